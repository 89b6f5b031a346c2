/// Which paths of a crowd come near each other: a sweep through time, with a grid on the floor of who is there.
#pragma once

#include <mobb/clip.h>

#include <cstddef>
#include <functional>
#include <limits>
#include <span>

namespace mobb {

/// Some samples of a path, few and close together: when they last, and the rectangle that their disks stay within.
struct PathPiece {
    int path = 0;  ///< index into the crowd
    int first = 0, end = 0;
    double t0 = 0, t1 = 0;                  ///< global seconds, [t0, t1)
    double x0 = 0, x1 = 0, y0 = 0, y1 = 0;  ///< metres; wider than the disks by more than any rounding of the predicate
};

/// The piece of a path that begins with a sample that lasts for some time. `within`: metres >= 0, of which the
/// rectangle is wider by half on each side.
PathPiece piece_from(const PlacedClip& clip, int path, int first, double within = 0);

/// A part of space and time: [t0, t1) in global seconds, x in [x0, x1) in metres. Without limits it is all.
struct Region {
    static constexpr double kNoLimit = std::numeric_limits<double>::infinity();
    double t0 = -kNoLimit, t1 = kNoLimit;
    double x0 = -kNoLimit, x1 = kNoLimit;

    friend bool operator==(const Region&, const Region&) = default;
    bool is_all() const { return *this == Region{}; }
    /// Whether two near pieces are told here: where the later one begins, and their rectangles begin to overlap. So of
    /// regions that share nothing and cover all each pair of pieces is told in one.
    bool has(const PathPiece& a, const PathPiece& b) const {
        const double t = a.t0 < b.t0 ? b.t0 : a.t0;
        const double x = a.x0 < b.x0 ? b.x0 : a.x0;
        return t0 <= t && t < t1 && x0 <= x && x < x1;
    }
};

/// Whether two pieces share time, and their rectangles touch.
bool near(const PathPiece& a, const PathPiece& b);

/// Is told of two near pieces, the one of the path with the lower index first, and whether these two paths were not
/// told before. Returns whether it has heard enough of the two paths.
using OnNear = std::function<bool(const PathPiece& a, const PathPiece& b, bool first)>;

/// Is told how much of a whole is done. It may throw; the exception passes through.
using SweepProgress = std::function<void(std::size_t done, std::size_t all)>;

/// Tells `on_near` of every two near pieces (see piece_from) in a region, those of two paths in order of time. Paths of
/// one person are not told of each other; `person_of`: by path. Beside a number per path it keeps only who is there, so
/// memory and time grow with how many are there at once, and with how many meet.
void sweep_paths(std::span<const PlacedClip> crowd, std::span<const int> person_of, double within, const Region& region,
                 const OnNear& on_near, const SweepProgress& progress = {});

}  // namespace mobb
