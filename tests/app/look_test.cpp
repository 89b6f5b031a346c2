#include <app/ui/style.h>

#include <gtest/gtest.h>

#include <cmath>
#include <string_view>

namespace mobbscope::app {
namespace {

Rgba from_im(ImU32 color) {
    const ImVec4 c = ImGui::ColorConvertU32ToFloat4(color);
    return {c.x, c.y, c.z, c.w};
}

class LookTest : public ::testing::Test {
  protected:
    LookTest() : context_(ImGui::CreateContext()) { ImGui::SetCurrentContext(context_); }
    ~LookTest() override { ImGui::DestroyContext(context_); }

  private:
    ImGuiContext* context_;
};

TEST_F(LookTest, TextIsReadableOnEverySurface) {
    for (const Theme theme : {Theme::dark, Theme::light}) {
        const Style look = make_style(theme, 1);
        for (const ImU32 surface : {look.window, look.panel, look.raised}) {
            for (const ImU32 text : {look.text, look.quiet, look.warning, look.error}) {
                EXPECT_GE(contrast(from_im(text), from_im(surface)), 4.5f) << std::hex << text << " on " << surface;
            }
        }
    }
}

TEST_F(LookTest, LinesAreWholePixelsAtEveryScale) {
    for (const float scale : {0.5f, 1.0f, 1.25f, 1.7f, 2.0f, 4.0f}) {
        const Style look = make_style(Theme::dark, scale);
        for (const ImFont* font : {look.body, look.title, look.caption, look.mono}) {
            EXPECT_EQ(font->FontSize, std::round(font->FontSize));
            EXPECT_NE(font->FindGlyphNoFallback('A'), nullptr);
        }
        EXPECT_EQ(look.body->FontSize, look.mono->FontSize) << "words and numbers share a line";
        EXPECT_EQ(look.body->FindGlyph('H')->Y1, look.mono->FindGlyph('H')->Y1)
            << "... and its base, at scale " << scale;
    }
}

TEST_F(LookTest, FontsHaveWhatUnitsAndFormulasNeed) {
    const Style look = make_style(Theme::dark, 1);
    for (const ImWchar code :
         std::u16string_view(u"\u00B2\u00B7\u00D7\u03B1\u2026\u2080\u2190\u2191\u2192\u2212\u2264\u25B6")) {
        EXPECT_NE(look.body->FindGlyphNoFallback(code), nullptr) << std::hex << code;
    }
}

}  // namespace
}  // namespace mobbscope::app
