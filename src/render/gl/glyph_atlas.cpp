#include <base/text.h>
#include <render/gl/glyph_atlas.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace mobbscope {

namespace {

constexpr int kWidth = 512;
constexpr int kQuarters = 4;  // pen positions within a pixel
constexpr std::size_t kManyGlyphs = 4096;

struct Cell {
    const GlyphBitmap* bitmap = nullptr;
    glm::ivec2 corner{0};
};

}  // namespace

GlyphAtlas make_atlas(std::span<const TextRun> texts, KeptGlyphs& kept) {
    if (kept.size() > kManyGlyphs) kept.clear();
    GlyphAtlas atlas;
    std::map<KeptGlyphs::key_type, Cell> cells;
    // Rows are filled from left to right. A row is as high as its highest glyph.
    glm::ivec2 next(0);
    int row_height = 0;
    for (const TextRun& run : texts) {
        const Font& font = Font::of(run.face);
        const std::vector<char32_t> codes = code_points(run.text);
        float pen = run.baseline.x;
        for (std::size_t i = 0; i < codes.size(); ++i) {
            const float snapped = std::floor(pen * kQuarters + 0.5f) / kQuarters;
            const float whole = std::floor(snapped);
            const int quarter = static_cast<int>((snapped - whole) * kQuarters);
            const auto [at, added] = cells.try_emplace({run.face, run.size, codes[i], quarter});
            Cell& cell = at->second;
            if (added) {
                const auto [glyph, is_new] = kept.try_emplace(at->first);
                if (is_new) glyph->second = font.rasterise(codes[i], run.size, static_cast<float>(quarter) / kQuarters);
                cell.bitmap = &glyph->second;
                if (next.x + cell.bitmap->width > kWidth) {
                    next = {0, next.y + row_height};
                    row_height = 0;
                }
                cell.corner = next;
                next.x += cell.bitmap->width;
                row_height = std::max(row_height, cell.bitmap->height);
            }
            const glm::vec2 corner(whole + static_cast<float>(cell.bitmap->left),
                                   std::round(run.baseline.y) + static_cast<float>(cell.bitmap->top));
            const glm::vec2 extent(cell.bitmap->width, cell.bitmap->height);
            if (cell.bitmap->width > 0)
                atlas.glyphs.push_back({{corner, corner + extent}, glm::vec2(cell.corner), run.color});
            pen += font.advance(codes[i], i + 1 < codes.size() ? codes[i + 1] : 0, run.size);
        }
    }
    atlas.size = {kWidth, std::max(1, next.y + row_height)};
    atlas.coverage.resize(std::size_t{kWidth} * static_cast<std::size_t>(atlas.size.height));
    for (const auto& [wanted, cell] : cells) {
        for (int row = 0; row < cell.bitmap->height; ++row) {
            std::copy_n(cell.bitmap->coverage.begin() + row * cell.bitmap->width, cell.bitmap->width,
                        atlas.coverage.begin() + (cell.corner.y + row) * kWidth + cell.corner.x);
        }
    }
    return atlas;
}

}  // namespace mobbscope
