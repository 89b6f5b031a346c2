#include <app/document/described.h>
#include <app/panels/bottom_tabs.h>
#include <app/ui/filter_field.h>
#include <app/ui/widgets.h>
#include <base/text.h>
#include <explain/query_sentence.h>
#include <scene/fitted_scene.h>

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

namespace mobbscope::app {

namespace {

constexpr int kLeastRows = 6;       // of the table, where the levels have room too
constexpr float kMostPart = 0.45f;  // of the room, that the levels take

/// As wide as any value of the column.
std::string widest_node_text(NodeField field) {
    switch (field) {
        case NodeField::node:
            return "00.00000";
        case NodeField::sample:
            return "00000..00000";
        default:
            return "0000000";
    }
}

std::vector<TableColumn> node_table_columns(const NodeInspector& nodes) {
    std::vector<TableColumn> out;
    for (const NodeField field : nodes.columns()) {
        const NodeFieldInfo& about = info(field);
        out.push_back({.name = std::string(about.name),
                       .heading = column_heading(field),
                       .doc = std::string(about.doc),
                       .widest = widest_node_text(field),
                       .is_number = field != NodeField::node});
    }
    return out;
}

/// Beside the tabs: of which tree, and a button for what has not been counted.
void node_title(Ui& ui, int clip) {
    const NodeInspector& nodes = ui.session.nodes;
    const NodeValues& values = *nodes.values();
    const std::string& name = ui.workspace.scene().clips[static_cast<std::size_t>(clip)].name;
    const std::string about =
        ": " + counted(values.size(), "node", "nodes") + ", " + std::string(mobb::name(values.tree().options().tree));
    const bool can_count = nodes.can_count();
    const char* const count = "count tests and overlaps";
    ImGui::SameLine(0, ui.px(18));
    const float button = can_count ? button_width(count) + ui.px(12) : 0;
    const float room = ImGui::GetContentRegionAvail().x - button - ImGui::CalcTextSize(about.c_str()).x;
    text_line(ui.style.quiet, fitted_name(name, std::max(room, ui.px(40))) + about);
    if (!can_count) return;
    ImGui::SameLine(0, ui.px(12));
    ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {ui.px(6), 0});
    command_button(ui, count, "nodes.count", "nodes.count");
    ImGui::PopStyleVar();
}

std::vector<MenuEntry> node_row_menu(const Ui& ui, int node) {
    const std::optional<Selection> selection = ui.session.nodes.selection_of(node);
    std::vector<MenuEntry> menu;
    if (selection) {
        const mobb::Tree& tree = ui.session.nodes.values()->tree();
        const std::string level = std::to_string(tree.level(node));
        const std::string name = placed_agent_of(ui.workspace.fitted(), selection->path)->name;
        menu = {{"go.node", name + ' ' + std::to_string(node), "Select it, and show its level"},
                {"view.level", level, "Show level " + level + " alone"},
                {""}};
    }
    menu.insert(menu.end(), {{"nodes.copy"}, {"nodes.copy_csv"}});
    return menu;
}

void node_filter_line(Ui& ui) {
    static const std::vector<MenuEntry> entries{{"nodes.count"}, {""}, {"nodes.copy"}, {"nodes.copy_csv"}};
    const NodeInspector& nodes = ui.session.nodes;
    filter_line(ui, "nodes",
                {.fields = node_field_table(),
                 .now = nodes.filter ? nodes.filter->text() : "",
                 .hint = "fill < 50 % and not leaf",
                 .hits =
                     [&nodes](const std::string& filter) {
                         return std::to_string(nodes.hits(NodeFilter(filter))) + " of " +
                                std::to_string(nodes.values()->size());
                     }},
                "Count tests; copy the table", entries);
}

}  // namespace

void node_list(Ui& ui, DataTable& table, LevelStrip& levels, const ChartAxis& time) {
    const NodeInspector& nodes = ui.session.nodes;
    const int clip = clip_in_focus(ui.workspace);
    ui.session.fit_costs.update(clip);
    node_title(ui, clip);
    const float below =
        ImGui::GetFrameHeightWithSpacing() + DataTable::height(ui, kLeastRows) + ImGui::GetStyle().ScrollbarSize;
    const float room = ImGui::GetContentRegionAvail().y;
    levels.draw(ui, clip, time, std::min(room - below, kMostPart * room));
    node_filter_line(ui);
    const auto rows = nodes.listed();
    if (rows->empty()) return words(ui.style.quiet, "No node passes the filter.");
    const std::shared_ptr<const NodeValues> values = nodes.values();
    const std::vector<NodeField> fields = nodes.columns();
    const std::vector<TableColumn> columns = node_table_columns(nodes);
    table.draw(ui,
               {.mark = "nodes",
                .columns = columns,
                .rows = rows,
                .present = nodes.selected(),
                .hovered = nodes.hovered(),
                .sorted_by = std::string(info(nodes.by).name),
                .descending = nodes.descending,
                .filter = nodes.filter ? nodes.filter->text() : "",
                .cell =
                    [&](std::size_t column, int node) {
                        const NodeField field = fields[column];
                        const double shown_as = info(field).unit == "%" ? 100 : 1;
                        return TableCell{
                            node_text(*values, field, node), ui.style.text, {shown_as * values->value(field, node)}};
                    },
                .sort = [&](const std::string& column) { ui.invoke("nodes.sort", column); },
                .pick =
                    [&](int node) {
                        const auto selection = nodes.selection_of(node);
                        if (selection) ui.later([selection](Workspace& workspace) { workspace.select(*selection); });
                    },
                .hover =
                    [&](int node) {
                        const auto selection = nodes.selection_of(node);
                        if (!selection) return;
                        ui.hovered = *selection;
                        const auto who = placed_agent_of(ui.workspace.fitted(), selection->path);
                        const std::string name = node_name(drawn_agent_of(ui.workspace.fitted(), *who), node);
                        ImGui::SetTooltip("%s: %s s", name.c_str(), node_text(*values, NodeField::time, node).c_str());
                    },
                .menu = [&](int node) { return node_row_menu(ui, node); }});
}

}  // namespace mobbscope::app
