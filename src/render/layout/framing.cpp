#include <render/layout/framing.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace mobbscope {

namespace {

/// The middle of the points' bounds.
glm::dvec3 middle_of(const ShownPoints& points) {
    const auto along = [&](glm::vec3 way) {
        return 0.5 * (static_cast<double>(points.most(way)) - static_cast<double>(points.most(-way)));
    };
    return {along({1, 0, 0}), along({0, 1, 0}), along({0, 0, 1})};
}

/// How far from a vertical axis the points reach, metres; a little more than they do.
double reach_around(const ShownPoints& points, glm::dvec3 axis) {
    constexpr int kWays = 32;
    double reach = 0;
    for (int i = 0; i < kWays; ++i) {
        const double angle = 2 * std::numbers::pi * i / kWays;
        const glm::dvec3 way(std::cos(angle), std::sin(angle), 0);
        reach = std::max(reach, static_cast<double>(points.most(glm::vec3(way))) - glm::dot(way, axis));
    }
    return reach / std::cos(std::numbers::pi / kWays);
}

}  // namespace

void Bounds::add(glm::dvec3 p) {
    min = glm::min(min, p);
    max = glm::max(max, p);
}

void add_samples(Bounds& bounds, const mobb::PlacedClip& clip, mobb::SampleRange range) {
    for (int i = range.first; i < range.end(); ++i) {
        const mobb::Disk disk = clip.disk(i);
        bounds.add({disk.x - disk.r, disk.y - disk.r, clip.time(i)});
        const mobb::Disk at_end = clip.disk_at_end(i);
        bounds.add({disk.x + disk.r, disk.y + disk.r, clip.time(i)});
        bounds.add({at_end.x - at_end.r, at_end.y - at_end.r, clip.time(i + 1)});
        bounds.add({at_end.x + at_end.r, at_end.y + at_end.r, clip.time(i + 1)});
    }
}

Bounds bounds_of(std::span<const DrawnAgent> agents) {
    Bounds bounds;
    for (const DrawnAgent& agent : agents) add_samples(bounds, agent.clip(), {0, agent.clip().count()});
    return bounds;
}

DrawnSpace space_for(const Bounds& bounds, const ViewState& view) {
    DrawnSpace space;
    const glm::dvec3 extent = bounds.max - bounds.min;
    space.origin = {0.5 * (bounds.min.x + bounds.max.x), 0.5 * (bounds.min.y + bounds.max.y), bounds.min.z};
    // A point that stands still has no width to match.
    const double wide = std::max({extent.x, extent.y, 1e-3});
    space.time_height = view.time_height > 0 ? view.time_height : wide / extent.z;
    return space;
}

void add_floor_points(ShownPoints& points, const DrawnSpace& space, const FloorExtent& floor_extent,
                      const ViewState& view, bool has_cursor) {
    const std::vector<glm::vec3> corners = floor_corners(floor_extent, space);
    if (view.floor || has_cursor || points.empty()) points.add(std::span(corners).first(has_cursor ? 8 : 4));
    if (!view.time_axis) return;
    const glm::dvec2 foot = axis_corner(floor_extent, glm::vec3(directions(view.camera).right));
    for (const double t : {floor_extent.t0, floor_extent.t1}) points.add(space.point(foot.x, foot.y, t));
}

Camera framed_camera(const Camera& camera, const ShownPoints& points, const DrawnSpace& space, PictureSize size,
                     double margin, int free_top) {
    const Orientation seen = orientation(camera);
    Camera out = camera;
    out.preset = CameraPreset::free;
    out.yaw_deg = seen.yaw_deg;
    out.pitch_deg = seen.pitch_deg;
    out.perspective = seen.perspective;
    if (camera.target) return out;

    // Half of what the height below the top shows is tangent * distance; the points fill it without the margin.
    const PictureSize below{size.width, size.height - free_top};
    const double part = static_cast<double>(below.height) / size.height;
    const double tangent = std::tan(camera.fov_deg * kDegree / 2) * part;
    Camera within = out;
    within.fov_deg = 2 * std::atan(tangent / (1 + margin)) / kDegree;
    const ViewProjection fitted = make_projection(within, points, nullptr, below);
    const glm::dvec3 back(fitted.back);
    const double depth = glm::dot(glm::dvec3(fitted.eye) - middle_of(points), back);
    out.target = space.to_target(glm::dvec3(fitted.eye) - back * depth);
    out.distance = seen.perspective ? depth : (1 + margin) / static_cast<double>(fitted.scale.y) / tangent;
    if (free_top > 0) out.shift.y = -0.5 * free_top / size.height;
    return out;
}

Camera turning_camera(const Camera& camera, const ShownPoints& points, const DrawnSpace& space, PictureSize size,
                      int free_top) {
    Camera out = framed_camera(camera, points, space, size, kFrameMargin, free_top);
    if (camera.target) return out;
    // Half of what the picture shows at the target without its margin, in distances to it.
    const double half_of_all = std::tan(out.fov_deg * kDegree / 2) / (1 + kFrameMargin);
    const double half_x = half_of_all * size.width / size.height;
    const double half_y = half_of_all * (static_cast<double>(size.height - free_top) / size.height);
    const double cosine = std::cos(out.pitch_deg * kDegree);
    const double sine = std::sin(out.pitch_deg * kDegree);
    const double near = out.perspective ? 1 : 0;  // what comes nearer grows

    // All points lie in an upright cylinder about the axis of the turn. Of its rims each needs the eye this far from
    // the middle, for the picture's upper and lower edge and its sides.
    const glm::dvec3 middle = middle_of(points);
    const double reach = reach_around(points, middle);
    const double high = static_cast<double>(points.most({0, 0, 1})) - middle.z;
    double top = 0, bottom = 0, sides = 0;
    for (const double height : {-high, high}) {
        top = std::max(top, height * (cosine / half_y + near * sine) + reach * std::abs(near * cosine - sine / half_y));
        bottom = std::max(bottom,
                          -height * (cosine / half_y - near * sine) + reach * std::abs(near * cosine + sine / half_y));
        sides = std::max(sides, reach * std::hypot(1 / half_x, near * cosine) + near * height * sine);
    }
    // The target goes up the axis until above and below need the same.
    const double up = cosine > 1e-6 ? std::clamp((top - bottom) * half_y / (2 * cosine), -high, high) : 0;
    out.distance = std::max({top - up * (cosine / half_y + near * sine), bottom + up * (cosine / half_y - near * sine),
                             sides - up * near * sine, 1e-3});
    out.target = space.to_target(middle + glm::dvec3(0, 0, up));
    return out;
}

void project(PictureFrame& frame, const ShownPoints& points) {
    const glm::vec3 target = frame.space.from_target(*frame.camera.target);
    frame.projection = make_projection(frame.camera, points, &target, frame.size);
}

}  // namespace mobbscope
