/// What a clip's samples say, in metres and seconds.
#pragma once

#include <mobb/clip.h>

namespace mobbscope {

struct PathFigures {
    double length = 0;      ///< metres
    double mean_speed = 0;  ///< m/s between the first sample and the last; 0 for one sample
    double min_radius = 0;  ///< metres
    double mean_radius = 0;
    double max_radius = 0;
};

PathFigures figures_of(const mobb::Clip& clip);

}  // namespace mobbscope
