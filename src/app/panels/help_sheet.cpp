#include <app/commands/arguments.h>
#include <app/commands/command.h>
#include <app/panels/panels.h>
#include <app/ui/dialog_frame.h>
#include <app/ui/widgets.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace mobbscope::app {

namespace {

constexpr float kColumn = 300;  // pixels at scale 1

struct Line {
    std::string keys, what;
    bool heading = false;
};

constexpr std::array<std::pair<const char*, const char*>, 6> kMouse{{
    {"Left drag", "Turn the scene"},
    {"Right drag", "Shift the scene"},
    {"Wheel", "Go nearer, or away"},
    {"Click", "Select"},
    {"Drop files", "Open or add them"},
    {"Hover", "Say what is there"},
}};

/// All shortcuts by menu, then the mouse.
std::vector<Line> lines(const Session& session) {
    std::vector<Line> out;
    std::string_view menu;
    for (const Command& command : commands()) {
        if (command.shortcut.empty() || !belongs_here(session, command)) continue;
        const std::string_view of = command.menu.substr(0, command.menu.find('/'));
        if (of != menu) out.push_back({"", std::string(of), true});
        menu = of;
        std::string what(command.title);
        if (what.ends_with("...")) what.resize(what.size() - 3);
        for (const std::string& chord : words_of(command.shortcut)) out.push_back({chord, what, false});
    }
    out.push_back({"", "Mouse", true});
    for (const auto& [keys, what] : kMouse) out.push_back({keys, what, false});
    return out;
}

void help_line(Ui& ui, const Line& line, float keys_width) {
    if (line.heading) {
        text_line(ui.style.quiet, line.what, ui.style.caption);
        return;
    }
    const float x = ImGui::GetCursorPosX();
    text_line(ui.style.text, line.keys, ui.style.mono);
    ImGui::SameLine();
    ImGui::SetCursorPosX(x + keys_width);
    ImGui::TextUnformatted(line.what.c_str());
}

}  // namespace

std::span<const std::pair<const char*, const char*>> mouse_help() { return kMouse; }

void help_sheet(Ui& ui) {
    begin_dialog(ui, "help", {980, 640});
    dialog_title(ui, "Shortcuts");
    const std::vector<Line> all = lines(ui.session);
    float keys_width = 0, what_width = 0;
    for (const Line& line : all) {
        keys_width = std::max(keys_width, text_size(*ui.style.mono, line.keys).x);
        what_width = std::max(what_width, ImGui::CalcTextSize(line.what.c_str()).x);
    }
    keys_width += ui.px(12);
    ImGui::BeginChild("keys", {0, -ImGui::GetFrameHeightWithSpacing() - ui.px(4)});
    const float width = std::max(ui.px(kColumn), keys_width + what_width + ui.px(16));
    const int columns = std::clamp(static_cast<int>(ImGui::GetContentRegionAvail().x / width), 1, 3);
    const auto per_column = static_cast<std::size_t>(std::ceil(static_cast<double>(all.size()) / columns));
    const float top = ImGui::GetCursorPosY();
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {ui.px(8), ui.px(3)});
    std::size_t line = 0;
    for (int column = 0; column < columns; ++column) {
        ImGui::SetCursorPos({static_cast<float>(column) * width, top});
        ImGui::BeginGroup();
        // A heading does not stay behind alone at the foot of a column.
        const std::size_t end = (static_cast<std::size_t>(column) + 1) * per_column;
        for (; line < all.size() && (line < end || column + 1 == columns); ++line) {
            if (all[line].heading && line + 1 == end) break;
            help_line(ui, all[line], keys_width);
        }
        ImGui::EndGroup();
    }
    ImGui::PopStyleVar();
    if (pressed(ImGuiKey_DownArrow, true)) ImGui::SetScrollY(ImGui::GetScrollY() + ui.px(60));
    if (pressed(ImGuiKey_UpArrow, true)) ImGui::SetScrollY(ImGui::GetScrollY() - ui.px(60));
    ImGui::EndChild();
    close_button(ui, "help.close");
    ImGui::SameLine();
    ImGui::AlignTextToFramePadding();
    ImGui::TextDisabled("Ctrl+P finds everything else by a few letters.");
    end_dialog();
}

}  // namespace mobbscope::app
