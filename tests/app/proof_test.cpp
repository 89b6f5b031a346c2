// The proof of an answer in the window: its rows, its bars, its file, and what it promises of a drag.
#include <app/viewport/agent_handles.h>
#include <app/window/headless_window.h>
#include <base/file.h>
#include <explain/certificate_file.h>
#include <render/gl/gl_context.h>

#include "app/folder_window.h"

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

namespace mobbscope::app {
namespace {

/// A stands while B goes around it in 6 s, 2 m away: no single line proves that. C walks far off.
std::string circling_scene() {
    std::string stand, circle;
    for (int i = 0; i < 60; ++i) {
        const double angle = 2 * std::numbers::pi * i / 60;
        const char* comma = i > 0 ? "," : "";
        stand += std::string(comma) + "[0,0,0.3]";
        circle += std::string(comma) + '[' + std::to_string(2 * std::cos(angle)) + ',' +
                  std::to_string(2 * std::sin(angle)) + ",0.3]";
    }
    return R"({"clips": {"stand": {"dt": 0.1, "samples": [)" + stand + R"(]}, "circle": {"dt": 0.1, "samples": [)" +
           circle + R"(]}}, "agents": [{"name": "A", "clip": "stand"}, {"name": "B", "clip": "circle"}]})";
}

struct ProofWindow : FolderWindow<CrossingFolder> {
    ProofWindow() : FolderWindow({1280, 900}) {
        open(folder.write("circling.json", circling_scene()));
        run("query.select", "0");
    }
    void run(const std::string& command, const std::string& argument = "") {
        run_command(session, command, argument);
        window.settle();
        move({2, 2});  // a panel that has got a scroll bar is narrower in the next frame
    }
    const QueryProof& proof() const { return findings_of()->proof; }
    std::shared_ptr<const QueryFindings> findings_of() const { return session.queries.findings(); }
    glm::vec2 at(const std::string& mark) { return window.shell().marks().all().at(mark).center(); }
    void move(glm::vec2 to) {
        window.shell().feed(MouseMove{to});
        window.settle();
    }
    void press(bool down) {
        window.shell().feed(MouseButton{0, down});
        window.settle();
    }
    void click(glm::vec2 there) {
        move(there);
        press(true);
        press(false);
    }
    void key(Key key, bool shift = false) {
        if (shift) window.shell().feed(KeyPress{Key::shift, true});
        window.shell().feed(KeyPress{key, true});
        window.shell().feed(KeyPress{key, false});
        if (shift) window.shell().feed(KeyPress{Key::shift, false});
        window.settle();
    }
    std::optional<std::size_t> line() const {
        const auto& time = session.workspace.view().time;
        return time ? proof().at(*time) : std::nullopt;
    }
    /// How opaque the walls are, in the order of their lines.
    std::vector<float> walls() {
        std::vector<float> out;
        for (const BoxInstance& box : window.shell().shown()->boxes)
            if (box.order.layer == DrawLayer::findings && box.order.level == 2) out.push_back(box.fill.a);
        return out;
    }
    /// Where an agent's handle is with the agent shifted by so much from where it is.
    glm::vec2 shifted_handle(glm::dvec2 start, double time, glm::dvec2 shift) {
        const DrawList& list = *window.shell().shown();
        const glm::vec2 here = *list.projection.project(list.space.point(start.x, start.y, time));
        const glm::vec2 there = *list.projection.project(list.space.point(start.x + shift.x, start.y + shift.y, time));
        return at("handle.move") + (there - here);
    }
};

TEST(Proof, ItsRowsBarsAndKeysGoToItsLines) {
    ProofWindow w;
    const std::size_t count = w.proof().lines.size();
    ASSERT_GE(count, 2u);
    EXPECT_EQ(w.walls().size(), count);
    EXPECT_FALSE(w.line());
    w.click(w.at("proof.line.1"));
    EXPECT_EQ(w.line(), 1u);
    EXPECT_EQ(w.session.workspace.view().time, w.proof().lines[1].nearest);
    const std::vector<float> walls = w.walls();
    EXPECT_EQ(std::ranges::max_element(walls) - walls.begin(), 1) << "its wall stands out";
    w.key(Key::y);
    EXPECT_EQ(w.line(), 2 % count);
    w.key(Key::y, true);
    w.key(Key::y, true);
    EXPECT_EQ(w.line(), 0u);
    // From another step it leads back to the walls.
    w.run("step.first");
    EXPECT_TRUE(w.walls().empty());
    const Rect bars = w.window.shell().marks().all().at("timeline.proof");
    w.click({bars.max.x - 6, bars.center().y});
    EXPECT_EQ(w.line(), count - 1);
    EXPECT_EQ(w.walls().size(), count);
}

TEST(Proof, ItsIntervalsInTheRecursionSquareAreClicked) {
    ProofWindow w;
    for (const char* section :
         {"steps", "this test", "reasons", "in time", "along each axis", "costliest branches", "tests", "the proof"})
        if (w.has("section." + std::string(section))) w.click(w.at("section." + std::string(section)));
    ASSERT_TRUE(w.has("query.square"));
    const Rect square = w.window.shell().marks().all().at("query.square");
    const ProofLine& last = w.proof().lines.back();
    const float share = static_cast<float>(0.5 * (last.t0 + last.t1) / 6);
    w.click({square.min.x + share * square.size().x, square.max.y - share * square.size().y});
    EXPECT_EQ(w.line(), w.proof().lines.size() - 1);
}

TEST(Proof, IsSavedAsTheFileThatVerifyReads) {
    ProofWindow w;
    const std::filesystem::path file = w.folder.file("proof.json");
    w.run("proof.save");
    EXPECT_EQ(w.session.dialogs.now, Dialog::save_proof);
    w.run("proof.save", file.string());
    const FittedScene& fitted = w.session.workspace.fitted();
    const std::vector<QueryCertificate> read = read_certificates(read_file(file), "proof.json", fitted);
    ASSERT_EQ(read.size(), 1u);
    EXPECT_EQ(read[0].proof.tiles.size(), w.proof().lines.size());
    const SceneQuery query = fitted.queries()[0];
    EXPECT_EQ(why_not_proven(fitted.placed(query.a).placed_clip(), fitted.placed(query.b).placed_clip(), read[0].proof),
              "");
}

TEST(Proof, SaysOfADragWhetherTheAnswerCanChange) {
    for (const std::size_t dragged : {0u, 1u}) {
        SCOPED_TRACE(dragged);
        ProofWindow w;
        w.run("go.agent", dragged == 0 ? "A" : "B");
        const QueryProof before = w.proof();
        const mobb::PlacedClip& clip = w.findings_of()->sides[dragged].clip();
        const glm::dvec2 start(clip.disk(0).x, clip.disk(0).y);
        // The corner that is farthest; A goes the other way.
        const auto corner =
            std::ranges::max(before.margins->free_region, {}, [](glm::dvec2 at) { return glm::length(at); });
        const glm::dvec2 way = dragged == 0 ? -corner : corner;
        ASSERT_GT(glm::length(way), 0.01);
        const glm::vec2 from = w.at("handle.move");
        const glm::vec2 inside = w.shifted_handle(start, clip.time(0), 0.9 * way);
        const glm::vec2 outside = w.shifted_handle(start, clip.time(0), 1.2 * way);
        w.move(from);
        w.press(true);
        EXPECT_FALSE(w.has("drag.answer_stays")) << "nothing has moved yet";
        w.move(from + glm::vec2(30, 0));  // past the reach of a click
        w.move(inside);
        EXPECT_TRUE(w.has("drag.answer_stays"));
        EXPECT_FALSE(w.has("drag.answer_may_change"));
        EXPECT_FALSE(w.findings_of()->clearance.contact);
        EXPECT_NE(w.proof().tightest ? w.proof().lines[*w.proof().tightest].gap : 0, before.lines[*before.tightest].gap)
            << "trace and proof are fresh";
        w.move(outside);
        EXPECT_TRUE(w.has("drag.answer_may_change"));
        EXPECT_FALSE(w.has("drag.answer_stays"));
        w.press(false);
        EXPECT_FALSE(w.has("drag.answer_may_change"));
        w.run("edit.undo");
        EXPECT_EQ(w.proof().lines[*w.proof().tightest].gap, before.lines[*before.tightest].gap);
    }
}

TEST(Proof, APromiseOfADragIsAboutMovesAndStarts) {
    DragPromise promise;
    promise.certificate.tiles = {{0, 1, {1, 0}, 0, 0.5}};
    promise.margins.shift_in_time = 0.25;
    HandleDrag drag;
    drag.start = {{1, 2}, 0, 3};
    drag.handle = Handle::move;
    EXPECT_NEAR(*promise.room(drag, {{0.75, 9}, 0, 3}), 0.25, 1e-12);
    promise.of_a = true;
    EXPECT_NEAR(*promise.room(drag, {{0.75, 9}, 0, 3}), 0.75, 1e-12);
    drag.handle = Handle::shift;
    EXPECT_NEAR(*promise.room(drag, {{1, 2}, 0, 2.9}), 0.15, 1e-12);
    EXPECT_LT(*promise.room(drag, {{1, 2}, 0, 3.3}), 0);
    drag.handle = Handle::turn;
    EXPECT_FALSE(promise.room(drag, {{1, 2}, 40, 3}));
}

}  // namespace
}  // namespace mobbscope::app
