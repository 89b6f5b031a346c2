/// Who comes too close to whom: every pair of a crowd that collides, found through the trees.
#pragma once

#include <base/budget.h>
#include <mobb/placed_tree.h>
#include <mobb/query.h>
#include <scene/crowd_run.h>
#include <scene/fitted_scene.h>

#include <glm/vec3.hpp>

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace mobbscope {

/// Two members of a crowd that collide (mobb/predicate.h).
struct Conflict {
    int a = 0;  ///< index into the crowd; less than b
    int b = 0;
    std::vector<mobb::Interval> intervals;  ///< all that they collide over, earliest first; at least one
    /// Metres: the least of distance of centres minus radii over the pairs of samples that overlap in time; at most 0.
    double least_clearance = 0;
    double time = 0;  ///< global seconds: when it is so; of held clips when that pair's overlap begins; the earliest
    int a_sample = 0;
    int b_sample = 0;
};

/// Pairs (a, b) of indices into the crowd, a < b, of those whose disks may meet; it leaves out no pair that collides
/// (mobb/predicate.h). In order, each once. Time and memory grow with the number of samples and with how many are near
/// each other, not with the square of the crowd. Throws InputError if they take more than the budget (base/budget.h).
std::vector<std::pair<int, int>> near_pairs(std::span<const mobb::PlacedTree> crowd);

/// Two people who collide, over all the paths that they walk.
struct PeopleConflict {
    int a = 0;  ///< index of the person; less than b
    int b = 0;
    std::vector<mobb::Interval> intervals;  ///< all that they collide over, earliest first; at least one
    Conflict deepest;                       ///< of the two paths, a's and b's, that overlap deepest
    Conflict begins;                        ///< of the two paths with which the interval of the deepest overlap begins

    /// The interval in which they overlap deepest.
    const mobb::Interval& worst() const;
    double seconds() const;  ///< of all intervals
};

/// Every pair of people who collide, each once however often they meet, worst first: the deepest overlap, of equals the
/// longest, then the earliest. Of a crowd in one place there are millions: what the first ten thousand are in full is
/// kept, of others it is searched again when it is asked for.
class PeopleConflicts {
  public:
    /// `person_of` says, for each path of the crowd, whose it is: a person's paths stand together, and people count
    /// from 0 in their order. A person's own paths, which join, are no conflict. Search::trees asks the trees of those
    /// paths that come near each other (near_pairs). Search::direct measures every pair of samples of every pair of
    /// paths. Both find the same. `progress` is told of pairs of paths. The trees may be of any kind, and must outlive
    /// what is found.
    PeopleConflicts(std::span<const mobb::PlacedTree> crowd, std::span<const int> person_of, Search search,
                    const Progress& progress = {});

    std::size_t size() const { return ranked_.size(); }
    bool empty() const { return ranked_.empty(); }
    /// 0 <= index < size().
    PeopleConflict operator[](std::size_t index) const;

    std::size_t pairs() const;                            ///< of people
    std::size_t pairs_tested() const { return tested_; }  ///< of people: of whose paths any two were searched
    double seconds() const;                               ///< of all conflicts

  private:
    struct Ranked {
        double least_clearance, seconds, begin;
        int a, b;
        std::size_t found;  ///< the number that was found before it
    };

    /// Calls test(a, b) for the paths of a person and of later ones that may collide, a by a; `with`: of that one
    /// alone.
    template <class Test>
    void for_each_pair(int person, std::optional<int> with, const Test& test) const;
    std::optional<Conflict> conflict_between(int a, int b) const;
    int people() const { return static_cast<int>(first_path_.size()) - 1; }

    std::vector<mobb::PlacedTree> crowd_;
    std::vector<int> person_of_;
    std::vector<int> first_path_;  ///< by person; then the number of paths
    Search search_;
    std::vector<std::pair<int, int>> near_;  ///< of a search through trees
    std::size_t tested_ = 0;
    std::vector<Ranked> ranked_;
    std::vector<PeopleConflict> kept_;  ///< the first that were found
    Spent spent_;                       ///< of the budget
};

/// "2 conflicts among 22 agents, 1.3 s in all": a conflict is a pair of people.
std::string conflict_count(std::size_t conflicts, std::size_t people, double seconds);

/// A conflict of a scene or a run, with the paths on which its worst contact begins.
struct SceneConflict {
    PlacedAgent a, b;              ///< PlacedAgent::agent is the agent's index, of a run in CrowdRun::agents
    int a_play = -1, b_play = -1;  ///< of a run: indices into CrowdAgent::plays
    /// Of a run: the clip of the joint that leads to the play, if the path is that joint; else null.
    mobb::ClipPtr a_joint{}, b_joint{};
    PeopleConflict facts;

    double begin() const { return facts.worst().t0; }  ///< of that contact, global seconds
};

/// Where the two touch first in that contact: x, y, and when; none if one of them is not there. `scene`: of the
/// conflict.
std::optional<glm::dvec3> place_of(const Scene& scene, const SceneConflict& conflict);
/// "17 and 42: 0.123 m deep, from 13.40 to 13.80 s; they meet once more".
std::string sentence(const SceneConflict& conflict);

/// The most that are kept at once, some 600 bytes each.
inline constexpr std::size_t kMostSceneConflicts = 1'000'000;

/// All of them, worst first: of a scene between its agents, of a run between its people, over all that they play.
/// `progress` is told of pairs of paths. Throws InputError if there are more than kMostSceneConflicts.
std::vector<SceneConflict> conflicts_in(const FittedScene& fitted, const Progress& progress = {});

/// Whether `a` made the conflict of a run, or else `b`: whose play was forced, of two such plays the one that was
/// chosen last, when the other was committed to its own.
bool made_by_a(const CrowdRun& run, const SceneConflict& conflict);

/// Whether one of the two plays of a run was forced: no other may collide, so else an answer was wrong, or the run was
/// edited.
bool was_forced(const CrowdRun& run, const SceneConflict& conflict);

}  // namespace mobbscope
