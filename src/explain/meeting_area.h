/// How likely two boxes meet, wherever they are placed.
#pragma once

#include <mobb/box.h>
#include <mobb/tree.h>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <optional>

namespace mobbscope {

/// What the area at which two boxes meet depends on.
struct BoxOutline {
    BoxOutline(const mobb::Tree& tree, int node);

    mobb::BoxKind kind;
    double duration;                       ///< s, of the node
    double time_scale;                     ///< of the tree
    double area;                           ///< on the floor, m^2; of an upright or moving box
    double perimeter;                      ///< likewise, m
    glm::dvec2 half;                       ///< likewise, m
    double speed;                          ///< of a moving box, m/s
    std::array<glm::dvec3, 3> half_edges;  ///< in (x, y, w*t)
};

/// The test that the traversal has for the two; where it has none they count as overlapping.
std::optional<mobb::BoxKind> test_of(const BoxOutline& a, const BoxOutline& b);

/// The area in m^2 of the shifts of B at which the two meet: the mean over B's headings, and over the starts of B at
/// which the two share time. Requires that they have a test, that it is not of blocks, and that both last.
///
/// Two upright boxes: A_a + A_b + L_a L_b/(2 pi), the mean Minkowski sum (Blaschke 1937) from areas and perimeters.
/// Two moving ones: that, and (L_a + L_b)/pi for each metre that they move apart in their common time, for which
/// sqrt(v_a^2 + v_b^2) h_a h_b/(h_a + h_b) stands. Two aabb: of the boxes as they are wrapped again in the world.
/// Tested as 3D boxes: the volume of their Minkowski sum, of which only what lies within the starts at which they share
/// time counts: boxes reach beyond the time of their nodes, but time is tested first. `headings` many are tried for
/// it, evenly from `first_heading` (radians) on; the others are in closed form.
double meeting_area(const BoxOutline& a, const BoxOutline& b, int headings = 64, double first_heading = 0);

}  // namespace mobbscope
