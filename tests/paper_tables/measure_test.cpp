#include <mobb/query.h>
#include <paper_tables/measure.h>
#include <paper_tables/test_costs.h>
#include <paper_tables/workload.h>

#include <gtest/gtest.h>

#include <set>

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
    const TableRows table = measure(workload, hierarchical_methods({}), 1);
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

TEST(Measure, SweepsLeaves) {
    const std::vector<TableRow> rows = sweep_leaf(some_queries(50), {}, 1);
    std::set<int> leaves;
    for (const TableRow& each : rows) leaves.insert(each.leaf);
    EXPECT_TRUE(leaves.contains(1) && leaves.contains(10) && leaves.contains(50));
    EXPECT_EQ(rows.size(), leaves.size() * hierarchical_methods({}).size());
}

TEST(Measure, EveryTestHasACost) {
    const TestCosts costs = measure_test_costs(some_queries(50), {});
    ASSERT_TRUE(costs[mobb::BoxKind::obb2d] && costs[mobb::BoxKind::obb3d] && costs.sample_pair);
    EXPECT_GT(*costs[mobb::BoxKind::obb2d], 0);
    EXPECT_GT(*costs.sample_pair, 0);
}

}  // namespace
}  // namespace mobbscope
