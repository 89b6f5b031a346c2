#include <render/drawlist/shown_points.h>
#include <render/drawlist/view_projection.h>

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>
#include <utility>

namespace mobbscope {

namespace {

double radians(double degrees) { return degrees * std::numbers::pi / 180.0; }

/// The scene in the camera's directions: x to the right, y up, z towards the eye.
struct CameraExtent {
    glm::vec3 min{0};
    glm::vec3 max{0};
};

glm::vec3 to_camera(const ViewProjection& projection, glm::vec3 p) {
    return {glm::dot(p, projection.right), glm::dot(p, projection.up), glm::dot(p, projection.back)};
}

/// Where the eye stands, in the camera's directions; z is its distance from the plane through the origin.
struct Stand {
    glm::vec3 eye{0};
    float half_height = 1;  ///< of what the frame shows, without perspective
};

Stand fit_orthographic(const CameraExtent& extent, float aspect) {
    const glm::vec3 half = (extent.max - extent.min) * 0.5f;
    const glm::vec3 middle = (extent.max + extent.min) * 0.5f;
    return {{middle.x, middle.y, extent.max.z + 1}, std::max({half.y, half.x / aspect, 1e-6f})};
}

/// Each point p limits the eye: |p.x - eye.x| <= (eye.z - p.z) * tan. Along x the extremes of p.x +/- p.z*tan decide,
/// likewise along y; the direction that needs more distance wins and the other is centred.
Stand fit_perspective(const ViewProjection& projection, const ShownPoints& points, float tan_x, float tan_y,
                      float nearest) {
    const auto most = [&](glm::vec3 along, float tan) { return points.most(along, projection.back, tan); };
    const float right = most(projection.right, tan_x);
    const float left = most(-projection.right, tan_x);
    const float top = most(projection.up, tan_y);
    const float bottom = most(-projection.up, tan_y);
    const float distance = std::max((right + left) / (2 * tan_x), (top + bottom) / (2 * tan_y));
    // Never into the scene, even where it has no width.
    return {{(right - left) / 2, (top - bottom) / 2, std::max(distance, nearest + 1e-3f)}, 1};
}

/// The depths to coarse steps, so that boxes that come and go leave the projection, and with it what has been
/// drawn of the disks, as it is.
void round_outwards(ViewProjection& projection) {
    constexpr float kStepsPerDoubling = 4;
    if (projection.perspective) {
        projection.near_depth =
            std::exp2(std::floor(kStepsPerDoubling * std::log2(projection.near_depth)) / kStepsPerDoubling);
        projection.far_depth =
            std::exp2(std::ceil(kStepsPerDoubling * std::log2(projection.far_depth)) / kStepsPerDoubling);
        return;
    }
    const float step =
        std::exp2(std::floor(std::log2(projection.far_depth - projection.near_depth))) / kStepsPerDoubling;
    projection.near_depth = step * std::floor(projection.near_depth / step);
    projection.far_depth = step * std::ceil(projection.far_depth / step);
}

/// Column-major, to OpenGL's clip space.
glm::mat4 projection_matrix(bool perspective, glm::vec2 scale, float near_depth, float far_depth) {
    glm::mat4 m(0);
    m[0][0] = scale.x;
    m[1][1] = scale.y;
    const float range = far_depth - near_depth;
    if (perspective) {
        m[2][2] = -(far_depth + near_depth) / range;
        m[2][3] = -1;
        m[3][2] = -2 * far_depth * near_depth / range;
    } else {
        m[2][2] = -2 / range;
        m[3][2] = -(far_depth + near_depth) / range;
        m[3][3] = 1;
    }
    return m;
}

glm::mat4 view_matrix(const ViewProjection& projection) {
    glm::mat4 m(1);
    const glm::vec3 rows[3] = {projection.right, projection.up, projection.back};
    for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 3; ++column) m[column][row] = rows[row][column];
        m[3][row] = -glm::dot(rows[row], projection.eye);
    }
    return m;
}

/// Shifts clip space.
glm::mat4 moved_by(glm::vec2 middle) {
    glm::mat4 m(1);
    m[3][0] = middle.x;
    m[3][1] = middle.y;
    return m;
}

}  // namespace

Orientation orientation(const Camera& camera) {
    switch (camera.preset) {
        case CameraPreset::iso:
            return {-52, 24, camera.perspective};
        case CameraPreset::top:
            return {-90, 90, false};
        case CameraPreset::front:
            return {-90, 0, false};
        case CameraPreset::side:
            return {0, 0, false};
        case CameraPreset::free:
            break;
    }
    return {camera.yaw_deg, camera.pitch_deg, camera.perspective};
}

Directions directions(const Camera& camera) {
    const Orientation o = orientation(camera);
    const double yaw = radians(o.yaw_deg);
    const double pitch = radians(o.pitch_deg);
    Directions d;
    d.back = {std::cos(pitch) * std::cos(yaw), std::cos(pitch) * std::sin(yaw), std::sin(pitch)};
    d.right = {-std::sin(yaw), std::cos(yaw), 0};
    d.up = glm::cross(d.back, d.right);
    return d;
}

std::optional<glm::vec2> ViewProjection::project(glm::vec3 point) const {
    const glm::vec4 clip = clip_from_world * glm::vec4(point, 1);
    // The near plane itself is still drawn; rounding must not lose what lies on it.
    if (perspective && clip.w < near_depth * (1 - 1e-4f)) return std::nullopt;
    return glm::vec2{(clip.x / clip.w * 0.5f + 0.5f) * static_cast<float>(size.width),
                     (0.5f - clip.y / clip.w * 0.5f) * static_cast<float>(size.height)};
}

Ray ViewProjection::ray(glm::vec2 pixel) const {
    const glm::dvec2 clip(2.0 * pixel.x / size.width - 1, 1 - 2.0 * pixel.y / size.height);
    const glm::dvec2 across = (clip - glm::dvec2(middle)) / glm::dvec2(scale);
    const glm::dvec3 aside = glm::dvec3(right) * across.x + glm::dvec3(up) * across.y;
    const glm::dvec3 ahead = -glm::dvec3(back);
    if (perspective) return {glm::dvec3(eye), glm::normalize(aside + ahead)};
    return {glm::dvec3(eye) + aside + ahead * static_cast<double>(near_depth), glm::normalize(ahead)};
}

float ViewProjection::depth(glm::vec3 point) const { return glm::dot(eye - point, back); }

float ViewProjection::pixels_per_metre(glm::vec3 point) const {
    const auto here = project(point);
    const auto beside = project(point + right);
    return here && beside ? glm::length(*beside - *here) : 0;
}

ViewProjection make_projection(const Camera& camera, const ShownPoints& points, const glm::vec3* target,
                               PictureSize size) {
    const Directions d = directions(camera);
    ViewProjection projection;
    projection.size = size;
    projection.perspective = orientation(camera).perspective;
    projection.back = glm::vec3(d.back);
    projection.right = glm::vec3(d.right);
    projection.up = glm::cross(projection.back, projection.right);

    const auto extent_along = [&](glm::vec3 way) { return std::pair(-points.most(-way), points.most(way)); };
    CameraExtent extent;
    std::tie(extent.min.z, extent.max.z) = extent_along(projection.back);
    if (!target && !projection.perspective) {
        std::tie(extent.min.x, extent.max.x) = extent_along(projection.right);
        std::tie(extent.min.y, extent.max.y) = extent_along(projection.up);
    }
    const float aspect = static_cast<float>(size.width) / static_cast<float>(size.height);
    const float tan_y = static_cast<float>(std::tan(radians(camera.fov_deg) / 2));
    Stand stand;
    if (target) {
        const float distance = static_cast<float>(camera.distance);
        stand = {to_camera(projection, *target) + glm::vec3(0, 0, distance), distance * tan_y};
    } else if (projection.perspective) {
        stand = fit_perspective(projection, points, tan_y * aspect, tan_y, extent.max.z);
    } else {
        stand = fit_orthographic(extent, aspect);
    }
    projection.eye = projection.right * stand.eye.x + projection.up * stand.eye.y + projection.back * stand.eye.z;

    const float deepest = stand.eye.z - extent.min.z;
    const float margin = std::max(0.01f * (extent.max.z - extent.min.z), 1e-4f * std::abs(deepest) + 1e-6f);
    projection.far_depth = deepest + margin;
    projection.near_depth = stand.eye.z - extent.max.z - margin;
    if (projection.perspective) {
        // An eye inside the scene still needs something in front of it.
        projection.far_depth = std::max(projection.far_depth, 1e-3f);
        projection.near_depth = std::max(projection.near_depth, 1e-3f * projection.far_depth);
    }
    round_outwards(projection);
    projection.scale = projection.perspective ? glm::vec2(1 / (tan_y * aspect), 1 / tan_y)
                                              : glm::vec2(1 / (stand.half_height * aspect), 1 / stand.half_height);
    if (target) projection.middle = 2.0f * glm::vec2(camera.shift);
    projection.clip_from_world =
        moved_by(projection.middle) *
        projection_matrix(projection.perspective, projection.scale, projection.near_depth, projection.far_depth) *
        view_matrix(projection);
    return projection;
}

}  // namespace mobbscope
