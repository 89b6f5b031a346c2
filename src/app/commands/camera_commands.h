/// The view with a camera that says where it stands, for commands that move it.
#pragma once

#include <app/session/session.h>
#include <render/drawlist/draw_list.h>
#include <render/layout/framing.h>

#include <array>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace mobbscope::app {

/// Of the viewport's picture; without a window that of `render`.
PictureSize viewport_size(const Views& views);

/// Looks from elsewhere: `move` turns the present explicit camera, and what it shows, into another. Time keeps the
/// height that it has now, as the camera's target is measured in it. Requires a scene.
void move_camera(Views& views, Workspace& workspace,
                 const std::function<Camera(const Camera&, const PictureFrame&)>& move);

/// What `selected` covers of what the present picture shows, in (x, y, t), or in the picture of a moment (x, y,
/// height). None if it is not in the picture.
std::optional<Bounds> box_of(const Workspace& workspace, const Selection& selected);

/// What a slab leaves of the paths in space-time, and the boxes too where they are framed; none: there is no slab, or
/// nothing in it.
std::optional<Bounds> box_of_slab(const Workspace& workspace);

/// What the pair under test covers, likewise; none without a query in view, or in the picture of a moment.
std::optional<Bounds> box_of_test(const Workspace& workspace);

/// The corners of the two boxes under test, in (x, y, t); none where box_of_test has none.
using TestCorners = std::array<std::vector<glm::dvec3>, 2>;
std::optional<TestCorners> corners_of_test(const Workspace& workspace);

/// Whether both boxes lie wholly in the part of a picture that no panel covers, and are together not small.
bool is_well_seen(const TestCorners& boxes, const PictureFrame& picture, std::span<const Rect> panels);

/// The camera that has both boxes beside the panels, with so much room around them that smaller boxes in them and near
/// them are well seen too.
Camera framing_beside(const TestCorners& boxes, const PictureFrame& picture, std::span<const Rect> panels);

/// Brings a box that box_of gave into the middle, as large as it fits.
void frame_box(Views& views, Workspace& workspace, const Bounds& box);

/// Frames both boxes so, as what the present step brings along: the state of the history that shows the step has the
/// camera too.
void go_along_with(Views& views, Workspace& workspace, const TestCorners& boxes, std::span<const Rect> panels);

bool follows(const Workspace& workspace);

/// Follows and selects an agent, with so many metres around it in the picture. Throws std::invalid_argument if there is
/// no agent of that name.
void follow_agent(Workspace& workspace, Views& views, const std::string& name, double metres);

/// Brings so many metres around the followed agent into the picture.
void frame_followed(Views& views, Workspace& workspace, double metres);

/// Puts the followed agent in the middle again, seen from as far as before.
void center_followed(Views& views, Workspace& workspace);

}  // namespace mobbscope::app
