#include <app/panels/panels.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <string_view>
#include <utility>

namespace mobbscope::app {

namespace {

constexpr float kSplitter = 5;      // pixels at scale 1, to take hold of
constexpr float kLeastPanel = 180;  // a panel narrower than this shows nothing
constexpr float kLeastView = 240;

/// An invisible bar between two panels; returns how far it was dragged in pixels.
float splitter(Ui& ui, const char* name, ImVec2 size, bool upright) {
    ImGui::InvisibleButton(name, size);
    ui.mark_only(name);
    const bool active = ImGui::IsItemActive();
    if (active || ImGui::IsItemHovered()) {
        ImGui::SetMouseCursor(upright ? ImGuiMouseCursor_ResizeEW : ImGuiMouseCursor_ResizeNS);
        ImGui::GetWindowDrawList()->AddRectFilled(ImGui::GetItemRectMin(), ImGui::GetItemRectMax(), ui.style.accent);
    }
    const ImVec2 moved = ImGui::GetIO().MouseDelta;
    return active ? (upright ? moved.x : moved.y) : 0;
}

/// A newly opened scene's begins at its top; an excerpt has panels of its own, so that those of the whole stay where
/// they were scrolled to.
template <class Draw>
void panel(Ui& ui, std::string_view called, ImVec2 size, const Draw& draw) {
    const std::string name(called);
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {ui.px(8), ui.px(5)});
    ImGui::BeginChild((ui.workspace.in_excerpt() ? name + " of excerpt" : name).c_str(), size, false,
                      ImGuiWindowFlags_AlwaysUseWindowPadding);
    int& shown = *ImGui::GetStateStorage()->GetIntRef(ImGui::GetID("opening"));
    if (std::exchange(shown, ui.workspace.document().opening) != ui.workspace.document().opening) ImGui::SetScrollY(0);
    ui.focus.panel(name);
    draw();
    ImGui::EndChild();
    ImGui::PopStyleVar();
}

/// Side by side, equally wide, with a line between them.
void draw_views(Ui& ui, std::vector<Viewport>& viewports) {
    if (viewports.size() == 1) return viewports.front().draw(ui, 0);
    const ImVec2 corner = ImGui::GetCursorPos();
    const ImVec2 room = ImGui::GetContentRegionAvail();
    const float line = std::max(1.0f, std::floor(ui.px(1)));
    const float count = static_cast<float>(viewports.size());
    const float width = std::floor((room.x - line * (count - 1)) / count);
    for (std::size_t place = 0; place < viewports.size(); ++place) {
        ImGui::SetCursorPos({corner.x + static_cast<float>(place) * (width + line), corner.y});
        ImGui::BeginChild(("view " + std::to_string(place)).c_str(), {width, room.y}, false,
                          ImGuiWindowFlags_NoBackground);
        viewports[place].draw(ui, place);
        ImGui::EndChild();
    }
}

}  // namespace

void window_layout(Ui& ui, std::vector<Viewport>& viewports, QueryPictures& pictures) {
    const ImGuiIO& io = ImGui::GetIO();
    ui.focus.panel("menu");
    menu_bar(ui);
    const float top = ImGui::GetFrameHeight();
    ImGui::SetNextWindowPos({0, top});
    ImGui::SetNextWindowSize({io.DisplaySize.x, io.DisplaySize.y - top});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0, 0});
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {0, 0});
    ImGui::Begin("##window", nullptr,
                 // The shell has cleared to its colour: to fill it again is half the cost of a frame in software.
                 ImGuiWindowFlags_NoBackground | ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                     ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoBringToFrontOnFocus |
                     ImGuiWindowFlags_NoScrollWithMouse);
    ImGui::PopStyleVar(2);

    Settings& settings = ui.session.settings;
    const float bar = ui.px(kSplitter);
    const float status = status_height(ui);
    const ImVec2 room{ImGui::GetContentRegionAvail().x, ImGui::GetContentRegionAvail().y - status};
    // Each side gives way before the picture does.
    const float least = std::min(ui.px(kLeastPanel), 0.3f * room.x);
    const float most = std::max(least, (room.x - ui.px(kLeastView) - 2 * bar) / 2);
    const auto width = [&](double wanted) { return std::clamp(ui.px(static_cast<float>(wanted)), least, most); };
    const float left = width(settings.left_width);
    const float right = width(settings.right_width);
    const float highest = 0.6f * room.y;
    const float bottom =
        std::clamp(ui.px(static_cast<float>(settings.bottom_height)), std::min(ui.px(90), highest), highest);
    const auto spacing = [] { ImGui::SameLine(0, 0); };
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {0, 0});

    Screen* screen = ui.session.screen;
    const auto panels = screen ? screen->panels() : std::array<ScreenPanel, 3>();
    // The placement stands below the lists: they stay where they are when somebody is selected.
    const float placement = screen ? 0 : std::min(placement_height(ui, ui.session.settings), 0.5f * room.y);
    ImGui::BeginGroup();
    panel(ui, screen ? panels[0].name : "left", {left, room.y - placement}, [&] {
        if (screen) return panels[0].draw(ui);
        for (const auto& each : ui.session.screens) each->draw_above_scene(ui);
        scene_panel(ui, ui.session.queries);
        tree_panel(ui, ui.session.jobs, ui.session.queries);
    });
    if (placement > 0) panel(ui, "placement", {left, placement}, [&] { placement_panel(ui); });
    ImGui::EndGroup();
    spacing();
    settings.left_width += splitter(ui, "splitter.left", {bar, room.y}, true) / ui.style.scale;
    spacing();
    ImGui::BeginGroup();
    const float middle = room.x - left - right - 2 * bar;
    if (screen) {
        panel(ui, panels[1].name, {middle, room.y}, [&] { panels[1].draw(ui); });
    } else {
        // Up to its borders.
        ImGui::BeginChild("viewport", {middle, room.y - bottom - bar}, false, ImGuiWindowFlags_NoBackground);
        ui.focus.panel("view");
        viewport_toolbar(ui);
        draw_views(ui, viewports);
        ImGui::EndChild();
        settings.bottom_height -= splitter(ui, "splitter.bottom", {middle, bar}, false) / ui.style.scale;
        panel(ui, "timeline", {middle, bottom},
              [&] { timeline(ui, ui.session.playback, ui.session.queries, pictures); });
    }
    ImGui::EndGroup();
    spacing();
    settings.right_width -= splitter(ui, "splitter.right", {bar, room.y}, true) / ui.style.scale;
    spacing();
    panel(ui, screen ? panels[2].name : "right", {right, room.y}, [&] {
        if (screen) return panels[2].draw(ui);
        if (is_crowd(ui.workspace) && !ui.workspace.view().query) {
            crowd_panel(ui, ui.session.crowds);
        } else {
            query_panel(ui, ui.session.queries, pictures);
        }
        selection_panel(ui);
    });
    ui.workspace.hovered = ui.hovered;
    status_bar(ui, ui.session.queries, {io.DisplaySize.x, status});
    ImGui::PopStyleVar();
    ImGui::End();

    settings.left_width = std::clamp(settings.left_width, 180.0, 900.0);
    settings.right_width = std::clamp(settings.right_width, 180.0, 900.0);
    settings.bottom_height = std::clamp(settings.bottom_height, 90.0, 900.0);

    ui.focus.panel("dialog");
    dialogs(ui);
    ui.focus.panel("messages");
    messages(ui, ui.session.notifications, ui.session.dialogs);
}

}  // namespace mobbscope::app
