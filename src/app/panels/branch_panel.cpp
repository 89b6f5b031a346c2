#include <app/commands/command.h>
#include <app/panels/query_parts.h>
#include <app/ui/thing_menus.h>
#include <app/ui/widgets.h>
#include <base/text.h>
#include <explain/branch_costs.h>
#include <explain/query_sentence.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace mobbscope::app {

namespace {

constexpr int kMostBranchRows = 6;

/// A row over a bar as long as its share of the most.
bool cost_row(Ui& ui, const Row& shown, double share) {
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    const float width = ImGui::GetContentRegionAvail().x * static_cast<float>(std::clamp(share, 0.0, 1.0));
    ImGui::GetWindowDrawList()->AddRectFilled({corner.x, corner.y + ui.px(1)},
                                              {corner.x + width, corner.y + ImGui::GetFrameHeight() - ui.px(1)},
                                              to_im(with_alpha(ui.style.palette.overlap, 0.22f)), ui.px(3));
    return row(ui, shown);
}

void of_query(Ui& ui, QueryInspector& queries, const QueryFindings& findings) {
    const Recursion& recursion = findings.recursion;
    const std::vector<BranchCost>& branches = queries.branches();
    if (branches.empty()) {
        words(ui.style.quiet, "No pair below the first one called others.");
        return;
    }
    rows(ui, "##branches", static_cast<int>(branches.size()), kMostBranchRows, [&](int i) {
        const BranchCost& branch = branches[static_cast<std::size_t>(i)];
        const RecursionPair& pair = recursion.pairs[static_cast<std::size_t>(branch.pair)];
        const int hovered = ui.workspace.hovered_event;
        const int step = ui.workspace.step();
        if (cost_row(ui,
                     {.mark = "branch." + std::to_string(i),
                      .name = node_name(findings.sides[0], pair.a) + " / " + node_name(findings.sides[1], pair.b),
                      .remark = i == 0 ? counted(branch.events, "event", "events") : std::to_string(branch.events),
                      .selected = step >= pair.first && step <= pair.last,
                      .hovered = hovered >= pair.first && hovered <= pair.last,
                      .remark_color = to_im(readable(ui.style.palette.overlap, ui.style.palette))},
                     static_cast<double>(branch.events) / branches.front().events)) {
            ui.invoke("step.to", std::to_string(pair.last));
        }
        context_menu(ui, [&] { return test_menu(ui.workspace, queries, pair.last); });
        if (!ImGui::IsItemHovered()) return;
        ui.hovered_event = pair.last;
        if (ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left)) ui.invoke("focus.branch", std::to_string(pair.last));
    });
}

void neighbours(Ui& ui, const char* what, const std::string& mark, const std::vector<Sandwich::Neighbour>& all) {
    if (all.empty()) return;
    words(ui.style.quiet, what);
    rows(ui, ("##" + mark).c_str(), static_cast<int>(all.size()), kMostBranchRows, [&](int i) {
        const Sandwich::Neighbour& neighbour = all[static_cast<std::size_t>(i)];
        const std::string name =
            tree_node_name(ui.workspace, neighbour.nodes[0]) + " / " + tree_node_name(ui.workspace, neighbour.nodes[1]);
        static_cast<void>(cost_row(
            ui, {.mark = mark + '.' + std::to_string(i), .name = name, .remark = std::to_string(neighbour.tests)},
            static_cast<double>(neighbour.tests) / static_cast<double>(all.front().tests)));
    });
}

void of_scene(Ui& ui, const CostInspector& costs) {
    const SceneCosts* counted_costs = costs.costs();
    if (!counted_costs) {
        words(ui.style.quiet, "The tests of all queries are not counted.");
        if (small_button(ui, "Count them", "branches.count")) ui.invoke("branches.of", "scene");
        return;
    }
    const std::vector<NodeCost>& nodes = counted_costs->nodes;
    if (nodes.empty()) return;
    rows(ui, "##nodes", static_cast<int>(nodes.size()), kMostBranchRows, [&](int i) {
        const NodeCost& cost = nodes[static_cast<std::size_t>(i)];
        const std::string name = tree_node_name(ui.workspace, cost.at);
        const std::int64_t all = cost.own + cost.below;
        if (cost_row(ui,
                     {.mark = "cost." + std::to_string(i),
                      .name = name,
                      .remark = i == 0 ? counted(all, "test", "tests") : std::to_string(all),
                      .selected = costs.sandwich() && costs.sandwich()->of == cost.at,
                      .remark_color = to_im(readable(ui.style.palette.overlap, ui.style.palette))},
                     static_cast<double>(all) / static_cast<double>(nodes.front().own + nodes.front().below))) {
            ui.invoke("branches.of_node", name);
        }
        if (!ImGui::IsItemHovered()) return;
        ImGui::SetTooltip("%s: %s of its own, %s below\nClick for the pairs above and below it", name.c_str(),
                          counted(cost.own, "test", "tests").c_str(), std::to_string(cost.below).c_str());
    });
    if (counted_costs->in_part > 0) {
        words(ui.style.warning, "Here recording stopped in " + std::to_string(counted_costs->in_part) + " of " +
                                    counted(counted_costs->tests.size(), "query", "queries") + ".");
        ui.mark_only("query.stopped.all_queries");
    }
    if (const Sandwich* around = costs.sandwich()) {
        const std::string name = tree_node_name(ui.workspace, around->of);
        neighbours(ui, ("Called pairs with " + name).c_str(), "above", around->above);
        neighbours(ui, ("Called by pairs with " + name).c_str(), "below", around->below);
    }
}

}  // namespace

void costliest(Ui& ui, QueryInspector& queries, CostInspector& costs, const QueryFindings& findings) {
    const bool scene = costs.branches_of == CostInspector::Of::scene;
    if (!section(ui, "COSTLIEST BRANCHES")) return;
    const std::size_t count = ui.workspace.fitted().queries().size();
    if (count > 1) {
        const std::array all{ChoiceWord{"query", "this query"}, ChoiceWord{"scene", "all " + std::to_string(count)}};
        const int pressed = word_choice(ui, "branches", all, scene ? 1 : 0);
        if (pressed >= 0) ui.invoke("branches.of", all[static_cast<std::size_t>(pressed)].name);
    }
    if (scene && count > 1) {
        of_scene(ui, costs);
    } else {
        of_query(ui, queries, findings);
        recording_note(ui, "branches");
    }
}

}  // namespace mobbscope::app
