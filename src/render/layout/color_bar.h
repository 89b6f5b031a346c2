/// Colour bars: what figure a colour stands for, and its values at the two ends.
#pragma once

#include <render/drawlist/color_scale.h>
#include <render/drawlist/draw_list.h>

#include <glm/vec2.hpp>

#include <span>
#include <string>

namespace mobbscope {

struct ColorBar {
    std::string of;  ///< what has these colours: "boxes"
    ColorScale scale;
    std::string unknown;  ///< where there is no value: why
};

/// How large bars below one another are, pixels; nothing of none. `text_size`: of their words.
glm::vec2 color_bars_size(std::span<const ColorBar> bars, float text_size);

/// Adds bars with their upper left corner at a point.
void add_color_bars(DrawList& list, std::span<const ColorBar> bars, glm::vec2 corner, float text_size);

}  // namespace mobbscope
