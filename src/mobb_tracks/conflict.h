/// Two paths that come too close to each other: when, and how close.
#pragma once

#include <mobb/placed_tree.h>
#include <mobb/query.h>

#include <span>
#include <vector>

namespace mobb {

/// Of intervals in order of time, the last that begins by then; of an earlier time the first. There must be one.
const Interval& interval_at(std::span<const Interval> intervals, double time);
/// Of all intervals.
double seconds_of(std::span<const Interval> intervals);
/// Of the longest interval; 0 without any.
double longest_of(std::span<const Interval> intervals);

/// Two members of a crowd who collide (mobb/predicate.h), or come within some distance.
struct Conflict {
    int a = 0;  ///< index into the crowd; less than b
    int b = 0;
    std::vector<Interval> intervals;  ///< all over which they are so close, earliest first; empty: they never are
    /// Metres: the least of distance of centres minus radii over the pairs of samples that are so close; at most the
    /// distance that was asked for.
    double least_clearance = 0;
    double time = 0;  ///< global seconds: when it is so; of held clips when that pair's overlap begins; the earliest
    int a_sample = 0;
    int b_sample = 0;
};

/// A placed clip whose disks are wider, by metres >= 0: it collides with those that the clip comes within.
class WidenedClip {
  public:
    /// Refers to the clip.
    WidenedClip(const PlacedClip& clip, double by) : clip_(&clip), by_(by) {}

    Disk disk(int i) const { return widened(clip_->disk(i)); }
    Disk disk_at_end(int i) const { return widened(clip_->disk_at_end(i)); }
    double time(int i) const { return clip_->time(i); }
    bool is_linear() const { return clip_->is_linear(); }

  private:
    Disk widened(Disk disk) const {
        disk.r += by_;
        return disk;
    }

    const PlacedClip* clip_;
    double by_;
};

/// Over every pair of samples, of `a` from first_a on and of `b` from first_b on. `within`: metres >= 0; 0 finds who
/// collides. Conflict::a and b are left 0.
Conflict conflict_of(const PlacedClip& a, const PlacedClip& b, double within = 0, int first_a = 0, int first_b = 0);
/// Of who collides, through the trees: the same.
Conflict conflict_of(const PlacedTree& a, const PlacedTree& b);

}  // namespace mobb
