#include <app/command.h>
#include <app/panels.h>
#include <app/panels/parts.h>
#include <app/panels/query_parts.h>
#include <import/text.h>
#include <render/paths.h>
#include <render/subject.h>

#include <algorithm>
#include <cstdio>

namespace mobbscope::app {

namespace {

void button(Ui& ui, const char* label, const char* id) {
    const Command* command = find_command(id);
    ImGui::BeginDisabled(!command || !command->enabled(ui.session));
    if (ImGui::Button(label)) invoke(ui.session, id);
    ImGui::EndDisabled();
    ui.mark(std::string("timeline.") + id);
    if (command && ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled)) {
        ImGui::SetTooltip("%s  %s", std::string(command->title).c_str(), std::string(command->shortcut).c_str());
    }
}

/// When each path is there, as a bar in its colour, with the time cursor over all of them; drag to scrub.
void time_bars(Ui& ui, float width, float height) {
    Session& session = ui.session;
    const mobb::Interval span = session.time_span();
    const double length = std::max(span.t1 - span.t0, 1e-12);
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    ImGui::InvisibleButton("##time", {width, height});
    ui.mark("timeline.time");
    const auto x_of = [&](double t) { return corner.x + width * static_cast<float>((t - span.t0) / length); };
    if (ImGui::IsItemActive()) {
        const double at = span.t0 + length * std::clamp<double>((ImGui::GetIO().MousePos.x - corner.x) / width, 0, 1);
        session.playing = false;
        session.look([&](ViewState& view) { view.time = at; });
    }
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    draw.AddRectFilled(corner, {corner.x + width, corner.y + height}, ui.look.window, ui.px(3));
    const std::vector<Subject> paths = subjects(session.fitted(), session.view());
    // Of a crowd the bars melt together; they still say when somebody is there.
    const float each = height / static_cast<float>(std::max<std::size_t>(paths.size(), 1));
    for (std::size_t i = 0; i < paths.size(); ++i) {
        const float y = corner.y + each * static_cast<float>(i);
        const float gap = std::min(ui.px(1.5f), 0.2f * each);
        draw.AddRectFilled({x_of(paths[i].begin()), y + gap}, {x_of(paths[i].end()), y + each - gap},
                           to_im(with_alpha(paths[i].color, 0.75f)), ui.px(2));
    }
    if (const auto time = session.view().time; time && *time >= span.t0 && *time <= span.t1) {
        const float x = x_of(*time);
        draw.AddLine({x, corner.y - ui.px(3)}, {x, corner.y + height + ui.px(3)}, ui.look.text, ui.px(2));
    }
    draw.AddRect(corner, {corner.x + width, corner.y + height}, ui.look.border, ui.px(3));
}

void time_row(Ui& ui) {
    Session& session = ui.session;
    const mobb::Interval span = session.time_span();
    button(ui, session.playing ? "Pause" : "Play", "time.play");
    ImGui::SameLine();
    char text[64];
    std::snprintf(text, sizeof text, "%7.3f s", session.view().time.value_or(span.t0));
    ImGui::AlignTextToFramePadding();
    ImGui::PushFont(ui.look.mono);
    ImGui::TextColored(ImGui::ColorConvertU32ToFloat4(session.view().time ? ui.look.text : ui.look.quiet), "%s",
                       session.view().time ? text : "   off   ");
    ImGui::PopFont();
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("The time cursor: who is where at this moment");
    ImGui::SameLine();
    const float clear = ImGui::GetFrameHeight();
    time_bars(ui, std::max(ui.px(60), ImGui::GetContentRegionAvail().x - clear - ui.px(8)), ImGui::GetFrameHeight());
    ImGui::SameLine();
    ImGui::BeginDisabled(!session.view().time);
    if (ImGui::Button("\u00D7", {clear, clear})) invoke(session, "time.clear");
    ImGui::EndDisabled();
    ui.mark("timeline.clear");
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("Hide the time cursor");
}

/// The second clock: where in the trace we stand.
void step_row(Ui& ui) {
    char text[48];
    std::snprintf(text, sizeof text, "step %d / %d", ui.session.step(), ui.session.recorded()->trace.size() - 1);
    ImGui::AlignTextToFramePadding();
    ImGui::PushFont(ui.look.mono);
    ImGui::TextUnformatted(text);
    ImGui::PopFont();
    ImGui::SameLine();
    step_strip(ui, ImGui::GetContentRegionAvail().x, ImGui::GetFrameHeight());
}

}  // namespace

void timeline(Ui& ui) {
    if (ui.session.empty()) return;
    ImGui::PushID("timeline");
    time_row(ui);
    if (ui.session.recorded()) {
        step_row(ui);
        const ImVec2 room = ImGui::GetContentRegionAvail();
        if (room.y > ui.px(24)) recursion_icicle(ui, room);
    }
    ImGui::PopID();
}

}  // namespace mobbscope::app
