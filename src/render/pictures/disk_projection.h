/// One disk and how far it reaches along the axes of a box around it: the paper's Fig. 6.
#pragma once

#include <render/pictures/picture.h>
#include <scene/drawn_agent.h>
#include <scene/view_state.h>

#include <array>
#include <memory>

namespace mobbscope {

/// What a disk covers along an axis of a box, metres from the centre of its base.
struct AxisExtent {
    int axis = 0;              ///< of the box
    glm::dvec3 direction{0};   ///< unit, in world (x, y, w*t)
    double min = 0;            ///< <= 0
    double max = 0;            ///< >= 0
    glm::dvec3 min_corner{0};  ///< the point of the disk that is the least along the axis, from the centre of its base
    glm::dvec3 max_corner{0};
};

struct DiskExtents {
    glm::dvec3 base{0};     ///< centre of the base, world (x, y, w*t)
    glm::dvec3 heading{0};  ///< unit, on the floor: the way of the radius vector, along axis 0
    double radius = 0;      ///< of the base, metres
    glm::dvec3 rise{0};     ///< from there to the centre of the upper face, w*dt above: of a linear clip it leans
    double top_radius = 0;  ///< of the upper face, metres
    /// Of a free box along its axes 0 and 2, as axis 1 lies on the floor, where an upright disk reaches its radius
    /// either way; of any other box along the two on the floor.
    std::array<AxisExtent, 2> along;
};

/// `node` and `sample` of the agent's tree and clip; the node bounds the sample.
DiskExtents disk_extents(const DrawnAgent& agent, int node, int sample);

/// The picture of the view's projection. Unless the view says how high time is drawn it has the height that the box is
/// fitted with, so that right angles are seen as such. The scene outlives the picture. Throws std::invalid_argument,
/// saying what there is, if it names an agent, a node or a sample of the node that does not exist.
std::unique_ptr<Picture> disk_projection_picture(const FittedScene& fitted, const ViewState& view,
                                                 const PictureOptions& options);

}  // namespace mobbscope
