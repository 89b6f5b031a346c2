/// The glyphs of a picture's texts, packed into one grey image.
#pragma once

#include <render/draw_list.h>

#include <cstdint>
#include <span>
#include <vector>

namespace mobbscope {

/// A glyph to draw: whole pixels in the picture, and where its grey levels begin in the atlas.
struct PlacedGlyph {
    Rect rect;
    glm::vec2 texel{0};
    Rgba color{1};
};

struct GlyphAtlas {
    int width = 0;
    int height = 0;
    std::vector<std::uint8_t> coverage;
    std::vector<PlacedGlyph> glyphs;
};

/// Rasterises every glyph once for each size and quarter of a pixel that it is wanted at.
GlyphAtlas make_atlas(std::span<const TextRun> texts);

}  // namespace mobbscope
