#include <app/commands/arguments.h>
#include <app/commands/camera_commands.h>
#include <app/commands/command.h>
#include <app/document/agents.h>
#include <app/document/measuring.h>
#include <base/text.h>
#include <render/drawlist/camera.h>
#include <render/drawlist/view_projection.h>
#include <render/layout/follow.h>
#include <scene/crowd_run.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace mobbscope::app {

namespace {

constexpr double kKeyZoom = 1.25;
constexpr double kOrbitStep = 5;  // degrees
constexpr std::array kScales{0.5, 0.75, 0.9, 1.0, 1.1, 1.25, 1.5, 1.75, 2.0, 2.5, 3.0, 4.0};

bool shows_levels(const Workspace& workspace) { return has_scene(workspace) && !workspace.view().query; }

// --- the camera

/// The camera turns about its target, and stays as far from it.
Command see_from(CameraPreset preset, std::string_view id, std::string_view title, std::string_view key,
                 std::string_view doc, std::string_view also) {
    const auto see = [preset](Workspace& workspace) {
        workspace.change_view([&](ViewState& view) { view.camera.preset = preset; });
    };
    const auto is_seen = [preset](const Workspace& workspace) { return workspace.view().camera.preset == preset; };
    return {id, title, doc, see, {.shortcut = key, .checked = is_seen, .also = also}};
}

bool may_have_perspective(const Workspace& workspace) {
    Camera camera = workspace.view().camera;
    camera.perspective = true;
    return has_scene(workspace) && orientation(camera).perspective;
}

void frame_all(Workspace& workspace, Views& views) {
    if (const std::optional<Bounds> slab = box_of_slab(workspace)) return frame_box(views, workspace, *slab);
    workspace.change_view([&](ViewState& view) {
        view.camera = without_target(view.camera);
        // What is framed may have become larger since, by another unit or a longer clip.
        if (view.show == Show::space_time && !views.has_chosen_height()) view.time_height = 0;
    });
}

/// Whether an agent is selected, and no part of its path; in the picture of a moment an agent stands where a sample is.
bool is_agent_selected(const Workspace& workspace) {
    const Selection& selected = workspace.selection;
    if (!selected.on_path() || selected.path.agent < 0) return false;
    return selected.kind == Selection::Kind::path ||
           (selected.kind == Selection::Kind::sample && workspace.view().show != Show::space_time);
}

/// Frames the selected agent while the camera follows one: it follows the selected one from now on, as nobody else
/// stays in its picture.
void frame_selected_agent(Workspace& workspace, Views& views) {
    const std::string who = current_agent(workspace);
    if (who == workspace.view().follow) return frame_followed(views, workspace, kAroundFollowed);
    follow_agent(workspace, views, who, kAroundFollowed);
}

/// What is selected, else the pair under test; none: neither is in the picture.
std::optional<Bounds> what_to_frame(const Workspace& workspace) {
    // A query that is selected is the one in view: what is looked at is its test.
    const bool apart = workspace.selection.kind != Selection::Kind::query;
    const std::optional<Bounds> selected = apart ? box_of(workspace, workspace.selection) : std::nullopt;
    return selected ? selected : box_of_test(workspace);
}

void frame_selection(Workspace& workspace, Views& views) {
    const bool whom = workspace.selection.kind == Selection::Kind::none || is_agent_selected(workspace);
    if (follows(workspace) && whom) return frame_selected_agent(workspace, views);
    if (const std::optional<Bounds> box = what_to_frame(workspace)) return frame_box(views, workspace, *box);
    return follows(workspace) ? frame_followed(views, workspace, kAroundFollowed) : frame_all(workspace, views);
}

void zoom(Views& views, Workspace& workspace, double factor) {
    move_camera(views, workspace, [&](const Camera& camera, const PictureFrame& picture) {
        const PictureSize size = picture.size;
        const glm::dvec2 target =
            (glm::dvec2(0.5) + camera.shift * glm::dvec2(1, -1)) * glm::dvec2(size.width, size.height);
        return zoomed(camera, factor, glm::vec2(target), size);
    });
}

/// The scene turns as if it was dragged to the right and downwards.
void orbit(Views& views, Workspace& workspace, glm::dvec2 degrees) {
    move_camera(views, workspace, [&](const Camera& camera, const PictureFrame& picture) {
        return orbited(camera, glm::vec2(degrees * (picture.size.height / 180.0)), picture.size);
    });
}

Command orbit_step(glm::dvec2 way, std::string_view id, std::string_view title, std::string_view key,
                   std::string_view doc) {
    const auto step = [way](Views& views, Workspace& workspace) { orbit(views, workspace, kOrbitStep * way); };
    return {id, title, doc, step, {.shortcut = key, .repeats = true}};
}

// --- what is drawn

bool shows_moment(const Workspace& workspace) { return workspace.view().show == Show::moment; }
bool shows_plan(const Workspace& workspace) { return workspace.view().show == Show::plan; }

std::string_view subject(const ViewState& view) {
    if (view.show != Show::space_time) return name(view.show);
    return view.projection ? "disk" : "space-time";
}

/// Heights mean something else in a picture of something else: each has its own camera, and frames the scene when it is
/// shown first. A disk is framed each time, as it may be another one.
void show_other_picture(Workspace& workspace, const std::function<void(ViewState&)>& change) {
    workspace.change_view([&](ViewState& view) {
        workspace.other_cameras[subject(view)] = view.camera;
        change(view);
        const auto known = workspace.other_cameras.find(subject(view));
        if (known != workspace.other_cameras.end() && !view.projection) {
            view.camera = known->second;
        } else {
            view.camera = without_target(view.camera);
            // Of a plan north is up, until it is turned.
            if (view.show == Show::plan) view.camera.preset = CameraPreset::top;
        }
    });
}

/// Who the camera goes along with stays as near.
void toggle_floor(Workspace& workspace, Views& views, Show show) {
    const auto toggle = [show](ViewState& view) { view.show = view.show == show ? Show::space_time : show; };
    if (!follows(workspace) || !workspace.view().camera.target) return show_other_picture(workspace, toggle);
    workspace.change_view(toggle);
    center_followed(views, workspace);
}

// --- measuring

/// Between two places that are given, or the next two that are clicked.
void measure(Workspace& workspace, const std::string& text) {
    Measuring& measuring = workspace.measuring;
    if (text.empty()) {
        const bool picks = !measuring.picks;
        measuring = {};
        measuring.picks = picks;
        return;
    }
    const MeasuredLine line = parse_measured_line(text);
    measuring = {.picks = false, .from = MeasuredEnd{line.from, ""}, .to = MeasuredEnd{line.to, ""}};
}

bool is_measured(const Workspace& workspace) { return measured_in_view(workspace).has_value(); }

std::string_view why_not_measured(const Workspace& workspace) {
    return workspace.view().projection ? "a disk is shown alone" : "the agents are laid out in a grid";
}

void copy_measured(Session& session) {
    const MeasuredLine line = *measured_in_view(session.workspace);
    std::string text =
        "distance\t" + format_double(line.metres()) + " m\ntime\t" + format_double(line.seconds()) + " s\n";
    if (const std::optional<double> speed = line.speed()) text += "speed\t" + format_double(*speed) + " m/s\n";
    session.desktop->set_clipboard(text + "places\t" + text_of(line) + '\n');
    session.notifications.tell(MessageLevel::info, "Copied " + measured_words(line));
}

/// Levels of the deepest tree in the picture.
int depth_in_view(const Workspace& workspace) {
    int depth = 1;
    for (const PlacedAgent& who : workspace.fitted().placed_agents()) {
        depth = std::max(depth, workspace.fitted().tree(who).depth());
    }
    return depth;
}

/// A query's picture has no levels: showing some leaves it.
void show_levels(Workspace& workspace, LevelRange levels) {
    workspace.change_view([&](ViewState& view) {
        view.levels = levels;
        view.query.reset();
    });
}

std::string_view why_no_level(const Workspace& workspace) {
    return shows_levels(workspace) ? "there is no further level" : "a query is in the picture: Q closes it";
}

bool can_be_finer(const Workspace& workspace) {
    const LevelRange levels = workspace.view().levels;
    return shows_levels(workspace) && !levels.leaves && levels.last + 1 < depth_in_view(workspace);
}

void finer(Workspace& workspace) {
    const LevelRange levels = workspace.view().levels;
    show_levels(workspace, {levels.first + 1, levels.last + 1, false});
}

bool can_be_coarser(const Workspace& workspace) {
    return shows_levels(workspace) && (workspace.view().levels.leaves || workspace.view().levels.first > 0);
}

void coarser(Workspace& workspace) {
    const LevelRange levels = workspace.view().levels;
    const int deepest = depth_in_view(workspace) - 1;
    // Leaves are of several levels, and a range from a file may go deeper than the trees do.
    if (levels.leaves) return show_levels(workspace, {deepest, deepest, false});
    const int by = std::max(1, std::min(levels.last - deepest, levels.first));
    show_levels(workspace, {levels.first - by, levels.last - by, false});
}

void set_shown_levels(Workspace& workspace, const std::string& levels) {
    show_levels(workspace, parse_level_range(levels));
}

/// As the command line says it.
void set_view_option(Workspace& workspace, std::string_view key, const std::string& text) {
    workspace.change_view([&](ViewState& view) { view_option(key).parse(text, view); });
}

void set_time_height(Workspace& workspace, const std::string& metres) {
    const double height = metres == "auto" ? 0 : number_in(metres, "the height of a second", 1e-6, 1e6);
    workspace.change_view([&](ViewState& view) { view.time_height = height; });
}

/// The selected sample's disk, and the leaf that holds it; none if it is not in the picture. The agents of a run are
/// others at every time, so that none of them keeps its number.
std::optional<DiskProjection> selected_disk(const Workspace& workspace) {
    const Selection& selected = workspace.selection;
    if (selected.kind != Selection::Kind::sample || workspace.crowd()) return std::nullopt;
    const auto who = index_in_view(workspace.fitted(), workspace.view(), selected.path);
    if (!who) return std::nullopt;
    const mobb::Tree& tree = workspace.fitted().tree(placed_agent_of(workspace.fitted(), selected.path)->clip);
    return DiskProjection{*who, leaf_of_sample(tree, selected.index), selected.index};
}

void toggle_projection(Workspace& workspace) {
    const auto disk = workspace.view().projection ? std::nullopt : selected_disk(workspace);
    show_other_picture(workspace, [&](ViewState& view) { view.projection = disk; });
}

// --- the window

std::vector<std::string> tab_names() { return {bottom_tab_names().begin(), bottom_tab_names().end()}; }

constexpr std::array<std::string_view, 4> kTabTitles{"Recursion, or paths", "Events", "Nodes", "Curves"};

std::string title_of_tab(const std::string& name) {
    const auto at = std::ranges::find(bottom_tab_names(), name) - bottom_tab_names().begin();
    return std::string(kTabTitles.at(static_cast<std::size_t>(at)));
}

void show_tab(Settings& settings, const std::string& text) {
    settings.bottom_tab = choice_named<BottomTab>(bottom_tab_names(), text, "what stands below");
}

void set_scale(Settings& settings, const std::string& text) {
    settings.ui_scale = number_in(text, "the scale", kScales.front(), kScales.back());
}

constexpr double kHair = 1e-3;

void larger(Session& session) {
    const auto next = std::upper_bound(kScales.begin(), kScales.end(), session.ui_scale() + kHair);
    session.settings.ui_scale = next == kScales.end() ? kScales.back() : *next;
}

void smaller(Session& session) {
    const auto next = std::lower_bound(kScales.begin(), kScales.end(), session.ui_scale() - kHair);
    session.settings.ui_scale = next == kScales.begin() ? kScales.front() : *(next - 1);
}

// --- time

void set_time(Workspace& workspace, double time) {
    workspace.change_view([&](ViewState& view) { view.time = time; });
}

/// The shortest sample of the paths in the picture, seconds.
double sample_time(const Workspace& workspace) {
    double dt = std::numeric_limits<double>::max();
    for_each_agent_in_view(workspace.fitted(), workspace.view(), [&](const PlacedAgent& who) {
        dt = std::min(dt, workspace.fitted().tree(who).clip().dt());
    });
    return dt;
}

/// To the next multiple of a sample after (before) the present time, counted from the first moment.
void step_time(Workspace& workspace, Playback& playback, int direction) {
    const mobb::Interval span = time_span(workspace);
    const double dt = sample_time(workspace);
    const double at = (workspace.view().time.value_or(span.t0) - span.t0) / dt;
    const double next = direction > 0 ? std::floor(at + kHair) + 1 : std::ceil(at - kHair) - 1;
    playback.stop();
    set_time(workspace, std::clamp(span.t0 + next * dt, span.t0, span.t1));
}

void play(Playback& playback) {
    if (playback.playing()) return playback.stop();
    playback.play();
}

// --- the tables, in the order of the menus

std::vector<Command> direction_commands() {
    const std::vector<Command> rows{
        see_from(CameraPreset::iso, "view.iso", "View from a corner", "1", "Looks from above a corner of the floor.",
                 "iso isometric 3d"),
        see_from(CameraPreset::top, "view.top", "View from above", "2",
                 "Looks down on the floor: the paths as on a map.", "top plan overhead bird 2d"),
        see_from(CameraPreset::front, "view.front", "View from the front", "3",
                 "Looks along y: x to the right, time upwards.", "elevation"),
        see_from(CameraPreset::side, "view.side", "View from the side", "4", "Looks along x: y across, time upwards.",
                 "right left elevation"),
        Command("view.perspective", "Perspective",
                "Draws what is farther smaller; without it, equal lengths stay equal.",
                [](Workspace& workspace) {
                    workspace.change_view([](ViewState& view) { view.camera.perspective = !view.camera.perspective; });
                },
                {.shortcut = "5",
                 .enabled = may_have_perspective,
                 .checked = [](const Workspace& workspace) { return orientation(workspace.view().camera).perspective; },
                 .also = "orthographic ortho lens"}),
        Command(
            "view.frame", "Frame the selection",
            "Brings what is selected into the middle, as large as it fits; without a selection the pair under test, "
            "else everything. Following somebody, it goes along with who is selected.",
            frame_selection, {.shortcut = "F", .also = "zoom to fit focus centre center"}),
        Command("view.frame_all", "Frame everything",
                "Shows the whole picture again, from the present direction; with a slab, all that lies in it.",
                frame_all, {.shortcut = "Home", .also = "home reset zoom to fit all centre center"}),
        Command("view.follow_test", "Follow the test",
                "Lets the camera go to the pair under test whenever a step's boxes are cut off, lie below a panel, or "
                "are small in the picture.",
                [](Views& views) { views.follow_test = !views.follow_test; },
                {.checked = [](const Views& views) { return views.follow_test; }}),
    };
    return in_menu("View", rows);
}

std::vector<Command> movement_commands() {
    const std::vector<Command> rows{
        Command("view.zoom", "Zoom by", "Goes nearer by a factor; below 1 farther.",
                [](Views& views, Workspace& workspace, const std::string& text) {
                    zoom(views, workspace, number_in(text, "the factor", 1e-3, 1e3));
                },
                {.menu = kNoMenu, .argument = "FACTOR", .also = "closer"}),
        Command("view.zoom_in", "Zoom in", "Goes nearer.",
                [](Views& views, Workspace& workspace) { zoom(views, workspace, kKeyZoom); },
                {.shortcut = "=", .repeats = true, .also = "closer"}),
        Command("view.zoom_out", "Zoom out", "Goes farther away.",
                [](Views& views, Workspace& workspace) { zoom(views, workspace, 1 / kKeyZoom); },
                {.shortcut = "-", .repeats = true}),
        Command("view.orbit", "Turn by", "Turns the scene by degrees to the right and downwards.",
                [](Views& views, Workspace& workspace, const std::string& text) {
                    orbit(views, workspace, two_numbers(text, "the angles"));
                },
                {.menu = kNoMenu, .argument = "DX DY", .also = "rotate tumble"}),
        orbit_step({-1, 0}, "view.orbit_left", "Turn to the left", "Alt+Left",
                   "Turns the scene to the left by 5 degrees."),
        orbit_step({1, 0}, "view.orbit_right", "Turn to the right", "Alt+Right",
                   "Turns the scene to the right by 5 degrees."),
        orbit_step({0, -1}, "view.orbit_up", "Tip upwards", "Alt+Up",
                   "Tips the scene upwards by 5 degrees: it is seen more from the side."),
        orbit_step({0, 1}, "view.orbit_down", "Tip downwards", "Alt+Down",
                   "Tips the scene downwards by 5 degrees: it is seen more from above."),
        Command("view.pan", "Shift by", "Shifts the scene by pixels to the right and downwards.",
                [](Views& views, Workspace& workspace, const std::string& text) {
                    const glm::vec2 pixels(two_numbers(text, "the way"));
                    move_camera(views, workspace, [&](const Camera& camera, const PictureFrame& picture) {
                        return panned(camera, pixels, picture.size);
                    });
                },
                {.menu = kNoMenu, .argument = "DX DY", .also = "move track"}),
        option_command(view_option("frame_boxes")),
    };
    return in_menu("View/Camera", rows);
}

std::vector<Command> picture_commands() {
    const std::vector<Command> rows{
        Command("view.moment", "Show the moment",
                "Shows people in their cylinders on the floor at the moment of the time cursor, or space-time again.",
                [](Workspace& workspace, Views& views) { toggle_floor(workspace, views, Show::moment); },
                {.shortcut = "M", .checked = shows_moment, .also = "floor people instant cylinders now"}),
        Command("view.plan", "Floor plan",
                "Shows the floor from above at the moment of the time cursor: every disk, and the sections of the "
                "boxes that are shown; or space-time again.",
                [](Workspace& workspace, Views& views) { toggle_floor(workspace, views, Show::plan); },
                {.shortcut = "Shift+G", .checked = shows_plan, .also = "map 2d top cross section"}),
        Command("view.measure", "Measure",
                "Measures how far apart two places are, on the floor and in time: click both in the picture. A click "
                "near a disk's centre or edge, or a box's corner, takes that. Escape ends it.",
                measure,
                {.shortcut = "Shift+D",
                 .argument = "[X,Y,T:X,Y,T]",
                 .enabled = {can_measure, why_not_measured},
                 .checked = [](const Workspace& workspace) { return workspace.measuring.picks; },
                 .present =
                     [](const Workspace& workspace) {
                         const auto line = workspace.measuring.line();
                         return line ? text_of(*line) : std::string();
                     },
                 .also = "ruler distance gap length dimension"}),
        Command("view.copy_measured", "Copy what is measured",
                "Copies the measured distance, time and speed with all digits, and the two places.", copy_measured,
                {.enabled = {is_measured, []() -> std::string_view { return "nothing is measured"; }}}),
        option_command(view_option("past")),
    };
    return in_menu("View", rows);
}

/// What is drawn and what folds, made from the rows in scene/view_options.cpp.
std::vector<Command> show_commands() {
    std::vector<Command> out;
    for (const ViewOption& option : view_options()) {
        if (option.menu == "View/Show" || option.menu == "View/Overlays") out.push_back(option_command(option));
    }
    return out;
}

bool has_slab(const Workspace& workspace) { return workspace.view().slab.has_value(); }

std::vector<Command> slab_commands() {
    const std::vector<Command> rows{
        Command("view.slab", "Slab in time",
                "Shows what lies between two times, in seconds, and cuts the rest away; none shows all.",
                [](Workspace& workspace, const std::string& text) { set_view_option(workspace, "slab", text); },
                {.argument = "T0:T1|none",
                 .present = [](const Workspace& workspace) { return view_option("slab").text(workspace.view()); },
                 .also = "clip clipping cut crop range section"}),
        option_command(view_option("cut_boxes")),
        Command("view.no_slab", "No slab", "Shows all of time again.",
                [](Workspace& workspace) { set_view_option(workspace, "slab", "none"); }, {.enabled = has_slab}),
    };
    return in_menu("View/Slab", rows);
}

std::vector<Command> level_commands() {
    const std::vector<Command> rows{
        option_command(view_option("color_by")),
        Command(
            "view.color_range", "Range of the boxes' colours",
            "Chooses the figures at both ends of the colours, of parts in per cent, where boxes are coloured by one: "
            "boxes outside step back; auto takes the range of the boxes in the picture.",
            [](Workspace& workspace, const std::string& text) { set_view_option(workspace, "color_range", text); },
            {.menu = kNoMenu,
             .argument = "A:B|auto",
             .present = [](const Workspace& workspace) { return view_option("color_range").text(workspace.view()); },
             .also = "histogram scale minimum maximum"}),
        Command("view.level", "Show levels",
                "Shows the boxes of a level, of a range of levels, or the leaves; leaves the query in view.",
                set_shown_levels,
                {.menu = kNoMenu,
                 .argument = "N|A:B|leaves",
                 .present = [](const Workspace& workspace) { return to_string(workspace.view().levels); },
                 .also = "depth lod"}),
        Command("view.finer", "Finer level", "Shows the boxes one level further down the trees.", finer,
                {.shortcut = "]", .repeats = true, .enabled = {can_be_finer, why_no_level}, .also = "deeper down"}),
        Command("view.coarser", "Coarser level", "Shows the boxes one level nearer to the roots.", coarser,
                {.shortcut = "[", .repeats = true, .enabled = {can_be_coarser, why_no_level}, .also = "shallower up"}),
        Command(
            "view.leaves", "Leaves", "Shows the leaves of the trees, whatever their level; leaves the query in view.",
            [](Workspace& workspace) { set_shown_levels(workspace, "leaves"); },
            {.shortcut = "E",
             .checked =
                 [](const Workspace& workspace) { return !workspace.view().query && workspace.view().levels.leaves; },
             .also = "leaf deepest bottom"}),
        Command(
            "view.time_height", "Height of a second",
            "Sets how many metres high a second is drawn; auto makes the scene about as tall as wide.", set_time_height,
            {.menu = kNoMenu,
             .argument = "M|auto",
             .present = [](const Workspace& workspace) { return view_option("time_height").text(workspace.view()); },
             .also = "vertical scale exaggerate"}),
    };
    return in_menu("View/Levels", rows);
}

std::vector<Command> window_commands() {
    Command theme = option_command(view_option("theme"));
    theme.where = Where::everywhere;
    const std::vector<Command> rows{
        Command(
            "view.projection", "Disk along the axes of its box",
            "Shows how far the selected sample's disk reaches along the axes of its leaf's box, instead of all else.",
            toggle_projection,
            {.menu = "View/Show",
             .enabled = {
                 [](const Workspace& workspace) { return workspace.view().projection || selected_disk(workspace); },
                 [] { return std::string_view("no sample in the picture is selected"); }},
             .checked = [](const Workspace& workspace) { return workspace.view().projection.has_value(); }}),
        theme,
        Command("bottom.show", "Below the picture",
                "Chooses what is below the picture: the recursion of the query in view (without one the paths over "
                "time), its events, the nodes of the tree in focus, or curves of its clip.",
                show_tab,
                {.argument = "TAB",
                 .choices = [](const Session&) { return tab_names(); },
                 .choice_title = title_of_tab,
                 .chosen =
                     [](const Settings& settings, const std::string& name) {
                         return name == bottom_tab_names()[static_cast<std::size_t>(settings.bottom_tab)];
                     },
                 .also = "table list spreadsheet sort waste worst plot graph speed radius"}),
        Command("window.scale", "Scale of text and panels", "Sets the scale of text and panels, 0.5 to 4.", set_scale,
                {.menu = kNoMenu,
                 .argument = "X",
                 .enabled = always,
                 .where = Where::everywhere,
                 .present = [](const Session& session) { return format_double(session.ui_scale()); },
                 .also = "ui font size dpi settings preferences"}),
        Command("window.larger", "Larger text", "Makes text and panels larger.", larger,
                {.shortcut = "Ctrl+=",
                 .repeats = true,
                 .enabled = always,
                 .where = Where::everywhere,
                 .also = "font bigger ui"}),
        Command(
            "window.smaller", "Smaller text", "Makes text and panels smaller.", smaller,
            {.shortcut = "Ctrl+-", .repeats = true, .enabled = always, .where = Where::everywhere, .also = "font ui"}),
        Command("window.scale_reset", "Usual text size", "Sets the scale of text and panels to that of the monitor.",
                [](Settings& settings) { settings.ui_scale = 0; },
                {.shortcut = "Ctrl+0", .enabled = always, .where = Where::everywhere, .also = "font ui"}),
    };
    return in_menu("View/Window", rows);
}

std::vector<Command> time_commands() {
    const std::vector<Command> rows{
        Command("time.at", "Time cursor at", "Puts the time cursor at a moment, in seconds.",
                [](Workspace& workspace, const std::string& text) {
                    set_time(workspace, number_in(text, "the time", -mobb::kMaxTime, mobb::kMaxTime));
                },
                {.menu = kNoMenu,
                 .argument = "S",
                 .present =
                     [](const Workspace& workspace) {
                         return workspace.view().time ? format_double(*workspace.view().time) : std::string();
                     },
                 .also = "time moment seek scrub goto frame"}),
        Command(
            "time.clear", "No time cursor", "Hides the time cursor.",
            [](Playback& playback, Workspace& workspace) {
                playback.stop();
                workspace.change_view([](ViewState& view) { view.time.reset(); });
            },
            {.enabled =
                 [](const Workspace& workspace) { return workspace.view().time.has_value() && !workspace.crowd(); }}),
        Command("time.play", "Play", "Starts the time cursor, or stops it.", play,
                {.shortcut = "Space",
                 .checked = [](const Playback& playback) { return playback.playing(); },
                 .also = "animate animation pause stop run"}),
        Command("time.start", "To the first moment", "Puts the time cursor where the first path begins.",
                [](Workspace& workspace) { set_time(workspace, time_span(workspace).t0); },
                {.also = "rewind beginning first frame"}),
        Command("time.end", "To the last moment", "Puts the time cursor where the last path ends.",
                [](Workspace& workspace) { set_time(workspace, time_span(workspace).t1); }, {.also = "last frame"}),
        Command("time.forward", "A sample on", "Moves the time cursor on by a sample.",
                [](Workspace& workspace, Playback& playback) { step_time(workspace, playback, 1); },
                {.shortcut = ".", .repeats = true, .also = "next frame"}),
        Command("time.back", "A sample back", "Moves the time cursor back by a sample.",
                [](Workspace& workspace, Playback& playback) { step_time(workspace, playback, -1); },
                {.shortcut = ",", .repeats = true, .also = "previous frame"}),
        Command("time.speed", "Speed of playing", "Sets how many seconds of the scene play in a second, 0.01 to 100.",
                [](Playback& playback, const std::string& text) {
                    playback.speed = number_in(text, "the speed", 0.01, 100);
                },
                {.argument = "X",
                 .enabled = always,
                 .present = [](const Playback& playback) { return format_double(playback.speed); },
                 .also = "fps rate slow motion playback"}),
    };
    return in_menu("View/Time", rows);
}

}  // namespace

std::vector<Command> view_commands() {
    return joined({direction_commands(), movement_commands(), picture_commands(), side_by_side_commands(),
                   show_commands(), slab_commands(), level_commands(), window_commands(), time_commands()});
}

}  // namespace mobbscope::app
