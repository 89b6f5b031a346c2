#include <base/text.h>
#include <explain/query_sentence.h>
#include <explain/trace_comparison.h>
#include <mobb/blocks.h>
#include <scene/fit_text.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace mobbscope {

namespace {

bool numbers_agree(double stored, double present, double& rounding) {
    const double by = std::abs(stored - present);
    if (by > kTraceAgreement * std::max(1.0, std::abs(stored))) return false;
    rounding = std::max(rounding, by);
    return true;
}

bool pairs_agree(const mobb::MeasuredPair& stored, const mobb::MeasuredPair& present, double& rounding) {
    return stored.i == present.i && stored.j == present.j && numbers_agree(stored.distance, present.distance, rounding);
}

std::vector<std::string_view> members_that_differ(const mobb::Trace::Event& stored, const mobb::Trace::Event& present,
                                                  double& rounding) {
    std::vector<std::string_view> out;
    const auto compare = [&](std::string_view name, bool same) {
        if (!same) out.push_back(name);
    };
    compare("parent", stored.parent == present.parent);
    compare("depth", stored.depth == present.depth);
    compare("a", stored.a == present.a);
    compare("b", stored.b == present.b);
    compare("test", stored.test == present.test);
    compare("outcome", stored.outcome == present.outcome);
    compare("axis", stored.axis == present.axis);
    compare("gap", numbers_agree(stored.gap, present.gap, rounding));
    compare("pairs", std::ranges::equal(stored.pairs, present.pairs, [&](const auto& one, const auto& other) {
                return pairs_agree(one, other, rounding);
            }));
    return out;
}

bool differs_in(const TraceDifference& difference, std::string_view member) {
    return std::ranges::find(difference.members, member) != difference.members.end();
}

std::string pair_words(std::span<const mobb::MeasuredPair> pairs, std::size_t index) {
    if (index >= pairs.size()) return "none";
    const mobb::MeasuredPair& pair = pairs[index];
    return "samples " + std::to_string(pair.i) + " and " + std::to_string(pair.j) + " at " +
           format_double(pair.distance) + " m";
}

/// The event of one of the traces, with all digits.
std::string event_words(std::span<const DrawnAgent> sides, const mobb::Trace& trace,
                        const TraceDifference& difference) {
    const mobb::Trace::Event event = trace[difference.step];
    std::string out;
    if (differs_in(difference, "parent") || differs_in(difference, "depth")) {
        out = "called by step " + std::to_string(event.parent) + " at depth " + std::to_string(event.depth) + ", ";
    }
    return out + plain_sentence(sides, event);
}

/// The first that differs of two lists of pairs, of either side: "pair 3: samples 4 and 5 at 0.3 m".
std::pair<std::string, std::string> first_pairs(const mobb::Trace::Event& stored, const mobb::Trace::Event& present) {
    double rounding = 0;
    const auto at = std::ranges::mismatch(stored.pairs, present.pairs, [&](const auto& one, const auto& other) {
        return pairs_agree(one, other, rounding);
    });
    const auto index = static_cast<std::size_t>(at.in1 - stored.pairs.begin());
    const std::string which = "pair " + std::to_string(index) + ": ";
    return {which + pair_words(stored.pairs, index), which + pair_words(present.pairs, index)};
}

std::string stopped_words(const char* whose, const mobb::Trace& trace) {
    return trace.stopped() ? std::string("; of the ") + whose + " trace " + recording_words(trace) : "";
}

/// Both have so many events, but for what a stopped recording leaves out.
std::string counts_words(const TraceCheck& check) {
    return "the stored trace is of " + counted(check.stored_events, "event", "events") + ", now there are " +
           std::to_string(check.present_events);
}

void end_at(std::vector<Decision>& decisions, double end) {
    while (!decisions.empty() && decisions.back().t0 >= end) decisions.pop_back();
    if (!decisions.empty()) decisions.back().t1 = std::min(decisions.back().t1, end);
}

}  // namespace

TraceCheck check_trace(const mobb::Trace& stored, const mobb::Trace& present) {
    TraceCheck out;
    out.stored_events = stored.events();
    out.present_events = present.events();
    const int both = std::min(stored.size(), present.size());
    for (; out.compared < both; ++out.compared) {
        double rounding = out.rounding;
        std::vector<std::string_view> members =
            members_that_differ(stored[out.compared], present[out.compared], rounding);
        if (!members.empty()) {
            out.difference = TraceDifference{out.compared, std::move(members)};
            return out;
        }
        out.rounding = rounding;
    }
    // Where recording stopped, events that are missing say nothing.
    const mobb::Trace& shorter = stored.size() < present.size() ? stored : present;
    if (stored.size() != present.size() && !shorter.stopped()) out.difference = TraceDifference{both, {}};
    return out;
}

std::string check_words(const TraceCheck& check, std::span<const DrawnAgent> sides, const mobb::Trace& stored,
                        const mobb::Trace& present) {
    if (!check.difference) {
        std::string out = counted(check.compared, "event", "events") + (check.compared == 1 ? " agrees" : " agree") +
                          " with the stored trace";
        if (!check.agrees()) out += ", but " + counts_words(check);
        if (check.rounding > 0) out += ", gaps and distances to " + formatted("%.1g", check.rounding) + " m";
        return out + stopped_words("stored", stored) + stopped_words("present", present);
    }
    const TraceDifference& difference = *check.difference;
    std::string out = "the traces differ at step " + std::to_string(difference.step);
    if (difference.members.empty()) {
        const bool is_short = difference.step >= stored.size();
        out += is_short ? ": the stored trace ends there, now it goes on with "
                        : ": now the trace ends there, the stored one goes on with ";
        return out + event_words(sides, is_short ? present : stored, difference) + "; " + counts_words(check);
    }
    out += " in " + listed(difference.members) + ": stored " + event_words(sides, stored, difference) + "; now " +
           event_words(sides, present, difference);
    if (differs_in(difference, "pairs")) {
        const auto [of_stored, of_present] = first_pairs(stored[difference.step], present[difference.step]);
        out += "; stored " + of_stored + "; now " + of_present;
    }
    return out;
}

SteppedTraces traces_at(std::span<const DrawnAgent> sides, const mobb::Trace& stored, const mobb::Trace& present,
                        int step) {
    TraceDifference at{step, {}};
    double rounding = 0;
    const bool both = step < stored.size() && step < present.size();
    if (both) at.members = members_that_differ(stored[step], present[step], rounding);
    const auto in_words = [&](const mobb::Trace& trace) {
        return step < trace.size() ? event_words(sides, trace, at) : std::string("the trace has ended");
    };
    SteppedTraces out{in_words(stored), in_words(present), both && at.members.empty()};
    if (differs_in(at, "pairs")) {
        const auto [of_stored, of_present] = first_pairs(stored[step], present[step]);
        out.stored += "; " + of_stored;
        out.present += "; " + of_present;
    }
    return out;
}

std::optional<std::string> yes_no_disagreement(const FittedScene& fitted, const SceneQuery& query, bool collides) {
    const mobb::Blocks *of_a = fitted.tree(query.a).blocks(), *of_b = fitted.tree(query.b).blocks();
    if (!of_a || !of_b) return std::nullopt;
    const mobb::PlacedBlocks a(*of_a, query.a.placement), b(*of_b, query.b.placement);
    const std::array pairs{mobb::BlocksPair{&a, &b}};
    std::array<bool, 1> each{};
    mobb::intersects_each(pairs, each);
    for (const auto& [name, says] :
         {std::pair("mobb::intersects", mobb::intersects(a, b)), std::pair("mobb::intersects_each", each[0])}) {
        if (says != collides)
            return std::string(name) + " says that they " + (says ? "collide" : "do not collide") +
                   ", but the query that finds contacts says otherwise";
    }
    return std::nullopt;
}

std::optional<std::string> QueryCheck::complaint() const {
    if (!trace || (!disagrees && trace->agrees())) return disagrees;
    const std::string traces = check_words(*trace, sides, *query.trace, *answer.trace);
    if (!disagrees) return traces;
    std::string out = *disagrees;
    if (out.ends_with('.')) out.pop_back();
    return out.append("; ").append(traces);
}

QueryCheck check_query(const FittedScene& fitted, const SceneQuery& query) {
    QueryCheck out{query, answer(fitted, query, {.trace = query.trace != nullptr}), named_sides(fitted, query), {}, {}};
    out.disagrees = disagreement(query, out.answer);
    if (!out.disagrees) out.disagrees = yes_no_disagreement(fitted, query, out.answer.contact.has_value());
    if (query.trace) out.trace = check_trace(*query.trace, *out.answer.trace);
    return out;
}

std::vector<Decision> decisions_of(const mobb::PlacedTree& a, const mobb::PlacedTree& b,
                                   const RecordedQuery& recorded) {
    std::vector<Decision> out;
    for (const TraversalEnd& end : deciding_events(a, b, recorded.trace)) {
        const mobb::Trace::Event event = recorded.trace[end.step];
        const mobb::TestCounts tests = recorded.trace.counts(end.step + 1);
        out.push_back({end, event.depth, event.gap, tests.boxes() + tests[mobb::TestKind::samples]});
    }
    if (out.empty()) return out;
    // Cracks of less than kMinOverlap lie between them, which no pair of samples can meet in.
    const mobb::PlacedClip &clip_a = a.placed_clip(), &clip_b = b.placed_clip();
    out.front().t0 = std::max(clip_a.time(0), clip_b.time(0));
    if (!recorded.trace.stopped()) out.back().t1 = std::min(clip_a.time(clip_a.count()), clip_b.time(clip_b.count()));
    for (std::size_t i = 1; i < out.size(); ++i) out[i - 1].t1 = out[i].t0 = std::max(out[i].t0, out[i - 1].t0);
    if (recorded.contact) end_at(out, recorded.contact->time);
    std::erase_if(out, [](const Decision& decision) { return !(decision.t1 > decision.t0); });
    return out;
}

const ComparedTime* TraversalComparison::at(double time) const {
    const auto after = std::ranges::upper_bound(times, time, {}, &ComparedTime::t0);
    if (after == times.begin()) return nullptr;
    const ComparedTime& found = *std::prev(after);
    return time <= found.t1 ? &found : nullptr;
}

TraversalComparison compared(std::vector<Decision> first, std::vector<Decision> second) {
    if (first.empty() || second.empty()) return {};
    const double end = std::min(first.back().t1, second.back().t1);
    end_at(first, end);
    end_at(second, end);
    TraversalComparison out{{std::move(first), std::move(second)}, {}};
    std::array<std::size_t, 2> at{};
    const auto& [one, other] = out.decisions;
    for (double t0 = one.empty() ? end : one.front().t0; t0 < end;) {
        const double t1 = std::min(one[at[0]].t1, other[at[1]].t1);
        out.times.push_back({t0, t1, at, other[at[1]].tests - one[at[0]].tests});
        for (std::size_t side = 0; side < 2; ++side) {
            if (out.decisions[side][at[side]].t1 == t1) ++at[side];
        }
        t0 = t1;
    }
    return out;
}

namespace {

/// When both nodes of an event are there.
mobb::Interval time_of_both(const RecordedTraversal& of, const mobb::Trace::Event& event) {
    const mobb::Node &a = of.a.tree().node(event.a), &b = of.b.tree().node(event.b);
    const double t0 = std::max(of.a.begin(a), of.b.begin(b)), t1 = std::min(of.a.end(a), of.b.end(b));
    // Of nodes that are apart in time, what lies between them.
    return {std::min(t0, t1), std::max(t0, t1)};
}

/// Within what rounding leaves.
bool covers(const mobb::Interval& whole, const mobb::Interval& part) {
    constexpr double kRounding = 1e-9;  // seconds
    return whole.t0 <= part.t0 + kRounding && part.t1 <= whole.t1 + kRounding;
}

}  // namespace

int matching_step(const TraversalComparison& both, const RecordedTraversal& first, const RecordedTraversal& second,
                  int step, std::optional<double> moment) {
    const mobb::Trace &from = first.recorded->trace, &to = second.recorded->trace;
    if (to.empty()) return 0;
    const int last = to.size() - 1;
    if (step + 1 >= from.size()) return last;
    const mobb::Interval time = time_of_both(first, from[step]);
    const bool is_in_it = moment && time.t0 <= *moment && *moment <= time.t1;
    double at = is_in_it ? *moment : 0.5 * (time.t0 + time.t1);
    // Behind a contact nothing was to be decided.
    if (!both.times.empty()) at = std::clamp(at, both.times.front().t0, both.times.back().t1);
    const ComparedTime* there = both.at(at);
    if (!there) return static_cast<int>(std::lround(static_cast<double>(step) * last / (from.size() - 1)));
    int out = both.decision(*there, 1).step;
    if (std::ranges::find(both.decisions[0], step, &Decision::step) != both.decisions[0].end()) return out;
    for (int parent = to[out].parent; parent >= 0 && !covers(time_of_both(second, to[out]), time);
         parent = to[out].parent) {
        out = parent;
    }
    return out;
}

FitComparison compare_fits(const mobb::PlacedTree& a, const mobb::PlacedTree& b, const RecordedQuery& recorded,
                           std::array<std::shared_ptr<const mobb::Tree>, 2> trees) {
    const std::array placed{mobb::PlacedTree(*trees[0], a.placed_clip().placement()),
                            mobb::PlacedTree(*trees[1], b.placed_clip().placement())};
    FitComparison out{std::move(trees), placed, record(placed[0], placed[1]), {}, {}};
    out.traversals = compared(decisions_of(a, b, recorded), decisions_of(out.placed[0], out.placed[1], out.recorded));
    const std::vector<std::string> names =
        names_of_fits(std::array{a.tree().options(), out.placed[0].tree().options()});
    out.names = {names[0], names[1]};
    return out;
}

std::string decision_words(const Decision& decision) {
    const std::string what =
        decision.is_boxes ? "boxes " + with_unit(decision.gap, "m") + " apart" : "samples measured";
    return "step " + std::to_string(decision.step) + ", depth " + std::to_string(decision.depth) + ": " + what +
           ", after " + counted(decision.tests, "test", "tests");
}

std::string earlier_words(std::int64_t earlier, const std::array<std::string, 2>& names) {
    if (earlier == 0) return "both as early";
    return names[earlier > 0 ? 0 : 1] + " was earlier by " + counted(std::abs(earlier), "test", "tests");
}

std::string comparison_words(const TraversalComparison& comparison, const std::array<std::string, 2>& names) {
    if (comparison.times.empty()) return "There is no time before a contact to compare";
    std::array<double, 2> first{};
    bool ties = false;
    for (const ComparedTime& time : comparison.times) {
        if (time.earlier != 0) first[time.earlier > 0 ? 0 : 1] += time.t1 - time.t0;
        ties |= time.earlier == 0;
    }
    if (first == std::array<double, 2>{}) return "Both decided as early at every moment";
    const double all = comparison.times.back().t1 - comparison.times.front().t0;
    return "Over " + formatted("%.2f s", all) + ": " + names[0] + " decided earlier for " +
           formatted("%.2f s", first[0]) + ", " + names[1] + " for " + formatted("%.2f s", first[1]) +
           (ties ? ", both as early for the rest" : "");
}

}  // namespace mobbscope
