#include <base/text.h>
#include <explain/proof_words.h>
#include <explain/query_sentence.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace mobbscope {

namespace {

constexpr double kWorthNaming = 1e-3;  // metres or seconds: less is shown as 0

/// A number that is promised: what is left off makes it less.
std::string promised(double value, const char* unit) {
    const double shown = value < 10 ? 1000 : 100;
    return with_unit(std::floor(value * shown) / shown, unit);
}

std::string result(const Certificate& certificate) {
    if (certificate.contact) return "No contact before " + with_unit(certificate.contact->time, "s") + ".";
    const double gap = std::ranges::min(certificate.tiles, {}, &Tile::gap).gap;
    return gap < kWorthNaming ? "They all but touch, and never collide."
                              : "Never closer than " + promised(gap, "m") + ".";
}

std::string cost(std::span<const TraversalEnd> ends) {
    const auto boxes = std::ranges::count(ends, true, &TraversalEnd::is_boxes);
    const auto runs = std::ssize(ends) - boxes;
    std::string out;
    if (boxes > 0) out = counted(boxes, "box pair", "box pairs");
    if (runs > 0) out += (boxes > 0 ? " and " : "") + counted(runs, "run of samples", "runs of samples");
    return out;
}

}  // namespace

std::vector<TraversalEnd> traversal_ends(const mobb::PlacedTree& a, const mobb::PlacedTree& b,
                                         const mobb::Trace& trace) {
    std::vector<TraversalEnd> out;
    const mobb::PlacedClip &clip_a = a.placed_clip(), &clip_b = b.placed_clip();
    for (int step = 0; step < trace.size(); ++step) {
        const mobb::Trace::Event event = trace[step];
        if (event.outcome == mobb::Outcome::separated) {
            const mobb::Node &of_a = a.tree().node(event.a), &of_b = b.tree().node(event.b);
            out.push_back({std::max(a.begin(of_a), b.begin(of_b)), std::min(a.end(of_a), b.end(of_b)), true, step});
        } else if (!event.pairs.empty()) {
            const mobb::MeasuredPair first = event.pairs.front(), last = event.pairs.back();
            if (out.empty() || out.back().is_boxes)
                out.push_back({std::max(clip_a.time(first.i), clip_b.time(first.j)), 0, false, step});
            out.back().t1 = std::min(clip_a.time(last.i + 1), clip_b.time(last.j + 1));
        }
    }
    return out;
}

std::string proof_words(const Certificate& certificate, std::span<const TraversalEnd> ends) {
    if (certificate.tiles.empty())
        return certificate.contact ? "In contact as soon as both are there." : "They share no time.";
    std::string out = result(certificate) + " Proof: " + counted(certificate.tiles.size(), "line", "lines") + " over " +
                      with_unit(certificate.tiles.back().t1 - certificate.tiles.front().t0, "s");
    if (!ends.empty()) out += "; the trees needed " + cost(ends);
    return out + '.';
}

std::string margin_words(const Margins& margins, const std::string& b) {
    const std::string grow = margins.growth < kWorthNaming ? "Neither radius may grow"
                                                           : "Both radii may grow by " + promised(margins.growth, "m");
    const double seconds = margins.shift_in_time;
    if (std::isinf(seconds)) return grow + "; " + b + " may start at any time.";
    if (seconds < kWorthNaming) return grow + "; " + b + " may start neither earlier nor later.";
    return grow + "; " + b + " may start up to " + promised(seconds, "s") + " earlier or later.";
}

}  // namespace mobbscope
