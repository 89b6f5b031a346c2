/// The two faces that pictures are lettered in, both part of the program. What one of them lacks the other draws.
#pragma once

#include <base/name_list.h>

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace mobbscope {

enum class FontFace {
    text,  ///< for words
    mono,  ///< for numbers: digits of one width
};

/// A glyph as grey levels, and where they go relative to the pen on the baseline (pixels, y down).
struct GlyphBitmap {
    int width = 0;
    int height = 0;
    int left = 0;
    int top = 0;
    std::vector<std::uint8_t> coverage;
};

class Font {
  public:
    static const Font& of(FontFace face);
    /// The font file itself, for others that draw glyphs. Valid as long as the program runs.
    static std::string_view file(FontFace face);
    static std::string_view file_name(FontFace face);    ///< "OpenSans-Regular.ttf"
    static std::string_view file_sha256(FontFace face);  ///< 64 hexadecimal digits
    static float file_ascent(FontFace face);  ///< of the file's own line, above the baseline, as a share of the em
    static float file_line(FontFace face);    ///< its height, likewise
    /// The face that draws a code point where `face` is asked for: that, or the other where only the other has it.
    static FontFace drawing(FontFace face, char32_t code);

    /// Pixels from pen start to pen end. `size` is the em's height in pixels.
    float width(std::string_view utf8, float size) const;
    float ascent(float size) const;   ///< of a line, above the baseline, pixels
    float descent(float size) const;  ///< of a line, below the baseline, pixels, >= 0
    /// Pixels to advance after a code point, including kerning with `next` (0: none).
    float advance(char32_t code, char32_t next, float size) const;
    /// Pixels from the pen to where the glyph's own origin lies: not 0 where the fixed-width face draws it among words.
    float indent(char32_t code, float size) const;
    /// Whether a face has a glyph for a code point; a hollow box stands for what there is none for. Control characters
    /// are spaces.
    bool has(char32_t code) const;
    /// The glyph with its pen `shift` (0..1) of a pixel to the right.
    GlyphBitmap rasterise(char32_t code, float size, float shift) const;

  private:
    explicit Font(FontFace face) : face_(face) {}

    FontFace face_;
};

/// `text`, or its beginning and an ellipsis, so that it is at most `width` pixels wide.
std::string fit_text(const std::string& text, FontFace face, float size, float width);

/// Likewise of a name of a list: the ellipsis stands for what the names have in common.
std::string fit_name(const std::string& name, FontFace face, float size, float width, const NameList& list);

/// Lines of at most `width` pixels, broken at spaces; a longer word has a line of its own.
std::vector<std::string> wrap_text(const std::string& text, FontFace face, float size, float width);

}  // namespace mobbscope
