#include <app/panels/list_rows.h>
#include <import/text.h>

#include <algorithm>

namespace mobbscope::app {

std::string fitted_text(const std::string& text, float room) {
    const std::string line = cleaned(text);
    if (ImGui::CalcTextSize(line.c_str()).x <= room) return line;
    const float left = std::max(room - ImGui::CalcTextSize("\u2026").x, 0.0f);
    const char* end = nullptr;
    ImGui::GetFont()->CalcTextSizeA(ImGui::GetFontSize(), left, 0, line.c_str(), nullptr, &end);
    return line.substr(0, static_cast<std::size_t>(end - line.c_str())) + "\u2026";
}

void rows(Ui& ui, const char* name, int count, int most_rows, const std::function<void(int)>& draw) {
    const float height = ImGui::GetFrameHeight();
    const bool scrolls = count > most_rows;
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {ui.px(8), 0});
    if (scrolls)
        ImGui::BeginChild(name, {0, height * (static_cast<float>(most_rows) + 0.5f)}, false,
                          ImGuiWindowFlags_NoBackground);
    ImGuiListClipper clipper;
    clipper.Begin(count, height);
    while (clipper.Step()) {
        for (int i = clipper.DisplayStart; i < clipper.DisplayEnd; ++i) draw(i);
    }
    if (scrolls) ImGui::EndChild();
    ImGui::PopStyleVar();
}

bool row(Ui& ui, const Row& row) {
    const float height = ImGui::GetFrameHeight();
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    const float width = ImGui::GetContentRegionAvail().x;
    ImGui::PushID(row.id.c_str());
    const bool clicked = ImGui::InvisibleButton("##row", {width, height});
    ImGui::PopID();
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    const ImVec2 end{corner.x + width, corner.y + height};
    if (row.selected || row.hovered || ImGui::IsItemHovered()) {
        draw.AddRectFilled(corner, end, row.selected ? ui.look.raised : ui.look.border, ui.px(4));
    }
    if (row.selected) draw.AddRectFilled(corner, {corner.x + ui.px(2), end.y}, ui.look.accent, ui.px(1));
    const float pad = ui.px(6);
    const ImFont* mono = ui.look.mono;
    const float y = corner.y + 0.5f * (height - ImGui::GetFontSize());
    const ImVec2 remark = mono->CalcTextSizeA(mono->FontSize, 1e6f, 0, row.remark.c_str());
    const float left = corner.x + pad + row.indent;
    const std::string name = fitted_text(row.name, std::max(ui.px(24), end.x - pad - remark.x - ui.px(8) - left));
    draw.AddText({left, y}, ui.look.text, name.c_str());
    draw.AddText(mono, mono->FontSize, {end.x - pad - remark.x, corner.y + 0.5f * (height - mono->FontSize)},
                 row.remark_color != 0 ? row.remark_color : ui.look.quiet, row.remark.c_str());
    return clicked;
}

}  // namespace mobbscope::app
