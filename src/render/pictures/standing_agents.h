/// People at one moment: each a skeleton, or its capsules, in its cylinder of glass, or a plain cylinder where it is
/// small.
#pragma once

#include <render/drawlist/draw_list.h>
#include <render/drawlist/picture_options.h>
#include <render/pictures/moment.h>
#include <render/text/labels.h>

#include <span>
#include <vector>

namespace mobbscope {

/// Which of the bodies' parts are drawn.
struct BodyParts {
    bool disks = true;  ///< on the floor
    bool walls = true;  ///< of the cylinders
};

/// Adds them. Needs the projection.
void add_bodies(DrawList& list, std::span<const DrawnAgent> agents, const Moment& moment, BodyParts parts, float scale);

/// The radius of a body as a line on the floor to below the joint that reaches farthest, and up to that joint on the
/// wall; the length stands beside it in the returned label, if the body is large enough to be read.
std::vector<LabelRequest> add_radius(DrawList& list, const DrawnAgent& agent, const Body& body, const Metrics& metrics);

/// The shortest way on the floor between two disks, with its length to stand beside it.
std::vector<LabelRequest> add_clearance(DrawList& list, const Body& a, const Body& b, const Metrics& metrics);

/// The two nearest bones, and the way between them with its length to stand beside it. Requires Moment::bones.
std::vector<LabelRequest> add_nearest_bones(DrawList& list, std::span<const DrawnAgent> agents, const Moment& moment,
                                            const Metrics& metrics);

/// Names above the cylinders.
void add_body_names(DrawList& list, LabelLayout& layout, std::span<const DrawnAgent> agents, const Moment& moment,
                    const Metrics& metrics);

}  // namespace mobbscope
