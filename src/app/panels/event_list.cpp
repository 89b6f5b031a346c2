#include <app/panels/event_list.h>
#include <app/ui/filter_field.h>
#include <app/ui/swatch.h>
#include <app/ui/thing_menus.h>
#include <app/ui/widgets.h>
#include <base/text.h>
#include <explain/query_sentence.h>

#include <algorithm>
#include <string>
#include <vector>

namespace mobbscope::app {

namespace {

/// As wide as any value of the column.
std::string widest_event_text(const TableField& field) {
    switch (field.kind) {
        case FieldKind::word:
            return std::string(*std::ranges::max_element(field.values, {}, &std::string_view::size));
        case FieldKind::range:
            return "000.000..000.000";
        case FieldKind::node:
            return "00.0000";
        case FieldKind::number:
        case FieldKind::flag:
            break;
    }
    return field.unit.empty() ? "0000000" : "-1.23e-05";
}

const std::vector<TableColumn>& event_table_columns() {
    static const std::vector<TableColumn> all = [] {
        std::vector<TableColumn> out;
        for (const EventColumn& column : event_columns()) {
            const TableField& field = info(column.field);
            std::string doc(field.doc);
            if (field.of_side) doc += column.side == 0 ? ", of A" : ", of B";
            out.push_back({.name = column_name(column),
                           .heading = std::string(column.heading),
                           .doc = std::move(doc),
                           .widest = widest_event_text(field),
                           .is_number = field.kind == FieldKind::number || field.kind == FieldKind::range});
        }
        return out;
    }();
    return all;
}

const std::vector<MenuEntry>& list_menu() {
    static const std::vector<MenuEntry> entries{{"events.saved"},
                                                {"events.save"},
                                                {"events.rename_saved"},
                                                {"events.remove_saved"},
                                                {""},
                                                {"events.copy"},
                                                {"events.copy_csv"},
                                                {""},
                                                {"breakpoint.next"},
                                                {"breakpoint.previous"}};
    return entries;
}

void event_filter_line(Ui& ui, QueryInspector& queries) {
    const std::optional<EventFilter>& now = ui.workspace.events.filter;
    const int all = queries.events_in_focus();
    filter_line(ui, "events",
                {.fields = event_field_table(),
                 .now = now ? now->text() : "",
                 .hint = "gap < 0.05 and level(a) >= 3",
                 .hits =
                     [&queries, all](const std::string& filter) {
                         return std::to_string(queries.hits(EventFilter(filter))) + " of " + std::to_string(all);
                     }},
                "Saved filters; copy the list", list_menu());
    if (ui.workspace.look.focus.is_all()) return;
    text_line(ui.style.accent, "Only the focus is listed.");
    ImGui::SameLine();
    command_button(ui, "list everything", "focus.none", "events.focus_none");
}

}  // namespace

void EventTable::draw(Ui& ui, QueryInspector& queries) {
    event_filter_line(ui, queries);
    const auto rows = queries.listed_events();
    if (rows->empty()) {
        const bool whole = ui.workspace.look.focus.is_all();
        return words(ui.style.quiet,
                     whole ? "No event passes the filter." : "No event of the focus passes the filter.");
    }
    const EventValues values = queries.events();
    const mobb::Trace& trace = ui.workspace.recorded()->trace;
    const EventList& list = ui.workspace.events;
    table_.draw(
        ui, {.mark = "events",
             .columns = event_table_columns(),
             .rows = rows,
             .present = ui.workspace.step(),
             .hovered = ui.workspace.hovered_event,
             .sorted_by = column_name(list.by),
             .descending = list.descending,
             .filter = list.filter ? list.filter->text() : "",
             .cell =
                 [&](std::size_t index, int step) {
                     const EventColumn& column = event_columns()[index];
                     const mobb::Trace::Event event = trace[step];
                     const ImU32 color = column.field == EventField::outcome
                                             ? mark_text(ui.style, mark_of(event.test, event.outcome))
                                             : ui.style.text;
                     const auto exact = values.value(column.field, column.side, step);
                     return TableCell{values.text(column.field, column.side, step), color, {exact.least, exact.most}};
                 },
             .sort = [&](const std::string& column) { ui.invoke("events.sort", column); },
             .pick = [&](int step) { ui.invoke("step.to", std::to_string(step)); },
             .hover =
                 [&](int step) {
                     ui.hovered_event = step;
                     ImGui::SetTooltip("%s", step_sentence(queries.findings()->sides, trace, step).c_str());
                 },
             .menu = [&](int step) { return test_menu(ui.workspace, queries, step); },
             .is_marked = [&](int step) { return std::ranges::binary_search(queries.break_steps(), step); },
             .marked = "break"});
}

}  // namespace mobbscope::app
