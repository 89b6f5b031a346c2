#include <app/commands/arguments.h>
#include <app/commands/command.h>
#include <app/commands/picture_order.h>
#include <app/panels/panels.h>
#include <app/ui/dialog_frame.h>
#include <app/ui/widgets.h>
#include <base/file.h>
#include <base/text.h>
#include <scene/load_files.h>

#include <algorithm>
#include <array>
#include <ctime>
#include <exception>
#include <optional>
#include <span>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

namespace mobbscope::app {

namespace {

using Choose = FileBrowser::Choose;

// Pixels at scale 1.
constexpr float kDialogWidth = 920;
constexpr float kDialogHeight = 560;
constexpr float kPlacesWidth = 132;
constexpr float kPreviewWidth = 236;
constexpr float kLeastList = 300;  ///< narrower, what stands beside it gives way
constexpr float kSizeWidth = 74;
constexpr float kDateWidth = 136;
constexpr float kLeastName = 150;  ///< narrower, the date gives way
constexpr std::size_t kMostCrumbs = 4;
constexpr std::size_t kMostRecentFolders = 6;

bool is_folder(const std::filesystem::path& path) {
    std::error_code ignored;
    return std::filesystem::is_directory(path, ignored);
}

bool is_clip(const FileEntry& entry) { return !entry.folder && unpacked_extension(entry.name) != ".json"; }

/// Pictures that are compared must not change with the dates of files.
std::string date_text(const Session& session, std::time_t when) {
    std::tm parts{};
    if (!session.options.may_write || !::localtime_r(&when, &parts)) return "";
    std::array<char, 32> text{};
    const std::size_t length = std::strftime(text.data(), text.size(), "%Y-%m-%d %H:%M", &parts);
    return {text.data(), length};
}

/// Where one was last; a scene that has a file is saved beside it.
void begin(Settings& settings, Workspace& workspace, Dialogs& dialogs, const FileQuestion& question) {
    std::filesystem::path folder = settings.folder;
    if (question.writes() && workspace.file) folder = workspace.file->parent_path();
    if (!folder.empty() && !is_folder(folder)) folder.clear();
    const std::string open = workspace.scene().file.filename().string();
    const bool to_export = dialogs.now == Dialog::export_file;
    const std::filesystem::path exported =
        to_export ? export_file(workspace, settings, dialogs) : std::filesystem::path();
    if (to_export && is_folder(exported.parent_path())) folder = exported.parent_path();
    dialogs.browser.order_by(settings.file_order);
    dialogs.browser.begin(folder, question.extensions(), open);
    const std::string stem = std::filesystem::path(workspace.title()).stem().string();
    dialogs.input.set_text(to_export                           ? exported.filename().string()
                           : dialogs.now == Dialog::save_proof ? stem + "_proof.json"
                           : question.writes()                 ? stem + question.extension
                                                               : "");
}

/// What was typed led elsewhere; the name of a file that is to be written stays.
void keep_name(Dialogs& dialogs, const FileQuestion& question) {
    const std::string& typed = dialogs.input.text;
    dialogs.input.set_text(question.writes() ? typed.substr(typed.rfind('/') + 1) : "");
}

void go_into(Dialogs& dialogs, const FileQuestion& question, const std::filesystem::path& folder) {
    dialogs.browser.go(folder);
    keep_name(dialogs, question);
}

void go_up(Dialogs& dialogs, const FileQuestion& question) {
    dialogs.browser.go_up();
    keep_name(dialogs, question);
}

/// Does the dialog's command with files; what goes wrong is said, and the dialog stays.
void take(Session& session, const FileQuestion& question, const std::vector<std::filesystem::path>& files) {
    const Dialog dialog = session.dialogs.now;
    try {
        run_command(session, question.command, as_argument(files));
        if (session.dialogs.now == dialog) session.dialogs.close();
    } catch (const std::exception& error) {
        session.notifications.tell(MessageLevel::error, error.what());
        session.dialogs.input.fresh = true;
    }
}

/// A file that is to be written, with the extension that it lacks; asks before another one is overwritten.
void take_written(Session& session, const FileQuestion& question) {
    DialogInput& input = session.dialogs.input;
    std::filesystem::path path = typed_path(input.text, session.dialogs.browser.folder());
    if (is_folder(path)) return go_into(session.dialogs, question, path);
    const bool film = session.dialogs.now == Dialog::export_file && session.dialogs.exporting.film;
    path = with_extension(path, film ? ".mp4" : question.extension);
    std::error_code ignored;
    const bool keeps_own =
        session.dialogs.now == Dialog::save_as && session.workspace.file && is_same_file(path, *session.workspace.file);
    if (!keeps_own && !input.confirming && std::filesystem::exists(path, ignored)) {
        input.confirming = true;
        input.fresh = true;
        return;
    }
    const auto pending_goes_on = [&] {
        try {
            session.files.save_as(path);  // closes the dialog, and goes on with what waited for it
        } catch (const std::exception& error) {
            session.notifications.tell(MessageLevel::error, error.what());
            input.fresh = true;
        }
    };
    // Who agreed here is not asked again where it is written.
    if (session.dialogs.now == Dialog::export_file) session.dialogs.exporting.agreed = input.confirming ? path : "";
    session.dialogs.now == Dialog::save_as ? pending_goes_on() : take(session, question, {path});
}

/// What is chosen, which is what was typed where that is listed; a folder is gone into.
void take_read(Session& session, const FileQuestion& question) {
    const std::vector<std::filesystem::path> chosen = session.dialogs.browser.chosen();
    if (chosen.size() == 1 && is_folder(chosen.front())) return go_into(session.dialogs, question, chosen.front());
    if (!chosen.empty()) return take(session, question, chosen);
    const std::string& typed = session.dialogs.input.text;
    const std::filesystem::path path = typed_path(typed, session.dialogs.browser.folder()).lexically_normal();
    if (typed.empty()) {
        session.dialogs.input.fresh = true;
    } else if (is_folder(path)) {
        go_into(session.dialogs, question, path);
    } else {
        take(session, question, {path});  // which says what is wrong with it
    }
}

/// The folder whose clips are opened together: the one that is chosen, else the one that is listed.
std::filesystem::path folder_of_clips(const FileBrowser& browser) {
    const std::vector<std::filesystem::path> chosen = browser.chosen();
    const bool is_one = browser.is_chosen_by_hand() && chosen.size() == 1 && is_folder(chosen.front());
    return is_one ? chosen.front() : browser.listed();
}

// --- what stands above the list

/// The way to the folder, each step a button.
void crumbs(Ui& ui, Dialogs& dialogs, const FileQuestion& question) {
    const std::string prefix = question.prefix;
    const auto go = [&](const std::filesystem::path& folder) {
        ui.later([&dialogs, question, folder] { go_into(dialogs, question, folder); });
    };
    if (ImGui::ArrowButton("##up", ImGuiDir_Up)) ui.later([&dialogs, question] { go_up(dialogs, question); });
    ui.mark(prefix + ".up");
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("The folder above (Backspace, or Alt+Up)");
    const std::vector<std::filesystem::path> way = dialogs.browser.way();
    const std::size_t first = way.size() > kMostCrumbs ? way.size() - kMostCrumbs : 0;
    const float room = ImGui::GetContentRegionMax().x / static_cast<float>(kMostCrumbs + 1);
    ImGui::PushStyleColor(ImGuiCol_Button, ImVec4(0, 0, 0, 0));
    if (first > 0) {
        ImGui::SameLine();
        if (ImGui::Button("\u2026")) go(way[first - 1]);
        if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", way[first - 1].string().c_str());
    }
    for (std::size_t i = first; i < way.size(); ++i) {
        ImGui::SameLine(0, ui.px(2));
        if (i > 0) {
            ImGui::AlignTextToFramePadding();
            ImGui::TextDisabled("/");
            ImGui::SameLine(0, ui.px(2));
        }
        const std::string name = i == 0 ? "/" : way[i].filename().string();
        ImGui::PushID(static_cast<int>(i));
        if (ImGui::Button(fitted_text(name, room).c_str())) go(way[i]);
        ImGui::PopID();
        ui.mark(prefix + ".crumb." + std::to_string(way.size() - 1 - i));
        if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", way[i].string().c_str());
    }
    ImGui::PopStyleColor();
}

// --- what stands at the left

struct FilePlace {
    std::string name;
    std::filesystem::path folder;
};

/// Where files often are.
std::vector<FilePlace> places(const Workspace& workspace) {
    std::vector<FilePlace> out;
    const std::string home = expanded("~");
    out.push_back({"Home", home == "~" ? "/" : home});
    if (workspace.file) out.push_back({"This scene's", typed_path(".", workspace.file->parent_path())});
    try {
        out.push_back({"Examples", demo_scene_file().parent_path().parent_path()});
    } catch (const MachineError&) {
        // It was installed without them.
    }
    return out;
}

std::vector<FilePlace> recent_folders(const Settings& settings) {
    std::vector<FilePlace> out;
    for (const std::filesystem::path& file : settings.recent) {
        const std::filesystem::path folder = is_folder(file) ? file : file.parent_path();
        const bool known = std::ranges::any_of(out, [&](const FilePlace& place) { return place.folder == folder; });
        if (!known) out.push_back({own_name(folder), folder});
        if (out.size() == kMostRecentFolders) break;
    }
    return out;
}

void place_list(Ui& ui, Settings& settings, const FileQuestion& question) {
    const auto list = [&](const std::vector<FilePlace>& all, const std::string& mark) {
        for (std::size_t i = 0; i < all.size(); ++i) {
            const FilePlace& place = all[i];
            ImGui::PushID(static_cast<int>(i));
            ImGui::PushID(mark.c_str());
            if (ImGui::Selectable(fitted_text(place.name, ImGui::GetContentRegionAvail().x).c_str())) {
                ui.later([question, to = place.folder](Dialogs& dialogs) { go_into(dialogs, question, to); });
            }
            ImGui::PopID();
            ImGui::PopID();
            ui.mark(question.prefix + mark + std::to_string(i));
            if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", place.folder.string().c_str());
        }
    };
    text_line(ui.style.quiet, "PLACES", ui.style.caption);
    list(places(ui.workspace), ".place.");
    const std::vector<FilePlace> recent = recent_folders(settings);
    if (recent.empty()) return;
    ImGui::Dummy({0, ui.px(6)});
    text_line(ui.style.quiet, "RECENT", ui.style.caption);
    list(recent, ".recent.");
}

// --- the list

/// Where its columns begin, from the left end of a row.
struct Columns {
    float width = 0;  ///< of the row
    float size = 0;   ///< right end
    float date = 0;   ///< left end; 0: there is no room for it
};

Columns columns_of(const Ui& ui, float width) {
    Columns out{width, width - ui.px(6), 0};
    if (width - ui.px(kSizeWidth + kDateWidth) > ui.px(kLeastName)) {
        out.date = width - ui.px(kDateWidth);
        out.size = out.date - ui.px(14);
    }
    return out;
}

/// Orders by a column, or the other way round if it is ordered by it already.
void order_by(Settings& settings, Dialogs& dialogs, const std::string& column) {
    std::string& now = settings.file_order;
    // Who orders by date or size looks for the latest or largest.
    const std::string first = column == "name" ? column : "-" + column;
    const std::string other = column == "name" ? "-" + column : column;
    now = now == first ? other : first;
    dialogs.browser.order_by(now);
}

/// The heads of the columns; a click orders by one, the next one the other way round.
void column_heads(Ui& ui, Settings& settings, Dialogs& dialogs, const FileQuestion& question, const Columns& columns) {
    const std::string& now = settings.file_order;
    const ImVec2 at = ImGui::GetCursorPos();
    const auto head = [&](const char* label, const std::string& order, float from, float to) {
        const bool first_to_last = now == order;
        const bool last_to_first = now == "-" + order;
        ImGui::SetCursorPos({at.x + from, at.y});
        const float height = ImGui::GetTextLineHeight() + ui.px(6);
        if (ImGui::InvisibleButton(order.c_str(), {to - from, height})) order_by(settings, dialogs, order);
        ui.mark(question.prefix + (".order." + order));
        const bool hovered = ImGui::IsItemHovered();
        if (hovered) ImGui::SetTooltip("Orders by it: Ctrl+1 the name, Ctrl+2 the size, Ctrl+3 the date");
        const ImVec2 min = ImGui::GetItemRectMin();
        ImDrawList& draw = *ImGui::GetWindowDrawList();
        const ImU32 color = hovered || first_to_last || last_to_first ? ui.style.text : ui.style.quiet;
        const ImFont& font = *ui.style.caption;
        const float y = min.y + (height - font.FontSize) / 2;
        const float word = text_size(font, label).x;
        const bool right = order == "size";
        const float x = right ? ImGui::GetItemRectMax().x - word : min.x + (order == "name" ? ui.px(6) : 0);
        draw_text(draw, font, {x, y}, color, label);
        if (!first_to_last && !last_to_first) return;
        const ImVec2 tip{right ? x - ui.px(8) : x + word + ui.px(8), y + font.FontSize / 2};
        const float up = first_to_last ? -1.0f : 1.0f;
        const float side = ui.px(3);
        draw.AddTriangleFilled({tip.x - side, tip.y - up * side / 2}, {tip.x + side, tip.y - up * side / 2},
                               {tip.x, tip.y + up * side}, color);
    };
    head("NAME", "name", 0, columns.size - ui.px(kSizeWidth));
    head("SIZE", "size", columns.size - ui.px(kSizeWidth), columns.size);
    if (columns.date > 0) head("CHANGED", "date", columns.date, columns.width);
}

/// One line of the list; returns whether it was clicked.
bool file_row(Ui& ui, Dialogs& dialogs, const FileEntry& entry, std::size_t index, const Columns& columns,
              const NameList& names) {
    const FileBrowser& browser = dialogs.browser;
    const float height = ImGui::GetTextLineHeight() + ui.px(6);
    const ImVec2 at = ImGui::GetCursorScreenPos();
    ImGui::PushID(static_cast<int>(index));
    const bool clicked = ImGui::Selectable("##row", browser.is_chosen(entry), ImGuiSelectableFlags_AllowDoubleClick,
                                           {columns.width, height});
    ImGui::PopID();
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    const float y = at.y + (height - ImGui::GetFontSize()) / 2;
    const std::string size = entry.folder ? "" : bytes_text(entry.size);
    const float name_room = columns.size - text_size(*ui.style.mono, size).x - ui.px(16);
    const std::string whole = entry.name + (entry.folder ? "/" : "");
    const std::string name = fitted_name(whole, name_room, names);
    tell_whole(ui, name, whole);
    draw.AddText({at.x + ui.px(6), y}, entry.folder ? ui.style.accent : ui.style.text, name.c_str());
    const auto number = [&](float x, const std::string& text) {
        draw_text(draw, *ui.style.mono, {at.x + x, at.y + (height - ui.style.mono->FontSize) / 2}, ui.style.quiet,
                  text);
    };
    number(columns.size - text_size(*ui.style.mono, size).x, size);
    if (columns.date > 0) number(columns.date, date_text(ui.session, entry.written));
    if (index == browser.cursor() && browser.chosen_count() > 1) {
        draw.AddRect(at, {at.x + columns.width, at.y + height}, ui.style.accent, ui.px(2));
    }
    return clicked;
}

/// A click on an entry; whether it is taken.
bool clicked_entry(Session& session, const FileQuestion& question, std::size_t index) {
    const ImGuiIO& io = ImGui::GetIO();
    const FileEntry& entry = session.dialogs.browser.entries()[index];
    session.dialogs.input.fresh = true;  // keys go on in the field
    session.dialogs.browser.choose(index, io.KeyShift && !question.writes()  ? Choose::range
                                          : io.KeyCtrl && !question.writes() ? Choose::toggle
                                                                             : Choose::only);
    const bool twice = ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left);
    if (question.writes()) {
        if (entry.folder && twice) {
            session.queue.push([&session, question, to = session.dialogs.browser.listed() / entry.name] {
                go_into(session.dialogs, question, to);
            });
        }
        // The name of a file that is there may be meant for the new one.
        if (!entry.folder) session.dialogs.input.set_text(entry.name);
        return twice && !entry.folder;
    }
    return twice;
}

/// The keys that move through the list while the field has the others.
bool keys_in_list(Dialogs& dialogs, Settings& settings, const FileQuestion& question) {
    FileBrowser& browser = dialogs.browser;
    const ImGuiIO& io = ImGui::GetIO();
    if (browser.entries().empty() || io.KeyAlt) return false;
    int at = static_cast<int>(browser.cursor());
    const bool moved = move_picked(at, static_cast<int>(browser.entries().size()));
    const bool several = !question.writes();
    if (moved) {
        browser.choose(static_cast<std::size_t>(at), io.KeyShift && several  ? Choose::range
                                                     : io.KeyCtrl && several ? Choose::none
                                                                             : Choose::only);
    }
    constexpr std::array<std::pair<Key, const char*>, 3> kOrders{
        {{Key::n1, "name"}, {Key::n2, "size"}, {Key::n3, "date"}}};
    for (const auto& [key, column] : kOrders) {
        if (io.KeyCtrl && pressed(key)) order_by(settings, dialogs, column);
    }
    if (several && io.KeyCtrl && pressed(ImGuiKey_Space)) browser.choose(browser.cursor(), Choose::toggle);
    if (several && io.KeyCtrl && pressed(ImGuiKey_A) && dialogs.input.text.empty()) browser.choose_all();
    return moved;
}

/// Whether an entry was taken by a double click.
bool listing(Ui& ui, Dialogs& dialogs, Settings& settings, const FileQuestion& question, bool moved) {
    const FileBrowser& browser = dialogs.browser;
    const Columns columns = columns_of(ui, ImGui::GetContentRegionAvail().x - ImGui::GetStyle().ScrollbarSize);
    column_heads(ui, settings, dialogs, question, columns);
    ImGui::BeginChild("entries", {0, 0}, false);
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {0, 0});
    if (!browser.error().empty()) {
        words(ui.style.error, browser.error());
    } else if (browser.entries().empty()) {
        words(ui.style.quiet, question.writes()            ? "No such file is here yet."
                              : dialogs.input.text.empty() ? "There is nothing here that can be opened."
                                                           : "No name here contains this text.");
    }
    std::optional<std::size_t> clicked;
    ImGuiListClipper clipper;
    const std::vector<FileEntry>& entries = browser.entries();
    const NameList names(entries.size(), [&](std::size_t i) { return entries[i].name; });
    clipper.Begin(static_cast<int>(entries.size()));
    const int cursor = static_cast<int>(browser.cursor());
    if (moved) clipper.ForceDisplayRangeByIndices(cursor, cursor + 1);
    while (clipper.Step()) {
        for (int i = clipper.DisplayStart; i < clipper.DisplayEnd; ++i) {
            const auto index = static_cast<std::size_t>(i);
            if (file_row(ui, dialogs, entries[index], index, columns, names)) clicked = index;
            ui.mark_only(std::string(question.prefix) + ".entry." + entries[index].name);
            if (moved && i == cursor) ImGui::SetScrollHereY();
        }
    }
    ImGui::PopStyleVar();
    ImGui::EndChild();
    return clicked && clicked_entry(ui.session, question, *clicked);
}

// --- what a file holds

const FileSummary* summary_at_cursor(Ui& ui, Dialogs& dialogs) {
    const FileBrowser& browser = dialogs.browser;
    if (browser.entries().empty()) return nullptr;
    const std::filesystem::path file = browser.listed() / browser.entries()[browser.cursor()].name;
    const FileSummary* summary =
        dialogs.preview.ask(file, ui.now, !ui.session.options.attended, [&at = *ui.session.desktop] { at.wake(); });
    if (!summary) ui.want_frame_in(dialogs.preview.ask_again_in(ui.now));
    return summary;
}

void preview(Ui& ui, Dialogs& dialogs) {
    const FileBrowser& browser = dialogs.browser;
    if (browser.entries().empty()) return;
    const FileEntry& entry = browser.entries()[browser.cursor()];
    const std::vector<FileEntry>& entries = browser.entries();
    const NameList files(entries.size(), [&](std::size_t i) { return entries[i].name; });
    name_line(ui, ui.style.text, entry.name, ImGui::GetContentRegionAvail().x, files);
    const FileSummary* summary = summary_at_cursor(ui, dialogs);
    if (!summary) return text_line(ui.style.quiet, "Reading\u2026");
    words(summary->readable ? ui.style.quiet : ui.style.error, summary->title);
    ImGui::Dummy({0, ui.px(4)});
    const float end = ImGui::GetContentRegionAvail().x;
    for (const auto& [label, value] : summary->facts) {
        text_line(ui.style.quiet, label);
        ImGui::SameLine(ui.px(70));
        fitted_line(ui, ui.style.text, value, end - ui.px(70));
    }
    const NameList clips(summary->clips.size(), [&](std::size_t i) { return summary->clips[i].first; });
    for (const auto& [name, duration] : summary->clips) {
        const float width = text_size(*ui.style.mono, duration).x;
        name_line(ui, ui.style.text, name, end - width - ui.px(10), clips);
        ImGui::SameLine(end - width);
        text_line(ui.style.quiet, duration, ui.style.mono);
    }
    if (!summary->clips.empty() && summary->clip_count > summary->clips.size()) {
        text_line(ui.style.quiet, "and " + std::to_string(summary->clip_count - summary->clips.size()) + " more");
    }
    for (const std::string& warning : summary->warnings) {
        ImGui::Dummy({0, ui.px(2)});
        words(ui.style.warning, warning);
    }
}

/// In a line, where there is no room beside the list.
std::string in_a_line(Ui& ui, Dialogs& dialogs, bool has_preview) {
    const FileBrowser& browser = dialogs.browser;
    if (browser.chosen_count() > 1) return counted(browser.chosen_count(), "entry", "entries") + " chosen";
    const FileSummary* summary = has_preview ? nullptr : summary_at_cursor(ui, dialogs);
    return summary ? summary->title : "";
}

/// The next button goes on the same line if it fits there.
bool flowing_button(Ui& ui, const char* label, const std::string& mark, const char* help) {
    flow(button_width(label));
    const bool hit = marked_button(ui, label, mark.c_str());
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", help);
    return hit;
}

}  // namespace

void file_dialog(Ui& ui, Dialogs& dialogs, Settings& settings) {
    DialogInput& input = dialogs.input;
    FileBrowser& browser = dialogs.browser;
    const FileQuestion& question = *dialogs.question(dialogs.now);
    const std::string prefix = question.prefix;
    const auto enqueue = [&](void (*what)(Session&, const FileQuestion&)) {
        ui.later([question, what](Session& session) { what(session, question); });
    };
    if (input.generation == 0) begin(settings, ui.workspace, dialogs, question);
    begin_dialog(ui, "file", {kDialogWidth, kDialogHeight});
    dialog_title(ui, question.title);
    crumbs(ui, dialogs, question);

    // Backspace leads up where there is nothing to delete.
    const bool up =
        (input.text.empty() && pressed(ImGuiKey_Backspace)) || (ImGui::GetIO().KeyAlt && pressed(ImGuiKey_UpArrow));
    const auto complete = [&](const std::string& text) {
        return complete_path(text, browser.folder(), question.extensions());
    };
    const FieldEvents events = question.writes()
                                   ? text_field(ui, "A name", complete, FieldText::file_name)
                                   : text_field(ui, "A part of a name, or a path; Tab completes it", complete);
    ui.mark(prefix + ".path");
    browser.follow(input.text, !question.writes());
    settings.folder = ui.session.options.attended ? browser.way().back() : browser.folder();
    const bool moved = keys_in_list(dialogs, settings, question);
    if (ImGui::GetIO().KeyCtrl && pressed(Key::h)) browser.show_hidden(!browser.shows_hidden());

    const float room = ImGui::GetContentRegionAvail().x;
    const bool has_places = room >= ui.px(kPlacesWidth + kLeastList);
    const float preview_room = room - (has_places ? ui.px(kPlacesWidth) : 0);
    const bool has_preview =
        !question.writes() && !question.of_folder && preview_room >= ui.px(kPreviewWidth + kLeastList);
    const bool one_line = room >= ui.px(600);
    const float foot = (one_line ? 1.0f : 2.0f) * ImGui::GetFrameHeightWithSpacing() + ui.px(4);
    if (has_places) {
        ImGui::BeginChild("places", {ui.px(kPlacesWidth) - ui.px(12), -foot}, false);
        place_list(ui, settings, question);
        ImGui::EndChild();
        ImGui::SameLine(0, ui.px(12));
    }
    ImGui::BeginChild("files", {has_preview ? -ui.px(kPreviewWidth) : 0, -foot}, false);
    bool accepted = listing(ui, dialogs, settings, question, moved) || events.entered;
    ImGui::EndChild();
    if (has_preview) {
        ImGui::SameLine(0, ui.px(12));
        ImGui::BeginChild("preview", {0, -foot}, false);
        preview(ui, dialogs);
        ImGui::EndChild();
    }

    const bool agreed =
        marked_button(ui, input.confirming ? "Overwrite" : question.button, (prefix + ".ok").c_str(), true);
    accepted |= agreed && !question.of_folder;
    ImGui::SameLine();
    if (marked_button(ui, "Cancel", (prefix + ".cancel").c_str())) {
        ui.later(&Dialogs::close);
    }
    bool as_clips = agreed && question.of_folder;
    if (!question.writes() && !question.of_folder) {
        const bool has_clips =
            std::ranges::any_of(browser.entries(), is_clip) || folder_of_clips(browser) != browser.listed();
        if (has_clips) {
            as_clips = flowing_button(ui, "All clips of the folder", prefix + ".folder",
                                      "Every clip in the folder that is chosen, or else in this one (Ctrl+Enter)");
        }
        as_clips |= has_clips && pressed(ImGuiKey_Enter) && ImGui::GetIO().KeyCtrl;
    }
    flow(button_width("Hidden") + ui.px(24));
    bool hidden = browser.shows_hidden();
    if (ImGui::Checkbox("Hidden", &hidden)) browser.show_hidden(hidden);
    ui.mark(prefix + ".hidden");
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("Files and folders whose names begin with a dot (Ctrl+H)");
    const std::string line = input.confirming     ? "This file exists. Enter overwrites it."
                             : question.writes()  ? ""
                             : question.of_folder ? "Enter goes into a folder; the button takes it."
                                                  : in_a_line(ui, dialogs, has_preview);
    if (!line.empty()) {
        if (one_line) ImGui::SameLine();
        ImGui::AlignTextToFramePadding();
        fitted_line(ui, input.confirming ? ui.style.warning : ui.style.quiet, line, ImGui::GetContentRegionAvail().x);
    }
    end_dialog();
    if (as_clips) {
        ui.later([question](Session& session) { take(session, question, {folder_of_clips(session.dialogs.browser)}); });
    } else if (accepted) {
        enqueue(question.writes() ? take_written : take_read);
    } else if (up) {
        ui.later([&dialogs, question] { go_up(dialogs, question); });
    }
}

}  // namespace mobbscope::app
