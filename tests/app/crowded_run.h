/// A run that tests open.
#pragma once

#include "crowd/walker_moves.h"

#include <string>

namespace mobbscope::app {
inline namespace testing {

/// The file of a run with so many on a small floor that some are forced to collide.
inline const std::string& crowded_run() {
    static const std::string text = to_json(with_run(walker_scene(), 22, {9, 9}), true);
    return text;
}

}  // namespace testing
}  // namespace mobbscope::app
