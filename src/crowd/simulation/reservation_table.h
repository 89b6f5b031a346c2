/// The moves that the agents of a crowd have reserved, and the room kept free where they end.
#pragma once

#include <crowd/simulation/move_set.h>
#include <crowd/simulation/reservation_grid.h>
#include <scene/crowd_run.h>

#include <cstddef>
#include <optional>
#include <vector>

namespace mobbscope {

/// Every agent's reserved moves. Refers to the moves, which must outlive it.
class ReservationTable {
  public:
    /// The floor of `area` metres; room is kept for `grace` seconds, 0: none.
    ReservationTable(const MoveSet& moves, glm::dvec2 area, double grace);

    /// Reserves an agent's play, which must begin after all that the agent has reserved, the joint that leads to it
    /// from the play reserved before, and in place of what the agent had planned before what is planned to follow the
    /// play.
    void reserve(int agent, int index, const Play& play);
    /// Drops what ends at `now` or before.
    void forget_before(double now);

    const ReservationGrid& motions() const { return motions_; }  ///< that are played
    const ReservationGrid& plans() const { return plans_; }      ///< that are planned to follow

    /// What is reserved near some candidates. It may be asked until something is reserved or forgotten.
    struct Nearby {
        Surroundings motions, plans, stands;
    };
    /// Near all that may follow a play of an agent: where they are, and for the grace where they end.
    Nearby nearby(int agent, const MoveSet::Room& room) const;
    /// Near one move of the set, likewise.
    Nearby nearby(const PlayedMove& motion) const;

    /// Whether a move of the set that might follow would leave some agent, perhaps its own, without a free choice: it
    /// runs through the place where another agent's moves end, within the grace after that; or it ends where another
    /// agent passes or stands within the grace; or it faces a wall. Without a grace it is false.
    /// `nearby`: what is near it.
    bool in_the_way(const PlayedMove& motion, const Nearby& nearby) const;

    /// Whether a move, where it is placed, ends too near a wall to turn round before it: neither half circle to the
    /// left nor to the right lies on the floor, at the speed with which the move ends and the set's turn rate. Of
    /// agents that turn at once, or never, whether a wall is within a metre straight ahead.
    bool faces_wall(int move, const mobb::Placement& placed) const;

  private:
    /// A disk that stands, for the grace, where a move of the set ends, from when it runs on.
    PlayedMove stand(const PlayedMove& motion) const;

    const MoveSet& moves_;
    glm::dvec2 area_;
    double grace_;
    std::vector<PlayableClip> stand_of_clip_;  ///< as large as the clip's last disk; empty without a grace
    ReservationGrid motions_;
    ReservationGrid plans_;
    ReservationGrid stands_;
    std::vector<std::optional<Play>> runs_on_;                ///< the agent's last play, if it does
    std::vector<std::vector<std::size_t>> plan_of_agent_;     ///< what plans_ gave for the agent's last plan
    std::vector<std::optional<std::size_t>> stand_of_agent_;  ///< what stands_ gave for the agent's last play
};

}  // namespace mobbscope
