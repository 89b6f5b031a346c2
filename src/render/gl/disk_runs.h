/// Disks so far away that they cannot be told apart, drawn as one.
#pragma once

#include <render/drawlist/draw_list.h>

#include <span>
#include <vector>

namespace mobbscope {

/// Successive disks of a path as one tube, from the lower face of the first to the lower face of the disk after the
/// last.
struct DiskRun {
    glm::vec3 base{0};  ///< centre below, drawn space
    float radius = 0;   ///< below
    glm::vec3 top{0};   ///< centre above
    float top_radius = 0;
    Rgba color{1};  ///< of the middle disk
};

/// What is to draw one by one, in order, and the runs: every disk is in either, the first of a run that is seen from
/// below in both, as runs have no faces.
struct DiskGroups {
    std::vector<const DiskInstance*> single;
    std::vector<DiskRun> runs;
};

/// How many pixels of the picture a metre at `point` makes up, for many points.
class PixelScale {
  public:
    explicit PixelScale(const ViewProjection& projection);
    /// A point nearer than what is drawn counts as if it lay there, for it may be the middle of what is seen.
    float at(glm::vec3 point) const;
    /// At distance 1 from the eye; without perspective anywhere.
    float near() const { return scale_; }

  private:
    const ViewProjection* lens_;
    float scale_;
};

/// `disks`: in drawing order. A run follows them within `tolerance` pixels; its disks' edges would not be seen, nor the
/// steps between them.
DiskGroups group_runs(std::span<const DiskInstance* const> disks, const ViewProjection& projection, float tolerance);

}  // namespace mobbscope
