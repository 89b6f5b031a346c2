/// Looks for moves with which an agent can go on behind a move, so that it never runs out of free ones.
#pragma once

#include <crowd/simulation/reservation_table.h>
#include <scene/crowd_run.h>

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <utility>
#include <vector>

namespace mobbscope {

class PlanSearch {
  public:
    /// All must outlive the search. `tick` is called before each look, as a choice may need thousands; it may throw.
    PlanSearch(const MoveSet& moves, const ReservationTable& reservations, const CrowdRun& run,
               std::function<void()> tick = {})
        : moves_(moves), reservations_(reservations), run_(run), tick_(std::move(tick)) {}

    /// Begins anew, for a play of an agent that it has not reserved yet. `asked` gets the pairs whose trees were
    /// queried, and must outlive what is looked for.
    void start(int agent, int play, std::vector<AskedPair>* asked = nullptr) {
        agent_ = agent;
        play_ = play;
        asked_ = asked;
        queries_ = 0;
        looks_ = 0;
    }

    /// Looks for moves that can follow `move`, back to back, that stay on the floor, collide with nothing that another
    /// agent has reserved, last CrowdRun::plan seconds, and do not end facing a wall (that only with a grace, as
    /// ReservationTable::faces_wall). It first goes on from `kept`, which is known to be free.
    /// True if there are; else plan() is the longest found. It looks at so many moves and no more.
    bool look(int move, const mobb::Placement& placed, std::span<const PlannedMove> kept = {});

    const std::vector<PlannedMove>& plan() const { return longest_; }  ///< what look() found
    double seconds() const { return reach_; }                          ///< that it lasts
    std::int64_t queries() const { return queries_; }                  ///< tree queries made since the start
    std::int64_t looks() const { return looks_; }                      ///< since the start

  private:
    /// What is looked at behind one move of a plan, in memory that is used again.
    struct Level {
        explicit Level(const MoveSet& moves) : placements(moves) {}

        FollowingPlacements placements;
        Surroundings motions, plans;
        std::vector<PlayedMove> looked_at;
        std::vector<PlayedMove> joints;  ///< that lead to those, as the next two; none: of a held move
        std::vector<const MoveSet::Follower*> followers;
        std::vector<FirstMet> found;
        std::vector<const PlayedMove*> candidates;

        void clear() {
            looked_at.clear();
            joints.clear();
            followers.clear();
        }
        /// Goes on from what is found.
        void find_first(const std::vector<PlayedMove>& of);
    };

    bool extend(int before, const mobb::Placement& placed, double seconds);
    void add(const PlannedMove& next, double seconds);

    const MoveSet& moves_;
    const ReservationTable& reservations_;
    const CrowdRun& run_;
    std::function<void()> tick_;
    int agent_ = 0;
    int play_ = 0;
    std::vector<AskedPair>* asked_ = nullptr;
    std::vector<std::unique_ptr<Level>> levels_;  ///< by the moves planned before
    std::vector<PlannedMove> plan_;               ///< at present
    std::vector<PlannedMove> longest_;
    double reach_ = 0;
    int left_ = 0;           ///< moves that may still be looked at
    bool collides_ = false;  ///< the one that was looked at last
    std::int64_t queries_ = 0;
    std::int64_t looks_ = 0;
};

}  // namespace mobbscope
