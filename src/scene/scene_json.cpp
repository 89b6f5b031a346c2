#include <base/text.h>
#include <scene/scene_json.h>

#include <algorithm>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace mobbscope {

namespace {

using Layout = JsonWriter::Layout;

// ---- fits and trees

std::optional<mobb::TreeKind> find_tree_kind_at(const JsonPlace& place) {
    try {
        return find_tree_kind(place.string());
    } catch (const std::invalid_argument& old_name) {
        place.fail(old_name.what());
    }
}

mobb::TreeKind read_tree_kind(const JsonPlace& place) {
    if (const auto kind = find_tree_kind_at(place)) return *kind;
    place.fail(in_quotes(place.string()) + " is no tree; give one of " + listed(mobb::tree_kind_names()));
}

mobb::Axes read_axes(const JsonPlace& place) {
    if (const auto axes = mobb::axes_from_name(place.string())) return *axes;
    place.fail(in_quotes(place.string()) + " names no axes; give one of " + listed(mobb::axes_names()));
}

/// The first 2 or 3 coordinates of a vector.
void write_vector(JsonWriter& out, const glm::dvec3& v, int count) {
    count == 2 ? out.numbers({v.x, v.y}) : out.numbers({v.x, v.y, v.z});
}

void write_node(JsonWriter& out, const mobb::Tree& tree, int index) {
    const mobb::Node& node = tree.node(index);
    const mobb::Box box = tree.box(index);
    const mobb::BoxInfo& shape = mobb::info(box.kind);
    const int dimensions = shape.axes == mobb::BoxAxes::space_time ? 3 : 2;
    out.begin_object(Layout::row);
    out.member("index", index);
    out.member("parent", tree.parent(index));
    out.member("level", tree.level(index));
    out.member("first", node.first);
    out.member("count", node.count);
    out.member("leaf", tree.is_leaf(index));
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
            out.numbers({box.center.x + side * box.drift.x, box.center.y + side * box.drift.y, box.half.x});
        out.end_array();
    }
    if (shape.moves) {
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

// ---- contacts and traces

constexpr double kAnyTime = 2 * mobb::kMaxTime;        // a start plus a clip's duration
constexpr double kAnyLength = 1e2 * mobb::kMaxLength;  // sums and differences of placed coordinates

/// A tree over n samples has at most 2n - 1 nodes.
int last_node(int samples) {
    return samples > std::numeric_limits<int>::max() / 2 ? std::numeric_limits<int>::max() : 2 * samples - 2;
}

/// Whether a test can end so.
bool fits(mobb::TestKind test, mobb::Outcome outcome) {
    switch (outcome) {
        case mobb::Outcome::disjoint_in_time:
            return test == mobb::TestKind::time;
        case mobb::Outcome::separated:
            return test.is_box();
        case mobb::Outcome::overlap:
            return test != mobb::TestKind::samples;
        case mobb::Outcome::hit:
        case mobb::Outcome::no_hit:
            return test == mobb::TestKind::samples;
    }
    return false;
}

/// "time, obb2d, ... or samples".
std::string test_names() {
    std::string out(mobb::name(mobb::TestKind::time));
    for (const mobb::BoxKind kind : mobb::kBoxKinds) out += ", " + std::string(mobb::name(kind));
    return out + " or " + std::string(mobb::name(mobb::TestKind::samples));
}

mobb::TestKind read_test(const JsonPlace& place) {
    if (const auto test = mobb::test_from_name(place.string())) return *test;
    place.fail(in_quotes(place.string()) + " is no test; give " + test_names());
}

mobb::Outcome read_outcome(const JsonPlace& place, mobb::TestKind test) {
    const auto outcome = mobb::outcome_from_name(place.string());
    if (!outcome) {
        place.fail(in_quotes(place.string()) +
                   " is no outcome; give disjoint_in_time, separated, overlap, hit or no_hit");
    }
    if (!fits(test, *outcome)) {
        place.fail("a test of kind " + std::string(mobb::name(test)) + " cannot end as " + place.string());
    }
    return *outcome;
}

std::vector<mobb::MeasuredPair> read_pairs(const JsonPlace& place, int samples_a, int samples_b) {
    std::vector<mobb::MeasuredPair> pairs;
    for (int i = 0; i < place.size(); ++i) {
        const JsonPlace pair = place[i];
        pair.require_size(3, "[i, j, distance]");
        pairs.push_back(
            {pair[0].integer(0, samples_a - 1), pair[1].integer(0, samples_b - 1), pair[2].number(0, kAnyLength)});
    }
    return pairs;
}

void write_event(JsonWriter& out, int step, const mobb::Trace::Event& event) {
    const bool separated = event.outcome == mobb::Outcome::separated;
    out.begin_object(Layout::row);
    out.member("step", step);
    out.member("parent", event.parent);
    out.member("depth", event.depth);
    out.member("a", event.a);
    out.member("b", event.b);
    out.member("test", mobb::name(event.test));
    out.member("outcome", mobb::name(event.outcome));
    out.key("axis");
    separated ? out.value(event.axis) : out.null();
    out.key("gap");
    separated ? out.value(event.gap) : out.null();
    out.list("pairs", event.pairs, [&](const mobb::MeasuredPair& pair) {
        out.begin_array();
        out.value(pair.i);
        out.value(pair.j);
        out.value(pair.distance);
        out.end_array();
    });
    out.end_object();
}

}  // namespace

std::optional<mobb::TreeKind> find_tree_kind(std::string_view name) {
    const auto old = std::ranges::find(mobb::kTreeKinds, name, [](auto kind) { return mobb::info(kind).formerly; });
    if (name.empty() || old == mobb::kTreeKinds.end()) return mobb::tree_kind_from_name(name);
    throw std::invalid_argument("`" + std::string(name) + "` is called `" + std::string(mobb::name(*old)) + "`");
}

void refuse_old_tree_names(const JsonPlace& place) {
    const int members = place.is_object() ? place.members() : 0, elements = place.is_array() ? place.size() : 0;
    for (int i = 0; i < members; ++i) {
        const JsonPlace member = place.member(i);
        if (member.key() == "tree" && member.is_string()) find_tree_kind_at(member);
        refuse_old_tree_names(member);
    }
    for (int i = 0; i < elements; ++i) refuse_old_tree_names(place[i]);
}

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
    return column.whole ? std::to_string(static_cast<std::int64_t>(*value)) : brief(*value * column.in_unit);
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

void write_contact(JsonWriter& out, const std::optional<mobb::Contact>& contact) {
    if (!contact) return out.null();
    out.begin_object(JsonWriter::Layout::row);
    out.member("time", contact->time);
    out.member("a_sample", contact->a_sample);
    out.member("b_sample", contact->b_sample);
    out.member("distance", contact->distance);
    out.member("radii", contact->radii);
    out.end_object();
}

std::optional<mobb::Contact> read_contact(const JsonPlace& place, int samples_a, int samples_b) {
    if (place.is_null()) return std::nullopt;
    place.allow_only({"time", "a_sample", "b_sample", "distance", "radii"});
    return mobb::Contact{place.require("time").number(-kAnyTime, kAnyTime),
                         place.require("a_sample").integer(0, samples_a - 1),
                         place.require("b_sample").integer(0, samples_b - 1),
                         place.require("distance").number(0, kAnyLength), place.require("radii").number(0, kAnyLength)};
}

void write_trace(JsonWriter& out, const mobb::Trace& trace) {
    out.begin_array();
    for (int step = 0; step < trace.size(); ++step) write_event(out, step, trace[step]);
    out.end_array();
}

mobb::Trace read_trace(const JsonPlace& place, int samples_a, int samples_b) {
    mobb::Trace trace;
    for (int step = 0; step < place.size(); ++step) {
        const JsonPlace entry = place[step];
        entry.allow_only({"step", "parent", "depth", "a", "b", "test", "outcome", "axis", "gap", "pairs"});
        mobb::Trace::Event event;
        entry.require("step").integer(step, step);
        event.parent = entry.require("parent").integer(-1, step - 1);
        // An event with no earlier one to call it is at the root.
        const int depth = event.parent < 0 ? 0 : trace[event.parent].depth + 1;
        event.depth = entry.require("depth").integer(depth, depth);
        event.a = entry.require("a").integer(0, last_node(samples_a));
        event.b = entry.require("b").integer(0, last_node(samples_b));
        event.test = read_test(entry.require("test"));
        event.outcome = read_outcome(entry.require("outcome"), event.test);
        if (event.outcome == mobb::Outcome::separated) {
            event.axis = entry.require("axis").integer(0, mobb::axis_count(event.test) - 1);
            event.gap = entry.require("gap").number(0, kAnyLength);
        } else {
            for (const char* key : {"axis", "gap"}) {
                const auto value = entry.find(key);
                if (value && !value->is_null()) value->fail("only a separation has one; give null");
            }
        }
        std::vector<mobb::MeasuredPair> pairs;
        if (const auto list = entry.find("pairs")) {
            pairs = read_pairs(*list, samples_a, samples_b);
            if (!pairs.empty() && event.test != mobb::TestKind::samples)
                list->fail("only a test of samples measures pairs");
        }
        event.pairs = pairs;
        trace.push(event);
    }
    return trace;
}

}  // namespace mobbscope
