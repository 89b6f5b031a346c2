// Sweeps of fits: against all fits counted one by one, and what they say of themselves.
#include <explain/fit_sweep.h>
#include <explain/time_scale_curves.h>
#include <support/folders.h>

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "mobb/random_motion.h"

namespace mobbscope {
namespace {

using mobb::TreeKind;
using mobb::test::Random;

/// A walk that turns and stands, in other proportions for every seed.
mobb::ClipPtr made_up_walk(std::uint64_t seed, int count) {
    Random random(seed);
    const double turning = random.real(0.02, 0.3), radius = random.real(0.25, 0.5);
    double speed = random.real(0.3, 1.5), x = 0, y = 0, heading = 0;
    std::vector<mobb::Disk> samples;
    for (int i = 0; i < count; ++i) {
        if (random.chance(0.02)) speed = random.chance(0.4) ? 0 : random.real(0.3, 2);
        heading += random.real(-turning, turning);
        x += speed / 30 * std::cos(heading);
        y += speed / 30 * std::sin(heading);
        samples.push_back({x, y, radius});
    }
    return std::make_shared<const mobb::Clip>(1.0 / 30, std::move(samples));
}

std::vector<mobb::ClipPtr> walks(int count, int samples) {
    std::vector<mobb::ClipPtr> out;
    for (int i = 0; i < count; ++i) out.push_back(made_up_walk(static_cast<std::uint64_t>(i) + 1, samples * (i + 1)));
    return out;
}

SweepOrder sweep_over(const std::vector<std::string>& texts, const mobb::FitOptions& present = {}) {
    SweepOrder order{.present = present};
    for (const std::string& text : texts) set_over(order, text);
    return order;
}

std::vector<double> costs_of(const std::vector<mobb::ClipPtr>& clips, const QueryWorkload& workload,
                             const mobb::FitOptions& fit) {
    std::vector<std::shared_ptr<const mobb::Tree>> trees;
    for (const mobb::ClipPtr& clip : clips) trees.push_back(std::make_shared<const mobb::Tree>(clip, fit));
    std::vector<double> out;
    for (const mobb::TestCounts& tests : count_tests(workload, trees))
        out.push_back(cost_of(tests, prices_of(fit.tree)));
    return out;
}

double mean_cost(const std::vector<mobb::ClipPtr>& clips, const QueryWorkload& workload, const mobb::FitOptions& fit) {
    return spread_of(costs_of(clips, workload, fit)).mean;
}

/// By how much, as a share, the recommended fit costs more than the best of all kinds and leaves, on other placements.
double regret(const std::vector<mobb::ClipPtr>& clips, const std::vector<TreeKind>& kinds, int most_leaf) {
    SweepOrder order = sweep_over({"leaf=1:" + std::to_string(most_leaf)});
    order.trees = kinds;
    const SweepResult result = sweep_fits(clips, standard_workload(clips, order.most_queries, 1), order);
    const QueryWorkload others = standard_workload(clips, 4000, 2);
    double best = std::numeric_limits<double>::infinity();
    for (const TreeKind kind : kinds) {
        // Nodes of a level have half as many samples as those above, so leaves closer than this seldom make other
        // trees.
        for (int leaf = 1; leaf <= most_leaf; leaf += 1 + 2 * leaf / 5) {
            best = std::min(best, mean_cost(clips, others, {.tree = kind, .leaf = leaf}));
            if (!mobb::info(kind).splits()) break;
        }
    }
    return mean_cost(clips, others, result.rows[result.recommended].fit) / best - 1;
}

const std::vector<TreeKind> kOwnTests{TreeKind::mobb, TreeKind::umobb, TreeKind::moving, TreeKind::aabb};

TEST(FitSweep, RecommendsTheBestOfMadeUpWalks) {
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
        EXPECT_LT(regret({made_up_walk(seed, 120 * static_cast<int>(seed))}, kOwnTests, 100), 0.03) << "walk " << seed;
    }
    EXPECT_LT(regret(walks(3, 120), {mobb::kTreeKinds.begin(), mobb::kTreeKinds.end()}, 60), 0.03);
}

TEST(FitSweep, RecommendsTheBestOfRecordings) {
    const std::string folder = kSharedData / "bvh/";
    if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no recordings in " << folder;
    std::vector<mobb::ClipPtr> short_ones;
    for (const char* file :
         {"short/cmu_09_01_run_120hz", "short/cmu_06_08_sideways-dribble_30hz", "long/cmu_02_10_wash-self_30hz"}) {
        const mobb::ClipPtr clip = load_scene(folder + file + ".bvh").clips.front().clip;
        EXPECT_LT(regret({clip}, kOwnTests, 200), 0.03) << file;
        if (clip->duration() < 10) short_ones.push_back(clip);
    }
    EXPECT_LT(regret(short_ones, kOwnTests, 200), 0.03);
}

TEST(FitSweep, OptionsThatDoNotMatterAreNotVaried) {
    const std::vector<mobb::ClipPtr> clips{made_up_walk(1, 200)};
    const SweepOrder order = sweep_over({"tree=mobb,umobb,aabb,blocks", "leaf=5,20", "axes=all", "time_scale=0.5,2"});
    const SweepResult result = sweep_fits(clips, standard_workload(clips, 200, 1), order);
    const auto rows_of = [&](TreeKind kind) {
        return std::ranges::count_if(result.rows, [&](const SweepRow& row) { return row.fit.tree == kind; });
    };
    EXPECT_EQ(rows_of(TreeKind::mobb), 2 * 3 + 1) << "and the present one";
    EXPECT_EQ(rows_of(TreeKind::umobb), 2 * 3 * 2);
    EXPECT_EQ(rows_of(TreeKind::aabb), 2);
    EXPECT_EQ(rows_of(TreeKind::blocks), 1);
    EXPECT_EQ(result.rows[result.present].fit, order.present);
}

/// Leaves of a row's kind, in order.
std::vector<std::pair<int, double>> leaves_of(const SweepResult& result, TreeKind kind) {
    std::vector<std::pair<int, double>> out;
    for (const SweepRow& row : result.rows) {
        if (row.fit.tree == kind) out.emplace_back(row.fit.leaf, row.cost.mean);
    }
    return out;
}

TEST(FitSweep, ARangeIsRefinedAroundTheBest) {
    const std::vector<mobb::ClipPtr> clips = walks(5, 170);
    std::vector<std::size_t> passes;
    const SweepResult result = sweep_fits(clips, standard_workload(clips, 2000, 1), sweep_over({"leaf=1:200"}), {},
                                          [&](const auto& rows) { passes.push_back(rows->rows.size()); });
    const auto leaves = leaves_of(result, TreeKind::mobb);
    EXPECT_EQ(leaves.front().first, 1);
    EXPECT_EQ(leaves.back().first, 200);
    EXPECT_LT(leaves.size(), 30u) << "not all of 200";
    const auto best = std::ranges::min_element(leaves, {}, [](const auto& leaf) { return leaf.second; });
    ASSERT_NE(best, leaves.begin());
    ASSERT_NE(best + 1, leaves.end());
    for (const auto& next : {best - 1, best + 1}) {
        EXPECT_TRUE(std::abs(next->first - best->first) == 1 || next->second <= 1.01 * best->second)
            << best->first << " and " << next->first;
    }
    ASSERT_FALSE(passes.empty());
    EXPECT_TRUE(std::ranges::is_sorted(passes)) << "rows come, none goes";
    EXPECT_EQ(passes.back(), result.rows.size());
    EXPECT_LE(passes.front(), 13u) << "12 of the range, and the present one";
}

TEST(FitSweep, ASearchStaysInItsRange) {
    const std::vector<mobb::ClipPtr> clips{made_up_walk(7, 600)};
    const QueryWorkload workload = standard_workload(clips, 1000, 1);
    // A present fit outside, on either side, and ranges too narrow for three digits.
    for (const mobb::FitOptions& present :
         {mobb::FitOptions{.tree = TreeKind::umobb, .leaf = 10}, mobb::FitOptions{.tree = TreeKind::umobb, .leaf = 300},
          mobb::FitOptions{.tree = TreeKind::umobb, .leaf = 50, .time_scale = 100}}) {
        for (const auto& [text, from, to] :
             {std::tuple("time_scale=5:30", 5.0, 30.0), std::tuple("time_scale=0.12345:0.12345", 0.12345, 0.12345),
              std::tuple("time_scale=0.12345:0.12348", 0.12345, 0.12348)}) {
            const SweepResult result = sweep_fits(clips, workload, sweep_over({"leaf=20:200", text}, present));
            EXPECT_EQ(result.rows[result.present].fit, present);
            EXPECT_GT(result.rows.size(), 3u);
            for (std::size_t i = 0; i < result.rows.size(); ++i) {
                const mobb::FitOptions& fit = result.rows[i].fit;
                EXPECT_TRUE(i == result.present || (fit.leaf >= 20 && fit.leaf <= 200)) << text << ' ' << fit.leaf;
                EXPECT_TRUE(i == result.present || (fit.time_scale >= from && fit.time_scale <= to))
                    << text << ' ' << fit.time_scale;
            }
        }
    }
}

TEST(FitSweep, EveryPassHasThePresentFit) {
    const std::vector<mobb::ClipPtr> clips = walks(4, 800);
    const mobb::FitOptions present{.tree = TreeKind::umobb, .leaf = 150};
    for (const SweepCost cost : {SweepCost::price, SweepCost::time}) {
        SweepOrder order = sweep_over({"tree=all", "leaf=1:40"}, present);
        order.cost = cost;
        order.most_queries = 500;
        std::size_t passes = 0;
        sweep_fits(clips, standard_workload(clips, 500, 1), order, {}, [&](const auto& result) {
            ++passes;
            EXPECT_EQ(result->rows.at(result->present).fit, present);
        });
        EXPECT_GT(passes, 0u);
    }
}

TEST(FitSweep, ASearchEndsWhereThereAreTooManyFits) {
    const std::vector<mobb::ClipPtr> clips = walks(4, 130);
    SweepOrder order = sweep_over({"leaf=1:200"}, {.tree = TreeKind::umobb});
    for (int i = 0; i < 415; ++i) order.time_scale.values.push_back(1 + 0.0001 * i);  // 12 leaves each: 4980 fits
    EXPECT_EQ(sweep_fits(clips, standard_workload(clips, 400, 1), order).rows.size(), 5000u);
}

TEST(FitSweep, LevelsAreThoseOfThePresentFit) {
    const std::vector<mobb::ClipPtr> clips{made_up_walk(1, 300)};
    const mobb::FitOptions present{.leaf = 10, .levels = 3};
    const SweepResult result =
        sweep_fits(clips, standard_workload(clips, 200, 1), sweep_over({"leaf=5,20", "tree=mobb,umobb"}, present));
    EXPECT_EQ(result.rows[result.present].fit, present);
    for (const SweepRow& row : result.rows) EXPECT_EQ(row.fit.levels, 3);
    EXPECT_NE(result.why.find(", levels 3"), std::string::npos) << result.why;
    EXPECT_EQ(sweep_words({.tree = TreeKind::blocks, .levels = 3}, {}).find("levels"), std::string::npos);
}

TEST(FitSweep, OneQueryIsNotCertain) {
    const std::vector<mobb::ClipPtr> clips{made_up_walk(1, 300)};
    SweepOrder order = sweep_over({"leaf=1,10"}, {.leaf = 300});
    order.most_queries = 1;
    SweepResult result;
    // Of some a query ends at the roots, and all fits cost the same.
    for (std::uint64_t seed = 1; seed < 50 && result.recommended == result.present; ++seed)
        result = sweep_fits(clips, standard_workload(clips, 1, seed), order);
    EXPECT_EQ(result.queries, 1u);
    for (const SweepRow& row : result.rows) {
        EXPECT_TRUE(std::isnan(row.cost.standard_error));
        EXPECT_TRUE(std::isnan(row.difference_error));
    }
    ASSERT_NE(result.recommended, result.present);
    EXPECT_NE(result.why.find(" % (of one query) less than MOBB, leaf 300 (now), over 1 placement"), std::string::npos)
        << result.why;
}

TEST(FitSweep, AClipInFewQueriesIsNoException) {
    // As AClipThatAnotherFitServesBetterIsNamed, but the scene asks the long walk just once, and one clip never.
    std::vector<mobb::ClipPtr> clips;
    for (int i = 0; i < 3; ++i) {
        clips.push_back(std::make_shared<const mobb::Clip>(1.0 / 30, std::vector<mobb::Disk>(40, {0, 0, 0.3})));
    }
    clips.push_back(made_up_walk(5, 3000));
    QueryWorkload workload = standard_workload(clips, 200, 1);
    const auto takes_part = [](const ClipQuery& query, int clip) {
        return query.clip_a == clip || query.clip_b == clip;
    };
    std::erase_if(workload.queries,
                  [&](const ClipQuery& query) { return takes_part(query, 2) || takes_part(query, 3); });
    workload.queries.push_back({0, 3, {}, {}});
    workload.kind = QueryWorkload::Kind::queries;
    const SweepResult result = sweep_fits(clips, workload, sweep_over({"leaf=1,4,10,40"}));
    for (const SweepRow& row : result.rows) {
        EXPECT_EQ(row.clips[2].queries, 0u);
        EXPECT_EQ(row.clips[3].queries, 1u);
        EXPECT_TRUE(std::isnan(row.clips[3].cost.standard_error));
    }
    for (const SweepException& exception : result.exceptions) EXPECT_LT(exception.clip, 2);
}

TEST(FitSweep, TwoRangesAreBothSearched) {
    const std::vector<mobb::ClipPtr> clips{made_up_walk(7, 600)};
    const QueryWorkload workload = standard_workload(clips, 2000, 1);
    const SweepResult result =
        sweep_fits(clips, workload, sweep_over({"leaf=1:200", "time_scale=0.1:30"}, {.tree = TreeKind::umobb}));
    const SweepRow& best = result.rows[result.recommended];
    for (const double scale : {0.1, 0.3, 0.5, 1.0, 2.0, 4.0, 10.0, 30.0}) {
        for (const int leaf : {5, 10, 20, 40, 80, 160}) {
            const mobb::FitOptions fit{.tree = TreeKind::umobb, .leaf = leaf, .time_scale = scale};
            EXPECT_LT(best.cost.mean, 1.03 * mean_cost(clips, workload, fit)) << leaf << ' ' << scale;
        }
    }
}

TEST(FitSweep, FiguresAreThoseOfTheQueries) {
    const std::vector<mobb::ClipPtr> clips = walks(2, 150);
    const QueryWorkload workload = standard_workload(clips, 1000, 3);
    const SweepResult result = sweep_fits(clips, workload, sweep_over({"tree=mobb,moving,blocks", "leaf=4,16,64"}));
    EXPECT_EQ(result.queries, 1000u);
    const std::vector<double> chosen = costs_of(clips, workload, result.rows[result.recommended].fit);
    for (const SweepRow& row : result.rows) {
        const std::vector<double> costs = costs_of(clips, workload, row.fit);
        std::vector<double> differences, of_first;
        for (std::size_t i = 0; i < costs.size(); ++i) {
            differences.push_back(costs[i] - chosen[i]);
            if (workload.queries[i].clip_a == 0 || workload.queries[i].clip_b == 0) of_first.push_back(costs[i]);
        }
        const Spread cost = spread_of(costs), apart = spread_of(differences);
        EXPECT_DOUBLE_EQ(row.cost.mean, cost.mean);
        EXPECT_DOUBLE_EQ(row.cost.standard_error, cost.standard_error);
        EXPECT_EQ(row.cost.p99, cost.p99);
        EXPECT_EQ(row.cost.max, cost.max);
        EXPECT_NEAR(row.difference, apart.mean, 1e-9);
        EXPECT_NEAR(row.difference_error, apart.standard_error, 1e-9);
        EXPECT_NEAR(cost_of(row.tests, prices_of(row.fit.tree)), cost.mean, 1e-9);
        ASSERT_EQ(row.clips.size(), 2u);
        EXPECT_EQ(row.clips[0].queries, of_first.size());
        EXPECT_DOUBLE_EQ(row.clips[0].cost.mean, spread_of(of_first).mean);
        EXPECT_NEAR(cost_of(row.clips[0].tests, prices_of(row.fit.tree)), row.clips[0].cost.mean, 1e-9);
    }
}

void expect_same(const SweepResult& a, const SweepResult& b) {
    ASSERT_EQ(a.rows.size(), b.rows.size());
    for (std::size_t i = 0; i < a.rows.size(); ++i) {
        EXPECT_EQ(a.rows[i].fit, b.rows[i].fit);
        EXPECT_EQ(a.rows[i].cost.mean, b.rows[i].cost.mean);
        EXPECT_EQ(a.rows[i].difference_error, b.rows[i].difference_error);
    }
    EXPECT_EQ(a.why, b.why);
    EXPECT_EQ(a.queries, b.queries);
}

TEST(FitSweep, DependsOnNothingButItsOrder) {
    const std::vector<mobb::ClipPtr> clips = walks(3, 100);
    const QueryWorkload workload = standard_workload(clips, 4000, 5);
    const SweepOrder order = sweep_over({"tree=all", "leaf=1:50"});
    const SweepResult result = sweep_fits(clips, workload, order);
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    expect_same(result, sweep_fits(clips, workload, order));
}

TEST(FitSweep, MoreIsAskedUntilFitsAreToldApart) {
    const std::vector<mobb::ClipPtr> clips{made_up_walk(2, 400)};
    const QueryWorkload workload = standard_workload(clips, 16'000, 1);
    SweepOrder order = sweep_over({"leaf=1,200"});
    order.most_queries = 16'000;
    EXPECT_LT(sweep_fits(clips, workload, order).queries, 16'000u) << "far apart";
    // Two fits between 1 % and what few queries tell.
    order = sweep_over({"leaf=1:200", "tree=mobb,hybrid1,aabb"});
    order.most_queries = 16'000;
    const SweepResult close = sweep_fits(clips, workload, order);
    const SweepRow& best = close.rows[close.recommended];
    for (const SweepRow& row : close.rows) {
        EXPECT_TRUE(close.queries == 16'000 || row.difference < 0.02 * best.cost.mean ||
                    row.difference >= 3 * row.difference_error);
    }
    order.most_queries = 500;
    EXPECT_EQ(sweep_fits(clips, workload, order).queries, 500u);
}

TEST(FitSweep, ThePresentFitStaysWhereNoneIsBetter) {
    const std::vector<mobb::ClipPtr> clips{made_up_walk(3, 300)};
    const QueryWorkload workload = standard_workload(clips, 2000, 1);
    const SweepResult first = sweep_fits(clips, workload, sweep_over({"leaf=1:200"}));
    const SweepRow& best = first.rows[first.recommended];
    EXPECT_NE(first.recommended, first.present);
    EXPECT_NE(first.why.find(" less than MOBB, leaf 10 (now), over "), std::string::npos) << first.why;
    const SweepResult again = sweep_fits(clips, workload, sweep_over({"leaf=1:200"}, best.fit));
    EXPECT_EQ(again.recommended, again.present);
    EXPECT_NE(again.why.find(", as now: no other fit costs "), std::string::npos) << again.why;
    EXPECT_EQ(again.why.find("% less than"), std::string::npos) << again.why;
}

TEST(FitSweep, OfAScenesQueriesAllAreAsked) {
    const Scene scene = load_scene(kCrossing);
    std::vector<mobb::ClipPtr> clips;
    for (const SceneClip& clip : scene.clips) clips.push_back(clip.clip);
    const QueryWorkload workload = scene_workload(scene);
    ASSERT_FALSE(workload.queries.empty());
    const SweepResult result = sweep_fits(clips, workload, sweep_over({"leaf=1:200"}));
    EXPECT_EQ(result.queries, workload.queries.size());
    EXPECT_NE(result.why.find("over " + std::to_string(result.queries) + " quer"), std::string::npos) << result.why;
}

TEST(FitSweep, OfACrowdsPairsEvenlyManyAreTaken) {
    Scene scene;
    scene.clips.emplace_back();
    scene.clips.back().clip = made_up_walk(1, 20);
    for (int i = 0; i < 300; ++i) {
        Agent agent;
        agent.placement.start = i;
        scene.agents.push_back(agent);
    }
    EXPECT_EQ(scene_workload(scene).queries.size(), 16'000u);
    const QueryWorkload some = scene_workload(scene, 1000);
    ASSERT_EQ(some.queries.size(), 1000u);
    for (std::size_t i = 0; i < some.queries.size(); ++i) {
        const SceneQuery query = query_at(scene, i * query_count(scene) / 1000);
        EXPECT_EQ(some.queries[i].place_a, query.a.placement);
        EXPECT_EQ(some.queries[i].place_b, query.b.placement);
    }
}

TEST(FitSweep, AClipThatAnotherFitServesBetterIsNamed) {
    // Nothing is like a crowd of short standing people and one long walk.
    std::vector<mobb::ClipPtr> clips;
    for (int i = 0; i < 6; ++i) {
        clips.push_back(std::make_shared<const mobb::Clip>(1.0 / 30, std::vector<mobb::Disk>(40, {0, 0, 0.3})));
    }
    clips.push_back(made_up_walk(5, 3000));
    const SweepResult result = sweep_fits(clips, standard_workload(clips, 4000, 1), sweep_over({"leaf=1,4,10,40"}));
    for (const SweepException& exception : result.exceptions) {
        const auto clip = static_cast<std::size_t>(exception.clip);
        const double chosen = result.rows[result.recommended].clips[clip].cost.mean;
        EXPECT_GT(exception.saving, 0.05);
        EXPECT_NEAR(exception.saving, 1 - result.rows[exception.row].clips[clip].cost.mean / chosen, 1e-12);
    }
    EXPECT_FALSE(result.exceptions.empty());
}

TEST(FitSweep, ItEndsWhenProgressThrows) {
    const std::vector<mobb::ClipPtr> clips{made_up_walk(1, 200)};
    const QueryWorkload workload = standard_workload(clips, 2000, 1);
    std::size_t told = 0;
    const auto stop = [&told](std::size_t done, std::size_t all) {
        EXPECT_LE(done, all);
        if (++told == 5) throw std::runtime_error("enough");
    };
    EXPECT_THROW(sweep_fits(clips, workload, sweep_over({"leaf=1:200"}), stop), std::runtime_error);
}

TEST(FitSweep, TimeIsMeasured) {
    const std::vector<mobb::ClipPtr> clips{made_up_walk(1, 200)};
    SweepOrder order = sweep_over({"leaf=1,10,50"});
    order.cost = SweepCost::time;
    const SweepResult result = sweep_fits(clips, standard_workload(clips, 1000, 1), order);
    ASSERT_EQ(result.rows.size(), 3u);
    for (const SweepRow& row : result.rows) {
        EXPECT_GT(row.cost.mean, 0);
        EXPECT_GT(row.tests.boxes(), 0);
    }
}

TEST(FitSweep, TimeOfMoreQueriesIsMeasuredInTheSameStretches) {
    const std::vector<mobb::ClipPtr> clips{made_up_walk(2, 400)};
    std::size_t asked_more = 0;
    // Counts that do not divide into stretches of 64. Close fits make it ask more, then new ones are measured at once.
    for (const std::size_t count : {65u, 300u, 4097u, 5003u, 9001u}) {
        SweepOrder order = sweep_over({"leaf=1:100", "tree=mobb,moving,aabb,hybrid1", "axes=all"});
        order.cost = SweepCost::time;
        order.most_queries = count;
        const SweepResult result = sweep_fits(clips, standard_workload(clips, count, 1), order);
        EXPECT_TRUE(result.queries == count || (result.queries >= 4096 && result.queries < count)) << result.queries;
        if (result.queries > 4200) ++asked_more;
        for (const SweepRow& row : result.rows) {
            EXPECT_TRUE(std::isfinite(row.cost.mean) && std::isfinite(row.difference));
            EXPECT_EQ(std::isnan(row.difference_error), count == 65) << "a single stretch";
        }
    }
    // How close measured fits are is up to the machine.
    if (asked_more == 0) GTEST_SKIP() << "no fits were so close that more queries were asked";
}

TEST(FitSweep, WhatIsNoOrderIsRefused) {
    for (const char* text : {"leaf=0",
                             "leaf=1.5",
                             "leaf=nan",
                             "leaf=",
                             "leaf",
                             "leaf=200:1",
                             "leaf=1:",
                             "leaf=1:2:3",
                             "leaf=1,,2",
                             "leaf=1:1000000000",
                             "tree=oak",
                             "tree=",
                             "axes=x",
                             "time_scale=0",
                             "time_scale=-1:1",
                             "time_scale=1:inf",
                             "levels=1:3",
                             "",
                             "=",
                             "tree=mobb,,umobb"}) {
        SweepOrder order;
        EXPECT_THROW(set_over(order, text), std::invalid_argument) << text;
    }
    SweepOrder order;
    EXPECT_NO_THROW(set_over(order, " leaf = 5 , 10 "));
    EXPECT_EQ(order.leaf.values, (std::vector<double>{5, 10}));
    EXPECT_THROW(set_over(order, "leaf=20"), std::invalid_argument) << "twice";
    EXPECT_EQ(order.leaf.values, (std::vector<double>{5, 10}));
    try {
        SweepOrder other;
        set_over(other, "leaf=2000000");
        FAIL();
    } catch (const std::invalid_argument& error) {
        EXPECT_STREQ(error.what(), "leaf cannot be '2000000': give whole numbers from 1 to 1000000");
    }
    const std::vector<mobb::ClipPtr> clips{made_up_walk(1, 20)};
    for (int i = 1; i < 6000; ++i) order.leaf.values.push_back(i);
    EXPECT_THROW(sweep_fits(clips, standard_workload(clips, 10, 1), order), std::invalid_argument);
    const std::vector<mobb::ClipPtr> far{
        std::make_shared<const mobb::Clip>(1.0, std::vector<mobb::Disk>{{9e8, 9e8, 1}, {9e8, 9e8, 1}})};
    EXPECT_THROW(sweep_fits(far, standard_workload(far, 100, 1), sweep_over({"leaf=1,2"})), std::invalid_argument);
}

TEST(TimeScaleCurves, AreOfTheTrees) {
    const std::vector<mobb::ClipPtr> clips{made_up_walk(4, 300)};
    const std::vector<double> scales{0.5, 4};
    const auto curves = time_scale_curves(clips, {.leaf = 20}, scales);
    ASSERT_EQ(curves.size(), 4u);
    EXPECT_EQ(curves[0].fit.tree, TreeKind::mobb);
    EXPECT_EQ(curves[1].fit.tree, TreeKind::moving);
    EXPECT_EQ(curves[3].fit.tree, TreeKind::umobb);
    EXPECT_EQ(curves[3].fit.time_scale, 4);
    EXPECT_NE(curves[2].levels.back().volume, curves[3].levels.back().volume);
    // Boxes upright in time shrink from level to level.
    for (std::size_t i = 1; i < curves[0].levels.size(); ++i) {
        EXPECT_LT(curves[0].levels[i].volume, curves[0].levels[i - 1].volume);
        EXPECT_GT(curves[0].levels[i].cost, 0);
    }
}

}  // namespace
}  // namespace mobbscope
