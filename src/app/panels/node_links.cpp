#include <app/commands/arguments.h>
#include <app/document/described.h>
#include <app/panels/panels.h>

#include <algorithm>
#include <string>
#include <vector>

namespace mobbscope::app {

namespace {

std::string level_and_place(const mobb::Tree& tree, int node) {
    return std::to_string(tree.level(node)) + '.' + std::to_string(tree.place_in_level(node));
}

/// A button that selects a node, which the picture outlines while the mouse is on it.
void node_link(Ui& ui, const PlacedAgent& who, int node, const std::string& label) {
    const Selection target{Selection::Kind::node, ui.workspace.selection.path, node};
    const bool is_here = ui.workspace.selection == target;
    ImGui::PushID(node);
    ImGui::PushStyleColor(ImGuiCol_Text, is_here ? ui.style.text : ui.style.accent);
    if (small_button(ui, label.c_str(), "node." + std::to_string(node)))
        ui.invoke("go.node", who.name + ' ' + std::to_string(node));
    ImGui::PopStyleColor();
    ImGui::PopID();
    if (ImGui::IsItemHovered()) ui.hovered = target;
}

/// From the root down to a node.
void breadcrumb(Ui& ui, const PlacedAgent& who, const mobb::Tree& tree, int node) {
    std::vector<int> way;
    for (int at = node; at >= 0; at = tree.parent(at)) way.push_back(at);
    std::ranges::reverse(way);
    for (const int at : way) {
        std::string label = at == way.front() ? who.name : "\u203A";
        label.append(1, ' ').append(level_and_place(tree, at));
        if (at != way.front()) flow(button_width(label.c_str()));
        node_link(ui, who, at, label);
    }
}

}  // namespace

void node_links(Ui& ui) {
    const Selection& selected = ui.workspace.selection;
    if (selected.kind != Selection::Kind::node && selected.kind != Selection::Kind::sample) return;
    const auto who = placed_agent_of(ui.workspace.fitted(), selected.path);
    if (!who) return;
    const mobb::Tree& tree = ui.workspace.fitted().tree(*who);
    const bool is_node = selected.kind == Selection::Kind::node;
    const int node = is_node ? selected.index : leaf_of_sample(tree, selected.index);
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {ui.px(2), ImGui::GetStyle().ItemSpacing.y});
    ImGui::PushStyleColor(ImGuiCol_Button, IM_COL32_BLACK_TRANS);
    breadcrumb(ui, *who, tree, node);
    if (is_node) {
        const int before = neighbour_on_level(tree, node, -1), after = neighbour_on_level(tree, node, 1);
        if (before >= 0 || after >= 0) {
            form_label(ui, "beside", nullptr);
            if (before >= 0) node_link(ui, *who, before, "\u2039 " + level_and_place(tree, before));
            if (before >= 0 && after >= 0) ImGui::SameLine();
            if (after >= 0) node_link(ui, *who, after, level_and_place(tree, after) + " \u203A");
        }
        if (!tree.is_leaf(node)) {
            const auto [first, last] = tree.children(node);
            form_label(ui, "below", nullptr);
            for (int child = first; child >= 0; child = child == last ? -1 : neighbour_on_level(tree, child, 1)) {
                const std::string label = level_and_place(tree, child);
                if (child != first) flow(button_width(label.c_str()));
                node_link(ui, *who, child, label);
            }
        }
    }
    ImGui::PopStyleColor();
    ImGui::PopStyleVar();
    if (!is_node) return;
    const bool is_alone = ui.workspace.view().subtree == DrawnNode{selected.path.agent, node};
    command_button(ui, is_alone ? "show all" : "show alone", "node.isolate", "node.isolate");
    const char* above = ui.workspace.view().ancestors ? "hide boxes above" : "boxes above";
    flow(button_width(above));
    command_button(ui, above, "view.ancestors", "node.ancestors");
}

}  // namespace mobbscope::app
