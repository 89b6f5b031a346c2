#include <render/drawlist/pen.h>
#include <render/layout/framing.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <numbers>
#include <optional>
#include <set>

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

/// Whether some of the convex hull of the points is seen in a panel: no line keeps the two apart. All points lie before
/// the eye.
bool covers(const Rect& panel, const ShownPoints& points, const ViewProjection& projection) {
    constexpr int kWays = 32;
    const glm::vec2 size(projection.size.width, projection.size.height);
    const glm::mat4 rows = glm::transpose(projection.clip_from_world);
    for (int i = 0; i < kWays; ++i) {
        const glm::vec2 way(on_circle<double>(i, kWays));
        const glm::vec2 nearest(way.x > 0 ? panel.min.x : panel.max.x, way.y > 0 ? panel.min.y : panel.max.y);
        // Of a point times its w: how much farther that way it is seen than the panel begins.
        const glm::vec4 beyond = 0.5f * way.x * size.x * (rows[3] + rows[0]) +
                                 0.5f * way.y * size.y * (rows[3] - rows[1]) - glm::dot(way, nearest) * rows[3];
        if (points.most(glm::vec3(beyond)) + beyond.w <= 0) return false;
    }
    return true;
}

/// The camera that `fit` makes for the whole picture, if no panel covers the points there; else for the free part where
/// it stands nearest.
template <class Fit>
Camera fit_beside(PictureSize size, std::span<const Rect> panels, const ShownPoints& points, const DrawnSpace& space,
                  const Fit& fit) {
    constexpr double kMostTimesFarther = 2;
    const Camera whole = fit(Rect{glm::vec2(0), glm::vec2(size.width, size.height)});
    const glm::vec3 target = space.from_target(*whole.target);
    const ViewProjection projection = make_projection(whole, points, &target, size);
    if (std::ranges::none_of(panels, [&](const Rect& panel) { return covers(panel, points, projection); }))
        return whole;
    std::optional<Camera> best;
    for (const Rect& part : free_parts(size, panels)) {
        const Camera there = fit(part);
        if (!best || there.distance < best->distance) best = there;
    }
    return best && best->distance <= kMostTimesFarther * whole.distance ? *best : whole;
}

/// How far the middle of a part is from that of the picture, as Camera::shift has it.
glm::dvec2 shift_to(const Rect& part, PictureSize size) {
    return (glm::dvec2(part.center()) / glm::dvec2(size.width, size.height) - 0.5) * glm::dvec2(1, -1);
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
    for (const DrawnAgent& agent : agents) {
        for (const mobb::PlacedClip& path : agent.paths()) add_samples(bounds, path, {0, path.count()});
    }
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

std::vector<Rect> free_parts(PictureSize size, std::span<const Rect> panels) {
    const Rect all{{0, 0}, glm::vec2(size.width, size.height)};
    std::array<std::set<float>, 4> sides{{{all.min.x}, {all.min.y}, {all.max.x}, {all.max.y}}};
    for (const Rect& panel : panels) {
        sides[0].insert(std::ceil(panel.max.x));
        sides[1].insert(std::ceil(panel.max.y));
        sides[2].insert(std::floor(panel.min.x));
        sides[3].insert(std::floor(panel.min.y));
    }
    std::vector<Rect> free;
    for (const float left : sides[0]) {
        for (const float top : sides[1]) {
            for (const float right : sides[2]) {
                for (const float bottom : sides[3]) {
                    const Rect part{{left, top}, {right, bottom}};
                    if (left >= right || top >= bottom || !all.contains(part)) continue;
                    if (std::ranges::none_of(panels, [&](const Rect& panel) { return panel.overlaps(part); }))
                        free.push_back(part);
                }
            }
        }
    }
    std::vector<Rect> out;
    std::ranges::copy_if(free, std::back_inserter(out), [&](const Rect& part) {
        return std::ranges::none_of(free, [&](const Rect& o) { return &o != &part && o.contains(part); });
    });
    return out;
}

std::vector<Rect> united(std::span<const Rect> panels) {
    std::vector<Rect> out;
    for (Rect one : panels) {
        for (auto other = out.begin(); other != out.end();) {
            if (!other->overlaps(one)) {
                ++other;
                continue;
            }
            one = {glm::min(one.min, other->min), glm::max(one.max, other->max)};
            out.erase(other);
            other = out.begin();
        }
        out.push_back(one);
    }
    return out;
}

Camera framed_camera(const Camera& camera, const ShownPoints& points, const DrawnSpace& space, PictureSize size,
                     std::span<const Rect> panels, double margin) {
    const Orientation seen = orientation(camera);
    Camera out = camera;
    out.preset = CameraPreset::free;
    out.yaw_deg = seen.yaw_deg;
    out.pitch_deg = seen.pitch_deg;
    out.perspective = seen.perspective;
    if (camera.target) return out;
    const glm::dvec3 middle = middle_of(points);
    const auto fit = [&](const Rect& part) {
        // Half of what the height of the part shows is tangent * distance; the points fill it without the margin.
        const PictureSize there{static_cast<int>(part.size().x), static_cast<int>(part.size().y)};
        const double tangent = std::tan(camera.fov_deg * kDegree / 2) * there.height / size.height;
        Camera within = out;
        within.fov_deg = 2 * std::atan(tangent / (1 + margin)) / kDegree;
        const ViewProjection fitted = make_projection(within, points, nullptr, there);
        const glm::dvec3 back(fitted.back);
        const double depth = glm::dot(glm::dvec3(fitted.eye) - middle, back);
        Camera fits = out;
        fits.target = space.to_target(glm::dvec3(fitted.eye) - back * depth);
        fits.distance = seen.perspective ? depth : (1 + margin) / static_cast<double>(fitted.scale.y) / tangent;
        fits.shift = shift_to(part, size);
        return fits;
    };
    return fit_beside(size, panels, points, space, fit);
}

Camera turning_camera(const Camera& camera, const ShownPoints& points, const DrawnSpace& space, PictureSize size,
                      std::span<const Rect> panels) {
    const Camera seen = framed_camera(camera, points, space, size);
    if (camera.target) return seen;
    const double cosine = std::cos(seen.pitch_deg * kDegree);
    const double sine = std::sin(seen.pitch_deg * kDegree);
    const double near = seen.perspective ? 1 : 0;  // what comes nearer grows

    // All points lie in an upright cylinder about the axis of the turn.
    const glm::dvec3 middle = middle_of(points);
    const double reach = reach_around(points, middle);
    const double high = static_cast<double>(points.most({0, 0, 1})) - middle.z;
    constexpr int kCorners = 32;
    ShownPoints around;
    for (int i = 0; i < kCorners; ++i) {
        const glm::dvec2 corner = reach / std::cos(std::numbers::pi / kCorners) * on_circle<double>(i, kCorners);
        for (const double height : {-high, high}) around.add(glm::vec3(middle + glm::dvec3(corner, height)));
    }
    const auto fit = [&](const Rect& part) {
        // Half of what the part shows at the target without its margin, in distances to it.
        const double half_of_all = std::tan(seen.fov_deg * kDegree / 2) / (1 + kFrameMargin) / size.height;
        const double half_x = half_of_all * static_cast<double>(part.size().x);
        const double half_y = half_of_all * static_cast<double>(part.size().y);
        // Of the cylinder's rims each needs the eye this far from the middle, for the part's upper and lower edge and
        // its sides.
        double top = 0, bottom = 0, sides = 0;
        for (const double height : {-high, high}) {
            top = std::max(top,
                           height * (cosine / half_y + near * sine) + reach * std::abs(near * cosine - sine / half_y));
            bottom = std::max(
                bottom, -height * (cosine / half_y - near * sine) + reach * std::abs(near * cosine + sine / half_y));
            sides = std::max(sides, reach * std::hypot(1 / half_x, near * cosine) + near * height * sine);
        }
        // The target goes up the axis until above and below need the same.
        const double up = cosine > 1e-6 ? std::clamp((top - bottom) * half_y / (2 * cosine), -high, high) : 0;
        Camera fits = seen;
        fits.distance = std::max({top - up * (cosine / half_y + near * sine),
                                  bottom + up * (cosine / half_y - near * sine), sides - up * near * sine, 1e-3});
        fits.target = space.to_target(middle + glm::dvec3(0, 0, up));
        fits.shift = shift_to(part, size);
        return fits;
    };
    return fit_beside(size, panels, around, space, fit);
}

void project(PictureFrame& frame, const ShownPoints& points) {
    const glm::vec3 target = frame.space.from_target(*frame.camera.target);
    frame.projection = make_projection(frame.camera, points, &target, frame.size);
}

}  // namespace mobbscope
