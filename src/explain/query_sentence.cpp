#include <base/name_list.h>
#include <base/text.h>
#include <explain/avoidable.h>
#include <explain/axis_intervals.h>
#include <explain/clearance.h>
#include <explain/query_sentence.h>
#include <mobb/query.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>

namespace mobbscope {

namespace {

std::string separating_axis_words(std::span<const DrawnAgent> sides, const mobb::Trace::Event& event) {
    const auto axis_of = [&](const DrawnAgent& side, int node, int axis) {
        return side.label + "'s " + axis_word(side.placed.tree().box(node), event.test, axis) + " axis";
    };
    const mobb::BoxAxes axes = mobb::info(event.test.box()).axes;
    if (axes == mobb::BoxAxes::world) return event.axis == 0 ? "along x" : "along y";
    if (axes == mobb::BoxAxes::centers) return "from centre to centre";
    const AxisOrigin origin = axis_origin(event.test, event.axis);
    if (origin.b < 0) return "along " + axis_of(sides[0], event.a, origin.a);
    if (origin.a < 0) return "along " + axis_of(sides[1], event.b, origin.b);
    return "across " + axis_of(sides[0], event.a, origin.a) + " and " + axis_of(sides[1], event.b, origin.b);
}

std::string what_next(std::span<const DrawnAgent> sides, const mobb::Trace::Event& event) {
    const bool leaf_a = sides[0].placed.tree().is_leaf(event.a);
    const bool leaf_b = sides[1].placed.tree().is_leaf(event.b);
    return leaf_a && leaf_b ? "on to their samples" : "on to their children";
}

std::string time_outcome(std::span<const DrawnAgent> sides, const mobb::Trace::Event& event) {
    const mobb::PlacedTree& a = sides[0].placed;
    const mobb::PlacedTree& b = sides[1].placed;
    const double shared = std::min(a.end(a.node(event.a)), b.end(b.node(event.b))) -
                          std::max(a.begin(a.node(event.a)), b.begin(b.node(event.b)));
    if (event.outcome == mobb::Outcome::disjoint_in_time) {
        // Neighbours in time only touch; rounding is no gap.
        return shared > -1e-9 ? "they only touch in time" : "apart in time by " + with_unit(-shared, "s");
    }
    return "they share " + with_unit(shared, "s");
}

std::string sample_outcome(std::span<const DrawnAgent> sides, const mobb::Trace::Event& event) {
    const mobb::PlacedClip& a = sides[0].clip();
    const mobb::PlacedClip& b = sides[1].clip();
    if (event.outcome == mobb::Outcome::hit && !event.pairs.empty()) {
        const mobb::Contact contact = mobb::contact_of(a, event.pairs.back().i, b, event.pairs.back().j);
        return "samples " + std::to_string(contact.a_sample) + " and " + std::to_string(contact.b_sample) + " hit at " +
               with_unit(contact.time, "s") + ", " + overlap_words(a, b, contact.a_sample, contact.b_sample) + " deep";
    }
    if (event.pairs.empty()) return "no pair of samples overlaps in time";
    double clearance = std::numeric_limits<double>::max();
    for (const mobb::MeasuredPair& pair : event.pairs) {
        const mobb::Approach approach = mobb::approach_of(a, pair.i, b, pair.j);
        clearance = std::min(clearance, approach.clearance(approach.nearest()));
    }
    return "no hit in " + counted(event.pairs.size(), "pair", "pairs") + " of samples, the nearest " +
           with_unit(clearance, "m") + " apart";
}

}  // namespace

std::string overlap_words(const mobb::PlacedClip& a, const mobb::PlacedClip& b, int i, int j) {
    return (a.is_linear() || b.is_linear() ? "up to " : "") + with_unit(most_overlap(a, b, i, j), "m");
}

std::array<DrawnAgent, 2> named_sides(const FittedScene& fitted, const SceneQuery& query) {
    const auto side = [&](const PlacedAgent& who) {
        return DrawnAgent{.placed = fitted.placed(who), .name = who.name, .label = cleaned(who.name), .color = {}};
    };
    return {side(query.a), side(query.b)};
}

std::string node_name(const DrawnAgent& agent, int node) {
    const mobb::Tree& tree = agent.placed.tree();
    const int level = agent.placed.tree().level(node);
    return agent.label + ' ' + std::to_string(level) + '.' + std::to_string(tree.place_in_level(node));
}

std::string outcome_text(std::span<const DrawnAgent> sides, const mobb::Trace::Event& event) {
    if (event.test == mobb::TestKind::time) return time_outcome(sides, event);
    if (event.test == mobb::TestKind::samples) return sample_outcome(sides, event);
    const mobb::BoxInfo& shape = mobb::info(event.test.box());
    if (event.outcome == mobb::Outcome::separated) {
        const char* when = shape.moves ? " at the nearest" : "";
        return "separated " + separating_axis_words(sides, event) + " by " + with_unit(event.gap, "m") + when;
    }
    if (const auto avoidable = avoidable_overlap(sides[0].placed, sides[1].placed, event)) {
        return std::string(shape.meets) + ", avoidable: " +
               avoidable_words(*avoidable, node_name(sides[0], event.a), node_name(sides[1], event.b));
    }
    return std::string(shape.meets) + ", " + what_next(sides, event);
}

std::string plain_sentence(std::span<const DrawnAgent> sides, const mobb::Trace::Event& event) {
    // In the order of the outcomes.
    constexpr std::array kWords{"apart in time", "separated", "overlap", "hit", "no hit"};
    static_assert(kWords.size() == static_cast<std::size_t>(mobb::Outcome::no_hit) + 1);
    const auto has = [](const DrawnAgent& side, int node) { return node < std::ssize(side.placed.tree().nodes()); };
    const auto named = [&](const DrawnAgent& side, int node) {
        return has(side, node) ? node_name(side, node) : side.label + " node " + std::to_string(node);
    };
    std::string out = named(sides[0], event.a) + " against " + named(sides[1], event.b) + ", " +
                      std::string(mobb::name(event.test)) + ": " + kWords[static_cast<std::size_t>(event.outcome)];
    if (event.outcome == mobb::Outcome::separated) {
        const bool both = has(sides[0], event.a) && has(sides[1], event.b);
        out += ' ' + (both ? separating_axis_words(sides, event) : "along axis " + std::to_string(event.axis)) +
               " by " + format_double(event.gap) + " m";
    }
    if (event.test != mobb::TestKind::samples) return out;
    out += " (" + counted(event.pairs.size(), "pair", "pairs") + " measured";
    if (event.outcome == mobb::Outcome::hit && !event.pairs.empty()) {
        const mobb::MeasuredPair& pair = event.pairs.back();
        out += ", samples " + std::to_string(pair.i) + " and " + std::to_string(pair.j) + " at " +
               format_double(pair.distance) + " m";
    }
    return out + ')';
}

std::string short_outcome(std::span<const DrawnAgent> sides, const mobb::Trace::Event& event) {
    switch (event.outcome) {
        case mobb::Outcome::disjoint_in_time:
            return "apart in time";
        case mobb::Outcome::separated:
            return separating_axis_words(sides, event) + ' ' + with_unit(event.gap, "m");
        case mobb::Outcome::overlap:
            return event.test == mobb::TestKind::time ? "share time" : "overlap";
        case mobb::Outcome::hit:
            return "hit";
        case mobb::Outcome::no_hit:
            return "no hit";
    }
    return "";
}

std::string avoidable_words(const AvoidableOverlap& overlap, const std::string& a, const std::string& b) {
    const std::string kept = "a line keeps the disks " + with_unit(overlap.line.gap, "m") + " apart; ";
    switch (overlap.blame) {
        case Blame::a:
            return kept + "the box of " + a + " is to blame";
        case Blame::b:
            return kept + "the box of " + b + " is to blame";
        case Blame::both:
            return kept + "the boxes of " + a + " and " + b + " are to blame";
        case Blame::none:
            break;
    }
    return kept + "no tighter box of its kind would have helped";
}

std::string judged_words(const AvoidableOverlaps& avoidable) {
    return "The first " + std::to_string(avoidable.judged) + " of " + std::to_string(avoidable.overlaps) +
           " overlaps were judged.";
}

std::string blame_words(const BlameInScene& blame, std::size_t queries) {
    return counted(blame.overlaps, "avoidable overlap", "avoidable overlaps") + " in " +
           counted(queries, "query", "queries") +
           (blame.without_blame > 0 ? "; of " + std::to_string(blame.without_blame) + " of them no box is to blame"
                                    : "");
}

std::string step_of(int step, const mobb::Trace& trace) {
    return "step " + std::to_string(step) + " of 0.." + std::to_string(trace.size() - 1);
}

std::string recording_words(const mobb::Trace& trace) {
    if (!trace.stopped()) return "";
    return "recording stopped at event " + std::to_string(trace.size()) + " of " + std::to_string(trace.events());
}

std::string step_sentence(std::span<const DrawnAgent> sides, const mobb::Trace& trace, int step) {
    const mobb::Trace::Event event = trace[step];
    return step_of(step, trace) + ": " + node_name(sides[0], event.a) + " against " + node_name(sides[1], event.b) +
           ": " + outcome_text(sides, event);
}

std::vector<DrawnAgent> with_short_names(std::span<const DrawnAgent> sides, std::size_t most) {
    std::vector<DrawnAgent> out(sides.begin(), sides.end());
    const bool same = sides[0].label == sides[1].label;
    const NameList names({sides[0].label, sides[1].label});
    do {
        const auto fits = [&](const std::string& label) { return code_points(label).size() <= most; };
        for (std::size_t i = 0; i < out.size(); ++i) out[i].label = names.shortened(sides[i].label, fits);
        ++most;
    } while (!same && out[0].label == out[1].label);
    return out;
}

std::vector<std::string> step_sentences(std::span<const DrawnAgent> sides, const mobb::Trace& trace, int step) {
    return {step_sentence(sides, trace, step), step_sentence(with_short_names(sides, kShortName), trace, step)};
}

std::vector<std::string> outcome_sentences(std::span<const DrawnAgent> sides, const mobb::Trace& trace, int step) {
    const std::string number = "step " + std::to_string(step) + ": ";
    std::vector<std::string> out{number + outcome_text(with_short_names(sides, kShortName), trace[step]),
                                 number + outcome_text(with_short_names(sides, kShortestName), trace[step])};
    if (const auto avoidable = avoidable_overlap(sides[0].placed, sides[1].placed, trace[step]))
        out.push_back(number + "avoidable overlap, " + with_unit(avoidable->line.gap, "m"));
    return out;
}

std::string answer_sentence(std::span<const DrawnAgent> sides, const RecordedQuery& recorded) {
    const std::string pair = sides[0].label + " and " + sides[1].label;
    return (recorded.contact ? pair + " collide at " + with_unit(recorded.contact->time, "s")
                             : pair + " never collide") +
           "; " + cost_words(recorded.tests);
}

std::string cost_words(const mobb::TestCounts& tests) {
    std::string text = counted(tests[mobb::TestKind::time], "time test", "time tests");
    for (const mobb::BoxKind kind : mobb::kBoxKinds) {
        const std::string test = std::string(mobb::info(kind).title) + " test";
        if (tests[kind] > 0) text += ", " + counted(tests[kind], test, test + "s");
    }
    return text + ", " + counted(tests[mobb::TestKind::samples], "pair of samples", "pairs of samples");
}

}  // namespace mobbscope
