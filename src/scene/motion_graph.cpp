#include <scene/motion_graph.h>

#include <cmath>

namespace mobbscope {

mobb::Placement following(const mobb::Placement& before, const Stance& exit, double duration, const Stance& entry) {
    mobb::Placement next;
    // Headings add up over a long walk: kept within a turn, they stay exact.
    next.rotate_deg = std::remainder(before.rotate_deg + exit.heading_deg - entry.heading_deg, 360.0);
    const glm::dvec2 joint = mobb::Rotation::from_degrees(before.rotate_deg)(exit.position) + before.translate;
    next.translate = joint - mobb::Rotation::from_degrees(next.rotate_deg)(entry.position);
    next.start = before.start + duration;
    return next;
}

}  // namespace mobbscope
