/// The moves of a scene's graph, ready to be placed and asked about.
#pragma once

#include <crowd/outline.h>
#include <crowd/world.h>
#include <scene/fitted_scene.h>
#include <scene/motion_graph.h>

#include <vector>

namespace mobbscope {

/// Refers to the scene, which must outlive it and have a graph.
class MoveSet {
  public:
    explicit MoveSet(const FittedScene& fitted);

    const FittedScene& fitted() const { return *fitted_; }
    const MotionGraph& graph() const { return *fitted_->scene().graph; }
    std::size_t count() const { return graph().moves.size(); }
    const GraphMove& move(int move) const { return graph().moves[static_cast<std::size_t>(move)]; }
    const mobb::Tree& tree(int move) const { return fitted_->tree(this->move(move).clip); }
    const Outline& outline(int move) const { return outlines_[static_cast<std::size_t>(this->move(move).clip)]; }
    double duration(int move) const { return tree(move).clip().duration(); }
    /// The moves that begin in the hub where `move` ends.
    const std::vector<int>& after(int move) const { return by_hub_[static_cast<std::size_t>(this->move(move).to)]; }
    /// Where `next` is placed after `before`, turned by `turn_deg` on the spot between them.
    mobb::Placement following(int before, const mobb::Placement& placed, int next, double turn_deg) const;
    /// A move as an agent's play.
    PlayedMove motion(int agent, int play, int move, const mobb::Placement& placement) const {
        return {agent, play, &tree(move), &outline(move), placement};
    }

  private:
    const FittedScene* fitted_;
    std::vector<Outline> outlines_;  ///< by clip
    std::vector<std::vector<int>> by_hub_;
};

}  // namespace mobbscope
