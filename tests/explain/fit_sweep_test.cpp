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
#include <functional>
#include <limits>
#include <memory>
#include <set>
#include <span>
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

/// Of what is counted: nothing is measured.
SweepResult counted_sweep(const std::vector<mobb::ClipPtr>& clips, const QueryWorkload& workload,
                          const SweepOrder& order) {
    return sweep_fits(clips, workload, order, {}, {}, FitTimer());
}

/// The prices, written once more, as documents have them.
double priced(const mobb::TestCounts& tests) {
    using mobb::TestKind;
    const auto count = [&](TestKind kind) { return static_cast<double>(tests[kind]); };
    return 3 * count(TestKind::time) + 14 * count(mobb::BoxKind::obb2d) + 37 * count(mobb::BoxKind::obb3d) +
           26 * count(mobb::BoxKind::moving) + 15 * count(mobb::BoxKind::aabb) + 1.4 * count(TestKind::samples);
}

std::vector<double> costs_of(const std::vector<mobb::ClipPtr>& clips, const QueryWorkload& workload,
                             const mobb::FitOptions& fit) {
    FitTrees trees;
    for (const mobb::ClipPtr& clip : clips) trees.push_back(std::make_shared<const mobb::Tree>(clip, fit));
    std::vector<double> out;
    for (const mobb::TestCounts& tests : count_tests(workload, trees)) out.push_back(priced(tests));
    return out;
}

double mean_cost(const std::vector<mobb::ClipPtr>& clips, const QueryWorkload& workload, const mobb::FitOptions& fit) {
    return spread_of(costs_of(clips, workload, fit)).mean;
}

double estimate_of(const SweepRow& row) {
    return row.estimate ? row.estimate->cost.mean : std::numeric_limits<double>::infinity();
}

const SweepRow& least_estimated(const SweepResult& result) {
    return *std::ranges::min_element(result.rows, {}, estimate_of);
}

/// By how much, as a share, the fit of the least estimate costs more than the best of all kinds and leaves, on other
/// placements.
double regret(const std::vector<mobb::ClipPtr>& clips, const std::vector<TreeKind>& kinds, int most_leaf) {
    SweepOrder order = sweep_over({"leaf=1:" + std::to_string(most_leaf)});
    order.trees = kinds;
    const SweepResult result = counted_sweep(clips, standard_workload(clips, order.most_queries, 1), order);
    const QueryWorkload others = standard_workload(clips, 4000, 2);
    double best = std::numeric_limits<double>::infinity();
    for (const TreeKind kind : kinds) {
        // Nodes of a level have half as many samples as those above, so leaves closer than this seldom make other
        // trees.
        for (int leaf = 1; leaf <= most_leaf; leaf += 1 + 2 * leaf / 5)
            best = std::min(best, mean_cost(clips, others, {.tree = kind, .leaf = leaf}));
    }
    return mean_cost(clips, others, least_estimated(result).fit) / best - 1;
}

/// A machine on which a query of a fit takes so long, ns, with noise: a stretch more or less by a third, some by
/// twenty times, and now and then all is slower for a while.
struct PlantedMachine {
    std::function<double(Protocol, const mobb::FitOptions&)> ns;
    std::uint64_t seed = 1;

    FitTimer timer() const {
        return [ns = ns, random = Random(seed), speed = 1.0](Protocol protocol, const FitTrees& trees,
                                                             std::span<const ClipQuery> queries,
                                                             std::size_t stretch) mutable {
            if (random.chance(0.05)) speed = random.chance(0.6) ? 1 : random.real(1, 2);
            std::vector<double> out((queries.size() + stretch - 1) / stretch);
            for (double& taken : out) {
                taken = speed * random.real(0.7, 1.3) * ns(protocol, trees.front()->options());
                if (random.chance(0.01)) taken *= 20;
            }
            return out;
        };
    }
};

SweepResult measured_sweep(const std::vector<mobb::ClipPtr>& clips, const SweepOrder& order, const PlantedMachine& on,
                           std::uint64_t seed = 1) {
    return sweep_fits(clips, standard_workload(clips, 2000, seed), order, {}, {}, on.timer());
}

const std::vector<TreeKind> kOwnTests{TreeKind::mobb, TreeKind::umobb, TreeKind::moving, TreeKind::aabb};

TEST(TestPrices, AreThoseOfTheDocument) {
    for (const mobb::TestKind kind : mobb::kTestKinds) {
        mobb::TestCounts tests;
        tests[kind] = 10;
        if (kind == mobb::BoxKind::block) {
            EXPECT_TRUE(std::isnan(cost_of(tests))) << "nobody may price blocks";
        } else {
            EXPECT_DOUBLE_EQ(cost_of(tests), priced(tests)) << kind.index();
            EXPECT_GT(priced(tests), 0);
        }
    }
}

TEST(FitSweep, EstimatesTheBestOfMadeUpWalks) {
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
        EXPECT_LT(regret({made_up_walk(seed, 120 * static_cast<int>(seed))}, kOwnTests, 100), 0.03) << "walk " << seed;
    }
    EXPECT_LT(regret(walks(3, 120), kOwnTests, 60), 0.03);
}

TEST(FitSweep, EstimatesTheBestOfRecordings) {
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
    const SweepResult result = counted_sweep(clips, standard_workload(clips, 200, 1), order);
    const auto rows_of = [&](TreeKind kind) {
        return std::ranges::count_if(result.rows, [&](const SweepRow& row) { return row.fit.tree == kind; });
    };
    EXPECT_EQ(rows_of(TreeKind::mobb), 2 * 3 + 3 + 1) << "with trees of one level, and the present one";
    EXPECT_EQ(rows_of(TreeKind::umobb), 2 * 3 * 2 + 3);
    EXPECT_EQ(rows_of(TreeKind::aabb), 2 + 1);
    EXPECT_EQ(rows_of(TreeKind::blocks), 1);
    EXPECT_EQ(result.rows[result.present].fit, order.present);
}

/// Leaves of a row's kind, in order.
std::vector<std::pair<int, double>> leaves_of(const SweepResult& result, TreeKind kind) {
    std::vector<std::pair<int, double>> out;
    for (const SweepRow& row : result.rows) {
        if (row.fit.tree == kind && row.fit.levels != 1) out.emplace_back(row.fit.leaf, estimate_of(row));
    }
    return out;
}

TEST(FitSweep, ARangeIsRefinedAroundTheBest) {
    const std::vector<mobb::ClipPtr> clips = walks(5, 170);
    std::vector<std::size_t> passes;
    const SweepResult result = sweep_fits(
        clips, standard_workload(clips, 2000, 1), sweep_over({"leaf=1:200"}), {},
        [&](const auto& rows) { passes.push_back(rows->rows.size()); }, FitTimer());
    const auto leaves = leaves_of(result, TreeKind::mobb);
    EXPECT_EQ(leaves.front().first, 1);
    EXPECT_GT(leaves.back().first, 150) << "as 200 does";
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
    EXPECT_LE(passes.front(), 14u) << "12 of the range, one level, and the present one";
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
            SweepOrder order = sweep_over({"leaf=20:200", text}, present);
            order.most_queries = 1000;
            // The fastest lies far outside.
            const PlantedMachine machine{[](Protocol, const mobb::FitOptions& fit) { return 1e6 / fit.leaf; }};
            const SweepResult result = sweep_fits(clips, workload, order, {}, {}, machine.timer());
            EXPECT_EQ(result.rows[result.present].fit, present);
            EXPECT_GT(result.rows.size(), 3u);
            for (std::size_t i = 0; i < result.rows.size(); ++i) {
                const mobb::FitOptions& fit = result.rows[i].fit;
                const bool stands_alone = i == result.present || fit.levels == 1;
                EXPECT_TRUE(stands_alone || (fit.leaf >= 20 && fit.leaf <= 200)) << text << ' ' << fit.leaf;
                EXPECT_TRUE(stands_alone || (fit.time_scale >= from && fit.time_scale <= to))
                    << text << ' ' << fit.time_scale;
            }
        }
    }
}

TEST(FitSweep, EveryPassHasThePresentFit) {
    const std::vector<mobb::ClipPtr> clips = walks(4, 800);
    const mobb::FitOptions present{.tree = TreeKind::umobb, .leaf = 150};
    const PlantedMachine machine{[](Protocol, const mobb::FitOptions& fit) { return 100 + fit.leaf; }};
    std::size_t passes = 0;
    sweep_fits(
        clips, standard_workload(clips, 500, 1), sweep_over({"tree=all", "leaf=1:40"}, present), {},
        [&](const auto& result) {
            ++passes;
            EXPECT_EQ(result->rows.at(result->present).fit, present);
        },
        machine.timer());
    EXPECT_GT(passes, 0u);
}

TEST(FitSweep, ASearchEndsWhereThereAreTooManyFits) {
    const std::vector<mobb::ClipPtr> clips = walks(4, 130);
    SweepOrder order = sweep_over({"leaf=1:200"}, {.tree = TreeKind::umobb});
    for (int i = 0; i < 415; ++i)
        order.time_scale.values.push_back(1 + 0.0001 * i);  // 12 leaves each: 4980 fits, and one level
    EXPECT_EQ(counted_sweep(clips, standard_workload(clips, 400, 1), order).rows.size(), 5000u);
}

TEST(FitSweep, LevelsAreThoseOfThePresentFit) {
    const std::vector<mobb::ClipPtr> clips{made_up_walk(1, 300)};
    const mobb::FitOptions present{.leaf = 10, .levels = 3};
    const SweepResult result =
        counted_sweep(clips, standard_workload(clips, 200, 1), sweep_over({"leaf=5,20", "tree=mobb,umobb"}, present));
    EXPECT_EQ(result.rows[result.present].fit, present);
    for (const SweepRow& row : result.rows) EXPECT_TRUE(row.fit.levels == 3 || row.fit.levels == 1);
    EXPECT_EQ(sweep_words(present, present), "MOBB, leaf 10, levels 3");
    EXPECT_EQ(sweep_words({.levels = 1}, present), "MOBB, 1 level");
    EXPECT_EQ(sweep_words({.tree = TreeKind::blocks, .levels = 3}, {}).find("levels"), std::string::npos);
}

TEST(FitSweep, OnePlacementIsNotCertain) {
    const std::vector<mobb::ClipPtr> clips{made_up_walk(1, 300)};
    const PlantedMachine machine{[](Protocol, const mobb::FitOptions& fit) { return 100.0 * fit.leaf; }};
    const SweepResult result = sweep_fits(clips, standard_workload(clips, 1, 1),
                                          sweep_over({"leaf=1,10"}, {.leaf = 300}), {}, {}, machine.timer());
    EXPECT_EQ(result.queries, 1u);
    for (const SweepRow& row : result.rows) EXPECT_TRUE(std::isnan(row.estimate->cost.standard_error));
    EXPECT_FALSE(result.of(Protocol::warm).recommended) << "others may take other times";
    EXPECT_EQ(result.of(Protocol::warm).undecided.size(), 3u) << "300 samples are one level";
}

TEST(FitSweep, AClipsRowIsOfItsQueries) {
    // The scene asks the long walk just once, and one clip never.
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
    const SweepResult result = counted_sweep(clips, workload, sweep_over({"leaf=1,4,10,40"}));
    for (const SweepRow& row : result.rows) {
        EXPECT_EQ(row.estimate->clips[2].queries, 0u);
        EXPECT_EQ(row.estimate->clips[3].queries, 1u);
        EXPECT_TRUE(std::isnan(row.estimate->clips[3].cost.standard_error));
    }
}

TEST(FitSweep, TwoRangesAreBothSearched) {
    const std::vector<mobb::ClipPtr> clips{made_up_walk(7, 600)};
    const QueryWorkload workload = standard_workload(clips, 2000, 1);
    const SweepResult result =
        counted_sweep(clips, workload, sweep_over({"leaf=1:200", "time_scale=0.1:30"}, {.tree = TreeKind::umobb}));
    const SweepRow& best = least_estimated(result);
    for (const double scale : {0.1, 0.3, 0.5, 1.0, 2.0, 4.0, 10.0, 30.0}) {
        for (const int leaf : {5, 10, 20, 40, 80, 160}) {
            const mobb::FitOptions fit{.tree = TreeKind::umobb, .leaf = leaf, .time_scale = scale};
            EXPECT_LT(estimate_of(best), 1.03 * mean_cost(clips, workload, fit)) << leaf << ' ' << scale;
        }
    }
}

TEST(FitSweep, EstimatesAreThoseOfTheQueries) {
    const std::vector<mobb::ClipPtr> clips = walks(2, 150);
    const QueryWorkload workload = standard_workload(clips, 1000, 3);
    const SweepResult result =
        counted_sweep(clips, workload, sweep_over({"tree=mobb,umobb,moving,aabb,blocks", "leaf=4,16,64"}));
    EXPECT_EQ(result.queries, 1000u);
    for (const SweepRow& row : result.rows) {
        if (row.fit.tree == TreeKind::blocks) {
            EXPECT_FALSE(row.estimate) << "their tests have no price";
            EXPECT_GT(row.bytes, 0u);
            continue;
        }
        const std::vector<double> costs = costs_of(clips, workload, row.fit);
        std::vector<double> of_first;
        for (std::size_t i = 0; i < costs.size(); ++i) {
            if (workload.queries[i].clip_a == 0 || workload.queries[i].clip_b == 0) of_first.push_back(costs[i]);
        }
        const Spread cost = spread_of(costs);
        ASSERT_TRUE(row.estimate);
        EXPECT_NEAR(row.estimate->cost.mean, cost.mean, 1e-9);
        EXPECT_NEAR(row.estimate->cost.standard_error, cost.standard_error, 1e-9);
        EXPECT_NEAR(row.estimate->cost.p99, cost.p99, 1e-9);
        EXPECT_NEAR(row.estimate->cost.max, cost.max, 1e-9);
        EXPECT_NEAR(cost_of(row.estimate->tests), cost.mean, 1e-9);
        ASSERT_EQ(row.estimate->clips.size(), 2u);
        EXPECT_EQ(row.estimate->clips[0].queries, of_first.size());
        EXPECT_NEAR(row.estimate->clips[0].cost.mean, spread_of(of_first).mean, 1e-9);
        EXPECT_NEAR(cost_of(row.estimate->clips[0].tests), row.estimate->clips[0].cost.mean, 1e-9);
    }
}

void expect_same(const SweepResult& a, const SweepResult& b) {
    ASSERT_EQ(a.rows.size(), b.rows.size());
    for (std::size_t i = 0; i < a.rows.size(); ++i) {
        EXPECT_EQ(a.rows[i].fit, b.rows[i].fit);
        EXPECT_EQ(estimate_of(a.rows[i]), estimate_of(b.rows[i]));
    }
    EXPECT_EQ(a.queries, b.queries);
}

TEST(FitSweep, EstimatesDependOnNothingButTheOrder) {
    const std::vector<mobb::ClipPtr> clips = walks(3, 100);
    const QueryWorkload workload = standard_workload(clips, 4000, 5);
    const SweepOrder order = sweep_over({"tree=all", "leaf=1:50"});
    const SweepResult result = counted_sweep(clips, workload, order);
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    expect_same(result, counted_sweep(clips, workload, order));
}

// --- by measured time

TEST(FitSweep, TimeDecidesAndIsNotMixedWithTheEstimate) {
    const std::vector<mobb::ClipPtr> clips{made_up_walk(2, 400)};
    // The more a fit is estimated to cost, the less it takes here.
    const auto ns = [](Protocol protocol, const mobb::FitOptions& fit) {
        const double warm = fit.levels == 1 ? 900 : fit.leaf == 1 ? 50 : 50.0 + 2 * fit.leaf;
        return protocol == Protocol::warm ? warm : 1000 - warm;
    };
    const SweepResult result = measured_sweep(clips, sweep_over({"leaf=1,40,80"}, {.leaf = 80}), {ns});
    const auto fit_of = [&](Protocol protocol) {
        return result.of(protocol).recommended ? result.rows[*result.of(protocol).recommended].fit : mobb::FitOptions{};
    };
    EXPECT_EQ(fit_of(Protocol::warm).leaf, 1);
    EXPECT_EQ(fit_of(Protocol::cold).levels, 1);
    EXPECT_NE(least_estimated(result).fit.leaf, 1) << "by the estimate another one is the best";
    for (const SweepRow& row : result.rows) {
        for (const Protocol protocol : kProtocols) {
            ASSERT_TRUE(row.time(protocol));
            // However fast the machine was.
            const SweepRow& first = result.rows.front();
            const double planted = ns(protocol, row.fit) / ns(protocol, first.fit);
            EXPECT_NEAR(row.time(protocol)->ns / first.time(protocol)->ns, planted, 0.1 * planted)
                << sweep_words(row.fit, {});
            EXPECT_GE(row.time(protocol)->error, 0.01 * row.time(protocol)->ns);
        }
        EXPECT_NEAR(estimate_of(row), mean_cost(clips, standard_workload(clips, 2000, 1), row.fit), 1e-9);
    }
    EXPECT_TRUE(result.of(Protocol::warm).why.starts_with("MOBB, leaf 1: ")) << result.of(Protocol::warm).why;
    EXPECT_NE(result.of(Protocol::warm).why.find(" % less than MOBB, leaf 80 (now), over 2,000 placements"),
              std::string::npos)
        << result.of(Protocol::warm).why;
    EXPECT_TRUE(result.of(Protocol::cold).why.starts_with("MOBB, 1 level: ")) << result.of(Protocol::cold).why;
}

TEST(FitSweep, ThePresentFitStaysWhereItIsTheFastest) {
    const std::vector<mobb::ClipPtr> clips{made_up_walk(3, 300)};
    const PlantedMachine machine{[](Protocol, const mobb::FitOptions& fit) {
        return fit.levels == 1 ? 500 : 100 + 20 * std::abs(fit.leaf - 20);
    }};
    const SweepResult result = measured_sweep(clips, sweep_over({"leaf=5,10,20,40"}, {.leaf = 20}), machine);
    for (const Protocol protocol : kProtocols) {
        EXPECT_EQ(result.of(protocol).recommended, result.present);
        EXPECT_NE(result.of(protocol).why.find("MOBB, leaf 20, as now: "), std::string::npos)
            << result.of(protocol).why;
    }
}

TEST(FitSweep, WhereIntervalsOverlapItIsUndecided) {
    const std::vector<mobb::ClipPtr> clips{made_up_walk(3, 300)};
    const PlantedMachine machine{[](Protocol, const mobb::FitOptions& fit) {
        return fit.levels == 1 ? 500.0 : fit.leaf == 5 || fit.leaf == 40 ? 100.0 : 200.0;
    }};
    const SweepResult result = measured_sweep(clips, sweep_over({"leaf=5,10,20,40"}), machine);
    for (const Protocol protocol : kProtocols) {
        const SweepAdvice& advice = result.of(protocol);
        EXPECT_FALSE(advice.recommended);
        ASSERT_EQ(advice.undecided.size(), 2u) << advice.why;
        for (const std::size_t row : advice.undecided)
            EXPECT_TRUE(result.rows[row].fit.leaf == 5 || result.rows[row].fit.leaf == 40);
        EXPECT_TRUE(advice.why.starts_with("undecided between MOBB, leaf ")) << advice.why;
    }
}

TEST(FitSweep, OneLevelIsAlwaysTriedAndBlocksAreMeasured) {
    const std::vector<mobb::ClipPtr> clips{made_up_walk(4, 3000)};
    const auto best_is = [](auto is_best) {
        return PlantedMachine{[=](Protocol, const mobb::FitOptions& fit) { return is_best(fit) ? 10.0 : 100.0; }};
    };
    const SweepResult single =
        measured_sweep(clips, usual_sweep({}), best_is([](const mobb::FitOptions& fit) { return fit.levels == 1; }));
    EXPECT_EQ(single.rows[single.fastest(Protocol::warm)].fit.levels, 1);
    const SweepResult blocks = measured_sweep(
        clips, usual_sweep({}), best_is([](const mobb::FitOptions& fit) { return fit.tree == TreeKind::blocks; }));
    ASSERT_TRUE(blocks.of(Protocol::cold).recommended);
    EXPECT_EQ(blocks.rows[*blocks.of(Protocol::cold).recommended].fit.tree, TreeKind::blocks);
    std::set<TreeKind> measured;
    for (const SweepRow& row : blocks.rows) {
        if (row.time(Protocol::warm)) measured.insert(row.fit.tree);
    }
    EXPECT_EQ(measured.size(), mobb::kTreeKindCount) << "one of each kind";
}

TEST(FitSweep, TheSearchGoesOnBeyondTheUsualLeaves) {
    const std::vector<mobb::ClipPtr> clips{made_up_walk(4, 5000)};
    const PlantedMachine machine{[](Protocol, const mobb::FitOptions& fit) {
        const double off = std::log2((fit.levels == 1 ? 5000 : fit.leaf) / 620.0);
        return fit.tree == TreeKind::mobb ? 100 * (1 + off * off) : 2000;
    }};
    const SweepResult result = measured_sweep(clips, usual_sweep({}), machine);
    const mobb::FitOptions& fit = result.rows[result.fastest(Protocol::warm)].fit;
    EXPECT_GE(fit.leaf, 310);
    EXPECT_LE(fit.leaf, 1250);
    EXPECT_EQ(result.of(Protocol::warm).why.find("is an end of"), std::string::npos) << result.of(Protocol::warm).why;
}

TEST(FitSweep, ABestAtTheEndOfItsRangeIsSaid) {
    const std::vector<mobb::ClipPtr> clips{made_up_walk(4, 5000)};
    const PlantedMachine machine{
        [](Protocol, const mobb::FitOptions& fit) { return fit.levels == 1 ? 5000 : 10'000.0 / fit.leaf; }};
    for (const char* over : {"leaf=1:40", "leaf=5,10,40"}) {
        const SweepResult result = measured_sweep(clips, sweep_over({over}), machine);
        EXPECT_EQ(result.rows[result.fastest(Protocol::warm)].fit.leaf, 40);
        EXPECT_NE(result.of(Protocol::warm).why.find("leaf 40 is an end of what was tried"), std::string::npos)
            << result.of(Protocol::warm).why;
    }
}

TEST(FitSweep, TheWinnerIsTheSameAmongFewAndManyFitsAndForEverySeed) {
    const std::vector<mobb::ClipPtr> clips = walks(3, 300);
    // Two kinds that are near each other, and leaves that make a difference of some per cent.
    const auto ns = [](Protocol protocol, const mobb::FitOptions& fit) {
        if (fit.tree == TreeKind::blocks) return protocol == Protocol::warm ? 90.0 : 500.0;
        const double off = std::log2((fit.levels == 1 ? 900 : fit.leaf) / (protocol == Protocol::warm ? 45.0 : 90.0));
        return (fit.tree == TreeKind::mobb ? 100 : 130) * (1 + 0.03 * off * off);
    };
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
        const SweepResult many = measured_sweep(clips, usual_sweep({}), {ns, seed}, seed);
        for (const Protocol protocol : kProtocols) {
            const mobb::FitOptions best = many.rows[many.fastest(protocol)].fit;
            const SweepOrder few = sweep_over({"tree=mobb,blocks", "leaf=10," + std::to_string(best.leaf + 0)}, best);
            const SweepResult again = measured_sweep(clips, few, {ns, seed + 10}, seed + 10);
            const SweepAdvice& advice = again.of(protocol);
            const auto is_best = [&](std::size_t row) { return again.rows[row].fit == best; };
            EXPECT_TRUE(advice.recommended ? is_best(*advice.recommended)
                                           : std::ranges::any_of(advice.undecided, is_best))
                << advice.why << ", but among many " << many.of(protocol).why;
        }
    }
}

TEST(FitSweep, OfAScenesQueriesAllAreAsked) {
    const Scene scene = load_scene(kCrossing);
    std::vector<mobb::ClipPtr> clips;
    for (const SceneClip& clip : scene.clips) clips.push_back(clip.clip);
    const QueryWorkload workload = scene_workload(scene);
    ASSERT_FALSE(workload.queries.empty());
    const PlantedMachine machine{
        [](Protocol, const mobb::FitOptions& fit) { return fit.levels == 1 ? 50.0 : 100.0 + fit.leaf; }};
    const SweepResult result = sweep_fits(clips, workload, sweep_over({"leaf=5,20"}), {}, {}, machine.timer());
    EXPECT_EQ(result.queries, workload.queries.size());
    EXPECT_TRUE(result.of(Protocol::warm).recommended) << "these are all that count";
    EXPECT_NE(result.of(Protocol::warm).why.find("over " + std::to_string(result.queries) + " quer"), std::string::npos)
        << result.of(Protocol::warm).why;
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

TEST(FitSweep, ItEndsWhenProgressThrows) {
    const std::vector<mobb::ClipPtr> clips{made_up_walk(1, 200)};
    const QueryWorkload workload = standard_workload(clips, 2000, 1);
    std::size_t told = 0;
    const auto stop = [&told](std::size_t done, std::size_t all) {
        EXPECT_LE(done, all);
        if (++told == 5) throw std::runtime_error("enough");
    };
    EXPECT_THROW(sweep_fits(clips, workload, sweep_over({"leaf=1:200"}), stop), std::runtime_error);
    // While it measures, too.
    std::size_t measured = 0;
    const auto end = [&](std::size_t, std::size_t) {
        if (measured > 20) throw std::runtime_error("enough");
    };
    const PlantedMachine machine{[&](Protocol, const mobb::FitOptions&) { return static_cast<double>(++measured); }};
    EXPECT_THROW(sweep_fits(clips, workload, sweep_over({"leaf=1:200"}), end, {}, machine.timer()), std::runtime_error);
    EXPECT_LT(measured, 10'000u);
}

TEST(FitSweep, TimeIsMeasured) {
    const std::vector<mobb::ClipPtr> clips = walks(2, 100);
    const SweepResult result =
        sweep_fits(clips, standard_workload(clips, 300, 1), sweep_over({"tree=mobb,blocks", "leaf=1,50"}));
    for (const SweepRow& row : result.rows) {
        for (const Protocol protocol : kProtocols) {
            ASSERT_TRUE(row.time(protocol));
            EXPECT_GT(row.time(protocol)->ns, 0);
            EXPECT_GT(row.time(protocol)->error, 0);
        }
    }
    for (const Protocol protocol : kProtocols)
        EXPECT_NE(result.of(protocol).recommended.has_value(), !result.of(protocol).undecided.empty());
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
    EXPECT_THROW(counted_sweep(clips, standard_workload(clips, 10, 1), order), std::invalid_argument);
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
