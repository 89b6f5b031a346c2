#include <app/session/dialogs.h>
#include <render/image/picture_names.h>
#include <scene/load_files.h>

#include <vector>

namespace mobbscope::app {

namespace {

std::span<const std::string_view> exported_extensions() {
    static const std::vector<std::string_view> all = [] {
        std::vector<std::string_view> out(kPictureExtensions.begin(), kPictureExtensions.end());
        out.insert(out.end(), kFilmExtensions.begin(), kFilmExtensions.end());
        return out;
    }();
    return all;
}

constexpr FileQuestion kOpen{"Open", "Open", "open", "file.open", openable_extensions};
constexpr FileQuestion kAdd{"Add files", "Add", "add", "file.add", openable_extensions};
constexpr FileQuestion kSaveAs{
    .title = "Save as", .button = "Save", .prefix = "save", .command = "file.save_as", .extension = ".json"};
constexpr FileQuestion kSaveProof{
    .title = "Save the proof", .button = "Save", .prefix = "proof", .command = "proof.save", .extension = ".json"};
constexpr FileQuestion kExportTo{"Export to", "Choose", "file", "picture.file", exported_extensions, ".png"};

/// In the order of Dialog.
constexpr auto kDialogs = std::to_array<DialogRow>({
    {.name = "none"},
    {.name = "open", .has_field = true, .question = &kOpen},
    {.name = "add", .has_field = true, .question = &kAdd},
    {.name = "save_as", .has_field = true, .question = &kSaveAs},
    {.name = "export_picture", .has_field = true, .about_scene = true, .before_escape = BeforeEscape::popup},
    {.name = "unsaved"},
    {.name = "palette", .has_field = true},
    {.name = "help", .has_field = true},
    {.name = "about"},
    {.name = "messages"},
    {.name = "dropped"},
    {.name = "import_clip",
     .about_scene = true,
     .before_escape = BeforeEscape::popup_or_text,
     .lets_through = {"edit.undo", "edit.redo"}},
    {.name = "history"},
    {.name = "folder", .has_field = true},
    {.name = "export_file",
     .has_field = true,
     .question = &kExportTo,
     .about_scene = true,
     .over = Dialog::export_picture},
    {.name = "save_proof", .has_field = true, .question = &kSaveProof, .about_scene = true},
    {.name = "build_graph", .about_scene = true, .before_escape = BeforeEscape::popup_or_text},
    {.name = "simulate", .about_scene = true, .before_escape = BeforeEscape::popup_or_text},
});

}  // namespace

std::span<const std::string_view> FileQuestion::scene_extensions() {
    static constexpr std::array<std::string_view, 1> kScenes{".json"};
    return kScenes;
}

const DialogRow& row_of(Dialog dialog) { return kDialogs[static_cast<std::size_t>(dialog)]; }

void Dialogs::open(Dialog which, DialogInput with) {
    behind_help_ = {};  // to close the help would lead back there, with what waits for an answer
    close();
    now = which;
    ask_anew(std::move(with));
}

void Dialogs::open_help() {
    if (now == Dialog::help) return;
    behind_help_ = {now, std::move(input)};
    now = Dialog::help;
    input = {.text = "", .opening = behind_help_.second.opening};
    ask_anew({});
}

void Dialogs::close() {
    if (now == Dialog::help && behind_help_.first != Dialog::none) {
        now = std::exchange(behind_help_.first, Dialog::none);
        const int opening = input.opening;
        input = std::move(behind_help_.second);
        input.fresh = true;
        input.opening = opening + 1;
        return;
    }
    if (row_of(now).over != Dialog::none) {
        now = row_of(now).over;
        return ask_anew({.text = exporting.file});
    }
    now = Dialog::none;
    ask_anew({});
    waiting_ = nullptr;
}

void Dialogs::ask_anew(DialogInput with) {
    with.opening = input.opening + 1;
    input = std::move(with);
}

void Dialogs::close_those_about_scene() {
    if (row_of(behind_help_.first).about_scene) behind_help_ = {Dialog::none, {}};
    while (row_of(now).about_scene) close();
}

void Dialogs::ask_for_folder(const FileQuestion& question) {
    folder_ = &question;
    open(Dialog::folder);
}

void Dialogs::ask_about_unsaved(std::function<void()> then) {
    open(Dialog::unsaved);
    waiting_ = std::move(then);
}

void Dialogs::ask_where_to_save() {
    now = Dialog::save_as;
    ask_anew({});
}

std::function<void()> Dialogs::take_waiting() { return std::exchange(waiting_, nullptr); }

}  // namespace mobbscope::app
