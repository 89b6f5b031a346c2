#include <base/strong_components.h>
#include <scene/motion_graph.h>

#include <cmath>
#include <numbers>
#include <utility>

namespace mobbscope {

double heading_of(glm::dvec2 way) { return std::atan2(way.y, way.x) * 180 / std::numbers::pi; }

mobb::Placement following(const mobb::Placement& before, const Stance& exit, double duration, const Stance& entry) {
    mobb::Placement next;
    // Headings add up over a long walk: kept within a turn, they stay exact.
    next.rotate_deg = std::remainder(before.rotate_deg + exit.heading_deg - entry.heading_deg, 360.0);
    const glm::dvec2 joint = mobb::Rotation::from_degrees(before.rotate_deg)(exit.position) + before.translate;
    next.translate = joint - mobb::Rotation::from_degrees(next.rotate_deg)(entry.position);
    next.start = before.start + duration;
    return next;
}

std::vector<int> hub_components(const MotionGraph& graph) {
    std::vector<std::pair<int, int>> edges;
    for (const GraphMove& move : graph.moves) edges.emplace_back(move.from, move.to);
    return strong_components(static_cast<int>(graph.hubs.size()), edges);
}

}  // namespace mobbscope
