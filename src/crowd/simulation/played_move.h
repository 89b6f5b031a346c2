/// A motion where somebody plays it, or may play it.
#pragma once

#include <mobb/blocks.h>
#include <mobb/clip.h>
#include <mobb/kdop.h>
#include <mobb/lanes.h>
#include <mobb/placed_tree.h>
#include <mobb/tree.h>
#include <scene/motion_graph.h>

#include <glm/common.hpp>
#include <glm/vec2.hpp>

#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>

namespace mobbscope {

/// A rectangle along the axes of the floor, in metres.
struct FloorRect {
    glm::dvec2 low{0};
    glm::dvec2 high{0};

    bool meets(const FloorRect& other) const {
        return !mobb::any((mobb::lanes(low) > mobb::lanes(other.high)) | (mobb::lanes(other.low) > mobb::lanes(high)));
    }
    /// Around both.
    FloorRect with(const FloorRect& other) const { return {glm::min(low, other.low), glm::max(high, other.high)}; }
};

/// A polygon around all disks of a clip. Where a run's agents first stand is drawn by these bounds: with others the
/// same seed would give another run.
class ClipBounds {
  public:
    explicit ClipBounds(const mobb::Clip& clip);

    /// Holds every disk of the clip where it is placed (metres), rounding included.
    FloorRect bounds(const mobb::Placement& at) const;

  private:
    static constexpr std::size_t kCorners = mobb::KDop::kDirections / 2;

    std::array<double, kCorners> x_, y_;  ///< of the corners, in the clip's frame
    double reach_;                        ///< of the clip: what rounding is measured by
};

/// A clip with all that is asked of it wherever it is played.
struct PlayableClip {
    /// `asked`: a tree over the clip that queries go through instead of the blocks; null: none.
    explicit PlayableClip(mobb::ClipPtr clip, std::shared_ptr<const mobb::Tree> asked = nullptr)
        : blocks(std::move(clip)),
          tree(std::move(asked)),
          last(blocks.clip().samples().back()),
          bounds(blocks.clip()) {}

    const mobb::Clip& clip() const { return blocks.clip(); }

    mobb::Blocks blocks;
    std::shared_ptr<const mobb::Tree> tree;
    mobb::Disk last;  ///< of the clip
    ClipBounds bounds;
};

/// Whether a disk of a clip that is placed reaches over a wall of the floor, which goes from -area/2 to area/2
/// (metres). Touching a wall is not over it.
inline bool is_over_wall(const mobb::Disk& disk, const mobb::Placement& at, glm::dvec2 area) {
    const mobb::Disk there = mobb::placed(disk, at.rotation(), at.translate);
    // Without a branch for each, which would often be mispredicted.
    return static_cast<bool>(static_cast<unsigned>(std::abs(there.x) + there.r > area.x / 2) |
                             static_cast<unsigned>(std::abs(there.y) + there.r > area.y / 2));
}

/// The bounds of a clip where it is placed, or none if some disk is over a wall.
std::optional<FloorRect> bounds_on_floor(const PlayableClip& clip, const mobb::Placement& at, glm::dvec2 area);

/// A clip that an agent plays, or may play. What queries need of the place is worked out once, as it is made. Refers to
/// the clip, which must outlive it.
struct PlayedMove {
    /// `play_index`: among the agent's plays; `move_index`: among those of the MoveSet, -1: somebody who stands.
    /// Throws std::invalid_argument, naming the number, unless is_valid(where).
    PlayedMove(int agent_index, int play_index, int move_index, const PlayableClip& clip, const mobb::Placement& where)
        : PlayedMove(agent_index, play_index, move_index, clip, where, clip.bounds.bounds(where)) {}
    /// The same with the clip's bounds where it is placed.
    PlayedMove(int agent_index, int play_index, int move_index, const PlayableClip& clip, const mobb::Placement& where,
               const FloorRect& placed_bounds)
        : agent(agent_index),
          play(play_index),
          move(move_index),
          playable(&clip),
          at(where),
          placed(clip.blocks, where),
          bounds(placed_bounds) {}

    double begin() const { return placed.begin_time(); }  ///< global seconds
    double end() const { return placed.end_time(); }
    /// Of a clip that has a tree.
    mobb::PlacedTree placed_tree() const { return {*playable->tree, at}; }

    int agent;
    int play;               ///< a Blocker repeats it
    int move;               ///< likewise; of a joint the move that it leads to
    int planned = 0;        ///< 0: the play itself; else which of the moves that are planned to follow it, from 1
    bool is_joint = false;  ///< what a linear move runs on by to that one (MoveSet::joint)
    const PlayableClip* playable;
    mobb::Placement at;
    mobb::PlacedBlocks placed;
    FloorRect bounds;  ///< holds every disk
};

}  // namespace mobbscope
