#include <app/commands/arguments.h>
#include <app/commands/camera_commands.h>
#include <app/commands/command.h>
#include <app/document/agents.h>
#include <app/document/described.h>
#include <app/document/edit_names.h>
#include <base/text.h>
#include <render/layout/framing.h>
#include <scene/scene_edits.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace mobbscope::app {

namespace {

constexpr double kCopyDistance = 1;  // metres from the original to its copy
constexpr double kBetween = 0.5;     // metres from the others to a new agent
constexpr double kMaxDegrees = 1e9;  // as placements allow

/// Beside all others, level with the middle of them, beginning when the first of them does.
mobb::Placement beside_others(const FittedScene& fitted, const mobb::Clip& clip) {
    Bounds others, own;
    double start = std::numeric_limits<double>::max();
    for (const PlacedAgent& who : fitted.placed_agents()) {
        const mobb::PlacedTree tree = fitted.placed(who);
        add_samples(others, tree.placed_clip(), {0, tree.placed_clip().count()});
        start = std::min(start, who.placement.start);
    }
    add_samples(own, mobb::PlacedClip(clip, {}), {0, clip.count()});
    const double x = 0.5 * (others.min.x + others.max.x - own.min.x - own.max.x);
    const double y = others.max.y + kBetween - own.min.y;
    const auto rounded_up = [](double metres) { return std::ceil(metres * 10) / 10; };
    return {{rounded_up(x), rounded_up(y)}, 0, start};
}

void select_agent(Workspace& workspace, int agent) { workspace.select({Selection::Kind::path, {agent, -1, 0}, -1}); }

void add(Workspace& workspace, const std::string& name) {
    const int clip = index_of_name(clip_names(workspace), name, "clip");
    const mobb::Placement placement =
        beside_others(workspace.fitted(), *workspace.scene().clips[static_cast<std::size_t>(clip)].clip);
    int agent = 0;
    workspace.edit({"adding an agent that plays " + name, ""},
                   [&](Scene& scene) { agent = add_agent(scene, clip, placement); });
    select_agent(workspace, agent);
}

void duplicate(Workspace& workspace) {
    int copy = 0;
    edit_selected_agent(workspace, {"duplicating " + selected_agent_name(workspace), ""}, [&](Scene& scene, int agent) {
        copy = duplicate_agent(scene, agent);
        mobb::Placement placement = scene.agents[static_cast<std::size_t>(copy)].placement;
        placement.translate += glm::dvec2(kCopyDistance, kCopyDistance) / std::sqrt(2.0);
        place_agent(scene, copy, placement);
    });
    select_agent(workspace, copy);
}

void remove(Workspace& workspace) {
    edit_selected_agent(workspace, {"removing " + selected_agent_name(workspace), ""},
                        [](Scene& scene, int agent) { remove_agent(scene, agent); });
    // The next agent has its index now.
    workspace.select({});
}

void rename(Edits& edits, Workspace& workspace, const std::string& name) {
    edits.rename_agent(selected_agent(workspace), name);
}

const mobb::Placement& selected_placement(const Workspace& workspace) {
    return workspace.fitted().placed_agents()[static_cast<std::size_t>(selected_agent(workspace))].placement;
}

template <class Change>
void place_agent(Workspace& workspace, const Change& change) {
    const mobb::Placement before = selected_placement(workspace);
    mobb::Placement placement = before;
    change(placement);
    EditName name = name_of_placing(selected_agent_name(workspace), before, placement);
    // Each command is an edit of its own.
    name.group.clear();
    edit_selected_agent(workspace, name, [&](Scene& scene, int agent) { place_agent(scene, agent, placement); });
}

void move(Workspace& workspace, const std::string& text) {
    const glm::dvec2 to = two_numbers(text, "the place");
    place_agent(workspace, [&](mobb::Placement& placement) { placement.translate = to; });
}

void nudge(Workspace& workspace, const std::string& text) {
    const glm::dvec2 by = two_numbers(text, "the way");
    place_agent(workspace, [&](mobb::Placement& placement) { placement.translate += by; });
}

void turn(Workspace& workspace, const std::string& text) {
    const double degrees = number_in(text, "the angle", -kMaxDegrees, kMaxDegrees);
    place_agent(workspace, [&](mobb::Placement& placement) { placement.rotate_deg = degrees; });
}

void start(Workspace& workspace, const std::string& text) {
    const double time = number_in(text, "the start", -mobb::kMaxTime, mobb::kMaxTime);
    place_agent(workspace, [&](mobb::Placement& placement) { placement.start = time; });
}

void shift_start(Workspace& workspace, const std::string& text) {
    const double by = number_in(text, "the shift", -mobb::kMaxTime, mobb::kMaxTime);
    place_agent(workspace, [&](mobb::Placement& placement) { placement.start += by; });
}

void set_color(Workspace& workspace, const std::string& text) {
    std::optional<Color> color;
    if (text != "none") {
        color = color_from_text(text);
        if (!color) {
            throw std::invalid_argument("the colour cannot be " + in_quotes(text) + ": give one like #E69F00, or none");
        }
    }
    edit_selected_agent(workspace, {"colouring " + selected_agent_name(workspace) + ": " + text, ""},
                        [&](Scene& scene, int agent) { scene.agents[static_cast<std::size_t>(agent)].color = color; });
}

void go_to_state(Workspace& workspace, Edits& edits, const std::string& text) {
    const int last = static_cast<int>(workspace.history.count()) - 1;
    edits.go_to_state(static_cast<std::size_t>(whole_number_in(text, "the state", 0, last)));
}

void copy_figures(Session& session) {
    const Described what = describe(session.workspace, session.workspace.selection);
    session.desktop->set_clipboard(lines_of(what));
    session.notifications.tell(MessageLevel::info, "Copied the figures of " + what.name);
}

/// Of what it is about.
template <auto can, auto title>
std::string title_end_of(const Workspace& workspace) {
    return (workspace.history.*can)() ? ' ' + (workspace.history.*title)() : "";
}

}  // namespace

std::vector<Command> edit_commands() {
    const std::vector<Command> rows{
        Command("edit.undo", "Undo", "Undoes the last edit; the view stays.", &Edits::undo,
                {.shortcut = "Ctrl+Z",
                 .repeats = true,
                 .enabled = [](const Workspace& workspace) { return workspace.history.can_undo(); },
                 .title_end = title_end_of<&History::can_undo, &History::undo_title>,
                 .also = "revert back"}),
        Command("edit.redo", "Redo", "Does again what was undone.", &Edits::redo,
                {.shortcut = "Ctrl+Y Ctrl+Shift+Z",
                 .repeats = true,
                 .enabled = [](const Workspace& workspace) { return workspace.history.can_redo(); },
                 .title_end = title_end_of<&History::can_redo, &History::redo_title>,
                 .also = "again"}),
        Command("view.previous", "Previous view",
                "Goes back to the view before the last change of view; the scene stays as it is.",
                &Edits::previous_view,
                {.menu = "View",
                 .shortcut = "Ctrl+[",
                 .repeats = true,
                 .enabled = [](const Workspace& workspace) { return workspace.history.can_look_back(); },
                 .title_end = title_end_of<&History::can_look_back, &History::look_back_title>,
                 .also = "back camera"}),
        Command("view.next", "Next view", "Goes forward again, after Previous view.", &Edits::next_view,
                {.menu = "View",
                 .shortcut = "Ctrl+]",
                 .repeats = true,
                 .enabled = [](const Workspace& workspace) { return workspace.history.can_look_forward(); },
                 .title_end = title_end_of<&History::can_look_forward, &History::look_forward_title>,
                 .also = "redo camera"}),
        Command("edit.history", "History...", "Lists the edits; a click goes back or forward to one.",
                [](Dialogs& dialogs) { dialogs.open(Dialog::history); }, {.also = "log"}),
        Command("edit.go_to", "To a state of the history",
                "Goes to a state of what was done, by its number from 0, the oldest.", go_to_state,
                {.menu = kNoMenu, .argument = "N"}),
        Command(
            "edit.copy_figures", "Copy figures", "Copies what is selected with all its numbers, a line each.",
            copy_figures,
            {.enabled = {[](const Workspace& workspace) { return workspace.selection.kind != Selection::Kind::none; },
                         []() -> std::string_view { return "nothing is selected"; }},
             .also = "numbers values statistics clipboard"}),
        Command("agent.make", "Make these agents",
                "Makes an agent of every clip, where it is shown: agents can be placed and queried.",
                [](Workspace& workspace) {
                    workspace.edit({"making agents", ""}, add_agents_for_clips);
                },
                {.enabled = {shows_bare_clips,
                             [](const Workspace& workspace) -> std::string_view {
                                 return workspace.crowd() ? "a run cannot be edited" : "they are agents already";
                             }},
                 .also = "instance"}),
        Command("agent.add", "Add agent", "Adds an agent that plays a clip, a little beside the others.", add,
                {.argument = "CLIP",
                 .enabled = {[](const Workspace& workspace) {
                                 return has_scene(workspace) && !workspace.crowd() && !shows_bare_clips(workspace);
                             },
                             why_no_agent},
                 .choices = clip_names,
                 .also = "instance spawn new"}),
        Command("agent.duplicate", "Duplicate agent", "Adds a copy of the selected agent, a metre beside it.",
                duplicate,
                {.shortcut = "Ctrl+D", .enabled = {has_true_agent, why_no_agent}, .also = "copy clone instance"}),
        Command("agent.remove", "Remove agent", "Removes the selected agent and the queries about it; its clip stays.",
                remove, {.shortcut = "Delete", .enabled = {has_selected_of_several, why_no_agent}, .also = "delete"}),
        Command("agent.rename", "Rename agent...", "Gives the selected agent another name.", rename,
                {.argument = "NAME",
                 .enabled = {has_true_agent, why_no_agent},
                 .present = selected_agent_name,
                 .also = "label"}),
        Command("agent.move", "Place agent at", "Places the selected agent on the floor, in metres.", move,
                {.menu = kNoMenu,
                 .argument = "X Y",
                 .enabled = {has_selected_agent, why_nothing_to_place},
                 .present =
                     [](const Workspace& workspace) {
                         const glm::dvec2 at = selected_placement(workspace).translate;
                         return format_double(at.x) + ' ' + format_double(at.y);
                     },
                 .also = "translate position transform grab"}),
        Command("agent.turn", "Turn agent to",
                "Turns the selected agent's path about its clip's origin: degrees, counter-clockwise.", turn,
                {.menu = kNoMenu,
                 .argument = "DEG",
                 .enabled = {has_selected_agent, why_nothing_to_place},
                 .present =
                     [](const Workspace& workspace) { return format_double(selected_placement(workspace).rotate_deg); },
                 .also = "rotate orientation"}),
        Command(
            "agent.start", "Start agent at", "Sets when the selected agent starts, in seconds.", start,
            {.menu = kNoMenu,
             .argument = "S",
             .enabled = {has_selected_agent, why_nothing_to_place},
             .present = [](const Workspace& workspace) { return format_double(selected_placement(workspace).start); },
             .also = "delay offset"}),
        Command("agent.nudge", "Move agent by", "Moves the selected agent on the floor by metres.", nudge,
                {.menu = kNoMenu,
                 .argument = "DX DY",
                 .enabled = {has_selected_agent, why_nothing_to_place},
                 .also = "translate shift"}),
        Command("agent.shift_start", "Shift agent in time by",
                "Makes the selected agent start later, in seconds; below 0: earlier.", shift_start,
                {.menu = kNoMenu, .argument = "S", .enabled = {has_selected_agent, why_nothing_to_place}}),
        Command("agent.color", "Colour agent", "Gives the selected agent a colour of its own, or the palette's again.",
                set_color,
                {.menu = kNoMenu,
                 .argument = "#RRGGBB|none",
                 .enabled = {has_selected_agent, why_nothing_to_place},
                 .also = "color paint"}),
    };
    return in_menu("Edit", rows);
}

}  // namespace mobbscope::app
