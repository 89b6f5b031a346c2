// Which bones touch, in the panel of a query, on its clearance and in the picture of the moment.
#include "app/folder_window.h"

#include <app/commands/command.h>
#include <app/window/headless_window.h>
#include <render/gl/gl_context.h>
#include <support/bvh_text.h>
#include <support/temp_folder.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

namespace mobbscope::app {
namespace {

/// Walkers whose arms reach 0.7 m forward, side by side; one who is a disk alone.
struct BodiesWindow : FolderWindow<TempFolder> {
    explicit BodiesWindow(const std::string& b, int frames = 2) : FolderWindow({1280, 900}) {
        std::string walker = kWalker;
        walker = walker.substr(0, walker.find("Frames:")) + "Frames: " + std::to_string(frames) + "\nFrame Time: 0.1\n";
        for (int i = 0; i < frames; ++i) walker += "10 95 30 0 0 0 0 0 0 0 0 0\n";
        folder.write("walker.bvh", walker);
        session.files.open({folder.write("s.json", R"({"clips": {"walk": {"source": "walker.bvh", "unit": "cm"},
            "disk": {"dt": 0.1, "samples": [[0,0,0.7]]}},
            "agents": [{"name": "A", "clip": "walk"}, {"name": "B", )" +
                                                       b + "}]}")});
        window.settle();
        run_command(session, "query.select", "0");
        window.settle();
        // What was found has made the panel longer: Dear ImGui 1.90 has its scrollbar a frame later.
        window.settle();
    }
    void click(const std::string& mark) {
        const glm::vec2 at = window.shell().marks().all().at(mark).center();
        for (const auto& input :
             {InputEvent(MouseMove{at}), InputEvent(MouseButton{0, true}), InputEvent(MouseButton{0, false})}) {
            window.shell().feed(input);
            window.settle();
        }
    }
    const DrawList& list() { return *window.shell().shown(); }
    bool says(const std::string& part) {
        return std::ranges::any_of(list().texts,
                                   [&](const TextRun& run) { return run.text.find(part) != std::string::npos; });
    }
};

TEST(BodiesWindow, GoesToTheNearestBonesOfAHitThatIsNone) {
    BodiesWindow w(R"("clip": "walk", "translate": [0.3, 0])");
    ASSERT_TRUE(w.session.queries.findings()->clearance.contact) << "disks hit";
    EXPECT_TRUE(w.has("query.bodies"));
    EXPECT_TRUE(w.has("query.clearance_legend"));
    w.click("query.bones");
    EXPECT_EQ(w.session.workspace.view().show, Show::moment);
    ASSERT_TRUE(w.session.workspace.view().time);
    EXPECT_TRUE(w.says("0.200 m")) << "between capsules 0.3 m apart";
    EXPECT_TRUE(w.says("nearest bones"));
    const auto green = [&](const LineInstance& line) {
        return line.color == w.list().palette.separated && line.width > 4;
    };
    EXPECT_TRUE(std::ranges::any_of(w.list().lines, green)) << "the two stand out";
}

TEST(BodiesWindow, ATouchIsRed) {
    BodiesWindow w(R"("clip": "walk", "translate": [0.08, 0])");
    w.click("query.bones");
    EXPECT_EQ(w.session.workspace.view().time, 0.0);
    EXPECT_TRUE(w.says("0.020 m deep"));
    EXPECT_TRUE(std::ranges::any_of(w.list().lines, [&](const LineInstance& line) {
        return line.color == w.list().palette.hit && line.width > 4;
    }));
}

TEST(BodiesWindow, WhoHasNoSkeletonHasNoBody) {
    BodiesWindow w(R"("clip": "disk")");
    EXPECT_FALSE(w.has("query.bodies"));
    EXPECT_FALSE(w.has("query.bones"));
    EXPECT_FALSE(w.has("query.clearance_legend"));
    run_command(w.session, "view.moment");
    w.window.settle();
    EXPECT_FALSE(w.says("bones"));
}

TEST(BodiesWindow, LongClipsAreMeasuredWhenSomebodyAsks) {
    BodiesWindow w(R"("clip": "walk", "translate": [0.3, 0])", 12'000);
    EXPECT_FALSE(w.has("query.bodies"));
    w.click("query.measure_bones");
    w.window.settle();
    EXPECT_TRUE(w.has("query.bodies"));
    EXPECT_TRUE(w.has("query.bones"));
}

}  // namespace
}  // namespace mobbscope::app
