#include <app/session/dialogs.h>

namespace mobbscope::app {

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
    if (now == Dialog::export_file) {
        // It lies over the dialog that asked for the file.
        now = Dialog::export_picture;
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
    const auto is_about_scene = [](Dialog which) {
        return which == Dialog::import_clip || which == Dialog::export_picture || which == Dialog::export_file;
    };
    if (is_about_scene(behind_help_.first)) behind_help_ = {Dialog::none, {}};
    if (now == Dialog::export_file) close();  // to the one that it lies over
    if (is_about_scene(now)) close();
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
