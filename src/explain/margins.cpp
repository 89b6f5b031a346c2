#include <explain/margins.h>

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>

namespace mobbscope {

namespace {

constexpr double kRoundingUnit = std::numeric_limits<double>::epsilon();
constexpr double kForever = std::numeric_limits<double>::infinity();
constexpr double kInset = 1e-12;  // metres that corners of a region stay within it, more than their rounding

double least_gap(const Certificate& certificate) { return std::ranges::min(certificate.tiles, {}, &Tile::gap).gap; }

std::vector<glm::dvec2> free_region(const Certificate& certificate) {
    if (least_gap(certificate) <= kInset) return {};
    constexpr double kFar = kFarthestShift;
    std::vector<glm::dvec2> out{{-kFar, -kFar}, {kFar, -kFar}, {kFar, kFar}, {-kFar, kFar}};
    for (const Tile& tile : certificate.tiles) out = cut_off(out, -tile.direction, tile.gap - kInset);
    return out;
}

/// Checks the lines of a miss again while B's start shifts.
class ShiftCheck {
  public:
    ShiftCheck(const mobb::PlacedClip& a, const mobb::PlacedClip& b, std::span<const Tile> tiles)
        : a_(a),
          b_(b),
          tiles_(tiles),
          begin_(std::max(a.time(0), b.time(0))),
          end_(std::min(a.time(a.count()), b.time(b.count()))),
          reach_(a.frame().reach + b.frame().reach + length(a) + length(b)) {}

    /// Whether every line holds at all shifts of B's start by up to `most` seconds. If so, also for a smaller `most`.
    bool holds(double most) const {
        for (std::size_t i = 0; i < tiles_.size(); ++i) {
            const bool last = i + 1 == tiles_.size();
            if (!holds(tiles_[i], i == 0 ? begin_ - most : tiles_[i].t0, last ? end_ + most : tiles_[i + 1].t0, most))
                return false;
        }
        return true;
    }

    /// A shift by so much leaves no time that the two share.
    double all_shifts() const { return std::max(a_.time(a_.count()) - b_.time(0), b_.time(b_.count()) - a_.time(0)); }
    /// How far B's rounded times may be from where a shift puts them, seconds.
    double rounding() const {
        return 8 * kRoundingUnit * (std::abs(begin_) + std::abs(end_) + a_.frame().duration + b_.frame().duration);
    }

  private:
    static double length(const mobb::PlacedClip& clip) {
        return std::abs(clip.frame().translate.x) + std::abs(clip.frame().translate.y);
    }

    bool holds(const Tile& tile, double from, double to, double most) const {
        // A is nowhere before its first sample and after its last one.
        from = std::max(from, a_.time(0));
        to = std::min(to, a_.time(a_.count()));
        const double least =
            reach_of_a(tile, from, to) +
            16 * kRoundingUnit * (reach_ + std::abs(tile.speed) * (to - from + std::abs(from - tile.t0)));
        const auto is_beyond = [&](const mobb::SweptDisk& swept, double q) {
            const mobb::Disk disk = swept.at(q);
            // Of the times at which a shift can put it, the one when the line is farthest.
            const double t = tile.speed > 0 ? std::min(to, q + most) : std::max(from, q - most);
            return glm::dot(tile.direction, glm::dvec2(disk.x, disk.y)) - disk.r - tile.speed * (t - tile.t0) >= least;
        };
        // Where a shift brings B's disk to the tile's end, its distance from the line has a corner.
        const double corner = tile.speed > 0 ? to - most : from + most;
        for (int j = mobb::first_ending_after(b_, 0, b_.count(), from - most - rounding()); j < b_.count(); ++j) {
            const mobb::SweptDisk swept = mobb::swept(b_, j);
            if (swept.begin > to + most) break;
            const double first = std::max(swept.begin, from - most), last = std::min(swept.end, to + most);
            if (!is_beyond(swept, first) || !is_beyond(swept, last)) return false;
            if (corner > first && corner < last && !is_beyond(swept, corner)) return false;
        }
        return true;
    }

    /// How far A's disks reach along a tile's direction, seen from its line.
    double reach_of_a(const Tile& tile, double from, double to) const {
        double out = -kForever;
        for (int i = mobb::first_ending_after(a_, 0, a_.count(), from); i < a_.count(); ++i) {
            const mobb::SweptDisk swept = mobb::swept(a_, i);
            if (swept.begin >= to) break;
            for (const double t : {std::max(swept.begin, from), std::min(swept.end, to)}) {
                const mobb::Disk disk = swept.at(t);
                out = std::max(
                    out, glm::dot(tile.direction, glm::dvec2(disk.x, disk.y)) + disk.r - tile.speed * (t - tile.t0));
            }
        }
        return out;
    }

    const mobb::PlacedClip& a_;
    const mobb::PlacedClip& b_;
    std::span<const Tile> tiles_;
    double begin_, end_;  ///< of the time that they share unshifted
    double reach_;        ///< metres, of all coordinates
};

double shift_in_time(const ShiftCheck& check) {
    const double all = check.all_shifts();
    constexpr double kLeast = 1e-6, kPrecise = 1e-6;  // seconds that are worth naming; share of the result
    double holds = 0, fails = kLeast;
    while (fails < all && check.holds(fails)) {
        holds = fails;
        fails *= 2;
    }
    if (holds == 0) return 0;
    if (fails >= all && check.holds(all)) return kForever;
    while (fails - holds > kPrecise * holds) {
        const double middle = 0.5 * (holds + fails);
        (check.holds(middle) ? holds : fails) = middle;
    }
    return std::max(holds - check.rounding(), 0.0);
}

}  // namespace

std::optional<Margins> margins_of(const mobb::PlacedClip& a, const mobb::PlacedClip& b,
                                  const Certificate& certificate) {
    if (certificate.contact || certificate.tiles.empty()) return std::nullopt;
    Margins out;
    out.growth = std::max(0.5 * least_gap(certificate), 0.0);
    out.free_region = free_region(certificate);
    out.bounded = std::ranges::none_of(out.free_region, [](glm::dvec2 corner) {
        return std::max(std::abs(corner.x), std::abs(corner.y)) >= kFarthestShift - kInset;
    });
    out.shift_in_time = shift_in_time(ShiftCheck(a, b, certificate.tiles));
    return out;
}

double room_left(const Certificate& certificate, glm::dvec2 shift) {
    double out = std::numeric_limits<double>::infinity();
    for (const Tile& tile : certificate.tiles) out = std::min(out, tile.gap + glm::dot(tile.direction, shift));
    return out;
}

std::vector<glm::dvec2> cut_off(const std::vector<glm::dvec2>& polygon, glm::dvec2 u, double most) {
    std::vector<glm::dvec2> out;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const glm::dvec2 from = polygon[i], to = polygon[(i + 1) % polygon.size()];
        const double a = glm::dot(u, from) - most, b = glm::dot(u, to) - most;
        if (a <= 0) out.push_back(from);
        if ((a < 0 && b > 0) || (a > 0 && b < 0)) out.push_back(from + a / (a - b) * (to - from));
    }
    return out;
}

}  // namespace mobbscope
