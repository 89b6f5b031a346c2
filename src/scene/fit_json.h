/// The `fit` of a scene file: every key is optional and has FitOptions' name for it.
///
///     {"tree": "mobb", "leaf": 10, "levels": 0, "axes": "endpoints", "time_scale": 1}
#pragma once

#include <mobb/tree.h>
#include <scene/json_place.h>

namespace mobbscope {

/// What the keys say, over `base`: a key that is not there keeps its value. Throws InputError.
mobb::FitOptions read_fit(const JsonPlace& place, mobb::FitOptions base = {});

}  // namespace mobbscope
