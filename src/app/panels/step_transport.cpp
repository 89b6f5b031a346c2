#include <app/commands/command.h>
#include <app/panels/query_parts.h>
#include <app/ui/widgets.h>

#include <cstdio>

namespace mobbscope::app {

namespace {

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

void step_transport(Ui& ui) {
    const int last = ui.session.recorded()->trace.size() - 1;
    int step = ui.session.step();
    heading(ui, "STEPS");
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
    text_button(ui, "over", "step.over");
    text_button(ui, "out", "step.out");
    ImGui::PushStyleColor(ImGuiCol_Text, ui.style.quiet);
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted("next");
    ImGui::PopStyleColor();
    text_button(ui, "separated", "step.next_separated");
    text_button(ui, "overlap", "step.next_overlap");
    text_button(ui, "hit", "step.next_hit");
    ImGui::PopStyleVar(2);

    char format[48];
    std::snprintf(format, sizeof format, "step %%d / %d", last);
    ImGui::PushFont(ui.style.mono);
    // The number stays readable under the grab.
    ImGui::PushStyleColor(ImGuiCol_SliderGrab, to_im(with_alpha(ui.style.palette.accent, 0.45f)));
    ImGui::PushStyleColor(ImGuiCol_SliderGrabActive, to_im(with_alpha(ui.style.palette.accent, 0.6f)));
    ImGui::SetNextItemWidth(-1);
    if (ImGui::SliderInt("##step", &step, 0, last, format, ImGuiSliderFlags_AlwaysClamp)) {
        invoke(ui.session, "step.to", std::to_string(step));
    }
    ui.mark("query.step");
    ImGui::PopStyleColor(2);
    ImGui::PopFont();
}

}  // namespace mobbscope::app
