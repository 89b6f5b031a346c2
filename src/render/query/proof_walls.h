/// The proof of an answer in the scene: each of its lines as a wall between the two, and the region that a miss leaves
/// free on the floor.
#pragma once

#include <explain/query_proof.h>
#include <render/drawlist/draw_list.h>
#include <render/parts/floor_and_axes.h>
#include <scene/drawn_agent.h>

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace mobbscope {

/// A gap across a wall, which has its number beside it.
struct WallGap {
    glm::vec3 at{0};  ///< drawn space
    double gap = 0;
};

/// Of more lines only the tightest are drawn: beyond, walls hide each other.
constexpr std::size_t kMostWalls = 2000;

/// Adds a wall for each line over its time, kMostWalls of them and the one that stands out. The one that holds at
/// `time` stands out; without one the tightest. Returns the gaps that are told: of the tightest, and of the one that
/// stands out.
std::vector<WallGap> add_proof_walls(DrawList& list, const QueryProof& proof, std::optional<double> time, float scale);

/// Adds the line that tells that an overlap was avoidable.
WallGap add_avoidable_wall(DrawList& list, const ProofLine& line, float scale);

/// Adds the line that holds at a time as a low pane of glass on the floor, in the picture of a moment. `height`:
/// metres.
void add_proof_pane(DrawList& list, const QueryProof& proof, double time, double height, float scale);

/// Adds where B may start, around where it does, as far as the floor goes. Returns where its label goes (drawn space);
/// none where there is no room for one. Needs the projection.
std::optional<glm::vec3> add_free_region(DrawList& list, const DrawnAgent& b, const Margins& margins,
                                         const FloorExtent& floor_extent, float scale);

/// The part of a convex region that lies in a rectangle.
std::vector<glm::dvec2> cut_to(std::vector<glm::dvec2> region, glm::dvec2 low, glm::dvec2 high);

/// A free region where B starts, world metres.
std::vector<glm::dvec2> region_of_start(const mobb::PlacedClip& b, const Margins& margins);

}  // namespace mobbscope
