// The table of a tree's nodes: filters and orders against others by hand, and rows as text.
#include <explain/node_table.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <numeric>
#include <string>
#include <vector>

namespace mobbscope {
namespace {

NodeValues values_of(mobb::TreeKind kind) {
    std::vector<mobb::Disk> samples;
    for (int i = 0; i < 100; ++i) samples.push_back({2 * std::cos(0.05 * i), 3 * std::sin(0.03 * i), 0.3});
    return {std::make_shared<const mobb::Tree>(std::make_shared<const mobb::Clip>(0.1, samples),
                                               mobb::FitOptions{.tree = kind}),
            {}};
}

std::vector<int> by_hand(const NodeValues& values, const std::function<bool(int)>& passes) {
    std::vector<int> out;
    for (int node = 0; node < values.size(); ++node) {
        if (passes(node)) out.push_back(node);
    }
    return out;
}

TEST(NodeTable, FiltersByEveryField) {
    const NodeValues all = values_of(mobb::TreeKind::umobb);
    const mobb::Tree& tree = all.tree();
    const auto pass = [&](const std::string& text) {
        const NodeFilter filter(text);
        return nodes_that_pass(all, &filter);
    };
    EXPECT_EQ(nodes_that_pass(all, nullptr).size(), tree.nodes().size());
    EXPECT_EQ(pass("level >= 2"), by_hand(all, [&](int i) { return tree.level(i) >= 2; }));
    EXPECT_EQ(pass("leaf"), by_hand(all, [&](int i) { return tree.is_leaf(i); }));
    EXPECT_EQ(pass("node = 2.1"),
              by_hand(all, [&](int i) { return tree.level(i) == 2 && tree.place_in_level(i) == 1; }));
    EXPECT_EQ(pass("node != 3").size(), tree.nodes().size() - 1);
    EXPECT_EQ(pass("sample = 40"),
              by_hand(all, [&](int i) { return tree.node(i).first <= 40 && 40 < tree.node(i).end(); }));
    EXPECT_EQ(pass("time > 9.5 s"), by_hand(all, [&](int i) { return tree.t1(tree.node(i)) > 9.5; }));
    EXPECT_EQ(pass("fill < 50 %"), by_hand(all, [&](int i) { return all.value(NodeField::fill, i) < 0.5; }));
    EXPECT_EQ(pass("overhang > 10"), by_hand(all, [&](int i) { return all.value(NodeField::overhang, i) > 0.1; }));
    EXPECT_EQ(pass("empty > 0.2"), by_hand(all, [&](int i) { return all.value(NodeField::empty, i) > 0.2; }));
    EXPECT_TRUE(pass("tests >= 0").empty()) << "nobody has counted";
    EXPECT_FALSE(pass("fill < 50 %").empty());
}

TEST(NodeTable, SortsByEveryColumnBothWays) {
    const NodeValues all = values_of(mobb::TreeKind::umobb);
    for (const NodeField field : node_columns()) {
        for (const bool descending : {false, true}) {
            std::vector<int> nodes(static_cast<std::size_t>(all.size()));
            std::iota(nodes.begin(), nodes.end(), 0);
            sort_nodes(nodes, all, field, descending);
            const auto in_order = [&](int before, int after) {
                const mobb::Tree& tree = all.tree();
                const auto key = [&](int node) {
                    return field == NodeField::node ? 1e6 * tree.level(node) + tree.place_in_level(node)
                                                    : all.value(field, node);
                };
                if (std::isnan(key(after))) return true;
                return descending ? key(before) >= key(after) : key(before) <= key(after);
            };
            for (std::size_t i = 1; i < nodes.size(); ++i)
                EXPECT_TRUE(in_order(nodes[i - 1], nodes[i])) << info(field).name;
        }
    }
}

TEST(NodeTable, TheWorstIsWhatWastesMost) {
    EXPECT_TRUE(is_worse_if_more(NodeField::empty));
    EXPECT_TRUE(is_worse_if_more(NodeField::avoidable));
    EXPECT_FALSE(is_worse_if_more(NodeField::fill));
    EXPECT_FALSE(is_worse_if_more(NodeField::node));
    EXPECT_FALSE(is_worse_if_more(NodeField::level));
}

TEST(NodeTable, ValuesAreTextInTheColumnsUnit) {
    const NodeValues all = values_of(mobb::TreeKind::mobb);
    const int last = all.size() - 1;
    const mobb::Tree& tree = all.tree();
    EXPECT_EQ(node_text(all, NodeField::node, last),
              std::to_string(tree.level(last)) + '.' + std::to_string(tree.place_in_level(last)));
    EXPECT_EQ(node_text(all, NodeField::sample, 0), "0..99");
    EXPECT_EQ(node_text(all, NodeField::time, 0), "0.000..10.000");
    EXPECT_EQ(node_text(all, NodeField::overhang, 0), "") << "upright boxes have none";
    EXPECT_EQ(node_text(all, NodeField::tests, 0), "");
    EXPECT_EQ(column_heading(NodeField::fill), "fill, %");
    EXPECT_EQ(column_heading(NodeField::level), "level");
    const double shown = std::stod(node_text(all, NodeField::fill, 0));
    const double exact = std::stod(node_text(all, NodeField::fill, 0, true));
    EXPECT_EQ(exact, all.value(NodeField::fill, 0));
    EXPECT_NEAR(shown, 100 * exact, 0.05);
}

TEST(NodeTable, RowsHaveTheirColumnsNames) {
    const NodeValues all = values_of(mobb::TreeKind::mobb);
    const std::vector<NodeField> columns{NodeField::node, NodeField::sample};
    EXPECT_EQ(node_rows(all, columns, std::vector<int>{0}, ','), "node,sample\n0.0,0..99\n");
    EXPECT_EQ(node_rows(all, columns, std::vector<int>{0}, '\t'), "node\tsample\n0.0\t0..99\n");
}

}  // namespace
}  // namespace mobbscope
