/// From a camera that frames the scene by itself to one that says where it stands.
#pragma once

#include <render/drawlist/draw_list.h>
#include <scene/view_state.h>

namespace mobbscope {

/// The explicit camera (preset free, with a target) that shows what `list.projection` shows; `camera` is the one that
/// the list was built with. The target lies in the middle of the picture's free part, as deep as the middle of the
/// disks and boxes. It is in world metres with time drawn `list.space.time_height` high, which the view has to keep. A
/// camera that has a target keeps it. A field of view beyond kMostFov, as a tiny picture may have, is cut to that.
Camera resolved_camera(const Camera& camera, const DrawList& list);

/// The same for a projection that framed `camera`; the target is as deep as `middle` (drawn space).
Camera resolved_camera(const Camera& camera, const ViewProjection& projection, const DrawnSpace& space,
                       glm::dvec3 middle);

}  // namespace mobbscope
