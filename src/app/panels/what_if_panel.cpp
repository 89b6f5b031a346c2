#include <app/panels/panels.h>
#include <base/text.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <string_view>

namespace mobbscope::app {

namespace {

/// Where columns end, as parts of the room; the first begins at its left.
constexpr std::array kRight{0.49f, 0.655f, 1.0f};

std::string tooltip_of(const WhatIf& found, const NodeVariant& variant) {
    std::string out = "volume " + figure(variant.volume) + " m\u00B2\u00B7s";
    if (variant.children > 0) out += ", its children's " + figure(variant.children) + " m\u00B2\u00B7s";
    out += "\n" + figure(variant.tests.boxes()) + " tests of boxes and " +
           figure(variant.tests[mobb::TestKind::samples]) + " pairs of samples a query\n" + figure(variant.cost) +
           " ns a query: tests times their prices";
    if (&variant != &found.variants.front())
        out += "\n" + change_in_per_cent(found, variant, " \u00B1 ") +
               " % of the present cost: the mean of the\ndifferences query by query, and its standard error";
    return out;
}

/// A line of the table: what, and under the heads of columns its numbers.
void table_line(Ui& ui, ImVec2 corner, float width, const std::string& what, const std::array<std::string, 3>& cells,
                ImU32 color, ImU32 last_color, const std::vector<double>& exact = {}) {
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    const ImFont& mono = *ui.style.mono;
    const float pad = ui.px(6), room = width - 2 * pad;
    const float y = corner.y + 0.5f * (ImGui::GetFrameHeight() - ImGui::GetFontSize());
    const float number_y = corner.y + 0.5f * (ImGui::GetFrameHeight() - mono.FontSize);
    const float name_room = kRight[0] * room - text_size(mono, cells[0]).x - ui.px(4);
    draw.AddText({corner.x + pad, y}, color, fitted_text(what, std::max(name_room, ui.px(24))).c_str());
    for (std::size_t i = 0; i < cells.size(); ++i) {
        const float x = corner.x + pad + kRight[i] * room - text_size(mono, cells[i]).x;
        draw_text(draw, mono, {x, number_y}, i + 1 == cells.size() ? last_color : color, cells[i]);
        copies_numbers(ui, cells[i], {x, number_y}, mono, exact);
    }
}

void variant_row(Ui& ui, const WhatIf& found, std::size_t index) {
    const NodeVariant& variant = found.variants[index];
    const NodeVariant& present = found.variants.front();
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    const ImVec2 size{std::max(1.0f, ImGui::GetContentRegionAvail().x), ImGui::GetFrameHeight()};
    const std::string mark = "what_if." + std::to_string(index);
    ImGui::InvisibleButton(mark.c_str(), size);
    ui.mark(mark);
    if (ImGui::IsItemHovered()) {
        ui.hovered_variant = static_cast<int>(index);
        ImGui::GetWindowDrawList()->AddRectFilled(corner, {corner.x + size.x, corner.y + size.y}, ui.style.border,
                                                  ui.px(4));
        ImGui::SetTooltip("%s", tooltip_of(found, variant).c_str());
    }
    const Palette& palette = ui.style.palette;
    const bool is_best = &variant == &found.best() && &variant != &present;
    const bool is_split = variant.change.split.has_value();
    const double volume = is_split && variant.children > 0 ? variant.children : variant.volume;
    const ImU32 best_color = to_im(readable(palette.separated, palette));
    table_line(
        ui, corner, size.x, change_words(*present.tree, variant.change),
        {figure(volume, 3), formatted("%.2f", variant.tests.boxes()),
         &variant == &present ? figure(variant.cost, 3) + " ns" : change_in_per_cent(found, variant, " \u00B1 ")},
        is_best ? ui.style.text : ui.style.quiet, is_best ? best_color : ui.style.quiet,
        {volume, variant.tests.boxes(), variant.cost});
}

}  // namespace

void what_if_panel(Ui& ui, WhatIfInspector& what_if) {
    if (!what_if.tree() || !section(ui, "WHAT IF", "", true)) return;
    if (const std::string_view why = what_if.why_not(); !why.empty()) {
        words(ui.style.quiet, "Nothing can be tried: " + std::string(why) + ".");
        return;
    }
    const WhatIf* found = what_if.found();
    if (!found) {
        words(ui.style.quiet, what_if.is_under_way()
                                  ? "Measuring\u2026"
                                  : "Would queries cost less with other axes here, another box or another split?");
        if (!what_if.is_under_way()) command_button(ui, "Try others", "tree.what_if", "what_if.measure");
        return;
    }
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {0, 0});
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    const float width = ImGui::GetContentRegionAvail().x;
    table_line(ui, corner, width, "", {"m\u00B2\u00B7s", "tests", "cost %"}, ui.style.quiet, ui.style.quiet);
    ImGui::Dummy({width, ImGui::GetFrameHeight()});
    for (std::size_t i = 0; i < found->variants.size(); ++i) variant_row(ui, *found, i);
    ImGui::PopStyleVar();
    ui.mark_only("what_if.table");
    const bool keeps = &found->best() == &found->variants.front();
    words(keeps ? ui.style.quiet : ui.style.text,
          keeps ? "Nothing costs less for certain."
                : "Best: " + change_words(*found->variants.front().tree, found->best().change));
    words(ui.style.quiet, "Measured only, at " + counted(found->queries, "placement", "placements") +
                              " of the clip against itself. Volume: of the box, or of its children's where the split "
                              "is other. The tree stays as it is.");
}

}  // namespace mobbscope::app
