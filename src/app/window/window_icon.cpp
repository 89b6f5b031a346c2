#include <app/window/window_icon.h>
#include <render/drawlist/palette.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include <algorithm>
#include <cmath>

namespace mobbscope::app {

namespace {

float distance_to_segment(glm::vec2 p, glm::vec2 a, glm::vec2 b) {
    const float t = glm::clamp(glm::dot(p - a, b - a) / glm::dot(b - a, b - a), 0.0f, 1.0f);
    return glm::length(p - (a + t * (b - a)));
}

float distance_to_rounded_square(glm::vec2 p, float radius) {
    const glm::vec2 q = glm::abs(p - 0.5f) - 0.5f + radius;
    return glm::length(glm::max(q, 0.0f)) + std::min(std::max(q.x, q.y), 0.0f) - radius;
}

}  // namespace

Image window_icon(int side) {
    const Palette& colors = palette(Theme::dark);
    const Rgba orange(0.902f, 0.624f, 0, 1);
    const float pixel = 1.0f / static_cast<float>(side);
    const auto covered = [&](float outside) { return glm::clamp(0.5f - outside / pixel, 0.0f, 1.0f); };
    Image icon(side, side);
    for (int y = 0; y < side; ++y) {
        for (int x = 0; x < side; ++x) {
            const glm::vec2 p = (glm::vec2(x, y) + 0.5f) * pixel;
            Rgba color = colors.panel_border;
            color = mix_colors(color, colors.accent,
                               covered(distance_to_segment(p, {0.25f, 0.25f}, {0.75f, 0.75f}) - 0.11f));
            // The one that is in front leaves a gap.
            const float front = distance_to_segment(p, {0.75f, 0.25f}, {0.25f, 0.75f});
            color = mix_colors(color, colors.panel_border, covered(front - 0.16f));
            color = mix_colors(color, orange, covered(front - 0.11f));
            color.a = covered(distance_to_rounded_square(p, 0.2f));
            for (int c = 0; c < 4; ++c) {
                icon.at(x, y)[c] = static_cast<std::uint8_t>(std::lround(255 * color[c]));
            }
        }
    }
    return icon;
}

}  // namespace mobbscope::app
