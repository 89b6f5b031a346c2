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
    int width = 0;
    int height = 0;
    std::vector<std::uint8_t> coverage;
    std::vector<PlacedGlyph> glyphs;
};

/// Face, size, code point, and how many quarters of a pixel (0..3) the pen stands to the right.
using GlyphKey = std::tuple<FontFace, float, char32_t, int>;

/// Rasterised glyphs, kept from picture to picture.
class GlyphCache {
  public:
    /// Valid until the next forget_some.
    const GlyphBitmap& glyph(const GlyphKey& key);
    /// Forgets all when they have become many, as they do while a window changes its size.
    void forget_some();

  private:
    std::map<GlyphKey, GlyphBitmap> glyphs_;
};

/// Every glyph stands in it once for each size and quarter of a pixel that it is wanted at.
GlyphAtlas make_atlas(std::span<const TextRun> texts, GlyphCache& cache);

}  // namespace mobbscope
