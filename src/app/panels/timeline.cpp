#include <app/commands/command.h>
#include <app/document/agents.h>
#include <app/panels/bottom_tabs.h>
#include <app/panels/panels.h>
#include <app/panels/query_parts.h>
#include <app/panels/ruler.h>
#include <app/ui/thing_menus.h>
#include <app/ui/widgets.h>
#include <base/text.h>
#include <explain/query_sentence.h>
#include <render/parts/paths.h>
#include <scene/crowd_run.h>
#include <scene/drawn_agent.h>
#include <scene/motion_graph.h>

#include <algorithm>
#include <cmath>
#include <span>

namespace mobbscope::app {

namespace {

constexpr float kLeastBars = 60;        // width, pixels at scale 1
constexpr float kMostBar = 26;          // height of a path's bar, pixels at scale 1
constexpr float kConflictBars = 14;     // height, pixels at scale 1
constexpr float kProofBar = 7;          // height of the lines of a proof, pixels at scale 1
constexpr float kSlabHandle = 6;        // of an end of the slab, to either side, pixels at scale 1
constexpr float kSlabHandleHeight = 7;  // ... upwards and downwards
constexpr float kNoEnd = -1e9f;         // no end of the slab is dragged
constexpr float kLeastSlab = 3;         // a shorter drag is a click, pixels at scale 1
constexpr float kLeastStrip = 60;       // of the strip of steps, which else has a line of its own
constexpr float kHalfLabel = 14;        // of the first label of a ruler, pixels at scale 1

/// An empty span has some length too.
ChartAxis time_axis(const mobb::Interval& span, float left, float width) {
    return {span.t0, span.t1 > span.t0 ? span.t1 : span.t0 + 1, left, left + width};
}

/// What the agent in question plays, move after move, and of everybody what was forced.
void play_bars(Ui& ui, ImVec2 corner, ImVec2 size, const ChartAxis& time) {
    const CrowdRun& crowd = *ui.workspace.crowd();
    const Palette& palette = ui.style.palette;
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    draw.PushClipRect(corner, {corner.x + size.x, corner.y + size.y}, true);
    const auto until_next = [&](const Play& play) {
        const GraphMove& move = ui.workspace.scene().graph->moves[static_cast<std::size_t>(play.move)];
        return ui.workspace.scene().clips[static_cast<std::size_t>(move.clip)].clip->until_next();
    };
    if (const auto run_agent = current_run_agent(ui.workspace)) {
        PlacedAgent who;
        const Rgba own = agent_color(ui.workspace.fitted().scene(), who, *run_agent);
        const float gap = ui.px(1);
        for (const Play& play : crowd.agents[static_cast<std::size_t>(*run_agent)].plays) {
            const float left = time.pixel(play.placement.start);
            const float right = time.pixel(play.placement.start + until_next(play));
            draw.AddRectFilled({left + 0.5f * gap, corner.y + ui.px(3)},
                               {std::max(right - 0.5f * gap, left + gap), corner.y + size.y - ui.px(3)},
                               to_im(with_alpha(own, play.kind == PlayKind::chosen ? 0.75f : 0.4f)), ui.px(1));
        }
    }
    for (const CrowdAgent& agent : crowd.agents) {
        for (const Play& play : agent.plays) {
            if (play.kind != PlayKind::forced) continue;
            const float x = time.pixel(play.placement.start);
            draw.AddLine({x, corner.y}, {x, corner.y + size.y}, to_im(palette.hit), ui.px(1.5f));
        }
    }
    draw.PopClipRect();
}

/// The pixel of the end of the slab that stays when a drag begins: the other one's where it begins at an end's handle,
/// else with Shift its own; none: the drag is not about the slab.
std::optional<float> fixed_end(const Ui& ui, const ChartAxis& axis, float x) {
    const bool shift = ImGui::GetIO().KeyShift;
    const float middle = 0.5f * (ImGui::GetItemRectMin().y + ImGui::GetItemRectMax().y);
    const bool at_handle = shift || std::abs(ImGui::GetIO().MousePos.y - middle) <= ui.px(kSlabHandleHeight);
    if (const auto& slab = ui.workspace.view().slab; slab && at_handle) {
        const float low = axis.pixel(slab->least), high = axis.pixel(slab->most);
        if (std::abs(x - high) <= ui.px(kSlabHandle)) return low;
        if (std::abs(x - low) <= ui.px(kSlabHandle)) return high;
    }
    return shift ? std::optional(x) : std::nullopt;
}

/// A drag over the bars with Shift, from one end of the slab to the other, or of an end's handle. A click with Shift
/// takes the slab away. True while it lasts.
bool slab_under_drag(Ui& ui, const ChartAxis& axis) {
    ImGuiStorage& storage = *ImGui::GetStateStorage();
    const ImGuiID key = ImGui::GetID("slab.fixed");
    const float x = std::clamp(ImGui::GetIO().MousePos.x, axis.first, axis.last);
    if (ImGui::IsItemActivated()) storage.SetFloat(key, fixed_end(ui, axis, x).value_or(kNoEnd));
    const float fixed = storage.GetFloat(key, kNoEnd);
    if (fixed == kNoEnd || !(ImGui::IsItemActive() || ImGui::IsItemDeactivated())) return false;
    const float moved = std::abs(ImGui::GetMouseDragDelta(ImGuiMouseButton_Left, 0).x);
    if (ImGui::IsItemActive() && moved >= ui.px(kLeastSlab)) {
        const double one = axis.value(x), other = axis.value(fixed);
        ui.later([range = ValueRange{std::min(one, other), std::max(one, other)}](Workspace& workspace) {
            workspace.change_view([&](ViewState& view) { view.slab = range; });
        });
        storage.SetBool(ImGui::GetID("slab.moved"), true);
    }
    if (ImGui::IsItemDeactivated()) {
        const bool click = !storage.GetBool(ImGui::GetID("slab.moved"));
        if (click && ImGui::GetIO().KeyShift && ui.workspace.view().slab) ui.invoke("view.no_slab");
        storage.SetBool(ImGui::GetID("slab.moved"), false);
        storage.SetFloat(key, kNoEnd);
    }
    return true;
}

/// What a slab cuts away is dimmed; its ends are handles.
void shade_slab(const Ui& ui, const ChartAxis& axis, const ValueRange& slab, float top, float height) {
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    const float low = std::clamp(axis.pixel(slab.least), axis.first, axis.last);
    const float high = std::clamp(axis.pixel(slab.most), axis.first, axis.last);
    const ImU32 veil = to_im(with_alpha(ui.style.palette.background, 0.72f));
    draw.AddRectFilled({axis.first, top}, {low, top + height}, veil);
    draw.AddRectFilled({high, top}, {axis.last, top + height}, veil);
    for (const float x : {low, high}) {
        draw.AddLine({x, top}, {x, top + height}, ui.style.text, ui.px(1));
        const ImVec2 middle{x, top + 0.5f * height};
        const float half = std::min(ui.px(kSlabHandleHeight), 0.4f * height);
        draw.AddRectFilled({x - ui.px(3), middle.y - half}, {x + ui.px(3), middle.y + half}, ui.style.text, ui.px(2));
    }
}

/// When each path is there, as a bar in its colour, with the time cursor over all of them; drag to scrub. A run has no
/// paths, but plays.
void time_bars(Ui& ui, std::span<const DrawnAgent> paths, float width, float height) {
    const mobb::Interval span = time_span(ui.workspace);
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    const ChartAxis axis = time_axis(span, corner.x, width);
    ImGui::InvisibleButton("##time", {width, height});
    ui.mark("timeline.time", OwnKeys::left_right);
    time_keys(ui, "timeline.time");
    const float cursor = axis.pixel(ui.workspace.view().time.value_or(0.5 * (axis.from + axis.to)));
    context_menu(
        ui,
        [&] {
            const float x = ImGui::GetMousePosOnOpeningCurrentPopup().x;
            return time_menu(ui.session, axis.value(std::clamp(x, corner.x, corner.x + width)));
        },
        ImVec2{std::clamp(cursor, corner.x, corner.x + width), corner.y + 0.5f * height});
    const bool drags_slab = slab_under_drag(ui, axis);
    if (ImGui::IsItemActive() && !drags_slab) {
        const double at = axis.value(std::clamp(ImGui::GetIO().MousePos.x, corner.x, corner.x + width));
        scrub_to(ui, at);
    }
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    draw.AddRectFilled(corner, {corner.x + width, corner.y + height}, ui.style.window, ui.px(3));
    if (ui.workspace.crowd()) play_bars(ui, corner, {width, height}, axis);
    // Of a crowd the bars melt together; they still say when somebody is there.
    const float each = height / static_cast<float>(std::max<std::size_t>(paths.size(), 1));
    const float gap = std::min(ui.px(1.5f), 0.2f * each);
    const NameList names(paths.size(), [&](std::size_t i) { return paths[i].name; });
    const float mouse = ImGui::IsItemHovered() ? (ImGui::GetIO().MousePos.y - corner.y) / each : -1;
    const std::optional<ValueRange>& slab = ui.workspace.view().slab;
    for (std::size_t i = 0; i < paths.size(); ++i) {
        const float y = corner.y + each * static_cast<float>(i);
        float left = axis.pixel(paths[i].begin());
        float right = axis.pixel(paths[i].end());
        draw.AddRectFilled({left, y + gap}, {right, y + each - gap}, to_im(with_alpha(paths[i].color, 0.75f)),
                           ui.px(2));
        // The name stands where the bar is not dimmed.
        if (slab) {
            left = std::max(left, axis.pixel(slab->least));
            right = std::min(right, axis.pixel(slab->most));
        }
        const float font = ImGui::GetFontSize();
        const bool has_room = each >= font + 2 * gap;
        const std::string name = has_room ? fitted_name(paths[i].name, right - left - ui.px(12), names) : "";
        if (mouse >= static_cast<float>(i) && mouse < static_cast<float>(i + 1)) tell_whole(ui, name, paths[i].name);
        if (!has_room) continue;
        const Rgba ink =
            contrast(paths[i].color, Rgba(0, 0, 0, 1)) > contrast(paths[i].color, Rgba(1)) ? Rgba(0, 0, 0, 1) : Rgba(1);
        draw.AddText({left + ui.px(6), y + 0.5f * (each - font)}, to_im(ink), name.c_str());
    }
    if (slab) shade_slab(ui, axis, *slab, corner.y, height);
    if (const auto time = ui.workspace.view().time; time && *time >= span.t0 && *time <= span.t1) {
        const float x = axis.pixel(*time);
        draw.AddLine({x, corner.y - ui.px(3)}, {x, corner.y + height + ui.px(3)}, ui.style.text, ui.px(2));
    }
    draw.AddRect(corner, {corner.x + width, corner.y + height}, ui.style.border, ui.px(3));
}

/// The first clock; returns where its bars have which time. `tall`: nothing stands below it but the tabs, at its left.
ChartAxis time_row(Ui& ui, Playback& playback, QueryInspector& queries, PathBars& bars, bool tall) {
    const mobb::Interval span = time_span(ui.workspace);
    ImGui::BeginGroup();
    command_button(ui, playback.playing() ? "Pause" : "Play", "time.play", "timeline.time.play");
    ImGui::SameLine();
    const auto time = ui.workspace.view().time;
    ImGui::AlignTextToFramePadding();
    text_line(time ? ui.style.text : ui.style.quiet, time ? formatted("%7.3f s", *time) : "   off   ", ui.style.mono);
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("The time cursor: who is where at this moment");
    if (tall) {
        bottom_tabs(ui);
        // The first label of the ruler begins before the bars do.
        ImGui::SameLine(0, ui.px(kHalfLabel));
        ImGui::Dummy({});
    }
    ImGui::EndGroup();
    const float clear = ImGui::GetFrameHeight();
    // Of a narrow window the bars have a line of their own.
    flow(ui.px(kLeastBars) + clear + ui.px(8));
    const float width = std::max(1.0f, ImGui::GetContentRegionAvail().x - clear - ui.px(8));
    const CrowdInspector& crowds = ui.session.crowds;
    const bool has_conflicts = tall && crowds.conflicts() && !crowds.conflicts()->empty();
    const float lane = has_conflicts ? ui.px(kConflictBars + 3) : 0;
    const float below = ui.px(24) + lane;
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    const ChartAxis axis = time_axis(span, corner.x, width);
    std::span<const DrawnAgent> paths;
    if (!ui.workspace.crowd()) paths = bars.of(ui.workspace);
    const auto lanes = static_cast<float>(ui.workspace.crowd() ? 1 : paths.size());
    const float most =
        std::clamp(lanes * ui.px(kMostBar), clear, std::max(clear, ImGui::GetContentRegionAvail().y - below));
    const float height = tall ? most : clear;
    time_bars(ui, paths, width, height);
    if (tall) ruler(ui, *ui.style.mono, axis, corner.y + height + lane, " s");
    ImGui::SameLine();
    ImGui::BeginDisabled(!ui.workspace.view().time || ui.workspace.crowd());
    if (ImGui::Button("\u00D7", {clear, clear})) ui.invoke("time.clear");
    ImGui::EndDisabled();
    ui.mark("timeline.clear");
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("Hide the time cursor");
    if (has_conflicts) {
        conflict_bars(ui, crowds, axis, {corner.x, corner.y + height + ui.px(3)}, {width, ui.px(kConflictBars)});
    }
    const auto findings = queries.findings();
    if (findings && !findings->proof.lines.empty())
        proof_bars(ui, *findings, axis, {corner.x, corner.y + height + ui.px(3)}, {width, ui.px(kProofBar)});
    return axis;
}

/// The second clock: where in the trace we stand.
void step_row(Ui& ui, QueryInspector& queries, QueryPictures& pictures) {
    ImGui::AlignTextToFramePadding();
    const mobb::Trace& trace = ui.workspace.recorded()->trace;
    const std::string step = step_of(ui.workspace.step(), trace);
    text_line(ui.style.text, step, ui.style.mono);
    // The strip begins where it begins at the last step, whose number is the longest.
    const float longest = text_size(*ui.style.mono, step_of(trace.size() - 1, trace)).x;
    ImGui::SameLine(0, 0);
    ImGui::Dummy({longest - text_size(*ui.style.mono, step).x, 0});
    if (trace.stopped()) {
        ImGui::SameLine(0, ui.px(8));
        text_line(ui.style.warning, recording_words(trace));
        ui.mark_only("timeline.stopped");
    }
    const float least = ui.px(kLeastStrip);
    flow(least);
    pictures.strip(ui, queries, std::max(least, ImGui::GetContentRegionAvail().x), ImGui::GetFrameHeight());
}

/// Beside the tabs the way to the present pair, and below them the recursion.
void recursion(Ui& ui, QueryInspector& queries, QueryPictures& pictures) {
    const std::shared_ptr<const QueryFindings> findings = queries.findings();
    if (findings->recursion.pairs.empty()) return;
    ImGui::SameLine(0, ui.px(18));
    way_to_pair(ui, *findings);
    const ImVec2 room = ImGui::GetContentRegionAvail();
    if (room.y > ui.px(24)) pictures.icicle(ui, queries, room);
}

/// A bar, a triangle or both, on the last button.
void draw_icon(Ui& ui, bool forward, bool to_end, bool enabled) {
    const ImVec2 min = ImGui::GetItemRectMin();
    const ImVec2 max = ImGui::GetItemRectMax();
    const ImVec2 middle{0.5f * (min.x + max.x), 0.5f * (min.y + max.y)};
    const float r = ui.px(4.5f);
    const float way = forward ? 1.0f : -1.0f;
    const ImU32 color = enabled ? ui.style.text : ui.style.border;
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const float shift = to_end ? -0.3f * r * way : 0;
    const ImVec2 tip{middle.x + shift + way * r, middle.y};
    const ImVec2 upper{middle.x + shift - way * 0.8f * r, middle.y - r};
    const ImVec2 lower{upper.x, middle.y + r};
    // Clockwise, as ImGui's smooth edges need it.
    if (forward) {
        list.AddTriangleFilled(upper, tip, lower, color);
    } else {
        list.AddTriangleFilled(tip, upper, lower, color);
    }
    if (to_end) {
        const float x = middle.x + shift + way * 1.3f * r;
        list.AddLine({x, middle.y - r}, {x, middle.y + r}, color, ui.px(1.8f));
    }
}

void icon_button(Ui& ui, const char* id, bool forward, bool to_end) {
    // A blank label of a fixed width, under an id of its own.
    query_button(ui, (std::string("    ##") + id).c_str(), id);
    const Command* command = find_command(id);
    draw_icon(ui, forward, to_end, command && command->enabled(ui.session));
}

void text_button(Ui& ui, const char* label, const char* id) {
    flow(button_width(label));
    query_button(ui, label, id);
}

}  // namespace

const std::vector<DrawnAgent>& PathBars::of(const Workspace& workspace) {
    const std::shared_ptr<const FittedScene> fitted = workspace.shown();
    const ViewState& view = workspace.view();
    if (of_ == fitted && query_ == view.query && hidden_ == view.hidden) return shown_;
    shown_ = drawn_agents(*fitted, view);
    std::erase_if(shown_, [](const DrawnAgent& agent) { return agent.hidden; });
    of_ = fitted;
    query_ = view.query;
    hidden_ = view.hidden;
    return shown_;
}

void timeline(Ui& ui, Playback& playback, QueryInspector& queries, QueryPictures& pictures) {
    if (ui.workspace.empty()) return;
    ImGui::PushID("timeline");
    const bool steps = ui.workspace.recorded() != nullptr;
    const BottomTab tab = shown_tab(ui);
    const bool tall = !steps && tab == BottomTab::recursion;
    const ChartAxis axis = time_row(ui, playback, queries, pictures.paths, tall);
    if (steps) step_row(ui, queries, pictures);
    if (!tall) bottom_tabs(ui);
    switch (tab) {
        case BottomTab::recursion:
            if (steps) recursion(ui, queries, pictures);
            break;
        case BottomTab::events:
            pictures.events.draw(ui, queries);
            break;
        case BottomTab::nodes:
            node_list(ui, pictures.nodes, pictures.levels, axis);
            break;
        case BottomTab::curves:
            pictures.curves.draw(ui, axis);
            break;
    }
    ImGui::PopID();
}

void step_transport(Ui& ui) {
    const int last = ui.workspace.recorded()->trace.size() - 1;
    if (!section(ui, "STEPS")) return;
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {ui.px(4), ui.px(4)});
    ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {ui.px(6), ui.px(4)});
    icon_button(ui, "step.first", false, true);
    const float icon = button_width("    ");
    flow(icon);
    icon_button(ui, "step.back", false, false);
    flow(icon);
    icon_button(ui, "step.forward", true, false);
    flow(icon);
    icon_button(ui, "step.last", true, true);
    text_button(ui, "into", "step.into");
    text_button(ui, "over", "step.over");
    text_button(ui, "out", "step.out");
    ImGui::AlignTextToFramePadding();
    text_line(ui.style.quiet, "next");
    text_button(ui, "separated", "step.next_separated");
    text_button(ui, "overlap", "step.next_overlap");
    text_button(ui, "avoidable", "step.next_avoidable");
    text_button(ui, "hit", "step.next_hit");
    text_button(ui, "leaf", "step.next_leaf");
    ImGui::PopStyleVar(2);

    recording_note(ui, "steps");
    ImGui::SetNextItemWidth(-1);
    const auto wanted = number_field(ui, {.mark = "query.step",
                                          .what = "The step",
                                          .now = static_cast<double>(ui.workspace.step()),
                                          .before = "step ",
                                          .unit = "of 0.." + std::to_string(last),
                                          .least = 0,
                                          .most = static_cast<double>(last)});
    if (wanted) ui.invoke("step.to", formatted("%.0f", *wanted));
}

}  // namespace mobbscope::app
