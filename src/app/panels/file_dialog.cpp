#include <app/commands/command.h>
#include <app/panels/panels.h>
#include <app/panels/path_completion.h>
#include <app/ui/dialog_frame.h>
#include <app/ui/widgets.h>
#include <base/text.h>
#include <scene/load_files.h>

#include <array>
#include <exception>
#include <system_error>

namespace mobbscope::app {

namespace {

constexpr std::array<std::string_view, 1> kScenes{".json"};
constexpr std::array<std::string_view, 1> kPictures{".png"};

/// What differs between the four.
struct Purpose {
    const char* title;
    const char* button;
    const char* prefix;   ///< of the marks
    const char* command;  ///< that is done with the path
    std::span<const std::string_view> extensions;
    const char* extension;  ///< that a name without one gets; null: none, as the file must be there
};

Purpose purpose_of(Dialog dialog) {
    switch (dialog) {
        case Dialog::add:
            return {"Add files", "Add", "add", "file.add", openable_extensions(), nullptr};
        case Dialog::save_as:
            return {"Save as", "Save", "save", "file.save_as", kScenes, ".json"};
        case Dialog::export_picture:
            return {"Export picture", "Export", "export", "file.export_picture", kPictures, ".png"};
        case Dialog::review:
            return {"Review picture tests", "Review this folder", "review", "file.review", kScenes, nullptr};
        default:
            return {"Open", "Open", "open", "file.open", openable_extensions(), nullptr};
    }
}

/// Where one begins: the folder of what is open, and for a new file a name.
std::string first_text(const Session& session, const Purpose& purpose) {
    const std::filesystem::path& open = session.scene().file;
    std::error_code ignored;
    std::filesystem::path folder =
        open.has_parent_path() && session.file() ? open.parent_path() : std::filesystem::current_path(ignored);
    if (purpose.extension) {
        const std::string stem = std::filesystem::path(session.title()).stem().string();
        return (folder / (stem + purpose.extension)).string();
    }
    return (folder / "").string();
}

std::string size_text(std::uintmax_t bytes) {
    const double size = static_cast<double>(bytes);
    if (bytes < 1000) return formatted("%ju B", bytes);
    if (size < 999.5e3) return formatted("%.*f kB", size < 9.95e3 ? 1 : 0, size / 1e3);
    return formatted("%.1f MB", size / 1e6);
}

/// The path that is meant, with the extension that it lacks.
std::filesystem::path path_meant(const std::string& typed, const Purpose& purpose) {
    std::filesystem::path path = expanded(typed);
    if (purpose.extension && path.has_filename() && !path.has_extension()) path += purpose.extension;
    return path;
}

void accept(Session& session, const Purpose& purpose) {
    DialogInput& input = session.input;
    const std::filesystem::path path = path_meant(input.text, purpose);
    std::error_code ignored;
    const bool keeps_own = session.dialog == Dialog::save_as && session.file() &&
                           std::filesystem::equivalent(path, *session.file(), ignored);
    if (purpose.extension && !keeps_own && !input.confirming && std::filesystem::exists(path, ignored)) {
        input.confirming = true;
        input.fresh = true;
        return;
    }
    const Dialog dialog = session.dialog;
    try {
        if (dialog == Dialog::save_as) {
            session.save_as(path);  // closes the dialog, and goes on with what waited for it
            return;
        }
        run_command(session, purpose.command, path.string());
        if (session.dialog == dialog) session.close_dialog();
    } catch (const std::exception& error) {
        session.tell(Message::Level::error, error.what());
        input.fresh = true;
    }
}

/// The files and folders that go on as typed; a folder that is taken is gone into.
void listing(Ui& ui, const Purpose& purpose, const PathCompletion& completion, bool& accepted) {
    DialogInput& input = ui.session.input;
    const int count = static_cast<int>(completion.entries.size());
    const bool moved = move_picked(input.picked, count);
    if (completion.entries.empty())
        ImGui::TextDisabled(purpose.extension ? "No file here begins so."
                                              : "There is nothing here that can be opened.");
    for (int i = 0; i < count; ++i) {
        const PathEntry& entry = completion.entries[static_cast<std::size_t>(i)];
        const std::string name = entry.name + (entry.folder ? "/" : "");
        ImGui::PushID(i);
        const bool clicked = ImGui::Selectable(name.c_str(), i == input.picked, ImGuiSelectableFlags_AllowDoubleClick);
        ImGui::PopID();
        ui.mark(std::string(purpose.prefix) + ".entry." + entry.name);
        if (moved && i == input.picked) ImGui::SetScrollHereY();
        if (!entry.folder) {
            const std::string size = size_text(entry.size);
            ImGui::SameLine(ImGui::GetWindowContentRegionMax().x - text_size(*ui.style.mono, size).x);
            text_line(ui.style.quiet, size, ui.style.mono);
        }
        if (clicked) {
            const bool twice = ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left);
            // A folder is gone into at the second click; a file is named at the first and taken at the second.
            if (!entry.folder || twice) input.set_text(with_entry(input.text, entry));
            if (!entry.folder && twice) accepted = true;
            if (!twice) {
                input.picked = i;
                input.fresh = true;
            }
            return;
        }
    }
}

void recent_files(Ui& ui, const Purpose& purpose, bool& accepted) {
    text_line(ui.style.quiet, "RECENT", ui.style.caption);
    int index = 0;
    for (const std::filesystem::path& file : ui.session.settings.recent) {
        ImGui::PushID(index);
        const bool clicked = ImGui::Selectable(file.filename().string().c_str(), false);
        ImGui::PopID();
        ui.mark(std::string(purpose.prefix) + ".recent." + std::to_string(index++));
        if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", file.string().c_str());
        if (!clicked) continue;
        ui.session.input.set_text(file.string());
        accepted = true;
        return;
    }
}

}  // namespace

void file_dialog(Ui& ui) {
    Session& session = ui.session;
    DialogInput& input = session.input;
    const Purpose purpose = purpose_of(session.dialog);
    if (input.generation == 0) input.set_text(first_text(session, purpose));
    begin_dialog(ui, "file", {680, 460});
    dialog_title(ui, purpose.title);
    const auto complete = [&](const std::string& text) { return complete_path(text, purpose.extensions).completed; };
    const std::string prefix = purpose.prefix;
    const FieldEvents events = text_field(ui, "A path; Tab completes it", complete);
    ui.mark(prefix + ".path");
    const PathCompletion completion = complete_path(input.text, purpose.extensions);

    const float foot = ImGui::GetFrameHeightWithSpacing() + ui.px(4);
    const bool has_recent = !purpose.extension && session.dialog != Dialog::review && !session.settings.recent.empty();
    const float side = has_recent ? ui.px(180) : 0;
    bool accepted = false;
    ImGui::BeginChild("files", {ImGui::GetContentRegionAvail().x - side, -foot}, false);
    listing(ui, purpose, completion, accepted);
    ImGui::EndChild();
    if (has_recent) {
        ImGui::SameLine();
        ImGui::BeginChild("recent", {0, -foot}, false);
        recent_files(ui, purpose, accepted);
        ImGui::EndChild();
    }

    if (events.entered) {
        // Enter takes the picked entry where the text is only its beginning.
        std::error_code ignored;
        const std::filesystem::path typed = expanded(input.text);
        const bool is_file = std::filesystem::exists(typed, ignored) && !std::filesystem::is_directory(typed, ignored);
        const bool is_new = purpose.extension && typed.has_filename() && !std::filesystem::is_directory(typed, ignored);
        const auto picked = static_cast<std::size_t>(input.picked);
        if (is_file || (is_new && input.picked == 0) || picked >= completion.entries.size()) {
            accepted = true;
        } else {
            const PathEntry entry = completion.entries[picked];
            input.set_text(with_entry(input.text, entry));
            accepted = !entry.folder;
        }
    }
    if (marked_button(ui, input.confirming ? "Overwrite" : purpose.button, (prefix + ".ok").c_str(), true)) {
        accepted = true;
    }
    ImGui::SameLine();
    const bool cancelled = marked_button(ui, "Cancel", (prefix + ".cancel").c_str());
    ImGui::SameLine();
    ImGui::AlignTextToFramePadding();
    if (input.confirming) {
        text_line(ui.style.warning, "This file exists. Enter overwrites it.");
    } else if (!purpose.extension) {
        ImGui::TextDisabled("Enter goes into a folder; %s.",
                            session.dialog == Dialog::review ? "the button takes it" : "Open opens all clips in it");
    }
    end_dialog();
    if (accepted) session.enqueue([&session, purpose] { accept(session, purpose); });
    if (cancelled) session.enqueue([&session] { session.close_dialog(); });
}

}  // namespace mobbscope::app
