#include <render/drawlist/draw_list.h>
#include <render/drawlist/resolve_camera.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace mobbscope {

namespace {

/// The middle of what is drawn of paths and boxes.
glm::dvec3 middle_of(const DrawList& list) {
    glm::vec3 min(std::numeric_limits<float>::max());
    glm::vec3 max(std::numeric_limits<float>::lowest());
    const auto add = [&](glm::vec3 low, glm::vec3 high) {
        min = glm::min(min, low);
        max = glm::max(max, high);
    };
    for (const DiskInstance& disk : list.disks) {
        const glm::vec3 around(disk.radius, disk.radius, 0);
        add(disk.base - around, disk.base + around + glm::vec3(0, 0, disk.height));
    }
    for (const BoxInstance& box : list.boxes) {
        for (const glm::vec3& corner : box_corners(box)) add(corner, corner);
    }
    return min.x <= max.x ? 0.5 * (glm::dvec3(min) + glm::dvec3(max)) : glm::dvec3(0);
}

}  // namespace

Camera resolved_camera(const Camera& camera, const DrawList& list) {
    return resolved_camera(camera, list.projection, list.space, middle_of(list));
}

Camera resolved_camera(const Camera& camera, const ViewProjection& projection, const DrawnSpace& space,
                       glm::dvec3 middle) {
    const Orientation o = orientation(camera);
    Camera out = camera;
    out.preset = CameraPreset::free;
    out.yaw_deg = o.yaw_deg;
    out.pitch_deg = o.pitch_deg;
    out.perspective = o.perspective;
    if (camera.target) return out;

    const glm::dvec3 back(projection.back);
    const double depth = glm::dot(glm::dvec3(projection.eye) - middle, back);
    out.target = space.to_target(glm::dvec3(projection.eye) - back * depth);
    out.shift = 0.5 * glm::dvec2(projection.middle);
    // Half of what the picture's height shows is tan(fov / 2) * distance.
    const double half_height = 1 / static_cast<double>(projection.scale.y);
    if (o.perspective) {
        out.distance = depth;
        out.fov_deg = std::min(2 * std::atan(half_height) / kDegree, kMostFov);
    } else {
        out.distance = half_height / std::tan(camera.fov_deg * kDegree / 2);
    }
    return out;
}

}  // namespace mobbscope
