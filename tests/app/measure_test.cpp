// Measuring in the picture: two clicks, what they take, and what the picture and `render` show of it.
#include <app/commands/picture_order.h>
#include <app/window/headless_window.h>
#include <mobb/box.h>
#include <render/gl/gl_context.h>
#include <render/parts/measured_line.h>
#include <scene/drawn_agent.h>

#include "app/folder_window.h"

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace mobbscope::app {
namespace {

struct MeasureWindow : FolderWindow<CrossingFolder> {
    MeasureWindow() : FolderWindow({1280, 900}) { open(folder.scene); }
    const DrawList& list() { return *window.shell().shown(); }
    Measuring& measuring() { return session.workspace.measuring; }
    glm::vec2 seen(glm::dvec3 place) {
        const Rect viewport = window.shell().marks().all().at("viewport");
        return viewport.min + list().projection.project(list().space.point(place.x, place.y, place.z)).value();
    }
    void move(glm::vec2 at) {
        window.shell().feed(MouseMove{at});
        window.settle();
    }
    void click(glm::vec2 at) {
        move(at);
        window.shell().feed(MouseButton{0, true});
        window.settle();
        window.shell().feed(MouseButton{0, false});
        window.settle();
    }
    glm::vec2 mark(const std::string& name) { return window.shell().marks().all().at(name).center(); }
    DrawnAgent agent(std::size_t index) {
        return drawn_agents(session.workspace.fitted(), session.workspace.view()).at(index);
    }
    /// Where the centre of a sample is, and when.
    glm::dvec3 centre(std::size_t index, int sample) {
        const DrawnAgent who = agent(index);
        const mobb::Disk disk = who.clip().disk(sample);
        return {disk.x, disk.y, who.clip().time(sample)};
    }
    /// A few pixels from the centre of the last sample, away from the one before.
    glm::vec2 near_end(std::size_t index) {
        const glm::vec2 last = seen(centre(index, 59)), before = seen(centre(index, 58));
        return last + 3.0f * glm::normalize(last - before);
    }
    std::size_t measured_lines() {
        return static_cast<std::size_t>(
            std::ranges::count(list().highlights, HighlightLine::Role::measure, &HighlightLine::role));
    }
};

TEST(Measure, TwoClicksOnCentresMeasureTheWayBetweenThem) {
    MeasureWindow w;
    w.run("view.boxes");
    w.run("view.top");
    w.run("view.measure");
    EXPECT_TRUE(w.measuring().picks);
    // From above the last disk of each path lies in front.
    const glm::dvec3 a = w.centre(0, 59), c = w.centre(2, 59);
    w.click(w.near_end(0));
    ASSERT_TRUE(w.measuring().from);
    EXPECT_EQ(w.measuring().from->place, a);
    EXPECT_EQ(w.measuring().from->what, "A, sample 59, centre");
    EXPECT_TRUE(w.measuring().picks);
    w.click(w.near_end(2));
    ASSERT_TRUE(w.measuring().to);
    EXPECT_EQ(w.measuring().to->place, c);
    EXPECT_FALSE(w.measuring().picks) << "the next click selects";
    const MeasuredLine line = w.measuring().line().value();
    EXPECT_NEAR(line.metres(), 9, 1e-12);
    EXPECT_NEAR(line.seconds(), 0.5, 1e-12);
    EXPECT_NEAR(line.speed().value(), 18, 1e-9);
    EXPECT_GT(w.measured_lines(), 0u);
    EXPECT_EQ(w.session.workspace.selection.kind, Selection::Kind::none) << "the clicks have selected nothing";

    // The moment shows it too, and Escape ends it.
    w.run("view.moment");
    EXPECT_GT(w.measured_lines(), 0u);
    w.run("go.none");
    EXPECT_EQ(w.measured_lines(), 0u);
    EXPECT_TRUE(w.measuring().is_nothing());
}

TEST(Measure, ClicksTakeRimsCornersAndTheFloor) {
    MeasureWindow w;
    w.run("view.top");
    w.run("view.leaves");
    const DrawnAgent a = w.agent(0);
    // The upper corner of the last leaf's box.
    const int last = static_cast<int>(a.placed.tree().nodes().size()) - 1;
    glm::dvec3 corner = mobb::corners(world_box(a.placed, last))[7];
    corner.z /= a.placed.time_scale();
    w.run("view.measure");
    w.move(w.seen(corner));
    w.click(w.seen(corner) + glm::vec2(1, -1));
    ASSERT_TRUE(w.measuring().from);
    EXPECT_LT(glm::length(w.measuring().from->place - corner), 1e-9) << w.measuring().from->what;
    EXPECT_TRUE(w.measuring().from->what.ends_with(", corner")) << w.measuring().from->what;

    w.run("view.boxes");
    const glm::dvec3 middle = w.centre(0, 59);
    const double r = a.clip().disk(59).r;
    w.click(w.seen(middle + glm::dvec3(0, r, 0)) + glm::vec2(0, 2));
    ASSERT_TRUE(w.measuring().to);
    EXPECT_TRUE(w.measuring().to->what.ends_with(", edge")) << w.measuring().to->what;
    EXPECT_NEAR(glm::length(glm::dvec2(w.measuring().to->place - middle)), r, 1e-5);

    w.run("view.measure");
    EXPECT_FALSE(w.measuring().from) << "a new one begins";
    const glm::dvec3 floor(0.5, 4, 0);
    w.click(w.seen(floor));
    ASSERT_TRUE(w.measuring().from);
    EXPECT_EQ(w.measuring().from->what, "the floor");
    EXPECT_LT(glm::length(w.measuring().from->place - floor), 0.03) << "a pixel";
}

TEST(Measure, ADragBetweenTheClicksTurnsTheScene) {
    MeasureWindow w;
    w.run("view.measure");
    const Camera before = w.session.workspace.view().camera;
    const glm::vec2 at = w.mark("viewport");
    w.window.shell().feed(MouseMove{at});
    w.window.shell().feed(MouseButton{0, true});
    w.window.settle();
    w.window.shell().feed(MouseMove{at + glm::vec2(60, 0)});
    w.window.settle();
    w.window.shell().feed(MouseButton{0, false});
    w.window.settle();
    EXPECT_FALSE(w.measuring().from);
    EXPECT_TRUE(w.measuring().picks);
    EXPECT_FALSE(w.session.workspace.view().camera == before);
}

TEST(Measure, AnEndCanBeDragged) {
    MeasureWindow w;
    w.run("view.top");
    w.run("view.boxes");
    w.run("view.measure", "0.5,4,0:2,4,0");
    EXPECT_EQ(w.measuring().line(), (MeasuredLine{{0.5, 4, 0}, {2, 4, 0}}));
    w.move(w.mark("measure.to"));
    w.window.shell().feed(MouseButton{0, true});
    w.window.settle();
    const glm::dvec3 place(1.5, 5, 0);
    w.move(w.seen(place));
    w.window.shell().feed(MouseButton{0, false});
    w.window.settle();
    EXPECT_LT(glm::length(w.measuring().to->place - place), 0.03) << "a pixel";
    EXPECT_EQ(w.measuring().from->place, glm::dvec3(0.5, 4, 0));
}

TEST(Measure, ItsNumbersAreCopied) {
    MeasureWindow w;
    w.run("view.top");
    w.run("view.measure", "0,4,0:1.00000001,4,0.5");
    const Rect words = w.window.shell().marks().all().at("measure.words");
    w.click({words.min.x + 4, words.center().y});
    EXPECT_EQ(w.desktop.text, "1.00000001") << "of 1.000 m all digits";
    EXPECT_EQ(w.session.notifications.all().back().text, "Copied 1 m");
    EXPECT_TRUE(w.measuring().line()) << "it stays";
    w.run("view.copy_measured");
    EXPECT_EQ(w.desktop.text,
              "distance\t1.00000001 m\ntime\t0.5 s\nspeed\t2.00000002 m/s\nplaces\t0,4,0:1.00000001,4,0.5\n");
}

TEST(Measure, ThePictureThatIsExportedHasIt) {
    MeasureWindow w;
    w.run("view.measure", "0,4,0:2,5,1.5");
    const PictureOrder order = order_of_viewport(w.session.workspace, w.session.views);
    const DrawList list = draw_list_of(w.session.workspace, order);
    EXPECT_GT(std::ranges::count(list.highlights, HighlightLine::Role::measure, &HighlightLine::role), 0);
    EXPECT_TRUE(
        std::ranges::any_of(list.texts, [](const TextRun& run) { return run.text == "2.236 m, 1.500 s, 1.491 m/s"; }));
    w.run("file.copy_command");
    EXPECT_NE(w.desktop.text.find(" --measure 0,4,0:2,5,1.5 "), std::string::npos) << w.desktop.text;
}

TEST(Measure, WhereAgentsAreNotWhereTheyAreNothingIsMeasured) {
    MeasureWindow w;
    w.run("view.measure", "0,4,0:2,5,1.5");
    w.run("view.arrange");
    EXPECT_EQ(w.measured_lines(), 0u);
    EXPECT_NE(refusal(w.session, "view.measure"), "");
    EXPECT_EQ(why_not(w.session, command_named("view.measure")), "the agents are laid out in a grid");
    w.run("view.arrange");
    EXPECT_GT(w.measured_lines(), 0u);
}

TEST(Measure, PlacesAreReadAndWritten) {
    const MeasuredLine line{{-1.5, 2, 0.25}, {3, 4e-7, 1}};
    EXPECT_EQ(parse_measured_line(text_of(line)), line);
    EXPECT_EQ(measured_words({{0, 0, 1}, {3, 4, 1}}), "5.000 m at one moment");
    for (const char* wrong : {"", "1,2,3", "1,2:3,4", "1,2,3:4,5", "1,2,3:4,5,x", "1,2,3:4,5,6,7", "1,2,1e400:0,0,0"})
        EXPECT_THROW(parse_measured_line(wrong), std::invalid_argument) << wrong;
}

}  // namespace
}  // namespace mobbscope::app
