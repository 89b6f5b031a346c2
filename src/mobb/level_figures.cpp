#include <mobb/level_figures.h>

#include <cstddef>
#include <numbers>

namespace mobb {

double cylinder_volume(const Clip& clip) {
    double sum = 0;
    for (const Disk& d : clip.samples()) sum += d.r * d.r;
    return std::numbers::pi * sum * clip.dt();
}

std::vector<LevelFigures> level_figures(const Tree& tree) {
    std::vector<LevelFigures> levels(static_cast<std::size_t>(tree.depth()));
    for (const Node& node : tree.nodes()) {
        const double v = volume(node.box, tree.time_scale());
        const int last = node.is_leaf() ? tree.depth() - 1 : node.level;
        for (int level = node.level; level <= last; ++level) {
            levels[static_cast<std::size_t>(level)].nodes += 1;
            levels[static_cast<std::size_t>(level)].volume += v;
        }
    }
    const double cylinders = cylinder_volume(tree.clip());
    for (std::size_t i = 0; i < levels.size(); ++i) {
        levels[i].level = static_cast<int>(i);
        if (levels[i].volume > 0) levels[i].tightness = cylinders / levels[i].volume;
    }
    return levels;
}

}  // namespace mobb
