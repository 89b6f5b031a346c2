// The picture of a motion graph: what it says. What it looks like is a golden:
// tests/picture_tests/plain_pictures_golden_test.cpp.
#include <render/pictures/graph_moves.h>
#include <render/pictures/graph_picture.h>

#include "small_graph.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace mobbscope {
namespace {

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
        for (const OverlayPanel& panel : list.panels) EXPECT_TRUE(picture.contains(panel.rect));
        for (const OverlayPanel& mark : list.marks) EXPECT_TRUE(picture.contains(mark.rect));
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

}  // namespace
}  // namespace mobbscope
