#include <base/text.h>
#include <scene/scene_json.h>

#include <algorithm>
#include <charconv>
#include <cinttypes>
#include <stdexcept>
#include <string>
#include <vector>

namespace mobbscope {

namespace {

using Layout = JsonWriter::Layout;

// ---- fits

std::optional<mobb::TreeKind> find_tree_kind_at(const JsonPlace& place) {
    return place.attempt([&] { return find_tree_kind(place.string()); });
}

mobb::TreeKind read_tree_kind(const JsonPlace& place) {
    if (const auto kind = find_tree_kind_at(place)) return *kind;
    place.fail(in_quotes(place.string()) + " is no tree; give one of " + listed(mobb::tree_kind_names()));
}

mobb::Axes read_axes(const JsonPlace& place) {
    if (const auto axes = mobb::axes_from_name(place.string())) return *axes;
    place.fail(in_quotes(place.string()) + " names no axes; give one of " + listed(mobb::axes_names()));
}

// ---- contacts and traces

constexpr double kAnyTime = 2 * mobb::kMaxTime;        // a start plus a clip's duration
constexpr double kAnyLength = 1e2 * mobb::kMaxLength;  // sums and differences of placed coordinates

/// A tree over n samples has at most 2n - 1 nodes.
int last_node(int samples) { return samples > kMaxInt / 2 ? kMaxInt : 2 * samples - 2; }

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
    place.fail(in_quotes(place.string()) + " is no kind of test; give " + test_names());
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

void write_fit(JsonWriter& out, const mobb::FitOptions& fit) {
    out.row("tree", mobb::name(fit.tree), "leaf", fit.leaf, "levels", fit.levels, "axes", mobb::name(fit.axes),
            "time_scale", fit.time_scale);
}

std::string digest_text(std::uint64_t digest) { return formatted("%016" PRIx64, digest); }

std::uint64_t read_digest(const JsonPlace& place) {
    const std::string& text = place.string();
    std::uint64_t digest = 0;
    const char* const end = text.data() + text.size();
    if (text.size() != 16 || std::from_chars(text.data(), end, digest, 16).ptr != end)
        place.fail(in_quotes(text) + " is not 16 hexadecimal digits; remove it where nobody knows it");
    return digest;
}

void write_contact(JsonWriter& out, const std::optional<mobb::Contact>& contact) {
    if (!contact) return out.null();
    out.row("time", contact->time, "a_sample", contact->a_sample, "b_sample", contact->b_sample, "distance",
            contact->distance, "radii", contact->radii);
}

std::optional<mobb::Contact> read_contact(const JsonPlace& place, int samples_a, int samples_b) {
    if (place.is_null()) return std::nullopt;
    place.allow_only({"time", "a_sample", "b_sample", "distance", "radii"});
    return mobb::Contact{place.require("time").number(-kAnyTime, kAnyTime),
                         place.require("a_sample").integer(0, samples_a - 1),
                         place.require("b_sample").integer(0, samples_b - 1),
                         place.require("distance").number(0, kAnyLength), place.require("radii").number(0, kAnyLength)};
}

std::array<std::optional<std::int64_t>, mobb::kTestKindCount> read_test_counts(const JsonPlace& place) {
    std::array<std::optional<std::int64_t>, mobb::kTestKindCount> out;
    for (int i = 0; i < place.members(); ++i) {
        const JsonPlace member = place.member(i);
        const auto test = mobb::test_from_name(member.key());
        if (!test) member.fail(in_quotes(member.key()) + " is no kind of test; give " + test_names());
        out[test->index()] = member.count();
    }
    return out;
}

void write_event(JsonWriter& out, const mobb::Trace& trace, int step, bool avoidable) {
    const mobb::Trace::Event event = trace[step];
    const bool separated = event.outcome == mobb::Outcome::separated;
    out.begin_object(Layout::row);
    out.members("step", step, "parent", event.parent, "depth", event.depth, "a", event.a, "b", event.b);
    out.members("test", mobb::name(event.test), "outcome", mobb::name(event.outcome));
    out.member("axis", separated ? std::optional(event.axis) : std::nullopt);
    out.member("gap", separated ? std::optional(event.gap) : std::nullopt);
    out.list("pairs", event.pairs, [&](const mobb::MeasuredPair& pair) { out.tuple(pair.i, pair.j, pair.distance); });
    if (avoidable) out.member("avoidable", true);
    out.end_object();
}

void write_trace(JsonWriter& out, const mobb::Trace& trace, std::span<const int> avoidable) {
    out.begin_array();
    for (int step = 0; step < trace.size(); ++step)
        write_event(out, trace, step, std::ranges::binary_search(avoidable, step));
    out.end_array();
}

void write_events(JsonWriter& out, const mobb::Trace& trace, std::span<const int> steps,
                  std::span<const int> avoidable) {
    out.begin_array();
    for (const int step : steps) write_event(out, trace, step, std::ranges::binary_search(avoidable, step));
    out.end_array();
}

mobb::Trace read_trace(const JsonPlace& place, int samples_a, int samples_b) {
    mobb::Trace trace;
    for (int step = 0; step < place.size(); ++step) {
        const JsonPlace entry = place[step];
        entry.allow_only({"step", "parent", "depth", "a", "b", "test", "outcome", "axis", "gap", "pairs", "avoidable"});
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
    trace.shrink_to_fit();
    return trace;
}

}  // namespace mobbscope
