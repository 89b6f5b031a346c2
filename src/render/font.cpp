#include <render/font.h>

#include <stb_truetype.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace render_assets {
std::string_view embedded(std::string_view name);
}

namespace mobbscope {

Font::Font(std::string_view data) {
    const auto info = std::make_shared<stbtt_fontinfo>();
    const auto* bytes = reinterpret_cast<const unsigned char*>(data.data());
    if (data.empty() || !stbtt_InitFont(info.get(), bytes, stbtt_GetFontOffsetForIndex(bytes, 0))) {
        throw std::logic_error("an embedded font cannot be read");
    }
    info_ = info;
}

const Font& Font::of(FontFace face) {
    static const Font text(render_assets::embedded(MOBBSCOPE_FONT_TEXT_NAME));
    static const Font mono(render_assets::embedded(MOBBSCOPE_FONT_MONO_NAME));
    return face == FontFace::text ? text : mono;
}

int Font::glyph(char32_t code) const { return stbtt_FindGlyphIndex(info_.get(), static_cast<int>(code)); }

float Font::advance(char32_t code, char32_t next, float size) const {
    int advance = 0;
    int bearing = 0;
    const int here = glyph(code);
    stbtt_GetGlyphHMetrics(info_.get(), here, &advance, &bearing);
    if (next != 0) advance += stbtt_GetGlyphKernAdvance(info_.get(), here, glyph(next));
    return static_cast<float>(advance) * stbtt_ScaleForMappingEmToPixels(info_.get(), size);
}

float Font::width(std::string_view utf8, float size) const {
    const std::vector<char32_t> codes = code_points(utf8);
    float width = 0;
    for (std::size_t i = 0; i < codes.size(); ++i) {
        width += advance(codes[i], i + 1 < codes.size() ? codes[i + 1] : 0, size);
    }
    return width;
}

float Font::ascent(float size) const {
    int ascent = 0;
    int descent = 0;
    int gap = 0;
    stbtt_GetFontVMetrics(info_.get(), &ascent, &descent, &gap);
    return static_cast<float>(ascent) * stbtt_ScaleForMappingEmToPixels(info_.get(), size);
}

float Font::descent(float size) const {
    int ascent = 0;
    int descent = 0;
    int gap = 0;
    stbtt_GetFontVMetrics(info_.get(), &ascent, &descent, &gap);
    return static_cast<float>(-descent) * stbtt_ScaleForMappingEmToPixels(info_.get(), size);
}

GlyphBitmap Font::rasterise(char32_t code, float size, float shift) const {
    const float scale = stbtt_ScaleForMappingEmToPixels(info_.get(), size);
    const int index = glyph(code);
    int x0 = 0;
    int y0 = 0;
    int x1 = 0;
    int y1 = 0;
    stbtt_GetGlyphBitmapBoxSubpixel(info_.get(), index, scale, scale, shift, 0, &x0, &y0, &x1, &y1);
    GlyphBitmap bitmap{x1 - x0, y1 - y0, x0, y0, {}};
    bitmap.coverage.resize(static_cast<std::size_t>(bitmap.width) * static_cast<std::size_t>(bitmap.height));
    if (!bitmap.coverage.empty()) {
        stbtt_MakeGlyphBitmapSubpixel(info_.get(), bitmap.coverage.data(), bitmap.width, bitmap.height, bitmap.width,
                                      scale, scale, shift, 0, index);
    }
    return bitmap;
}

std::vector<char32_t> code_points(std::string_view utf8) {
    constexpr char32_t kMalformed = 0xFFFD;
    std::vector<char32_t> out;
    for (std::size_t i = 0; i < utf8.size();) {
        const auto lead = static_cast<unsigned char>(utf8[i++]);
        const int following = lead < 0x80         ? 0
                              : (lead >> 5) == 6  ? 1
                              : (lead >> 4) == 14 ? 2
                              : (lead >> 3) == 30 ? 3
                                                  : -1;
        char32_t code = following < 0 ? kMalformed : following == 0 ? lead : lead & (0x3Fu >> following);
        for (int k = 0; k < following; ++k) {
            if (i >= utf8.size() || (static_cast<unsigned char>(utf8[i]) >> 6) != 2) {
                code = kMalformed;
                break;
            }
            code = (code << 6) | (static_cast<unsigned char>(utf8[i++]) & 0x3Fu);
        }
        out.push_back(code);
    }
    return out;
}

std::string fit_text(const std::string& text, FontFace face, float size, float width) {
    const Font& font = Font::of(face);
    if (font.width(text, size) <= width) return text;
    std::string kept = text;
    const auto is_continuation = [](char c) { return (static_cast<unsigned char>(c) >> 6) == 2; };
    while (!kept.empty()) {
        while (is_continuation(kept.back()) && kept.size() > 1) kept.pop_back();
        kept.pop_back();
        if (font.width(kept + "\u2026", size) <= width) break;
    }
    return kept + "\u2026";
}

std::vector<std::string> wrap_text(const std::string& text, FontFace face, float size, float width) {
    const Font& font = Font::of(face);
    std::vector<std::string> lines;
    std::string line;
    std::size_t begin = 0;
    while (begin < text.size()) {
        const std::size_t end = std::min(text.find(' ', begin), text.size());
        const std::string word = text.substr(begin, end - begin);
        const std::string longer = line.empty() ? word : line + " " + word;
        if (!line.empty() && font.width(longer, size) > width) {
            lines.push_back(line);
            line = word;
        } else {
            line = longer;
        }
        begin = end + 1;
    }
    if (!line.empty()) lines.push_back(line);
    return lines;
}

}  // namespace mobbscope
