/// Where a clip may reach on the floor, wherever it is placed.
#pragma once

#include <mobb/clip.h>
#include <mobb/kdop.h>

namespace mobbscope {

/// A rectangle along the axes of the floor, in metres.
struct FloorRect {
    glm::dvec2 low{0};
    glm::dvec2 high{0};

    bool meets(const FloorRect& other) const {
        return low.x <= other.high.x && other.low.x <= high.x && low.y <= other.high.y && other.low.y <= high.y;
    }
};

/// A polygon around all disks of a clip. Where a run's agents first stand is drawn by these bounds: with others the
/// same seed would give another run.
class ClipBounds {
  public:
    explicit ClipBounds(const mobb::Clip& clip)
        : corners_(mobb::KDop(clip.samples()).coarse_corners()), reach_(clip.reach()) {}

    /// Holds every disk of the clip where it is placed, rounding included.
    FloorRect bounds(const mobb::Placement& placement) const;

  private:
    std::array<glm::dvec2, mobb::KDop::kDirections / 2> corners_;  ///< in the clip's frame
    double reach_;                                                 ///< of the clip: what rounding is measured by
};

/// Whether some disk reaches over a wall of the floor, which goes from -area/2 to area/2. Touching a wall is allowed.
/// The bounds must be the clip's; it only saves time.
bool leaves_floor(const mobb::PlacedClip& clip, const ClipBounds& clip_bounds, glm::dvec2 area);

}  // namespace mobbscope
