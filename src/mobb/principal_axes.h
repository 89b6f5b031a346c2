/// Principal axes of the centres of disks. Internal to the library's sources.
#pragma once

#include <mobb/clip.h>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <span>

namespace mobb {

/// The unit direction of largest variance on the floor, x >= 0; +x where no direction has more than another. At least
/// one disk.
glm::dvec2 principal_axis(std::span<const Disk> disks);

struct PrincipalAxes {
    std::array<glm::dvec3, 3> axes;  ///< orthonormal, right-handed, largest variance first, the first never downwards
    bool is_line = false;            ///< all variance lies along the first: the direction of the others is rounding
};

/// Of the points (x, y, i*height), i counted from the first disk.
PrincipalAxes principal_axes(std::span<const Disk> disks, double height);

}  // namespace mobb
