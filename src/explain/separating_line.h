/// Lines on the floor, fixed or moving evenly, that keep the disks of two paths apart for some time.
#pragma once

#include <mobb/placed_tree.h>
#include <mobb/query.h>

#include <glm/vec2.hpp>

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace mobbscope {

/// A time interval and a line that keeps all disks of A on one side and all of B's on the other throughout. The line
/// crosses `direction`, fixed or moving evenly along it.
struct Tile {
    double t0 = 0, t1 = 0;       ///< global seconds, t0 < t1
    glm::dvec2 direction{1, 0};  ///< unit, from A to B
    double speed = 0;            ///< of the line along `direction`, m/s
    double gap = 0;              ///< metres between the two along it, rounded down; touching disks may give -1e-9
};

/// A pair of samples that share time, with their disks at both ends of it.
struct SharedTime {
    double t0 = 0, t1 = 0;
    std::array<mobb::Disk, 2> a{}, b{};
};

/// All pairs that share time before some end, in order of time, and the direction that keeps each apart.
struct Pieces {
    std::vector<SharedTime> pieces;
    std::vector<glm::dvec2> lines;
    double slack = 0;  ///< metres by which each side is drawn back, so that disks that touch are still kept apart
};

Pieces pieces_before(const mobb::PlacedClip& a, const mobb::PlacedClip& b, double end);

/// Along which the disks of a pair stay apart all the time that they share: from A to B when they are nearest. A convex
/// hull of the two relative disks at its ends is nearest to the origin there.
glm::dvec2 line_of(const mobb::Approach& approach);

inline glm::dvec2 center(const mobb::Disk& disk) { return {disk.x, disk.y}; }

/// Metres that a side of a line may seem to be passed by for rounding, for coordinates so large.
double line_tolerance(double coordinate);

/// A point of a path as a line sees it: a moment, and how far the path reaches along the direction then.
struct Reach {
    double t = 0, y = 0;
};

/// The points of a side that a line must pass, seen along a direction: of A the upper ones, of B the lower ones.
class Hull {
  public:
    /// `way`: 1 keeps the upper hull, -1 the lower one.
    explicit Hull(double way) : way_(way) {}

    /// Points come in order of time.
    void add(Reach point);
    std::span<const Reach> points() const { return points_; }
    /// Where the last point is, if it is of that time.
    double at_end(double time, double otherwise) const {
        return !points_.empty() && points_.back().t == time ? points_.back().y : otherwise;
    }
    /// The extreme slope from an earlier point of the hull to `to`: of an upper hull the least, of a lower one the
    /// most.
    std::optional<double> slope_to(Reach to) const;

  private:
    bool turns(Reach p, Reach q, Reach r) const {
        return way_ * ((q.y - p.y) * (r.t - p.t) - (r.y - p.y) * (q.t - p.t)) > 0;
    }

    double way_;
    std::vector<Reach> points_;
};

/// How far lines across one direction keep A and B apart, from a first piece on.
class Sweep {
  public:
    /// `slack`: metres by which each side is drawn back, so that disks that touch are still kept apart.
    Sweep(std::span<const SharedTime> pieces, glm::dvec2 direction, double slack)
        : pieces_(pieces), u_(direction), slack_(slack) {}

    /// How many pieces from `first` on a fixed line keeps apart.
    std::size_t fixed(std::size_t first) const;
    /// The same of a line that moves evenly, at whatever speed.
    std::size_t moving(std::size_t first) const;
    /// The tile over pieces [first, first + count).
    Tile tile(std::size_t first, std::size_t count, bool fixed_line) const;

  private:
    Reach of_a(std::size_t piece, std::size_t end) const;
    Reach of_b(std::size_t piece, std::size_t end) const;

    std::span<const SharedTime> pieces_;
    glm::dvec2 u_;
    double slack_;
};

}  // namespace mobbscope
