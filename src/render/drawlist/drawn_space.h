/// From space-time to what is drawn: time becomes height.
#pragma once

#include <glm/vec3.hpp>

namespace mobbscope {

/// Maps (x, y, t), metres and global seconds, to drawn metres near the origin. The subtraction happens in double, so
/// that scenes at 10 km and 10^5 s keep their detail in float.
struct DrawnSpace {
    glm::dvec3 origin{0};    ///< x, y in metres, t in seconds
    double time_height = 1;  ///< metres drawn per second, > 0
    glm::dvec3 anchor{0};    ///< x, y, t that the targets of cameras are counted from

    glm::vec3 point(double x, double y, double t) const {
        return glm::vec3(glm::dvec3(x - origin.x, y - origin.y, (t - origin.z) * time_height));
    }
    /// The (x, y, t) that is drawn at a point.
    glm::dvec3 place(glm::dvec3 point) const {
        return {point.x + origin.x, point.y + origin.y, point.z / time_height + origin.z};
    }
    /// Where a camera's target is drawn, and the target that is drawn at a point.
    glm::vec3 from_target(glm::dvec3 target) const {
        return point(target.x + anchor.x, target.y + anchor.y, target.z / time_height + anchor.z);
    }
    glm::dvec3 to_target(glm::dvec3 point) const {
        const glm::dvec3 p = place(point) - anchor;
        return {p.x, p.y, p.z * time_height};
    }
    /// A direction or extent of a box, which is in (x, y, w*t) with w in m/s. A tilted box is sheared by this, as time
    /// is drawn time_height metres a second and not w.
    glm::vec3 extent(glm::dvec3 v, double time_scale) const {
        return glm::vec3(glm::dvec3(v.x, v.y, v.z / time_scale * time_height));
    }
};

}  // namespace mobbscope
