#include <paper_tables/table_report.h>
#include <paper_tables/workload.h>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <sstream>
#include <vector>

namespace mobbscope {
namespace {

TableReport report() {
    TableReport out;
    out.workload = "table2";
    out.description = "somewhere";
    out.machine = "a machine";
    out.seed = 3;
    out.rounds = 5;
    out.queries = 1000;
    out.clips = 14;
    out.mean_duration = 42;
    out.table.positive = 0.28;
    TableRow brute{.method = "brute", .time_ns = 2900, .time_ns_q1 = 2800, .time_ns_q3 = 3000};
    brute[mobb::TestKind::samples] = 600;
    TableRow tree{.method = "mobb", .leaf = 10, .time_ns = 190, .root_rejected = 0.4};
    tree[mobb::BoxKind::obb2d] = 25.5;
    tree[mobb::TestKind::samples] = 7;
    tree.trees = {.depth = 2, .nodes = 3, .bytes = 600, .build_ns = 1500, .volumes = {10, 6}};
    tree.pair_levels = {{1, 0.25, 0.5, 0, 0.75}, {0.5, 0.25, 0, 0.25, 0.25}};
    out.table.rows = {brute, tree};
    out.costs[mobb::BoxKind::obb2d] = 6;
    out.costs.sample_pair = 3;
    return out;
}

TEST(TableReport, JsonHasTheContractsKeys) {
    std::ostringstream text;
    write_json(text, report());
    const nlohmann::json json = nlohmann::json::parse(text.str());
    EXPECT_EQ(json["workload"], "table2");
    EXPECT_EQ(json["machine"], "a machine");
    EXPECT_EQ(json["queries"], 1000);
    EXPECT_EQ(json["seed"], 3);
    EXPECT_EQ(json["clips"]["count"], 14);
    EXPECT_EQ(json["clips"]["mean_duration"], 42);
    EXPECT_EQ(json["positive"], 0.28);
    EXPECT_EQ(json["root_rejected"], 0.4);
    ASSERT_EQ(json["rows"].size(), 2u);
    EXPECT_EQ(json["rows"][1]["method"], "mobb");
    EXPECT_EQ(json["rows"][1]["time_ns"], 190);
    EXPECT_EQ(json["rows"][1]["obb2d"], 25.5);
    EXPECT_EQ(json["rows"][1]["obb3d"], 0);
    EXPECT_EQ(json["rows"][1]["samples"], 7);
    EXPECT_EQ(json["rows"][1]["paper"]["obb2d"], 27.5);
    EXPECT_TRUE(json["rows"][0]["paper"].is_null());
    EXPECT_EQ(json["rows"][1]["nodes"], 3);
    EXPECT_EQ(json["rows"][1]["bytes"], 600);
    EXPECT_EQ(json["rows"][1]["build_ns"], 1500);
    EXPECT_EQ(json["rows"][1]["volumes"], (std::vector<double>{10, 6}));
    EXPECT_EQ(json["rows"][1]["pair_levels"][0]["separated"], 0.5);
    EXPECT_EQ(json["rows"][1]["pair_levels"][1]["queries_ended"], 0.25);
    EXPECT_FALSE(json.contains("leaf_sweep"));
    EXPECT_FALSE(json.contains("variants"));
    EXPECT_EQ(json["test_ns"]["obb2d"], 6);
    EXPECT_TRUE(json["test_ns"]["moving"].is_null());
}

TEST(TableReport, TextSetsThePapersFiguresBeside) {
    std::ostringstream text;
    write_text(text, report());
    EXPECT_NE(text.str().find("28.0 % collide"), std::string::npos) << text.str();
    EXPECT_NE(text.str().find("27.5"), std::string::npos) << text.str();
    EXPECT_NE(text.str().find("worth 2.0 sample pairs"), std::string::npos) << text.str();
}

TEST(TableReport, SweepAndVariantsAreSetBesideTheBaselines) {
    TableReport with = report();
    TableRow one_level = with.table.rows[1];
    one_level.method = "mobb_1level";
    one_level.levels = 1;
    one_level.time_ns = 321.5;
    TableRow large_leaf = with.table.rows[1];
    large_leaf.leaf = 200;
    large_leaf.time_ns = 123.5;
    with.sweep = {with.table.rows[0], one_level, with.table.rows[1], large_leaf};
    with.variants = {one_level, with.table.rows[1]};
    std::ostringstream text;
    write_text(text, with);
    EXPECT_NE(text.str().find("In the same rounds: brute 2900.0, mobb_1level 321.5 ns/query"), std::string::npos)
        << text.str();
    EXPECT_NE(text.str().find("best    n_min 200"), std::string::npos) << text.str();
    EXPECT_NE(text.str().find("volumes from the root on"), std::string::npos) << text.str();

    std::ostringstream json_text;
    write_json(json_text, with);
    const nlohmann::json json = nlohmann::json::parse(json_text.str());
    EXPECT_EQ(json["leaf_sweep"][3]["leaf"], 200);
    EXPECT_EQ(json["variants"][1]["volumes"].size(), 2u);
}

TEST(TableReport, TextSaysWherePairsOfNodesEnd) {
    std::ostringstream text;
    write_text(text, report());
    EXPECT_NE(text.str().find("2.0 levels, 3.0 nodes, 600 B a tree, built in 1.5 us"), std::string::npos) << text.str();
    EXPECT_NE(text.str().find("0       1.000         25.0 %     50.0 %    0.0 %            75.0 %"), std::string::npos)
        << text.str();
}

TEST(PaperFigures, AreThoseOfTheTables) {
    EXPECT_EQ(paper_row("table1", "hybrid2")->obb2d, 1.5);
    EXPECT_EQ(paper_row("table2", "mobb_1level")->samples, 306);
    EXPECT_FALSE(paper_row("table2", "moving"));
    EXPECT_FALSE(paper_row("table3", "mobb"));
}

}  // namespace
}  // namespace mobbscope
