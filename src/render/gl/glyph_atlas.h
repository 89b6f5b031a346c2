/// The glyphs of a picture's texts, packed into one grey image.
#pragma once

#include <render/drawlist/draw_list.h>

#include <cstdint>
#include <map>
#include <span>
#include <tuple>
#include <vector>

namespace mobbscope {

/// A glyph to draw: whole pixels in the picture, and where its grey levels begin in the atlas.
struct PlacedGlyph {
    Rect rect;
    glm::vec2 texel{0};
    Rgba color{1};
};

struct GlyphAtlas {
    PictureSize size;
    std::vector<std::uint8_t> coverage;
    std::vector<PlacedGlyph> glyphs;
};

/// Rasterised glyphs by face, size, code point, and how many quarters of a pixel (0..3) the pen stands to the right.
using KeptGlyphs = std::map<std::tuple<FontFace, float, char32_t, int>, GlyphBitmap>;

/// Every glyph stands in it once for each size and quarter of a pixel that it is wanted at. `kept`: from picture to
/// picture; all are forgotten when they have become many, as they do while a window changes its size.
GlyphAtlas make_atlas(std::span<const TextRun> texts, KeptGlyphs& kept);

}  // namespace mobbscope
