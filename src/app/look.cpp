#include <app/look.h>
#include <render/font.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>

namespace mobbscope::app {

namespace {

// Heights of a line at scale 1. Words and numbers share one, so that they stand on one line; Inter's em is 1/1.21 of
// it.
constexpr float kBody = 16;
constexpr float kTitle = 21;
constexpr float kCaption = 13;

/// What names, units and formulas are written with; of these, those that the font has.
constexpr std::array<std::pair<ImWchar, ImWchar>, 12> kWanted{{
    {0x0020, 0x024F},  // Latin
    {0x0370, 0x03FF},  // Greek
    {0x0400, 0x045F},  // Cyrillic
    {0x1E00, 0x1EFF},  // Latin with more accents
    {0x2010, 0x203A},  // dashes, quotes, ellipsis
    {0x2070, 0x209C},  // superscripts and subscripts
    {0x2190, 0x21B5},  // arrows
    {0x2200, 0x22A5},  // mathematics
    {0x2318, 0x2326},  // keys
    {0x2500, 0x257F},  // lines of boxes
    {0x25A0, 0x25FF},  // geometric shapes
    {0x2713, 0x2717},  // ticks and crosses
}};

ImVector<ImWchar> ranges_of(FontFace face) {
    ImFontGlyphRangesBuilder builder;
    for (const auto& [first, last] : kWanted) {
        for (ImWchar code = first; code <= last; ++code) {
            if (Font::of(face).has(code)) builder.AddChar(code);
        }
    }
    ImVector<ImWchar> ranges;
    builder.BuildRanges(&ranges);
    return ranges;
}

/// From the top of a line to its base, as Dear ImGui rounds it.
float base_line(FontFace face, float height) {
    const Font& font = Font::of(face);
    return std::floor(height * font.ascent(1) / (font.ascent(1) + font.descent(1))) + 1;
}

ImFont* add_font(FontFace face, float height, float scale) {
    // The atlas keeps the pointers.
    static const ImVector<ImWchar> text = ranges_of(FontFace::text);
    static const ImVector<ImWchar> mono = ranges_of(FontFace::mono);
    const std::string_view file = Font::file(face);
    ImFontConfig config;
    // It reads the bytes alone, whatever its type says.
    config.FontData = const_cast<char*>(file.data());
    config.FontDataSize = static_cast<int>(file.size());
    config.FontDataOwnedByAtlas = false;
    config.SizePixels = std::round(height * scale);
    config.GlyphRanges = (face == FontFace::text ? text : mono).Data;
    // Large glyphs are smooth without it.
    config.OversampleH = scale < 1.5f ? 3 : 2;
    // Digits of one width stand on whole pixels.
    config.PixelSnapH = face == FontFace::mono;
    config.GlyphOffset.y = base_line(FontFace::text, config.SizePixels) - base_line(face, config.SizePixels);
    return ImGui::GetIO().Fonts->AddFont(&config);
}

void add_fonts(Look& look) {
    ImFontAtlas& fonts = *ImGui::GetIO().Fonts;
    fonts.Clear();
    fonts.TexDesiredWidth = look.scale < 1.5f ? 1024 : 2048;
    look.body = add_font(FontFace::text, kBody, look.scale);
    look.title = add_font(FontFace::text, kTitle, look.scale);
    look.caption = add_font(FontFace::text, kCaption, look.scale);
    look.mono = add_font(FontFace::mono, kBody, look.scale);
    ImGui::GetIO().FontDefault = look.body;
    fonts.Build();
}

constexpr ImU32 hex(std::uint32_t rgb) { return IM_COL32((rgb >> 16) & 255u, (rgb >> 8) & 255u, rgb & 255u, 255u); }

void set_colors(Look& look) {
    const bool dark = look.palette.dark;
    // The picture goes over into the window around it.
    look.window = to_im(look.palette.background);
    look.panel = hex(dark ? 0x1A2027 : 0xEDF0F3);
    look.raised = hex(dark ? 0x222A33 : 0xFFFFFF);
    look.border = hex(dark ? 0x2C343D : 0xD2D7DC);
    look.text = hex(dark ? 0xE7EAEE : 0x1D2329);
    look.quiet = hex(dark ? 0x98A2AD : 0x5A646E);
    look.accent = to_im(look.palette.accent);
    look.warning = hex(dark ? 0xE8B44A : 0x8A5A00);
    look.error = hex(dark ? 0xF2776B : 0xB3261E);
}

ImVec4 color(ImU32 of, float alpha = 1) {
    ImVec4 out = ImGui::ColorConvertU32ToFloat4(of);
    out.w *= alpha;
    return out;
}

/// From one opaque colour towards another: surfaces do not shine through each other.
ImVec4 blend(ImU32 from, ImU32 to, float share) {
    const ImVec4 a = color(from);
    const ImVec4 b = color(to);
    return {a.x + (b.x - a.x) * share, a.y + (b.y - a.y) * share, a.z + (b.z - a.z) * share, 1};
}

void set_style_colors(const Look& look, ImGuiStyle& style) {
    ImVec4* c = style.Colors;
    const ImVec4 hovered = blend(look.raised, look.text, 0.08f);
    const ImVec4 chosen = blend(look.raised, look.accent, look.palette.dark ? 0.16f : 0.12f);
    const ImVec4 pressed = blend(look.raised, look.accent, look.palette.dark ? 0.28f : 0.22f);
    const ImVec4 none(0, 0, 0, 0);
    for (int i = 0; i < ImGuiCol_COUNT; ++i) c[i] = color(look.accent);
    c[ImGuiCol_Text] = color(look.text);
    c[ImGuiCol_TextDisabled] = color(look.quiet);
    c[ImGuiCol_WindowBg] = color(look.window);
    c[ImGuiCol_ChildBg] = color(look.panel);
    c[ImGuiCol_PopupBg] = blend(look.panel, look.raised, 0.5f);
    c[ImGuiCol_Border] = color(look.border);
    c[ImGuiCol_BorderShadow] = none;
    c[ImGuiCol_FrameBg] = color(look.window);
    c[ImGuiCol_FrameBgHovered] = color(look.raised);
    c[ImGuiCol_FrameBgActive] = color(look.raised);
    c[ImGuiCol_TitleBg] = c[ImGuiCol_TitleBgActive] = c[ImGuiCol_TitleBgCollapsed] = color(look.raised);
    c[ImGuiCol_MenuBarBg] = color(look.panel);
    c[ImGuiCol_ScrollbarBg] = none;
    c[ImGuiCol_ScrollbarGrab] = blend(look.panel, look.text, 0.16f);
    c[ImGuiCol_ScrollbarGrabHovered] = blend(look.panel, look.text, 0.26f);
    c[ImGuiCol_ScrollbarGrabActive] = blend(look.panel, look.text, 0.36f);
    c[ImGuiCol_SliderGrab] = color(look.accent);
    c[ImGuiCol_SliderGrabActive] = blend(look.accent, look.text, 0.25f);
    c[ImGuiCol_Button] = color(look.raised);
    c[ImGuiCol_ButtonHovered] = hovered;
    c[ImGuiCol_ButtonActive] = pressed;
    c[ImGuiCol_Header] = chosen;
    c[ImGuiCol_HeaderHovered] = hovered;
    c[ImGuiCol_HeaderActive] = pressed;
    c[ImGuiCol_Separator] = color(look.border);
    c[ImGuiCol_ResizeGrip] = none;
    c[ImGuiCol_Tab] = c[ImGuiCol_TabUnfocused] = color(look.panel);
    c[ImGuiCol_TabHovered] = hovered;
    c[ImGuiCol_TabActive] = c[ImGuiCol_TabUnfocusedActive] = chosen;
    c[ImGuiCol_TableHeaderBg] = color(look.raised);
    c[ImGuiCol_TableBorderStrong] = c[ImGuiCol_TableBorderLight] = color(look.border);
    c[ImGuiCol_TableRowBg] = none;
    c[ImGuiCol_TableRowBgAlt] = color(look.text, 0.025f);
    c[ImGuiCol_TextSelectedBg] = color(look.accent, 0.35f);
    c[ImGuiCol_NavWindowingHighlight] = color(look.accent);
    c[ImGuiCol_NavWindowingDimBg] = c[ImGuiCol_ModalWindowDimBg] = ImVec4(0, 0, 0, look.palette.dark ? 0.5f : 0.28f);
}

void set_style(const Look& look) {
    ImGuiStyle style;
    style.WindowPadding = {12, 10};
    style.FramePadding = {8, 4};
    style.ItemSpacing = {8, 5};
    style.ItemInnerSpacing = {6, 4};
    style.CellPadding = {6, 3};
    style.IndentSpacing = 14;
    style.ScrollbarSize = 10;
    style.GrabMinSize = 10;
    style.FrameRounding = style.GrabRounding = style.TabRounding = 4;
    style.WindowRounding = 0;  // panels fill the window
    style.ChildRounding = 0;
    style.PopupRounding = 6;
    style.ScrollbarRounding = 5;
    style.DisabledAlpha = 0.45f;
    style.DisplaySafeAreaPadding = {0, 0};
    style.ScaleAllSizes(look.scale);
    const float line = std::max(1.0f, std::floor(look.scale));
    style.WindowBorderSize = 0;
    style.ChildBorderSize = style.PopupBorderSize = style.FrameBorderSize = line;
    style.TabBorderSize = 0;
    style.MouseCursorScale = look.scale;
    set_style_colors(look, style);
    ImGui::GetStyle() = style;
}

}  // namespace

Look make_look(Theme theme, float scale) {
    Look look{};
    look.scale = scale;
    look.palette = palette(theme);
    set_colors(look);
    add_fonts(look);
    set_style(look);
    return look;
}

ImU32 to_im(const Rgba& color) { return ImGui::ColorConvertFloat4ToU32({color.r, color.g, color.b, color.a}); }

}  // namespace mobbscope::app
