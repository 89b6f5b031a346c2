/// What a crowd is committed to: every agent's moves, and the room that it needs where they end.
#pragma once

#include <crowd/move_set.h>
#include <crowd/world.h>
#include <scene/crowd_run.h>

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace mobbscope {

/// Refers to the moves, which must outlive it.
class Commitments {
  public:
    /// The floor of `area` metres; room is kept for `grace` seconds, 0: none.
    Commitments(const MoveSet& moves, glm::dvec2 area, double grace);

    /// An agent's play, later than all it is committed to.
    void commit(int agent, int index, const Play& play);
    /// Drops what ends at `now` or before.
    void forget_before(double now);

    const World& motions() const { return motions_; }

    /// For each play that might follow: whether it runs through the place where another agent's moves end, in the grace
    /// after that; whether it ends where another agent will pass or stand in the grace after it; or whether there is no
    /// room before the wall where it ends. Whoever takes such a one leaves somebody, perhaps himself, without a choice.
    /// Without a grace all are false.
    std::vector<bool> in_the_way(int agent, int index, std::span<const Play> plays) const;

  private:
    /// A disk that stands, for the grace, where a play ends.
    PlayedMove stand(int agent, int index, const Play& play) const;
    bool faces_wall(const Play& play) const;

    struct Stand {
        mobb::Tree tree;
        Outline outline;
    };

    const MoveSet& moves_;
    glm::dvec2 area_;
    std::vector<Stand> stand_of_clip_;  ///< as large as the clip's last disk; empty without a grace
    World motions_;
    World stands_;
    std::vector<std::optional<std::size_t>> stand_of_agent_;  ///< what stands_ gave for the agent's last play
};

}  // namespace mobbscope
