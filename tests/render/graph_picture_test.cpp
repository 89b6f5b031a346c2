// The picture of a motion graph: what it says, and what it looks like.
#include <render/graph_moves.h>
#include <render/graph_picture.h>
#include <render/image_diff.h>
#include <render/png.h>
#include <scene/motion_graph.h>

#include "backends.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <string>

namespace mobbscope {
namespace {

/// Three hubs that lead to each other and one by itself; moves are arcs of different speeds and turns.
Scene small_graph() {
    Scene scene;
    auto graph = std::make_shared<MotionGraph>();
    graph->hubs = {{"A"}, {"B"}, {"C"}, {"D"}};
    graph->bounds = {0.16, 0.6};
    const auto add = [&](int from, int to, double speed, double turn_deg) {
        constexpr int kCount = 60;
        const double per_step = turn_deg / kCount * 3.14159265358979 / 180;
        std::vector<mobb::Disk> samples;
        glm::dvec2 at(3, 4);
        for (int i = 0; i < kCount; ++i) {
            samples.push_back({at.x, at.y, 0.3});
            at += speed / 30 * glm::dvec2(std::cos(i * per_step), std::sin(i * per_step));
        }
        graph->moves.push_back({static_cast<int>(scene.clips.size()), from, to, {{3, 4}, 0}, {at, turn_deg}});
        scene.clips.push_back(
            {std::to_string(scene.clips.size()), {}, {}, std::make_shared<mobb::Clip>(1.0 / 30, samples)});
    };
    for (int i = 0; i < 9; ++i) add(0, i % 3, 0.8 + 0.2 * i, 20.0 * i - 80);
    for (int i = 0; i < 4; ++i) add(1, 2 - i % 3, 1.5, 30.0 * i - 45);
    add(2, 0, 0.4, 0);
    add(3, 3, 1, 90);
    scene.graph = graph;
    return scene;
}

TEST(GraphPicture, NamesEveryHubAndCountsItsMoves) {
    const DrawList list = graph_picture(small_graph(), {640, 360}, Theme::dark);
    const auto count = [&](const std::string& text) {
        return std::count_if(list.texts.begin(), list.texts.end(), [&](const TextRun& t) { return t.text == text; });
    };
    for (const char* hub : {"A", "B", "C", "D"}) EXPECT_EQ(count(hub), 2) << hub;  // as a node and on its card
    EXPECT_EQ(count("9 moves"), 1);
    EXPECT_EQ(count("1 move"), 2);
    EXPECT_EQ(list.headline, "Motion graph: 4 hubs, 15 moves, 30 s of motion");
}

TEST(GraphPicture, KeepsWithinItsEdges) {
    for (const PictureSize size : {PictureSize{640, 360}, PictureSize{1280, 720}, PictureSize{360, 640}}) {
        const DrawList list = graph_picture(small_graph(), size, Theme::light);
        const Rect picture{{0, 0}, {size.width, size.height}};
        for (const TextRun& text : list.texts) EXPECT_TRUE(picture.contains(text.box)) << text.text;
        for (const Panel& panel : list.panels) EXPECT_TRUE(picture.contains(panel.rect));
        for (const Panel& mark : list.marks) EXPECT_TRUE(picture.contains(mark.rect));
        for (const OverlayLine& line : list.overlay_lines) {
            EXPECT_TRUE(picture.contains({glm::min(line.from, line.to), glm::max(line.from, line.to)}));
        }
    }
}

TEST(GraphPicture, FloorPathsBeginAtTheHubAndFaceUp) {
    const std::vector<FloorPath> paths = floor_paths_of(small_graph());
    ASSERT_EQ(paths.size(), 15u);
    const FloorPath& straight = paths[4];  // 1.6 m/s for 2 s
    EXPECT_NEAR(straight.points.front().x, 0, 1e-12);
    EXPECT_NEAR(straight.points.back().x, 0, 1e-9);
    EXPECT_NEAR(straight.points.back().y, 3.2, 1e-9);
    EXPECT_NEAR(straight.speed(), 1.6, 1e-9);
    EXPECT_LT(paths[0].points.back().x, 0);  // it turns to the right
    EXPECT_GT(paths[8].points.back().x, 0);
}

TEST(GraphPicture, WidthsGrowWithTheNumberOfMoves) {
    const ArrowScale scale{16, 2};
    EXPECT_FLOAT_EQ(scale.width(16), 12);
    EXPECT_LT(scale.width(1), scale.width(4));
}

TEST(GraphPicture, NeedsAGraph) {
    EXPECT_THROW(graph_picture({}, {640, 360}, Theme::dark), std::invalid_argument);
    EXPECT_THROW(graph_picture(small_graph(), {1, 1}, Theme::dark), std::invalid_argument);
}

class GraphPicturePixels : public testing::OnEachBackend {};

TEST_P(GraphPicturePixels, AreTheGoldens) {
    const Image drawn = renderer().draw(graph_picture(small_graph(), {640, 360}, Theme::dark));
    const std::filesystem::path golden = MOBBSCOPE_SOURCE_DIR "/tests/render/goldens/motion_graph.png";
    const std::filesystem::path actual = std::filesystem::path(::testing::TempDir()) / "motion_graph.png";
    write_png(actual, drawn);
    ASSERT_TRUE(std::filesystem::exists(golden)) << "look at " << actual << " and copy it to " << golden;
    EXPECT_TRUE(diff(drawn, read_png(golden), {}).same)
        << "look at " << actual << "; if it is right, copy it to " << golden;
}

INSTANTIATE_TEST_SUITE_P(Backends, GraphPicturePixels, ::testing::Values(Backend::osmesa, Backend::egl),
                         testing::backend_name);

}  // namespace
}  // namespace mobbscope
