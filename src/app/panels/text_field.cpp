#include <app/panels/text_field.h>

#include <imgui.h>
#include <imgui_stdlib.h>

namespace mobbscope::app {

namespace {

struct FieldWithCompletion {
    DialogInput& input;
    const std::function<std::string(const std::string&)>& complete;
};

int on_event(ImGuiInputTextCallbackData* data) {
    auto& [input, complete] = *static_cast<FieldWithCompletion*>(data->UserData);
    if (data->EventFlag == ImGuiInputTextFlags_CallbackCompletion) {
        const std::string completed = complete(std::string(data->Buf, static_cast<std::size_t>(data->BufTextLen)));
        data->DeleteChars(0, data->BufTextLen);
        data->InsertChars(0, completed.c_str());
    } else if (input.fresh) {
        // What is there is gone on with, not replaced.
        data->CursorPos = data->SelectionStart = data->SelectionEnd = data->BufTextLen;
        input.fresh = false;
    }
    return 0;
}

}  // namespace

FieldEvents text_field(Ui& ui, const char* hint, const std::function<std::string(const std::string&)>& complete) {
    DialogInput& input = ui.session.input;
    FieldWithCompletion field{input, complete};
    ImGuiInputTextFlags flags = ImGuiInputTextFlags_CallbackAlways | ImGuiInputTextFlags_EnterReturnsTrue;
    if (complete) flags |= ImGuiInputTextFlags_CallbackCompletion;
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
