#include <app/commands/command.h>
#include <app/document/edit_names.h>
#include <app/panels/panels.h>
#include <app/ui/widgets.h>
#include <base/text.h>
#include <scene/scene_edits.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>

namespace mobbscope::app {

namespace {

/// True when it has changed.
bool placement_number(Ui& ui, const char* label, double& value, NumberField field, const char* help) {
    form_label(ui, label, help);
    field.now = value;
    const std::optional<double> wanted = number_field(ui, field);
    value = wanted.value_or(value);
    return wanted.has_value();
}

void rename_agent(Ui& ui, int agent, const std::string& name) {
    form_label(ui, "Name", "What the agent is called in queries and pictures");
    const std::optional<std::string> text = text_edit(ui, "agent.name", name);
    if (!text) return;
    ui.later([agent, text = *text](Edits& edits) { edits.rename_agent(agent, text); });
}

void color_field(Ui& ui, const PlacedAgent& who, int index) {
    form_label(ui, "Colour", nullptr);
    const Rgba now = agent_color(ui.workspace.scene(), who, index);
    std::array<float, 3> rgb{now.r, now.g, now.b};
    const bool changed =
        ImGui::ColorEdit3("##agent.color", rgb.data(), ImGuiColorEditFlags_NoInputs | ImGuiColorEditFlags_NoLabel);
    ui.mark_only("agent.color");
    ImGui::PushID("##agent.color");
    ui.focus.add("agent.color", Ui::last_rect(), ImGui::GetID("##ColorButton"), OwnKeys::none, "");
    ImGui::PopID();
    if (!changed) return;
    const auto byte = [](float c) { return static_cast<std::uint8_t>(std::lround(255 * c)); };
    const Color wanted{byte(rgb[0]), byte(rgb[1]), byte(rgb[2])};
    ui.later([who, wanted](Workspace& workspace) {
        workspace.edit({"colouring " + who.name + ": " + to_string(wanted), "color"},
                       [&](Scene& scene) { scene.agents.at(static_cast<std::size_t>(who.agent)).color = wanted; });
    });
}

/// The selected one, also by a node or a sample; none in a run, whose agents stand where they were simulated.
std::optional<PlacedAgent> agent_to_place(const Workspace& workspace) {
    if (workspace.crowd() || !workspace.selection.on_path()) return std::nullopt;
    const auto who = placed_agent_of(workspace.fitted(), workspace.selection.path);
    return who && who->agent >= 0 ? who : std::nullopt;
}

}  // namespace

float placement_height(const Ui& ui, Settings& settings) {
    if (!agent_to_place(ui.workspace)) return 0;
    const float spacing = ui.px(5);
    const float around = 2 * ImGui::GetStyle().WindowPadding.y + ui.px(6) + spacing + ui.style.caption->FontSize;
    if (is_folded(settings, "placement")) return around;
    const float fields = 6 * (ImGui::GetFrameHeight() + spacing);
    return around + spacing + fields + ImGui::GetTextLineHeight();
}

void placement_panel(Ui& ui) {
    const ImVec2 corner = ImGui::GetWindowPos();
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    const ImVec2 end{corner.x + ImGui::GetWindowWidth(), corner.y + ui.px(1)};
    draw.PushClipRect(corner, end);
    draw.AddRectFilled(corner, end, ui.style.border);
    draw.PopClipRect();
    // A list above may have selected something else in this frame.
    const auto who = agent_to_place(ui.workspace);
    if (!who || !section(ui, "PLACEMENT", cleaned(who->name))) return;
    // Of this agent: what is half typed into a field is no other's.
    ImGui::PushID(who->agent);
    rename_agent(ui, who->agent, who->name);
    mobb::Placement placement = who->placement;
    const auto metres = [](const char* mark, const char* what) {
        return NumberField{.mark = mark,
                           .what = what,
                           .unit = "m",
                           .decimals = 3,
                           .step = 0.1,
                           .least = -mobb::kMaxLength,
                           .most = mobb::kMaxLength};
    };
    bool changed =
        placement_number(ui, "x", placement.translate.x, metres("agent.x", "x"), "Where the clip's origin goes");
    changed |= placement_number(ui, "y", placement.translate.y, metres("agent.y", "y"), "Where the clip's origin goes");
    double degrees = placement.rotate_deg;
    changed |= placement_number(ui, "turned", degrees,
                                {.mark = "agent.turn",
                                 .what = "The angle",
                                 .unit = "\u00B0",
                                 .decimals = 2,
                                 .step = 2.5,
                                 .least = -1e9,
                                 .most = 1e9},
                                "About the clip's origin, counter-clockwise");
    placement.rotate_deg = degrees;
    changed |= placement_number(ui, "starts at", placement.start,
                                {.mark = "agent.start",
                                 .what = "The start",
                                 .unit = "s",
                                 .decimals = 3,
                                 .step = 0.1,
                                 .least = -mobb::kMaxTime,
                                 .most = mobb::kMaxTime},
                                "Global time at which the clip begins");
    color_field(ui, *who, ui.workspace.selection.path.agent);
    if (changed) {
        ui.later([who = *who, placement](Workspace& workspace) {
            workspace.edit(name_of_placing(who.name, who.placement, placement),
                           [&](Scene& scene) { place_agent(scene, who.agent, placement); });
        });
    }
    if (small_button(ui, "Duplicate", "agent.duplicate")) ui.invoke("agent.duplicate");
    ImGui::SameLine();
    if (small_button(ui, "Remove", "agent.remove")) ui.invoke("agent.remove");
    ImGui::PopID();
}

}  // namespace mobbscope::app
