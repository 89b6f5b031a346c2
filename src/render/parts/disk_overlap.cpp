#include <mobb/predicate.h>
#include <render/parts/disk_overlap.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace mobbscope {

DiskOverlap disk_overlap(const mobb::Disk& a, const mobb::Disk& b, int rows) {
    DiskOverlap out;
    if (!mobb::collide(a, b)) return out;
    const glm::dvec2 from(a.x, a.y);
    const glm::dvec2 way = glm::dvec2(b.x, b.y) - from;
    const double distance = std::sqrt(mobb::squared_distance(a, b));
    const glm::dvec2 along = distance > 0 ? way / distance : glm::dvec2(1, 0);
    const glm::dvec2 across(-along.y, along.x);
    // Half of what the overlap covers across: the smaller disk's radius, unless the circles cross nearer than that.
    double half = std::min(a.r, b.r);
    if (distance > 0) {
        const double foot = (distance * distance + a.r * a.r - b.r * b.r) / (2 * distance);
        const double square = a.r * a.r - foot * foot;
        out.has_tips = square > 0;
        // Where the crossing lies beyond the middle of the smaller disk, that disk is widest before it.
        if (square > 0 && foot > 0 && foot < distance) half = std::sqrt(square);
    }
    for (int i = 0; i < rows; ++i) {
        // Closer together towards the ends, where the outlines turn.
        const double v = -half * std::cos(std::numbers::pi * i / (rows - 1));
        const double reach_a = std::sqrt(std::max(a.r * a.r - v * v, 0.0));
        const double reach_b = std::sqrt(std::max(b.r * b.r - v * v, 0.0));
        const double left = std::max(-reach_a, distance - reach_b);
        const double right = std::max(std::min(reach_a, distance + reach_b), left);
        out.sides[0].push_back(from + along * left + across * v);
        out.sides[1].push_back(from + along * right + across * v);
    }
    return out;
}

}  // namespace mobbscope
