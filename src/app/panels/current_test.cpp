#include <app/panels/query_parts.h>
#include <app/ui/swatch.h>
#include <app/ui/widgets.h>
#include <explain/query_sentence.h>

#include <cctype>

namespace mobbscope::app {

namespace {

void node_line(Ui& ui, const QueryFindings& findings, std::size_t side, int node) {
    const DrawnAgent& agent = findings.sides[side];
    const mobb::Node& n = agent.placed.node(node);
    const Selection selection{Selection::Kind::node,
                              agent_in_view(ui.session.fitted(), ui.session.view(), static_cast<int>(side)), node};
    const std::string samples = std::to_string(n.first) + " .. " + std::to_string(n.end() - 1);
    ImGui::PushID(static_cast<int>(side));
    const float left = ImGui::GetCursorPosX();
    const float room = ImGui::GetContentRegionAvail().x;
    const bool selected = ui.session.selection == selection;
    ImGui::PushStyleColor(ImGuiCol_Text, to_im(readable(agent.color, ui.style.palette)));
    const std::string name = node_name(agent, node);
    const float name_width = ImGui::CalcTextSize(name.c_str()).x;
    if (ImGui::Selectable((name + "##node").c_str(), selected)) ui.session.select(selection);
    ImGui::PopStyleColor();
    ui.mark(side == 0 ? "query.node_a" : "query.node_b");
    if (ImGui::IsItemHovered()) {
        ui.session.hovered = selection;
        ImGui::SetTooltip("%s, samples %s\nClick to select", name.c_str(), samples.c_str());
    }
    ImGui::PushFont(ui.style.mono);
    const float width = ImGui::CalcTextSize(samples.c_str()).x;
    if (name_width + width + ui.px(12) < room) {
        ImGui::SameLine(left + room - width);
        ImGui::PushStyleColor(ImGuiCol_Text, ui.style.quiet);
        ImGui::TextUnformatted(samples.c_str());
        ImGui::PopStyleColor();
    }
    ImGui::PopFont();
    ImGui::PopID();
}

}  // namespace

void current_test(Ui& ui, const QueryFindings& findings) {
    const mobb::Trace::Event event = ui.session.recorded()->trace[ui.session.step()];
    const EventMark mark = mark_of(event.test, event.outcome);
    heading(ui, "THIS TEST", "depth " + std::to_string(event.depth));
    framed(ui, mark_color(ui.style, mark, 0.10f), mark_color(ui.style, mark), [&] {
        const ImVec2 at = ImGui::GetCursorScreenPos();
        const float side = ui.px(12);
        const float down = 0.5f * (ImGui::GetTextLineHeight() - side);
        outcome_cell(*ImGui::GetWindowDrawList(), ui.style, {at.x, at.y + down}, {at.x + side, at.y + down + side},
                     mark, 1);
        ImGui::Dummy({side, ImGui::GetTextLineHeight()});
        ImGui::SameLine(0, ui.px(7));
        words(mark_text(ui.style, mark), headline(mark));
        std::string sentence = outcome_text(findings.sides, event) + ".";
        sentence[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(sentence[0])));
        words(ui.style.text, sentence);
    });
    ui.mark("query.test");
    node_line(ui, findings, 0, event.a);
    node_line(ui, findings, 1, event.b);
}

}  // namespace mobbscope::app
