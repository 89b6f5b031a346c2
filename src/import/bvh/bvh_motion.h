/// One character of a BVH in motion.
#pragma once

#include <import/bvh/bvh.h>

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace mobbscope {

/// A ROOT and all below it. Keeps the data alive.
class BvhMotion : public Motion {
  public:
    /// Of the joints in the file those from `first` to before `end`.
    BvhMotion(std::shared_ptr<const BvhData> data, std::size_t first, std::size_t end);

    std::span<const Joint> joints() const override { return joints_; }
    std::size_t in_file(int joint) const override { return first_ + static_cast<std::size_t>(joint); }
    int topmost() const override { return 0; }
    const MotionTimes& times() const override { return times_; }
    void pose(double seconds, std::span<glm::dvec3> positions, std::span<glm::dquat> rotations) const override;
    std::vector<std::string> warnings() const override { return data_->warnings; }

    /// From the joint above (of the ROOT: from the file's origin), file units.
    const glm::dvec3& offset(std::size_t joint) const { return moves()[joint].offset; }
    /// Whether a row says anything of it.
    bool has_channels() const;

  private:
    std::span<const BvhJoint> moves() const { return std::span(data_->moves).subspan(first_, joints_.size()); }

    std::shared_ptr<const BvhData> data_;
    std::size_t first_;
    std::vector<Joint> joints_;
    MotionTimes times_;
};

}  // namespace mobbscope
