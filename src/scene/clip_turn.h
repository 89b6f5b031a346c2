/// Clips whose way is bent: whoever plays one turns on the way, and not in no time.
#pragma once

#include <mobb/clip.h>

#include <memory>

namespace mobbscope {

struct SceneClip;  // scene/scene.h
struct Skeleton;   // import/skeleton/motion.h
struct Stance;     // scene/motion_graph.h

/// A turn from the begin of a clip on, beside what the recording turns by itself. The angular speed that it adds is
/// zero at its begin and end and largest in its middle: 1.5 * |deg| / seconds.
struct ClipTurn {
    double deg = 0;      ///< counter-clockwise, from -180 to 180
    double seconds = 0;  ///< over 0, at most Clip::until_next

    /// Degrees turned so far at a time of the clip, in seconds.
    double at(double time) const;
    friend bool operator==(const ClipTurn&, const ClipTurn&) = default;
};

/// The turn whose largest angular speed is `rate` degrees per second, over 0.
ClipTurn turn_at_rate(double deg, double rate);

/// The clip with every step of its path turned by what the turn has come to in the middle of the step: the first disk
/// stays, and radii and the lengths of steps too. Throws std::invalid_argument if that leads beyond what a clip holds.
mobb::ClipPtr bent(const mobb::Clip& clip, const ClipTurn& turn);

/// Where the bent clip's stance is that the clip has one dt after its last sample.
Stance bent_exit(const mobb::Clip& clip, const mobb::Clip& bent_clip, const Stance& exit, const ClipTurn& turn);

/// The clip's skeleton with its samples turned as the bent clip is.
std::shared_ptr<const Skeleton> turned_skeleton(const Skeleton& skeleton, const mobb::Clip& clip, const ClipTurn& turn);

/// Bends the clip and turns its skeleton's samples with it; `clip.turn` says by how much. Throws std::invalid_argument
/// if the turn lasts longer than Clip::until_next, or as `bent` does.
void bend(SceneClip& clip, const ClipTurn& turn);

}  // namespace mobbscope
