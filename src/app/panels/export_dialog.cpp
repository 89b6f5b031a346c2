#include <app/commands/camera_commands.h>
#include <app/commands/command.h>
#include <app/commands/picture_order.h>
#include <app/panels/panels.h>
#include <app/ui/dialog_frame.h>
#include <app/ui/widgets.h>
#include <base/file.h>
#include <base/process.h>
#include <base/text.h>
#include <render/image/picture_names.h>
#include <render/pictures/played.h>
#include <scene/view_options.h>

#include <imgui_stdlib.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <exception>
#include <filesystem>
#include <functional>
#include <memory>
#include <set>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

namespace mobbscope::app {

namespace {

// Pixels at scale 1.
constexpr float kExportWidth = 1000;
constexpr float kExportHeight = 610;
constexpr float kSettingsWidth = 400;
constexpr int kLongestRest = 400;  // milliseconds that a preview waits for the hand to rest
constexpr int kMostLineRows = 6;   // of the command line, before it scrolls

void set_export(Ui& ui, std::string_view option, const std::string& text) {
    ui.invoke("picture." + std::string(option), text);
}

// --- the file

/// What becomes of the file; `why_not` where nothing can be written.
struct ExportTarget {
    std::filesystem::path file;
    bool is_there = false;
    std::string says, why_not{};
};

ExportTarget target_of(const Workspace& workspace, const Settings& settings, const Dialogs& dialogs) {
    ExportTarget out{export_file(workspace, settings, dialogs), false, ""};
    const std::filesystem::path& file = out.file;
    const std::filesystem::path folder = file.parent_path().empty() ? "." : file.parent_path();
    std::error_code ignored;
    const auto status = std::filesystem::status(file, ignored);
    if (std::filesystem::is_directory(status)) {
        out.why_not = "This is a folder: give the picture a name in it.";
    } else if (!is_picture_name(file) && !is_film_name(file)) {
        out.why_not = "Pictures are written as .png, .svg or .pdf, films as .mp4 or .webm: rename the file.";
    } else if (is_film_name(file) && !program_in_path("ffmpeg")) {
        out.why_not = "Films need ffmpeg, which is not in PATH: install it, or name a .png.";
    } else if (!std::filesystem::is_directory(folder, ignored)) {
        out.why_not = "There is no folder " + folder.string() + ".";
    } else if (::access(folder.c_str(), W_OK) != 0) {
        out.why_not = "Nothing can be written in " + folder.string() + ".";
    } else if (std::filesystem::exists(status)) {
        out.is_there = true;
        out.says = "Replaces a file of " + bytes_text(std::filesystem::file_size(file, ignored)) + ".";
    } else {
        out.says = "A new file.";
    }
    return out;
}

/// The text has the keys when the dialog opens. Whether Enter was pressed in it.
bool file_field(Ui& ui, Dialogs& dialogs, const ExportTarget& target) {
    const float browse = button_width("Browse...") + ImGui::GetStyle().ItemSpacing.x;
    ImGui::BeginChild("file", {-browse, ImGui::GetFrameHeight()});
    const FieldEvents events = text_field(ui, "The file to write: .png, for papers .svg or .pdf; a film .mp4 or .webm",
                                          {}, FieldText::file_name);
    ui.mark("export.path");
    ImGui::EndChild();
    dialogs.exporting.file = dialogs.input.text;
    ImGui::SameLine();
    if (marked_button(ui, "Browse...", "export.browse")) ui.invoke("picture.browse");
    ImGui::PushFont(ui.style.caption);
    const bool asks = dialogs.input.confirming;
    const std::string said = asks ? "This file exists. Enter overwrites it." : target.says;
    const bool refused = !target.why_not.empty();
    fitted_line(ui,
                refused ? ui.style.error
                : asks  ? ui.style.warning
                        : ui.style.quiet,
                refused ? target.why_not : said, ImGui::GetContentRegionAvail().x);
    ImGui::PopFont();
    return events.entered;
}

// --- the settings

/// The next widget, a box or a circle with a label, goes on the same line if it fits there, else below `left`.
void flow_below(Ui& ui, float left, const char* label) {
    const float width = ImGui::GetFrameHeight() + ImGui::GetStyle().ItemInnerSpacing.x + ImGui::CalcTextSize(label).x;
    const float end = ImGui::GetWindowPos().x + ImGui::GetWindowContentRegionMax().x;
    if (ImGui::GetItemRectMax().x + ui.px(12) + width <= end) return ImGui::SameLine(0, ui.px(12));
    ImGui::SetCursorPosX(left);
}

const ExportOption& export_option(std::string_view key) {
    return *std::ranges::find(export_options(), key, &ExportOption::key);
}

/// The choices of an option side by side, the present one filled. `why_not`: why a choice cannot be made, empty where
/// it can; null: all can. `titles`: others than the option has.
void choice_buttons(Ui& ui, Settings& settings, std::string_view key,
                    const std::function<std::string(const std::string&)>& why_not = {},
                    const std::vector<std::string>& titles = {}) {
    const ExportOption& option = export_option(key);
    const std::vector<std::string>& called = titles.empty() ? option.choice_titles : titles;
    const std::string now = option.text(settings.picture_export);
    const float left = ImGui::GetCursorPosX();
    for (std::size_t i = 0; i < option.choices.size(); ++i) {
        const std::string& choice = option.choices[i];
        const std::string& label = called.empty() ? choice : called[i];
        const std::string why = why_not ? why_not(choice) : "";
        if (i > 0) flow_below(ui, left, label.c_str());
        ImGui::BeginDisabled(!why.empty());
        if (ImGui::RadioButton((label + "##" + std::string(key)).c_str(), choice == now)) set_export(ui, key, choice);
        ImGui::EndDisabled();
        ui.mark("export." + std::string(key) + '.' + choice);
        if (!why.empty() && ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled)) {
            ImGui::SetTooltip("Not now: %s", why.c_str());
        }
    }
}

std::string size_label(const std::string& choice, PictureSize viewport) {
    if (choice == "viewport") return "As in the window, " + size_text(viewport);
    return size_text(parse_size(choice));
}

void size_presets(Ui& ui, Settings& settings, Views& views) {
    const ExportOption& option = export_option("size");
    const std::string now = option.text(settings.picture_export);
    const bool is_preset = std::ranges::find(option.choices, now) != option.choices.end();
    const PictureSize viewport = viewport_size(views);
    form_label(ui, "Size", "In pixels");
    if (!begin_dropdown(ui, "export.size", is_preset ? size_label(now, viewport) : "Other", "Size")) return;
    for (const std::string& choice : option.choices) {
        if (ImGui::Selectable(size_label(choice, viewport).c_str(), choice == now)) set_export(ui, "size", choice);
        ui.mark("export.size." + choice);
        if (choice == now) ui.focus.begin_here();
    }
    ImGui::EndCombo();
}

/// The range of a side that leaves both within what pictures may have, where the other follows in that shape.
std::pair<double, double> range_of_side(bool keeps, double side, double other) {
    const double factor = keeps ? side / other : 1;
    return {std::ceil(kMinSide * std::max(1.0, factor)), std::floor(kMaxSide * std::min(1.0, factor))};
}

void size_fields(Ui& ui, Dialogs& dialogs, Settings& settings, PictureSize size) {
    ExportDialog& dialog = dialogs.exporting;
    const bool keeps = settings.picture_export.keeps_shape;
    if (size != dialog.made || !keeps) dialog.shape = dialog.made = size;
    form_label(ui, "", nullptr);
    const float left = ImGui::GetCursorPosX();
    const float cross = ImGui::CalcTextSize(" x ").x;
    const float lock = ImGui::GetFrameHeight() + ImGui::CalcTextSize("Keep shape").x + ui.px(20);
    const float width = std::max(ui.px(62), (ImGui::GetContentRegionAvail().x - cross - lock) / 2);
    PictureSize wanted = size;
    const auto side = [&](const char* mark, const char* what, int PictureSize::*own, int PictureSize::*other) {
        const auto [least, most] = range_of_side(keeps, dialog.shape.*own, dialog.shape.*other);
        ImGui::SetNextItemWidth(width);
        const auto given = number_field(ui, {.mark = mark,
                                             .what = what,
                                             .now = static_cast<double>(size.*own),
                                             .step = 16,
                                             .least = least,
                                             .most = most});
        if (!given) return;
        wanted.*own = static_cast<int>(*given);
        if (!keeps) return;
        const double factor = static_cast<double>(dialog.shape.*other) / dialog.shape.*own;
        wanted.*other = std::clamp(static_cast<int>(std::lround(*given * factor)), kMinSide, kMaxSide);
    };
    side("export.width", "The width", &PictureSize::width, &PictureSize::height);
    ImGui::SameLine(0, 0);
    ImGui::TextDisabled(" x ");
    ImGui::SameLine(0, 0);
    side("export.height", "The height", &PictureSize::height, &PictureSize::width);
    flow_below(ui, left, "Keep shape");
    bool keep = keeps;
    if (ImGui::Checkbox("Keep shape", &keep)) set_export(ui, "shape", keep ? "kept" : "free");
    ui.mark("export.shape");
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("Changing one side changes the other");
    if (wanted == size) return;
    if (keeps) dialog.made = wanted;
    ui.invoke("picture.size", size_word(wanted));
}

/// A number of an option that may be "auto"; `given`: it is not.
std::optional<double> field_with_reset(Ui& ui, std::string_view key, bool given, const NumberField& field) {
    const float reset = button_width("reset") + ui.px(6);
    ImGui::SetNextItemWidth(given ? -reset : -1);
    const auto wanted = number_field(ui, field);
    if (!given) return wanted;
    ImGui::SameLine(0, ui.px(6));
    if (ImGui::Button(("reset##" + std::string(key)).c_str())) set_export(ui, key, "auto");
    ui.mark(field.mark + ".reset");
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("As it suits");
    return wanted;
}

void scale_field(Ui& ui, Settings& settings, const PictureOrder& order) {
    const double given = settings.picture_export.scale;
    form_label(ui, "Text and lines", "How large they are: 1 suits 1280 x 720");
    const auto wanted =
        field_with_reset(ui, "scale", given > 0,
                         {.mark = "export.scale",
                          .what = "The scale of text and lines",
                          .now = given > 0 ? given : metrics_of(order.options.size, order.options.scale).scale,
                          .before = given > 0 ? "" : "auto: ",
                          .unit = "times",
                          .least = kLeastScale,
                          .most = kMostScale,
                          .by_factors = true});
    if (wanted) set_export(ui, "scale", formatted("%.3g", *wanted));
}

/// What the picture has, each to be left out of it; what the view does not show either is disabled.
void shown_boxes(Ui& ui, Settings& settings) {
    const std::set<std::string>& without = settings.picture_export.without;
    const float column = ImGui::GetContentRegionAvail().x / 2;
    const float left = ImGui::GetCursorPosX();
    int index = 0;
    for (const ViewOption& option : view_options()) {
        const bool may_be = option.may_be_seen ? option.may_be_seen(ui.workspace.view()) : true;
        if (option.without.empty() || !may_be) continue;
        if (index++ % 2 == 1) ImGui::SameLine(left + column);
        const std::string key(option.key);
        const bool is_seen = can_leave_out(option, ui.workspace.view());
        bool shown = is_seen && !without.contains(key);
        ImGui::BeginDisabled(!is_seen);
        if (ImGui::Checkbox(std::string(option.title).c_str(), &shown)) {
            PictureExport next = settings.picture_export;
            shown ? static_cast<void>(next.without.erase(key)) : static_cast<void>(next.without.insert(key));
            set_export(ui, "without", export_option("without").text(next));
        }
        ImGui::EndDisabled();
        ui.mark("export.without." + key);
        if (!is_seen && ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled)) {
            ImGui::SetTooltip("The window does not show it either: View / Show");
        }
    }
}

/// What a film goes through, and how fast.
void film_fields(Ui& ui, Settings& settings, const PictureOrder& order) {
    const PictureExport& wanted = settings.picture_export;
    const bool steps = plays_steps(order.view);
    form_label(ui, "Film of", "The motion, or where a query is shown its steps; or the scene from all around");
    choice_buttons(ui, settings, "film", {}, {steps ? "The query's steps" : "The motion", "Once around"});
    if (wanted.film_turns) {
        form_label(ui, "Pictures", "Once around");
        ImGui::SetNextItemWidth(-1);
        const auto count = number_field(ui, {.mark = "export.turntable",
                                             .what = "The number of pictures once around",
                                             .now = static_cast<double>(wanted.turntable),
                                             .step = 10,
                                             .least = 1,
                                             .most = kMostTurntable});
        if (count) set_export(ui, "turntable", formatted("%.0f", *count));
    }
    form_label(ui, "Rate", "Pictures a second");
    const auto rate = field_with_reset(ui, "rate", wanted.rate > 0,
                                       {.mark = "export.rate",
                                        .what = "The pictures a second",
                                        .now = film_pace(played_of(order.view, wanted.film_turns), wanted.rate).rate,
                                        .before = wanted.rate > 0 ? "" : "auto: ",
                                        .unit = "a second",
                                        .least = 1 / kMostFilmRate,
                                        .most = kMostFilmRate,
                                        .by_factors = true});
    if (rate) set_export(ui, "rate", format_double(*rate));
}

void settings_fields(Ui& ui, Settings& settings, Views& views, Dialogs& dialogs, const PictureOrder& order,
                     const std::string& why_no_size) {
    if (order.film) film_fields(ui, settings, order);
    size_presets(ui, settings, views);
    size_fields(ui, dialogs, settings, order.options.size);
    if (!why_no_size.empty()) words(ui.style.error, why_no_size);
    scale_field(ui, settings, order);
    form_label(ui, "Samples", "Per pixel: more make smoother edges");
    choice_buttons(ui, settings, "samples", [&](const std::string& count) {
        return ui.session.picture_maker->why_no_samples(parse_samples(count));
    });
    if (!order.film) {
        form_label(ui, "Background", "Transparent where nothing is drawn");
        choice_buttons(ui, settings, "background");
    }
    form_label(ui, "Theme", "Of the picture alone");
    choice_buttons(ui, settings, "theme");
    heading(ui, order.film ? "IN THE FILM" : "IN THE PICTURE");
    shown_boxes(ui, settings);
}

// --- the preview

void make_preview(Session& session) {
    ExportDialog& dialog = session.dialogs.exporting;
    const auto begun = std::chrono::steady_clock::now();
    dialog.shown = dialog.wanted;
    dialog.image.reset();
    dialog.why_not.clear();
    try {
        const int divisor = dialog.shown.divisor;
        // What has not been counted of the scene's queries is not for a preview: that takes long.
        const DrawList list =
            draw_list_of(session.workspace, order_to_export(session.settings, session.workspace, session.views),
                         session.figures.known());
        dialog.image =
            std::make_shared<const Image>(shrunk(session.picture_maker->draw_coarse(list, divisor), divisor));
    } catch (const std::exception& error) {
        dialog.why_not = error.what();
    }
    dialog.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();
}

/// Has a preview made for so much room, in pixels, if it is not there.
void want_preview(Ui& ui, const PictureOrder& order, ImVec2 room) {
    ExportDialog& dialog = ui.session.dialogs.exporting;
    const PictureSize size = order.options.size;
    const double times = std::max(size.width / std::max<double>(room.x, 1), size.height / std::max<double>(room.y, 1));
    ExportDialog::Preview wanted{ui.workspace.document().fitted,
                                 order.view,
                                 order.options,
                                 order.select ? text_of(*order.select) : "",
                                 std::max(1, static_cast<int>(std::ceil(times))),
                                 ui.session.figures.known()->revision()};
    if (!wanted.same_picture(dialog.wanted)) {
        dialog.wanted = std::move(wanted);
        dialog.wanted_since = ui.now;
    }
    if (dialog.wanted.same_picture(dialog.shown)) return;
    const double wait = ui.session.options.attended ? std::min(dialog.seconds, 1e-3 * kLongestRest) : 0;
    const double due = dialog.wanted_since + wait - ui.now;
    if (due > 0) return ui.want_frame_in(due);
    ui.later([](Session& session) { make_preview(session); });
}

void draw_preview(Ui& ui, Dialogs& dialogs, const PictureOrder& order, float height) {
    const ExportDialog& dialog = dialogs.exporting;
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    const ImVec2 room{ImGui::GetContentRegionAvail().x, height};
    want_preview(ui, order, room);
    const auto width_of = static_cast<float>(order.options.size.width);
    const auto height_of = static_cast<float>(order.options.size.height);
    const float scale = std::min({room.x / width_of, room.y / height_of, 1.0f});
    const ImVec2 from{corner.x + std::round((room.x - scale * width_of) / 2),
                      corner.y + std::round((room.y - scale * height_of) / 2)};
    const ImVec2 to{from.x + scale * width_of, from.y + scale * height_of};
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    draw.AddRectFilled(corner, {corner.x + room.x, corner.y + room.y}, ui.style.window, ui.px(3));
    const ImTextureID texture = dialog.image ? ui.painter.image(0, dialog.image, true) : ImTextureID{};
    if (texture) draw.AddImage(texture, from, to);
    draw.AddRect(from, to, ui.style.border);
    if (!dialog.image && !dialog.why_not.empty()) {
        ImGui::PushTextWrapPos(0);
        words(ui.style.error, dialog.why_not);
        ImGui::PopTextWrapPos();
    }
    ImGui::SetCursorScreenPos(corner);
    ImGui::Dummy(room);
    ui.mark_only("export.preview");
}

/// What is exported, and as what.
std::string exported_subject(const Workspace& workspace, const Files& files, const Views& views) {
    std::string out = "What the window shows of " + workspace.title();
    if (!files.visited().empty()) out = "The scene of the case " + files.visited();
    if (views.count() < 2) return out;
    const std::size_t place = views.active();
    const std::string between = views.count() == 3 ? "the middle" : place == 1 ? "the second" : "the third";
    const std::string which = place == 0 ? "the left" : place + 1 == views.count() ? "the right" : between;
    return out + ", " + which + " view alone (" +
           std::string(mobb::info(workspace.document().fitted->options().tree).label) + ")";
}

// --- the command line

/// A line in rows of at most so many characters, an option with its value on one; a shell takes the rows together as
/// the line.
std::string in_rows(const std::string& line, std::size_t columns) {
    std::string out, row;
    std::size_t begin = 0;
    while (begin < line.size()) {
        std::size_t end = begin;
        bool quoted = false;
        for (; end < line.size(); ++end) {
            if (line[end] == '\'') quoted = !quoted;
            const bool option_follows = line.compare(end, 3, " --") == 0 || line.compare(end, 3, " -o") == 0;
            if (!quoted && option_follows) break;
        }
        const std::string part = line.substr(begin, end - begin);
        if (!row.empty() && row.size() + part.size() + 3 > columns) {
            out += row + " \\\n";
            row = "  " + part;
        } else {
            row += (row.empty() ? "" : " ") + part;
        }
        begin = end + 1;
    }
    return out + row;
}

void command_line(Ui& ui, Files& files, Dialogs& dialogs, const PictureOrder& order, const ExportTarget& target) {
    const auto line = render_line(ui.workspace, files, dialogs, order, target.file.string());
    const ImVec2 room = ImGui::GetContentRegionAvail();
    if (!line) {
        words(
            ui.style.quiet,
            "The scene has unsaved changes. Copy command line writes it to a temporary file, and shows the line here.");
        ui.mark_only("export.no_line");
        return;
    }
    ImGui::PushFont(ui.style.mono);
    const float character = ImGui::CalcTextSize("0").x;
    const float inside = room.x - 2 * ImGui::GetStyle().FramePadding.x - ImGui::GetStyle().ScrollbarSize;
    std::string text = in_rows(*line, static_cast<std::size_t>(std::max(inside / character, 20.0f)));
    ImGui::InputTextMultiline("##line", &text, room, ImGuiInputTextFlags_ReadOnly);
    ui.mark("export.line");
    ImGui::PopFont();
}

/// The height that the command line takes.
float command_line_height() {
    return kMostLineRows * ImGui::GetTextLineHeight() + 2 * ImGui::GetStyle().FramePadding.y;
}

// --- the buttons

void export_now(Ui& ui, const ExportTarget& target) {
    if (target.is_there && !ui.session.dialogs.input.confirming && ui.session.dialogs.exporting.agreed != target.file) {
        ui.session.dialogs.input.confirming = true;
        ui.session.dialogs.input.fresh = true;  // another name may be typed
        return;
    }
    ui.later([file = target.file](Session& session) {
        try {
            run_command(session, "picture.write", file.string());
            session.dialogs.exporting.agreed = file;
            if (session.dialogs.now == Dialog::export_picture) session.dialogs.close();
        } catch (const std::exception& error) {
            session.notifications.tell(MessageLevel::error, error.what());
            session.dialogs.input.confirming = false;
        }
    });
}

/// A button of a command; disabled, it says why.
void export_command(Ui& ui, const char* label, const char* id, const std::string& why_no_picture) {
    const Command& command = *find_command(id);
    const std::string why = why_no_picture.empty() ? std::string(why_not(ui.session, command)) : why_no_picture;
    ImGui::BeginDisabled(!why.empty());
    if (ImGui::Button(label)) ui.invoke(id);
    ImGui::EndDisabled();
    ui.mark("export" + std::string(id).substr(std::string_view("picture").size()));
    if (ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled)) {
        ImGui::SetTooltip("%s", why.empty() ? std::string(command.doc).c_str() : ("Not now: " + why).c_str());
    }
}

/// Whether it is to be exported.
bool export_buttons(Ui& ui, Dialogs& dialogs, bool film, const std::string& why_no_picture,
                    const std::string& why_not) {
    ImGui::BeginDisabled(!why_not.empty());
    const bool pressed_it =
        marked_button(ui, dialogs.input.confirming ? "Overwrite" : "Export", "export.ok", why_not.empty());
    ImGui::EndDisabled();
    if (!why_not.empty() && ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled)) {
        ImGui::SetTooltip("%s", why_not.c_str());
    }
    ImGui::SameLine();
    if (!film) {
        export_command(ui, "Copy picture", "picture.copy", why_no_picture);
        ImGui::SameLine();
    }
    export_command(ui, "Copy command line", "picture.copy_command", why_no_picture);
    ImGui::SameLine();
    const float close = button_width("Close");
    ImGui::SetCursorPosX(std::max(ImGui::GetCursorPosX(), ImGui::GetWindowContentRegionMax().x - close));
    if (marked_button(ui, "Close", "export.close")) ui.later(&Dialogs::close);
    return pressed_it;
}

}  // namespace

void export_dialog(Ui& ui) {
    if (ui.workspace.empty()) {
        ui.later(&Dialogs::close);  // what was to be exported is closed
        return;
    }
    const bool keys_are_taken = ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopup) || ImGui::GetIO().WantTextInput;
    const ExportTarget target = target_of(ui.workspace, ui.session.settings, ui.session.dialogs);
    const PictureOrder order = ordered_for(
        target.file, order_to_export(ui.session.settings, ui.workspace, ui.session.views), ui.session.settings);
    std::string why_no_size, film, why_no_film;
    try {
        check(order.options);
    } catch (const std::invalid_argument& error) {
        why_no_size = error.what();
    }
    try {
        if (order.film && why_no_size.empty()) film = film_text(ui.workspace, order);
    } catch (const std::invalid_argument& error) {
        why_no_film = error.what();
    }
    begin_dialog(ui, "export", {kExportWidth, kExportHeight});
    text_line(ui.style.text, order.film ? "Export film" : "Export picture", ui.style.title);
    ImGui::SameLine(0, ui.px(14));
    ImGui::AlignTextToFramePadding();
    fitted_line(ui, ui.style.quiet, exported_subject(ui.workspace, ui.session.files, ui.session.views),
                ImGui::GetContentRegionAvail().x);
    const bool entered = file_field(ui, ui.session.dialogs, target);
    const float foot = ImGui::GetFrameHeight() + 3 * ImGui::GetStyle().ItemSpacing.y + ui.px(2);
    const float height = ImGui::GetContentRegionAvail().y - foot;
    const float left = std::min(ui.px(kSettingsWidth), 0.48f * ImGui::GetContentRegionAvail().x);
    ImGui::BeginChild("settings", {left, height});
    settings_fields(ui, ui.session.settings, ui.session.views, ui.session.dialogs, order, why_no_size);
    ImGui::EndChild();
    ImGui::SameLine(0, ui.px(14));
    ImGui::BeginChild("result", {0, height});
    const float caption = ui.style.caption->FontSize + 2 * ImGui::GetStyle().ItemSpacing.y;
    const float lines = std::min(command_line_height(), 0.4f * height);
    const float said = order.film ? ImGui::GetTextLineHeightWithSpacing() : 0;
    if (why_no_size.empty())
        draw_preview(ui, ui.session.dialogs, order, std::max(height - lines - caption - said, ui.px(40)));
    if (order.film) {
        fitted_line(ui, why_no_film.empty() ? ui.style.text : ui.style.error, film + why_no_film,
                    ImGui::GetContentRegionAvail().x);
        ui.mark_only("export.length");
    }
    text_line(ui.style.quiet, "COMMAND LINE THAT DOES THE SAME", ui.style.caption);
    if (why_no_size.empty()) command_line(ui, ui.session.files, ui.session.dialogs, order, target);
    ImGui::EndChild();
    ImGui::Dummy({0, ui.px(2)});
    std::string why_not = target.why_not;
    for (const std::string* why : {&why_no_film, &why_no_size}) {
        if (!why->empty()) why_not = *why;
    }
    bool wanted = export_buttons(ui, ui.session.dialogs, order.film.has_value(), why_no_size, why_not);
    wanted |= entered || (pressed(ImGuiKey_Enter) && !keys_are_taken);
    end_dialog();
    if (wanted && why_not.empty()) export_now(ui, target);
}

}  // namespace mobbscope::app
