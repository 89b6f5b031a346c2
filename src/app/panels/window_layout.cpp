#include <app/panels/bottom_tabs.h>
#include <app/panels/panels.h>
#include <app/ui/widgets.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <string>
#include <string_view>
#include <utility>

namespace mobbscope::app {

namespace {

constexpr float kSplitter = 5;      // pixels at scale 1, to take hold of
constexpr float kLeastPanel = 180;  // a panel narrower than this shows nothing
constexpr float kFoldBar = 20;      // ... of the edge that unfolds one
// The picture keeps half of a window's width; of a large one the panels may have all but this.
constexpr float kEnoughView = 560;
constexpr float kEnoughHeight = 300;

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

/// The panels at the two sides of the picture, which give way before it does.
struct Sides {
    float left = 0, right = 0;  ///< widths in pixels; 0: folded
    float least = 0, most = 0;  ///< that one may have; both have `most` and `least` together
    bool fold = false;          ///< there is room for one at most: bars at both edges unfold them
};

enum class Unfolded { unknown, none, left, right };

/// `unfolded`: which one, where there is no room for both.
Sides sides_of(const Ui& ui, float room, Unfolded unfolded) {
    const float least = ui.px(kLeastPanel);
    const float left = std::max(ui.px(static_cast<float>(ui.session.settings.left_width)), least);
    const float right = std::max(ui.px(static_cast<float>(ui.session.settings.right_width)), least);
    const float most = std::max(0.5f * room, room - ui.px(kEnoughView)) - 2 * ui.px(kSplitter);
    if (most >= 2 * least) {
        const float over = left + right - 2 * least;
        const float share = over > 0 ? std::min(1.0f, (most - 2 * least) / over) : 1;
        return {std::floor(least + share * (left - least)), std::floor(least + share * (right - least)), least,
                most - least, false};
    }
    const float one = 0.5f * room - 2 * ui.px(kFoldBar) - ui.px(kSplitter);
    return {unfolded == Unfolded::left ? std::floor(std::min(left, one)) : 0,
            unfolded == Unfolded::right ? std::floor(std::min(right, one)) : 0, std::min(least, one), one, true};
}

/// Gives one the width that it was dragged to; the other one takes what is left.
void drag_side(const Ui& ui, const Sides& sides, float width, double& dragged, double& other) {
    const float within = std::clamp(width, sides.least, sides.most);
    dragged = within / ui.style.scale;
    if (!sides.fold) other = std::min<double>(other, (sides.most + sides.least - within) / ui.style.scale);
}

/// Upwards, as letters stand on the back of a book. It is drawn in the middle of the window first: what is out of it
/// would be left out.
void text_upwards(ImDrawList& list, const ImFont& font, ImVec2 middle, ImU32 color, const std::string& text) {
    const ImVec2 screen = ImGui::GetIO().DisplaySize;
    const ImVec2 pivot{std::floor(0.5f * screen.x), std::floor(0.5f * screen.y)};
    const ImVec2 size = text_size(font, text);
    const int first = list.VtxBuffer.Size;
    draw_text(list, font, {pivot.x - std::floor(0.5f * size.x), pivot.y - std::floor(0.5f * size.y)}, color, text);
    for (int i = first; i < list.VtxBuffer.Size; ++i) {
        ImVec2& at = list.VtxBuffer[i].pos;
        at = {middle.x + (at.y - pivot.y), middle.y - (at.x - pivot.x)};
    }
}

/// The edge of a window that has no room for both panels: returns whether the one there is to be unfolded, or folded.
bool fold_bar(Ui& ui, const std::string& mark, const std::string& title, float height, bool at_left, bool open) {
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const ImVec2 size{ui.px(kFoldBar), height};
    const bool pressed = ImGui::InvisibleButton(mark.c_str(), size);
    ui.mark(mark);
    const bool hovered = ImGui::IsItemHovered();
    if (hovered) ImGui::SetTooltip(open ? "Fold this panel, for a larger picture" : "Unfold this panel");
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    draw.AddRectFilled(at, {at.x + size.x, at.y + size.y}, hovered ? ui.style.raised : ui.style.panel);
    const ImU32 color = hovered ? ui.style.text : ui.style.quiet;
    const float x = at.x + 0.5f * size.x;
    const float r = ui.px(3.5f);
    const float way = at_left == open ? -r : r;
    const float y = at.y + ui.px(14);
    draw.AddLine({x - 0.5f * way, y - r}, {x + 0.5f * way, y}, color, ui.px(1.3f));
    draw.AddLine({x + 0.5f * way, y}, {x - 0.5f * way, y + r}, color, ui.px(1.3f));
    text_upwards(draw, *ui.style.caption, {x, y + ui.px(12) + 0.5f * text_size(*ui.style.caption, title).x}, color,
                 title);
    return pressed;
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
    int& unfolded = *ImGui::GetStateStorage()->GetIntRef(ImGui::GetID("unfolded"));
    if (unfolded == static_cast<int>(Unfolded::unknown)) {
        unfolded = static_cast<int>(ui.workspace.view().query ? Unfolded::right : Unfolded::left);
    }
    const Sides sides = sides_of(ui, room.x, static_cast<Unfolded>(unfolded));
    const float left = sides.left;
    const float right = sides.right;
    const bool fold = sides.fold;
    const float highest = std::min(0.6f * room.y, std::max(0.4f * room.y, room.y - ui.px(kEnoughHeight)));
    double& bottom_height = is_high(shown_tab(ui)) ? settings.events_height : settings.bottom_height;
    const float bottom = std::clamp(ui.px(static_cast<float>(bottom_height)), std::min(ui.px(90), highest), highest);
    const auto spacing = [] { ImGui::SameLine(0, 0); };
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {0, 0});

    Screen* screen = ui.session.screen;
    const auto panels = screen ? screen->panels() : std::array<ScreenPanel, 3>();
    // The placement stands below the lists: they stay where they are when somebody is selected.
    const float placement = screen ? 0 : std::min(placement_height(ui, ui.session.settings), 0.5f * room.y);
    const auto fold_side = [&](Unfolded side, const std::string& mark, std::string title) {
        ui.focus.panel(mark);
        std::ranges::transform(title, title.begin(), [](char c) { return static_cast<char>(std::toupper(c)); });
        const bool open = unfolded == static_cast<int>(side);
        if (fold_bar(ui, mark, title, room.y, side == Unfolded::left, open)) {
            unfolded = static_cast<int>(open ? Unfolded::none : side);
            ui.want_frame_in(0);
        }
    };
    if (fold) {
        fold_side(Unfolded::left, "fold.left", screen ? std::string(panels[0].name) : "scene");
        spacing();
    }
    if (left > 0) {
        ImGui::BeginGroup();
        panel(ui, screen ? panels[0].name : "left", {left, room.y - placement}, [&] {
            if (screen) return panels[0].draw(ui);
            for (const auto& each : ui.session.screens) each->draw_above_scene(ui);
            scene_panel(ui, ui.session.queries);
            pictures.views.section(ui);
            tree_panel(ui, ui.session.jobs, ui.session.queries, ui.session.fit_costs, ui.session.notices,
                       pictures.box_figures);
            sweep_panel(ui, ui.session.sweeps);
        });
        if (placement > 0) panel(ui, "placement", {left, placement}, [&] { placement_panel(ui); });
        ImGui::EndGroup();
        spacing();
        const float moved = splitter(ui, "splitter.left", {bar, room.y}, true);
        if (moved != 0) drag_side(ui, sides, left + moved, settings.left_width, settings.right_width);
        spacing();
    }
    ImGui::BeginGroup();
    const float middle =
        room.x - left - right - (left > 0 ? bar : 0) - (right > 0 ? bar : 0) - (fold ? 2 * ui.px(kFoldBar) : 0);
    if (screen) {
        panel(ui, panels[1].name, {middle, room.y}, [&] { panels[1].draw(ui); });
    } else {
        // Up to its borders.
        ImGui::BeginChild("viewport", {middle, room.y - bottom - bar}, false, ImGuiWindowFlags_NoBackground);
        ui.focus.panel("view");
        viewport_toolbar(ui);
        views_panel(ui, viewports);
        ImGui::EndChild();
        bottom_height -= splitter(ui, "splitter.bottom", {middle, bar}, false) / ui.style.scale;
        panel(ui, "timeline", {middle, bottom},
              [&] { timeline(ui, ui.session.playback, ui.session.queries, pictures); });
    }
    ImGui::EndGroup();
    const bool of_crowd = is_crowd(ui.workspace) && !ui.workspace.view().query;
    if (right > 0) {
        spacing();
        const float moved = splitter(ui, "splitter.right", {bar, room.y}, true);
        if (moved != 0) drag_side(ui, sides, right - moved, settings.right_width, settings.left_width);
        spacing();
        // The map stays in sight, whatever of the query is scrolled to.
        const MapLayout map = map_layout(ui, {right, room.y});
        ImGui::BeginGroup();
        panel(ui, screen ? panels[2].name : "right", {right, room.y - map.height}, [&] {
            if (screen) return panels[2].draw(ui);
            compared_fits_panel(ui, ui.session.fit_costs);
            if (of_crowd) {
                crowd_panel(ui, ui.session.crowds);
            } else {
                query_panel(ui, ui.session.queries, pictures);
            }
            selection_panel(ui);
        });
        if (map.height > 0)
            panel(ui, "map", {right, map.height}, [&] { map_panel(ui, ui.session.maps, pictures.map, map); });
        ImGui::EndGroup();
    }
    if (fold) {
        spacing();
        fold_side(Unfolded::right, "fold.right", screen ? std::string(panels[2].name) : of_crowd ? "crowd" : "query");
    }
    ui.workspace.hovered = ui.hovered;
    ui.workspace.hovered_event = ui.hovered_event;
    status_bar(ui, ui.session.queries, {io.DisplaySize.x, status});
    ImGui::PopStyleVar();
    ImGui::End();

    settings.left_width = std::clamp(settings.left_width, 180.0, 900.0);
    settings.right_width = std::clamp(settings.right_width, 180.0, 900.0);
    bottom_height = std::clamp(bottom_height, 90.0, 900.0);

    ui.focus.panel("dialog");
    dialogs(ui);
    ui.focus.panel("messages");
    messages(ui, ui.session.notifications, ui.session.dialogs);
}

}  // namespace mobbscope::app
