/// Fonts, colours and sizes of the window.
#pragma once

#include <render/drawlist/palette.h>

#include <imgui.h>

namespace mobbscope::app {

struct Style {
    float scale = 1;  ///< pixels per pixel at scale 1
    Palette palette;  ///< of the pictures: outcomes and agents have the same colours in the panels
    // Surfaces, from the back to the front, and what stands on them.
    ImU32 window, panel, raised, border, text, quiet, accent, warning, error;
    ImFont* body = nullptr;     ///< words, 14 px at scale 1
    ImFont* title = nullptr;    ///< the sentence that answers, 18 px
    ImFont* caption = nullptr;  ///< headings of sections, small capitals in size, 11 px
    ImFont* mono = nullptr;     ///< numbers, 12 px
};

/// Puts the fonts into the atlas of the current ImGui context and sets its style. Call again when theme or scale
/// change.
Style make_style(Theme theme, float scale);

ImU32 to_im(const Rgba& color);

}  // namespace mobbscope::app
