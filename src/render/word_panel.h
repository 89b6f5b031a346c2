/// The panel that words lie on where the scene may be behind them.
#pragma once

#include <render/draw_list.h>

namespace mobbscope {

/// Pixels between its edge and what is written on it. `text_size`: pixels, of the legend's words.
float panel_padding(float text_size);

/// In the palette's colours.
Panel word_panel(const Rect& rect, const Palette& palette, float text_size);

}  // namespace mobbscope
