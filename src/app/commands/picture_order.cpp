#include <app/commands/camera_commands.h>
#include <app/commands/picture_order.h>
#include <base/error.h>
#include <base/file.h>
#include <base/text.h>
#include <render/drawlist/view_projection.h>
#include <render/image/picture_names.h>
#include <render/image/png.h>
#include <render/pictures/build_draw_list.h>
#include <render/pictures/kept_paths.h>
#include <render/pictures/played.h>
#include <scene/arrangement.h>
#include <scene/drawn_agent.h>
#include <scene/scene_edits.h>
#include <scene/view_options.h>

#include <stdlib.h>

#include <cerrno>
#include <cstring>
#include <initializer_list>
#include <stdexcept>
#include <system_error>
#include <utility>
#include <vector>

namespace mobbscope::app {

namespace {

/// What is selected, where the picture shows it.
std::optional<NamedPart> selected_part(const Workspace& workspace, const PictureOrder& order) {
    const Selection& selected = workspace.selection;
    const FittedScene& fitted = workspace.fitted();
    if (!selected.on_path()) return std::nullopt;
    const auto agent = index_in_view(fitted, order.view, selected.path);
    if (!agent) return std::nullopt;
    try {
        const std::vector<DrawnAgent> agents = drawn_agents(fitted, order.view);
        NamedPart named{agents.at(static_cast<std::size_t>(*agent)).name, selected.part()};
        DrawList list;
        static_cast<PictureFrame&>(list) = picture_frame(fitted, order.view, order.options.size);
        add_selection(list, fitted, order.view, named, 1);
        return named;
    } catch (const std::invalid_argument&) {
        return std::nullopt;
    }
}

void select_in(const Workspace& workspace, PictureOrder& order) {
    order.select = selected_part(workspace, order);
    if (order.select) order.options.selected = order.select->agent;
}

// --- the command line

/// Numbers with commas between them.
std::string with_commas(std::initializer_list<double> numbers) {
    std::string out;
    for (const double number : numbers) out += (out.empty() ? "" : ",") + format_double(number);
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
        out += " --yaw " + format_double(now.yaw_deg) + " --pitch " + format_double(now.pitch_deg);
    }
    if (orientation(now).perspective != orientation(reached).perspective) {
        out += now.perspective ? " --perspective" : " --ortho";
    }
    if (now.fov_deg != file.fov_deg && (orientation(now).perspective || now.target)) {
        out += " --fov " + format_double(now.fov_deg);
    }
    if (!now.target) return out;
    out += " --target " + with_commas({now.target->x, now.target->y, now.target->z});
    out += " --distance " + format_double(now.distance);
    if (now.shift != glm::dvec2(0)) out += " --shift " + with_commas({now.shift.x, now.shift.y});
    return out;
}

/// Agents have the places of those that are drawn, but in a run, which shows no part of a tree alone.
std::string subtree_option(const ViewState& view, const std::vector<std::string>& agents) {
    if (!view.subtree) return " --subtree none";
    const std::string& agent = agents.at(static_cast<std::size_t>(view.subtree->agent));
    return " --subtree " + shell_word(agent + ':' + std::to_string(view.subtree->node));
}

/// The options that lead from the view of a file with these agents to another; none if that takes more than options.
std::optional<std::string> view_options_between(const ViewState& file, const ViewState& now,
                                                const std::vector<std::string>& agents) {
    std::string out = camera_options(file.camera, now.camera);
    ViewState reached = file;  // as `render` applies the options
    reached.camera = now.camera;
    reached.subtree = now.subtree;
    // A query shows no part of a tree alone.
    if (now.subtree != file.subtree && !now.query) out += subtree_option(now, agents);
    for (const ViewOption& option : view_options()) {
        const bool needed = option.needed ? option.needed(reached, now) : !option.same(reached, now);
        if (!needed) continue;
        if (option.option.empty()) return std::nullopt;
        out += in_command_line(option, now, agents);
        if (option.names) {
            reached.*option.names = now.*option.names;
        } else {
            parse_option(option, option.text(now), agents, reached);
        }
    }
    return out;
}

/// The options of a fit.
std::string fit_options(const mobb::FitOptions& fit) {
    return " --tree " + std::string(mobb::name(fit.tree)) + " --leaf " + std::to_string(fit.leaf) + " --levels " +
           std::to_string(fit.levels) + " --axes " + std::string(mobb::name(fit.axes)) + " --time-scale " +
           format_double(fit.time_scale);
}

std::string picture_options(const PictureOptions& options) {
    std::string out = " --size " + size_word(options.size);
    if (options.scale > 0) out += " --scale " + format_double(options.scale);
    if (options.samples != kPictureSamples) out += " --samples " + std::to_string(options.samples);
    if (options.background) out += " --background transparent";
    return out;
}

std::string film_options(const FilmOrder& film) {
    std::string out = film.turns ? " --turntable " + std::to_string(film.turntable) : " --play";
    if (film.rate > 0) out += " --rate " + format_double(film.rate);
    return out;
}

/// What a film goes through is not said of its view.
ViewState view_of(const PictureOrder& order, const ViewState& file) {
    ViewState out = order.view;
    if (!order.film || order.film->turns) return out;
    if (plays_steps(out)) {
        out.step = file.step;
    } else {
        out.time = file.time;
    }
    return out;
}

/// Whether the one file that was opened holds the scene.
bool is_in_its_file(const Workspace& workspace, const Files& files) {
    const std::filesystem::path& file = workspace.scene().file;
    const bool one_file =
        workspace.opened.empty() || (workspace.opened.size() == 1 && workspace.opened.front() == file);
    // The scene of a case is seen and fitted as the case says, not as its file.
    const bool as_file = !workspace.modified() && !workspace.in_excerpt() && files.visited().empty();
    return as_file && one_file && !file.empty();
}

/// A file that holds a scene, seen so.
struct SceneFile {
    const std::filesystem::path& path;
    const Scene& scene;
    const ViewState& view;
};

/// The line that draws a file's scene as ordered; `fit`: the options of the fit, where they are not the file's.
std::optional<std::string> render_line_of(const SceneFile& file, const std::string& fit, const PictureOrder& order,
                                          const std::string& output) {
    const auto view = view_options_between(file.view, view_of(order, file.view), names_in_view(file.scene));
    if (!view) return std::nullopt;
    const std::string select = order.select ? " --select " + shell_word(text_of(*order.select)) : "";
    const std::string measure = order.measure ? " --measure " + text_of(*order.measure) : "";
    return "mobbscope render " + shell_word(file.path.string()) + fit + *view + select + measure +
           picture_options(order.options) + (order.film ? film_options(*order.film) : "") + " -o " + shell_word(output);
}

/// A new file in a new folder, which nobody else can have.
std::filesystem::path temporary_scene_file(const std::string& title) {
    std::error_code error;
    std::filesystem::path folder = std::filesystem::temp_directory_path(error);
    if (error) folder = "/tmp";
    std::string name = (folder / "mobbscope-XXXXXX").string();
    if (!::mkdtemp(name.data())) {
        throw MachineError(folder.string() + ": no temporary folder can be made there: " + std::strerror(errno));
    }
    const std::string stem = std::filesystem::path(title).stem().string();
    return std::filesystem::path(name) / ((stem.empty() ? "scene" : stem) + ".json");
}

/// Throws MachineError, and leaves nothing, if it cannot be written.
std::filesystem::path write_temporary_scene(const FittedScene& fitted, const std::string& title,
                                            const ViewState& view) {
    Scene temporary = fitted.scene();
    temporary.view = view;
    temporary.fit = fitted.options();
    std::filesystem::path file = temporary_scene_file(title);
    try {
        move_to_file(temporary, file);
        write_file(file, to_json(temporary));
    } catch (...) {
        std::error_code ignored;
        std::filesystem::remove(file.parent_path(), ignored);
        throw;
    }
    return file;
}

}  // namespace

PictureOrder order_of_viewport(const Workspace& workspace, const Views& views) {
    PictureOrder out{workspace.view(), {}, {}, measured_in_view(workspace)};
    out.options.size = viewport_size(views);
    // 0: what suits the size, as `render` takes it without being told.
    out.options.scale = views.picture ? views.picture->scale : 0;
    select_in(workspace, out);
    return out;
}

PictureOrder order_to_export(const Settings& settings, const Workspace& workspace, const Views& views) {
    const PictureExport& wanted = settings.picture_export;
    PictureOrder out = order_of_viewport(workspace, views);
    if (wanted.size && *wanted.size != out.options.size) {
        out.options.size = *wanted.size;
        out.options.scale = 0;
    }
    if (wanted.scale > 0) out.options.scale = wanted.scale;
    out.options.samples = wanted.samples;
    if (wanted.transparent) out.options.background = Rgba(0);
    if (wanted.theme) out.view.theme = *wanted.theme;
    for (const ViewOption& option : view_options()) {
        const bool left_out = wanted.without.contains(std::string(option.key));
        if (left_out && can_leave_out(option, out.view)) option.parse(std::string(option.without), out.view);
    }
    return out;
}

PictureOrder ordered_for(const std::filesystem::path& file, PictureOrder order, const Settings& settings) {
    if (!is_film_name(file)) return order;
    const PictureExport& wanted = settings.picture_export;
    order.film = {wanted.film_turns, wanted.turntable, wanted.rate};
    // Films are not seen through.
    order.options.background.reset();
    return order;
}

std::string film_text(const Workspace& workspace, const PictureOrder& order) {
    const Played played = played_of(order.view, order.film->turns);
    const FilmPace pace = film_pace(played, order.film->rate);
    double count = order.film->turntable;
    if (played == Played::steps) count = workspace.recorded()->trace.size();
    if (played == Played::motion) count = motion_pictures(*workspace.document().fitted, order.view, pace.rate).pictures;
    if (count > kMostPictures) {
        throw std::invalid_argument("The film would have " + brief(count) + " pictures; at most " +
                                    std::to_string(kMostPictures) + " are made at once. " +
                                    (played == Played::steps
                                         ? "Use the command line, with --frames A:B instead of --play."
                                         : "Lower the rate."));
    }
    return mobbscope::film_text(static_cast<std::size_t>(count), pace, film_size(order.options));
}

DrawList draw_list_of(const Workspace& workspace, const PictureOrder& order, std::shared_ptr<SceneFigures> figures) {
    check(order.options);
    KeptPaths paths(workspace.document().fitted, std::move(figures));
    DrawList list = build_draw_list(paths, order.view, order.options);
    if (order.select) {
        const float scale = metrics_of(order.options.size, order.options.scale).scale;
        add_selection(list, workspace.fitted(), order.view, *order.select, scale);
    }
    if (order.measure)
        add_measure(list, *order.measure, metrics_of(order.options.size, order.options.scale), order.view.labels);
    return list;
}

std::string png_of(const Session& session, const PictureOrder& order) {
    return png_bytes(session.picture_maker->draw(draw_list_of(session.workspace, order), order.options.samples));
}

std::size_t write_picture(const Session& session, const PictureOrder& order, const std::filesystem::path& file) {
    check_file_name(file);
    session.files.check_may_export(file);
    if (!is_picture_name(file)) throw InputError(file.string(), "", std::string(kPictureAndFilmNames));
    const std::string bytes =
        session.picture_maker->file_bytes(file, draw_list_of(session.workspace, order), order.options.samples);
    write_file(file, bytes);
    return bytes.size();
}

std::filesystem::path export_file(const Workspace& workspace, const Settings& settings, const Dialogs& dialogs) {
    const std::filesystem::path folder = workspace.file ? workspace.file->parent_path() : settings.folder;
    const std::string& typed = dialogs.exporting.file;
    const char* extension = dialogs.exporting.film ? ".mp4" : ".png";
    if (typed.empty()) return folder / (std::filesystem::path(workspace.title()).stem().string() + extension);
    return with_extension(typed.find('/') == std::string::npos ? folder / typed : typed_path(typed, {}), extension);
}

std::optional<std::string> render_line(const Workspace& workspace, const Files& files, const Dialogs& dialogs,
                                       const PictureOrder& order, const std::string& output) {
    const FittedScene& fitted = *workspace.document().fitted;
    if (is_in_its_file(workspace, files)) {
        // Of an unchanged scene, its `view` is the one in the file.
        const std::string fit = fitted.fits().size() == 1 ? "" : fit_options(fitted.options());
        if (auto line =
                render_line_of({workspace.scene().file, workspace.scene(), workspace.scene().view}, fit, order, output))
            return line;
    }
    const std::optional<ExportDialog::TemporaryScene>& temporary = dialogs.exporting.temporary;
    std::error_code ignored;
    if (!temporary || &temporary->of->scene() != &fitted.scene() ||
        !std::filesystem::exists(temporary->file, ignored)) {
        return std::nullopt;
    }
    const std::string fit = fitted.options() == temporary->of->options() ? "" : fit_options(fitted.options());
    return render_line_of({temporary->file, workspace.scene(), temporary->view}, fit, order, output);
}

std::string render_line_with_scene(Workspace& workspace, Files& files, Dialogs& dialogs, const PictureOrder& order,
                                   const std::string& output) {
    if (auto line = render_line(workspace, files, dialogs, order, output)) return *line;
    files.check_may_write("a temporary file for " + workspace.title());
    const std::shared_ptr<const FittedScene>& fitted = workspace.document().fitted;
    dialogs.exporting.temporary = {fitted, order.view, write_temporary_scene(*fitted, workspace.title(), order.view)};
    return *render_line(workspace, files, dialogs, order,
                        output);  // as no option differs from a scene that was just written
}

SceneCopy::SceneCopy(const FittedScene& of, const std::string& title, const ViewState& view)
    : scene_(of.scene()), view_(view), file_(write_temporary_scene(of, title, view)) {}

SceneCopy::~SceneCopy() {
    std::error_code ignored;
    std::filesystem::remove_all(file_.parent_path(), ignored);
}

std::string SceneCopy::render_line(const PictureOrder& order, const std::string& output) const {
    return *render_line_of({file_, scene_, view_}, "", order, output);  // as no option differs
}

}  // namespace mobbscope::app
