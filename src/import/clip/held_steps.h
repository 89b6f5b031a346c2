/// Held clips whose steps are longer than their radius: others pass through them unseen.
#pragma once

#include <import/clip/imported_clip.h>
#include <mobb/clip.h>

#include <optional>
#include <vector>

namespace mobbscope {

/// From a sample of a held clip to the next.
struct HeldStep {
    int sample = 0;     ///< where it begins
    double length = 0;  ///< metres
    double radius = 0;  ///< metres: of that sample
};

/// The step that exceeds the radius most; nothing if none does, and of a linear clip.
std::optional<HeldStep> longest_held_step(const mobb::Clip& clip);

/// Adds one warning, which motion mends, if there is such a step.
void warn_of_long_held_step(const mobb::Clip& clip, std::vector<ImportWarning>& warnings);

}  // namespace mobbscope
