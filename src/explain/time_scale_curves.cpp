#include <base/threads.h>
#include <explain/expected_cost.h>
#include <explain/time_scale_curves.h>
#include <mobb/level_figures.h>

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstddef>
#include <mutex>
#include <optional>

namespace mobbscope {

namespace {

void add_clip(LevelCurve& curve, const mobb::ClipPtr& clip, double clips) {
    const mobb::Tree tree(clip, curve.fit);
    const std::vector<mobb::LevelFigures> figures = mobb::level_figures(tree);
    const std::optional<ExpectedCost> expected = expected_cost(tree, tree);
    // What the clips before had on their last level, they have on those below.
    const LevelCurve::Level last = curve.levels.empty() ? LevelCurve::Level{} : curve.levels.back();
    if (curve.levels.size() < figures.size()) curve.levels.resize(figures.size(), {last.volume, 0});
    for (std::size_t i = 0; i < curve.levels.size(); ++i) {
        curve.levels[i].volume += figures[std::min(i, figures.size() - 1)].volume;
        if (expected && i < expected->levels.size()) curve.levels[i].cost += cost_of(expected->levels[i]) / clips;
    }
}

}  // namespace

std::vector<LevelCurve> time_scale_curves(std::span<const mobb::ClipPtr> clips, const mobb::FitOptions& fit,
                                          std::span<const double> time_scales, const Progress& progress) {
    std::vector<LevelCurve> out;
    const auto add = [&](mobb::TreeKind tree, double time_scale) {
        mobb::FitOptions options = fit;
        options.tree = tree;
        options.time_scale = time_scale;
        out.push_back({options});
    };
    add(mobb::TreeKind::mobb, fit.time_scale);
    add(mobb::TreeKind::moving, fit.time_scale);
    for (const double time_scale : time_scales) add(mobb::TreeKind::umobb, time_scale);
    limit_worker_threads();
    std::mutex telling;
    std::size_t done = 0;
    tbb::parallel_for(std::size_t{0}, out.size(), [&](std::size_t i) {
        for (const mobb::ClipPtr& clip : clips) add_clip(out[i], clip, static_cast<double>(clips.size()));
        const std::scoped_lock lock(telling);
        if (progress) progress(++done, out.size());
    });
    return out;
}

std::vector<LevelCurve> time_scale_curves(std::span<const mobb::ClipPtr> clips, const SweepResult& swept,
                                          const Progress& progress) {
    std::vector<double> scales;
    for (const SweepRow& row : swept.rows) {
        const bool is_single = row.fit.levels != swept.order.present.levels;
        if (!is_single && mobb::info(row.fit.tree).uses_time_scale()) scales.push_back(row.fit.time_scale);
    }
    std::ranges::sort(scales);
    scales.erase(std::unique(scales.begin(), scales.end()), scales.end());
    mobb::FitOptions fit = swept.rows[swept.fastest(Protocol::warm)].fit;
    fit.levels = swept.order.present.levels;
    return time_scale_curves(clips, fit, scales, progress);
}

}  // namespace mobbscope
