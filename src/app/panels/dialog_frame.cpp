#include <app/panels/dialog_frame.h>

#include <algorithm>

namespace mobbscope::app {

namespace {

constexpr float kMargin = 24;  // from the window's border, pixels at scale 1
constexpr int kPage = 10;

}  // namespace

void begin_dialog(Ui& ui, const char* name, ImVec2 size, float top_share) {
    const ImVec2 room = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos({0, 0});
    ImGui::SetNextWindowSize(room);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0, 0});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 0);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 0);
    const ImVec4 dim = ImGui::ColorConvertU32ToFloat4(ui.look.window);
    ImGui::PushStyleColor(ImGuiCol_WindowBg, {dim.x, dim.y, dim.z, 0.6f});
    ImGui::Begin(name, nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                     ImGuiWindowFlags_NoScrollWithMouse);
    ImGui::PopStyleColor();
    ImGui::PopStyleVar(3);
    const ImVec2 fits{std::min(ui.px(size.x), room.x - 2 * ui.px(kMargin)),
                      std::min(ui.px(size.y), room.y - 2 * ui.px(kMargin))};
    ImGui::SetCursorPos({(room.x - fits.x) / 2, std::max(ui.px(kMargin), (room.y - fits.y) * top_share)});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {ui.px(16), ui.px(14)});
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {ui.px(8), ui.px(6)});
    ImGui::BeginChild("panel", fits, true, ImGuiWindowFlags_AlwaysUseWindowPadding);
}

void end_dialog() {
    ImGui::EndChild();
    ImGui::PopStyleVar(2);
    ImGui::End();
}

void dialog_title(Ui& ui, const char* text) {
    ImGui::PushFont(ui.look.title);
    ImGui::TextUnformatted(text);
    ImGui::PopFont();
    ImGui::Dummy({0, ui.px(2)});
}

bool marked_button(Ui& ui, const char* label, const char* mark, bool is_default) {
    if (is_default) ImGui::PushStyleColor(ImGuiCol_Border, ImGui::ColorConvertU32ToFloat4(ui.look.accent));
    const bool hit = ImGui::Button(label);
    if (is_default) ImGui::PopStyleColor();
    ui.mark(mark);
    return hit;
}

bool pressed(ImGuiKey key, bool repeat) { return ImGui::IsKeyPressed(ImGui::GetKeyIndex(key), repeat); }

bool pressed(Key key) {
    // An int up to ImGui 1.86, an enumeration later.
    using Index = decltype(ImGui::GetKeyIndex(ImGuiKey_Enter));
    return ImGui::IsKeyPressed(static_cast<Index>(key), false);
}

bool move_picked(int& picked, int count) {
    const int before = picked;
    if (pressed(ImGuiKey_DownArrow, true)) ++picked;
    if (pressed(ImGuiKey_UpArrow, true)) --picked;
    if (pressed(ImGuiKey_PageDown, true)) picked += kPage;
    if (pressed(ImGuiKey_PageUp, true)) picked -= kPage;
    picked = std::clamp(picked, 0, std::max(count - 1, 0));
    return picked != before;
}

}  // namespace mobbscope::app
