/// What a picture has to show, as points: those farthest in a direction decide where the camera stands.
#pragma once

#include <render/drawlist/draw_list.h>

#include <glm/vec3.hpp>

#include <memory>
#include <span>
#include <vector>

namespace mobbscope {

/// Of a disk: eight directions around its rim, on the floor.
const std::array<glm::vec3, 8>& rim_directions();

/// Single points, and the rims of disks above and below. Most disks are never looked at: they lie in blocks, whose
/// bounds tell that others reach farther. Copies share the disks.
class ShownPoints {
  public:
    ShownPoints() = default;
    explicit ShownPoints(SharedValues<DiskInstance> disks);
    explicit ShownPoints(std::span<const glm::vec3> points) : points_(points.begin(), points.end()) {}

    void add(glm::vec3 point) { points_.push_back(point); }
    void add(std::span<const glm::vec3> points) { points_.insert(points_.end(), points.begin(), points.end()); }
    void add(const ShownPoints& points);

    /// The same points of disks that differ from these in colour alone: nothing is measured again.
    ShownPoints of_like(SharedValues<DiskInstance> disks) const;

    bool empty() const { return points_.empty() && disks_.empty() && others_.empty(); }

    /// The most of dot(p, along) + factor * dot(p, also); the lowest float of an empty set.
    float most(glm::vec3 along, glm::vec3 also = glm::vec3(0), float factor = 0) const;

  private:
    struct Block {
        glm::vec3 min, max;
    };
    SharedValues<DiskInstance> disks_;
    std::shared_ptr<const std::vector<Block>> blocks_;
    std::vector<glm::vec3> points_;
    std::vector<ShownPoints> others_;  ///< that were added
};

}  // namespace mobbscope
