/// Who is on the floor at one moment, in numbers: what the picture of it draws and says.
#pragma once

#include <explain/bodies.h>
#include <render/layout/caption.h>
#include <render/layout/legend.h>
#include <scene/drawn_agent.h>

#include <optional>
#include <span>
#include <vector>

namespace mobbscope {

/// The joint whose distance from the root makes the disk as large as it is.
struct FarthestJoint {
    int joint = 0;        ///< of the skeleton
    double distance = 0;  ///< metres on the floor from the centre of the disk
};

/// Somebody who stands there then: of who is several disks one of these, which stand together.
struct Body {
    int agent = 0;                            ///< index into the drawn agents
    int sample = 0;                           ///< that holds then
    mobb::Disk disk;                          ///< that sample in the world
    double height = 0;                        ///< metres, of the cylinder
    std::optional<FarthestJoint> farthest{};  ///< none without a skeleton, and of more than two
    bool overlaps = false;                    ///< with any other
    bool waits = false;                       ///< see waits_at
};

/// Whether that joint lies on the cylinder's wall: it does unless the clip was given a radius of its own.
bool sets_radius(const Body& body);

/// Whether somebody who walks from sample to sample (a linear clip) stays where he is: until the next sample, at the
/// last one since the one before.
bool waits_at(const mobb::PlacedClip& clip, int sample);

/// Two of them.
struct BodyPair {
    int a = 0, b = 0;      ///< indices into Moment::bodies, a < b
    double clearance = 0;  ///< metres between their disks; < 0: how deep they overlap
};

struct Moment {
    double time = 0;  ///< global seconds
    std::vector<Body> bodies;
    std::vector<BodyPair> overlaps;   ///< of all agents whose disks collide (mobb/predicate.h) the deepest two
    std::optional<BodyPair> nearest;  ///< if no pair overlaps: the one with the least clearance
    /// Of a query of two with skeletons that are there: their bones as capsules of kBoneRadius.
    std::optional<NearestBones> bones{};
};

/// Whether a body is the first of its agent's.
bool is_first_of(const Moment& moment, const Body& body);
/// How many agents stand there.
std::size_t people_in(const Moment& moment);

/// `heights`: of the agents' cylinders, one for each.
Moment moment_of(std::span<const DrawnAgent> agents, std::span<const double> heights, double time);

/// Moment::bones of two agents; none if one of them is not there or has no skeleton.
std::optional<NearestBones> bones_then(std::span<const DrawnAgent> agents, const Moment& moment);

/// How tall the agents' cylinders are, metres: a little more than the highest joint of the whole clip, so that they
/// keep their height while people walk.
std::vector<double> cylinder_heights(std::span<const DrawnAgent> agents);

/// Who is there, of so many people, and who overlaps whom, or how near they come.
Caption moment_caption(const Palette& palette, std::span<const DrawnAgent> agents, const Moment& moment,
                       std::size_t people);

/// Radii of few are drawn as lines; those of more would be told apart by nobody.
bool may_show_radii(std::span<const DrawnAgent> agents);

/// What the picture's colours and lines stand for, whenever it is: the legend stays while time runs. `paths`: of the
/// agents. `bones`: whether these are capsules at any time. Needs the projection.
std::vector<LegendEntry> moment_legend(const DrawList& list, std::span<const DrawnAgent> agents,
                                       std::span<const DrawnAgent> paths, const ViewState& view, bool bones);

}  // namespace mobbscope
