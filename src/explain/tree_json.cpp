#include <explain/fit_findings.h>
#include <explain/node_values.h>
#include <explain/tree_json.h>
#include <mobb/level_figures.h>
#include <scene/scene_json.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

namespace mobbscope {

namespace {

using Layout = JsonWriter::Layout;

/// The first 2 or 3 coordinates of a vector.
void write_vector(JsonWriter& out, const glm::dvec3& v, int count) {
    count == 2 ? out.value(glm::dvec2(v)) : out.value(v);
}

constexpr std::array<std::pair<std::string_view, NodeField>, 5> kNodeFigures{{{"share", NodeField::share},
                                                                              {"empty", NodeField::empty},
                                                                              {"floor", NodeField::floor},
                                                                              {"overhang", NodeField::overhang},
                                                                              {"waste", NodeField::waste}}};

/// What fitting made of a node.
void write_node_members(JsonWriter& out, const mobb::Tree& tree, int index) {
    const mobb::Node& node = tree.node(index);
    const mobb::Box box = tree.box(index);
    const mobb::BoxInfo& shape = mobb::info(box.kind);
    const int dimensions = shape.axes == mobb::BoxAxes::space_time ? 3 : 2;
    out.members("index", index, "parent", tree.parent(index), "level", tree.level(index));
    out.members("first", node.first, "count", node.count, "leaf", tree.is_leaf(index));
    out.member("kind", shape.name);
    out.key("center");
    // A box that moves has its centre in the middle of its time; files give it at t0.
    write_vector(out, box.center - glm::dvec3(box.drift, 0), dimensions);
    out.begin_array("axes");
    for (int i = 0; i < dimensions; ++i) write_vector(out, box.axes[static_cast<std::size_t>(i)], dimensions);
    out.end_array();
    out.key("half");
    write_vector(out, box.half, dimensions);
    if (shape.round) {
        // Its disk at t0 and at t1: x, y, r.
        out.begin_array("bounds");
        for (const double side : {-1.0, 1.0})
            out.tuple(box.center.x + side * box.drift.x, box.center.y + side * box.drift.y, box.half.x);
        out.end_array();
    }
    if (shape.moves) {
        out.member("velocity", 2.0 * box.drift / (tree.t1(node) - tree.t0(node)));
    }
    out.members("t0", tree.t0(node), "t1", tree.t1(node));
}

void write_node(JsonWriter& out, const NodeValues& values, int index) {
    out.begin_object(Layout::row);
    write_node_members(out, values.tree(), index);
    for (const auto& [key, field] : kNodeFigures) {
        const double value = values.value(field, index);
        out.member(key, std::isnan(value) ? std::nullopt : std::optional(value));
    }
    out.end_object();
}

void write_level(JsonWriter& out, const mobb::LevelFigures& figures) {
    out.begin_object(Layout::row);
    for (const mobb::LevelColumn& column : mobb::kLevelColumns) {
        const std::optional<double> value = column.of(figures);
        out.key(column.name);
        if (!value) out.null();
        if (value) column.whole ? out.value(static_cast<std::int64_t>(*value)) : out.value(*value);
    }
    out.end_object();
}

void write_cost(JsonWriter& out, const TreeCost* cost) {
    out.key("expected");
    if (!cost) {
        out.null();
        out.key("counted");
        return out.null();
    }
    const ExpectedCost& expected = *cost->expected;
    out.row("box_tests", expected.tests.boxes(), "sample_pairs", expected.tests[mobb::TestKind::samples], "area",
            expected.placements.area(), "offset", expected.placements.offset);
    out.key("counted");
    out.row("box_tests", cost->tests.boxes(), "sample_pairs", cost->tests[mobb::TestKind::samples], "standard_error",
            cost->count.standard_error(), "placements", cost->queries, "seed", kCountedSeed);
}

void write_finding(JsonWriter& out, const FitFinding& found) {
    out.begin_object(Layout::row);
    out.members("kind", name(found.kind), "text", found.text);
    const auto place = [](int at) { return at < 0 ? std::nullopt : std::optional<std::int64_t>(at); };
    out.member("level", place(found.level));
    out.member("node", place(found.node));
    out.member("sample", place(found.sample));
    out.key("mend");
    found.mend ? write_fit(out, *found.mend) : out.null();
    out.end_object();
}

/// Of which clip and fit a tree is.
void write_tree_head(JsonWriter& out, const std::string& clip, const mobb::Tree& tree) {
    const mobb::FitOptions& options = tree.options();
    out.members("clip", clip, "tree", mobb::name(options.tree), "axes", mobb::name(options.axes));
    out.members("leaf", options.leaf, "time_scale", options.time_scale);
}

}  // namespace

void write_tree(JsonWriter& out, const std::string& clip, const mobb::Tree& tree, const TreeCost* cost) {
    const std::vector<double> shares = cost ? cost->shares : std::vector<double>();
    // The tree is the caller's.
    const NodeValues values(std::shared_ptr<const mobb::Tree>(std::shared_ptr<void>(), &tree), shares);
    out.begin_object();
    write_tree_head(out, clip, tree);
    write_cost(out, cost);
    out.list("levels", mobb::level_figures(tree),
             [&](const mobb::LevelFigures& figures) { write_level(out, figures); });
    out.begin_array("nodes");
    for (int i = 0; i < values.size(); ++i) write_node(out, values, i);
    out.end_array();
    out.list("findings", fit_findings(tree, shares), [&](const FitFinding& found) { write_finding(out, found); });
    out.end_object();
}

void write_fitted_nodes(JsonWriter& out, const std::string& clip, const mobb::Tree& tree) {
    write_tree_head(out, clip, tree);
    out.begin_array("nodes");
    for (int i = 0; i < static_cast<int>(tree.nodes().size()); ++i) {
        out.begin_object(Layout::row);
        write_node_members(out, tree, i);
        out.end_object();
    }
    out.end_array();
}

}  // namespace mobbscope
