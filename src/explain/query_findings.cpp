#include <base/text.h>
#include <explain/query_findings.h>
#include <explain/query_sentence.h>

#include <utility>

namespace mobbscope {

namespace {

/// Where two neighbours in time touch, rounding is no gap.
constexpr double kTouching = 1e-9;

std::string no_common_time(std::span<const DrawnAgent> sides) {
    const DrawnAgent* first = &sides[0];
    const DrawnAgent* second = &sides[1];
    if (second->end() < first->end()) std::swap(first, second);
    const double gap = second->begin() - first->end();
    if (gap <= kTouching) return "They share no time: " + second->label + " begins when " + first->label + " ends.";
    return "They share no time: " + second->label + " begins " + with_unit(gap, "s") + " after " + first->label +
           " ends.";
}

std::string on_the_floor(std::span<const DrawnAgent> sides, const mobb::FloorPaths& floor) {
    if (!floor.meeting) {
        return "Their paths stay " + with_unit(floor.apart, "m") + " apart on the floor, whatever the time.";
    }
    const DrawnAgent& first = sides[floor.meeting->a_first ? 0 : 1];
    const DrawnAgent& second = sides[floor.meeting->a_first ? 1 : 0];
    if (floor.meeting->gap <= kTouching) {
        return "Their paths cross on the floor, but not in time: " + second.label + " comes the moment " + first.label +
               " leaves.";
    }
    return "Their paths cross on the floor, but not in time: at the closest, " + second.label + " comes " +
           with_unit(floor.meeting->gap, "s") + " after " + first.label + " has gone.";
}

}  // namespace

QueryFindings find_out(const FittedScene& fitted, const ViewState& view, const RecordedQuery& recorded) {
    QueryFindings out;
    out.sides = drawn_agents(fitted, view);
    const mobb::PlacedTree& a = out.sides[0].placed;
    const mobb::PlacedTree& b = out.sides[1].placed;
    out.clearance = clearance_over_time(a.placed_clip(), b.placed_clip());
    if (!out.clearance.contact) out.floor = mobb::floor_paths(a.placed_clip(), b.placed_clip());
    out.recursion = recursion_of(recorded.trace, a, b);
    out.proof = proof_of(fitted, fitted.queries()[static_cast<std::size_t>(*view.query)], recorded, out.clearance);
    return out;
}

std::string answer_words(std::span<const DrawnAgent> sides, const Clearance& clearance) {
    if (!clearance.contact) return sides[0].label + " and " + sides[1].label + " never collide";
    return "They collide at " + with_unit(clearance.contact_time, "s");
}

std::vector<std::string> why_words(std::span<const DrawnAgent> sides, const Clearance& clearance,
                                   const mobb::FloorPaths& floor) {
    std::vector<std::string> out;
    if (clearance.contact) {
        const ClearancePiece& piece = clearance.pieces[*clearance.contact];
        out.push_back("Sample " + std::to_string(piece.a_sample) + " of " + sides[0].label + " and sample " +
                      std::to_string(piece.b_sample) + " of " + sides[1].label + " overlap by " +
                      overlap_words(sides[0].clip(), sides[1].clip(), piece.a_sample, piece.b_sample) + ".");
        const ClearancePiece& deepest = clearance.pieces[*clearance.least];
        if (*clearance.least != *clearance.contact) {
            out.push_back("Deepest at " + with_unit(deepest.least_at, "s") + ": " + with_unit(-deepest.clearance, "m") +
                          ".");
        }
        return out;
    }
    if (floor.known) out.push_back(on_the_floor(sides, floor));
    if (!clearance.least) {
        out.insert(out.begin(), no_common_time(sides));
    } else {
        const ClearancePiece& nearest = clearance.pieces[*clearance.least];
        out.push_back("They come nearest at " + with_unit(nearest.least_at, "s") + ": " +
                      with_unit(nearest.clearance, "m") + " apart.");
    }
    return out;
}

std::vector<std::string> proof_sentences(const QueryFindings& findings) {
    if (!findings.clearance.least) return {};
    std::vector<std::string> out{proof_words(findings.proof.certificate, findings.proof.ends)};
    if (findings.proof.margins) out.push_back(margin_words(*findings.proof.margins, findings.sides[1].label));
    const std::span<const DrawnAgent> sides = findings.sides;
    std::string doubt = doubt_words(sides[0].label, sides[0].clip(), sides[1].label, sides[1].clip());
    if (!doubt.empty()) out.push_back(std::move(doubt) + '.');
    return out;
}

std::int64_t direct_pairs(const Clearance& clearance) {
    return static_cast<std::int64_t>(clearance.contact ? *clearance.contact + 1 : clearance.pieces.size());
}

std::string gain_words(const mobb::TestCounts& tests, const Clearance& clearance) {
    const std::int64_t pairs = direct_pairs(clearance);
    const std::int64_t all = tests.all();
    std::string out = "The direct search would measure " + counted(pairs, "pair", "pairs") + " of samples; this took " +
                      counted(all, "test", "tests");
    if (all > 0 && pairs > all) {
        return out + ", " + figure(static_cast<double>(pairs) / static_cast<double>(all), 3) + " times fewer.";
    }
    return out + (pairs == all ? ", as many." : ": here the trees gain nothing.");
}

}  // namespace mobbscope
