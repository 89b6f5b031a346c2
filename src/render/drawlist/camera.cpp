#include <render/drawlist/camera.h>
#include <render/drawlist/draw_list.h>
#include <render/drawlist/view_projection.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace mobbscope {

namespace {

constexpr double kPictureMargin = 0.1;  // of the picture, on each side of what it frames

double tan_half_fov(const Camera& camera) { return std::tan(camera.fov_deg * std::numbers::pi / 360); }

double within_reach(double distance) { return std::clamp(distance, kNearest, kFarthest); }

/// What a pixel is wide at the target, with perspective or without.
double metres_per_pixel(const Camera& camera, PictureSize size) {
    return 2 * camera.distance * tan_half_fov(camera) / size.height;
}

/// Across the line of sight, from a way in pixels (right, down).
glm::dvec3 across(const Camera& camera, glm::dvec2 pixels, PictureSize size) {
    const Directions d = directions(camera);
    return (d.right * pixels.x - d.up * pixels.y) * metres_per_pixel(camera, size);
}

}  // namespace

Camera orbited(Camera camera, glm::vec2 pixels, PictureSize size) {
    const double degrees_per_pixel = 180.0 / size.height;
    camera.yaw_deg = std::remainder(camera.yaw_deg - pixels.x * degrees_per_pixel, 360.0);
    camera.pitch_deg = std::clamp(camera.pitch_deg + pixels.y * degrees_per_pixel, -90.0, 90.0);
    return camera;
}

Camera panned(Camera camera, glm::vec2 pixels, PictureSize size) {
    *camera.target -= across(camera, pixels, size);
    return camera;
}

Camera zoomed(Camera camera, double factor, glm::vec2 cursor_pixel, PictureSize size) {
    const glm::dvec2 seen_at =
        (glm::dvec2(0.5) + camera.shift * glm::dvec2(1, -1)) * glm::dvec2(size.width, size.height);
    const glm::dvec3 to_cursor = across(camera, glm::dvec2(cursor_pixel) - seen_at, size);
    const double distance = within_reach(camera.distance / factor);
    *camera.target += to_cursor * (1 - distance / camera.distance);
    camera.distance = distance;
    return camera;
}

Camera framing(const Camera& camera, glm::dvec3 min, glm::dvec3 max, PictureSize size) {
    const Directions d = directions(camera);
    const double tan_y = tan_half_fov(camera) * (1 - 2 * kPictureMargin);
    const double tan_x = tan_y * size.width / size.height;
    double distance = 0;
    for (unsigned corner = 0; corner < 8; ++corner) {
        const glm::dvec3 sign(corner & 1u ? 1 : -1, corner & 2u ? 1 : -1, corner & 4u ? 1 : -1);
        const glm::dvec3 half = 0.5 * (max - min) * sign;
        const double nearer = camera.perspective ? glm::dot(half, d.back) : 0;
        distance = std::max({distance, nearer + std::abs(glm::dot(half, d.right)) / tan_x,
                             nearer + std::abs(glm::dot(half, d.up)) / tan_y});
    }
    Camera out = camera;
    out.target = 0.5 * (min + max);
    out.distance = within_reach(distance);
    out.shift = {0, 0};
    return out;
}

Camera standing_as(Camera camera, const Camera& other) {
    camera.target = other.target;
    camera.distance = other.distance;
    camera.shift = other.shift;
    return camera;
}

Camera without_target(const Camera& camera) { return standing_as(camera, Camera{}); }

Camera between(const Camera& from, const Camera& to, double t) {
    if (t <= 0) return from;
    if (t >= 1) return to;
    Camera out = t < 0.5 ? from : to;
    out.yaw_deg = from.yaw_deg + t * std::remainder(to.yaw_deg - from.yaw_deg, 360.0);
    out.pitch_deg = glm::mix(from.pitch_deg, to.pitch_deg, t);
    out.fov_deg = glm::mix(from.fov_deg, to.fov_deg, t);
    out.target = glm::mix(*from.target, *to.target, t);
    out.distance = from.distance * std::pow(to.distance / from.distance, t);
    out.shift = glm::mix(from.shift, to.shift, t);
    return out;
}

Camera resized(Camera camera, PictureSize from, PictureSize to) {
    camera.distance = within_reach(camera.distance * to.height / from.height);
    return camera;
}

}  // namespace mobbscope
