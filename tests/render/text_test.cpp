#include <base/text.h>
#include <render/gl/glyph_atlas.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <string>
#include <string_view>
#include <vector>

namespace mobbscope {
namespace {

TEST(Font, DigitsOfTheMonoFaceHaveOneWidth) {
    const Font& mono = Font::of(FontFace::mono);
    EXPECT_FLOAT_EQ(mono.width("111.1", 12), mono.width("888.8", 12));
    EXPECT_NEAR(mono.width("00", 24), 2 * mono.width("00", 12), 1e-3);
}

TEST(Font, Utf8IsRead) {
    EXPECT_EQ(code_points("a\u00B2\u20AC\U0001F600"), (std::vector<char32_t>{'a', 0xB2, 0x20AC, 0x1F600}));
    EXPECT_EQ(code_points("\xff\xc3"), (std::vector<char32_t>{0xFFFD, 0xFFFD}));
    EXPECT_TRUE(code_points("").empty());
}

TEST(Font, LongTextIsCutOffVisibly) {
    const std::string cut = fit_text("Stra\u00DFenbahnhaltestelle", FontFace::text, 12, 60);
    EXPECT_TRUE(cut.ends_with("\u2026"));
    EXPECT_LE(Font::of(FontFace::text).width(cut, 12), 60);
    EXPECT_EQ(fit_text("short", FontFace::text, 12, 60), "short");
}

TEST(Font, TextIsWrappedAtSpaces) {
    const auto lines = wrap_text("one two three four five six", FontFace::text, 12, 60);
    EXPECT_GT(lines.size(), 1u);
    std::string joined;
    for (const std::string& line : lines) {
        EXPECT_LE(Font::of(FontFace::text).width(line, 12), 60);
        joined += (joined.empty() ? "" : " ") + line;
    }
    EXPECT_EQ(joined, "one two three four five six");
}

/// Quadratic work would take minutes.
TEST(Font, AHundredThousandCharactersTakeNoTime) {
    const auto begin = std::chrono::steady_clock::now();
    std::string words;
    for (int i = 0; i < 20000; ++i) words += "word ";
    const std::string one_word(100000, 'm');
    for (const std::string& text : {words, one_word}) {
        EXPECT_LT(fit_text(text, FontFace::text, 12, 60).size(), 20u);
        EXPECT_GE(wrap_text(text, FontFace::text, 12, 1e4f).size(), 1u);
        EXPECT_EQ(fit_text(text, FontFace::text, 12, 1e9f), text);
    }
    EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(5));
}

TEST(Font, TheCutIsAsLateAsCanBe) {
    const Font& font = Font::of(FontFace::text);
    const std::string text = "AVAVAV Stra\u00DFe To\u20ACo";
    for (float width = 0; width < 130; width += 0.5f) {
        const std::string cut = fit_text(text, FontFace::text, 12, width);
        if (cut == text) {
            EXPECT_LE(font.width(text, 12), width);
            continue;
        }
        ASSERT_TRUE(cut.ends_with("\u2026"));
        std::string longer = cut.substr(0, cut.size() - 3);
        do longer += text[longer.size()];
        while (longer.size() < text.size() && (static_cast<unsigned char>(text[longer.size()]) >> 6) == 2);
        EXPECT_TRUE(font.width(longer + "\u2026", 12) > width) << cut << " at " << width;
    }
}

TEST(Font, ControlCharactersAreSpaces) {
    for (const FontFace face : {FontFace::text, FontFace::mono}) {
        const Font& font = Font::of(face);
        for (const char32_t code : {U'\n', U'\t', U'\x7F', U'\x85'}) {
            EXPECT_TRUE(font.has(code));
            EXPECT_EQ(font.advance(code, 0, 12), font.advance(' ', 0, 12));
            EXPECT_TRUE(font.rasterise(code, 12, 0).coverage.empty());
        }
    }
}

TEST(Font, TheOtherFaceDrawsWhatOneLacks) {
    const Font& words = Font::of(FontFace::text);
    for (const char32_t code : std::u32string_view(U"\u2080\u2190\u2191\u2192\u2193\u25B6")) {
        EXPECT_TRUE(words.has(code));
        EXPECT_EQ(Font::drawing(FontFace::text, code), FontFace::mono);
        // Without the room that it has among figures.
        const GlyphBitmap ink = words.rasterise(code, 12, 0);
        EXPECT_EQ(ink.coverage, Font::of(FontFace::mono).rasterise(code, 12, words.indent(code, 12)).coverage);
        EXPECT_GE(ink.left, 0);
        EXPECT_NEAR(static_cast<double>(words.advance(code, 'A', 12)), ink.width, 1.8);
    }
    EXPECT_LT(words.advance(0x2080, 'A', 12), 0.7f * Font::of(FontFace::mono).advance(0x2080, 0, 12));
    EXPECT_EQ(words.indent('A', 12), 0);
    EXPECT_EQ(Font::drawing(FontFace::text, 'A'), FontFace::text);
    EXPECT_EQ(Font::drawing(FontFace::mono, 'A'), FontFace::mono);
    EXPECT_EQ(Font::drawing(FontFace::text, 0x6F22), FontFace::text) << "neither has it";
}

TEST(Font, AMissingGlyphIsAHollowBox) {
    const Font& font = Font::of(FontFace::text);
    ASSERT_FALSE(font.has(0x6F22));
    EXPECT_TRUE(font.has('A'));
    const GlyphBitmap box = font.rasterise(0x6F22, 16, 0.25f);
    EXPECT_LE(static_cast<float>(box.left + box.width), font.advance(0x6F22, 0, 16));
    ASSERT_EQ(box.coverage.size(), static_cast<std::size_t>(box.width * box.height));
    for (int y = 0; y < box.height; ++y) {
        for (int x = 0; x < box.width; ++x) {
            const bool edge = x == 0 || y == 0 || x == box.width - 1 || y == box.height - 1;
            EXPECT_EQ(box.coverage[static_cast<std::size_t>(y * box.width + x)] > 0, edge) << x << ' ' << y;
        }
    }
}

TEST(GlyphAtlas, EveryGlyphLiesInItAndHasInk) {
    TextRun run;
    run.text = "step 14 of 0..61: A 2.1";
    run.baseline = {10.3f, 20};
    const std::vector<TextRun> runs{run};
    KeptGlyphs kept;
    const GlyphAtlas atlas = make_atlas(runs, kept);
    EXPECT_GE(atlas.glyphs.size(), 14u);  // spaces may be left out
    for (const PlacedGlyph& glyph : atlas.glyphs) {
        const glm::vec2 end = glyph.texel + glyph.rect.size();
        EXPECT_LE(end.x, static_cast<float>(atlas.size.width));
        EXPECT_LE(end.y, static_cast<float>(atlas.size.height));
    }
    EXPECT_GT(*std::max_element(atlas.coverage.begin(), atlas.coverage.end()), 200);
}

}  // namespace
}  // namespace mobbscope
