/// What the window draws over the picture: what is selected or under the mouse. It is no part of the picture itself.
#pragma once

#include <app/document/selection.h>
#include <app/ui/ui.h>

#include <glm/vec3.hpp>

#include <span>

namespace mobbscope::app {

/// The picture and where it stands in the window.
struct ShownPicture {
    const DrawList& list;
    ImVec2 corner;  ///< of the picture's first pixel, framebuffer pixels

    /// Where a point of drawn space is seen; none behind the eye.
    std::optional<ImVec2> at(glm::vec3 point) const;
    glm::vec2 pixel(ImVec2 at) const { return {at.x - corner.x, at.y - corner.y}; }
};

/// A line through points of drawn space, on a darker or lighter ground line that sets it off from what is below.
void draw_line(Ui& ui, const ShownPicture& picture, std::span<const glm::vec3> points, bool closed, ImU32 color,
               float width);

/// Outlines a node's box, a sample's disk, or the ends of a path.
void draw_highlight(Ui& ui, const ShownPicture& picture, const Selection& what, ImU32 color, float width);

/// Points out one of the moves that the followed agent could choose, if it is in the picture.
void draw_candidate(Ui& ui, const ShownPicture& picture);

/// Points out whom the followed agent is about to meet in the conflict that was gone to.
void draw_other_of_conflict(Ui& ui, const ShownPicture& picture);

/// What a selection is, in words and numbers, a line each: first its name.
struct Described {
    std::string name;
    std::vector<std::pair<std::string, std::string>> facts;  ///< "time", "1.20..1.53 s"
};
Described describe(const FittedScene& fitted, const Selection& what);

}  // namespace mobbscope::app
