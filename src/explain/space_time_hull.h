/// Convex bodies in space-time, and the line on the floor that keeps two of them apart.
#pragma once

#include <mobb/placed_tree.h>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <cstdint>
#include <optional>
#include <vector>

namespace mobbscope {

/// A convex body in (x, y, t), metres and global seconds from some origin, known by its furthest points.
class SpaceTimeHull {
  public:
    virtual ~SpaceTimeHull() = default;
    virtual glm::dvec3 furthest(glm::dvec3 direction) const = 0;
    virtual bool empty() const = 0;
};

/// The hull of a node's disks, or of those of them that are present for more than a moment in some time.
class HullOfDisks final : public SpaceTimeHull {
  public:
    HullOfDisks(const mobb::PlacedTree& tree, int node, mobb::Interval time, glm::dvec3 origin);

    /// Branch and bound: the child whose box reaches further first.
    glm::dvec3 furthest(glm::dvec3 direction) const override;
    bool empty() const override { return first_ >= end_; }
    /// How many disks and boxes have been looked at.
    std::int64_t visits() const { return visits_; }

  private:
    struct Search;

    const mobb::PlacedTree& tree_;
    int node_;
    mobb::Interval time_;
    glm::dvec3 origin_;
    int first_, end_;  ///< samples
    mutable std::int64_t visits_ = 0;
};

/// The hull of points.
class HullOfPoints final : public SpaceTimeHull {
  public:
    explicit HullOfPoints(std::vector<glm::dvec3> points) : points_(std::move(points)) {}

    glm::dvec3 furthest(glm::dvec3 direction) const override;
    bool empty() const override { return points_.empty(); }

  private:
    std::vector<glm::dvec3> points_;
};

/// Which lines are looked for.
enum class Lines {
    axes,   ///< across the world's x or y, fixed
    fixed,  ///< of any direction
    moving  ///< ... that may also move evenly
};

/// A line that crosses `direction`, with all of A before it and all of B behind it.
struct SeparatingLine {
    glm::dvec2 direction{1, 0};  ///< unit, from A to B
    double speed = 0;            ///< along it, m/s
    double gap = 0;              ///< metres between the two along it, > 0
};

/// About the widest gap of all such lines; none: there is no line, or the two touch within `least_gap` > 0 metres.
/// `steepness` > 0, m/s: how fast a line may move to be found soon. By Gilbert, Johnson and Keerthi's nearest points
/// (1988), which decides it exactly: a line keeps two bodies apart if and only if they share no point.
std::optional<SeparatingLine> line_between(const SpaceTimeHull& a, const SpaceTimeHull& b, Lines lines,
                                           double steepness, double least_gap);

}  // namespace mobbscope
