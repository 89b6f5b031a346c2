/// The `graph` of a scene file: a motion graph over the scene's clips.
///
///     {"hubs": [{"name": "step"}],
///      "bounds": {"pose_distance": 0.12, "root_speed": 0.5},
///      "moves": [{"clip": "walk", "from": 0, "to": 0, "entry": [0, 0, 0], "exit": [1.3, 0.1, 15]}]}
///
/// `from` and `to` count the hubs from 0; a stance is [x, y, heading in degrees]; a bound that is null, or not there,
/// is none.
#pragma once

#include <base/json_place.h>
#include <base/json_writer.h>
#include <scene/motion_graph.h>

#include <functional>

namespace mobbscope {

/// `clip_at` gives the index of the clip that a place names, or throws InputError. Checks that there is a hub and a
/// move, that hubs have names of their own, that moves join hubs that exist, and that stances and bounds are in range.
/// A hub that no move leaves is allowed. Throws InputError.
MotionGraph read_graph(const JsonPlace& place, const std::function<int(const JsonPlace&)>& clip_at);

/// `clip_name` gives the name of the clip with an index.
void write_graph(JsonWriter& out, const MotionGraph& graph, const std::function<std::string(int)>& clip_name);

}  // namespace mobbscope
