/// How near two placed clips come to each other, found without looking at every moment.
#pragma once

#include <mobb/clip.h>
#include <mobb/query.h>

#include <glm/vec2.hpp>

#include <optional>
#include <vector>

namespace mobb {

/// Halves of halves of a clip, each under a disk in the clip's frame: made once, for any number of placements.
class ClipDisks {
  public:
    struct Range {
        int first = 0, end = 0;  ///< samples that last for some time
        int second = 0;          ///< index of the second half, the first half is the next; 0: not halved
        glm::dvec2 center{0};
        double radius = 0;  ///< around the disks for as long as they last

        bool is_leaf() const { return second == 0; }
    };

    /// Refers to the clip, which must outlive it.
    explicit ClipDisks(const Clip& clip);

    const Clip& clip() const { return *clip_; }
    const Range& operator[](int i) const { return ranges_[static_cast<std::size_t>(i)]; }

  private:
    int build(int first, int end);

    const Clip* clip_;
    std::vector<Range> ranges_;
};

/// The samples that come nearest.
struct NearestPair {
    double clearance = 0;  ///< the least while both last, metres; below 0 exactly where they collide
    int a_sample = 0, b_sample = 0;
};

/// The least clearance over time, of every pair of samples that the direct search would measure; none if the two share
/// no time. `near`: samples that may be nearest, which makes it faster. It only affects which of several equally near
/// pairs is returned.
std::optional<NearestPair> least_clearance(const PlacedClip& a, const ClipDisks& disks_a, const PlacedClip& b,
                                           const ClipDisks& disks_b, const std::optional<NearestPair>& near = {});

}  // namespace mobb
