// What stands out in a fit: each kind on a clip that has it, and not on its twin that has it not.
#include <explain/expected_cost.h>
#include <explain/fit_findings.h>
#include <explain/query_workload.h>
#include <mobb/level_figures.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace mobbscope {
namespace {

using Kind = FitFinding::Kind;

constexpr int kCount = 640;

/// 30 samples a second.
mobb::ClipPtr motion(const std::function<mobb::Disk(int)>& at, int count = kCount) {
    std::vector<mobb::Disk> samples;
    for (int i = 0; i < count; ++i) samples.push_back(at(i));
    return std::make_shared<const mobb::Clip>(1.0 / 30, samples);
}

/// 1.4 m/s, swaying a little.
mobb::Disk walking(int i) { return {1.4 * i / 30, 0.02 * std::sin(i / 5.0), 0.4}; }
mobb::Disk circling(int i) { return {2 * std::cos(0.7 * i / 30), 2 * std::sin(0.7 * i / 30), 0.4}; }
mobb::Disk who_stands(int) { return {3, 4, 0.4}; }

std::vector<FitFinding> findings_in(const mobb::ClipPtr& clip, const mobb::FitOptions& options = {}) {
    const mobb::Tree tree(clip, options);
    return fit_findings(tree, expected_shares(tree));
}

std::optional<FitFinding> found(Kind kind, const std::vector<FitFinding>& all) {
    const auto at = std::ranges::find(all, kind, &FitFinding::kind);
    return at == all.end() ? std::nullopt : std::optional(*at);
}

double counted_cost(const mobb::ClipPtr& clip, const mobb::FitOptions& options) {
    const std::vector<mobb::TestCounts> tests = count_tests(
        standard_workload(std::array{clip}, 20'000, 5),
        std::array<std::shared_ptr<const mobb::Tree>, 1>{std::make_shared<const mobb::Tree>(clip, options)});
    return cost_of(mean_tests(tests));
}

TEST(FitFindings, AreNoneOfCleanMotions) {
    for (const mobb::TreeKind kind : {mobb::TreeKind::mobb, mobb::TreeKind::moving, mobb::TreeKind::aabb}) {
        for (const auto& at : {walking, circling}) {
            const std::vector<FitFinding> all = findings_in(motion(at), {.tree = kind});
            EXPECT_TRUE(all.empty()) << mobb::name(kind) << ": " << all.front().text;
        }
        // Who stands needs one box.
        EXPECT_TRUE(findings_in(motion(who_stands), {.tree = kind, .leaf = kCount}).empty());
    }
    EXPECT_TRUE(findings_in(motion(walking, 1)).empty());
    EXPECT_TRUE(findings_in(motion([](int) { return mobb::Disk{}; }, 2)).empty());
}

TEST(FitFindings, AreNoneWhereNothingCanBePlaced) {
    EXPECT_TRUE(findings_in(motion([](int i) { return mobb::Disk{9e8, 9e8 + i, 1}; })).empty());
}

TEST(FitFindings, FreeBoxesThatLeanTooFarGrow) {
    const mobb::ClipPtr clip = motion(circling);
    const mobb::FitOptions lean{.tree = mobb::TreeKind::umobb};
    const auto loose = found(Kind::loose_levels, findings_in(clip, lean));
    ASSERT_TRUE(loose);
    const std::vector<mobb::LevelFigures> levels = mobb::level_figures(mobb::Tree(clip, lean));
    EXPECT_EQ(loose->level, levels.back().level);
    EXPECT_GT(levels.back().volume, levels[levels.size() - 2].volume);
    EXPECT_TRUE(loose->text.starts_with("Boxes grow below level ")) << loose->text;
    EXPECT_NE(loose->text.find(": at 1 m/s they lean too far, at 4 m/s they end at "), std::string::npos)
        << loose->text;
    // The twin: the same at the time scale that the sentence gives.
    mobb::FitOptions steep = lean;
    steep.time_scale = 4;
    EXPECT_FALSE(found(Kind::loose_levels, findings_in(clip, steep)));
    // The mend is cheaper, on other placements too.
    ASSERT_TRUE(loose->mend);
    EXPECT_EQ(mend_words(*loose->mend, lean), "MOBB");
    EXPECT_NEAR(1 - counted_cost(clip, *loose->mend) / counted_cost(clip, lean), loose->cost, 0.05);
}

TEST(FitFindings, LeavesAreTooSmallWhereBoxesDoNotShrink) {
    const mobb::ClipPtr clip = motion(who_stands);
    const auto small = found(Kind::small_leaves, findings_in(clip));
    ASSERT_TRUE(small);
    ASSERT_TRUE(small->mend);
    EXPECT_EQ(mend_words(*small->mend, {}), "leaf 640");
    EXPECT_GT(small->cost, 0.5);
    EXPECT_NEAR(1 - counted_cost(clip, *small->mend) / counted_cost(clip, {}), small->cost, 0.05);
    EXPECT_FALSE(found(Kind::small_leaves, findings_in(motion(walking))));
}

TEST(FitFindings, LeavesAreTooLargeWhereTheyHoldHalfAWalk) {
    const mobb::ClipPtr clip = motion(circling);
    const mobb::FitOptions coarse{.leaf = 320};
    const auto large = found(Kind::large_leaves, findings_in(clip, coarse));
    ASSERT_TRUE(large);
    EXPECT_EQ(large->level, 1);
    ASSERT_TRUE(large->mend);
    EXPECT_TRUE(large->text.starts_with("Leaves of 320 samples are too large: ")) << large->text;
    EXPECT_NEAR(1 - counted_cost(clip, *large->mend) / counted_cost(clip, coarse), large->cost, 0.05);
    // Levels that were cut off are mended, too.
    const auto cut = found(Kind::large_leaves, findings_in(clip, {.levels = 2}));
    ASSERT_TRUE(cut);
    EXPECT_EQ(cut->mend->levels, 0);
    EXPECT_TRUE(mend_words(*cut->mend, {.levels = 2}).ends_with("all levels"));
    EXPECT_FALSE(found(Kind::large_leaves, findings_in(clip, *large->mend)));
}

TEST(FitFindings, ANodeIsCostlyThatMovesWhileTheOthersStand) {
    const auto circles_in = [](int first, int end) {
        return motion([=](int i) {
            if (i < first || i >= end) return mobb::Disk{0, 0, 0.3};
            return mobb::Disk{3 * std::sin(0.1 * (i - first)), 3 - 3 * std::cos(0.1 * (i - first)), 0.3};
        });
    };
    const mobb::ClipPtr clip = circles_in(320, 400);
    const auto costly = found(Kind::costly_node, findings_in(clip));
    ASSERT_TRUE(costly);
    const mobb::Tree tree(clip, {});
    EXPECT_EQ(tree.node(costly->node).first, 320);
    EXPECT_EQ(tree.node(costly->node).count, 80);
    EXPECT_FALSE(costly->mend);
    EXPECT_FALSE(found(Kind::costly_node, findings_in(circles_in(0, kCount))));
}

TEST(FitFindings, AJumpSpoilsItsAncestors) {
    const auto with_sample_at = [](double y) {
        return motion([y](int i) {
            mobb::Disk at = walking(i);
            if (i == 300) at.y += y;
            return at;
        });
    };
    const auto jump = found(Kind::jump, findings_in(with_sample_at(2)));
    ASSERT_TRUE(jump);
    EXPECT_EQ(jump->sample, 300);
    EXPECT_TRUE(jump->text.starts_with("Sample 300 at 10 s jumps 2 m (")) << jump->text;
    EXPECT_FALSE(jump->mend);
    // A stumble is none.
    EXPECT_FALSE(found(Kind::jump, findings_in(with_sample_at(0.1))));
    // Nor is a run after a walk.
    EXPECT_FALSE(found(Kind::jump, findings_in(motion([](int i) {
                           return mobb::Disk{i < 600 ? i / 30.0 : 20 + 8 * (i - 600) / 30.0, 0, 0.4};
                       }))));
    // The step alone, from where it goes on.
    const auto stays = found(Kind::jump, findings_in(motion([](int i) {
                                 mobb::Disk at = walking(i);
                                 if (i >= 330) at.y += 3;
                                 return at;
                             })));
    ASSERT_TRUE(stays);
    EXPECT_EQ(stays->sample, 330);
}

TEST(FitFindings, ARadiusSpikeSpoilsItsAncestors) {
    const auto wide_at = [](int count) {
        return motion([count](int i) {
            mobb::Disk at = walking(i);
            if (i >= 300 && i < 300 + count) at.r = 1.5;
            return at;
        });
    };
    const auto spike = found(Kind::radius_spike, findings_in(wide_at(1)));
    ASSERT_TRUE(spike);
    EXPECT_EQ(spike->sample, 300);
    EXPECT_TRUE(spike->text.starts_with("Sample 300 at 10 s has a radius of 1.5 m where 0.4 is usual: without it "))
        << spike->text;
    // Who spreads the arms for a second has no spike.
    EXPECT_FALSE(found(Kind::radius_spike, findings_in(wide_at(30))));
}

TEST(FitFindings, TheMostCostlyComesFirst) {
    const auto walking_with_a_jump = [](int i) {
        mobb::Disk at = walking(i);
        if (i == 300) at.y += 2;
        return at;
    };
    const std::vector<FitFinding> all = findings_in(motion(walking_with_a_jump), {.tree = mobb::TreeKind::umobb});
    EXPECT_TRUE(found(Kind::loose_levels, all));
    EXPECT_TRUE(found(Kind::jump, all));
    EXPECT_TRUE(std::ranges::is_sorted(all, std::ranges::greater(), &FitFinding::cost));
}

/// The boxes around it are spoiled.
mobb::Disk walking_with_a_far_jump(int i) {
    mobb::Disk at = walking(i);
    if (i == 300) at.y += 40;
    return at;
}

TEST(FitFindings, OfBlocksHaveNoPrice) {
    const auto jump = found(Kind::jump, findings_in(motion(walking_with_a_far_jump), {.tree = mobb::TreeKind::blocks}));
    ASSERT_TRUE(jump);
    EXPECT_EQ(jump->cost, 0);
}

TEST(FitFindings, EndWhereProgressThrows) {
    const mobb::Tree tree(motion(walking), {});
    const auto cancel = [](std::size_t, std::size_t) { throw std::runtime_error("cancelled"); };
    EXPECT_THROW(fit_findings(tree, {}, cancel), std::runtime_error);
}

TEST(FitFindings, OfBlocksAreOfTheClipAlone) {
    EXPECT_TRUE(findings_in(motion(who_stands), {.tree = mobb::TreeKind::blocks}).empty());
}

}  // namespace
}  // namespace mobbscope
