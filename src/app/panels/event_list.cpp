#include <app/panels/event_list.h>
#include <app/ui/filter_field.h>
#include <app/ui/swatch.h>
#include <app/ui/thing_menus.h>
#include <app/ui/widgets.h>
#include <base/text.h>
#include <explain/query_sentence.h>

#include <algorithm>
#include <optional>
#include <string>
#include <utility>

namespace mobbscope::app {

namespace {

constexpr const char* kTable = "events";

/// As wide as any value of the column.
std::string widest_text(const EventColumn& column) {
    const EventFieldInfo& about = info(column.field);
    switch (about.kind) {
        case FieldKind::word: {
            const auto longest = std::ranges::max_element(about.values, {}, &std::string_view::size);
            return std::string(*longest);
        }
        case FieldKind::range:
            return "000.000..000.000";
        case FieldKind::node:
            return "00.0000";
        case FieldKind::number:
        case FieldKind::flag:
            break;
    }
    return about.unit.empty() ? "0000000" : "-00.000";
}

bool is_number(const EventColumn& column) {
    const FieldKind kind = info(column.field).kind;
    return kind == FieldKind::number || kind == FieldKind::range;
}

/// A click sorts by the column, the next one the other way round.
void column_head(Ui& ui, const EventColumn& column) {
    const EventList& list = ui.workspace.events;
    const std::string name = column_name(column);
    const bool on = column_name(list.by) == name;
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float width = ImGui::GetContentRegionAvail().x;
    const float height = ImGui::GetTextLineHeight();
    if (ImGui::InvisibleButton(name.c_str(), {std::max(1.0f, width), height})) ui.invoke("events.sort", name);
    ui.mark("events.sort." + name);
    const bool hovered = ImGui::IsItemHovered();
    if (hovered) {
        const std::string side = info(column.field).of_side ? (column.side == 0 ? ", of A" : ", of B") : "";
        ImGui::SetTooltip("%s%s. A click sorts by it", std::string(info(column.field).doc).c_str(), side.c_str());
    }
    const ImFont& font = *ui.style.caption;
    const std::string heading(column.heading);
    const float text = text_size(font, heading).x;
    const float x = is_number(column) ? at.x + width - text : at.x;
    const float y = at.y + 0.5f * (height - font.FontSize);
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    draw_text(draw, font, {x, y}, on || hovered ? ui.style.text : ui.style.quiet, heading);
    if (!on) return;
    const float r = ui.px(3);
    const float up = list.descending ? -1.0f : 1.0f;
    const ImVec2 middle{is_number(column) ? x - 2 * r : x + text + 2 * r, y + 0.5f * font.FontSize};
    draw.AddTriangleFilled({middle.x - r, middle.y + 0.7f * up * r}, {middle.x + r, middle.y + 0.7f * up * r},
                           {middle.x, middle.y - 0.7f * up * r}, ui.style.text);
}

void cell(Ui& ui, const EventColumn& column, const std::string& text, const EventValues::Range& exact, ImU32 color) {
    const float width = text_size(*ui.style.mono, text).x;
    const float spare = ImGui::GetContentRegionAvail().x - width;
    if (is_number(column) && spare > 0) ImGui::SetCursorPosX(ImGui::GetCursorPosX() + spare);
    text_line(color, text, ui.style.mono);
    if (is_number(column))
        copies_numbers(ui, text, ImGui::GetItemRectMin(), *ui.style.mono, {exact.least, exact.most}, true);
}

FilterField list_filter(const Ui& ui, QueryInspector& queries) {
    const std::optional<EventFilter>& now = ui.workspace.events.filter;
    const int all = queries.events_in_focus();
    return {.mark = "events.filter",
            .now = now ? now->text() : "",
            .hint = "gap < 0.05 and level(a) >= 3",
            .hits = [&queries, all](const EventFilter& filter) {
                return std::to_string(queries.hits(filter)) + " of " + std::to_string(all);
            }};
}

/// The menu of what else can be done with the list.
void list_menu(Ui& ui) {
    if (ImGui::Button("\u00BB##list")) ImGui::OpenPopup("list menu");
    ui.mark("events.more");
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("Saved filters; copy the list");
    context_menu(ui, "list menu", []() -> std::vector<MenuEntry> {
        return {{"events.saved"},
                {"events.save"},
                {"events.rename_saved"},
                {"events.remove_saved"},
                {""},
                {"events.copy"},
                {"events.copy_csv"},
                {""},
                {"breakpoint.next"},
                {"breakpoint.previous"}};
    });
}

void filter_line(Ui& ui, QueryInspector& queries) {
    FilterField field = list_filter(ui, queries);
    const float gap = ImGui::GetStyle().ItemSpacing.x;
    field.right = button_width("all") + button_width("\u00BB") + 2 * gap;
    const std::optional<std::string> entered = event_filter_field(ui, field);
    ImGui::SameLine();
    command_button(ui, "all", "events.all", "events.all");
    ImGui::SameLine();
    list_menu(ui);
    filter_words(ui, field);
    if (!ui.workspace.look.focus.is_all()) {
        text_line(ui.style.accent, "Only the focus is listed.");
        ImGui::SameLine();
        command_button(ui, "list everything", "focus.none", "events.focus_none");
    }
    if (!entered) return;
    if (!entered->empty()) return ui.invoke("events.filter", *entered);
    if (ui.workspace.events.filter) ui.invoke("events.all");
}

}  // namespace

void EventTable::draw(Ui& ui, QueryInspector& queries) {
    filter_line(ui, queries);
    table(ui, queries);
}

void EventTable::follow(int step, float row_height, float head_height) {
    if (step_ == step && present_ != -2) return;
    step_ = step;
    const auto at = std::ranges::find(*rows_, step);
    present_ = at == rows_->end() ? -1 : static_cast<int>(at - rows_->begin());
    if (present_ < 0) return;
    const float top = static_cast<float>(present_) * row_height;
    const float seen = ImGui::GetWindowHeight() - head_height - row_height;
    const float scroll = ImGui::GetScrollY();
    if (top >= scroll && top + row_height <= scroll + seen) return;
    ImGui::SetScrollY(std::max(0.0f, top - 0.5f * seen));
}

void EventTable::row(Ui& ui, QueryInspector& queries, int index) const {
    const int step = (*rows_)[static_cast<std::size_t>(index)];
    const EventValues values = queries.events();
    const mobb::Trace& trace = ui.workspace.recorded()->trace;
    const mobb::Trace::Event event = trace[step];
    const float height = ImGui::GetTextLineHeight() + ui.px(3);
    ImGui::TableNextRow(0, height);
    ImGui::TableSetColumnIndex(0);
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    ImGui::PushID(step);
    const bool clicked =
        ImGui::Selectable("##row", index == present_, ImGuiSelectableFlags_SpanAllColumns, {0, height});
    ImGui::PopID();
    ui.mark("events.row." + std::to_string(step));
    if (index == present_) ui.focus.begin_here();
    // Arrows step as they go.
    if ((clicked && !ImGui::GetIO().KeyCtrl) || (ui.focus.arrived_at_last() && step != ui.workspace.step()))
        ui.invoke("step.to", std::to_string(step));
    if (ImGui::IsItemHovered()) {
        ui.hovered_event = step;
        ImGui::SetTooltip("%s", step_sentence(queries.findings()->sides, trace, step).c_str());
    }
    if (step == ui.workspace.hovered_event && index != present_)
        ImGui::TableSetBgColor(ImGuiTableBgTarget_RowBg0, ImGui::GetColorU32(ImGuiCol_HeaderHovered));
    context_menu(ui, [&] { return test_menu(ui.workspace, queries, step); });
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    if (std::ranges::binary_search(queries.break_steps(), step)) {
        const float r = ui.px(3.5f);
        draw.AddCircleFilled({corner.x + r, corner.y + 0.5f * height}, r, ui.style.error);
        ui.mark_only("events.break." + std::to_string(step));
    }
    for (std::size_t i = 0; i < event_columns().size(); ++i) {
        const EventColumn& column = event_columns()[i];
        if (!ImGui::TableSetColumnIndex(static_cast<int>(i))) continue;
        if (i == 0) ImGui::SetCursorScreenPos(corner);
        const ImU32 color = column.field == EventField::outcome
                                ? mark_text(ui.style, mark_of(event.test, event.outcome))
                                : ui.style.text;
        cell(ui, column, values.text(column.field, column.side, step), values.value(column.field, column.side, step),
             color);
    }
}

void EventTable::table(Ui& ui, QueryInspector& queries) {
    const auto rows = queries.listed_events();
    if (std::exchange(rows_, rows) != rows) present_ = -2;
    const EventList& list = ui.workspace.events;
    const std::string order =
        column_name(list.by) + (list.descending ? " down " : " up ") + (list.filter ? list.filter->text() : "");
    const bool is_ordered_anew = std::exchange(order_, order) != order;
    if (rows->empty()) {
        const bool whole = ui.workspace.look.focus.is_all();
        return words(ui.style.quiet,
                     whole ? "No event passes the filter." : "No event of the focus passes the filter.");
    }
    const int columns = static_cast<int>(event_columns().size());
    ImGui::PushStyleVar(ImGuiStyleVar_CellPadding, {ui.px(7), 0});
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {ui.px(8), 0});
    const ImVec2 room = ImGui::GetContentRegionAvail();
    if (room.y > ui.px(40) && ImGui::BeginTable(kTable, columns,
                                                ImGuiTableFlags_ScrollX | ImGuiTableFlags_ScrollY |
                                                    ImGuiTableFlags_SizingFixedFit | ImGuiTableFlags_NoSavedSettings,
                                                room)) {
        ImGui::PushFont(ui.style.mono);
        for (const EventColumn& column : event_columns()) {
            const float heading = text_size(*ui.style.caption, std::string(column.heading)).x + ui.px(12);
            ImGui::TableSetupColumn(column_name(column).c_str(), ImGuiTableColumnFlags_WidthFixed,
                                    std::max(heading, ImGui::CalcTextSize(widest_text(column).c_str()).x));
        }
        ImGui::PopFont();
        ImGui::TableSetupScrollFreeze(1, 1);
        ImGui::TableNextRow(ImGuiTableRowFlags_Headers);
        const float head_height = ImGui::GetTextLineHeight();
        for (int i = 0; i < columns; ++i) {
            if (ImGui::TableSetColumnIndex(i)) column_head(ui, event_columns()[static_cast<std::size_t>(i)]);
        }
        const float row_height = ImGui::GetTextLineHeight() + ui.px(3);
        follow(ui.workspace.step(), row_height, head_height);
        // Who sorts or filters looks for what comes first.
        if (is_ordered_anew) ImGui::SetScrollY(0);
        clipped_rows(ui, "##rows", static_cast<int>(rows->size()), row_height,
                     [&](int index) { row(ui, queries, index); });
        ImGui::EndTable();
    }
    ImGui::PopStyleVar(2);
}

}  // namespace mobbscope::app
