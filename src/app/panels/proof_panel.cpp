#include <app/panels/query_parts.h>
#include <app/ui/swatch.h>
#include <app/ui/widgets.h>
#include <base/text.h>
#include <explain/query_sentence.h>
#include <render/query/proof_walls.h>

#include <algorithm>
#include <string>
#include <utility>

namespace mobbscope::app {

namespace {

constexpr int kMostRows = 8;    // before the list scrolls
constexpr float kSign = 7;      // radius of the sign of how a line lies, pixels at scale 1
constexpr float kLeastBar = 3;  // width of a bar of the timeline, pixels at scale 1

std::string from_to(double t0, double t1) { return formatted("%.2f to %.2f s", t0, t1); }

/// How the line lies, as a map has it: x to the right, y upwards. One that moves has its direction too.
void line_sign(Ui& ui, const Tile& tile, ImVec2 middle) {
    const float r = ui.px(kSign);
    const ImU32 color = mark_color(ui.style, EventMark::separated);
    const ImVec2 u{static_cast<float>(tile.direction.x), -static_cast<float>(tile.direction.y)};
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddCircle(middle, r, ui.style.border, 0, ui.px(1));
    list.AddLine({middle.x - r * u.y, middle.y + r * u.x}, {middle.x + r * u.y, middle.y - r * u.x}, color,
                 ui.px(1.8f));
    if (tile.speed == 0) return;
    const float way = tile.speed > 0 ? 0.75f * r : -0.75f * r;
    list.AddLine(middle, {middle.x + way * u.x, middle.y + way * u.y}, color, ui.px(1.2f));
}

void line_row(Ui& ui, const QueryFindings& findings, std::size_t index) {
    const QueryProof& proof = findings.proof;
    const ProofLine& line = proof.lines[index];
    const bool tightest = index == proof.tightest;
    Row row;
    row.mark = "proof.line." + std::to_string(index);
    row.name = from_to(line.t0, line.t1);
    row.remark = gap_words(line.gap);
    row.selected = selected_line(ui.workspace, proof) == index;
    row.indent = ui.px(2 * kSign + 6);
    row.exact = {line.gap};
    if (tightest) row.remark_color = mark_text(ui.style, EventMark::separated);
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    if (app::row(ui, row)) ui.invoke("proof.line", std::to_string(index));
    if (ImGui::IsItemHovered()) {
        ImGui::SetTooltip("%s%s\nClick to go where the two are nearest",
                          tile_words(findings.sides, proof, index).c_str(), tightest ? ": the tightest" : "");
    }
    line_sign(ui, line, {corner.x + ui.px(6 + kSign), corner.y + 0.5f * ImGui::GetFrameHeight()});
}

void end_row(Ui& ui, const QueryFindings& findings, std::size_t index) {
    const TraversalEnd& end = findings.proof.ends[index];
    const mobb::Trace& trace = ui.workspace.recorded()->trace;
    const mobb::Trace::Event event = trace[end.step];
    Row row;
    row.mark = "proof.end." + std::to_string(index);
    row.name = from_to(end.t0, end.t1);
    row.remark = end.is_boxes ? with_unit(event.gap, "m") : "samples";
    row.selected = ui.workspace.step() == end.step;
    if (end.is_boxes) row.exact = {event.gap};
    if (app::row(ui, row)) ui.invoke("step.to", std::to_string(end.step));
    if (ImGui::IsItemHovered())
        ImGui::SetTooltip("%s\nClick to go there", step_sentence(findings.sides, trace, end.step).c_str());
}

}  // namespace

std::optional<std::size_t> selected_line(const Workspace& workspace, const QueryProof& proof) {
    const auto& time = workspace.view().time;
    return time ? proof.at(*time) : std::nullopt;
}

std::vector<LineRun> line_runs(const QueryProof& proof, const ChartAxis& time, std::optional<std::size_t> selected) {
    std::vector<LineRun> out;
    for (std::size_t i = 0; i < proof.lines.size(); ++i) {
        const bool joins = !out.empty() && i != selected && out.back().last != selected &&
                           time.pixel(proof.lines[i].t1) - time.pixel(proof.lines[out.back().first].t0) < 1;
        if (joins) {
            out.back().last = i;
        } else {
            out.push_back({i, i});
        }
    }
    return out;
}

void proof_section(Ui& ui, const QueryFindings& findings) {
    const QueryProof& proof = findings.proof;
    const auto count = static_cast<std::int64_t>(proof.lines.size());
    if (count == 0 || !section(ui, "THE PROOF", counted(count, "line", "lines"))) return;
    rows(ui, "proof", static_cast<int>(count), kMostRows,
         static_cast<int>(selected_line(ui.workspace, proof).value_or(0)),
         [&](int i) { line_row(ui, findings, static_cast<std::size_t>(i)); });
    if (proof.lines.size() > kMostWalls)
        words(ui.style.quiet, "The " + std::to_string(kMostWalls) + " tightest are drawn.");
    const ViewState& view = ui.workspace.view();
    query_button(ui, view.proof ? "hide walls" : "show walls", "view.proof");
    flow(button_width("show region"));
    query_button(ui, view.free_region ? "hide region" : "show region", "view.free_region");
    flow(button_width("Save..."));
    query_button(ui, "Save...", "proof.save");
    if (proof.ends.empty()) return;
    const std::string label = "as the trees found it: " + counted(std::ssize(proof.ends), "part", "parts") + "###ends";
    const bool open = ImGui::TreeNodeEx(label.c_str(), ImGuiTreeNodeFlags_NoTreePushOnOpen);
    ui.mark("proof.ends");
    if (!open) return;
    rows(ui, "ends", static_cast<int>(proof.ends.size()), kMostRows,
         present_row(proof.ends, [&](const TraversalEnd& end) { return end.step == ui.workspace.step(); }),
         [&](int i) { end_row(ui, findings, static_cast<std::size_t>(i)); });
}

void proof_bars(Ui& ui, const QueryFindings& findings, const ChartAxis& time, ImVec2 corner, ImVec2 size) {
    const QueryProof& proof = findings.proof;
    ImGui::SetCursorScreenPos(corner);
    ImGui::InvisibleButton("##proof", size);
    ui.mark_only("timeline.proof");
    const bool hovered = ImGui::IsItemHovered(), clicked = ImGui::IsItemClicked();
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddRectFilled(corner, {corner.x + size.x, corner.y + size.y}, ui.style.window, ui.px(2));
    const auto selected = selected_line(ui.workspace, proof);
    const float mouse = ImGui::GetIO().MousePos.x;
    for (const LineRun& run : line_runs(proof, time, selected)) {
        const float left = time.pixel(proof.lines[run.first].t0);
        const float right = std::max(time.pixel(proof.lines[run.last].t1) - ui.px(1.5f), left + ui.px(kLeastBar));
        list.AddRectFilled({left, corner.y}, {right, corner.y + size.y},
                           mark_color(ui.style, EventMark::separated, run.first == selected ? 1 : 0.5f), ui.px(1));
        if (!hovered || mouse < left || mouse >= right) continue;
        ImGui::SetTooltip("%s", tile_words(findings.sides, proof, run.first).c_str());
        if (clicked) ui.invoke("proof.line", std::to_string(run.first));
    }
}

}  // namespace mobbscope::app
