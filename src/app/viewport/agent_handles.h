/// Handles on the selected agent: move it on the floor, turn it, shift it in time.
#pragma once

#include <app/ui/ui.h>
#include <explain/margins.h>
#include <mobb/clip.h>
#include <render/drawlist/draw_list.h>

#include <imgui.h>

#include <optional>
#include <vector>

namespace mobbscope::app {

/// The picture and where it stands in the window.
struct ShownPicture {
    const DrawList& list;
    ImVec2 corner;  ///< of the picture's first pixel, framebuffer pixels

    /// Where a point of drawn space is seen; none behind the eye.
    std::optional<ImVec2> at(glm::vec3 point) const;
    glm::vec2 pixel(ImVec2 at) const { return {at.x - corner.x, at.y - corner.y}; }
};

enum class Handle { none, move, turn, shift };

/// Where the handles of a path stand in the picture, pixels of the window.
struct HandlePlaces {
    double time = 0;                          ///< of the plane in which it is moved and turned: when the path starts
    glm::dvec2 pivot{0};                      ///< where the path starts, world metres
    double radius = 0;                        ///< of the ring that turns it, metres
    std::optional<ImVec2> move, turn, shift;  ///< their middles; none where they cannot be seen or have no meaning
};
HandlePlaces handle_places(Ui& ui, const ShownPicture& picture, const mobb::PlacedClip& clip);

/// The handle nearest to a pixel of the window, if one is within reach of it.
Handle handle_at(Ui& ui, const HandlePlaces& places, ImVec2 mouse);

/// Draws them; `lit` is under the mouse or held.
void draw_handles(Ui& ui, const ShownPicture& picture, const HandlePlaces& places, Handle lit);

/// One drag of a handle: where the mouse took hold, and what then was.
struct HandleDrag {
    Handle handle = Handle::none;
    int agent = -1;
    mobb::Placement start;
    glm::dvec2 pivot{0};  ///< about which it is turned, world metres
    double time = 0;      ///< of the plane in which it is dragged
    glm::vec2 from{0};    ///< pixel of the picture
};

/// What the proof of a miss promises of a drag of one of the two: while it stays in there, the answer cannot change.
struct DragPromise {
    Certificate certificate;
    Margins margins;
    bool of_a = false;  ///< the first of the two is dragged, so the other one's region is mirrored

    /// How far it may still go, metres or seconds; 0 or less: no further, the answer may have changed. None of a turn,
    /// of which nothing is promised.
    std::optional<double> room(const HandleDrag& drag, const mobb::Placement& now) const;
    /// Where the dragged one may start, world metres: a convex polygon.
    std::vector<glm::dvec2> region(const HandleDrag& drag) const;
};

/// Draws the region of a promise; `kept`: the agent is in it.
void draw_promise(Ui& ui, const ShownPicture& picture, const DragPromise& promise, const HandleDrag& drag, bool kept);

/// The placement with the mouse at a pixel of the picture; none where the line of sight misses the floor. `snap`: whole
/// decimetres, steps of 5 degrees, tenths of a second.
std::optional<mobb::Placement> dragged(const HandleDrag& drag, const DrawList& list, glm::vec2 pixel, bool snap);

}  // namespace mobbscope::app
