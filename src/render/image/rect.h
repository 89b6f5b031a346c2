/// Places in a picture.
#pragma once

#include <glm/vec2.hpp>

namespace mobbscope {

/// An axis-aligned rectangle on the screen, pixels from the upper left corner.
struct Rect {
    glm::vec2 min{0};
    glm::vec2 max{0};
    glm::vec2 size() const { return max - min; }
    glm::vec2 center() const { return (min + max) * 0.5f; }
    bool overlaps(const Rect& o) const {
        return min.x < o.max.x && o.min.x < max.x && min.y < o.max.y && o.min.y < max.y;
    }
    bool contains(const Rect& o) const {
        return min.x <= o.min.x && min.y <= o.min.y && max.x >= o.max.x && max.y >= o.max.y;
    }
    Rect grown(float by) const { return {min - by, max + by}; }
};

}  // namespace mobbscope
