#include <app/commands/command.h>
#include <app/panels/query_parts.h>
#include <app/ui/swatch.h>
#include <app/ui/widgets.h>
#include <base/text.h>
#include <explain/query_sentence.h>

#include <algorithm>

namespace mobbscope::app {

namespace {

constexpr int kMostQueryRows = 12;  // a longer list scrolls by itself

/// "A against B", the names shortened until it fits; the tooltip has them in full.
std::string pair_that_fits(const SceneQuery& query, float room) {
    const std::string a = cleaned(query.a.name);
    const std::string b = cleaned(query.b.name);
    std::string pair;
    for (std::size_t most = 40; most >= 5; --most) {
        pair = shortened(a, most) + " against " + shortened(b, most);
        if (ImGui::CalcTextSize(pair.c_str()).x <= room) break;
    }
    return pair;
}

void query_row(Ui& ui, std::size_t index, float height) {
    const SceneQuery query = ui.session.fitted().queries()[index];
    const Answer& answer = ui.session.answer_of(index);
    const EventMark mark = answer.contact ? EventMark::hit : EventMark::separated;
    ImGui::PushID(static_cast<int>(index));
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float width = ImGui::GetContentRegionAvail().x;
    if (ImGui::Selectable("##query", false, 0, {width, height})) {
        invoke(ui.session, "query.select", std::to_string(index));
    }
    ui.mark("query.row." + std::to_string(index));
    if (ImGui::IsItemHovered()) {
        ui.session.hovered = {Selection::Kind::query, {}, static_cast<int>(index)};
        ImGui::SetTooltip("%s", sentence(query, answer.contact).c_str());
    }
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const float side = ui.px(11);
    const float line = ImGui::GetTextLineHeight();
    const ImVec2 cell{at.x + ui.px(2), at.y + 0.5f * (line - side) + ui.px(2)};
    outcome_cell(list, ui.style, cell, {cell.x + side, cell.y + side}, mark, 1);
    const float left = cell.x + side + ui.px(7);
    list.AddText({left, at.y + ui.px(2)}, ui.style.text, pair_that_fits(query, at.x + width - left).c_str());
    const std::string found = answer.contact ? "hit at " + with_unit(answer.contact->time, "s") : "never collide";
    list.AddText({left, at.y + ui.px(3) + line}, mark_text(ui.style, mark), found.c_str());
    ImGui::PopID();
}

}  // namespace

void query_list(Ui& ui) {
    const std::size_t count = ui.session.fitted().queries().size();
    heading(ui, "QUERIES", count > 0 ? std::to_string(count) : "");
    if (count == 0) {
        words(ui.style.quiet, ui.session.empty()
                                  ? "Open a scene to ask whether two agents collide."
                                  : "A query asks whether two agents ever collide. Add agents at the left (+ agent): "
                                    "every pair of them is asked by itself.");
        return;
    }
    words(ui.style.quiet, "Choose one to see why.");
    const float height = 2 * ImGui::GetTextLineHeight() + ui.px(6);
    const float spacing = ImGui::GetStyle().ItemSpacing.y;
    const int rows = static_cast<int>(count);
    const float room = (height + spacing) * static_cast<float>(std::min(rows, kMostQueryRows)) + spacing;
    ImGui::BeginChild("queries", {0, room});
    ImGuiListClipper clipper;
    clipper.Begin(rows, height + spacing);
    while (clipper.Step()) {
        for (int i = clipper.DisplayStart; i < clipper.DisplayEnd; ++i) {
            query_row(ui, static_cast<std::size_t>(i), height);
        }
    }
    ImGui::EndChild();
}

}  // namespace mobbscope::app
