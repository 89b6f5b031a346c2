#include <app/ui/style.h>
#include <render/drawlist/font.h>

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

void add_fonts(Style& style) {
    ImFontAtlas& fonts = *ImGui::GetIO().Fonts;
    fonts.Clear();
    fonts.TexDesiredWidth = style.scale < 1.5f ? 1024 : 2048;
    style.body = add_font(FontFace::text, kBody, style.scale);
    style.title = add_font(FontFace::text, kTitle, style.scale);
    style.caption = add_font(FontFace::text, kCaption, style.scale);
    style.mono = add_font(FontFace::mono, kBody, style.scale);
    ImGui::GetIO().FontDefault = style.body;
    fonts.Build();
}

constexpr ImU32 hex(std::uint32_t rgb) { return IM_COL32((rgb >> 16) & 255u, (rgb >> 8) & 255u, rgb & 255u, 255u); }

void set_colors(Style& style) {
    const bool dark = style.palette.dark;
    // The picture goes over into the window around it.
    style.window = to_im(style.palette.background);
    style.panel = hex(dark ? 0x1A2027 : 0xEDF0F3);
    style.raised = hex(dark ? 0x222A33 : 0xFFFFFF);
    style.border = hex(dark ? 0x2C343D : 0xD2D7DC);
    style.text = hex(dark ? 0xE7EAEE : 0x1D2329);
    style.quiet = hex(dark ? 0x98A2AD : 0x5A646E);
    style.accent = to_im(style.palette.accent);
    style.warning = hex(dark ? 0xE8B44A : 0x8A5A00);
    style.error = hex(dark ? 0xF2776B : 0xB3261E);
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

void set_style_colors(const Style& style, ImGuiStyle& imgui_style) {
    ImVec4* c = imgui_style.Colors;
    const ImVec4 hovered = blend(style.raised, style.text, 0.08f);
    const ImVec4 chosen = blend(style.raised, style.accent, style.palette.dark ? 0.16f : 0.12f);
    const ImVec4 pressed = blend(style.raised, style.accent, style.palette.dark ? 0.28f : 0.22f);
    const ImVec4 none(0, 0, 0, 0);
    for (int i = 0; i < ImGuiCol_COUNT; ++i) c[i] = color(style.accent);
    c[ImGuiCol_Text] = color(style.text);
    c[ImGuiCol_TextDisabled] = color(style.quiet);
    c[ImGuiCol_WindowBg] = color(style.window);
    c[ImGuiCol_ChildBg] = color(style.panel);
    c[ImGuiCol_PopupBg] = blend(style.panel, style.raised, 0.5f);
    c[ImGuiCol_Border] = color(style.border);
    c[ImGuiCol_BorderShadow] = none;
    c[ImGuiCol_FrameBg] = color(style.window);
    c[ImGuiCol_FrameBgHovered] = color(style.raised);
    c[ImGuiCol_FrameBgActive] = color(style.raised);
    c[ImGuiCol_TitleBg] = c[ImGuiCol_TitleBgActive] = c[ImGuiCol_TitleBgCollapsed] = color(style.raised);
    c[ImGuiCol_MenuBarBg] = color(style.panel);
    c[ImGuiCol_ScrollbarBg] = none;
    c[ImGuiCol_ScrollbarGrab] = blend(style.panel, style.text, 0.16f);
    c[ImGuiCol_ScrollbarGrabHovered] = blend(style.panel, style.text, 0.26f);
    c[ImGuiCol_ScrollbarGrabActive] = blend(style.panel, style.text, 0.36f);
    c[ImGuiCol_SliderGrab] = color(style.accent);
    c[ImGuiCol_SliderGrabActive] = blend(style.accent, style.text, 0.25f);
    c[ImGuiCol_Button] = color(style.raised);
    c[ImGuiCol_ButtonHovered] = hovered;
    c[ImGuiCol_ButtonActive] = pressed;
    c[ImGuiCol_Header] = chosen;
    c[ImGuiCol_HeaderHovered] = hovered;
    c[ImGuiCol_HeaderActive] = pressed;
    c[ImGuiCol_Separator] = color(style.border);
    c[ImGuiCol_ResizeGrip] = none;
    c[ImGuiCol_Tab] = c[ImGuiCol_TabUnfocused] = color(style.panel);
    c[ImGuiCol_TabHovered] = hovered;
    c[ImGuiCol_TabActive] = c[ImGuiCol_TabUnfocusedActive] = chosen;
    c[ImGuiCol_TableHeaderBg] = color(style.raised);
    c[ImGuiCol_TableBorderStrong] = c[ImGuiCol_TableBorderLight] = color(style.border);
    c[ImGuiCol_TableRowBg] = none;
    c[ImGuiCol_TableRowBgAlt] = color(style.text, 0.025f);
    c[ImGuiCol_TextSelectedBg] = color(style.accent, 0.35f);
    c[ImGuiCol_NavWindowingHighlight] = color(style.accent);
    c[ImGuiCol_NavWindowingDimBg] = c[ImGuiCol_ModalWindowDimBg] = ImVec4(0, 0, 0, style.palette.dark ? 0.5f : 0.28f);
}

void set_style(const Style& style) {
    ImGuiStyle imgui_style;
    imgui_style.WindowPadding = {12, 10};
    imgui_style.FramePadding = {8, 4};
    imgui_style.ItemSpacing = {8, 5};
    imgui_style.ItemInnerSpacing = {6, 4};
    imgui_style.CellPadding = {6, 3};
    imgui_style.IndentSpacing = 14;
    imgui_style.ScrollbarSize = 10;
    imgui_style.GrabMinSize = 10;
    imgui_style.FrameRounding = imgui_style.GrabRounding = imgui_style.TabRounding = 4;
    imgui_style.WindowRounding = 0;  // panels fill the window
    imgui_style.ChildRounding = 0;
    imgui_style.PopupRounding = 6;
    imgui_style.ScrollbarRounding = 5;
    imgui_style.DisabledAlpha = 0.45f;
    imgui_style.DisplaySafeAreaPadding = {0, 0};
    imgui_style.ScaleAllSizes(style.scale);
    const float line = std::max(1.0f, std::floor(style.scale));
    imgui_style.WindowBorderSize = 0;
    imgui_style.ChildBorderSize = imgui_style.PopupBorderSize = imgui_style.FrameBorderSize = line;
    imgui_style.TabBorderSize = 0;
    imgui_style.MouseCursorScale = style.scale;
    set_style_colors(style, imgui_style);
    ImGui::GetStyle() = imgui_style;
}

}  // namespace

Style make_style(Theme theme, float scale) {
    Style style{};
    style.scale = scale;
    style.palette = palette(theme);
    set_colors(style);
    add_fonts(style);
    set_style(style);
    return style;
}

ImU32 to_im(const Rgba& color) { return ImGui::ColorConvertFloat4ToU32({color.r, color.g, color.b, color.a}); }

}  // namespace mobbscope::app
