/// The two kinds of conflict of plans of multi-agent path finding: who is in one cell at one step, and who swaps cells.
#pragma once

#include <mobb/clip.h>
#include <scene/scene.h>

#include <glm/vec2.hpp>

#include <cstdint>
#include <string_view>
#include <vector>

namespace mobbscope {

enum class PlanConflictKind : std::uint8_t {
    vertex,  ///< both are in one cell
    swap,    ///< each goes to the cell that the other comes from: they meet on the edge between
};

/// "vertex", "swap".
std::string_view name(PlanConflictKind kind);

struct PlanConflict {
    PlanConflictKind kind = PlanConflictKind::vertex;
    double t0 = 0;  ///< global seconds: when both are there; of a swap when they set out
    double t1 = 0;  ///< of a swap when they arrive; else t0
    glm::dvec2 a;   ///< metres: where a is at t0
    glm::dvec2 b;   ///< likewise; of a vertex the same place
};

/// Whether a clip comes from such a plan.
bool is_plan(const SceneClip& clip);

/// All conflicts of two agents of a plan, by time. Who goes through others' cells or past them in another way is in
/// none, however wide the agents are.
std::vector<PlanConflict> plan_conflicts(const mobb::PlacedClip& a, const mobb::PlacedClip& b);

}  // namespace mobbscope
