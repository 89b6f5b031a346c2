#include <crowd/simulation/played_move.h>

#include <algorithm>
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

FloorRect ClipBounds::bounds(const mobb::Placement& placed) const {
    // Two corners at a time: compilers leave such a loop of single numbers as it is. Rounding keeps the order of
    // numbers: what is translated at the end is as if each corner were.
    const auto at = [](const std::array<double, kCorners>& values, std::size_t i) {
        return mobb::TwoDoubles{values[i], values[i + 1]};
    };
    constexpr double kFar = std::numeric_limits<double>::infinity();
    mobb::TwoDoubles low_x{kFar, kFar}, low_y = low_x;
    mobb::TwoDoubles high_x = -low_x, high_y = -low_x;
    const auto [c, s] = placed.rotation();
    for (std::size_t i = 0; i < kCorners; i += 2) {
        const mobb::TwoDoubles x = c * at(x_, i) - s * at(y_, i);
        const mobb::TwoDoubles y = s * at(x_, i) + c * at(y_, i);
        low_x = mobb::least(x, low_x);
        low_y = mobb::least(y, low_y);
        high_x = mobb::greatest(x, high_x);
        high_y = mobb::greatest(y, high_y);
    }
    const glm::dvec2 translate = placed.translate;
    // Far more than all rounding made here and where disks are placed.
    const double margin = 1e-12 * (reach_ + std::abs(translate.x) + std::abs(translate.y));
    const glm::dvec2 low(std::min(low_x[0], low_x[1]), std::min(low_y[0], low_y[1]));
    const glm::dvec2 high(std::max(high_x[0], high_x[1]), std::max(high_y[0], high_y[1]));
    return {low + translate - margin, high + translate + margin};
}

std::optional<FloorRect> bounds_on_floor(const PlayableClip& clip, const mobb::Placement& at, glm::dvec2 area) {
    const glm::dvec2 wall = area / 2.0;
    const auto is_over = [&](const mobb::Disk& disk) { return is_over_wall(disk, at, area); };
    // From the end, as there a move that began on the floor has left it: most that leave it need no more.
    if (is_over(clip.last)) return std::nullopt;
    const FloorRect bounds = clip.bounds.bounds(at);
    const bool is_within =
        bounds.low.x >= -wall.x && bounds.low.y >= -wall.y && bounds.high.x <= wall.x && bounds.high.y <= wall.y;
    if (is_within) return bounds;
    // Blocks of disks whose bound is over no wall are left out; the margin is far more than its single precision.
    const mobb::Blocks::Paths blocks = clip.blocks.paths(0);
    const glm::dvec2 origin = clip.blocks.origin();
    const double margin = 1e-6 * (1 + clip.blocks.reach());
    const std::span<const mobb::Disk> disks = clip.clip().samples();
    for (int block = clip.blocks.count(0) - 1; block >= 0; --block) {
        if (!is_over({origin.x + blocks.x()[block], origin.y + blocks.y()[block], blocks.r()[block] + margin}))
            continue;
        const auto of_block = disks.subspan(static_cast<std::size_t>(block) * mobb::Blocks::kSamples);
        if (std::ranges::any_of(of_block.first(std::min<std::size_t>(of_block.size(), mobb::Blocks::kSamples)),
                                is_over))
            return std::nullopt;
    }
    return bounds;
}

}  // namespace mobbscope
