#include <app/commands/arguments.h>
#include <app/commands/command.h>
#include <app/panels/panels.h>
#include <app/ui/dialog_frame.h>
#include <app/ui/widgets.h>
#include <base/file.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace mobbscope::app {

namespace {

void answer(Ui& ui, Files::Unsaved choice) {
    ui.later([choice](Files& files) { files.answer_unsaved(choice); });
}

void unsaved(Ui& ui) {
    begin_dialog(ui, "unsaved", {440, 150});
    dialog_title(ui, "Save the changes?");
    ImGui::TextWrapped("%s has changes that are not saved. They are lost if you go on without saving.",
                       ui.workspace.title().c_str());
    ImGui::Dummy({0, ui.px(6)});
    if (marked_button(ui, "Save", "unsaved.save", true) || pressed(ImGuiKey_Enter)) {
        answer(ui, Files::Unsaved::save);
    }
    ImGui::SameLine();
    if (marked_button(ui, "Discard", "unsaved.discard") || pressed(Key::d)) {
        answer(ui, Files::Unsaved::discard);
    }
    ImGui::SameLine();
    if (marked_button(ui, "Cancel", "unsaved.cancel")) answer(ui, Files::Unsaved::cancel);
    ImGui::SameLine();
    ImGui::AlignTextToFramePadding();
    ImGui::TextDisabled("Enter, D or Escape");
    end_dialog();
}

/// Files were dropped while something is open.
void dropped(Ui& ui) {
    constexpr std::size_t kMostNames = 6;
    const std::vector<std::filesystem::path>& files = ui.session.dialogs.input.files;
    begin_dialog(ui, "dropped", {480, 150 + 22 * static_cast<float>(std::min(files.size(), kMostNames + 1))});
    dialog_title(ui,
                 ui.session.files.may_add() ? "Add to this scene, or open instead?" : "Open in place of what is open?");
    const NameList names(files.size(), [&](std::size_t i) { return own_name(files[i]); });
    for (std::size_t i = 0; i < std::min(files.size(), kMostNames); ++i) {
        name_line(ui, ui.style.text, own_name(files[i]), ImGui::GetContentRegionAvail().x, names);
    }
    if (files.size() > kMostNames) {
        ImGui::TextDisabled("and %s more", std::to_string(files.size() - kMostNames).c_str());
    }
    ImGui::Dummy({0, ui.px(6)});
    const auto answer = [&](const char* command) {
        ui.later([command, argument = as_argument(files)](Session& session) {
            session.dialogs.close();
            run_command(session, command, argument);
        });
    };
    if (!ui.session.files.may_add()) {
        if (marked_button(ui, "Open instead", "dropped.open", true) || pressed(ImGuiKey_Enter)) answer("file.open");
    } else {
        if (marked_button(ui, "Add", "dropped.add", true) || pressed(ImGuiKey_Enter)) answer("file.add");
        ImGui::SameLine();
        if (marked_button(ui, "Open instead", "dropped.open") || pressed(Key::o)) answer("file.open");
    }
    ImGui::SameLine();
    if (marked_button(ui, "Cancel", "dropped.cancel")) ui.later(&Dialogs::close);
    ImGui::SameLine();
    ImGui::AlignTextToFramePadding();
    ImGui::TextDisabled(!ui.session.files.may_add() ? "Enter or Escape" : "Enter, O or Escape");
    end_dialog();
}

void ask_for_file(Ui& ui) { file_dialog(ui, ui.session.dialogs, ui.session.settings); }

using Draw = void (*)(Ui&);
constexpr std::array<std::pair<Dialog, Draw>, 17> kDrawn{
    {{Dialog::open, ask_for_file},
     {Dialog::add, ask_for_file},
     {Dialog::save_as, ask_for_file},
     {Dialog::export_file, ask_for_file},
     {Dialog::folder, ask_for_file},
     {Dialog::save_proof, ask_for_file},
     {Dialog::export_picture, export_dialog},
     {Dialog::unsaved, unsaved},
     {Dialog::palette, [](Ui& ui) { palette(ui, ui.session.dialogs); }},
     {Dialog::help, help_sheet},
     {Dialog::about, about},
     {Dialog::dropped, dropped},
     {Dialog::messages, [](Ui& ui) { message_list(ui, ui.session.dialogs, ui.session.notifications); }},
     {Dialog::import_clip, [](Ui& ui) { import_dialog(ui, ui.session.imports); }},
     {Dialog::history, history_list},
     {Dialog::build_graph, [](Ui& ui) { graph_dialog(ui, ui.session.crowd_maker); }},
     {Dialog::simulate, [](Ui& ui) { simulate_dialog(ui, ui.session.crowd_maker); }}}};

}  // namespace

void dialogs(Ui& ui) {
    const Dialog now = ui.session.dialogs.now;
    if (now == Dialog::none) return;
    // Of lists and fields in a dialog Escape closes these first.
    const BeforeEscape before = row_of(now).before_escape;
    const bool in_popup = before != BeforeEscape::nothing && ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopup);
    const bool in_text = before == BeforeEscape::popup_or_text && ImGui::GetIO().WantTextInput;
    std::ranges::find(kDrawn, now, &std::pair<Dialog, Draw>::first)->second(ui);
    // A field in it that is typed into is left first.
    const bool typing = ui.field.typing || in_popup || in_text;
    if (pressed(ImGuiKey_Escape) && !typing) ui.later(&Dialogs::close);
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
