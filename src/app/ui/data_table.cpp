#include <app/ui/data_table.h>
#include <app/ui/widgets.h>

#include <algorithm>
#include <utility>

namespace mobbscope::app {

namespace {

float table_row_height(const Ui& ui) { return ImGui::GetTextLineHeight() + ui.px(3); }

/// A click sorts by the column, the next one the other way round.
void column_head(Ui& ui, const TableContent& content, const TableColumn& column) {
    const bool on = content.sorted_by == column.name;
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float width = ImGui::GetContentRegionAvail().x;
    const float height = ImGui::GetTextLineHeight();
    if (ImGui::InvisibleButton(column.name.c_str(), {std::max(1.0f, width), height})) content.sort(column.name);
    ui.mark(content.mark + ".sort." + column.name);
    const bool hovered = ImGui::IsItemHovered();
    if (hovered) ImGui::SetTooltip("%s. A click sorts by it", column.doc.c_str());
    const ImFont& font = *ui.style.caption;
    const float text = text_size(font, column.heading).x;
    const float x = column.is_number ? at.x + width - text : at.x;
    const float y = at.y + 0.5f * (height - font.FontSize);
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    draw_text(draw, font, {x, y}, on || hovered ? ui.style.text : ui.style.quiet, column.heading);
    if (!on) return;
    const float r = ui.px(3);
    const float up = content.descending ? -1.0f : 1.0f;
    const ImVec2 middle{column.is_number ? x - 2 * r : x + text + 2 * r, y + 0.5f * font.FontSize};
    draw.AddTriangleFilled({middle.x - r, middle.y + 0.7f * up * r}, {middle.x + r, middle.y + 0.7f * up * r},
                           {middle.x, middle.y - 0.7f * up * r}, ui.style.text);
}

void cell(Ui& ui, const TableColumn& column, const TableCell& shown) {
    const float width = text_size(*ui.style.mono, shown.text).x;
    const float spare = ImGui::GetContentRegionAvail().x - width;
    if (column.is_number && spare > 0) ImGui::SetCursorPosX(ImGui::GetCursorPosX() + spare);
    text_line(shown.color, shown.text, ui.style.mono);
    if (column.is_number) copies_numbers(ui, shown.text, ImGui::GetItemRectMin(), *ui.style.mono, shown.exact, true);
}

}  // namespace

void DataTable::follow(int thing, float row_height, float head_height) {
    if (std::exchange(thing_, thing) == thing && !rows_are_new_) return;
    rows_are_new_ = false;
    const auto at = std::ranges::find(*rows_, thing);
    present_.reset();
    if (at == rows_->end()) return;
    present_ = static_cast<std::size_t>(at - rows_->begin());
    const float top = static_cast<float>(*present_) * row_height;
    const float seen = ImGui::GetWindowHeight() - head_height - row_height;
    const float scroll = ImGui::GetScrollY();
    if (top >= scroll && top + row_height <= scroll + seen) return;
    ImGui::SetScrollY(std::max(0.0f, top - 0.5f * seen));
}

void DataTable::row(Ui& ui, const TableContent& content, std::size_t index) const {
    const int thing = (*rows_)[index];
    const bool present = index == present_;
    const float height = table_row_height(ui);
    ImGui::TableNextRow(0, height);
    ImGui::TableSetColumnIndex(0);
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    ImGui::PushID(thing);
    const bool clicked = ImGui::Selectable("##row", present, ImGuiSelectableFlags_SpanAllColumns, {0, height});
    ImGui::PopID();
    ui.mark(content.mark + ".row." + std::to_string(thing));
    if (present) ui.focus.begin_here();
    // Arrows pick as they go.
    if ((clicked && !ImGui::GetIO().KeyCtrl) || (ui.focus.arrived_at_last() && !present)) content.pick(thing);
    if (ImGui::IsItemHovered()) content.hover(thing);
    if (thing == content.hovered && !present)
        ImGui::TableSetBgColor(ImGuiTableBgTarget_RowBg0, ImGui::GetColorU32(ImGuiCol_HeaderHovered));
    context_menu(ui, [&] { return content.menu(thing); });
    if (content.is_marked && content.is_marked(thing)) {
        const float r = ui.px(3.5f);
        ImGui::GetWindowDrawList()->AddCircleFilled({corner.x + r, corner.y + 0.5f * height}, r, ui.style.error);
        ui.mark_only(content.mark + '.' + content.marked + '.' + std::to_string(thing));
    }
    for (std::size_t i = 0; i < content.columns.size(); ++i) {
        if (!ImGui::TableSetColumnIndex(static_cast<int>(i))) continue;
        if (i == 0) ImGui::SetCursorScreenPos(corner);
        cell(ui, content.columns[i], content.cell(i, thing));
    }
}

float DataTable::height(const Ui& ui, int rows) {
    return ImGui::GetTextLineHeight() + static_cast<float>(rows) * table_row_height(ui);
}

void DataTable::draw(Ui& ui, const TableContent& content) {
    rows_are_new_ = std::exchange(rows_, content.rows) != content.rows || rows_are_new_;
    const std::string order = content.sorted_by + (content.descending ? " down " : " up ") + content.filter;
    // A table that opens shows the present row.
    const std::string before = std::exchange(order_, order);
    const bool is_ordered_anew = !before.empty() && before != order;
    const int columns = static_cast<int>(content.columns.size());
    // Dear ImGui keeps the widths of columns by their place: others have a table of their own.
    std::string id = content.mark;
    for (const TableColumn& column : content.columns) id.append(1, ' ').append(column.name);
    ImGui::PushStyleVar(ImGuiStyleVar_CellPadding, {ui.px(7), 0});
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {ui.px(8), 0});
    const ImVec2 room = ImGui::GetContentRegionAvail();
    if (room.y >= height(ui, 1) &&
        ImGui::BeginTable(id.c_str(), columns,
                          ImGuiTableFlags_ScrollX | ImGuiTableFlags_ScrollY | ImGuiTableFlags_SizingFixedFit |
                              ImGuiTableFlags_NoSavedSettings,
                          room)) {
        ImGui::PushFont(ui.style.mono);
        for (const TableColumn& column : content.columns) {
            const float heading = text_size(*ui.style.caption, column.heading).x + ui.px(12);
            ImGui::TableSetupColumn(column.name.c_str(), ImGuiTableColumnFlags_WidthFixed,
                                    std::max(heading, ImGui::CalcTextSize(column.widest.c_str()).x));
        }
        ImGui::PopFont();
        ImGui::TableSetupScrollFreeze(1, 1);
        ImGui::TableNextRow(ImGuiTableRowFlags_Headers);
        const float head_height = ImGui::GetTextLineHeight();
        for (int i = 0; i < columns; ++i) {
            if (ImGui::TableSetColumnIndex(i)) column_head(ui, content, content.columns[static_cast<std::size_t>(i)]);
        }
        follow(content.present, table_row_height(ui), head_height);
        // Who sorts or filters looks for what comes first.
        if (is_ordered_anew) ImGui::SetScrollY(0);
        clipped_rows(ui, "##rows", static_cast<int>(rows_->size()), table_row_height(ui),
                     [&](int index) { row(ui, content, static_cast<std::size_t>(index)); });
        ImGui::EndTable();
    }
    ImGui::PopStyleVar(2);
}

}  // namespace mobbscope::app
