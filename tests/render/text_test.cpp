#include <render/glyph_atlas.h>

#include <gtest/gtest.h>

#include <algorithm>

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

TEST(GlyphAtlas, EveryGlyphLiesInItAndHasInk) {
    TextRun run;
    run.text = "step 14 / 61: A 2.1";
    run.baseline = {10.3f, 20};
    const std::vector<TextRun> runs{run};
    const GlyphAtlas atlas = make_atlas(runs);
    EXPECT_GE(atlas.glyphs.size(), 14u);  // spaces may be left out
    for (const PlacedGlyph& glyph : atlas.glyphs) {
        const glm::vec2 end = glyph.texel + glyph.rect.size();
        EXPECT_LE(end.x, static_cast<float>(atlas.width));
        EXPECT_LE(end.y, static_cast<float>(atlas.height));
    }
    EXPECT_GT(*std::max_element(atlas.coverage.begin(), atlas.coverage.end()), 200);
}

}  // namespace
}  // namespace mobbscope
