#include <crowd/simulation/clip_bounds.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace mobbscope {

ClipBounds::ClipBounds(const mobb::Clip& clip) : corners_{}, reach_(clip.reach()) {
    constexpr std::size_t kSides = std::tuple_size_v<decltype(corners_)>;
    constexpr double kAngle = 2 * std::numbers::pi / kSides;
    std::array<glm::dvec2, kSides> normals;
    std::array<double, kSides> reaches;
    for (std::size_t i = 0; i < kSides; ++i) {
        normals[i] = {std::cos(static_cast<double>(i) * kAngle), std::sin(static_cast<double>(i) * kAngle)};
        reaches[i] = -std::numeric_limits<double>::infinity();
        for (const mobb::Disk& disk : clip.samples()) {
            reaches[i] = std::max(reaches[i], normals[i].x * disk.x + normals[i].y * disk.y + disk.r);
        }
    }
    // A corner lies where two neighbouring sides meet.
    const double sine = std::sin(kAngle);
    for (std::size_t i = 0; i < kSides; ++i) {
        const std::size_t j = (i + 1) % kSides;
        corners_[i] = {(reaches[i] * normals[j].y - reaches[j] * normals[i].y) / sine,
                       (reaches[j] * normals[i].x - reaches[i] * normals[j].x) / sine};
    }
}

FloorRect ClipBounds::bounds(const mobb::Placement& placement) const {
    const mobb::Rotation rotation = mobb::Rotation::from_degrees(placement.rotate_deg);
    FloorRect rect{glm::dvec2(std::numeric_limits<double>::infinity()),
                   glm::dvec2(-std::numeric_limits<double>::infinity())};
    for (const glm::dvec2 corner : corners_) {
        const glm::dvec2 at = rotation(corner) + placement.translate;
        rect.low = {std::min(rect.low.x, at.x), std::min(rect.low.y, at.y)};
        rect.high = {std::max(rect.high.x, at.x), std::max(rect.high.y, at.y)};
    }
    // Far more than all rounding made here and where disks are placed.
    const double margin = 1e-12 * (reach_ + std::abs(placement.translate.x) + std::abs(placement.translate.y));
    rect.low -= margin;
    rect.high += margin;
    return rect;
}

bool leaves_floor(const mobb::PlacedClip& clip, const ClipBounds& clip_bounds, glm::dvec2 area) {
    const glm::dvec2 wall = area / 2.0;
    const FloorRect rect = clip_bounds.bounds(clip.placement());
    if (rect.low.x >= -wall.x && rect.low.y >= -wall.y && rect.high.x <= wall.x && rect.high.y <= wall.y) return false;
    for (int i = 0; i < clip.count(); ++i) {
        const mobb::Disk disk = clip.disk(i);
        if (std::abs(disk.x) + disk.r > wall.x || std::abs(disk.y) + disk.r > wall.y) return true;
    }
    return false;
}

}  // namespace mobbscope
