#include <mobb/predicate.h>
#include <scene/path_figures.h>

#include <algorithm>
#include <cmath>

namespace mobbscope {

PathFigures figures_of(const mobb::Clip& clip) {
    PathFigures figures;
    double radii = 0;
    figures.min_radius = clip.samples().front().r;
    const mobb::Disk* before = nullptr;
    for (const mobb::Disk& disk : clip.samples()) {
        if (before) figures.length += std::sqrt(mobb::squared_distance(*before, disk));
        figures.min_radius = std::min(figures.min_radius, disk.r);
        figures.max_radius = std::max(figures.max_radius, disk.r);
        radii += disk.r;
        before = &disk;
    }
    // Rounding must not push the mean of equal radii off them.
    figures.mean_radius = std::clamp(radii / clip.count(), figures.min_radius, figures.max_radius);
    if (clip.count() > 1) figures.mean_speed = figures.length / ((clip.count() - 1) * clip.dt());
    return figures;
}

}  // namespace mobbscope
