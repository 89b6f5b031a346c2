/// The `view` of a scene file: every key is optional and has ViewState's name for it.
///
///     {"show": "space-time", "camera": {"preset": "iso", "yaw_deg": 45, "pitch_deg": 25, "perspective": true,
///     "fov_deg": 12,
///                 "target": [0, 0, 1], "distance": 12, "shift": [0, 0.1]},
///      "levels": "1:3", "query": 0, "step": "40%", "tested_before": true,
///      "projection": {"participant": 0, "node": 0, "sample": 3}, "time": 1.5, "time_height": 2,
///      "color_by": "agent", "theme": "dark",
///      "disks": true, "boxes": true, "floor": true, "time_axis": true, "labels": true, "legend": true}
///
/// `levels` is a level or what `--level` takes, `step` an event number or what `--step` takes.
#pragma once

#include <base/json.h>
#include <base/json_writer.h>
#include <scene/view_state.h>

namespace mobbscope {

/// What the keys say, over `base`: a key that is not there keeps its value, a camera replaces the whole camera, and
/// null takes a query or a time out. Throws InputError.
ViewState read_view(const JsonPlace& place, ViewState base = {});

/// An object with what differs from the default.
void write_view(JsonWriter& out, const ViewState& view);

}  // namespace mobbscope
