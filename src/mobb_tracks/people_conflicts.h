/// Every pair of people of a crowd who collide, or come within a distance of each other.
#pragma once

#include <mobb_tracks/conflict.h>
#include <mobb_tracks/path_sweep.h>

#include <cstddef>
#include <functional>
#include <span>
#include <utility>
#include <vector>

namespace mobb {

/// Two people who come too close, over all the paths that they walk.
struct PeopleConflict {
    int a = 0;  ///< index of the person; less than b
    int b = 0;
    std::vector<Interval> intervals;  ///< all over which they are so close, earliest first; at least one
    Conflict deepest;                 ///< of the two paths, a's and b's, that come closest
    Conflict begins;                  ///< of the two paths with which the interval of that begins

    /// The interval in which they come closest.
    const Interval& worst() const { return interval_at(intervals, deepest.time); }
    double seconds() const { return seconds_of(intervals); }
};

struct ConflictSearch {
    double within = 0;         ///< metres >= 0 between the disks; 0: those who collide
    double least_seconds = 0;  ///< whom no interval keeps so close for so long is left out
    /// Pairs are found where the first two of their paths that ever come near each other first do so (Region::has).
    Region region;
    /// Measures every pair of samples of every pair of paths, and sweeps nothing; the region must be all.
    bool direct = false;
    /// By person, or empty: numbers of floors, 0 where nobody says. People of two floors never meet.
    std::span<const int> floor_of{};
    /// By path: trees that are asked of the pairs that come near each other. Without them these are measured. `within`
    /// must be 0, and the trees outlive what is found.
    std::span<const PlacedTree> trees{};
    SweepProgress progress{};  ///< of paths
    /// Is told how many bytes what was found takes; may throw.
    std::function<void(std::size_t bytes)> spend{};
};

/// Each pair once however often they meet, worst first: the closest, of equals the longest, then the earliest. Of a
/// crowd in one place there are millions: each is measured again when it is asked for.
class PeopleConflicts {
  public:
    /// `person_of` says, for each path of the crowd, whose it is: a person's paths stand together, and people count
    /// from 0 in their order. A person's own paths, which join or are the disks of one body, are no conflict. All ways
    /// of searching find the same, and regions that share nothing and cover all find each pair of people in one. The
    /// clips must outlive what is found.
    PeopleConflicts(std::vector<PlacedClip> crowd, std::span<const int> person_of, const ConflictSearch& search = {});

    std::size_t size() const { return ranked_.size(); }
    bool empty() const { return ranked_.empty(); }
    /// 0 <= index < size().
    PeopleConflict operator[](std::size_t index) const { return measured(ranked_[index]); }

    const PlacedClip& clip(int path) const { return crowd_[static_cast<std::size_t>(path)]; }
    std::size_t people() const;
    std::size_t pairs() const;                            ///< of people, but not of two floors
    std::size_t pairs_tested() const { return tested_; }  ///< of people: of whose paths any two came near
    double seconds() const;                               ///< of all conflicts

  private:
    struct Ranked {
        double least_clearance, seconds, begin;
        std::size_t first, end;  ///< into met_
    };
    /// Two paths that may come too close, and their first samples that do.
    struct Meeting {
        int a, b;
        int a_sample = 0, b_sample = 0;
    };

    void sweep();
    bool is_found_in_region(int person, int other) const;
    void take_pair(int person, int other);
    void take_all_pairs();
    void meet(const Meeting& met);
    void rank();
    int person_of(int path) const { return person_of_[static_cast<std::size_t>(path)]; }
    std::pair<int, int> paths_of(int person) const;  ///< the first, and the one behind the last
    bool are_apart(int person, int other) const;
    std::pair<int, int> people_of(const Meeting& met) const { return {person_of(met.a), person_of(met.b)}; }
    Conflict conflict_between(const Meeting& met) const;
    PeopleConflict measured(const Ranked& ranked) const;
    void spend() const;

    std::vector<PlacedClip> crowd_;
    std::vector<int> person_of_;
    std::vector<int> floor_of_;
    ConflictSearch search_;
    std::vector<Meeting> met_;  ///< by people
    std::size_t tested_ = 0;
    std::vector<Ranked> ranked_;
};

}  // namespace mobb
