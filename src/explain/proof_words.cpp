#include <base/text.h>
#include <explain/proof_words.h>
#include <explain/query_sentence.h>

#include <algorithm>
#include <cmath>

namespace mobbscope {

namespace {

constexpr double kWorthNaming = 1e-3;  // metres or seconds: less is shown as 0

/// A number that is promised: what is left off makes it less, but for what rounding took from it.
std::string promised(double value, const char* unit) {
    const double shown = value < 10 ? 1000 : 100;
    return with_unit(std::floor((value + 1e-9) * shown) / shown, unit);
}

std::string result(const Certificate& certificate) {
    if (certificate.contact) return "No contact before " + with_unit(certificate.contact->time, "s") + ".";
    const double gap = std::ranges::min(certificate.tiles, {}, &Tile::gap).gap;
    return gap < kWorthNaming ? "They never collide." : "Proven bound: at least " + promised(gap, "m") + " apart.";
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

std::string margin_words(const Margins& margins, const std::string& b) {
    const std::string grow = margins.growth < kWorthNaming ? "Nothing is proven of larger radii"
                                                           : "Both radii may grow by " + promised(margins.growth, "m");
    const double seconds = margins.shift_in_time;
    if (std::isinf(seconds)) return grow + "; " + b + " may start at any time.";
    if (seconds < kWorthNaming) return grow + "; nothing is proven of other starts of " + b + ".";
    return grow + "; " + b + " may start up to " + promised(seconds, "s") + " earlier or later.";
}

}  // namespace mobbscope
