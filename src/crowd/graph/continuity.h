/// How continuous motion is where moves join: what changes from frame to frame across a join, against the most that the
/// same changes inside the two moves that it joins.
#pragma once

#include <crowd/graph/foot_slide.h>
#include <import/skeleton/motion.h>
#include <mobb/clip.h>
#include <scene/motion_graph.h>
#include <scene/scene.h>

#include <glm/gtc/quaternion.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <cstddef>
#include <string_view>
#include <utility>
#include <vector>

namespace mobbscope {

/// What changes from frame to frame. In the order of kChanges.
enum class Change : unsigned char {
    joint_position,  ///< how far each joint of the body goes from a frame to the next, in the world
    heading,         ///< how far the root joint turns about the vertical from a frame to the next
    root_velocity,   ///< how much the root's velocity on the floor changes from a step to the next
    joint_velocity,  ///< how much each joint's velocity does, in space
};

struct ChangeRow {
    std::string_view key;  ///< in JSON
    std::string_view words;
    std::string_view unit;  ///< of a change
    double least;           ///< what changes less than this inside both moves counts as changing so much
    bool bounded;           ///< by kMostRatio
};

inline constexpr std::array<ChangeRow, 4> kChanges{{
    {"joint_position", "joint position", "m", 0.002, true},
    {"heading", "heading", "degrees", 0.2, true},
    {"root_velocity", "root velocity", "m/s", 0.02, true},
    {"joint_velocity", "joint velocity", "m/s", 0.02, false},
}};

/// What is bounded changes across a join at most so many times as much as inside the moves, joint by joint.
inline constexpr double kMostRatio = 1.25;

/// Where all joints of a body are, and which way its root is turned.
struct BodyPose {
    std::vector<glm::dvec3> joints;  ///< metres; the first is the root
    glm::dquat root{1, 0, 0, 0};     ///< from the root's own axes
};

/// By Change the largest of each joint; of what is not of joints one number.
using LargestChanges = std::array<std::vector<double>, kChanges.size()>;

/// Of a joint that stands from the begin of a move, or up to its end, where it is in those frames.
struct Stand {
    int joint = 0;  ///< index into the skeleton's joints
    std::vector<glm::dvec2> places;
};

/// What of a move must be known to tell how it goes on with others.
struct MoveMotion {
    double dt = 0;
    int rig = 0;                     ///< moves of one rig have the same joints
    std::vector<int> joints;         ///< of BodyPose::joints, their indices in the skeleton
    std::vector<BodyPose> begin;     ///< the first two frames, seen from the entry stance: at 0, heading along +x
    std::vector<BodyPose> end;       ///< the last two frames, in their order, seen from the exit stance
    LargestChanges inside;           ///< from frame to frame of the move
    std::vector<double> slides;      ///< metres, of each contact within the move
    std::vector<int> slide_joints;   ///< of each, the joint
    std::vector<Stand> stand_first;  ///< seen from the entry stance
    std::vector<Stand> stand_last;   ///< seen from the exit stance
};

/// `stands`: what stands in the move's frames (`standing`), found in the same clip or in the one that it was made of.
MoveMotion motion_of(const mobb::Clip& clip, const Skeleton& skeleton, int rig, const Stance& entry, const Stance& exit,
                     const std::vector<Contact>& stands);

/// What changes across the join of two moves of one rig and dt, whose second one is turned by `turn_deg` on the spot:
/// from the last frame of the first to the first frame of the second, and for velocities from the last step to the step
/// across, and from that to the first step.
LargestChanges changes_across(const MoveMotion& before, const MoveMotion& after, double turn_deg = 0);

/// The join at which a change is largest against what is inside the two moves.
struct LargestRatio {
    double ratio = 0;
    double across = 0;  ///< the change there
    double inside = 0;  ///< the largest inside the two moves, at least ChangeRow::least
    int joint = -1;     ///< index into the joints of clip_with_joints; the root for what is not of joints
    int before = -1;    ///< the moves: indices into the graph's; -1: no join was measured
    int after = -1;
    std::size_t over = 0;  ///< joins with a ratio over kMostRatio
};

/// How far a foot slides that should stand.
struct LargestSlide {
    double metres = 0;
    int joint = -1;   ///< index into the joints of clip_with_joints; -1: none stood
    int before = -1;  ///< the move; of a contact across a join the one before it
    int after = -1;   ///< the move after it; -1: within one move
};

struct Continuity {
    std::size_t joins = 0;
    std::size_t measured = 0;   ///< of those: both moves have skeletons, of one rig, and one dt
    std::size_t different = 0;  ///< joins measured, those between the same two moves at the same turn counted once
    std::size_t over = 0;       ///< joins at which something bounded has a ratio over kMostRatio
    std::array<LargestRatio, kChanges.size()> largest;
    std::size_t contacts = 0;  ///< within the moves
    double median_slide = 0;   ///< metres, of those
    LargestSlide within;       ///< the largest slide of those
    LargestSlide across;       ///< and of contacts that go on across a join
};

/// Whether a graph promises kMostRatio at its joins: its moves are warped to their hubs.
bool promises_continuity(const Scene& scene);

/// Over all transitions of the scene's graph, and its moves. Throws InputError if there are too many.
Continuity graph_continuity(const Scene& scene);

/// The clip whose skeleton has a move's joints: the move's own or, of a turned one without a skeleton, that of the move
/// that it is a variant of. An index into Scene::clips.
int clip_with_joints(const Scene& scene, const GraphMove& move);

/// Whether something bounded has a ratio over kMostRatio, for each of these transitions of the scene's graph.
std::vector<bool> joins_over(const Scene& scene, const std::vector<std::pair<int, int>>& transitions);

/// Of a run's joins and of what was played there.
struct RunContinuity {
    Continuity free;    ///< joins with a play that was free, and all moves that are played
    Continuity forced;  ///< joins with a forced play, and no moves
};

/// Over all joins of the scene's run. A turned clip without a skeleton has that of clip_with_joints, turned.
/// `importer` reads what was recorded, unless it has before.
RunContinuity run_continuity(const Scene& scene, Importer& importer);

}  // namespace mobbscope
