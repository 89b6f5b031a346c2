/// Convex polygons that enclose disks on the floor, and can be merged without the disks.
#pragma once

#include <mobb/clip.h>

#include <glm/vec2.hpp>

#include <array>
#include <span>

namespace mobb {

/// A convex polygon around disks: how far they reach in a fixed number of directions (a discrete-orientation polytope:
/// Klosowski et al. 1998). The directions are those of a circle that has been stretched to the disks' length along an
/// axis and their width across it: a long and narrow path is enclosed as closely as a round one.
class KDop {
  public:
    /// Around disks, at least one; `axis` is a unit vector.
    KDop(std::span<const Disk> disks, glm::dvec2 axis);

    /// The same without a stretch: the directions are those of a circle, from +x on.
    explicit KDop(std::span<const Disk> disks);

    /// Around two others. Each adds less than 0.5 % to their extents.
    KDop(const KDop& a, const KDop& b, glm::dvec2 axis);

    /// Rotated about the world's origin, then translated (metres).
    KDop placed(const Rotation& rotation, glm::dvec2 translate) const;

    glm::dvec2 axis() const { return {frame_.c, frame_.s}; }
    /// Of the rectangle around it along its axis: the half extents along the axis and across it, and the centre.
    glm::dvec2 half() const {
        return size_ * glm::dvec2{reach_[0] + reach_[kHalf], reach_[kQuarter] + reach_[kHalf + kQuarter]} / 2.0;
    }
    glm::dvec2 center() const {
        return origin_ +
               frame_(size_ * glm::dvec2{reach_[0] - reach_[kHalf], reach_[kQuarter] - reach_[kHalf + kQuarter]} / 2.0);
    }

    static constexpr std::size_t kDirections = 32;  ///< a power of 2

    /// Of one without a stretch: where the sides of every second direction meet. This larger polygon reaches past the
    /// disks by a tenth of their extent at most.
    std::array<glm::dvec2, kDirections / 2> coarse_corners() const;

  private:
    static constexpr std::size_t kHalf = kDirections / 2, kQuarter = kDirections / 4;
    struct Circle;
    struct Corner;

    KDop(glm::dvec2 origin, glm::dvec2 axis);
    /// Takes the length and width of what reaches so far along the axis and across it.
    void stretch(glm::dvec2 half);
    /// The rectangle around another in this one's frame.
    void measure(const KDop& other, glm::dvec2& low, glm::dvec2& high) const;
    void enclose(const KDop& other);

    glm::dvec2 origin_;   ///< near the disks, so that no digits are lost far from the world's
    Rotation frame_;      ///< turns +x into the axis
    glm::dvec2 size_{1};  ///< about the half extents, metres: the unit of length along the axis and of width across it
    std::array<double, kDirections> reach_;  ///< from the origin, in those units, counter-clockwise from the axis
};

/// What rounding adds to an outline's errors, at most, as a share of its distance from the world's origin.
inline constexpr double kKDopRounding = 1e-12;

}  // namespace mobb
