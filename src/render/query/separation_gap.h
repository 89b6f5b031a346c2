/// The gap that separates two boxes, or two times, in the scene.
#pragma once

#include <render/drawlist/draw_list.h>
#include <scene/drawn_agent.h>

#include <mobb/trace.h>

#include <optional>
#include <span>

namespace mobbscope {

/// A gap in world (x, y, w*t): two parallel rectangles that face each other across it; of moving boxes two lines, at
/// the moment when they are nearest.
struct SeparationGap {
    glm::dvec3 from{0};    ///< middle of the rectangle on A's side
    glm::dvec3 to{0};      ///< ... and on B's: from + axis * gap
    glm::dvec3 across{0};  ///< half edges of both rectangles
    glm::dvec3 along{0};
};

/// Of a `separated` event; none for another. `sides`: A and B.
std::optional<SeparationGap> separation_gap(std::span<const DrawnAgent> sides, const mobb::Trace::Event& event);

/// Draws it; returns where its label goes (drawn space).
glm::vec3 add_separation_gap(DrawList& list, const SeparationGap& gap, double time_scale, float scale);

/// The time between two nodes that are apart in it: from the end of the earlier to the beginning of the later (drawn
/// space).
struct TimeGap {
    glm::vec3 from{0};
    glm::vec3 to{0};
    double seconds = 0;
};
std::optional<TimeGap> time_gap(std::span<const DrawnAgent> sides, const mobb::Trace::Event& event,
                                const DrawnSpace& space);
void add_time_gap(DrawList& list, const TimeGap& gap, float scale);

}  // namespace mobbscope
