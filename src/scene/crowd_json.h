/// The `crowd` of a scene file: what every agent of a run played, in order.
///
///     {"area": [30, 40], "seconds": 120, "seed": 1, "ahead": 0, "grace": 1,
///      "agents": [{"name": "1", "plays": [
///        {"move": 3, "translate": [1.5, -2], "rotate_deg": 30, "start": -0.4},
///        {"move": 7, "translate": [2.5, -2], "rotate_deg": 75, "start": 1.6, "chosen_at": 1.1, "kind": "pivoted"}]}]}
///
/// `move` counts the moves of the scene's `graph`. `chosen_at` is left out where it is `start`, `kind` where it is
/// chosen.
#pragma once

#include <base/json_place.h>
#include <base/json_writer.h>
#include <scene/crowd_run.h>
#include <scene/scene.h>

#include <memory>

namespace mobbscope {

/// The crowd that plays the moves of the scene's graph. Throws InputError, at its place, if the scene has no graph, has
/// agents or queries of its own, or if a play does not begin in the hub where the one before ends, at its end and where
/// it comes to stand, to a millionth of a metre, second and degree (a pivoted or forced one may face another way).
std::shared_ptr<const CrowdRun> read_crowd(const JsonPlace& place, const Scene& scene);

void write_crowd(JsonWriter& out, const CrowdRun& crowd);

}  // namespace mobbscope
