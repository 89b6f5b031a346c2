/// What fitting boxes is made of. Internal to the library's sources.
#pragma once

#include <mobb/clip.h>
#include <mobb/fit.h>
#include <mobb/tree.h>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <array>
#include <limits>
#include <span>

namespace mobb {

/// Extent of a set along one axis.
struct Extent {
    double low = std::numeric_limits<double>::infinity();
    double high = -std::numeric_limits<double>::infinity();

    void add(double from, double to) {
        low = std::min(low, from);
        high = std::max(high, to);
    }
    double length() const { return high - low; }
    double center() const { return (low + high) / 2; }
    double half() const { return (high - low) / 2; }
};

/// Whether the order in which a set was looked at can matter: of zeros of both signs the first one counts.
inline bool has_zero(const Extent& e) { return e.low == 0 || e.high == 0; }

/// What a box around a range must hold: of a linear clip also the disk that the range's last one runs to.
std::span<const Disk> swept_disks(const Clip& clip, SampleRange range);

/// Disks that a box must hold, at least one.
class BoundedDisks {
  public:
    explicit BoundedDisks(std::span<const Disk> disks) : disks_(disks) {}
    /// Those of a node whose descendants all have upright boxes: these rule most disks out of being the furthest.
    /// `nodes`: the tree's, as far as they are built.
    BoundedDisks(const Clip& clip, std::span<const Node> nodes, int node);

    std::span<const Disk> disks() const { return disks_; }
    /// Along a unit vector and its perpendicular (paper, Section 3.1: add and subtract r). The same to the last bit
    /// whether there are nodes or not.
    std::array<Extent, 2> extents(glm::dvec2 u) const;

  private:
    class Search;

    std::span<const Disk> disks_;
    const Clip* clip_ = nullptr;
    std::span<const Node> nodes_;
    int node_ = -1;  ///< -1: all disks are looked at
};

/// The unit direction of largest variance on the floor, x >= 0; +x where no direction has more than another. At least
/// one disk.
glm::dvec2 principal_axis(std::span<const Disk> disks);

struct PrincipalAxes {
    std::array<glm::dvec3, 3> axes;  ///< orthonormal, right-handed, largest variance first, the first never downwards
    bool is_line = false;            ///< all variance lies along the first: the direction of the others is rounding
};

/// Of the points (x, y, i*height), i counted from the first disk.
PrincipalAxes principal_axes(std::span<const Disk> disks, double height);

/// fit() of a node's samples to the last bit, of an upright kind, where all nodes below it have their boxes and these
/// are upright too: most samples are not looked at. `nodes`: the tree's, as far as they are built.
Rectangle fit_node(BoxKind kind, const Clip& clip, std::span<const Node> nodes, int node, Axes axes);

}  // namespace mobb
