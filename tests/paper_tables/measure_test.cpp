#include <mobb/level_figures.h>
#include <mobb/query.h>
#include <paper_tables/built_in_clips.h>
#include <paper_tables/measure.h>
#include <paper_tables/methods.h>
#include <paper_tables/test_costs.h>
#include <paper_tables/workload.h>

#include <gtest/gtest.h>

#include <map>
#include <memory>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

namespace mobbscope {
namespace {

Workload some_queries(int count) {
    Workload workload;
    workload.name = "table2";
    workload.clips = walks_in_a_volume(6, 15, 1);
    workload.queries = random_queries(workload.clips, count, {});
    return workload;
}

const TableRow& row(const TableRows& table, const std::string& method) {
    for (const TableRow& each : table.rows) {
        if (each.method == method) return each;
    }
    throw std::runtime_error("no row " + method);
}

TEST(Measure, CountsWhatEachMethodTests) {
    const Workload workload = some_queries(3000);
    const TableRows table = measure(workload, table_methods({}), 1);
    EXPECT_GT(table.positive, 0.1);
    EXPECT_LT(table.positive, 0.9);

    // With one level there is a box test where the roots overlap in time, and samples where their boxes do.
    const TableRow& one_level = row(table, "mobb_1level");
    EXPECT_NEAR(one_level[mobb::BoxKind::obb2d], 1 / 1.2, 0.03);
    EXPECT_DOUBLE_EQ(one_level[mobb::BoxKind::obb2d], one_level.root_box_tests);
    EXPECT_EQ(one_level[mobb::BoxKind::obb3d], 0);
    EXPECT_DOUBLE_EQ(row(table, "umobb_1level")[mobb::BoxKind::obb3d], one_level[mobb::BoxKind::obb2d]);

    // The hierarchy trades sample pairs for box tests: the paper's point.
    const TableRow& tree = row(table, "mobb");
    EXPECT_LT(tree[mobb::TestKind::samples], one_level[mobb::TestKind::samples] / 5);
    EXPECT_GT(tree[mobb::BoxKind::obb2d], one_level[mobb::BoxKind::obb2d]);
    EXPECT_LE(one_level[mobb::TestKind::samples], row(table, "brute")[mobb::TestKind::samples]);
    EXPECT_GT(row(table, "hybrid1")[mobb::BoxKind::obb3d], 0);
    EXPECT_DOUBLE_EQ(row(table, "hybrid2")[mobb::BoxKind::obb3d], one_level[mobb::BoxKind::obb2d]);
    EXPECT_DOUBLE_EQ(tree.root_rejected, one_level.root_rejected);
    for (const TableRow& each : table.rows) {
        EXPECT_LE(each.sample_steps, each[mobb::TestKind::samples]) << each.method;
        EXPECT_GT(each.time_ns, 0) << each.method;
    }
}

TEST(Measure, CountsAreThoseOfTheStatisticsObserver) {
    const Workload workload = some_queries(200);
    const TableRows table = measure(workload, table_methods({}), 1);
    mobb::FitOptions options;
    options.tree = mobb::TreeKind::umobb;
    std::int64_t boxes = 0, pairs = 0;
    for (const WorkloadQuery& query : workload.queries) {
        const mobb::Tree a(workload.clips[static_cast<std::size_t>(query.clip_a)], options);
        const mobb::Tree b(workload.clips[static_cast<std::size_t>(query.clip_b)], options);
        mobb::Statistics counts;
        mobb::query(mobb::PlacedTree(a, query.a), mobb::PlacedTree(b, query.b), counts);
        boxes += counts.tests[mobb::BoxKind::obb3d];
        pairs += counts.tests[mobb::TestKind::samples];
    }
    EXPECT_DOUBLE_EQ(row(table, "umobb")[mobb::BoxKind::obb3d], static_cast<double>(boxes) / 200);
    EXPECT_DOUBLE_EQ(row(table, "umobb")[mobb::TestKind::samples], static_cast<double>(pairs) / 200);
}

TEST(Measure, AnOffsetBetweenSamplesGivesEachTwoPartners) {
    const auto standing = std::make_shared<const mobb::Clip>(1.0, std::vector<mobb::Disk>(10, {0, 0, 0.1}));
    Workload workload{"table2", "", {standing}, {}};
    workload.queries.push_back({0, 0, {}, {{5, 0}, 0, 0.5}});
    const TableRows table = measure(workload, {{"brute", std::nullopt}}, 1);
    EXPECT_EQ(table.rows[0][mobb::TestKind::samples], 19);  // the first of A and the last of B have one partner
    EXPECT_EQ(table.rows[0].sample_steps, 10);
    workload.queries[0].b.start = 0;
    EXPECT_EQ(measure(workload, {{"brute", std::nullopt}}, 1).rows[0][mobb::TestKind::samples], 10);
}

TEST(Measure, SweepsLeavesBesideTheBaselines) {
    const std::vector<TableRow> rows = measure(some_queries(50), sweep_methods({}), 1).rows;
    std::map<std::string, std::set<int>> leaves;
    for (const TableRow& each : rows) leaves[each.method].insert(each.leaf);
    for (const mobb::TreeKind kind : mobb::kTreeKinds) {
        const std::set<int>& of_kind = leaves[std::string(mobb::name(kind))];
        EXPECT_TRUE(of_kind.contains(1) && of_kind.contains(10) && of_kind.contains(50)) << mobb::name(kind);
        EXPECT_EQ(*of_kind.rbegin(), 200) << mobb::name(kind);
    }
    for (const char* beside : {"brute", "mobb_1level", "umobb_1level"}) EXPECT_EQ(leaves[beside].size(), 1u) << beside;
}

TEST(Measure, CountsWhatBecomesOfThePairsOfEachLevel) {
    const TableRows table = measure(some_queries(2000), table_methods({}), 1);
    EXPECT_TRUE(row(table, "brute").pair_levels.empty());
    for (const char* method : {"mobb_1level", "mobb", "umobb", "moving"}) {
        const TableRow& each = row(table, method);
        ASSERT_FALSE(each.pair_levels.empty()) << method;
        EXPECT_EQ(each.pair_levels[0].pairs, 1) << method;
        EXPECT_DOUBLE_EQ(each.pair_levels[0].apart_in_time, 1 - each.root_box_tests) << method;
        EXPECT_DOUBLE_EQ(each.pair_levels[0].apart_in_time + each.pair_levels[0].separated, each.root_rejected);
        EXPECT_DOUBLE_EQ(each.pair_levels[0].ended, each.pair_levels.size() == 1 ? 1 : each.root_rejected) << method;
        double pairs = 0, ended = 0;
        for (const PairLevel& level : each.pair_levels) {
            pairs += level.pairs;
            ended += level.ended;
            EXPECT_LE(level.apart_in_time + level.separated + level.sampled, level.pairs + 1e-12) << method;
        }
        EXPECT_NEAR(pairs, each[mobb::TestKind::time], 1e-9) << method;
        EXPECT_NEAR(ended, 1, 1e-9) << method;
        // Each pair goes one level down on one side at least.
        EXPECT_LE(static_cast<double>(each.pair_levels.size()), 2 * static_cast<double>(each.trees.volumes.size()) - 1);
    }
    EXPECT_EQ(row(table, "mobb_1level").pair_levels.size(), 1u);
}

TEST(Measure, SaysHowLargeTreesAndTheirBoxesAre) {
    const Workload workload = some_queries(20);
    const TableRows table = measure(workload, table_methods({}), 1);
    mobb::FitOptions options;
    options.tree = mobb::TreeKind::umobb;
    double nodes = 0, root_volume = 0, leaf_volume = 0;
    for (const mobb::Tree& tree : trees_of(workload, options)) {
        nodes += static_cast<double>(tree.nodes().size()) / 6;
        root_volume += mobb::level_figures(tree).front().volume;
        leaf_volume += mobb::level_figures(tree).back().volume;
    }
    const TreeFigures& trees = row(table, "umobb").trees;
    EXPECT_DOUBLE_EQ(trees.nodes, nodes);
    EXPECT_GT(trees.bytes, nodes * sizeof(mobb::Node));
    EXPECT_GT(trees.build_ns, 0);
    EXPECT_GE(static_cast<double>(trees.volumes.size()), trees.depth);
    EXPECT_DOUBLE_EQ(trees.volumes.front(), root_volume);
    EXPECT_DOUBLE_EQ(trees.volumes.back(), leaf_volume);
    EXPECT_EQ(row(table, "brute").trees.nodes, 0);
    EXPECT_EQ(row(table, "mobb_1level").trees.nodes, 1);
}

TEST(Measure, VariantsChangeOneThingEach) {
    const TableRows table = measure(some_queries(2000), variant_methods({}), 1);
    // Box tests in place of sample tests where a leaf meets an inner node; the trees are the same.
    for (const std::string kind : {"mobb", "umobb"}) {
        const TableRow& paper = row(table, kind);
        const TableRow& boxes = row(table, kind + "_walk_boxes");
        EXPECT_GT(boxes.box_tests(), paper.box_tests()) << kind;
        EXPECT_LT(boxes[mobb::TestKind::samples], paper[mobb::TestKind::samples]) << kind;
        EXPECT_EQ(boxes.trees.volumes, paper.trees.volumes) << kind;
        EXPECT_LT(row(table, kind + "_minarea").trees.volumes[0], paper.trees.volumes[0]) << kind;
        EXPECT_NE(row(table, kind + "_covariance").trees.volumes[1], paper.trees.volumes[1]) << kind;
    }
    EXPECT_LT(row(table, "umobb_w4").trees.volumes.back(), row(table, "umobb_w0.25").trees.volumes.back());

    // Variants are of what is asked for.
    mobb::FitOptions base;
    base.axes = mobb::Axes::covariance;
    base.time_scale = 0.5;
    std::set<std::string> names;
    for (const Method& method : variant_methods(base)) EXPECT_TRUE(names.insert(method.name).second) << method.name;
    EXPECT_TRUE(names.contains("mobb_endpoints") && names.contains("umobb_w0.125") && names.contains("umobb_w2"));
    EXPECT_FALSE(names.contains("mobb_covariance"));
    base.time_scale = mobb::kMaxTimeScale;
    for (const Method& method : variant_methods(base)) {
        EXPECT_LE(method.options->time_scale, mobb::kMaxTimeScale) << method.name;
    }
}

TEST(Measure, EveryTestHasACost) {
    const TestCosts costs = measure_test_costs(some_queries(50), {});
    ASSERT_TRUE(costs[mobb::BoxKind::obb2d] && costs[mobb::BoxKind::obb3d] && costs.sample_pair);
    EXPECT_GT(*costs[mobb::BoxKind::obb2d], 0);
    EXPECT_GT(*costs.sample_pair, 0);
}

}  // namespace
}  // namespace mobbscope
