#include <app/ui/dialog_frame.h>
#include <app/ui/widgets.h>

#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <string_view>
#include <tuple>
#include <utility>

namespace mobbscope::app {

namespace {

constexpr float kMargin = 24;  // from the window's border, pixels at scale 1
constexpr int kPage = 10;

struct FieldWithCompletion {
    DialogInput& input;
    const std::function<std::string(const std::string&)>& complete;
    FieldText what;
};

/// What is selected when the field gets the keys: the first byte, and that behind the last.
std::pair<int, int> selected_at_first(std::string_view text, FieldText what) {
    const auto length = static_cast<int>(text.size());
    if (what == FieldText::search) return {length, length};
    const std::size_t name = text.rfind('/') + 1;
    const std::size_t dot = text.rfind('.');
    const bool has_extension = dot != std::string_view::npos && dot > name;
    return {static_cast<int>(name), has_extension ? static_cast<int>(dot) : length};
}

int on_event(ImGuiInputTextCallbackData* data) {
    auto& [input, complete, what] = *static_cast<FieldWithCompletion*>(data->UserData);
    if (data->EventFlag == ImGuiInputTextFlags_CallbackCompletion) {
        const std::string completed = complete(std::string(data->Buf, static_cast<std::size_t>(data->BufTextLen)));
        data->DeleteChars(0, data->BufTextLen);
        data->InsertChars(0, completed.c_str());
    } else if (input.fresh) {
        const std::string_view text(data->Buf, static_cast<std::size_t>(data->BufTextLen));
        const bool all = std::exchange(input.selected, false);
        std::tie(data->SelectionStart, data->SelectionEnd) =
            all ? std::pair(0, data->BufTextLen) : selected_at_first(text, what);
        data->CursorPos = data->SelectionEnd;
        input.fresh = false;
    }
    return 0;
}

}  // namespace

void begin_dialog(Ui& ui, const char* name, ImVec2 size, float top_share) {
    const ImVec2 room = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos({0, 0});
    ImGui::SetNextWindowSize(room);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0, 0});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 0);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 0);
    const ImVec4 dim = ImGui::ColorConvertU32ToFloat4(ui.style.window);
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
    text_line(ui.style.text, text, ui.style.title);
    ImGui::Dummy({0, ui.px(2)});
}

bool marked_button(Ui& ui, const char* label, const char* mark, bool is_default) {
    if (is_default) ImGui::PushStyleColor(ImGuiCol_Border, ImGui::ColorConvertU32ToFloat4(ui.style.accent));
    const bool hit = ImGui::Button(label);
    if (is_default) ImGui::PopStyleColor();
    ui.mark(mark);
    return hit;
}

void close_button(Ui& ui, const char* mark) {
    if (marked_button(ui, "Close", mark, true) || pressed(ImGuiKey_Enter)) {
        ui.later(&Dialogs::close);
    }
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

FieldEvents text_field(Ui& ui, const char* hint, const std::function<std::string(const std::string&)>& complete,
                       FieldText what) {
    DialogInput& input = ui.session.dialogs.input;
    FieldWithCompletion field{input, complete, what};
    ImGuiInputTextFlags flags = ImGuiInputTextFlags_CallbackAlways | ImGuiInputTextFlags_EnterReturnsTrue;
    // Where there is nothing to complete Tab goes on to the next widget.
    if (complete && complete(input.text) != input.text) {
        flags |= ImGuiInputTextFlags_CallbackCompletion;
        ui.focus.keep_tab();
    }
    if (input.fresh) {
        // ImGui 1.90 gives the keys to items of the focused window alone.
        if (!ImGui::IsWindowFocused()) ImGui::SetWindowFocus();
        ImGui::SetKeyboardFocusHere();
        ui.want_frame_in(0);
    }
    const std::string before = input.text;
    ImGui::PushID(input.opening);
    ImGui::PushID(input.generation);
    ImGui::SetNextItemWidth(-1);
    FieldEvents events;
    events.entered = ImGui::InputTextWithHint("##field", hint, &input.text, flags, on_event, &field);
    ImGui::PopID();
    ImGui::PopID();
    events.changed = input.text != before;
    if (events.changed) {
        input.picked = 0;
        input.confirming = false;
    }
    return events;
}

}  // namespace mobbscope::app
