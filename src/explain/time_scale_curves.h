/// What the time scale of free boxes in space-time does to their volume and cost.
#pragma once

#include <explain/fit_sweep.h>
#include <mobb/tree.h>
#include <scene/scene.h>

#include <span>
#include <vector>

namespace mobbscope {

/// One fit of some clips by level. A tree that ends above a level counts with its last one.
struct LevelCurve {
    struct Level {
        double volume = 0;  ///< m^2*s, of all clips
        double cost = 0;    ///< ns, that a query of a clip against itself is expected to cost on it (expected_cost.h);
                            ///< mean over the clips
    };
    mobb::FitOptions fit;
    std::vector<Level> levels{};
};

/// MOBB, moving boxes, and UMOBB at each time scale, with the other options of `fit`. Requires clips. `progress` is
/// told by one thread at a time how many of these are done; it may throw to end the work.
std::vector<LevelCurve> time_scale_curves(std::span<const mobb::ClipPtr> clips, const mobb::FitOptions& fit,
                                          std::span<const double> time_scales, const Progress& progress = {});

/// ... at the time scales that a sweep tried, with the leaf and the axes of the fit that it measured as the fastest.
std::vector<LevelCurve> time_scale_curves(std::span<const mobb::ClipPtr> clips, const SweepResult& swept,
                                          const Progress& progress = {});

}  // namespace mobbscope
