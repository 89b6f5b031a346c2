#include <crowd/simulation/played_move.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>

namespace mobbscope {

ClipBounds::ClipBounds(const mobb::Clip& clip) : reach_(clip.reach()) {
    const std::array<glm::dvec2, kCorners> corners = mobb::KDop(clip.samples()).coarse_corners();
    for (std::size_t i = 0; i < kCorners; ++i) {
        x_[i] = corners[i].x;
        y_[i] = corners[i].y;
    }
}

FloorRect ClipBounds::bounds(const OrientedPlacement& placed) const {
    // Several corners at a time, as many as compilers put into vector registers. Rounding keeps the order of numbers:
    // what is translated at the end is as if each corner were.
    constexpr std::size_t kLanes = 4;
    constexpr double kFar = std::numeric_limits<double>::infinity();
    std::array<double, kLanes> low_x, low_y, high_x, high_y;
    low_x.fill(kFar);
    low_y.fill(kFar);
    high_x.fill(-kFar);
    high_y.fill(-kFar);
    const auto [c, s] = placed.rotation;
    for (std::size_t i = 0; i < kCorners; i += kLanes) {
        for (std::size_t k = 0; k < kLanes; ++k) {
            const double x = c * x_[i + k] - s * y_[i + k];
            const double y = s * x_[i + k] + c * y_[i + k];
            low_x[k] = x < low_x[k] ? x : low_x[k];
            low_y[k] = y < low_y[k] ? y : low_y[k];
            high_x[k] = x > high_x[k] ? x : high_x[k];
            high_y[k] = y > high_y[k] ? y : high_y[k];
        }
    }
    const glm::dvec2 translate = placed.placement.translate;
    // Far more than all rounding made here and where disks are placed.
    const double margin = 1e-12 * (reach_ + std::abs(translate.x) + std::abs(translate.y));
    const auto least = [](const auto& v) { return std::min(std::min(v[0], v[1]), std::min(v[2], v[3])); };
    const auto most = [](const auto& v) { return std::max(std::max(v[0], v[1]), std::max(v[2], v[3])); };
    const glm::dvec2 low(least(low_x), least(low_y));
    const glm::dvec2 high(most(high_x), most(high_y));
    return {low + translate - margin, high + translate + margin};
}

std::optional<FloorRect> bounds_on_floor(const PlayableClip& clip, const OrientedPlacement& at, glm::dvec2 area) {
    const glm::dvec2 wall = area / 2.0;
    const auto is_over = [&](const mobb::Disk& disk) { return is_over_wall(disk, at, area); };
    // From the end, as there a move that began on the floor has left it: most that leave it need no more.
    if (is_over(clip.last)) return std::nullopt;
    const FloorRect bounds = clip.bounds.bounds(at);
    const bool is_within =
        bounds.low.x >= -wall.x && bounds.low.y >= -wall.y && bounds.high.x <= wall.x && bounds.high.y <= wall.y;
    if (is_within) return bounds;
    const std::span<const mobb::Disk> disks = clip.clip().samples();
    return std::any_of(disks.rbegin(), disks.rend(), is_over) ? std::nullopt : std::optional(bounds);
}

}  // namespace mobbscope
