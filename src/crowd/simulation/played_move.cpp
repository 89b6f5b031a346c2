#include <crowd/simulation/played_move.h>

#include <glm/common.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

namespace mobbscope {

FloorRect ClipBounds::bounds(const OrientedPlacement& placed) const {
    const glm::dvec2 translate = placed.placement.translate;
    FloorRect rect{glm::dvec2(std::numeric_limits<double>::infinity()),
                   glm::dvec2(-std::numeric_limits<double>::infinity())};
    for (const glm::dvec2 corner : corners_) {
        const glm::dvec2 at = placed.rotation(corner) + translate;
        rect.low = glm::min(rect.low, at);
        rect.high = glm::max(rect.high, at);
    }
    // Far more than all rounding made here and where disks are placed.
    const double margin = 1e-12 * (reach_ + std::abs(translate.x) + std::abs(translate.y));
    rect.low -= margin;
    rect.high += margin;
    return rect;
}

bool leaves_floor(const mobb::Clip& clip, const OrientedPlacement& at, const FloorRect& bounds, glm::dvec2 area) {
    const glm::dvec2 wall = area / 2.0;
    if (bounds.low.x >= -wall.x && bounds.low.y >= -wall.y && bounds.high.x <= wall.x && bounds.high.y <= wall.y)
        return false;
    const auto is_over = [&](const mobb::Disk& disk) {
        const mobb::Disk there = mobb::placed(disk, at.rotation, at.placement.translate);
        return std::abs(there.x) + there.r > wall.x || std::abs(there.y) + there.r > wall.y;
    };
    // From the end, as there a move that began on the floor has left it.
    const std::span<const mobb::Disk> disks = clip.samples();
    return std::any_of(disks.rbegin(), disks.rend(), is_over);
}

}  // namespace mobbscope
