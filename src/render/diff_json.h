/// What comparing two pictures found, as JSON.
#pragma once

#include <render/image_diff.h>
#include <scene/json_writer.h>

namespace mobbscope {

/// {"same", "same_size", "size_a": [w, h], "size_b", "pixels", "failing", "fraction", "maximum", "mean",
/// "bounds": null | {"x", "y", "width", "height"}, "histogram": [256], "threshold", "allowed", "shift"}: A is the
/// actual picture, B the reference; differences are 0..255, shares 0..1; the rest as in ImageDiff. Of pictures whose
/// sizes differ no pixels are compared.
void write_diff(JsonWriter& out, const ImageDiff& diff);

}  // namespace mobbscope
