// Picture tests in the window: what is listed and shown, goldens that are taken and given back, and the way to a case's
// scene and back. The cases are drawn by the real program.
#include <app/commands/situations.h>
#include <app/script/state_json.h>
#include <app/window/headless_window.h>
#include <base/base64.h>
#include <render/gl/gl_context.h>
#include <render/image/png.h>
#include <review/review_screen.h>
#include <support/input_error.h>
#include <support/temp_folder.h>

#include "app/crossing_folder.h"
#include "review/three_cases.h"

#include <gtest/gtest.h>
#include <imgui.h>
#include <nlohmann/json.hpp>

#include <signal.h>
#include <sys/resource.h>
#include <sys/types.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <latch>
#include <limits>
#include <memory>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

namespace mobbscope::app {
namespace {

namespace fs = std::filesystem;

/// A window on them.
struct ReviewWorld {
    TempFolder folder;
    ThreeCases files{folder.path()};
    Session session;
    ReviewScreen& reviews = add_review(session);
    testing::TestDesktop desktop;
    std::unique_ptr<HeadlessWindow> window;

    /// `attended`: runs go on beside the window.
    explicit ReviewWorld(bool attended = false) : session(attended) {
        reviews.case_drawer.program = MOBBSCOPE_PROGRAM;
        session.settings.ui_scale = 1;
        window =
            std::make_unique<HeadlessWindow>(GlContext::open(Backend::automatic), session, PictureSize{1024, 700}, 1);
        session.desktop = &desktop;
    }
    /// Opens a scene of the person's own, and leaves a change in it that is not saved.
    fs::path edit_own_scene() {
        const fs::path own = files.path() / "own.json";
        std::ofstream(own) << walkers("5");
        session.files.open({own});
        run_command(session, "go.agent", "A");
        run_command(session, "agent.move", "2 2");
        return own;
    }
    void open() {
        run_command(session, "file.review", files.cases().string());
        window->settle();
    }

    Review& review() { return *reviews.review(); }
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
    /// The lines that lie over the picture.
    std::vector<std::string> up() const {
        std::vector<std::string> out;
        for (const Message& message : session.notifications.all()) {
            if (message.up) out.push_back(message.text);
        }
        return out;
    }
    std::string said() const {
        std::string out;
        for (const Message& message : session.notifications.all()) out += message.text + '\n';
        return out;
    }
};

/// Stands in for the program that draws cases: it does so once it is let go.
class HeldDrawer {
  public:
    explicit HeldDrawer(const ThreeCases& files) : files_(files) {
        const std::string go = files.file("go").string();
        files.write("held.sh", "#!/bin/sh\necho $$ >'" + files.file("pid").string() + "'\nwhile [ ! -e '" + go +
                                   "' ]; do sleep 0.02; done\nexec '" MOBBSCOPE_PROGRAM "' \"$@\"\n");
        fs::permissions(program(), fs::perms::owner_all);
    }
    fs::path program() const { return files_.file("held.sh"); }
    void let_go() const { files_.write("go", ""); }
    /// Of the process that draws; waits for it.
    pid_t pid() const {
        while (!fs::exists(files_.file("pid")) || files_.bytes("pid").empty()) {
            std::this_thread::sleep_for(std::chrono::milliseconds(5));
        }
        return static_cast<pid_t>(std::stol(files_.bytes("pid")));
    }

  private:
    const ThreeCases& files_;
};

std::vector<ReviewNews> finished(Review& review) {
    std::vector<ReviewNews> all;
    while (review.run.drawing()) {
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
        for (ReviewNews& news : review.run.poll()) all.push_back(std::move(news));
    }
    return all;
}

std::string outcome_name(const ReviewCase& one) { return std::string(picture_tests::name(one.outcome())); }

TEST(Review, ListsWhatCameOfEachCase) {
    ReviewWorld w;
    w.open();
    EXPECT_EQ(w.said(), "");
    EXPECT_TRUE(w.reviews.shown());
    EXPECT_EQ(outcome_name(w.one("same")), "passed");
    EXPECT_EQ(outcome_name(w.one("moved")), "different");
    EXPECT_EQ(outcome_name(w.one("missing")), "missing golden");
    EXPECT_EQ(w.one("moved").result.drawn_by.backend.empty(), false);
    EXPECT_GT(w.one("moved").difference(), 0.01);
    ASSERT_EQ(w.one("moved").result.findings.size(), 2u) << "picture and state";
    const std::vector<std::string>& words = w.one("moved").result.findings[1].words;
    EXPECT_EQ(words, std::vector<std::string>{"B moved by (0.3, 0)"});

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
    const std::string numbers = w.files.bytes("moved.state.json");
    w.open();
    w.click("case.moved");
    ASSERT_EQ(w.review().shown().file.name, "moved");
    using Lines = std::vector<std::string>;
    w.click("review.accept");
    EXPECT_EQ(w.up(), Lines{"Accepted moved; undo gives the golden back"});
    EXPECT_EQ(outcome_name(w.one("moved")), "passed");
    EXPECT_TRUE(w.one("moved").accepted);
    EXPECT_EQ(outcome_name(w.one("missing")), "missing golden") << "one of them was accepted";
    EXPECT_FALSE(fs::exists(w.files.file("missing.png")));
    EXPECT_NE(w.files.bytes("moved.png"), picture);
    EXPECT_NE(w.files.bytes("moved.state.json"), numbers);
    EXPECT_EQ(ThreeCases::run("test '" + w.files.cases().string() + "' moved"), 0) << "as --update takes it";
    const std::string taken = w.files.bytes("moved.png");

    w.key("Ctrl+Z");
    EXPECT_EQ(w.files.bytes("moved.png"), picture);
    EXPECT_EQ(w.files.bytes("moved.state.json"), numbers);
    EXPECT_EQ(outcome_name(w.one("moved")), "different");
    EXPECT_EQ(w.up(), Lines{"Undone: accepting moved"}) << "that it was accepted is true no more";
    w.key("Ctrl+Y");
    EXPECT_EQ(w.up(), Lines{"Done again: accepting moved"});
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
    ASSERT_TRUE(w.one("missing").viewed) << "it is the first that fails, which is shown at once";
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
    EXPECT_EQ(w.files.bytes("moved.state.json").find("pictures"), std::string::npos);
    EXPECT_FALSE(w.one("moved").accepted);
    EXPECT_FALSE(w.review().goldens.can_undo());

    // The same the other way round.
    w.key("R");
    w.key("A");
    ASSERT_TRUE(w.one("moved").accepted);
    w.files.write("moved.png", "mine");
    w.key("Ctrl+Z");
    EXPECT_EQ(w.files.bytes("moved.png"), "mine");
    EXPECT_TRUE(w.one("moved").accepted);
}

/// No file may become larger than that, as if the disk were full.
class SmallFiles {
  public:
    explicit SmallFiles(rlim_t most) {
        before_ = std::signal(SIGXFSZ, SIG_IGN);
        ::getrlimit(RLIMIT_FSIZE, &limit_);
        const rlimit small{most, limit_.rlim_max};
        ::setrlimit(RLIMIT_FSIZE, &small);
    }
    ~SmallFiles() {
        ::setrlimit(RLIMIT_FSIZE, &limit_);
        std::signal(SIGXFSZ, before_);
    }
    SmallFiles(const SmallFiles&) = delete;
    SmallFiles& operator=(const SmallFiles&) = delete;

  private:
    rlimit limit_{};
    void (*before_)(int) = SIG_DFL;
};

TEST(Review, NothingIsHalfWritten) {
    TempFolder folder;
    const fs::path a = folder.path() / "a.png";
    const fs::path b = folder.path() / "b.state.json";
    const fs::path c = folder.path() / "c.png";
    const std::string large(2000, 'x');
    folder.write("a.png", "old");
    {
        const SmallFiles full(1000);
        EXPECT_THROW(picture_tests::write_goldens(
                         std::vector<picture_tests::GoldenChange>{{a, "new", "old"}, {b, "new", {}}, {c, large, {}}}),
                     MachineError);
    }
    EXPECT_EQ(slurp(a), "old");
    EXPECT_FALSE(fs::exists(b)) << "there was none";
    EXPECT_FALSE(fs::exists(c));

    // What cannot be put back is named, and the others are put back.
    folder.write("a.png", large);
    folder.write("b.state.json", "old");
    std::string said;
    try {
        const SmallFiles full(1000);
        picture_tests::write_goldens(
            std::vector<picture_tests::GoldenChange>{{b, "new", "old"}, {a, "new", large}, {c, large, {}}});
    } catch (const MachineError& error) {
        said = error.what();
    }
    EXPECT_NE(said.find("c.png: cannot be written"), std::string::npos) << said;
    EXPECT_NE(said.find("cannot be put back: " + a.string()), std::string::npos) << said;
    EXPECT_EQ(slurp(b), "old");
}

TEST(Review, ANameThatIsNoTextIsOneCasesFault) {
    ReviewWorld w;
    fs::copy(w.files.file("same.case.json"), w.files.file("no\xfftext.case.json"));
    w.open();
    EXPECT_NE(w.one("no\xfftext").result.message.find("the name is not UTF-8; rename the file"), std::string::npos);
    EXPECT_EQ(outcome_name(w.one("same")), "passed");
}

TEST(Review, NamesMayBeginAsOptionsDo) {
    ReviewWorld w;
    for (const std::string ending : {".case.json", ".png", ".state.json"}) {
        fs::rename(w.files.file("moved" + ending), w.files.file("-moved" + ending));
    }
    w.open();
    EXPECT_EQ(outcome_name(w.one("-moved")), "different");
    EXPECT_EQ(outcome_name(w.one("same")), "passed");
    w.show("-moved");
    run_command(w.session, "review.copy_command");
    EXPECT_EQ(w.desktop.text, "mobbscope test -- " + w.files.cases().string() + " -moved");
}

TEST(Review, WhatDoesNotGoWellIsAWarning) {
    ReviewWorld w;
    w.open();
    // One of several refuses: the others are accepted, and both is said.
    w.files.write("moved.png", "other");
    w.key("Ctrl+A");
    w.key("Shift+A");
    EXPECT_TRUE(w.one("missing").accepted);
    EXPECT_FALSE(w.one("moved").accepted);
    const std::vector<Message>& said = w.session.notifications.all();
    const auto level_of = [&](const std::string& part) {
        const auto at = std::ranges::find_if(said, [&](const Message& m) { return m.text.find(part) < m.text.size(); });
        return at == said.end() ? std::optional<MessageLevel>() : at->level;
    };
    EXPECT_EQ(level_of("Accepted missing; undo gives the golden back"), MessageLevel::info) << w.said();
    EXPECT_EQ(level_of("moved.png: has changed on the disk"), MessageLevel::error) << w.said();
}

TEST(Review, WhatHasNoPictureIsLeftOutAndSaid) {
    ReviewWorld w;
    w.files.write("same.case.json", "{");
    w.open();
    w.key("Ctrl+A");
    EXPECT_EQ(w.review().marked().size(), 2u) << "not the one that cannot be drawn";
    w.show("same");
    w.key("M");
    w.key("Shift+A");
    EXPECT_TRUE(w.one("moved").accepted);
    EXPECT_TRUE(w.one("missing").accepted);
    EXPECT_NE(w.said().find("Not accepted: same: it failed, so there is no golden to take"), std::string::npos)
        << w.said();
    w.key("Ctrl+Z");
    EXPECT_NE(w.said().find("Undone: accepting 2 pictures"), std::string::npos) << w.said();
    w.key("Ctrl+Y");
    EXPECT_NE(w.said().find("Done again: accepting 2 pictures"), std::string::npos) << w.said();
}

TEST(Review, SeveralOfAnEarlierRunAreOneStep) {
    ReviewWorld w;
    const fs::path out = w.files.path() / "out";
    const std::string picture = w.files.bytes("moved.png");
    ThreeCases::run("test '" + w.files.cases().string() + "' --output '" + out.string() + "'");
    w.reviews.open(w.files.cases(), out);
    w.show("missing");
    w.key("R");
    ASSERT_FALSE(w.one("missing").from_output);
    ASSERT_TRUE(w.one("moved").from_output);
    w.key("Ctrl+A");
    w.key("Shift+A");
    EXPECT_TRUE(w.one("missing").accepted) << w.said();
    EXPECT_TRUE(w.one("moved").accepted) << "the one that had to be drawn anew first";
    EXPECT_EQ(w.review().goldens.undo_title(), "accepting 2 pictures");
    w.key("Ctrl+Z");
    EXPECT_EQ(w.files.bytes("moved.png"), picture);
    EXPECT_FALSE(fs::exists(w.files.file("missing.png")));
    EXPECT_FALSE(w.review().goldens.has_undo());
}

/// A test of another program asked for it.
TEST(Review, ACaseThatIsNoFileYetIsAcceptedAndGivenBack) {
    ReviewWorld w;
    const fs::path goldens = w.files.path() / "new", out = w.files.path() / "out";
    std::ofstream(w.files.path() / "asked") << R"({"name": "deep/one", "scene": ")" << w.edit_own_scene().string()
                                            << R"(", "keys": "{\"size\": \"160x120\"}"})" << '\n';
    ThreeCases::run("test '" + goldens.string() + "' --asked --output '" + out.string() + "' <'" +
                    (w.files.path() / "asked").string() + "'");
    w.reviews.open(goldens, out);
    w.show("deep/one");
    EXPECT_EQ(outcome_name(w.one("deep/one")), "missing golden");
    w.key("A");
    EXPECT_TRUE(fs::exists(goldens / "deep/one.case.json")) << w.said();
    EXPECT_TRUE(fs::exists(goldens / "deep/one.png"));
    w.key("Ctrl+Z");
    EXPECT_FALSE(fs::exists(goldens / "deep/one.case.json"));
}

TEST(Review, WhatIsBeingDrawnIsNotTakenBack) {
    const TempFolder folder;
    const ThreeCases files(folder.path());
    const std::string picture = files.bytes("moved.png");
    const HeldDrawer drawer(files);
    drawer.let_go();
    Review review(find_review(files.cases()), {.attended = true, .drawer = {drawer.program(), "auto"}});
    review.run.draw_all();
    finished(review);
    const std::size_t moved = review.index_of("moved");
    review.goldens.accept({moved});
    fs::remove(files.file("go"));
    review.run.draw({moved});
    ASSERT_TRUE(review.run.drawing());
    // It would come back as passed, held against the golden that was taken, while the one of before is there again.
    EXPECT_TRUE(review.goldens.has_undo());
    EXPECT_FALSE(review.goldens.can_undo());
    drawer.let_go();
    finished(review);
    ASSERT_TRUE(review.goldens.can_undo());
    review.goldens.undo();
    EXPECT_EQ(files.bytes("moved.png"), picture);
    EXPECT_EQ(outcome_name(review.cases()[moved]), "different");
    review.run.draw({review.index_of("same")});
    EXPECT_TRUE(review.goldens.can_redo()) << "another case is being drawn";
    finished(review);
}

TEST(Review, ARunEndsWithIt) {
    const TempFolder folder;
    const ThreeCases files(folder.path());
    const HeldDrawer drawer(files);
    auto review = std::make_unique<Review>(find_review(files.cases()),
                                           ReviewSurroundings{.attended = true, .drawer = {drawer.program(), "auto"}});
    review->run.draw_all();
    const pid_t child = drawer.pid();
    ASSERT_EQ(::kill(child, 0), 0);
    review.reset();
    EXPECT_NE(::kill(child, 0), 0) << "nobody else would end it";
}

TEST(Review, NobodyIsWokenOnceItHasEnded) {
    const TempFolder folder;
    const ThreeCases files(folder.path());
    files.write("crash.sh", "#!/bin/sh\nkill -SEGV $$\n");
    fs::permissions(files.file("crash.sh"), fs::perms::owner_all);
    std::atomic<bool> wakes = false;
    std::atomic<bool> gone = false;
    std::atomic<bool> woke_what_is_gone = false;
    const auto wake = [&] {
        wakes = true;
        std::this_thread::sleep_for(std::chrono::milliseconds(100));
        if (gone) woke_what_is_gone = true;
    };
    auto review = std::make_unique<Review>(
        find_review(files.cases()),
        ReviewSurroundings{.attended = true, .wake = wake, .drawer = {files.file("crash.sh"), "auto"}});
    review->run.draw_all();
    while (!wakes) std::this_thread::yield();
    review.reset();
    gone = true;
    while (Job::any_left()) std::this_thread::yield();
    EXPECT_FALSE(woke_what_is_gone);
}

TEST(Review, AllWorkEndsWithTheWindow) {
    ReviewWorld w(true);
    const HeldDrawer drawer(w.files);
    w.reviews.case_drawer.program = drawer.program();
    w.open();
    // Who looks into a file is about to wake the window, and does so for a while.
    std::latch wakes_now(1);
    std::latch woke(1);
    const auto wake = [&] {
        wakes_now.count_down();
        woke.wait();
    };
    const fs::path file = w.files.file("same.json");
    w.session.dialogs.preview.ask(file, 0, false, wake);
    w.session.dialogs.preview.ask(file, 1, false, wake);
    wakes_now.wait();
    std::atomic<bool> ended = false;
    std::jthread window([&] {
        w.session.end_work();
        ended = true;
    });
    for (int i = 0; i < 20 && !ended; ++i) std::this_thread::sleep_for(std::chrono::milliseconds(10));
    EXPECT_FALSE(ended) << "the window may go, and somebody still wakes it";
    woke.count_down();
    window.join();
    const int before = w.desktop.wakes;
    EXPECT_FALSE(w.review().run.drawing());
    for (int i = 0; i < 500 && Job::any_left(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(10));
    EXPECT_FALSE(Job::any_left()) << "somebody still holds one";
    EXPECT_EQ(w.desktop.wakes, before);
}

TEST(Review, ARunIsShownAndStoppedWhereTheSceneIsShownToo) {
    ReviewWorld w(true);
    const HeldDrawer drawer(w.files);
    w.reviews.case_drawer.program = drawer.program();
    w.open();
    EXPECT_TRUE(w.window->shell().marks().all().contains("job.0"));
    w.key("Escape");
    ASSERT_FALSE(w.reviews.shown());
    ASSERT_TRUE(w.review().run.drawing());
    ASSERT_EQ(w.session.notifications.all().size(), 1u);
    EXPECT_EQ(w.session.notifications.all().front().offers.at(0).command, "review.back")
        << "who left by mistake sees the way back";
    w.click("job.0.cancel");
    EXPECT_FALSE(w.review().run.drawing());
    EXPECT_FALSE(w.window->shell().marks().all().contains("job.0"));
    EXPECT_EQ(w.session.notifications.all().back().text, "Cancelled");
    run_command(w.session, "review.back");
    run_command(w.session, "review.draw_all");
    w.session.notifications.clear();
    run_command(w.session, "review.cancel");
    EXPECT_EQ(w.said(), "Cancelled\n");
}

TEST(Review, BeginsAtTheFirstThatFails) {
    ReviewWorld w;
    fs::rename(w.files.file("same.case.json"), w.files.file("a.case.json"));
    for (const std::string ending : {".png", ".state.json"})
        fs::rename(w.files.file("same" + ending), w.files.file("a" + ending));
    w.open();
    EXPECT_EQ(outcome_name(w.one("a")), "passed");
    EXPECT_EQ(w.review().shown().file.name, "missing");
    // Once somebody has chosen a case, it stays that one, also when the folder is opened again.
    w.show("a");
    w.key("Shift+R");
    EXPECT_EQ(w.review().shown().file.name, "a");
    w.open();
    EXPECT_EQ(w.review().shown().file.name, "a");
    w.reviews.open(w.files.cases() / ".");
    EXPECT_EQ(w.review().shown().file.name, "missing") << "of another folder";
}

TEST(Review, ACaseThatNobodyChoseIsNotWhereItBeginsAgain) {
    ReviewWorld w;
    const std::string update = "test '" + w.files.cases().string() + "' --update all";
    ASSERT_EQ(ThreeCases::run(update), 0);
    w.open();
    ASSERT_TRUE(w.review().summary().ok());
    ASSERT_EQ(w.review().shown().file.name, "missing");
    w.files.write("moved.json", walkers("1.6"));
    w.open();
    EXPECT_EQ(w.review().shown().file.name, "moved") << "the first that fails now";
    fs::remove(w.files.file("missing.png"));
    w.key("Shift+R");
    EXPECT_EQ(w.review().shown().file.name, "moved") << "it stays in view while the review is open";
    w.open();
    EXPECT_EQ(w.review().shown().file.name, "missing");
}

TEST(Review, WarningsOfAnotherFolderAreOver) {
    ReviewWorld w;
    w.session.notifications.tell(MessageLevel::warning, "of the scene before");
    ASSERT_EQ(w.session.notifications.unread(), 1u);
    w.open();
    EXPECT_EQ(w.session.notifications.unread(), 0u);
    EXPECT_FALSE(w.session.notifications.has_up());
    w.session.notifications.tell(MessageLevel::warning, "of the picture tests");
    run_command(w.session, "file.demo");
    w.window->settle();
    EXPECT_EQ(w.session.notifications.unread(), 0u);
    EXPECT_NE(w.said().find("of the picture tests"), std::string::npos) << "the list keeps it";
}

TEST(Review, EscapePutsTheSliderBack) {
    ReviewWorld w;
    w.open();
    w.show("moved");
    w.key("5");
    w.move(w.middle("review.divider"));
    w.button(true);
    w.move(w.middle("review.divider") - glm::vec2(60, 0));
    ASSERT_LT(w.review().look.divider, 0.45);
    w.key("Escape");
    EXPECT_EQ(w.review().look.divider, 0.5);
    EXPECT_TRUE(w.reviews.shown()) << "the key does one thing";
    w.move(w.middle("review.divider") - glm::vec2(30, 0));
    w.button(false);
    EXPECT_EQ(w.review().look.divider, 0.5);
}

TEST(Review, TheListIsGoneThroughByKeys) {
    ReviewWorld w;
    w.open();
    ASSERT_EQ(w.review().shown().file.name, "missing");
    for (int i = 0; i < 10 && w.session.keys.focus != "case.missing"; ++i) w.key("Tab");
    ASSERT_EQ(w.session.keys.focus, "case.missing") << "it begins with the case that is shown";
    w.key("End");
    EXPECT_EQ(w.session.keys.focus, "case.same");
    EXPECT_EQ(w.review().shown().file.name, "missing") << "it is shown once it is chosen";
    w.key("Enter");
    EXPECT_EQ(w.review().shown().file.name, "same");
    w.key("Up");
    EXPECT_EQ(w.session.keys.focus, "case.moved");
    w.key("Home");
    EXPECT_EQ(w.session.keys.focus, "case.missing");
}

TEST(Review, FilesDroppedOnItAreOpenedNotAdded) {
    ReviewWorld w;
    const fs::path own = w.files.path() / "own.json";
    std::ofstream(own) << walkers("5");
    w.open();
    w.window->shell().feed(Drop{{own}});
    w.window->settle();
    ASSERT_EQ(w.session.dialogs.now, Dialog::dropped);
    EXPECT_FALSE(w.window->shell().marks().all().contains("dropped.add"));
    w.key("Escape");
    EXPECT_TRUE(w.reviews.shown());
    w.window->shell().feed(Drop{{own}});
    w.window->settle();
    w.key("Enter");
    EXPECT_FALSE(w.reviews.shown());
    EXPECT_EQ(w.session.workspace.file, own);
    EXPECT_EQ(w.said(), "");
}

/// Pixels at scale 1.
float width_of_caption(const std::string& text) {
    const auto& fonts = ImGui::GetIO().Fonts->Fonts;
    const auto smallest = std::min_element(fonts.begin(), fonts.end(),
                                           [](const ImFont* a, const ImFont* b) { return a->FontSize < b->FontSize; });
    ImFont& caption = **smallest;
    return std::ceil(caption.CalcTextSizeA(caption.FontSize, std::numeric_limits<float>::max(), 0, text.c_str()).x);
}

TEST(Review, TitleAndStatusBarAreAboutIt) {
    ReviewWorld w;
    const fs::path own = w.edit_own_scene();
    ASSERT_TRUE(w.session.shows_unsaved());
    w.window->settle();
    w.open();
    EXPECT_EQ(w.session.shown_title(), w.files.cases().filename().string());
    EXPECT_FALSE(w.session.shows_unsaved());
    EXPECT_EQ(w.mark("status.counts").size().x,
              width_of_caption("3 picture tests: 1 passed, 1 different, 1 without a golden"));
    run_command(w.session, "review.leave");
    EXPECT_EQ(w.session.shown_title(), "own.json");
}

TEST(Review, PicturesOfOtherCasesAreNotKept) {
    ReviewWorld w;
    w.open();
    w.show("moved");
    const std::weak_ptr<const Image> golden = w.review().pictures().golden;
    ASSERT_FALSE(golden.expired());
    w.show("missing");
    ASSERT_EQ(w.review().pictures().golden, nullptr);
    EXPECT_TRUE(golden.expired()) << "a texture of it is left";
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
    EXPECT_EQ(w.review().shown().file.name, "missing") << "behind the last one the first";
    w.key("P");
    EXPECT_EQ(w.review().shown().file.name, "moved");
    w.key("A");
    w.key("P");
    EXPECT_EQ(w.review().shown().file.name, "missing");
    EXPECT_FALSE(find_command("review.next_failing", commands(w.session))->enabled(w.session)) << "no other fails";
    w.key("Ctrl+Z");
    EXPECT_EQ(w.review().shown().file.name, "moved") << "what was given back is shown";
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

TEST(Review, TheSliderStaysInWhatIsSeenOfThePictures) {
    ReviewWorld w;
    w.open();
    w.show("moved");
    w.key("5");
    w.key("D");
    ASSERT_GT(w.review().look.zoom, 0);
    const Rect view = w.window->shell().marks().all().at("picture.0");
    for (const double middle : {0.1, 0.5, 0.9}) {
        w.review().look.zoom = 8 * w.review().look.fits;
        w.review().look.middle.x = middle;
        w.window->settle();
        EXPECT_NEAR(w.middle("review.divider").x, view.center().x, 1) << middle;
    }
    w.drag(w.middle("review.divider"), {40, 0});
    EXPECT_NEAR(w.middle("review.divider").x, view.center().x + 40, 1);
    w.drag(w.middle("review.divider"), {view.size().x, 0});
    EXPECT_EQ(w.review().look.divider, 1);
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
    const fs::path own = w.edit_own_scene();
    ASSERT_TRUE(w.session.workspace.modified());
    const auto before = w.session.workspace.document().fitted;
    w.open();
    w.show("moved");
    w.key("Enter");
    EXPECT_EQ(w.said(), "");
    EXPECT_FALSE(w.reviews.shown());
    EXPECT_EQ(w.session.files.visited(), "moved");
    EXPECT_EQ(w.session.workspace.scene().agents[1].placement.translate.x, 1.3);
    EXPECT_EQ(w.session.workspace.view().camera.distance, 8) << "as the case sees it";
    w.click("review.back");
    EXPECT_TRUE(w.reviews.shown());
    EXPECT_EQ(w.review().shown().file.name, "moved");
    EXPECT_EQ(outcome_name(w.one("moved")), "different") << "results stay";
    w.key("Escape");
    EXPECT_FALSE(w.reviews.shown());
    EXPECT_EQ(w.session.workspace.document().fitted, before);
    EXPECT_TRUE(w.session.workspace.modified());
    EXPECT_EQ(w.session.workspace.file, own);
    w.key("Ctrl+Z");
    EXPECT_FALSE(w.session.workspace.modified()) << "with its past";
    w.key("Ctrl+R");
    EXPECT_TRUE(w.reviews.shown());
}

TEST(Review, TheScenesCommandsAreNotForPictureTests) {
    ReviewWorld w;
    w.open();
    EXPECT_EQ(why_not(w.session, command_named("view.top", commands(w.session))),
              "picture tests are shown: leave them first");
    EXPECT_EQ(&present_situation(w.session), &w.reviews.situation());
    for (const std::string_view id : w.reviews.situation().commands) {
        EXPECT_NE(find_command(id, commands(w.session)), nullptr) << id;
    }
    run_command(w.session, "review.leave");
    EXPECT_EQ(why_not(w.session, command_named("review.accept", commands(w.session))), "no picture tests are shown");
}

TEST(Review, AcceptingPassesWhatIsWholeAndSkipsWhatWasNotDrawn) {
    ReviewCase one;
    one.state = ReviewCase::State::drawn;
    one.accepted = true;
    one.result.outcome = picture_tests::CaseOutcome::different;
    EXPECT_EQ(one.outcome(), picture_tests::CaseOutcome::passed);
    one.result.not_drawn = "no OpenGL";
    EXPECT_EQ(one.outcome(), picture_tests::CaseOutcome::skipped);
    one.result.findings = {{{}, "the scene expects another answer", {}}};
    EXPECT_EQ(one.outcome(), picture_tests::CaseOutcome::different);
}

TEST(Review, AReportsGoldensAreTakenByteByByteAndDrawNothing) {
    ReviewWorld w;
    const fs::path out = w.files.path() / "out";
    const std::string page = (w.files.path() / "page.html").string();
    const std::string command =
        "test '" + w.files.cases().string() + "' --output '" + out.string() + "' --html '" + page;
    EXPECT_NE(ThreeCases::run(command + "'"), 0);
    const std::string before = w.files.bytes("moved.png");
    w.reviews.case_drawer.program = w.files.file("none");
    w.files.write("moved.json", walkers("1.6"));
    for (const fs::path& report : {out, fs::path(page)}) {
        w.reviews.open(w.files.cases(), report);
        w.window->settle();
        EXPECT_EQ(outcome_name(w.one("moved")), "different");
        EXPECT_TRUE(w.one("moved").from_output);
        EXPECT_EQ(w.one("same").state, ReviewCase::State::not_drawn);
        w.show("moved");
        w.key("A");
        EXPECT_TRUE(w.one("moved").accepted) << w.said();
        EXPECT_EQ(w.files.bytes("moved.png"), mobbscope::testing::slurp(out / "moved.actual.png"));
        w.key("Ctrl+Z");
        EXPECT_EQ(w.files.bytes("moved.png"), before);
    }
    // Somebody else has accepted it meanwhile.
    EXPECT_EQ(ThreeCases::run("test '" + w.files.cases().string() + "' moved --accept '" + out.string() + "'"), 0);
    w.key("A");
    EXPECT_TRUE(w.one("moved").accepted);
    EXPECT_NE(w.said().find("moved: it is the golden already"), std::string::npos) << w.said();
    EXPECT_FALSE(w.review().goldens.has_undo());
}

TEST(Review, GoldenNumbersStandBesideThoseOfNow) {
    const auto answers = [](int time, const char* contact) {
        return R"({"mobbscope_answers": 1, "answers": [{"query": 0, "a": "A", "b": "B", "collides": true, "contact": )" +
               std::string(contact) + R"(, "tests": {"time": )" + std::to_string(time) + R"(, "aabb": 0}}]})";
    };
    const auto line = [](const HeldRow& row) {
        return row.what + '|' + row.golden + '|' + row.actual + '|' + row.ratio + (row.changed ? "|changed" : "");
    };
    std::vector<std::string> lines;
    for (const HeldRow& row : held_rows(answers(13, R"({"time": 0.5})"), answers(1, R"({"time": 0.5})"))) {
        EXPECT_EQ(row.of, "query 0, A and B");
        lines.push_back(line(row));
    }
    EXPECT_EQ(lines, (std::vector<std::string>{"collides|true|true|", "contact time|0.5|0.5|",
                                               "tests time|13|1|13 times fewer|changed"}));
    EXPECT_TRUE(held_rows(answers(1, "null"), answers(1, "null")).empty());
    EXPECT_TRUE(held_rows("{", answers(1, "null")).empty());
    EXPECT_EQ(held_rows(std::nullopt, answers(1, "null")).size(), 2u) << "without a golden all that there is";

    const auto trees = [](const char* kind, const char* half) {
        return R"({"mobbscope_fit": 1, "trees": [{"clip": "walk", "nodes": [{"index": 0}, {"index": 1, "kind": ")" +
               std::string(kind) + R"(", "half": )" + half + "}]}]}";
    };
    const std::vector<HeldRow> kinds = held_rows(trees("obb2d", "[1, 2]"), trees("obb3d", "[1, 2, 3]"));
    ASSERT_EQ(kinds.size(), 1u);
    EXPECT_EQ(kinds[0].of, "fit of 'walk', node 1");
    EXPECT_EQ(line(kinds[0]), "kind|obb2d|obb3d||changed");
    const std::vector<HeldRow> halves = held_rows(trees("obb2d", "[1, 2]"), trees("obb2d", "[1.0000000000001, 3]"));
    ASSERT_EQ(halves.size(), 1u);
    EXPECT_EQ(line(halves[0]), "half[1]|2|3||changed");
}

TEST(Review, AnswersAreShownInWordsAndAccepted) {
    ReviewWorld w;
    const auto write_case = [&](const std::string& more) {
        w.files.write("answers.case.json",
                      R"({"mobbscope_case": 1, "scene": "same.json", "hold": ["answers"])" + more + "}");
    };
    write_case("");
    ASSERT_EQ(ThreeCases::run("test '" + w.files.cases().string() + "' --update answers"), 0);
    const std::string before = w.files.bytes("answers.answers.json");
    w.open();
    EXPECT_EQ(outcome_name(w.one("answers")), "passed");
    write_case(R"(, "fit": {"tree": "umobb"})");
    w.show("answers");
    run_command(w.session, "review.draw");
    w.window->settle();
    EXPECT_EQ(outcome_name(w.one("answers")), "different") << w.said();
    EXPECT_TRUE(w.window->shell().marks().all().contains("held.answers.answers.json"));
    EXPECT_TRUE(w.window->shell().marks().all().contains("held.answers.answers.json.table"));
    EXPECT_EQ(w.review().pictures().number_files, std::vector{w.files.file("answers.answers.json")});
    EXPECT_FALSE(w.window->shell().marks().all().contains("picture.0"));
    w.key("A");
    EXPECT_TRUE(w.one("answers").accepted) << w.said();
    EXPECT_NE(w.files.bytes("answers.answers.json"), before);
    w.key("Ctrl+Z");
    EXPECT_EQ(w.files.bytes("answers.answers.json"), before);
    EXPECT_EQ(outcome_name(w.one("answers")), "different");

    // What the scene expects is nothing to accept.
    w.files.write("same.json", walkers("1").insert(1, R"("queries": [{"a": "A", "b": "B", "expect": {"tests":
                               {"time": 1000}}}], )"));
    write_case("");
    run_command(w.session, "review.draw");
    w.window->settle();
    EXPECT_EQ(outcome_name(w.one("answers")), "different");
    EXPECT_TRUE(w.window->shell().marks().all().contains("held.scene"));
    EXPECT_EQ(w.review().why_not_accept(w.review().index_of("answers")),
              "no golden differs, but its scene expects another answer; correct the scene");
}

TEST(Review, ACaseThatAReportBringsIsTakenAloneAndSaid) {
    ReviewWorld w;
    const fs::path out = w.files.path() / "out";
    EXPECT_NE(ThreeCases::run("test '" + w.files.cases().string() + "' --output '" + out.string() + "'"), 0);
    const std::string before = w.files.bytes("moved.case.json");
    nlohmann::json brought = nlohmann::json::parse(before);
    brought["allowed"] = "100%";
    nlohmann::json report = nlohmann::json::parse(mobbscope::testing::slurp(out / "report.json"));
    for (nlohmann::json& one : report["cases"]) {
        if (one["name"] != "moved") continue;
        one["fresh"].push_back(
            {{"golden", ".case.json"}, {"bytes", base64(brought.dump())}, {"replaces", base64(before)}});
    }
    write_file(out / "report.json", report.dump());
    w.reviews.open(w.files.cases(), out);
    w.show("moved");
    run_command(w.session, "review.mark_failing");
    run_command(w.session, "review.accept_marked");
    EXPECT_TRUE(w.one("missing").accepted) << w.said();
    EXPECT_FALSE(w.one("moved").accepted);
    EXPECT_NE(w.said().find("moved: the report brings the case itself"), std::string::npos) << w.said();
    EXPECT_EQ(w.files.bytes("moved.case.json"), before);
    w.key("A");
    EXPECT_TRUE(w.one("moved").accepted) << w.said();
    EXPECT_NE(w.said().find("moved.case.json is the case itself, no golden: other \"allowed\""), std::string::npos)
        << w.said();
    EXPECT_NE(w.said().find("moved.case.json is weaker: the share of pixels in \"allowed\" grows"), std::string::npos);
    EXPECT_EQ(w.files.bytes("moved.case.json"), brought.dump());
    w.key("Ctrl+Z");
    EXPECT_EQ(w.files.bytes("moved.case.json"), before);
}

TEST(Review, OfADamagedReportNothingIsTaken) {
    ReviewWorld w;
    const fs::path out = w.files.path() / "out";
    EXPECT_NE(ThreeCases::run("test '" + w.files.cases().string() + "' --output '" + out.string() + "'"), 0);
    const std::string before = w.files.bytes("moved.png");
    nlohmann::json report = nlohmann::json::parse(mobbscope::testing::slurp(out / "report.json"));
    for (nlohmann::json& one : report["cases"]) {
        for (nlohmann::json& fresh : one["fresh"]) {
            if (fresh["golden"] == ".state.json") fresh["bytes"] = "e30x";  // "{}1"
        }
    }
    write_file(out / "report.json", report.dump());
    w.reviews.open(w.files.cases(), out);
    w.show("moved");
    w.key("A");
    EXPECT_FALSE(w.one("moved").accepted);
    EXPECT_NE(w.said().find("moved.state.json as it would be"), std::string::npos) << w.said();
    EXPECT_EQ(w.files.bytes("moved.png"), before);
}

TEST(Review, ARunIsLiveAndCanBeStopped) {
    const TempFolder folder;
    const ThreeCases files(folder.path());
    Review review(find_review(files.cases()), {.attended = true, .drawer = {MOBBSCOPE_PROGRAM, "auto"}});
    review.run.draw_all();
    EXPECT_TRUE(review.run.drawing());
    EXPECT_THROW(review.run.draw_all(), std::invalid_argument);
    review.run.cancel();
    EXPECT_FALSE(review.run.drawing());
    EXPECT_EQ(review.cases().front().state, ReviewCase::State::not_drawn);
    review.run.draw_all();
    finished(review);
    EXPECT_EQ(review.summary().bad(), 2);
}

TEST(Review, ACrashIsAnOutcome) {
    const TempFolder folder;
    const ThreeCases files(folder.path());
    files.write("crash.sh", "#!/bin/sh\nkill -SEGV $$\n");
    fs::permissions(files.file("crash.sh"), fs::perms::owner_all);
    Review review(find_review(files.cases()), {.attended = false, .drawer = {files.file("crash.sh"), "auto"}});
    review.run.draw_all();
    review.run.poll();
    EXPECT_EQ(review.summary()[picture_tests::CaseOutcome::failed], 3);
    EXPECT_NE(review.shown().result.message.find("crashed: Segmentation fault"), std::string::npos)
        << review.shown().result.message;
}

TEST(Review, BadInputIsOneLine) {
    ReviewWorld w;
    const std::string empty = (w.files.path() / "empty").string();
    fs::create_directory(empty);
    EXPECT_EQ(mobbscope::testing::input_error([&] { w.reviews.open(empty); }),
              empty + ": holds no case; a case is a file NAME.case.json");
    EXPECT_FALSE(w.reviews.shown());
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
    EXPECT_EQ(w.desktop.text, "mobbscope test " + w.files.cases().string() + " missing");
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
