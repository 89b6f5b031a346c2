#include <app/commands/arguments.h>
#include <app/document/picture_export.h>
#include <app/window/shell.h>
#include <base/error.h>
#include <base/file.h>
#include <base/text.h>
#include <cli/command_line.h>
#include <cli/program.h>
#include <cli/render/render_options.h>
#include <render/drawlist/view_projection.h>
#include <render/image/picture_names.h>
#include <scene/arrangement.h>
#include <scene/load_files.h>
#include <scene/view_options.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace mobbscope::cli {

namespace {

constexpr double kLeastDistance = 1e-6;  // metres
constexpr const char* kShownGroup = "What is shown (over the scene's)";

/// "1,2.5" as numbers within [-most, most].
template <std::size_t Count>
std::array<double, Count> parse_numbers(const std::string& text, double most, const char* what) {
    std::array<double, Count> out{};
    std::string_view rest = text;
    for (std::size_t i = 0; i < Count; ++i) {
        const std::size_t comma = rest.find(',');
        const std::optional<double> value = parse_double(rest.substr(0, comma));
        const bool last = comma == std::string_view::npos;
        if (!value || !(*value >= -most && *value <= most) || last != (i + 1 == Count)) {
            throw std::invalid_argument(in_quotes(text) + " is not a " + what + ", each from " + brief(-most) + " to " +
                                        brief(most));
        }
        out[i] = *value;
        rest.remove_prefix(last ? rest.size() : comma + 1);
    }
    return out;
}

glm::dvec3 parse_target(const std::string& text) {
    const auto [x, y, z] = parse_numbers<3>(text, mobb::kMaxLength, "place: give X,Y,HEIGHT in metres");
    return {x, y, z};
}

glm::dvec2 parse_shift(const std::string& text) {
    const auto [right, up] = parse_numbers<2>(text, 1, "shift: give RIGHT,UP in widths and heights of the picture");
    return {right, up};
}

std::pair<int, int> parse_frames(const std::string& text) {
    const std::size_t colon = text.find(':');
    const std::optional<int> first = parse_int(std::string_view(text).substr(0, colon));
    const std::optional<int> last =
        colon == std::string::npos ? std::nullopt : parse_int(std::string_view(text).substr(colon + 1));
    if (!first || !last || *first < 0 || *last < *first) {
        throw std::invalid_argument(in_quotes(text) + " names no pictures: give the first and the last, such as 0:59");
    }
    return {*first, *last};
}

int parse_turntable(const std::string& text) {
    const std::optional<int> count = parse_int(text);
    if (!count || *count < 1)
        throw std::invalid_argument(in_quotes(text) + " is not a number of pictures: give 1 or more");
    return *count;
}

void add_camera_options(Command& command, ViewArguments& view) {
    constexpr const char* kGroup = "Camera (over the scene's)";
    const auto add = [&](const char* name, auto& target, auto parse, const char* help, const char* placeholder) {
        add_parsed(command, name, target, parse, help, placeholder).group(kGroup);
    };
    const auto see = [&view](const std::string& text) {
        view.preset = camera_preset(text);
        view.named = view.preset ? "" : text;
    };
    command
        .add_option("--view", see,
                    "iso, top, front, side, or free (--yaw, --pitch), which frame the scene; or a view that the scene "
                    "has by name",
                    "NAME")
        .group(kGroup);
    add("--yaw", view.yaw, number_within(-3600, 3600), "Free: degrees from +x to the eye, counter-clockwise", "DEG");
    add("--pitch", view.pitch, number_within(-90, 90), "Free: degrees above the floor", "DEG");
    add("--fov", view.fov, number_within(kLeastFov, kMostFov), "Vertical field of view in degrees", "DEG");
    const auto set_perspective = [&view](bool with) { view.perspective = with; };
    command.add_flag("--perspective,!--ortho", set_perspective, "With perspective, or without").group(kGroup);
    add("--target", view.target, parse_target, "What is looked at: metres, time as the height that it is drawn at",
        "X,Y,HEIGHT");
    add("--distance", view.distance, number_within(kLeastDistance, mobb::kMaxLength),
        "Metres from the target to the eye", "D");
    add("--shift", view.shift, parse_shift,
        "Where the target is seen: widths and heights of the picture from its middle", "RIGHT,UP");
}

void add_shown_options(Command& command, ViewArguments& view) {
    add_parsed(command, "--view-state", view.state, parse_file_name,
               "A view of its own: keys of a scene's view, or a scene's whole view", "FILE.json")
        .group(kShownGroup);
    for (const ViewOption& option : view_options()) {
        if (option.option.empty()) continue;
        const auto set = [&view, &option](const std::string& text) {
            ViewState ignored;
            option.parse(text, ignored);
            view.shown.insert_or_assign(std::string(option.key), std::vector{text});
        };
        const std::string& name = option.option;
        const std::string help(option.what);
        if (option.names) {
            const auto set_names = [&view, &option](const std::vector<std::string>& names) {
                view.shown.insert_or_assign(std::string(option.key), names);
            };
            command.add_list_option(name, set_names, help, std::string(option.placeholder)).group(kShownGroup);
            continue;
        }
        const auto switch_it = [set](bool on) { set(on ? "true" : "false"); };
        Option added = option.toggle ? command.add_flag(name, switch_it, help)
                                     : command.add_option(name, set, help, std::string(option.placeholder));
        added.group(kShownGroup);
        if (option.short_form.option.empty()) continue;
        const std::string value(option.short_form.value);
        const std::string help_of_short = formatted("Short for %s %s", name.c_str(), value.c_str());
        const auto set_short = [set, value](bool) { set(value); };
        command.add_flag(std::string(option.short_form.option), set_short, help_of_short).group(kShownGroup);
    }
}

/// The named view that --view asks for, else the scene's own.
const ViewState& own_view(const Scene& scene, const std::string& name) {
    if (name.empty()) return scene.view;
    const std::vector<NamedView>& views = scene.debug.views;
    const auto found = std::ranges::find(views, name, &NamedView::name);
    if (found != views.end()) return found->view;
    std::string known = "iso, top, front, side or free";
    std::vector<std::string> names{"iso", "top", "front", "side", "free"};
    for (const NamedView& named : views) {
        known.append(", ").append(in_quotes(named.name));
        names.push_back(named.name);
    }
    throw InputError("--view: " + in_quotes(name) + " is neither a direction nor a view of this scene" +
                     did_you_mean(name, names) + ": give " + known);
}

/// The node of "A:12", or "A:2.1" by level and place; none of "none".
std::optional<DrawnNode> part_named(const FittedScene& fitted, const std::string& text) {
    if (text == "none") return std::nullopt;
    const std::size_t colon = text.rfind(':');
    const std::string name = text.substr(0, colon);
    const auto refuse = [](const std::string& why) { return InputError("--subtree: " + why); };
    if (colon == std::string::npos) throw refuse(in_quotes(text) + " is not a node: give AGENT:NODE, such as A:2.1");
    if (fitted.scene().crowd) throw refuse("the agents of a run are others at every time");
    const std::vector<PlacedAgent>& agents = fitted.placed_agents();
    const auto who = std::ranges::find(agents, name, &PlacedAgent::name);
    if (who == agents.end()) throw refuse("there is no agent " + in_quotes(name));
    try {
        const int node = app::node_at(fitted.tree(*who), std::string_view(text).substr(colon + 1));
        return DrawnNode{static_cast<int>(who - agents.begin()), node};
    } catch (const std::invalid_argument& error) {
        throw refuse(error.what());
    }
}

void add_sequence_options(Command& command, SequenceArguments& sequence) {
    std::vector<Option> added{
        add_parsed(command, "--frames", sequence.frames, parse_frames,
                   "Pictures A to B of the motion, or with a query its steps A to B", "A:B"),
        command.add_flag("--play", sequence.play, "All pictures of the motion, or with a query all its steps"),
        add_parsed(command, "--rate", sequence.rate, number_within(1 / app::kMostFilmRate, app::kMostFilmRate),
                   "Pictures per second of the motion, and of a film (30; of a query's steps 2)", "FPS"),
        add_parsed(command, "--turntable", sequence.turntable, parse_turntable, "N pictures once around the scene",
                   "N")};
    for (Option& option : added) option.group("Numbered pictures (OUT_0000.png, ...), or a film");
}

[[noreturn]] void contradict(const std::string& a, const std::string& b, const std::string& why) {
    throw InputError(a + " and " + b + " contradict each other: " + why);
}

void check_camera(const ViewArguments& view) {
    const CameraPreset preset = view.preset.value_or(CameraPreset::free);
    const std::string name_of_view = "--view " + std::string(name(preset));
    const std::string angle = view.yaw ? "--yaw" : "--pitch";
    if (preset != CameraPreset::free && (view.yaw || view.pitch)) {
        contradict(name_of_view, angle, "a named view has angles of its own; leave one out, or give --view free");
    }
    if (view.target && !view.distance) throw InputError("--target: say with --distance how far the eye is from it");
    if (view.preset && !view.target && (view.distance || view.shift)) {
        contradict(name_of_view, view.distance ? "--distance" : "--shift",
                   "a named view frames the scene by itself; add a --target, or leave one out");
    }
    // With a target it says how large the picture is, in perspective or not.
    if (!view.fov || view.target) return;
    const std::string parallel = "there is no field of view without perspective; leave one out";
    if (view.perspective == false) contradict("--ortho", "--fov", parallel);
    Camera camera;
    camera.preset = preset;
    if (!orientation(camera).perspective) contradict(name_of_view, "--fov", parallel);
}

void check_sequence(const RenderArguments& arguments) {
    const SequenceArguments& sequence = arguments.sequence;
    const std::string kind = sequence.option();
    if (sequence.frames && sequence.play) contradict("--frames", "--play", "--play takes all of them; leave one out");
    if (sequence.turntable && (sequence.frames || sequence.play)) {
        contradict("--turntable", sequence.play ? "--play" : "--frames",
                   "one turns around the scene, the other goes on in time; leave one out");
    }
    if (sequence.rate && !sequence.frames && !sequence.play && !arguments.is_film()) {
        throw InputError("--rate needs pictures that go on in time; add --play or --frames");
    }
    if (arguments.ui && sequence.any()) contradict("--ui", kind, "a script runs the window; see mobbscope --help");
}

void check_film(const RenderArguments& arguments) {
    if (!arguments.is_film()) return;
    const std::filesystem::path& film = arguments.outputs.image;
    if (!arguments.sequence.any()) {
        throw InputError(film,
                         "a film is made of many pictures: add --play, --frames A:B or --turntable N, or name a .png");
    }
    if (arguments.picture.background.value_or(Rgba(1)).a < 1) {
        throw InputError(film, "films cannot be transparent; leave out --background, or give a colour without alpha");
    }
}

/// What a picture of the whole window has in its own way.
void check_window(const RenderArguments& arguments) {
    if (!arguments.ui) {
        if (arguments.ui_scale) throw InputError("--ui-scale: the picture has panels only with --ui");
        return;
    }
    const auto refuse = [](const char* option) {
        contradict("--ui", option, "it is of the scene's picture, not the window's; leave one out");
    };
    if (is_vector_name(arguments.outputs.image) || arguments.is_film())
        throw InputError(arguments.outputs.image, "the whole window is written as .png; rename the output");
    if (arguments.picture.background) refuse("--background");
    if (arguments.picture.samples != kPictureSamples) refuse("--samples");
    if (!arguments.outputs.ids.empty()) refuse("--ids");
    if (!arguments.outputs.draw_list.empty()) refuse("--draw-list");
    if (arguments.select) refuse("--select");
    if (arguments.measure) refuse("--measure");
}

/// The view of a file over another: of a scene its whole view, else the keys that there are.
ViewState view_of_file(const std::filesystem::path& file, const ViewState& base) {
    check_file_name(file);
    const std::string name = file.string();
    const JsonText value = parse_json(read_file(file), name);
    const JsonPlace root(value, name);
    if (!root.find("clips")) return read_view(root, base);
    const auto view = root.find("view");
    return view ? read_view(*view) : ViewState{};
}

/// Throws InputError at the key of a view, or of the view of a scene, its own or the one of that name, if the file has
/// it.
void refuse_where_said(const std::filesystem::path& file, const std::string& named, const std::string& key,
                       const std::string& message) {
    const std::string name = file.string();
    const JsonText value = parse_json(read_file(file), name);
    const JsonPlace root(value, name);
    const auto refuse_in = [&](const std::optional<JsonPlace>& view) {
        const auto said = view ? view->find(key) : std::nullopt;
        if (said) said->fail(message);
    };
    if (!root.find("clips")) return refuse_in(root);
    if (named.empty()) return refuse_in(root.find("view"));
    const auto debug = root.find("debug");
    const auto views = debug ? debug->find("views") : std::nullopt;
    for (int i = 0; views && i < views->size(); ++i) {
        const JsonPlace each = (*views)[i];
        if (trimmed(each.require("name").string()) == named) refuse_in(each.find("view"));
    }
}

Camera camera_over(Camera camera, const ViewArguments& arguments) {
    if (arguments.preset) {
        camera.preset = *arguments.preset;
        // A preset frames the scene; a target was meant for the camera that it replaces.
        camera.target.reset();
        camera.shift = {0, 0};
    }
    if (arguments.yaw || arguments.pitch) {
        // The angle that is not given stays what is seen now.
        const Orientation present = orientation(camera);
        camera.preset = CameraPreset::free;
        camera.yaw_deg = arguments.yaw.value_or(present.yaw_deg);
        camera.pitch_deg = arguments.pitch.value_or(present.pitch_deg);
        camera.perspective = present.perspective;
    }
    if (arguments.fov) camera.fov_deg = *arguments.fov;
    if (arguments.perspective) camera.perspective = *arguments.perspective;
    if (arguments.target) camera.target = arguments.target;
    const auto need_target = [&](const char* option) {
        if (!camera.target) throw InputError(std::string(option) + ": it needs a target; add one with --target");
    };
    if (arguments.distance) {
        need_target("--distance");
        camera.distance = *arguments.distance;
    }
    if (arguments.shift) {
        need_target("--shift");
        camera.shift = *arguments.shift;
    }
    if (arguments.fov && !camera.target && !orientation(camera).perspective) {
        throw InputError("--fov: this scene is seen without perspective; give a --view with it, such as iso");
    }
    return camera;
}

}  // namespace

void add_render_options(Command& command, RenderArguments& arguments) {
    command.add_option("FILE", arguments.file, openable_files());
    add_parsed(command, "-o,--output", arguments.outputs.image, parse_output_name,
               "The picture: .png, or for papers .svg or .pdf; of several pictures the film: .mp4 or .webm", "OUT.png");
    add_parsed(command, "--ids", arguments.outputs.ids, parse_output_name,
               "What is in each pixel: object ids as colours", "OUT.png");
    add_parsed(command, "--draw-list", arguments.outputs.draw_list, parse_output_name,
               "What is drawn, as numbers; needs no OpenGL", "OUT.json");
    add_parsed(command, "--size", arguments.picture.size, parse_size, "The picture's size in pixels (1280x720)", "WxH");
    add_parsed(command, "--scale", arguments.picture.scale, number_within(kLeastScale, kMostScale),
               "Of text and lines; 1 suits 1280x720, default: what suits the size", "X");
    add_parsed(command, "--samples", arguments.picture.samples, parse_samples, "Per pixel: 1, 2, 4 or 8 (4)", "N");
    add_parsed(command, "--background", arguments.picture.background, parse_background,
               "#RRGGBB, #RRGGBBAA or transparent; default: the theme's", "COLOR");
    add_parsed(command, "--backend", arguments.backend, one_of(backend_from_name, "auto, osmesa, egl"),
               "OpenGL without a display: auto, osmesa or egl", "NAME");
    command.add_flag("--ui", arguments.ui, "The whole window, panels included");
    add_parsed(command, "--ui-scale", arguments.ui_scale, number_within(app::kLeastUiScale, app::kMostUiScale),
               "With --ui: size of text and panels, 0.5 to 4", "X");
    add_camera_options(command, arguments.view);
    add_shown_options(command, arguments.view);
    const auto select = [&arguments](const std::string& text) {
        arguments.select = parse_named_part(text);
        arguments.picture.selected = arguments.select->agent;
    };
    command
        .add_option("--select", select,
                    "Highlights an agent, or a node or sample: AGENT (or AGENT:path), AGENT:node:N or AGENT:sample:N",
                    "WHAT")
        .group(kShownGroup);
    add_parsed(command, "--measure", arguments.measure, parse_measured_line,
               "Draws how far apart two places are, metres on the floor and seconds", "X,Y,T:X,Y,T")
        .group(kShownGroup);
    command
        .add_option(
            "--subtree", [&arguments](const std::string& text) { arguments.view.subtree = text; },
            std::string(view_option("subtree").what), "AGENT:NODE")
        .group(kShownGroup);
    add_sequence_options(command, arguments.sequence);
    add_fit_options(command, arguments.fit);
    add_import_options(command, arguments.import_options);
}

void check_together(const RenderArguments& arguments) {
    if (arguments.file.empty()) throw UsageError("FILE is required");
    if (arguments.ui && arguments.outputs.image.empty()) throw UsageError("--output is required");
    if (!arguments.outputs.any()) throw UsageError("--output, --ids or --draw-list is required");
    const ViewArguments& view = arguments.view;
    if (view.says("query") && view.says("levels")) {
        contradict("--query", "--level", "a picture shows a query or levels; leave one out");
    }
    if (view.says("query") && !view.subtree.empty()) {
        contradict("--query", "--subtree", "a picture shows a query or a part of a tree; leave one out");
    }
    check_window(arguments);
    if (!arguments.outputs.image.empty()) {
        try {
            check(arguments.picture);
        } catch (const std::invalid_argument& error) {
            throw InputError(std::string("--size, --samples: ") + error.what());
        }
    }
    check_camera(view);
    check_sequence(arguments);
    check_film(arguments);
}

ViewState view_over(const FittedScene& fitted, const ViewArguments& arguments) {
    const Scene& scene = fitted.scene();
    ViewState view = own_view(scene, arguments.named);
    if (!arguments.state.empty()) view = view_of_file(arguments.state, view);
    view.camera = camera_over(view.camera, arguments);
    const std::vector<std::string> agents = names_in_view(scene);
    for (const ViewOption& option : view_options()) {
        const auto given = arguments.shown.find(option.key);
        if (given == arguments.shown.end()) continue;
        if (option.names) (view.*option.names).clear();
        for (const std::string& text : given->second) parse_option(option, text, agents, view);
    }
    if (!arguments.subtree.empty()) {
        view.subtree = part_named(fitted, arguments.subtree);
        // A query shows no part of a tree.
        if (view.subtree) view.query.reset();
    }
    if (arguments.says("step") && !view.query) throw InputError("--step: say with --query which query it is a step of");
    return view;
}

void refuse_view(const RenderArguments& arguments, const ViewMismatch& mismatch) {
    const std::string scene = arguments.file.string();
    const std::filesystem::path& state = arguments.view.state;
    if (!arguments.view.says(mismatch.key())) {
        if (!state.empty()) refuse_where_said(state, "", mismatch.key(), scene + ": " + mismatch.what());
        if (lower_extension(scene) == ".json")
            refuse_where_said(scene, arguments.view.named, mismatch.key(), mismatch.what());
    }
    throw InputError(scene, mismatch.what());
}

}  // namespace mobbscope::cli
