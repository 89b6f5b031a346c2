#include <app/commands/arguments.h>
#include <app/commands/camera_commands.h>
#include <app/commands/command.h>
#include <base/file.h>
#include <base/text.h>
#include <render/drawlist/view_projection.h>
#include <render/parts/highlights.h>
#include <render/pictures/build_draw_list.h>
#include <scene/arrangement.h>
#include <scene/drawn_agent.h>
#include <scene/view_options.h>

#include <initializer_list>
#include <stdexcept>
#include <vector>

namespace mobbscope::app {

namespace {

void open_file(Session& session, const std::string& file) {
    if (file.empty()) return session.open_dialog(Dialog::open);
    session.open(paths_in(file));
}

void add_file(Session& session, const std::string& file) {
    if (file.empty()) return session.open_dialog(Dialog::add);
    session.add(paths_in(file));
}

void review_folder(Session& session, const std::string& folder) {
    if (folder.empty()) return session.open_dialog(Dialog::review);
    session.review(folder);
}

std::vector<std::string> recent_names(const Session& session) {
    std::vector<std::string> out;
    for (const auto& file : session.settings.recent) out.push_back(file.string());
    return out;
}

void save_as(Session& session, const std::string& file) {
    if (file.empty()) return session.open_dialog(Dialog::save_as);
    session.save_as(file);
}

void export_picture(Session& session, const std::string& file) {
    if (file.empty()) return session.open_dialog(Dialog::export_picture);
    check_file_name(file);
    session.check_may_write(file);
    if (lower_extension(file) != ".png") {
        throw InputError(file, "", "pictures are written as .png; rename the output");
    }
    if (!session.hooks.export_picture) throw std::invalid_argument("there is no window to take a picture of");
    session.hooks.export_picture(file);
    session.tell(Message::Level::info, "Wrote " + file);
}

// --- "Copy as command"

[[noreturn]] void ask_to_save() {
    throw std::invalid_argument(
        "save the scene first (Ctrl+S): this picture shows more than its files and the options of a command say");
}

/// Numbers with commas between them.
std::string with_commas(std::initializer_list<double> numbers) {
    std::string out;
    for (const double number : numbers) out += (out.empty() ? "" : ",") + short_double(number);
    return out;
}

/// The options that lead from one camera to another; the file's is taken as it is.
std::string camera_options(const Camera& file, const Camera& now) {
    if (now == file) return "";
    Camera reached = file;  // as `render` applies the options
    reached.preset = now.preset;
    std::string out = " --view " + std::string(name(now.preset));
    if (now.preset == CameraPreset::free) {
        reached.yaw_deg = now.yaw_deg;
        reached.pitch_deg = now.pitch_deg;
        out += " --yaw " + short_double(now.yaw_deg) + " --pitch " + short_double(now.pitch_deg);
    }
    if (orientation(now).perspective != orientation(reached).perspective) {
        out += now.perspective ? " --perspective" : " --ortho";
    }
    if (now.fov_deg != file.fov_deg && (orientation(now).perspective || now.target)) {
        out += " --fov " + short_double(now.fov_deg);
    }
    if (!now.target) return out;
    out += " --target " + with_commas({now.target->x, now.target->y, now.target->z});
    out += " --distance " + short_double(now.distance);
    if (now.shift != glm::dvec2(0)) out += " --shift " + with_commas({now.shift.x, now.shift.y});
    return out;
}

std::string view_line(const Scene& scene, const ViewState& now) {
    const ViewState& file = scene.view;
    const std::vector<std::string> agents = names_in_view(scene);
    std::string out = camera_options(file.camera, now.camera);
    ViewState reached = file;  // as `render` applies the options
    reached.camera = now.camera;
    for (const ViewOption& option : view_options()) {
        const bool needed = option.needed ? option.needed(reached, now) : !option.same(reached, now);
        if (!needed) continue;
        if (option.option.empty()) ask_to_save();
        out += in_command_line(option, now, agents);
        if (option.names) {
            reached.*option.names = now.*option.names;
        } else {
            parse_option(option, option.text(now), agents, reached);
        }
    }
    return out;
}

/// The options of the fit in use, where the file's may be another.
std::string fit_options(const FittedScene& fitted) {
    if (fitted.fits().size() == 1) return "";
    const mobb::FitOptions& fit = fitted.options();
    return " --tree " + std::string(mobb::name(fit.tree)) + " --leaf " + std::to_string(fit.leaf) + " --levels " +
           std::to_string(fit.levels) + " --axes " + std::string(mobb::name(fit.axes)) + " --time-scale " +
           short_double(fit.time_scale);
}

/// The option that highlights what is selected; empty where the picture shows nothing of it.
std::string select_option(const Session& session, PictureSize size) {
    const Selection& selected = session.selection;
    const FittedScene& fitted = session.fitted();
    if (!selected.on_path()) return "";
    const auto agent = index_in_view(fitted, session.view(), selected.path);
    if (!agent) return "";
    try {
        const std::vector<DrawnAgent> agents = drawn_agents(fitted, session.view());
        const NamedPart named{agents.at(static_cast<std::size_t>(*agent)).name, selected.part()};
        DrawList list;
        static_cast<PictureFrame&>(list) = picture_frame(fitted, session.view(), size);
        add_selection(list, fitted, session.view(), named, 1);
        return " --select " + shell_word(text_of(named));
    } catch (const std::invalid_argument&) {
        return "";
    }
}

/// "mobbscope render ..." that draws the present picture in the viewport's size, quoted for a shell. Throws
/// std::invalid_argument, saying that the scene must be saved first, if its files and the command's options do not tell
/// the whole picture.
std::string render_line(const Session& session) {
    const std::filesystem::path& file = session.scene().file;
    const bool one_file =
        session.opened().empty() || (session.opened().size() == 1 && session.opened().front() == file);
    if (session.modified() || session.in_excerpt() || !one_file || file.empty()) ask_to_save();
    const PictureSize size = viewport_size(session);
    // 0: what suits the size, as `render` takes it without being told.
    const double words = session.hooks.viewport_scale ? session.hooks.viewport_scale() : 0;
    const std::string scale = words > 0 ? " --scale " + short_double(words) : "";
    // Of an unchanged scene, its `view` is the one in the file.
    return "mobbscope render " + shell_word(file.string()) + fit_options(*session.document().fitted) +
           view_line(session.scene(), session.view()) + select_option(session, size) + " --size " +
           std::to_string(size.width) + 'x' + std::to_string(size.height) + scale + " -o picture.png";
}

void copy_command(Session& session) {
    const std::string line = render_line(session);
    if (session.hooks.set_clipboard) session.hooks.set_clipboard(line);
    session.tell(Message::Level::info, "Copied: " + line);
}

}  // namespace

std::vector<Command> file_commands() {
    const std::vector<Command> rows{
        Command(
            "file.open", "Open...",
            "Opens a scene, a capture, clips, or a folder of clips, in place of what is open. Several files stand in "
            "quotes.",
            open_file, {.shortcut = "Ctrl+O", .argument = "[FILE]", .enabled = always}),
        Command("file.add", "Add files...", "Adds clips, or the agents and clips of another scene, to what is open.",
                add_file, {.argument = "[FILE]", .enabled = always}),
        Command("file.recent", "Open recent", "Opens a file that was open before.",
                [](Session& session, const std::string& file) { session.open({file}); },
                {.argument = "FILE", .enabled = always, .choices = recent_names}),
        Command(
            "file.reopen_last", "Reopen last session",
            "Opens what was open when the window was closed last, as it was seen.", &Session::reopen_last,
            {.enabled = {&Session::has_last,
                         [](const Session&) -> std::string_view { return "there is none, or its files are gone"; }}}),
        Command("file.demo", "Open the demo",
                "Opens the scene that comes with the program: two walkers whose paths cross, but not in time.",
                &Session::open_demo, {.enabled = always}),
        Command("file.review", "Review picture tests...",
                "Draws the picture tests of a folder and shows what differs from their goldens.", review_folder,
                {.argument = "[FOLDER]", .enabled = always}),
        Command("file.reload", "Reload",
                "Reads what is open again from its files, when another program has changed them.",
                [](Session& session) { session.open(std::vector<std::filesystem::path>(session.opened())); },
                {.shortcut = "F5", .enabled = [](const Session& session) { return !session.opened().empty(); }}),
        Command("file.save", "Save", "Writes the scene and how it is seen to its file.", &Session::save,
                {.shortcut = "Ctrl+S"}),
        Command("file.save_as", "Save as...",
                "Writes the scene to another file; its clips are still read from where they are.", save_as,
                {.shortcut = "Ctrl+Shift+S", .argument = "[FILE]"}),
        Command("file.export_picture", "Export picture...",
                "Writes the picture in the middle of the window to a PNG file.", export_picture,
                {.shortcut = "Ctrl+E", .argument = "[FILE.png]"}),
        Command("file.copy_command", "Copy as command",
                "Copies the command line that draws this picture again without a window.", copy_command,
                {.shortcut = "Ctrl+Shift+C"}),
        Command("file.quit", "Quit", "Ends the program; asks first if there are unsaved changes.",
                &Session::request_close, {.shortcut = "Ctrl+Q", .enabled = always}),
    };
    return in_menu("File", rows);
}

}  // namespace mobbscope::app
