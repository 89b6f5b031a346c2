#include <mobb/level_figures.h>

#include <algorithm>
#include <cstddef>
#include <numbers>
#include <span>

namespace mobb {

double cylinder_volume(const Clip& clip, SampleRange range) {
    double sum = 0;
    const std::span<const Disk> samples = clip.samples();
    const bool runs = clip.runs();
    const auto end = static_cast<std::size_t>(std::min(range.end(), clip.steps()));
    for (auto i = static_cast<std::size_t>(range.first); i < end; ++i) {
        const double r0 = samples[i].r;
        const double r1 = samples[runs ? i + 1 : i].r;
        sum += runs ? (r0 * r0 + r0 * r1 + r1 * r1) / 3 : r0 * r0;
    }
    return std::numbers::pi * sum * clip.dt();
}

std::vector<LevelFigures> level_figures(const Tree& tree) {
    std::vector<LevelFigures> levels(static_cast<std::size_t>(tree.depth()));
    for (int i = 0; i < static_cast<int>(tree.nodes().size()); ++i) {
        const double v = volume(tree.box(i), tree.time_scale());
        const int last = tree.is_leaf(i) ? tree.depth() - 1 : tree.level(i);
        for (int level = tree.level(i); level <= last; ++level) {
            levels[static_cast<std::size_t>(level)].nodes += 1;
            levels[static_cast<std::size_t>(level)].volume += v;
        }
    }
    const double cylinders = cylinder_volume(tree.clip(), {0, tree.clip().count()});
    for (std::size_t i = 0; i < levels.size(); ++i) {
        levels[i].level = static_cast<int>(i);
        if (levels[i].volume > 0) levels[i].tightness = cylinders / levels[i].volume;
    }
    return levels;
}

}  // namespace mobb
