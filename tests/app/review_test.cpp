// Picture tests in the window: what is listed and shown, goldens that are taken and given back, and the way to a case's
// scene and back. The cases are drawn by the real program.
#include <app/commands/command.h>
#include <app/script/state_json.h>
#include <app/window/headless_window.h>
#include <render/gl/gl_context.h>
#include <render/image/png.h>
#include <support/input_error.h>
#include <support/temp_folder.h>

#include "app/three_cases.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>
#include <set>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace mobbscope::app {
namespace {

using mobbscope::testing::slurp;
using mobbscope::testing::TempFolder;
using testing::ThreeCases;
using testing::walkers;
namespace fs = std::filesystem;

/// A window on them.
struct ReviewWorld {
    TempFolder folder;
    ThreeCases files{folder.path()};
    Session session{false};
    std::string clipboard;
    std::unique_ptr<HeadlessWindow> window;

    ReviewWorld() {
        session.case_drawer.program = MOBBSCOPE_PROGRAM;
        session.settings.ui_scale = 1;
        window =
            std::make_unique<HeadlessWindow>(GlContext::open(Backend::automatic), session, PictureSize{1024, 700}, 1);
        session.hooks.set_clipboard = [this](const std::string& text) { clipboard = text; };
    }
    void open() {
        run_command(session, "file.review", files.cases().string());
        window->settle();
    }

    Review& review() { return *session.review(); }
    const ReviewCase& one(const std::string& name) { return review().cases()[review().index_of(name)]; }
    void show(const std::string& name) {
        run_command(session, "review.show", name);
        window->settle();
    }
    void key(const std::string& name) {
        const Chord chord = *chord_from_name(name);
        std::vector<Key> keys;
        if (chord.ctrl) keys.push_back(Key::ctrl);
        if (chord.shift) keys.push_back(Key::shift);
        keys.push_back(chord.key);
        for (const Key key : keys) window->shell().feed(KeyPress{key, true});
        for (auto key = keys.rbegin(); key != keys.rend(); ++key) window->shell().feed(KeyPress{*key, false});
        window->settle();
    }
    void move(glm::vec2 to) {
        window->shell().feed(MouseMove{to});
        window->settle();
    }
    void button(bool down) {
        window->shell().feed(MouseButton{0, down});
        window->settle();
    }
    void wheel(float notches) {
        window->shell().feed(Wheel{{0, notches}});
        window->settle();
    }
    void drag(glm::vec2 from, glm::vec2 by) {
        move(from);
        button(true);
        for (int i = 1; i <= 4; ++i) move(from + by * (static_cast<float>(i) / 4));
        button(false);
    }
    Rect mark(const std::string& name) const {
        const auto found = window->shell().marks().all().find(name);
        if (found == window->shell().marks().all().end()) throw std::runtime_error("no " + name);
        return found->second;
    }
    glm::vec2 middle(const std::string& name) const { return (mark(name).min + mark(name).max) / 2.0f; }
    void click(const std::string& name) {
        move(middle(name));
        button(true);
        button(false);
    }
    std::string said() const {
        std::string out;
        for (const Message& message : session.messages()) out += message.text + '\n';
        return out;
    }
};

std::string outcome_name(const ReviewCase& one) { return std::string(picture_tests::name(one.outcome())); }

TEST(Review, ListsWhatCameOfEachCase) {
    ReviewWorld w;
    w.open();
    EXPECT_EQ(w.said(), "");
    EXPECT_TRUE(w.session.reviewing());
    EXPECT_EQ(outcome_name(w.one("same")), "passed");
    EXPECT_EQ(outcome_name(w.one("moved")), "different");
    EXPECT_EQ(outcome_name(w.one("missing")), "missing golden");
    EXPECT_EQ(w.one("moved").result.drawn_by.backend.empty(), false);
    EXPECT_GT(w.one("moved").difference(), 0.01);
    ASSERT_EQ(w.one("moved").result.findings.size(), 2u) << "picture and draw list";
    const std::vector<std::string>& words = w.one("moved").result.findings[1].words;
    EXPECT_TRUE(std::ranges::any_of(words, [](const std::string& line) {
        return line.starts_with("disk of B, sample 0, base: ");
    })) << (words.empty() ? "nothing" : words.front());

    run_command(w.session, "review.order", "difference");
    EXPECT_EQ(w.review().listed().front(), w.review().index_of("missing"));
    run_command(w.session, "review.order", "outcome");
    EXPECT_EQ(w.review().listed().back(), w.review().index_of("same"));
    w.show("moved");
    w.key("L");
    EXPECT_EQ(w.review().listed().size(), 2u);
    EXPECT_FALSE(w.window->shell().marks().all().contains("case.same"));
    EXPECT_TRUE(w.window->shell().marks().all().contains("case.moved"));
}

TEST(Review, AcceptsOneOfTheFailingAndGivesItBack) {
    ReviewWorld w;
    const std::string picture = w.files.bytes("moved.png");
    const std::string numbers = w.files.bytes("moved.draw.json");
    w.open();
    w.click("case.moved");
    ASSERT_EQ(w.review().shown().file.name, "moved");
    w.click("review.accept");
    EXPECT_EQ(outcome_name(w.one("moved")), "passed");
    EXPECT_TRUE(w.one("moved").accepted);
    EXPECT_EQ(outcome_name(w.one("missing")), "missing golden") << "one of them was accepted";
    EXPECT_FALSE(fs::exists(w.files.file("missing.png")));
    EXPECT_NE(w.files.bytes("moved.png"), picture);
    EXPECT_NE(w.files.bytes("moved.draw.json"), numbers);
    EXPECT_EQ(ThreeCases::run("test '" + w.files.cases().string() + "' moved"), 0) << "as --update takes it";
    const std::string taken = w.files.bytes("moved.png");

    w.key("Ctrl+Z");
    EXPECT_EQ(w.files.bytes("moved.png"), picture);
    EXPECT_EQ(w.files.bytes("moved.draw.json"), numbers);
    EXPECT_EQ(outcome_name(w.one("moved")), "different");
    w.key("Ctrl+Y");
    EXPECT_EQ(w.files.bytes("moved.png"), taken);
    EXPECT_EQ(outcome_name(w.one("moved")), "passed");
}

TEST(Review, SeveralAreAcceptedAndGivenBackTogether) {
    ReviewWorld w;
    const std::string picture = w.files.bytes("moved.png");
    w.open();
    w.click("case.moved.mark");
    w.key("Ctrl+A");
    EXPECT_EQ(w.review().marked().size(), 2u);
    w.key("Shift+A");
    EXPECT_TRUE(w.review().marked().empty());
    EXPECT_TRUE(w.review().summary().ok());
    EXPECT_TRUE(fs::exists(w.files.file("missing.png")));
    w.key("Ctrl+Z");
    EXPECT_FALSE(fs::exists(w.files.file("missing.png"))) << "there was none";
    EXPECT_EQ(w.files.bytes("moved.png"), picture);
    EXPECT_EQ(w.review().summary().bad(), 2);
}

TEST(Review, OnlyWhatWasLookedAtIsAcceptedTogether) {
    ReviewWorld w;
    w.open();
    w.show("same");
    ASSERT_TRUE(w.one("missing").viewed) << "it is the first, which is shown at once";
    EXPECT_FALSE(w.one("moved").viewed);
    w.key("Ctrl+Shift+A");
    EXPECT_EQ(outcome_name(w.one("missing")), "passed");
    EXPECT_EQ(outcome_name(w.one("moved")), "different");
}

TEST(Review, GoldensThatChangedMeanwhileStay) {
    ReviewWorld w;
    w.open();
    w.show("moved");
    const std::string other = w.files.bytes("same.png");
    w.files.write("moved.png", other);
    w.key("A");
    EXPECT_NE(w.said().find("moved.png: has changed on the disk since the case was drawn"), std::string::npos)
        << w.said();
    EXPECT_EQ(w.files.bytes("moved.png"), other);
    EXPECT_EQ(w.files.bytes("moved.draw.json").find("pictures"), std::string::npos);
    EXPECT_FALSE(w.one("moved").accepted);
    EXPECT_FALSE(w.review().can_undo());

    // The same the other way round.
    w.key("R");
    w.key("A");
    ASSERT_TRUE(w.one("moved").accepted);
    w.files.write("moved.png", "mine");
    w.key("Ctrl+Z");
    EXPECT_EQ(w.files.bytes("moved.png"), "mine");
    EXPECT_TRUE(w.one("moved").accepted);
}

TEST(Review, NothingIsHalfWritten) {
    TempFolder folder;
    const std::vector<picture_tests::GoldenChange> changes{{folder.path() / "a.png", "new", "old"},
                                                           {folder.path() / "no folder" / "b.png", "new", {}}};
    folder.write("a.png", "old");
    EXPECT_THROW(picture_tests::write_goldens(changes), MachineError);
    EXPECT_EQ(slurp(folder.path() / "a.png"), "old");
}

TEST(Review, KeysGoFromCaseToCaseAndShowThePictures) {
    ReviewWorld w;
    w.open();
    EXPECT_EQ(w.review().shown().file.name, "missing");
    w.key("N");
    EXPECT_EQ(w.review().shown().file.name, "moved");
    w.key("Down");
    EXPECT_EQ(w.review().shown().file.name, "same");
    w.key("N");
    EXPECT_EQ(w.review().shown().file.name, "same") << "there is no other";
    w.key("P");
    EXPECT_EQ(w.review().shown().file.name, "moved");
    std::set<std::vector<std::uint8_t>> seen;
    for (std::size_t i = 0; i < kReviewModes.size(); ++i) {
        w.key(std::to_string(i + 1));
        EXPECT_EQ(w.review().look.mode, static_cast<ReviewMode>(i));
        seen.insert(w.window->shell().read_back().rgba);
    }
    EXPECT_EQ(seen.size(), kReviewModes.size());
    w.key("2");
    w.key("Space");
    EXPECT_EQ(w.review().look.mode, ReviewMode::actual);
    w.key("Space");
    EXPECT_EQ(w.review().look.mode, ReviewMode::golden);
}

/// The part of the window where the pictures are.
std::vector<std::uint8_t> pictures_seen(ReviewWorld& w) {
    const Image all = w.window->shell().read_back();
    const Rect part = w.mark("review.pictures");
    std::vector<std::uint8_t> out;
    for (int y = static_cast<int>(part.min.y) + 40; y < static_cast<int>(part.max.y); ++y) {
        const std::uint8_t* row = all.at(static_cast<int>(part.min.x), y);
        out.insert(out.end(), row, row + 4 * static_cast<int>(part.max.x - part.min.x));
    }
    return out;
}

TEST(Review, BlinksAtTheRateThatIsSet) {
    ReviewWorld w;
    w.open();
    w.show("moved");
    w.key("B");
    ASSERT_EQ(w.review().look.mode, ReviewMode::blink);
    run_command(w.session, "review.blink_rate", "1");
    w.window->settle();
    int changes = 0;
    std::vector<std::uint8_t> before = pictures_seen(w);
    for (int i = 0; i < 40; ++i) {
        w.window->run_for(0.1);
        const std::vector<std::uint8_t> now = pictures_seen(w);
        if (now != before) ++changes;
        before = now;
    }
    EXPECT_GE(changes, 3);
    EXPECT_LE(changes, 5);
    w.key("B");
    EXPECT_EQ(w.review().look.mode, ReviewMode::actual) << "the key ends it";
}

TEST(Review, TheSliderFollowsMouseAndKeys) {
    ReviewWorld w;
    w.open();
    w.show("moved");
    w.key("5");
    const double before = w.review().look.divider;
    w.drag(w.middle("review.divider"), {-60, 0});
    EXPECT_LT(w.review().look.divider, before - 0.05);
    const double dragged = w.review().look.divider;
    w.key("Right");
    EXPECT_NEAR(w.review().look.divider, dragged + 0.025, 1e-9);
    // All golden, or all actual picture.
    run_command(w.session, "review.golden");
    w.window->settle();
    const auto golden = pictures_seen(w);
    run_command(w.session, "review.slider");
    w.review().look.divider = 1;
    w.window->settle();
    const auto at_the_end = pictures_seen(w);
    w.review().look.divider = 0;
    w.window->settle();
    EXPECT_NE(pictures_seen(w), at_the_end);
    EXPECT_NE(golden, at_the_end) << "the line is there";
}

TEST(Review, TheWheelKeepsThePixelUnderTheMouse) {
    ReviewWorld w;
    w.open();
    w.show("moved");
    w.key("3");
    const double fits = w.review().look.fits;
    const glm::vec2 at = w.middle("picture.0") + glm::vec2(40, 30);
    w.move(at);
    for (int i = 0; i < 6; ++i) w.wheel(1);
    const ReviewLook look = w.review().look;
    EXPECT_NEAR(look.zoom, fits * std::pow(1.25, 6), 1e-6);
    const glm::dvec2 size(160, 120);
    const glm::dvec2 middle = w.middle("picture.0");
    const glm::dvec2 was = size / 2.0 + (glm::dvec2(at) - middle) / fits;
    const glm::dvec2 is = look.middle * size + (glm::dvec2(at) - middle) / look.zoom;
    EXPECT_NEAR(was.x, is.x, 0.5);
    EXPECT_NEAR(was.y, is.y, 0.5);
    w.drag(at, {-50, 0});
    EXPECT_NEAR(w.review().look.middle.x, look.middle.x + 50 / (160 * look.zoom), 1e-3);
    w.key("0");
    EXPECT_EQ(w.review().look.zoom, 1);
    w.key("F");
    EXPECT_EQ(w.review().look.zoom, 0);
    w.key("D");
    EXPECT_GT(w.review().look.zoom, 0) << "the part that differs";
    w.key("=");
    w.key("Shift+Left");
    w.key("-");
}

TEST(Review, ACaseOpensAsASceneAndWhatWasOpenIsBack) {
    ReviewWorld w;
    const fs::path own = w.files.path() / "own.json";
    std::ofstream(own) << walkers("5");
    w.session.open({own});
    run_command(w.session, "go.agent", "A");
    run_command(w.session, "agent.move", "2 2");
    ASSERT_TRUE(w.session.modified());
    const auto before = w.session.document().fitted;
    w.open();
    w.show("moved");
    w.key("Enter");
    EXPECT_EQ(w.said(), "");
    EXPECT_FALSE(w.session.reviewing());
    EXPECT_EQ(w.session.open_case_name(), "moved");
    EXPECT_EQ(w.session.scene().agents[1].placement.translate.x, 1.3);
    EXPECT_EQ(w.session.view().camera.distance, 8) << "as the case sees it";
    w.click("review.back");
    EXPECT_TRUE(w.session.reviewing());
    EXPECT_EQ(w.review().shown().file.name, "moved");
    EXPECT_EQ(outcome_name(w.one("moved")), "different") << "results stay";
    w.key("Escape");
    EXPECT_FALSE(w.session.reviewing());
    EXPECT_EQ(w.session.document().fitted, before);
    EXPECT_TRUE(w.session.modified());
    EXPECT_EQ(w.session.file(), own);
    w.key("Ctrl+Z");
    EXPECT_FALSE(w.session.modified()) << "with its past";
    w.key("Ctrl+R");
    EXPECT_TRUE(w.session.reviewing());
}

TEST(Review, TheScenesCommandsAreNotForPictureTests) {
    ReviewWorld w;
    w.open();
    EXPECT_EQ(why_not(w.session, command_named("view.top")), "picture tests are shown: leave them first");
    run_command(w.session, "review.leave");
    EXPECT_EQ(why_not(w.session, command_named("review.accept")), "no picture tests are shown");
}

TEST(Review, AnEarlierRunsPicturesAreTakenIfTheyAreStillTheSame) {
    ReviewWorld w;
    const fs::path out = w.files.path() / "out";
    EXPECT_NE(ThreeCases::run("test '" + w.files.cases().string() + "' --output '" + out.string() + "'"), 0);
    w.session.review(w.files.cases(), out);
    w.window->settle();
    EXPECT_EQ(outcome_name(w.one("moved")), "different");
    EXPECT_TRUE(w.one("moved").from_output);
    EXPECT_EQ(w.one("same").state, ReviewCase::State::not_drawn);
    w.show("moved");
    w.key("A");
    EXPECT_TRUE(w.one("moved").accepted) << w.said();
    w.key("Ctrl+Z");

    // Drawn otherwise now: it has to be looked at again.
    w.session.review(w.files.cases(), out);
    w.files.write("moved.json", walkers("1.6"));
    w.show("moved");
    w.key("A");
    EXPECT_FALSE(w.one("moved").accepted);
    EXPECT_NE(w.said().find("is drawn otherwise here"), std::string::npos) << w.said();
}

TEST(Review, ARunIsLiveAndCanBeStopped) {
    const TempFolder folder;
    const ThreeCases files(folder.path());
    Review review(files.cases(), {}, {.attended = true, .drawer = {MOBBSCOPE_PROGRAM, "auto"}});
    review.draw_all();
    EXPECT_TRUE(review.drawing());
    EXPECT_THROW(review.draw_all(), std::invalid_argument);
    review.cancel();
    EXPECT_FALSE(review.drawing());
    EXPECT_EQ(review.cases().front().state, ReviewCase::State::not_drawn);
    review.draw_all();
    while (review.drawing()) {
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
        review.poll();
    }
    EXPECT_EQ(review.summary().bad(), 2);
}

TEST(Review, ACrashIsAnOutcome) {
    const TempFolder folder;
    const ThreeCases files(folder.path());
    files.write("crash.sh", "#!/bin/sh\nkill -SEGV $$\n");
    fs::permissions(files.file("crash.sh"), fs::perms::owner_all);
    Review review(files.cases(), {}, {.attended = false, .drawer = {files.file("crash.sh"), "auto"}});
    review.draw_all();
    review.poll();
    EXPECT_EQ(review.summary()[picture_tests::CaseOutcome::failed], 3);
    EXPECT_NE(review.shown().result.message.find("crashed: Segmentation fault"), std::string::npos)
        << review.shown().result.message;
}

TEST(Review, BadInputIsOneLine) {
    ReviewWorld w;
    const std::string empty = (w.files.path() / "empty").string();
    fs::create_directory(empty);
    EXPECT_EQ(mobbscope::testing::input_error([&] { w.session.review(empty); }),
              empty + ": holds no case; a case is a file NAME.case.json");
    EXPECT_FALSE(w.session.reviewing());
    EXPECT_NE(ThreeCases::run("review '" + empty + "'"), 0);
    w.files.write("missing.case.json", "{");
    w.open();
    EXPECT_EQ(outcome_name(w.one("missing")), "failed");
    w.show("missing");
    EXPECT_NE(w.review().why_not_accept(w.review().current()), "");
}

TEST(Review, EveryCommandIsTried) {
    // By its key, by a click or by its name, in the tests above and here.
    ReviewWorld w;
    w.open();
    w.show("moved");
    run_command(w.session, "review.previous");
    EXPECT_EQ(w.review().shown().file.name, "missing");
    run_command(w.session, "review.mark");
    EXPECT_TRUE(w.one("missing").marked);
    run_command(w.session, "review.copy_command");
    EXPECT_EQ(w.clipboard, "mobbscope test " + w.files.cases().string() + " missing");
    run_command(w.session, "review.draw_all");
    EXPECT_EQ(w.review().summary().bad(), 2);
    run_command(w.session, "review.side");
    EXPECT_EQ(w.review().look.mode, ReviewMode::side_by_side);
    run_command(w.session, "review.slider");
    run_command(w.session, "review.divider_left");
    EXPECT_NEAR(w.review().look.divider, 0.475, 1e-9);
    for (const std::string id : {"review.pan_up", "review.pan_down", "review.pan_right"}) run_command(w.session, id);
    EXPECT_NEAR(w.review().look.middle.x, 0.6, 1e-9);
    EXPECT_NEAR(w.review().look.middle.y, 0.5, 1e-9);
    EXPECT_THROW(run_command(w.session, "review.cancel"), std::invalid_argument) << "nothing is drawn";
    const nlohmann::ordered_json state = state_json(w.session);
    EXPECT_EQ(state["review"]["case"], "missing");
    EXPECT_EQ(state["review"]["cases"]["moved"], "different");
}

}  // namespace
}  // namespace mobbscope::app
