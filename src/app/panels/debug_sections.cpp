#include <app/document/debug_texts.h>
#include <app/panels/query_parts.h>
#include <app/ui/filter_field.h>
#include <base/text.h>
#include <scene/step_link.h>

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace mobbscope::app {

namespace {

enum class Pressed { nothing, row, remove };

/// A row with a button at its right end that removes what it is of.
Pressed removable_row(Ui& ui, Row what, const std::function<std::string()>& tooltip) {
    const float side = ImGui::GetFrameHeight();
    what.buttons = what.right = side;
    Pressed out = row(ui, what) ? Pressed::row : Pressed::nothing;
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", tooltip().c_str());
    ImGui::SameLine(0, 0);
    ImGui::PushID(what.mark.c_str());
    ImGui::PushStyleColor(ImGuiCol_Button, IM_COL32_BLACK_TRANS);
    if (ImGui::Button("\u00D7", {side, side})) out = Pressed::remove;
    ImGui::PopStyleColor();
    ImGui::PopID();
    ui.mark(what.mark + ".remove");
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("Remove it");
    return out;
}

std::string hits_text(QueryInspector& queries, const EventFilter& filter) {
    return "at " + counted(queries.hits(filter), "test", "tests");
}

void breakpoint_row(Ui& ui, QueryInspector& queries, const Breakpoint& breakpoint, std::size_t index) {
    const std::string mark = "break." + std::to_string(index);
    const EventFilter filter(breakpoint.where);
    bool on = breakpoint.on;
    ImGui::PushID(static_cast<int>(index));
    if (ImGui::Checkbox("##on", &on)) ui.invoke("breakpoint.switch", breakpoint.where);
    ImGui::PopID();
    ui.mark(mark + ".on");
    ImGui::SameLine(0, ui.px(4));
    const Row what{
        .mark = mark, .name = breakpoint.where, .remark = hits_text(queries, filter), .quiet = !breakpoint.on};
    switch (removable_row(ui, what, [&] {
        return breakpoint.where + "\nBreaks when " + filter.words() + ".\nA click lists the events at which it does";
    })) {
        case Pressed::nothing:
            break;
        case Pressed::row:
            ui.invoke("events.filter", breakpoint.where);
            break;
        case Pressed::remove:
            ui.invoke("breakpoint.remove", breakpoint.where);
            break;
    }
}

/// The name and the note of the bookmark on the present step.
void bookmark_fields(Ui& ui, const Bookmark& bookmark) {
    form_label(ui, "Name", nullptr);
    if (const auto name = text_edit(ui, "bookmark.name", bookmark.name)) ui.invoke("bookmark.rename", *name);
    form_label(ui, "Note", nullptr);
    if (const auto note = text_edit(ui, "bookmark.note", bookmark.note)) ui.invoke("bookmark.note", *note);
}

}  // namespace

void break_when(Ui& ui, QueryInspector& queries) {
    if (!section(ui, "BREAK WHEN")) return;
    const FilterField field{.mark = "break.filter",
                            .fields = event_field_table(),
                            .hint = "outcome = hit",
                            .hits = [&](const std::string& filter) { return hits_text(queries, EventFilter(filter)); }};
    const std::optional<std::string> entered = table_filter_field(ui, field);
    filter_words(ui, field);
    if (entered && !entered->empty()) ui.invoke("breakpoint.add", *entered);
    const std::vector<Breakpoint>& all = ui.workspace.scene().debug.breakpoints;
    for (std::size_t i = 0; i < all.size(); ++i) breakpoint_row(ui, queries, all[i], i);
    command_button(ui, "these two", "breakpoint.here", "break.here");
    if (all.empty()) return;
    flow(button_width("back to one"));
    command_button(ui, "back to one", "breakpoint.previous", "break.previous");
    flow(button_width("run to next"));
    command_button(ui, "run to next", "breakpoint.next", "break.next");
}

void bookmarks(Ui& ui) {
    if (!section(ui, "BOOKMARKS")) return;
    const DebugState& debug = ui.workspace.scene().debug;
    const std::vector<std::string> names = names_of_bookmarks(debug);
    const std::optional<std::size_t> present = present_bookmark(ui.workspace);
    for (std::size_t i = 0; i < names.size(); ++i) {
        const Bookmark& bookmark = debug.bookmarks[i];
        const std::string link = to_string(StepLink{bookmark.query, bookmark.step});
        const Row what{.mark = "bookmark." + std::to_string(i),
                       .name = names[i],
                       .remark = names[i] == link ? "" : link,
                       .selected = present == i};
        switch (removable_row(ui, what, [&] { return bookmark.note.empty() ? names[i] : bookmark.note; })) {
            case Pressed::nothing:
                break;
            case Pressed::row:
                ui.invoke("bookmark.go", names[i]);
                break;
            case Pressed::remove:
                ui.invoke("bookmark.remove", names[i]);
                break;
        }
        if (present == i) bookmark_fields(ui, bookmark);
    }
    command_button(ui, "bookmark this step", "bookmark.add", "bookmark.add");
}

}  // namespace mobbscope::app
