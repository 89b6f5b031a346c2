#include <app/commands/command.h>
#include <app/panels/query_parts.h>
#include <app/panels/recursion_picture.h>
#include <app/ui/memo.h>
#include <app/ui/swatch.h>
#include <explain/query_sentence.h>

#include <algorithm>
#include <string>
#include <utility>

namespace mobbscope::app {

namespace {

constexpr float kIcicleAhead = 0.35f;  // strength of what comes after the present step

/// Pairs that went on to others stay quiet: what they found stands below them.
void draw_inner(ImDrawList& list, const Style& style, ImVec2 min, ImVec2 max, bool hit, float strength) {
    list.AddRectFilled(min, max, style.raised);
    if (hit) list.AddRectFilled({min.x, max.y - 2 * style.scale}, max, mark_color(style, EventMark::hit, strength));
}

}  // namespace

void recursion_icicle(Ui& ui, ImVec2 size) {
    const std::shared_ptr<const QueryFindings> findings = ui.session.findings();
    const int width = static_cast<int>(size.x);
    if (!findings || findings->recursion.pairs.empty() || width < 1) return;
    const Recursion& recursion = findings->recursion;
    const int most = static_cast<int>(ui.px(20));
    const int row = std::clamp(static_cast<int>(size.y) / std::max(1, recursion.depth), 2, most);
    using Drawn = std::tuple<std::shared_ptr<const QueryFindings>, int, int>;
    static Memo<Drawn, std::vector<PairCell>> memo;
    const std::vector<PairCell>& cells =
        memo.get({findings, width, row}, [&] { return icicle_cells(recursion, width, row); });

    const ImVec2 at = ImGui::GetCursorScreenPos();
    ImGui::InvisibleButton("icicle", size);
    ui.mark("query.icicle");
    const bool hovered = ImGui::IsItemHovered();
    const bool clicked = ImGui::IsItemClicked();
    const int step = ui.session.step();
    const int present = recursion.pair_of[static_cast<std::size_t>(step)];
    const ImVec2 mouse = ImGui::GetIO().MousePos;
    const PairCell* under = nullptr;
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.PushClipRect(at, {at.x + size.x, at.y + size.y}, true);
    for (const PairCell& cell : cells) {
        const RecursionPair& pair = recursion.pairs[static_cast<std::size_t>(cell.pair)];
        const ImVec2 min{at.x + static_cast<float>(cell.x0), at.y + static_cast<float>(cell.y0)};
        const ImVec2 end{at.x + static_cast<float>(cell.x1), at.y + static_cast<float>(cell.y1)};
        const float gap = cell.x1 - cell.x0 > 3 && row > 4 ? 1.0f : 0.0f;
        const ImVec2 max{end.x - gap, end.y - gap};
        const float strength = pair.first <= step ? 1 : kIcicleAhead;
        if (pair.has_children()) {
            draw_inner(list, ui.style, min, max, pair.hit, strength);
        } else {
            outcome_cell(list, ui.style, min, max, mark_of(pair), strength);
        }
        if (pair.has_children() && cell.merged == 1) {
            const std::string name =
                node_name(findings->sides[0], pair.a) + "  " + node_name(findings->sides[1], pair.b);
            const ImVec2 text = ImGui::CalcTextSize(name.c_str());
            if (text.x + ui.px(8) < max.x - min.x && text.y <= max.y - min.y) {
                list.AddText({min.x + ui.px(4), 0.5f * (min.y + max.y - text.y)},
                             pair.first <= step ? ui.style.text : ui.style.quiet, name.c_str());
            }
        }
        if (cell.pair == present) list.AddRect(min, max, ui.style.text, 0, 0, ui.px(2));
        if (mouse.x >= min.x && mouse.x < end.x && mouse.y >= min.y && mouse.y < end.y) under = &cell;
    }
    list.PopClipRect();
    if (!hovered || !under) return;
    const RecursionPair& pair = recursion.pairs[static_cast<std::size_t>(under->pair)];
    const std::string more = under->merged > 1 ? "\nand " + std::to_string(under->merged - 1) + " more pairs here" : "";
    ImGui::SetTooltip("%s\n%d events here and below%s",
                      step_sentence(findings->sides, ui.session.recorded()->trace, pair.last).c_str(),
                      pair.end - pair.first, more.c_str());
    if (clicked) invoke(ui.session, "step.to", std::to_string(pair.first));
}

}  // namespace mobbscope::app
