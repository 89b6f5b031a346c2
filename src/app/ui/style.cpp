#include <app/ui/style.h>
#include <render/drawlist/font.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

namespace mobbscope::app {

namespace {

// Heights of a line at scale 1. Words and numbers share one, so that they stand on one line.
constexpr float kBody = 16;
constexpr float kTitle = 21;
constexpr float kCaption = 13;

/// The em as a share of the line. Letters and digits of one width are wide, so theirs is smaller.
constexpr float em_of(FontFace face) { return face == FontFace::text ? 0.85f : 0.76f; }

/// What names, units and formulas are written with, as Dear ImGui takes it: it skips what a file has no glyph for.
constexpr ImWchar kWanted[] = {0x0020, 0x024F,  // Latin
                               0x0370, 0x03FF,  // Greek
                               0x0400, 0x045F,  // Cyrillic
                               0x1E00, 0x1EFF,  // Latin with more accents
                               0x2010, 0x203A,  // dashes, quotes, ellipsis
                               0x2070, 0x209C,  // superscripts and subscripts
                               0x2190, 0x21B5,  // arrows
                               0x2200, 0x22A5,  // mathematics
                               0x2318, 0x2326,  // keys
                               0x2500, 0x257F,  // lines of boxes
                               0x25A0, 0x25FF,  // geometric shapes
                               0x2713, 0x2717,  // ticks and crosses
                               0};

ImFont* add_font(FontFace face, float height, float scale) {
    const float line = std::round(height * scale);
    ImFont* font = nullptr;
    // The other file brings what the first lacks.
    for (const FontFace file : {face, face == FontFace::text ? FontFace::mono : FontFace::text}) {
        const std::string_view bytes = Font::file(file);
        ImFontConfig config;
        // It reads the bytes alone, whatever its type says.
        config.FontData = const_cast<char*>(bytes.data());
        config.FontDataSize = static_cast<int>(bytes.size());
        config.FontDataOwnedByAtlas = false;
        config.MergeMode = font != nullptr;
        // Dear ImGui counts the height of the file's own line, not the em.
        config.SizePixels = line * em_of(face) * Font::file_line(file);
        config.GlyphRanges = kWanted;
        // Large glyphs are smooth without it.
        config.OversampleH = scale < 1.5f ? 3 : 2;
        // Digits of one width stand on whole pixels.
        config.PixelSnapH = face == FontFace::mono;
        // It rounds where the base of the file's own line is.
        config.GlyphOffset.y = std::floor(0.8f * line) - std::floor(line * em_of(face) * Font::file_ascent(face));
        font = ImGui::GetIO().Fonts->AddFont(&config);
    }
    return font;
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
    // Glyphs are made; lines are closer than the files have them.
    for (const auto& [font, height] : {std::pair{style.body, kBody}, std::pair{style.title, kTitle},
                                       std::pair{style.caption, kCaption}, std::pair{style.mono, kBody}})
        font->FontSize = std::round(height * style.scale);
    // Versions of Dear ImGui round where a line's base is in other ways: numbers stand where words do.
    const float lower = style.body->FindGlyph('H')->Y1 - style.mono->FindGlyph('H')->Y1;
    for (ImFontGlyph& glyph : style.mono->Glyphs) {
        glyph.Y0 += lower;
        glyph.Y1 += lower;
    }
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
