/// The crowd simulator (paper, Section 5): agents on a walled floor play moves back to back and collide with nobody.
#pragma once

#include <crowd/simulation/choice.h>
#include <crowd/simulation/move_set.h>
#include <scene/crowd_run.h>
#include <scene/scene.h>

#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <vector>

namespace mobbscope {

/// Which queries a workload is drawn from. Joints, of two samples, are left out.
enum class Recorded {
    asked,  ///< those that the trees were asked: the pairs that are near each other in space and time
    all,    ///< candidate against every motion that another agent has reserved, near or far, at any time
};

/// A uniform sample without repetition of all queries that it is offered (reservoir sampling: Vitter 1985, Algorithm
/// R).
class QuerySample {
  public:
    /// Keeps at most `size` queries; 0 keeps all. Of `all` only pairs whose bounds on the floor come within `range`
    /// metres of each other are offered.
    QuerySample(Recorded recorded, std::size_t size, std::uint64_t seed,
                double range = std::numeric_limits<double>::infinity())
        : recorded_(recorded), size_(size), seed_(seed), range_(range) {}

    Recorded recorded() const { return recorded_; }
    double range() const { return range_; }
    void offer(std::span<const AskedPair> pairs);
    std::uint64_t offered() const { return offered_; }
    std::size_t size() const { return kept_.size(); }

    /// A scene with the clips of the moves, those that are turned only where they are asked about, and one query for
    /// each pair, in the order in which they were asked. The candidate is `a`. `moves` as in the simulation.
    Scene workload(const MoveSet& moves) const;

  private:
    struct Kept {
        std::uint64_t number;  ///< among those offered
        AskedPair pair;
    };

    Recorded recorded_;
    std::size_t size_;
    std::uint64_t seed_;
    double range_;
    std::uint64_t offered_ = 0;
    std::vector<Kept> kept_;
};

struct SimulateOptions {
    int agents = 100;         ///< 1 to kMaxAgents
    glm::dvec2 area{30, 40};  ///< metres, each over 0: the floor is centred on the origin
    double seconds = 120;     ///< over 0: simulated
    std::uint64_t seed = 1;   ///< at most kMaxSeed
    double ahead = 0;  ///< seconds, >= 0: each move is chosen so long before the one before it ends; the paper's is 0
    double grace = 1;  ///< seconds, >= 0: room kept where moves end, see choose; the paper's is 0
    double plan = 8;   ///< seconds, >= 0, for which each choice plans how to go on, see choose; the paper's is 0
    int threads = 0;   ///< at most kMaxThreads; 0: as many as the machine has. The run does not depend on it
};

inline constexpr int kMaxAgents = 1'000'000;
inline constexpr int kMaxThreads = 1024;
inline constexpr std::int64_t kMostPlays = 2'000'000;  ///< of a run: with their clips they take some 850 bytes each
inline constexpr double kMinSimulated = 1e-3;          ///< seconds
inline constexpr double kMaxSimulated = 1e6;           ///< seconds, also of `ahead`, `grace` and `plan`
inline constexpr double kMinArea = 1e-3;               ///< metres along a wall
inline constexpr double kMaxArea = 1e6;

/// Throws std::invalid_argument, naming the option, if one is out of range.
void check(const SimulateOptions& options);

/// What was done in a run, or so far.
struct SimulationCounts {
    double simulated = 0;  ///< seconds
    int agents = 0;        ///< that have found a place
    std::int64_t plays = 0;
    std::int64_t choices = 0;
    std::int64_t candidates = 0;  ///< at choice points
    std::int64_t off_floor = 0;   ///< candidates discarded because they leave the floor
    std::int64_t colliding = 0;   ///< candidates discarded because they collide with a reserved motion
    std::int64_t no_way_on = 0;   ///< candidates ignored because no plan was found to follow them
    std::int64_t in_the_way = 0;  ///< candidates ignored because they end in somebody's way
    std::int64_t looked_at = 0;   ///< candidates of the present choice for which a way on was looked for
    std::int64_t queries = 0;     ///< pairs that the trees were asked to discard candidates
    std::int64_t pivots = 0;
    std::int64_t forced = 0;
    std::size_t most_held = 0;  ///< reserved motions held at one time
};

/// Told now and then how far a run is; it may throw to end it, and what it throws passes through.
using SimulationProgress = std::function<void(const SimulationCounts&)>;

struct Simulation {
    CrowdRun run;  ///< of the moves of the MoveSet: see scene_of_run
    SimulationCounts counts;
};

/// The scene of the moves with a run of them as its crowd: behind its graph's moves and clips come the turned ones that
/// are played, by move and then by turn. What it is does not depend on the order of plays.
Scene scene_of_run(const MoveSet& moves, CrowdRun run, TurnedSkeletons skeletons = TurnedSkeletons::made);

/// Takes a run's turned moves and its crowd from a scene that is to be simulated anew, and the clips that only they
/// play. Agents and queries must be gone.
void remove_run(Scene& scene);

/// Runs a crowd. Every agent is placed at random, in mid-move, where it collides with nobody; then choices are made in
/// the order of (time, agent) until every agent's moves reach the end. `sample` is offered the queries of all choices.
/// Throws InputError if a hub is a dead end, if there is no room for all agents, or for more than kMostPlays plays.
Simulation simulate(const MoveSet& moves, const SimulateOptions& options, QuerySample* sample = nullptr,
                    const SimulationProgress& progress = {});

/// The most samples of the people of a run together: so many, and so many for each play, which is half a minute.
inline constexpr std::size_t kMostWalkedSamples = 10'000'000;
inline constexpr std::size_t kSamplesOfPlay = 1'000;

/// The people of a run as agents of an ordinary scene: one for each person, whose clip is the chain of all that the
/// person plays, from the begin of the first play. A chain has one dt, and is held or linear: where a person goes on
/// with a clip of another dt or motion, a further agent begins, called "17 from 4.2 s", and a linear clip before it has
/// one more sample, what its last one runs on to. Agent::run_agent says who it is, counting those who play anything.
/// Names and the fit are the run's. The scene must have a crowd and its graph. Throws InputError if a person plays more
/// than a chain can hold, or all of them more than kMostWalkedSamples allows.
Scene scene_of_people(const Scene& run);

}  // namespace mobbscope
