#include <app/commands/command.h>
#include <app/panels/panels.h>
#include <app/ui/dialog_frame.h>

#include <string>

namespace mobbscope::app {

namespace {

void answer(Ui& ui, Session::Unsaved choice) {
    ui.session.enqueue([&session = ui.session, choice] { session.answer_unsaved(choice); });
}

void unsaved(Ui& ui) {
    begin_dialog(ui, "unsaved", {440, 150});
    dialog_title(ui, "Save the changes?");
    ImGui::TextWrapped("%s has changes that are not saved. They are lost if you go on without saving.",
                       ui.session.title().c_str());
    ImGui::Dummy({0, ui.px(6)});
    if (marked_button(ui, "Save", "unsaved.save", true) || pressed(ImGuiKey_Enter)) {
        answer(ui, Session::Unsaved::save);
    }
    ImGui::SameLine();
    if (marked_button(ui, "Discard", "unsaved.discard") || pressed(Key::d)) {
        answer(ui, Session::Unsaved::discard);
    }
    ImGui::SameLine();
    if (marked_button(ui, "Cancel", "unsaved.cancel")) answer(ui, Session::Unsaved::cancel);
    ImGui::SameLine();
    ImGui::AlignTextToFramePadding();
    ImGui::TextDisabled("Enter, D or Escape");
    end_dialog();
}

}  // namespace

void dialogs(Ui& ui) {
    Session& session = ui.session;
    switch (session.dialog) {
        case Dialog::none:
            return;
        case Dialog::open:
        case Dialog::add:
        case Dialog::save_as:
        case Dialog::export_picture:
        case Dialog::review:
            file_dialog(ui);
            break;
        case Dialog::unsaved:
            unsaved(ui);
            break;
        case Dialog::palette:
            palette(ui);
            break;
        case Dialog::help:
            help_sheet(ui);
            break;
        case Dialog::about:
            about(ui);
            break;
    }
    if (pressed(ImGuiKey_Escape)) session.enqueue([&session] { session.close_dialog(); });
}

void about(Ui& ui) {
    begin_dialog(ui, "about", {460, 200});
    dialog_title(ui, "Mobbscope " MOBBSCOPE_VERSION);
    ImGui::TextWrapped(
        "Shows bounding-volume trees in space-time, and every step of the question whether two paths collide.");
    ImGui::Dummy({0, ui.px(4)});
    ImGui::PushStyleColor(ImGuiCol_Text, ui.style.quiet);
    ImGui::TextWrapped(
        "The method is from the paper \"Detecting Collisions in Graph-Driven Motion Synthesis for Crowd Simulation\".");
    ImGui::PopStyleColor();
    ImGui::Dummy({0, ui.px(6)});
    close_button(ui, "about.close");
    end_dialog();
}

}  // namespace mobbscope::app
