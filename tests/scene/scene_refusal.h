/// Why a scene's text is refused.
#pragma once

#include <scene/scene.h>
#include <support/input_error.h>

#include <string>

namespace mobbscope {
inline namespace testing {

inline std::string scene_refusal(const std::string& text) {
    return input_error([&] { parse_scene(text, "s.json", ""); });
}

}  // namespace testing
}  // namespace mobbscope
