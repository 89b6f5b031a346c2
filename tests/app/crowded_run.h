/// A run that tests open.
#pragma once

#include "crowd/walker_moves.h"

#include <crowd/simulate.h>
#include <scene/crowd_run.h>

#include <memory>
#include <string>

namespace mobbscope::app::testing {

/// The file of a run with so many on a small floor that some are forced to collide.
inline const std::string& crowded_run() {
    static const std::string text = [] {
        Scene scene = mobbscope::testing::walker_scene();
        const FittedScene fitted(scene, {});
        SimulateOptions options;
        options.agents = 22;
        options.area = {9, 9};
        options.seconds = 20;
        scene.crowd = std::make_shared<const CrowdRun>(simulate(MoveSet(fitted), options).run);
        return to_json(scene, true);
    }();
    return text;
}

}  // namespace mobbscope::app::testing
