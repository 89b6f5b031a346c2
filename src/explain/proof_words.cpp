#include <base/text.h>
#include <explain/proof_words.h>
#include <explain/query_sentence.h>
#include <import/clip/sample_times.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace mobbscope {

namespace {

constexpr double kWorthNaming = 1e-3;  // metres or seconds: less is shown as 0

std::string result(const Certificate& certificate) {
    if (certificate.contact) return "No contact before " + with_unit(certificate.contact->time, "s") + ".";
    const double gap = std::ranges::min(certificate.tiles, {}, &Tile::gap).gap;
    return gap < kWorthNaming ? "They never collide." : "Proven bound: at least " + proven_words(gap, "m") + " apart.";
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

std::string proof_words(const Certificate& certificate, std::span<const TraversalEnd> ends) {
    if (certificate.tiles.empty())
        return certificate.contact ? "In contact as soon as both are there." : "They share no time.";
    std::string out = result(certificate) + " Proof: " + counted(certificate.tiles.size(), "line", "lines") + " over " +
                      with_unit(certificate.tiles.back().t1 - certificate.tiles.front().t0, "s");
    if (!ends.empty()) out += "; the trees needed " + cost(ends);
    return out + '.';
}

std::string doubt_words(const std::string& name_a, const mobb::PlacedClip& a, const std::string& name_b,
                        const mobb::PlacedClip& b) {
    std::string out;
    for (const auto& [name, clip] : {std::pair(&name_a, &a), std::pair(&name_b, &b)}) {
        const std::string doubt = coarse_times(clip->clip(), clip->placement().start);
        if (!doubt.empty()) out += (out.empty() ? "" : "; ") + *name + ": " + doubt;
    }
    return out;
}

std::string margin_words(const Margins& margins, const std::string& b) {
    const std::string grow = margins.growth < kWorthNaming
                                 ? "Nothing is proven of larger radii"
                                 : "Both radii may grow by " + proven_words(margins.growth, "m");
    const double seconds = margins.shift_in_time;
    if (std::isinf(seconds)) return grow + "; " + b + " may start at any time.";
    if (seconds < kWorthNaming) return grow + "; nothing is proven of other starts of " + b + ".";
    return grow + "; " + b + " may start up to " + proven_words(seconds, "s") + " earlier or later.";
}

}  // namespace mobbscope
