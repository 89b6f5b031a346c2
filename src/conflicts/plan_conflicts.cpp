#include <conflicts/plan_conflicts.h>

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace mobbscope {

namespace {

constexpr double kSameCell = 1e-6;  // metres: cells are apart by far more
constexpr double kSameStep = 1e-6;  // of the shorter step

glm::dvec2 center_of(const mobb::PlacedClip& clip, int sample) {
    const mobb::Disk disk = clip.disk(sample);
    return {disk.x, disk.y};
}

bool same_cell(glm::dvec2 a, glm::dvec2 b) { return glm::distance(a, b) < kSameCell; }

}  // namespace

std::string_view name(PlanConflictKind kind) { return kind == PlanConflictKind::vertex ? "vertex" : "swap"; }

bool is_plan(const SceneClip& clip) { return clip.facts.format == "mapf" && clip.body.empty(); }

std::vector<PlanConflict> plan_conflicts(const mobb::PlacedClip& a, const mobb::PlacedClip& b) {
    std::vector<PlanConflict> found;
    const double slack = kSameStep * std::min(a.clip().dt(), b.clip().dt());
    const auto together = [&](int i, int j) { return std::abs(a.time(i) - b.time(j)) <= slack; };
    for (int i = 0, j = 0; i < a.count() && j < b.count();) {
        if (!together(i, j)) {
            ++(a.time(i) < b.time(j) ? i : j);
            continue;
        }
        const glm::dvec2 at_a = center_of(a, i);
        const glm::dvec2 at_b = center_of(b, j);
        if (same_cell(at_a, at_b)) {
            found.push_back({PlanConflictKind::vertex, a.time(i), a.time(i), at_a, at_b});
        } else if (i + 1 < a.count() && j + 1 < b.count() && together(i + 1, j + 1) &&
                   same_cell(at_a, center_of(b, j + 1)) && same_cell(at_b, center_of(a, i + 1))) {
            found.push_back({PlanConflictKind::swap, a.time(i), a.time(i + 1), at_a, at_b});
        }
        ++i;
        ++j;
    }
    return found;
}

}  // namespace mobbscope
