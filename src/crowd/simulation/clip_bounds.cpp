#include <crowd/simulation/clip_bounds.h>

#include <glm/common.hpp>

#include <cmath>
#include <limits>

namespace mobbscope {

FloorRect ClipBounds::bounds(const mobb::Placement& placement) const {
    const mobb::Rotation rotation = mobb::Rotation::from_degrees(placement.rotate_deg);
    FloorRect rect{glm::dvec2(std::numeric_limits<double>::infinity()),
                   glm::dvec2(-std::numeric_limits<double>::infinity())};
    for (const glm::dvec2 corner : corners_) {
        const glm::dvec2 at = rotation(corner) + placement.translate;
        rect.low = glm::min(rect.low, at);
        rect.high = glm::max(rect.high, at);
    }
    // Far more than all rounding made here and where disks are placed.
    const double margin = 1e-12 * (reach_ + std::abs(placement.translate.x) + std::abs(placement.translate.y));
    rect.low -= margin;
    rect.high += margin;
    return rect;
}

bool leaves_floor(const mobb::PlacedClip& clip, const ClipBounds& clip_bounds, glm::dvec2 area) {
    const glm::dvec2 wall = area / 2.0;
    const FloorRect rect = clip_bounds.bounds(clip.placement());
    if (rect.low.x >= -wall.x && rect.low.y >= -wall.y && rect.high.x <= wall.x && rect.high.y <= wall.y) return false;
    for (int i = 0; i < clip.count(); ++i) {
        const mobb::Disk disk = clip.disk(i);
        if (std::abs(disk.x) + disk.r > wall.x || std::abs(disk.y) + disk.r > wall.y) return true;
    }
    return false;
}

}  // namespace mobbscope
