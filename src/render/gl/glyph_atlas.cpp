#include <base/text.h>
#include <render/gl/glyph_atlas.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace mobbscope {

namespace {

constexpr int kWidth = 512;
constexpr int kQuarters = 4;  // pen positions within a pixel

struct Cell {
    const GlyphBitmap* bitmap = nullptr;
    int x = 0;
    int y = 0;
};

/// Fills rows from left to right. A row is as high as its highest glyph.
class RowPacker {
  public:
    void place(Cell& cell) {
        if (x_ + cell.bitmap->width > kWidth) {
            x_ = 0;
            y_ += row_height_;
            row_height_ = 0;
        }
        cell.x = x_;
        cell.y = y_;
        x_ += cell.bitmap->width;
        row_height_ = std::max(row_height_, cell.bitmap->height);
    }
    int height() const { return y_ + row_height_; }

  private:
    int x_ = 0;
    int y_ = 0;
    int row_height_ = 0;
};

}  // namespace

const GlyphBitmap& GlyphCache::glyph(const GlyphKey& key) {
    const auto [at, added] = glyphs_.try_emplace(key);
    if (added) {
        const auto& [face, size, code, quarter] = key;
        at->second = Font::of(face).rasterise(code, size, static_cast<float>(quarter) / kQuarters);
    }
    return at->second;
}

void GlyphCache::forget_some() {
    constexpr std::size_t kMany = 4096;
    if (glyphs_.size() > kMany) glyphs_.clear();
}

GlyphAtlas make_atlas(std::span<const TextRun> texts, GlyphCache& cache) {
    cache.forget_some();
    GlyphAtlas atlas;
    std::map<GlyphKey, Cell> cells;
    RowPacker packer;
    for (const TextRun& run : texts) {
        const Font& font = Font::of(run.face);
        const std::vector<char32_t> codes = code_points(run.text);
        float pen = run.baseline.x;
        for (std::size_t i = 0; i < codes.size(); ++i) {
            const float snapped = std::floor(pen * kQuarters + 0.5f) / kQuarters;
            const float whole = std::floor(snapped);
            const int quarter = static_cast<int>((snapped - whole) * kQuarters);
            const GlyphKey key(run.face, run.size, codes[i], quarter);
            const auto [at, added] = cells.try_emplace(key);
            Cell& cell = at->second;
            if (added) {
                cell.bitmap = &cache.glyph(key);
                packer.place(cell);
            }
            const glm::vec2 corner(whole + static_cast<float>(cell.bitmap->left),
                                   std::round(run.baseline.y) + static_cast<float>(cell.bitmap->top));
            const glm::vec2 extent(cell.bitmap->width, cell.bitmap->height);
            if (cell.bitmap->width > 0) {
                atlas.glyphs.push_back({{corner, corner + extent}, glm::vec2(cell.x, cell.y), run.color});
            }
            pen += font.advance(codes[i], i + 1 < codes.size() ? codes[i + 1] : 0, run.size);
        }
    }
    atlas.width = kWidth;
    atlas.height = std::max(1, packer.height());
    atlas.coverage.resize(static_cast<std::size_t>(atlas.width) * static_cast<std::size_t>(atlas.height));
    for (const auto& [wanted, cell] : cells) {
        for (int row = 0; row < cell.bitmap->height; ++row) {
            const auto from = cell.bitmap->coverage.begin() + row * cell.bitmap->width;
            std::copy(from, from + cell.bitmap->width, atlas.coverage.begin() + (cell.y + row) * atlas.width + cell.x);
        }
    }
    return atlas;
}

}  // namespace mobbscope
