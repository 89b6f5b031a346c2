/// The view with a camera that says where it stands, for commands that move it.
#pragma once

#include <app/session.h>

#include <functional>

namespace mobbscope::app {

/// Of the viewport's picture; without a window that of `render`.
PictureSize viewport_size(const Session& session);

/// Looks from elsewhere: `move` turns the present explicit camera into another. Time keeps the height that it has now,
/// as the camera's target is measured in it. Requires a scene.
void move_camera(Session& session, const std::function<Camera(const Camera&, PictureSize)>& move);

/// What `selected` covers of what the present picture shows, as cameras' targets are measured: world metres with time
/// drawn as height, or in the picture of a moment real height. None if it is not in the picture.
struct SceneBox {
    glm::dvec3 min{0}, max{0};
};
std::optional<SceneBox> box_of(const Session& session, const Selection& selected);

}  // namespace mobbscope::app
