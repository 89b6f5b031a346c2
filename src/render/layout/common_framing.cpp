#include <render/drawlist/camera.h>
#include <render/drawlist/shown_points.h>
#include <render/layout/common_framing.h>
#include <render/layout/framing.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

namespace mobbscope {

namespace {

constexpr std::size_t kFewPoints = 10'000;

Bounds extent_of(const std::vector<glm::vec3>& points) {
    Bounds extent;
    for (const glm::vec3& point : points) extent.add(point);
    return extent;
}

}  // namespace

void CommonFraming::add(const DrawList& list) {
    space_ = list.space;
    size_ = list.size;
    frame_ = frame_ ? Frame{glm::max(frame_->min, list.frame.min), glm::min(frame_->max, list.frame.max)} : list.frame;
    for (const DiskInstance& disk : list.disks) {
        for (const glm::vec3& direction : rim_directions()) {
            const glm::vec3 rim = disk.base + disk.radius * direction;
            points_.insert(points_.end(), {rim, rim + glm::vec3(0, 0, disk.height)});
        }
    }
    for (const BoxInstance& box : list.boxes) {
        for (const glm::vec3& corner : box_corners(box)) points_.push_back(corner);
    }
    for (const LineInstance& line : list.lines) points_.insert(points_.end(), {line.from, line.to});
    if (points_.size() > tidy_at_) tidy();
}

/// Most of what is drawn stays from picture to picture.
void CommonFraming::tidy() {
    const auto key = [](const glm::vec3& p) { return std::tuple(p.x, p.y, p.z); };
    std::sort(points_.begin(), points_.end(), [&](const glm::vec3& a, const glm::vec3& b) { return key(a) < key(b); });
    points_.erase(std::unique(points_.begin(), points_.end()), points_.end());
    tidy_at_ = std::max(2 * points_.size(), kFewPoints);
}

Camera CommonFraming::still(const Camera& camera) const {
    PictureFrame picture;
    picture.size = size_;
    picture.space = space_;
    picture.projection = make_projection(camera, ShownPoints(points_), nullptr, *frame_, size_);
    picture.middle = extent_of(points_).middle();
    return resolved_camera(camera, picture);
}

Camera CommonFraming::turning(const Camera& camera) const {
    Camera out = still(camera);
    // The frame's half width and height as seen at the target, in distances to it.
    const glm::dvec2 picture(size_.width, size_.height);
    const double tangent = std::tan(out.fov_deg * kDegree / 2);
    const glm::dvec2 half = glm::dvec2(frame_->max - frame_->min) / picture.y * tangent;
    const double cosine = std::cos(out.pitch_deg * kDegree);
    const double sine = std::sin(out.pitch_deg * kDegree);
    const double near = out.perspective ? 1 : 0;  // what comes nearer grows

    // Turned once around, a point at a distance from the axis and a height needs the eye this far from the axis' foot,
    // for the frame's upper and lower edge and its sides.
    const Bounds extent = extent_of(points_);
    const glm::dvec3 middle = extent.middle();
    double top = 0;
    double bottom = 0;
    double sides = 0;
    for (const glm::vec3& point : points_) {
        const double around = glm::length(glm::dvec2(point) - glm::dvec2(middle));
        const double height = static_cast<double>(point.z) - middle.z;
        top =
            std::max(top, height * (cosine / half.y + near * sine) + around * std::abs(near * cosine - sine / half.y));
        bottom = std::max(bottom,
                          -height * (cosine / half.y - near * sine) + around * std::abs(near * cosine + sine / half.y));
        sides = std::max(sides, around * std::hypot(1 / half.x, near * cosine) + near * height * sine);
    }
    // The target goes up the axis until above and below need the same.
    const double reach = 0.5 * (extent.max.z - extent.min.z);
    const double up = cosine > 1e-6 ? std::clamp((top - bottom) * half.y / (2 * cosine), -reach, reach) : 0;
    out.distance = std::max({top - up * (cosine / half.y + near * sine), bottom + up * (cosine / half.y - near * sine),
                             sides - up * near * sine, 1e-3});
    out.target = space_.to_target(middle + glm::dvec3(0, 0, up));
    return out;
}

}  // namespace mobbscope
