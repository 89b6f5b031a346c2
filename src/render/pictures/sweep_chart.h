/// What fits are estimated to cost, as a chart: over the samples of a leaf, a line for each kind of tree.
#pragma once

#include <explain/fit_sweep.h>
#include <explain/time_scale_curves.h>
#include <render/pictures/chart_picture.h>

#include <cstddef>
#include <vector>

namespace mobbscope {

struct SweepChart {
    Chart chart;
    std::vector<std::vector<std::size_t>> rows;  ///< of the sweep, by series and point
};

/// Each line has the cheapest fits of its kind; where leaves are not varied but time scales are, over these. A kind to
/// which neither matters is a level line, blocks have none. The row `now` is marked, if there is one, and once the
/// sweep has ended the one that is recommended for warm queries: where they stand in the estimate.
SweepChart sweep_chart(const SweepResult& result, std::optional<std::size_t> now);

/// What a level of trees does over the time scale of UMOBB, beside MOBB and moving boxes, which have none.
enum class CurveOf { volume, cost };
Chart time_scale_chart(const std::vector<LevelCurve>& curves, std::size_t level, CurveOf of);

}  // namespace mobbscope
