// Conflicts of plans in the words of path finding.
#include <conflicts/plan_conflicts.h>

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace mobbscope {
namespace {

using Cells = std::vector<glm::dvec2>;

mobb::Clip plan_of(const Cells& cells, double dt = 1) {
    std::vector<mobb::Disk> samples;
    for (const glm::dvec2& cell : cells) samples.push_back({cell.x, cell.y, 0.3});
    return {dt, std::move(samples), mobb::Motion::linear};
}

/// "swap 2..3 (1, 1) (1, 2); ".
std::string conflicts_of(const Cells& a, const Cells& b, double start_b = 0, double dt = 1, double dt_b = 1) {
    const mobb::Clip one = plan_of(a, dt);
    const mobb::Clip other = plan_of(b, dt_b);
    const auto whole = [](double number) { return std::to_string(static_cast<int>(number)); };
    const auto cell = [&](glm::dvec2 at) { return " (" + whole(at.x) + ", " + whole(at.y) + ")"; };
    std::string out;
    for (const PlanConflict& found :
         plan_conflicts(mobb::PlacedClip(one, {}), mobb::PlacedClip(other, {{0, 0}, 0, start_b}))) {
        out += std::string(name(found.kind)) + ' ' + whole(found.t0) + ".." + whole(found.t1) + cell(found.a) +
               cell(found.b) + "; ";
    }
    return out;
}

TEST(PlanConflicts, WhoIsInOneCellAtOneStepIsAVertexConflict) {
    EXPECT_EQ(conflicts_of({{0, 0}, {1, 0}, {2, 0}}, {{1, 1}, {1, 0}, {1, -1}}), "vertex 1..1 (1, 0) (1, 0); ");
    EXPECT_EQ(conflicts_of({{0, 0}, {1, 0}, {1, 0}}, {{1, 1}, {1, 0}, {1, 0}}),
              "vertex 1..1 (1, 0) (1, 0); vertex 2..2 (1, 0) (1, 0); ");
}

TEST(PlanConflicts, WhoGoesWhereTheOtherComesFromSwaps) {
    EXPECT_EQ(conflicts_of({{0, 0}, {1, 0}}, {{1, 0}, {0, 0}}), "swap 0..1 (0, 0) (1, 0); ");
    // The published plan of the Safe Interval search.
    EXPECT_EQ(conflicts_of({{0, 0}, {1, 0}, {1, 1}, {1, 2}, {2, 2}}, {{2, 2}, {1, 2}, {1, 2}, {1, 1}, {1, 0}, {0, 0}}),
              "swap 2..3 (1, 1) (1, 2); ");
}

TEST(PlanConflicts, WhoFollowsOrCrossesAtAnotherTimeHasNone) {
    EXPECT_EQ(conflicts_of({{0, 0}, {1, 0}, {2, 0}}, {{1, 0}, {2, 0}, {3, 0}}), "") << "one behind the other";
    EXPECT_EQ(conflicts_of({{1, 0}, {2, 0}, {3, 0}}, {{0, 0}, {1, 0}, {2, 0}}), "") << "the other way round";
    EXPECT_EQ(conflicts_of({{0, 0}, {1, 0}}, {{1, 0}, {0, 0}}, 2), "") << "later";
    EXPECT_EQ(conflicts_of({{0, 0}, {1, 1}}, {{1, 0}, {0, 1}}), "") << "they cross, but on no common edge";
}

TEST(PlanConflicts, CountsTimeAsTheAgentsDo) {
    EXPECT_EQ(conflicts_of({{0, 0}, {1, 0}, {2, 0}}, {{2, 0}, {1, 0}}, 1), "swap 1..2 (1, 0) (2, 0); ");
    // Steps of half a second: every second one of them is a step of the other.
    EXPECT_EQ(conflicts_of({{0, 0}, {5, 5}}, {{9, 9}, {8, 8}, {5, 5}}, 0, 1, 0.5), "vertex 1..1 (5, 5) (5, 5); ");
}

}  // namespace
}  // namespace mobbscope
