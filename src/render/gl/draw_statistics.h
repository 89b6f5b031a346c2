/// What drawing a picture took.
#pragma once

#include <cstddef>

namespace mobbscope {

/// Of one picture. A camera that moves needs none of the world's bytes anew.
struct DrawStatistics {
    std::size_t world_bytes = 0;    ///< uploaded: shapes of disks and boxes
    std::size_t state_bytes = 0;    ///< ... their colours and lines
    std::size_t overlay_bytes = 0;  ///< ... lines, words and all else
    std::size_t triangles = 0;      ///< that were asked for
    std::size_t draw_calls = 0;
};

}  // namespace mobbscope
