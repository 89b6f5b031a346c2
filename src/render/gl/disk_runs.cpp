#include <render/gl/disk_runs.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace mobbscope {

namespace {

constexpr float kHighest = 1.8f;      // pixels of a disk's side: above it the edge that the shader draws is seen
constexpr float kWidestStep = 0.5f;   // pixels of a disk's face that its successor leaves free
constexpr float kColorStep = 0.04f;   // between neighbours; more is a hit, or an end of what is in focus
constexpr std::size_t kLongest = 32;  // disks, so that the colour follows

glm::vec2 ground(glm::vec3 p) { return {p.x, p.y}; }

bool follows(const DiskInstance& next, const DiskInstance& disk) {
    return next.id.participant == disk.id.participant && next.id.index == disk.id.index + 1 &&
           std::abs(next.base.z - disk.base.z - disk.height) <= 0.01f * disk.height;
}

}  // namespace

PixelScale::PixelScale(const ViewProjection& projection)
    : lens_(&projection),
      scale_(0.5f * static_cast<float>(projection.size.width) *
             (projection.clip_from_world * glm::vec4(projection.right, 0)).x) {}

float PixelScale::at(glm::vec3 point) const {
    return lens_->perspective ? scale_ / std::max(lens_->depth(point), lens_->near_depth) : scale_;
}

DiskGroups group_runs(std::span<const DiskInstance* const> disks, const ViewProjection& projection, float tolerance) {
    const PixelScale scale(projection);
    const float upwards = std::sqrt(std::max(0.0f, 1 - projection.back.z * projection.back.z));
    // Whether the step from a disk to its successor is too small to be seen.
    const auto blurs = [&](const DiskInstance& disk, const DiskInstance& next) {
        if (!follows(next, disk)) return false;
        const float pixels = scale.at(disk.base);
        const float step = glm::length(ground(next.base - disk.base)) + std::abs(next.radius - disk.radius);
        const glm::vec4 change = glm::abs(next.color - disk.color);
        return disk.height * pixels * upwards < kHighest && step * pixels * std::abs(projection.back.z) < kWidestStep &&
               std::max({change.r, change.g, change.b, change.a}) < kColorStep;
    };
    // Whether the disks between two lie on the tube from one to the other.
    const auto straight = [&](std::size_t first, std::size_t last) {
        const DiskInstance& a = *disks[first];
        const DiskInstance& b = *disks[last];
        const float most = tolerance / scale.at(a.base);
        for (std::size_t i = first + 1; i < last; ++i) {
            const DiskInstance& disk = *disks[i];
            const float t = static_cast<float>(i - first) / static_cast<float>(last - first);
            const float aside = glm::length(ground(disk.base - glm::mix(a.base, b.base, t)));
            if (aside + std::abs(disk.radius - glm::mix(a.radius, b.radius, t)) > most) return false;
        }
        return true;
    };
    DiskGroups groups;
    for (std::size_t first = 0; first < disks.size();) {
        std::size_t last = first;
        while (last + 1 < disks.size() && last - first < kLongest && blurs(*disks[last], *disks[last + 1]) &&
               straight(first, last + 1)) {
            ++last;
        }
        if (last - first < 2) {
            groups.single.push_back(disks[first++]);
            continue;
        }
        const DiskInstance& a = *disks[first];
        const DiskInstance& b = *disks[last];
        // The run is open at its ends. The disk after the last closes the upper one, its first disk the lower one.
        if (projection.below(a.base.z)) groups.single.push_back(&a);
        groups.runs.push_back({a.base, a.radius, b.base, b.radius, disks[(first + last) / 2]->color});
        first = last;
    }
    return groups;
}

}  // namespace mobbscope
