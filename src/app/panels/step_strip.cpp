#include <app/commands/command.h>
#include <app/panels/query_parts.h>
#include <app/panels/recursion_picture.h>
#include <app/ui/memo.h>
#include <app/ui/swatch.h>
#include <explain/query_sentence.h>

#include <algorithm>
#include <array>
#include <string>
#include <utility>

namespace mobbscope::app {

namespace {

/// How much of the strip's height an event takes: what says more stands taller.
constexpr std::array<float, kEventMarks> kHeights{0.14f, 0.3f, 0.55f, 0.8f, 0.8f, 1.0f};

constexpr float kStripAhead = 0.4f;  // strength of what comes after the present step

void draw_cell(ImDrawList& list, const Style& style, const StripCell& cell, ImVec2 at, float height, float strength) {
    const float width = cell.x1 - cell.x0;
    const float gap = width >= 3 * style.scale ? style.scale : 0;
    // Taller ones behind: the top of each is seen, so a column shows all that is in it.
    for (std::size_t m = kEventMarks; m-- > 0;) {
        if (cell.marks[m] == 0) continue;
        const float top = at.y + height * (1 - kHeights[m]);
        list.AddRectFilled({at.x + cell.x0, top}, {at.x + cell.x1 - gap, at.y + height},
                           mark_color(style, static_cast<EventMark>(m), strength));
    }
}

std::string tooltip(const QueryFindings& findings, const mobb::Trace& trace, const StripCell& cell) {
    if (cell.end - cell.first == 1) return step_sentence(findings.sides, trace, cell.first);
    std::string out = "events " + std::to_string(cell.first) + " to " + std::to_string(cell.end - 1);
    for (std::size_t m = kEventMarks; m-- > 0;) {
        if (cell.marks[m] == 0) continue;
        out += "\n" + std::to_string(cell.marks[m]) + "  " + headline(static_cast<EventMark>(m));
    }
    return out;
}

}  // namespace

void step_strip(Ui& ui, float width, float height) {
    const std::shared_ptr<const QueryFindings> findings = ui.session.findings();
    const int columns = static_cast<int>(width);
    if (!findings || findings->recursion.pairs.empty() || columns < 1) return;
    const mobb::Trace& trace = ui.session.recorded()->trace;
    using Drawn = std::pair<std::shared_ptr<const QueryFindings>, int>;
    static Memo<Drawn, std::vector<StripCell>> memo;
    const std::vector<StripCell>& cells = memo.get({findings, columns}, [&] { return strip_cells(trace, columns); });

    const ImVec2 at = ImGui::GetCursorScreenPos();
    ImGui::InvisibleButton("strip", {width, height});
    ui.mark("query.strip");
    const int step = ui.session.step();
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddRectFilled(at, {at.x + width, at.y + height}, ui.style.raised);
    const float room = height - ui.px(4);  // the rest is for the marker
    for (const StripCell& cell : cells) {
        draw_cell(list, ui.style, cell, {at.x, at.y + ui.px(4)}, room, cell.first <= step ? 1 : kStripAhead);
    }
    const auto present =
        std::partition_point(cells.begin(), cells.end(), [&](const StripCell& c) { return c.end <= step; });
    const float x = at.x + 0.5f * (present->x0 + present->x1);
    const float r = ui.px(4);
    list.AddTriangleFilled({x - r, at.y}, {x + r, at.y}, {x, at.y + r}, ui.style.text);
    list.AddLine({x, at.y}, {x, at.y + height}, ui.style.text, ui.px(1.5f));

    const bool active = ImGui::IsItemActive();
    if (!active && !ImGui::IsItemHovered()) return;
    const float mouse = std::clamp(ImGui::GetIO().MousePos.x - at.x, 0.0f, width - 1);
    const auto under = std::min<std::size_t>(static_cast<std::size_t>(mouse / width * static_cast<float>(cells.size())),
                                             cells.size() - 1);
    const StripCell& cell = cells[under];
    ImGui::SetTooltip("%s", tooltip(*findings, trace, cell).c_str());
    if (active && (step < cell.first || step >= cell.end)) invoke(ui.session, "step.to", std::to_string(cell.first));
}

}  // namespace mobbscope::app
