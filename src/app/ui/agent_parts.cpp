#include <app/commands/command.h>
#include <app/ui/agent_parts.h>

#include <array>
#include <string>

namespace mobbscope::app {

namespace {

constexpr float kButton = 18;  // pixels at scale 1

// Each is drawn around a middle, about 12 pixels wide at scale 1.

void draw_eye(ImDrawList& draw, ImVec2 at, float px, ImU32 color, bool open) {
    const ImVec2 left{at.x - 6 * px, at.y};
    const ImVec2 right{at.x + 6 * px, at.y};
    draw.AddBezierQuadratic(left, {at.x, at.y - 8 * px}, right, color, 1.3f * px);
    draw.AddBezierQuadratic(left, {at.x, at.y + 8 * px}, right, color, 1.3f * px);
    if (open) {
        draw.AddCircleFilled(at, 2 * px, color);
    } else {
        draw.AddLine({at.x - 5 * px, at.y + 5 * px}, {at.x + 5 * px, at.y - 5 * px}, color, 1.3f * px);
    }
}

/// Corners around a dot: it alone.
void draw_alone(ImDrawList& draw, ImVec2 at, float px, ImU32 color) {
    const float side = 5 * px;
    const float arm = 2.5f * px;
    for (const auto [x, y] : {std::array{-1.0f, -1.0f}, {1.0f, -1.0f}, {1.0f, 1.0f}, {-1.0f, 1.0f}}) {
        const ImVec2 corner{at.x + x * side, at.y + y * side};
        draw.AddLine(corner, {corner.x - x * arm, corner.y}, color, 1.3f * px);
        draw.AddLine(corner, {corner.x, corner.y - y * arm}, color, 1.3f * px);
    }
    draw.AddCircleFilled(at, 2 * px, color);
}

void draw_pin(ImDrawList& draw, ImVec2 at, float px, ImU32 color, bool on) {
    const ImVec2 head{at.x, at.y - 2.5f * px};
    if (on) {
        draw.AddCircleFilled(head, 3.5f * px, color);
    } else {
        draw.AddCircle(head, 3 * px, color, 0, 1.3f * px);
    }
    draw.AddLine({at.x, head.y + 3 * px}, {at.x, at.y + 6 * px}, color, 1.3f * px);
}

/// A button of a command about agents by name; returns the middle of its place, and the colour for what is drawn there.
struct ButtonPlace {
    ImVec2 middle;
    ImU32 color;
};
ButtonPlace agent_button(Ui& ui, const std::string& mark, const char* id, const std::string& argument,
                         const std::string& title, bool on) {
    ImGui::SameLine(0, 0);
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    const ImVec2 size{ui.px(kButton), ImGui::GetFrameHeight()};
    ImGui::PushID(mark.c_str());
    if (ImGui::InvisibleButton("##icon", size)) ui.invoke(id, argument);
    ImGui::PopID();
    ui.mark(mark);
    const bool hovered = ImGui::IsItemHovered();
    if (hovered) ImGui::SetTooltip("%s", title.c_str());
    return {{corner.x + 0.5f * size.x, corner.y + 0.5f * size.y},
            hovered ? ui.style.text
            : on    ? ui.style.accent
                    : ui.style.quiet};
}

}  // namespace

float agent_buttons_width(const Ui& ui) { return 3 * ui.px(kButton); }

float shown_buttons_width(const Ui& ui, const ListedAgents& listed) {
    if (are_isolated(ui.workspace, listed.who)) return agent_buttons_width(ui);
    return (are_pinned(ui.workspace, listed.who) ? 2 : 1) * ui.px(kButton);
}

void agent_buttons(Ui& ui, const std::string& mark, const ListedAgents& listed, bool lit) {
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    const bool alone = are_isolated(ui.workspace, listed.who);
    const ButtonPlace of_alone = agent_button(ui, mark + ".solo", "agents.solo", listed.text,
                                              alone ? "Show what was shown before" : "Show alone", alone);
    if (lit || alone) draw_alone(draw, of_alone.middle, ui.px(1), of_alone.color);
    const bool pinned = are_pinned(ui.workspace, listed.who);
    const ButtonPlace of_pin =
        agent_button(ui, mark + ".pin", "agents.pin", listed.text,
                     pinned ? "Unpin" : "Pin: stays when another is shown alone, and keeps its colour", pinned);
    if (lit || pinned) draw_pin(draw, of_pin.middle, ui.px(1), of_pin.color, pinned);
    const bool hidden = are_hidden(ui.workspace, listed.who);
    const ButtonPlace of_eye =
        agent_button(ui, mark + ".eye", "agents.hide", listed.text, hidden ? "Show" : "Hide", false);
    draw_eye(draw, of_eye.middle, ui.px(1), of_eye.color, !hidden);
}

}  // namespace mobbscope::app
