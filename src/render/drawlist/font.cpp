#include <base/text.h>
#include <render/drawlist/font.h>

#include <stb_truetype.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace render_assets {
std::string_view embedded(std::string_view name);
}

namespace mobbscope {

namespace {

/// The glyph of what a font has no glyph for.
constexpr int kMissing = 0;

constexpr char32_t kEllipsis = 0x2026;

const stbtt_fontinfo& info_of(FontFace face) {
    const auto read = [](FontFace of) {
        stbtt_fontinfo info;
        const std::string_view data = Font::file(of);
        const auto* bytes = reinterpret_cast<const unsigned char*>(data.data());
        if (data.empty() || !stbtt_InitFont(&info, bytes, stbtt_GetFontOffsetForIndex(bytes, 0))) {
            throw std::logic_error("an embedded font cannot be read");
        }
        return info;
    };
    static const stbtt_fontinfo text = read(FontFace::text), mono = read(FontFace::mono);
    return face == FontFace::text ? text : mono;
}

struct Glyph {
    FontFace face;
    int index;  ///< kMissing: no face has it
};

Glyph glyph_of(FontFace face, char32_t code) {
    const bool control = code < 0x20 || (code >= 0x7F && code < 0xA0);
    for (const FontFace of : {face, face == FontFace::text ? FontFace::mono : FontFace::text}) {
        const int index = stbtt_FindGlyphIndex(&info_of(of), control ? ' ' : static_cast<int>(code));
        if (index != kMissing) return {of, index};
    }
    return {face, kMissing};
}

/// A glyph of the fixed-width face among words is as wide as its ink, and this share of the em on either side.
constexpr float kBearing = 0.05f;
bool is_borrowed(FontFace asked, FontFace drawing) { return asked == FontFace::text && drawing == FontFace::mono; }

/// From where to where a glyph has ink, in units of the font.
std::pair<int, int> ink_of(const stbtt_fontinfo& info, int glyph) {
    int begin = 0, end = 0;
    stbtt_GetGlyphBox(&info, glyph, &begin, nullptr, &end, nullptr);
    return {begin, end};
}

/// A frame of one pixel. Fonts bring one of their own, but so heavy that a row of them looks like a censor's bar.
GlyphBitmap hollow_box(float advance, float size) {
    const int side = std::max(1, static_cast<int>(advance * 0.14f));
    const int width = std::max(3, static_cast<int>(advance) - 2 * side);
    const int height = std::max(3, static_cast<int>(size * 0.7f));
    GlyphBitmap box{width, height, side, -height, {}};
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const bool edge = x == 0 || y == 0 || x == width - 1 || y == height - 1;
            box.coverage.push_back(edge ? 255 : 0);
        }
    }
    return box;
}

}  // namespace

std::string_view Font::file(FontFace face) { return render_assets::embedded(file_name(face)); }

std::string_view Font::file_name(FontFace face) {
    return face == FontFace::text ? MOBBSCOPE_FONT_TEXT_NAME : MOBBSCOPE_FONT_MONO_NAME;
}

std::string_view Font::file_sha256(FontFace face) {
    return face == FontFace::text ? MOBBSCOPE_FONT_TEXT_SHA256 : MOBBSCOPE_FONT_MONO_SHA256;
}

float Font::file_ascent(FontFace face) {
    int ascent = 0;
    stbtt_GetFontVMetrics(&info_of(face), &ascent, nullptr, nullptr);
    return static_cast<float>(ascent) * stbtt_ScaleForMappingEmToPixels(&info_of(face), 1);
}

float Font::file_line(FontFace face) {
    return stbtt_ScaleForMappingEmToPixels(&info_of(face), 1) / stbtt_ScaleForPixelHeight(&info_of(face), 1);
}

FontFace Font::drawing(FontFace face, char32_t code) { return glyph_of(face, code).face; }

const Font& Font::of(FontFace face) {
    static const Font text(FontFace::text), mono(FontFace::mono);
    return face == FontFace::text ? text : mono;
}

bool Font::has(char32_t code) const { return glyph_of(face_, code).index != kMissing; }

float Font::advance(char32_t code, char32_t next, float size) const {
    const auto [face, index] = glyph_of(face_, code);
    const stbtt_fontinfo& info = info_of(face);
    if (is_borrowed(face_, face) && index != kMissing) {
        const auto [begin, end] = ink_of(info, index);
        return static_cast<float>(end - begin) * stbtt_ScaleForMappingEmToPixels(&info, size) + 2 * kBearing * size;
    }
    int advance = 0;
    stbtt_GetGlyphHMetrics(&info, index, &advance, nullptr);
    if (next != 0) {
        const Glyph after = glyph_of(face_, next);
        if (after.face == face) advance += stbtt_GetGlyphKernAdvance(&info, index, after.index);
    }
    return static_cast<float>(advance) * stbtt_ScaleForMappingEmToPixels(&info, size);
}

float Font::indent(char32_t code, float size) const {
    const auto [face, index] = glyph_of(face_, code);
    if (!is_borrowed(face_, face)) return 0;
    const stbtt_fontinfo& info = info_of(face);
    return kBearing * size -
           static_cast<float>(ink_of(info, index).first) * stbtt_ScaleForMappingEmToPixels(&info, size);
}

float Font::width(std::string_view utf8, float size) const {
    const std::vector<char32_t> codes = code_points(utf8);
    float width = 0;
    for (std::size_t i = 0; i < codes.size(); ++i) {
        width += advance(codes[i], i + 1 < codes.size() ? codes[i + 1] : 0, size);
    }
    return width;
}

// What letters with accents take; the files' own lines are higher by up to an eighth.
float Font::ascent(float size) const { return 0.97f * size; }
float Font::descent(float size) const { return 0.24f * size; }

GlyphBitmap Font::rasterise(char32_t code, float size, float shift) const {
    const auto [face, index] = glyph_of(face_, code);
    const stbtt_fontinfo& info = info_of(face);
    const float scale = stbtt_ScaleForMappingEmToPixels(&info, size);
    if (index == kMissing) return hollow_box(advance(code, 0, size), size);
    shift += indent(code, size);
    int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
    stbtt_GetGlyphBitmapBoxSubpixel(&info, index, scale, scale, shift, 0, &x0, &y0, &x1, &y1);
    GlyphBitmap bitmap{x1 - x0, y1 - y0, x0, y0, {}};
    bitmap.coverage.resize(static_cast<std::size_t>(bitmap.width) * static_cast<std::size_t>(bitmap.height));
    if (!bitmap.coverage.empty()) {
        stbtt_MakeGlyphBitmapSubpixel(&info, bitmap.coverage.data(), bitmap.width, bitmap.height, bitmap.width, scale,
                                      scale, shift, 0, index);
    }
    return bitmap;
}

std::string fit_text(const std::string& text, FontFace face, float size, float width) {
    if (text.empty()) return text;
    const Font& font = Font::of(face);
    const float ellipsis = font.advance(kEllipsis, 0, size);
    std::size_t at = 0;
    std::size_t kept = 0;  // bytes after which there is room for the ellipsis
    float pen = 0;
    char32_t code = read_code_point(text, at);
    for (;;) {
        const std::size_t end = at;
        const bool last = end == text.size();
        const char32_t next = last ? 0 : read_code_point(text, at);
        if (pen + font.advance(code, kEllipsis, size) + ellipsis <= width) kept = end;
        pen += font.advance(code, next, size);
        if (pen > width) return text.substr(0, kept) + "\u2026";
        if (last) return text;
        code = next;
    }
}

std::string fit_name(const std::string& name, FontFace face, float size, float width, const NameList& list) {
    const auto fits = [&](const std::string& text) { return Font::of(face).width(text, size) <= width; };
    return fit_text(list.shortened(name, fits), face, size, width);
}

std::vector<std::string> wrap_text(const std::string& text, FontFace face, float size, float width) {
    const Font& font = Font::of(face);
    const float space = font.advance(' ', 0, size);
    std::vector<std::string> lines;
    std::string line;
    float line_width = 0;
    for (std::size_t begin = 0; begin < text.size();) {
        const std::size_t end = std::min(text.find(' ', begin), text.size());
        const std::string word = text.substr(begin, end - begin);
        const float word_width = font.width(word, size);
        if (line.empty() || line_width + space + word_width > width) {
            if (!line.empty()) lines.push_back(line);
            line = word;
            line_width = word_width;
        } else {
            line += ' ' + word;
            line_width += space + word_width;
        }
        begin = end + 1;
    }
    if (!line.empty()) lines.push_back(line);
    return lines;
}

}  // namespace mobbscope
