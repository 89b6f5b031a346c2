/// The difference of two pictures as JSON.
///
///     {"same": false, "same_size": true, "pixels": 230400, "failing": 512, "fraction": 0.00222, "maximum": 214,
///      "mean": 0.31, "bounds": {"x": 40, "y": 12, "width": 90, "height": 7} or null, "histogram": [256 counts]}
#pragma once

#include <render/image_diff.h>
#include <scene/json_writer.h>

namespace mobbscope {

/// As one value, where the writer stands; the histogram is empty if the sizes differ.
void write_diff(JsonWriter& json, const ImageDiff& diff);

}  // namespace mobbscope
