/// The moves that the agents of a crowd have reserved, and the room kept free where they end.
#pragma once

#include <crowd/simulation/reservation_grid.h>
#include <scene/crowd_run.h>
#include <scene/fitted_scene.h>
#include <scene/motion_graph.h>

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace mobbscope {

/// The moves of a motion graph, fitted. Refers to the scene, which must outlive it and have a graph.
class MoveSet {
  public:
    explicit MoveSet(const FittedScene& fitted);

    const FittedScene& fitted() const { return *fitted_; }
    const MotionGraph& graph() const { return *fitted_->scene().graph; }
    std::size_t count() const { return graph().moves.size(); }
    const GraphMove& move(int move) const { return graph().moves[static_cast<std::size_t>(move)]; }
    const mobb::Tree& tree(int move) const { return fitted_->tree(this->move(move).clip); }
    const ClipBounds& bounds(int move) const { return bounds_[static_cast<std::size_t>(this->move(move).clip)]; }
    double duration(int move) const { return tree(move).clip().duration(); }
    /// The moves that begin in the hub where `move` ends.
    const std::vector<int>& after(int move) const { return by_hub_[static_cast<std::size_t>(this->move(move).to)]; }
    /// The same, those first that take least room: floor times seconds.
    const std::vector<int>& after_by_room(int move) const {
        return by_room_[static_cast<std::size_t>(this->move(move).to)];
    }
    /// Where `next` is placed after `before`, turned by `turn_deg` on the spot between them.
    mobb::Placement following(int before, const mobb::Placement& placed, int next, double turn_deg) const;
    /// A move as an agent's play.
    PlayedMove motion(int agent, int play, int move, const mobb::Placement& placement) const {
        return {agent, play, &tree(move), &bounds(move), placement};
    }
    /// The moves that are planned to follow an agent's play.
    std::vector<PlayedMove> planned(int agent, int index, const Play& play) const;

  private:
    const FittedScene* fitted_;
    std::vector<ClipBounds> bounds_;  ///< by clip
    std::vector<std::vector<int>> by_hub_;
    std::vector<std::vector<int>> by_room_;
};

/// Every agent's reserved moves. Refers to the moves, which must outlive it.
class ReservationTable {
  public:
    /// The floor of `area` metres; room is kept for `grace` seconds, 0: none.
    ReservationTable(const MoveSet& moves, glm::dvec2 area, double grace);

    /// Reserves an agent's play, which must begin after all that the agent has reserved, and in place of what the agent
    /// had planned before what is planned to follow the play.
    void reserve(int agent, int index, const Play& play);
    /// Drops what ends at `now` or before.
    void forget_before(double now);

    const ReservationGrid& motions() const { return motions_; }  ///< that are played
    const ReservationGrid& plans() const { return plans_; }      ///< that are planned to follow

    /// For each play that might follow, whether it would leave some agent, perhaps this one, without a free choice: it
    /// runs through the place where another agent's moves end, within the grace after that; or it ends where another
    /// agent passes or stands within the grace; or it ends too near a wall. Without a grace all are false.
    std::vector<bool> in_the_way(int agent, int index, std::span<const Play> plays) const;

  private:
    /// A disk that stands, for the grace, where a play ends.
    PlayedMove stand(int agent, int index, const Play& play) const;
    bool faces_wall(const Play& play) const;

    struct Stand {
        mobb::Tree tree;
        ClipBounds clip_bounds;
    };

    const MoveSet& moves_;
    glm::dvec2 area_;
    std::vector<Stand> stand_of_clip_;  ///< as large as the clip's last disk; empty without a grace
    ReservationGrid motions_;
    ReservationGrid plans_;
    ReservationGrid stands_;
    std::vector<std::vector<std::size_t>> plan_of_agent_;     ///< what plans_ gave for the agent's last plan
    std::vector<std::optional<std::size_t>> stand_of_agent_;  ///< what stands_ gave for the agent's last play
};

}  // namespace mobbscope
