#include "walker_moves.h"

#include <crowd/graph/build_graph.h>

#include <support/input_error.h>

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

namespace mobbscope {
namespace {

/// A quarter circle of 100 samples, to the left, from the origin along +x to (10, 10).
Scene quarter_circle() {
    std::vector<mobb::Disk> samples;
    for (int i = 0; i < 100; ++i) {
        const double angle = i / 100.0 * 1.5707963267948966;
        samples.push_back({10 * std::sin(angle), 10 - 10 * std::cos(angle), 0.3});
    }
    Scene scene;
    scene.clips.push_back({"turn", {}, {}, std::make_shared<mobb::Clip>(0.02, samples)});
    scene.graph = std::make_shared<MotionGraph>(graph_of_whole_clips(scene));
    return scene;
}

TEST(GraphWalk, FourQuarterTurnsComeBackToTheirBeginning) {
    const Scene scene = quarter_circle();
    mobb::Placement placed{{3, -2}, 40, 1};
    for (int i = 0; i < 4; ++i) placed = following(scene, 0, placed, 0);
    EXPECT_NEAR(placed.translate.x, 3, 2);
    EXPECT_NEAR(placed.translate.y, -2, 2);
    EXPECT_NEAR(placed.rotate_deg, 40, 8);  // the direction is read over 0.1 m, here two samples
    EXPECT_DOUBLE_EQ(placed.start, 9);
}

TEST(GraphWalk, TheNextMoveBeginsOneStepBehindTheLastSample) {
    const Scene scene = quarter_circle();
    const mobb::Placement first{{3, -2}, 40, 1};
    const mobb::Placement second = following(scene, 0, first, 0);
    const mobb::Clip& clip = *scene.clips[0].clip;
    const mobb::Disk last = mobb::PlacedClip(clip, first).disk(99);
    const mobb::Disk next = mobb::PlacedClip(clip, second).disk(0);
    EXPECT_NEAR(std::hypot(next.x - last.x, next.y - last.y), 0.157, 0.001);
}

TEST(GraphWalk, AWholeClipThatIsNoMoveIsRefused) {
    Scene scene;
    scene.clips.push_back(
        {"far", "far.csv", {}, std::make_shared<mobb::Clip>(0.1, std::vector{mobb::Disk{-2e6, 0, 1}})});
    EXPECT_EQ(input_error([&] { graph_of_whole_clips(scene); }),
              "far.csv: clip 'far': begins or ends more than 1e+06 m from the origin; move it there");
}

TEST(GraphWalk, MovesAreFoundByTheirFirstHub) {
    MotionGraph graph;
    graph.hubs = {{"a"}, {"b"}};
    graph.moves = {{0, 0, 1, {}, {}}, {1, 1, 0, {}, {}}, {2, 0, 0, {}, {}}};
    const std::vector<std::vector<int>> expected{{0, 2}, {1}};
    EXPECT_EQ(moves_by_hub(graph), expected);
}

}  // namespace
}  // namespace mobbscope
