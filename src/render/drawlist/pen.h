/// Lines and circles of the scene.
#pragma once

#include <render/drawlist/draw_list.h>

#include <cmath>
#include <concepts>
#include <numbers>

namespace mobbscope {

/// A style for pictures of another scale.
inline LineStyle scaled(LineStyle style, float scale) {
    style.width *= scale;
    style.dash *= scale;
    style.cap *= scale;
    return style;
}

/// The unit direction to point `i` of `pieces` around a circle, counter-clockwise from +x.
template <std::floating_point T>
glm::vec<2, T> on_circle(T i, int pieces) {
    const T angle = 2 * std::numbers::pi_v<T> * i / static_cast<T>(pieces);
    return {std::cos(angle), std::sin(angle)};
}

/// Draws lines, each above those before it.
class Pen {
  public:
    /// `order`: of the first line; the index counts on.
    Pen(DrawList& list, DrawOrder order) : list_(list), order_(order) {}

    void line(glm::vec3 from, glm::vec3 to, const LineStyle& style) {
        list_.lines.push_back({style, from, to, order_});
        ++order_.index;
    }

    /// From at(0) to at(1), and so on to at(pieces).
    template <class At>
    void path(int pieces, const At& at, const LineStyle& style) {
        for (int i = 0; i < pieces; ++i) line(at(i), at(i + 1), style);
    }

    /// A circle in the plane of two unit vectors.
    void ring(glm::vec3 center, float radius, glm::vec3 right, glm::vec3 up, int pieces, const LineStyle& style) {
        const auto at = [&](int i) {
            const glm::vec2 to = on_circle(static_cast<float>(i), pieces);
            return center + radius * (to.x * right + to.y * up);
        };
        path(pieces, at, style);
    }

    /// From at(first) to at(last), joining pieces that are too short to be seen: too_short(from, to).
    template <class At, class TooShort>
    void joined_path(int first, int last, const At& at, const TooShort& too_short, const LineStyle& style) {
        glm::vec3 from = at(first);
        for (int i = first + 1; i <= last; ++i) {
            const glm::vec3 to = at(i);
            if (i < last && too_short(from, to)) continue;
            line(from, to, style);
            from = to;
        }
    }

    const DrawOrder& order() const { return order_; }

  private:
    DrawList& list_;
    DrawOrder order_;
};

}  // namespace mobbscope
