#include <base/text.h>
#include <mobb/level_figures.h>
#include <scene/fit_json.h>

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>

namespace mobbscope {

namespace {

/// A tree of the contract that this version cannot build.
bool is_planned(std::string_view tree) { return tree == "production"; }

mobb::TreeKind read_tree_kind(const JsonPlace& place) {
    const std::string& name = place.string();
    if (is_planned(name)) place.fail(in_quotes(name) + " trees are not in this version yet");
    if (const auto kind = mobb::tree_kind_from_name(name)) return *kind;
    place.fail(in_quotes(name) + " is no tree; give one of " + listed(mobb::tree_kind_names()));
}

mobb::Axes read_axes(const JsonPlace& place) {
    if (const auto axes = mobb::axes_from_name(place.string())) return *axes;
    place.fail(in_quotes(place.string()) + " names no axes; give one of " + listed(mobb::axes_names()));
}

using Layout = JsonWriter::Layout;

/// The first 2 or 3 coordinates of a vector.
void write_vector(JsonWriter& out, const glm::dvec3& v, int count) {
    count == 2 ? out.numbers({v.x, v.y}) : out.numbers({v.x, v.y, v.z});
}

void write_node(JsonWriter& out, const mobb::Tree& tree, int index) {
    const mobb::Node& node = tree.nodes()[static_cast<std::size_t>(index)];
    const mobb::Box& box = node.box;
    const int dimensions = mobb::info(box.kind).axes == mobb::BoxAxes::space_time ? 3 : 2;
    out.begin_object(Layout::row);
    out.member("index", index);
    out.member("parent", node.parent);
    out.member("level", node.level);
    out.member("first", node.first);
    out.member("count", node.count);
    out.member("leaf", node.is_leaf());
    out.member("kind", mobb::info(box.kind).name);
    out.key("center");
    // A moving box has its centre in the middle of its time; files give it at t0.
    write_vector(out, box.center - glm::dvec3(box.drift, 0), dimensions);
    out.begin_array("axes");
    for (int i = 0; i < dimensions; ++i) write_vector(out, box.axes[static_cast<std::size_t>(i)], dimensions);
    out.end_array();
    out.key("half");
    write_vector(out, box.half, dimensions);
    if (box.kind == mobb::BoxKind::moving) {
        const glm::dvec2 velocity = 2.0 * box.drift / (tree.t1(node) - tree.t0(node));
        out.member("velocity", {velocity.x, velocity.y});
    }
    out.member("t0", tree.t0(node));
    out.member("t1", tree.t1(node));
    out.end_object();
}

void write_level(JsonWriter& out, const mobb::LevelFigures& figures) {
    out.begin_object(Layout::row);
    for (const mobb::LevelColumn& column : mobb::kLevelColumns) {
        const std::optional<double> value = column.of(figures);
        out.key(column.key);
        if (!value) out.null();
        if (value) column.whole ? out.value(static_cast<std::int64_t>(*value)) : out.value(*value);
    }
    out.end_object();
}

}  // namespace

mobb::FitOptions read_fit(const JsonPlace& place, mobb::FitOptions fit) {
    place.allow_only({"tree", "leaf", "levels", "axes", "time_scale"});
    if (const auto tree = place.find("tree")) fit.tree = read_tree_kind(*tree);
    if (const auto leaf = place.find("leaf")) fit.leaf = leaf->integer(1, kMaxInt);
    if (const auto levels = place.find("levels")) fit.levels = levels->integer(0, kMaxInt);
    if (const auto axes = place.find("axes")) fit.axes = read_axes(*axes);
    if (const auto scale = place.find("time_scale")) {
        fit.time_scale = scale->number(1 / mobb::kMaxTimeScale, mobb::kMaxTimeScale);
    }
    return fit;
}

std::string level_text(const mobb::LevelColumn& column, const mobb::LevelFigures& figures) {
    const std::optional<double> value = column.of(figures);
    if (!value) return "-";
    return column.whole ? std::to_string(static_cast<std::int64_t>(*value)) : brief(*value);
}

void write_tree(JsonWriter& out, const std::string& clip, const mobb::Tree& tree) {
    out.begin_object();
    out.member("clip", clip);
    out.member("tree", mobb::name(tree.options().tree));
    out.member("axes", mobb::name(tree.options().axes));
    out.member("leaf", tree.options().leaf);
    out.member("time_scale", tree.options().time_scale);
    out.list("levels", mobb::level_figures(tree),
             [&](const mobb::LevelFigures& figures) { write_level(out, figures); });
    out.begin_array("nodes");
    for (int i = 0; i < static_cast<int>(tree.nodes().size()); ++i) write_node(out, tree, i);
    out.end_array();
    out.end_object();
}

}  // namespace mobbscope
