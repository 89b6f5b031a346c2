/// Convex polygons that enclose disks on the floor, and can be merged without the disks.
#pragma once

#include <mobb/clip.h>

#include <glm/vec2.hpp>

#include <array>
#include <cstddef>
#include <span>

namespace mobb {

/// A convex polygon around disks. A disk's is loose by 0.9 % of its radius, and what merges several adds nothing as
/// long as they are within kMostCorners; a rounder hull than that is enclosed by one with fewer corners. All of it
/// holds up to rounding errors, at most kOutlineRounding of the distance from the origin.
class Outline {
  public:
    static constexpr int kMostCorners = 48;

    /// Around at least one disk; time is linear in their number.
    static Outline around(std::span<const Disk> disks);

    /// Counter-clockwise, from the leftmost (of several, the lowest). Points and lines have fewer than three.
    std::span<const glm::dvec2> corners() const { return {corners_.data(), static_cast<std::size_t>(count_)}; }

    /// Rotated about the origin, then translated (metres).
    Outline placed(const Rotation& rotation, glm::dvec2 translate) const;

    /// Encloses both: their convex hull (Andrew 1979, in linear time as both are sorted), simplified if it has too many
    /// corners.
    friend Outline merged(const Outline& a, const Outline& b);

  private:
    /// From corners in counter-clockwise order, at most kMostCorners.
    explicit Outline(std::span<const glm::dvec2> corners);
    static Outline around(const Disk& disk);

    /// From the leftmost corner to the rightmost (of several, the highest), and from there back to the leftmost.
    std::span<const glm::dvec2> lower_side() const {
        return {corners_.data(), static_cast<std::size_t>(rightmost_ + 1)};
    }
    std::span<const glm::dvec2> upper_side() const {
        return {corners_.data() + rightmost_, static_cast<std::size_t>(count_ + 1 - rightmost_)};
    }

    std::array<glm::dvec2, kMostCorners + 1> corners_{};  ///< the first one again behind the last
    int count_ = 0;
    int rightmost_ = 0;
};

/// See Outline.
inline constexpr double kOutlineRounding = 1e-12;

Outline merged(const Outline& a, const Outline& b);

}  // namespace mobb
