/// Where two disks on the floor overlap: a projection, or the whole of the smaller one.
#pragma once

#include <mobb/clip.h>

#include <array>
#include <vector>

namespace mobbscope {

struct DiskOverlap {
    /// Its two outlines from end to end, as many points in each; rows of points across it. ReservationGrid metres.
    std::array<std::vector<glm::dvec2>, 2> sides;
    bool has_tips = false;  ///< the circles cross at the ends of the outlines
};

/// `rows` >= 2 points in each outline; both are empty if the disks do not overlap.
DiskOverlap disk_overlap(const mobb::Disk& a, const mobb::Disk& b, int rows);

}  // namespace mobbscope
