#include <render/word_panel.h>

#include <cmath>

namespace mobbscope {

float panel_padding(float text_size) { return std::round(0.8f * text_size); }

Panel word_panel(const Rect& rect, const Palette& palette, float text_size) {
    return {rect, 0.4f * text_size, palette.panel, palette.panel_border, 1};
}

}  // namespace mobbscope
