/// Where the light comes from.
#pragma once

#include <render/lens.h>

#include <glm/geometric.hpp>

namespace mobbscope {

/// Over the viewer's left shoulder, so that shapes read the same from every side. Unit length.
inline glm::vec3 towards_light(const Lens& lens) {
    return glm::normalize(lens.back - 0.9f * lens.right + 0.5f * lens.up);
}

}  // namespace mobbscope
