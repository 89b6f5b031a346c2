#include <app/commands/arguments.h>
#include <app/commands/camera_commands.h>
#include <app/commands/command.h>
#include <app/document/agents.h>
#include <base/text.h>
#include <render/drawlist/camera.h>
#include <render/drawlist/view_projection.h>
#include <render/layout/follow.h>
#include <scene/crowd_run.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <stdexcept>

namespace mobbscope::app {

namespace {

constexpr double kKeyZoom = 1.25;
constexpr double kOrbitStep = 5;  // degrees
constexpr std::array kScales{0.5, 0.75, 0.9, 1.0, 1.1, 1.25, 1.5, 1.75, 2.0, 2.5, 3.0, 4.0};

bool shows_levels(const Session& session) { return has_scene(session) && !session.view().query; }

// --- the camera

/// The scene framed by itself again. What the field of view was before the camera stood somewhere is not known.
void frame_by_itself(Camera& camera) {
    if (camera.target) camera.fov_deg = Camera{}.fov_deg;
    camera.target.reset();
    camera.distance = 0;
    camera.shift = {0, 0};
}

template <CameraPreset preset>
void see_from(Session& session, const std::string&) {
    session.change_view([](ViewState& view) {
        view.camera.preset = preset;
        frame_by_itself(view.camera);
    });
}

template <CameraPreset preset>
bool is_seen_from(const Session& session) {
    return session.view().camera.preset == preset;
}

bool may_have_perspective(const Session& session) {
    Camera camera = session.view().camera;
    camera.perspective = true;
    return has_scene(session) && orientation(camera).perspective;
}

void frame_all(Session& session, const std::string&) {
    session.change_view([](ViewState& view) { frame_by_itself(view.camera); });
}

/// Whether an agent is selected, and no part of its path; in the picture of a moment an agent stands where a sample is.
bool is_agent_selected(const Session& session) {
    const Selection& selected = session.selection;
    if (!selected.on_path() || selected.path.agent < 0) return false;
    return selected.kind == Selection::Kind::path ||
           (selected.kind == Selection::Kind::sample && session.view().show == Show::moment);
}

/// Frames the selected agent while the camera follows one: it follows the selected one from now on, as nobody else
/// stays in its picture.
void frame_selected_agent(Session& session) {
    const std::string who = current_agent(session);
    if (who == session.view().follow) return frame_followed(session, kAroundFollowed);
    follow_agent(session, who, kAroundFollowed);
}

void frame_selection(Session& session, const std::string& none) {
    const Selection selected = session.selection;
    if (follows(session) && (selected.kind == Selection::Kind::none || is_agent_selected(session))) {
        return frame_selected_agent(session);
    }
    const std::optional<Bounds> box = box_of(session, selected);
    if (!box) return follows(session) ? frame_followed(session, kAroundFollowed) : frame_all(session, none);
    move_camera(session, [&](const Camera& camera, const PictureFrame& picture) {
        const auto target = [&](glm::dvec3 at) {
            return picture.space.to_target(picture.space.point(at.x, at.y, at.z));
        };
        return framing(camera, target(box->min), target(box->max), picture.size);
    });
}

void zoom(Session& session, double factor) {
    move_camera(session, [&](const Camera& camera, const PictureFrame& picture) {
        const PictureSize size = picture.size;
        const glm::dvec2 target =
            (glm::dvec2(0.5) + camera.shift * glm::dvec2(1, -1)) * glm::dvec2(size.width, size.height);
        return zoomed(camera, factor, glm::vec2(target), size);
    });
}

/// The scene turns as if it was dragged to the right and downwards.
void orbit(Session& session, glm::dvec2 degrees) {
    move_camera(session, [&](const Camera& camera, const PictureFrame& picture) {
        return orbited(camera, glm::vec2(degrees * (picture.size.height / 180.0)), picture.size);
    });
}

template <int x, int y>
void orbit_step(Session& session, const std::string&) {
    orbit(session, kOrbitStep * glm::dvec2(x, y));
}

// --- what is drawn

bool shows_moment(const Session& session) { return session.view().show == Show::moment; }

/// Heights mean something else then, so the camera frames the scene anew; who it goes along with stays as near.
void toggle_moment(Session& session, const std::string&) {
    const bool goes_along = follows(session) && session.view().camera.target;
    session.change_view([&](ViewState& view) {
        view.show = view.show == Show::moment ? Show::space_time : Show::moment;
        if (!goes_along) frame_by_itself(view.camera);
    });
    if (goes_along) center_followed(session);
}

/// Levels of the deepest tree in the picture.
int depth_in_view(const Session& session) {
    int depth = 1;
    for (const PlacedAgent& who : session.fitted().placed_agents()) {
        depth = std::max(depth, session.fitted().tree(who.clip).depth());
    }
    return depth;
}

/// A query's picture has no levels: showing some leaves it.
void show_levels(Session& session, LevelRange levels) {
    session.change_view([&](ViewState& view) {
        view.levels = levels;
        view.query.reset();
    });
}

bool can_be_finer(const Session& session) {
    const LevelRange levels = session.view().levels;
    return shows_levels(session) && !levels.leaves && levels.last + 1 < depth_in_view(session);
}

void finer(Session& session, const std::string&) {
    const LevelRange levels = session.view().levels;
    show_levels(session, {levels.first + 1, levels.last + 1, false});
}

bool can_be_coarser(const Session& session) {
    return shows_levels(session) && (session.view().levels.leaves || session.view().levels.first > 0);
}

void coarser(Session& session, const std::string&) {
    const LevelRange levels = session.view().levels;
    const int deepest = depth_in_view(session) - 1;
    // Leaves are of several levels, and a range from a file may go deeper than the trees do.
    if (levels.leaves) return show_levels(session, {deepest, deepest, false});
    const int by = std::max(1, std::min(levels.last - deepest, levels.first));
    show_levels(session, {levels.first - by, levels.last - by, false});
}

void set_shown_levels(Session& session, const std::string& levels) { show_levels(session, parse_level_range(levels)); }

void set_time_height(Session& session, const std::string& metres) {
    const double height = metres == "auto" ? 0 : number_in(metres, "the height of a second", 1e-6, 1e6);
    session.change_view([&](ViewState& view) { view.time_height = height; });
}

/// The selected sample's disk, and the leaf that holds it; none if it is not in the picture. The agents of a run are
/// others at every time, so that none of them keeps its number.
std::optional<DiskProjection> selected_disk(const Session& session) {
    const Selection& selected = session.selection;
    if (selected.kind != Selection::Kind::sample || session.crowd()) return std::nullopt;
    const auto who = index_in_view(session.fitted(), session.view(), selected.path);
    if (!who) return std::nullopt;
    const mobb::Tree& tree = session.fitted().tree(placed_agent_of(session.fitted(), selected.path)->clip);
    return DiskProjection{*who, leaf_of_sample(tree, selected.index), selected.index};
}

void toggle_projection(Session& session, const std::string&) {
    const auto disk = session.view().projection ? std::nullopt : selected_disk(session);
    session.change_view([&](ViewState& view) { view.projection = disk; });
}

// --- the window

double present_scale(const Session& session) {
    if (session.settings.ui_scale > 0) return session.settings.ui_scale;
    return session.hooks.ui_scale ? session.hooks.ui_scale() : 1;
}

void set_scale(Session& session, const std::string& text) {
    session.settings.ui_scale = number_in(text, "the scale", kScales.front(), kScales.back());
}

constexpr double kHair = 1e-3;

void larger(Session& session, const std::string&) {
    const auto next = std::upper_bound(kScales.begin(), kScales.end(), present_scale(session) + kHair);
    session.settings.ui_scale = next == kScales.end() ? kScales.back() : *next;
}

void smaller(Session& session, const std::string&) {
    const auto next = std::lower_bound(kScales.begin(), kScales.end(), present_scale(session) - kHair);
    session.settings.ui_scale = next == kScales.begin() ? kScales.front() : *(next - 1);
}

// --- time

void set_time(Session& session, double time) {
    session.change_view([&](ViewState& view) { view.time = time; });
}

/// The shortest sample of the paths in the picture, seconds.
double sample_time(const Session& session) {
    double dt = std::numeric_limits<double>::max();
    const auto add = [&](const PlacedAgent& who) { dt = std::min(dt, session.fitted().tree(who.clip).clip().dt()); };
    if (session.view().query) {
        const SceneQuery query = session.fitted().queries()[static_cast<std::size_t>(*session.view().query)];
        add(query.a);
        add(query.b);
    } else {
        for (const PlacedAgent& who : session.fitted().placed_agents()) add(who);
    }
    return dt;
}

/// To the next multiple of a sample after (before) the present time, counted from the first moment.
void step_time(Session& session, int direction) {
    const mobb::Interval span = session.time_span();
    const double dt = sample_time(session);
    const double at = (session.view().time.value_or(span.t0) - span.t0) / dt;
    const double next = direction > 0 ? std::floor(at + kHair) + 1 : std::ceil(at - kHair) - 1;
    session.stop();
    set_time(session, std::clamp(span.t0 + next * dt, span.t0, span.t1));
}

void play(Session& session, const std::string&) {
    if (session.playing()) return session.stop();
    session.play();
    if (!session.view().time) set_time(session, session.time_span().t0);
}

bool is_split(const Session& session) { return session.view_count() > 1; }

void toggle_split(Session& session, const std::string&) {
    if (is_split(session)) return session.close_other_views();
    mobb::FitOptions other = session.fitted().options();
    other.tree = other.tree == mobb::TreeKind::umobb ? mobb::TreeKind::mobb : mobb::TreeKind::umobb;
    session.split_view(other.tree == mobb::TreeKind::umobb ? "UMOBB" : "MOBB", other);
}

// --- the tables

std::vector<Command> camera_table() {
    return {
        {.id = "view.iso",
         .title = "View from a corner",
         .menu = "View",
         .shortcut = "1",
         .doc = "Looks from above a corner of the floor, with the whole scene in the picture.",
         .enabled = has_scene,
         .run = see_from<CameraPreset::iso>,
         .checked = is_seen_from<CameraPreset::iso>},
        {.id = "view.top",
         .title = "View from above",
         .menu = "View",
         .shortcut = "2",
         .doc = "Looks down on the floor: the paths as on a map.",
         .enabled = has_scene,
         .run = see_from<CameraPreset::top>,
         .checked = is_seen_from<CameraPreset::top>},
        {.id = "view.front",
         .title = "View from the front",
         .menu = "View",
         .shortcut = "3",
         .doc = "Looks along y: x to the right, time upwards.",
         .enabled = has_scene,
         .run = see_from<CameraPreset::front>,
         .checked = is_seen_from<CameraPreset::front>},
        {.id = "view.side",
         .title = "View from the side",
         .menu = "View",
         .shortcut = "4",
         .doc = "Looks along x: y across, time upwards.",
         .enabled = has_scene,
         .run = see_from<CameraPreset::side>,
         .checked = is_seen_from<CameraPreset::side>},
        {.id = "view.perspective",
         .title = "Perspective",
         .menu = "View",
         .shortcut = "5",
         .doc = "Draws what is farther smaller; without it, equal lengths stay equal.",
         .enabled = may_have_perspective,
         .run =
             [](Session& session, const std::string&) {
                 session.change_view([](ViewState& view) { view.camera.perspective = !view.camera.perspective; });
             },
         .checked = [](const Session& session) { return orientation(session.view().camera).perspective; }},
        {.id = "view.frame",
         .title = "Frame the selection",
         .menu = "View",
         .shortcut = "F",
         .doc =
             "Brings what is selected into the middle, as large as it fits; without a selection everything. Following "
             "somebody, it goes along with who is selected.",
         .enabled = has_scene,
         .run = frame_selection},
        {.id = "view.frame_all",
         .title = "Frame everything",
         .menu = "View",
         .shortcut = "Home",
         .doc = "Shows the whole scene again from the present direction.",
         .enabled = has_scene,
         .run = frame_all},
        {.id = "view.zoom",
         .title = "Zoom by",
         .argument = "FACTOR",
         .doc = "Goes nearer by a factor; below 1 farther.",
         .enabled = has_scene,
         .run = [](Session& session,
                   const std::string& text) { zoom(session, number_in(text, "the factor", 1e-3, 1e3)); }},
        {.id = "view.zoom_in",
         .title = "Zoom in",
         .menu = "View/Camera",
         .shortcut = "=",
         .repeats = true,
         .doc = "Goes nearer.",
         .enabled = has_scene,
         .run = [](Session& session, const std::string&) { zoom(session, kKeyZoom); }},
        {.id = "view.zoom_out",
         .title = "Zoom out",
         .menu = "View/Camera",
         .shortcut = "-",
         .repeats = true,
         .doc = "Goes farther away.",
         .enabled = has_scene,
         .run = [](Session& session, const std::string&) { zoom(session, 1 / kKeyZoom); }},
        {.id = "view.orbit",
         .title = "Turn by",
         .argument = "DX DY",
         .doc = "Turns the scene by degrees to the right and downwards.",
         .enabled = has_scene,
         .run = [](Session& session, const std::string& text) { orbit(session, two_numbers(text, "the angles")); }},
        {.id = "view.orbit_left",
         .title = "Turn to the left",
         .menu = "View/Camera",
         .shortcut = "Alt+Left",
         .repeats = true,
         .doc = "Turns the scene to the left by 5 degrees.",
         .enabled = has_scene,
         .run = orbit_step<-1, 0>},
        {.id = "view.orbit_right",
         .title = "Turn to the right",
         .menu = "View/Camera",
         .shortcut = "Alt+Right",
         .repeats = true,
         .doc = "Turns the scene to the right by 5 degrees.",
         .enabled = has_scene,
         .run = orbit_step<1, 0>},
        {.id = "view.orbit_up",
         .title = "Tip upwards",
         .menu = "View/Camera",
         .shortcut = "Alt+Up",
         .repeats = true,
         .doc = "Tips the scene upwards by 5 degrees: it is seen more from the side.",
         .enabled = has_scene,
         .run = orbit_step<0, -1>},
        {.id = "view.orbit_down",
         .title = "Tip downwards",
         .menu = "View/Camera",
         .shortcut = "Alt+Down",
         .repeats = true,
         .doc = "Tips the scene downwards by 5 degrees: it is seen more from above.",
         .enabled = has_scene,
         .run = orbit_step<0, 1>},
        {.id = "view.pan",
         .title = "Shift by",
         .argument = "DX DY",
         .doc = "Shifts the scene by pixels to the right and downwards.",
         .enabled = has_scene,
         .run =
             [](Session& session, const std::string& text) {
                 const glm::vec2 pixels(two_numbers(text, "the way"));
                 move_camera(session, [&](const Camera& camera, const PictureFrame& picture) {
                     return panned(camera, pixels, picture.size);
                 });
             }},
        {.id = "view.moment",
         .title = "Show the moment",
         .menu = "View",
         .shortcut = "M",
         .doc = "Shows people in their cylinders on the floor at the moment of the time cursor, or space-time again.",
         .enabled = has_scene,
         .run = toggle_moment,
         .checked = shows_moment},
        {.id = "view.split",
         .title = "Split",
         .menu = "View",
         .doc = "Shows the scene twice, side by side: beside these trees UMOBB trees, or MOBB trees where these are "
                "UMOBB.",
         .enabled = has_scene,
         .run = toggle_split,
         .checked = is_split},
        {.id = "view.other",
         .title = "Go to the other view",
         .menu = "View",
         .shortcut = "F6",
         .doc = "Of a split view: commands and panels are about the next part from now on.",
         .enabled = is_split,
         .run = [](Session& session,
                   const std::string&) { session.activate_view((session.active_place() + 1) % session.view_count()); }},
        {.id = "view.link_cameras",
         .title = "Link cameras",
         .menu = "View",
         .doc = "Of a split view: moving the camera of one part moves that of the other.",
         .enabled = is_split,
         .run = [](Session& session, const std::string&) { session.link_cameras(!session.document().linked_cameras); },
         .checked = [](const Session& session) { return is_split(session) && session.document().linked_cameras; }},
    };
}

std::vector<Command> shown_table() {
    return {
        option_command(view_option("color_by")),
        {.id = "view.level",
         .title = "Show levels",
         .argument = "N|A:B|leaves",
         .doc = "Shows the boxes of a level, of a range of levels, or the leaves; leaves the query in view.",
         .enabled = has_scene,
         .run = set_shown_levels},
        {.id = "view.finer",
         .title = "Finer level",
         .menu = "View/Levels",
         .shortcut = "]",
         .repeats = true,
         .doc = "Shows the boxes one level further down the trees.",
         .enabled = can_be_finer,
         .run = finer},
        {.id = "view.coarser",
         .title = "Coarser level",
         .menu = "View/Levels",
         .shortcut = "[",
         .repeats = true,
         .doc = "Shows the boxes one level nearer to the roots.",
         .enabled = can_be_coarser,
         .run = coarser},
        {.id = "view.leaves",
         .title = "Leaves",
         .menu = "View/Levels",
         .shortcut = "E",
         .doc = "Shows the leaves of the trees, whatever their level; leaves the query in view.",
         .enabled = has_scene,
         .run = [](Session& session, const std::string&) { set_shown_levels(session, "leaves"); },
         .checked = [](const Session& session) { return !session.view().query && session.view().levels.leaves; }},
        {.id = "view.time_height",
         .title = "Height of a second",
         .argument = "M|auto",
         .doc = "Draws a second so many metres high; auto makes the scene about as tall as wide.",
         .enabled = has_scene,
         .run = set_time_height},
        {.id = "view.projection",
         .title = "Disk along the axes of its box",
         .menu = "View/Show",
         .doc =
             "Shows how far the selected sample's disk reaches along the axes of its leaf's box, instead of all else.",
         .enabled = [](const Session& session) { return session.view().projection || selected_disk(session); },
         .why_not = [](const Session&) { return std::string_view("no sample in the picture is selected"); },
         .run = toggle_projection,
         .checked = [](const Session& session) { return session.view().projection.has_value(); }},
        option_command(view_option("theme")),
        {.id = "window.scale",
         .title = "Scale of text and panels",
         .argument = "X",
         .doc = "Makes text and panels so many times as large, 0.5 to 4.",
         .run = set_scale},
        {.id = "window.larger",
         .title = "Larger text",
         .menu = "View/Window",
         .shortcut = "Ctrl+=",
         .repeats = true,
         .doc = "Makes text and panels larger.",
         .run = larger},
        {.id = "window.smaller",
         .title = "Smaller text",
         .menu = "View/Window",
         .shortcut = "Ctrl+-",
         .repeats = true,
         .doc = "Makes text and panels smaller.",
         .run = smaller},
        {.id = "window.scale_reset",
         .title = "Usual text size",
         .menu = "View/Window",
         .shortcut = "Ctrl+0",
         .doc = "Makes text and panels as large as the monitor's scale asks for.",
         .run = [](Session& session, const std::string&) { session.settings.ui_scale = 0; }},
        {.id = "time.at",
         .title = "Time cursor at",
         .argument = "S",
         .doc = "Puts the time cursor at a moment, in seconds.",
         .enabled = has_scene,
         .run =
             [](Session& session, const std::string& text) {
                 set_time(session, number_in(text, "the time", -mobb::kMaxTime, mobb::kMaxTime));
             }},
        {.id = "time.clear",
         .title = "No time cursor",
         .menu = "View/Time",
         .doc = "Takes the time cursor out of the picture.",
         .enabled = [](const Session& session) { return session.view().time.has_value() && !session.crowd(); },
         .run =
             [](Session& session, const std::string&) {
                 session.stop();
                 session.change_view([](ViewState& view) { view.time.reset(); });
             }},
        {.id = "time.play",
         .title = "Play",
         .menu = "View/Time",
         .shortcut = "Space",
         .doc = "Lets the time cursor run, or stops it.",
         .enabled = has_scene,
         .run = play,
         .checked = [](const Session& session) { return session.playing(); }},
        {.id = "time.start",
         .title = "To the first moment",
         .menu = "View/Time",
         .doc = "Puts the time cursor where the first path begins.",
         .enabled = has_scene,
         .run = [](Session& session, const std::string&) { set_time(session, session.time_span().t0); }},
        {.id = "time.end",
         .title = "To the last moment",
         .menu = "View/Time",
         .doc = "Puts the time cursor where the last path ends.",
         .enabled = has_scene,
         .run = [](Session& session, const std::string&) { set_time(session, session.time_span().t1); }},
        {.id = "time.forward",
         .title = "A sample on",
         .menu = "View/Time",
         .shortcut = ".",
         .repeats = true,
         .doc = "Moves the time cursor on by a sample.",
         .enabled = has_scene,
         .run = [](Session& session, const std::string&) { step_time(session, 1); }},
        {.id = "time.back",
         .title = "A sample back",
         .menu = "View/Time",
         .shortcut = ",",
         .repeats = true,
         .doc = "Moves the time cursor back by a sample.",
         .enabled = has_scene,
         .run = [](Session& session, const std::string&) { step_time(session, -1); }},
        {.id = "time.speed",
         .title = "Speed of playing",
         .argument = "X",
         .doc = "Plays so many seconds of the scene in a second, 0.01 to 100.",
         .run = [](Session& session,
                   const std::string& text) { session.speed = number_in(text, "the speed", 0.01, 100); }},
    };
}

/// The toggles of the menu "View/Show" are made from their rows in scene/view_options.cpp.
std::vector<Command> all_view_commands() {
    std::vector<Command> out = camera_table();
    for (const ViewOption& option : view_options()) {
        if (option.menu == "View/Show") out.push_back(option_command(option));
    }
    std::ranges::move(shown_table(), std::back_inserter(out));
    return out;
}

}  // namespace

std::span<const Command> view_commands() {
    static const std::vector<Command> table = all_view_commands();
    return table;
}

}  // namespace mobbscope::app
