#include <app/commands/arguments.h>
#include <app/commands/camera_commands.h>
#include <app/commands/command.h>
#include <app/document/agents.h>
#include <app/document/shown_agents.h>
#include <base/text.h>
#include <mobb/traversal.h>
#include <render/layout/follow.h>
#include <render/layout/framing.h>
#include <render/pictures/candidates.h>
#include <scene/crowd_run.h>
#include <scene/crowd_scene.h>
#include <scene/drawn_agent.h>
#include <scene/motion_graph.h>

#include <algorithm>
#include <array>
#include <limits>
#include <stdexcept>

namespace mobbscope::app {

namespace {

constexpr double kNear = 2.5;           // metres around two that meet
constexpr double kAroundMeeting = 0.5;  // ... around both
constexpr double kAfterTouch = 0.5;     // seconds of their ways that are framed

// --- following

void stop_following(Workspace& workspace) {
    const double time = shown_time(workspace);
    const glm::dvec3 anchor = camera_anchor(workspace.fitted(), workspace.view(), time);
    workspace.change_view([&](ViewState& view) {
        view.follow.clear();
        // What was in the middle stays there.
        if (view.camera.target) *view.camera.target += glm::dvec3(anchor.x, anchor.y, 0);
    });
}

void follow(Workspace& workspace, Views& views, Notifications& notifications, const std::string& name) {
    if (!name.empty()) return follow_agent(workspace, views, name, kAroundFollowed);
    const std::string who = current_agent(workspace);
    if (who.empty()) return notifications.tell(MessageLevel::info, "Click somebody first to follow them");
    if (who == workspace.view().follow) return stop_following(workspace);
    follow_agent(workspace, views, who, kAroundFollowed);
}

// --- plays and choices

const CrowdAgent* followed(const Workspace& workspace) {
    const auto run_agent = current_run_agent(workspace);
    return run_agent ? &workspace.crowd()->agents[static_cast<std::size_t>(*run_agent)] : nullptr;
}

void to_time(Playback& playback, Workspace& workspace, double time) {
    playback.stop();
    workspace.change_view([&](ViewState& view) { view.time = time; });
}

void to_play(Workspace& workspace, Playback& playback, const std::string& text) {
    const CrowdAgent& agent = *followed(workspace);
    const int play = whole_number_in(text, "the play", 0, static_cast<int>(agent.plays.size()) - 1);
    to_time(playback, workspace, agent.plays[static_cast<std::size_t>(play)].placement.start);
}

constexpr std::array<std::string_view, 3> kPlayColumns{"time", "agent", "kind"};

void sort_special_plays(CrowdInspector& crowds, const std::string& text) {
    const auto by = choice_named<SpecialPlayList::Column>(kPlayColumns, text, "the column");
    crowds.play_order.descending = crowds.play_order.by == by && !crowds.play_order.descending;
    crowds.play_order.by = by;
}

void to_special_play(Session& session, const std::string& text) {
    const std::vector<SpecialPlay>& all = session.crowds.special_plays();
    const int index = whole_number_in(text, "the play", 0, static_cast<int>(all.size()) - 1);
    const SpecialPlay& of = all[static_cast<std::size_t>(index)];
    const CrowdAgent& agent = session.workspace.crowd()->agents[static_cast<std::size_t>(of.agent)];
    to_time(session.playback, session.workspace, agent.plays[static_cast<std::size_t>(of.play)].chosen_at);
    follow_agent(session.workspace, session.views, agent.name, kAroundFollowed);
}

/// The choice after or before the present time; none if there is none.
template <int direction>
std::optional<double> next_choice(const Workspace& workspace) {
    const CrowdAgent* agent = followed(workspace);
    if (!agent) return std::nullopt;
    const double now = run_time(workspace.scene(), workspace.view());
    std::optional<double> best;
    for (std::size_t i = 1; i < agent->plays.size(); ++i) {
        const double at = agent->plays[i].chosen_at;
        const bool beyond = direction > 0 ? at > now + 1e-9 : at < now - 1e-9;
        if (beyond && (!best || (direction > 0 ? at < *best : at > *best))) best = at;
    }
    return best;
}

template <int direction>
bool has_choice(const Workspace& workspace) {
    return next_choice<direction>(workspace).has_value();
}
template <int direction>
void to_choice(Playback& playback, Workspace& workspace) {
    to_time(playback, workspace, *next_choice<direction>(workspace));
}

// --- candidates

Command candidates_command() {
    Command out = option_command(view_option("candidates"));
    out.enabled = &Workspace::crowd;
    return out;
}

void point_out(CrowdInspector& crowds, Workspace& workspace, const std::string& text) {
    const int count = static_cast<int>(crowds.choice()->choice.candidates.size());
    crowds.point_out(whole_number_in(text, "the candidate", 0, count - 1));
    workspace.change_view([](ViewState& view) { view.candidates = true; });
}

constexpr std::array<std::string_view, 4> kColumns{"outcome", "clip", "reason", "contact"};
constexpr std::array<std::string_view, 3> kWhich{"all", "free", "rejected"};

/// Which of `names` it is. Throws std::invalid_argument if it is none.
template <std::size_t N>
std::size_t which_of(const std::array<std::string_view, N>& names, const char* what, const std::string& text) {
    return static_cast<std::size_t>(index_of_name({names.begin(), names.end()}, text, what));
}

/// The same column once more turns the order round.
void sort_candidates(CrowdInspector& crowds, const std::string& text) {
    const auto by = static_cast<CandidateList::Column>(which_of(kColumns, "column", text));
    CandidateList& list = crowds.list;
    list.descending = list.by == by && !list.descending;
    list.by = by;
}

void list_candidates(CrowdInspector& crowds, const std::string& text) {
    crowds.list.which = static_cast<CandidateList::Which>(which_of(kWhich, "choice", text));
}

void open_candidate(CrowdInspector& crowds, Excerpts& excerpts, const std::string& text) {
    int index = crowds.candidate();
    if (!text.empty()) {
        index = whole_number_in(text, "the candidate", 0, std::numeric_limits<int>::max());
    }
    excerpts.open_candidate(index);
}

// --- conflicts

bool can_find(const Workspace& workspace, const Jobs& jobs) {
    return !workspace.empty() && !jobs.job() && can_conflict(workspace);
}
bool has_conflicts(const CrowdInspector& crowds) { return crowds.conflicts() && !crowds.conflicts()->empty(); }

/// What two in the foreground cover from now until so long after they touch, as box_of has it.
Bounds box_of_meeting(const Workspace& workspace, double touch) {
    const double from = *workspace.view().time;
    Bounds bounds;
    for (const DrawnAgent& agent : drawn_agents(workspace.fitted(), workspace.view())) {
        if (!agent.named) continue;
        const mobb::PlacedClip& clip = agent.clip();
        const int first = mobb::first_ending_after(clip, 0, clip.count(), from);
        const int last = mobb::first_ending_after(clip, 0, clip.count(), touch + kAfterTouch);
        add_samples(bounds, clip, {first, std::min(last + 1, clip.count()) - first});
    }
    bounds.min -= glm::dvec3(kAroundMeeting, kAroundMeeting, 0);
    bounds.max += glm::dvec3(kAroundMeeting, kAroundMeeting, 0);
    if (workspace.view().show != Show::space_time) {
        bounds.min.z = 0;
        bounds.max.z = kStanding;
    }
    return bounds;
}

/// The two alone, framed, just before they touch.
void to_conflict(Session& session, int index) {
    const SceneConflict& conflict = (*session.crowds.conflicts())[static_cast<std::size_t>(index)];
    Workspace& workspace = session.workspace;
    session.playback.stop();
    workspace.conflict = index;
    const double before = time_before(workspace, conflict);
    show_in_foreground(workspace, {conflict.a.name, conflict.b.name}, [&](ViewState& view) {
        view.query.reset();
        view.follow.clear();
        view.arrange = Arrange::none;
        view.time = before;
    });
    frame_box(session.views, workspace, box_of_meeting(workspace, conflict.begin()));
    // A selection would stand out among the two, and of all afterwards.
    workspace.select({});
}

/// Follows who plays what the simulator would not choose, when it was chosen.
void tell_of_check(Session& session, const MoveSet& moves, const RunCheck& found) {
    if (!found.difference) {
        return session.notifications.tell(MessageLevel::info,
                                          "All " + counted(found.plays, "play", "plays") + " come out as the run says");
    }
    std::string text;
    for (const std::string& line : difference_lines(moves, *found.difference))
        text += (text.empty() ? "" : "\n") + line;
    session.notifications.tell(MessageLevel::warning, text);
    const FollowedChoice& remade = found.difference->remade;
    to_time(session.playback, session.workspace, std::max(0.0, remade.choice.time));
    follow_agent(session.workspace, session.views,
                 session.workspace.crowd()->agents[static_cast<std::size_t>(remade.agent)].name, kAroundFollowed);
    if (remade.play > 0 && found.difference->other && session.crowds.choice())
        session.crowds.point_out(static_cast<int>(found.difference->other->candidate));
}

void check_the_run(Session& session) {
    session.crowds.check_run(
        [&session](const MoveSet& moves, const RunCheck& found) { tell_of_check(session, moves, found); });
}

bool can_check(const Workspace& workspace, const Jobs& jobs) { return workspace.crowd() && !jobs.job(); }

bool has_choice_behind(const Workspace& workspace, const CrowdInspector& crowds) {
    return workspace.crowd() && workspace.conflict >= 0 && crowds.conflicts();
}

void to_choice_behind(Session& session) {
    const ConflictPlace place = conflict_place(
        session.workspace, (*session.crowds.conflicts())[static_cast<std::size_t>(session.workspace.conflict)]);
    to_time(session.playback, session.workspace, place.time);
    follow_agent(session.workspace, session.views, place.followed.name, kNear);
}

void go_conflict(Session& session, const std::string& text) {
    to_conflict(session,
                whole_number_in(text, "the conflict", 0, static_cast<int>(session.crowds.conflicts()->size()) - 1));
}

template <int direction>
bool has_next_conflict(const CrowdInspector& crowds, const Workspace& workspace) {
    if (!has_conflicts(crowds)) return false;
    const int next = workspace.conflict + direction;
    return next >= 0 && next < static_cast<int>(crowds.conflicts()->size());
}
template <int direction>
void next_conflict(Session& session) {
    to_conflict(session, session.workspace.conflict + direction);
}

void open_conflict(CrowdInspector& crowds, Workspace& workspace, Excerpts& excerpts, const std::string& text) {
    const int last = static_cast<int>(crowds.conflicts()->size()) - 1;
    const int index = text.empty() ? workspace.conflict : whole_number_in(text, "the conflict", 0, last);
    if (index < 0) throw std::invalid_argument("choose a conflict first: click one in the list");
    excerpts.open_conflict((*crowds.conflicts())[static_cast<std::size_t>(index)]);
}

void open_pair(Workspace& workspace, Excerpts& excerpts, const std::string& name) {
    const auto path = current_path(workspace);
    const int index = index_of_name(agent_names(workspace), name, "agent");
    const PlacedAgent other = workspace.fitted().placed_agents()[static_cast<std::size_t>(index)];
    if (other.name == path->name) throw std::invalid_argument("an agent cannot be asked against itself: name another");
    excerpts.open(*path, other);
}

}  // namespace

std::vector<Command> crowd_commands() {
    const std::vector<Command> rows{
        Command("crowd.follow", "Follow",
                "Lets the camera go along with the selected agent, and shows a run's last choice; once more: stops.",
                follow,
                {.shortcut = "W", .argument = "[AGENT]", .checked = follows, .also = "track chase lock camera"}),
        Command("crowd.stop", "Stop following", "Leaves the camera where it is.", stop_following, {.enabled = follows}),
        candidates_command(),
        Command("crowd.window", "Seconds around the time",
                "Shows so many seconds of a run before and after its time in space-time, 0.1 to 60.",
                [](Workspace& workspace, const std::string& text) {
                    const double window = number_in(text, "the window", kLeastTimeWindow, kMostTimeWindow);
                    workspace.change_view([&](ViewState& view) { view.time_window = window; });
                },
                {.menu = kNoMenu,
                 .argument = "S",
                 .enabled = &Workspace::crowd,
                 .present = [](const Workspace& workspace) { return format_double(workspace.view().time_window); }}),
        Command("crowd.next_choice", "Next choice", "Goes to the time at which the agent chooses next.", to_choice<1>,
                {.shortcut = "N", .enabled = has_choice<1>}),
        Command("crowd.previous_choice", "Previous choice", "Goes to the time at which the agent chose before.",
                to_choice<-1>, {.shortcut = "Shift+N", .enabled = has_choice<-1>}),
        Command("crowd.check", "Check the run",
                "Makes every choice of the run again, and follows who plays the first one that comes out otherwise.",
                check_the_run, {.enabled = can_check, .also = "verify replay remake simulate"}),
        Command("crowd.special_play", "To a forced or turned play",
                "Follows who was forced or turned, when that was chosen: by its number from 0 in the list.",
                to_special_play,
                {.menu = kNoMenu,
                 .argument = "N",
                 .enabled =
                     [](const Workspace& workspace, const CrowdInspector& crowds) {
                         return workspace.crowd() && !crowds.special_plays().empty();
                     }}),
        Command("crowd.sort_plays", "Sort forced and turned plays by",
                "Lists the forced and turned plays of a run by a column; by the same one again the other way round.",
                sort_special_plays,
                {.argument = "COLUMN",
                 .choices = [] { return std::vector<std::string>(kPlayColumns.begin(), kPlayColumns.end()); },
                 .chosen =
                     [](const CrowdInspector& crowds, const std::string& column) {
                         return column == kPlayColumns[static_cast<std::size_t>(crowds.play_order.by)];
                     }}),
        Command("crowd.play", "To a play", "Goes to the time at which the agent's play begins, by its number from 0.",
                to_play, {.menu = kNoMenu, .argument = "N", .enabled = followed}),
        Command("crowd.candidate", "Point out a candidate",
                "Points out one of the moves that the followed agent could choose, by its number from 0.", point_out,
                {.menu = kNoMenu, .argument = "N", .enabled = &CrowdInspector::choice}),
        Command("crowd.sort_candidates", "Sort candidates by",
                "Lists the candidates of the last choice by a column; by the same one again the other way round.",
                sort_candidates,
                {.argument = "COLUMN",
                 .choices = [] { return std::vector<std::string>(kColumns.begin(), kColumns.end()); },
                 .chosen =
                     [](const CrowdInspector& crowds, const std::string& column) {
                         return column == kColumns[static_cast<std::size_t>(crowds.list.by)];
                     }}),
        Command("crowd.list_candidates", "List candidates",
                "Lists all candidates of the last choice, those that were free, or those that were rejected.",
                list_candidates,
                {.argument = "WHICH",
                 .choices = [] { return std::vector<std::string>(kWhich.begin(), kWhich.end()); },
                 .chosen =
                     [](const CrowdInspector& crowds, const std::string& which) {
                         return which == kWhich[static_cast<std::size_t>(crowds.list.which)];
                     }}),
        Command(
            "crowd.open_candidate", "Open the candidate as a scene",
            "Opens the candidate that is pointed out, and who rules it out, as a scene with the query between them.",
            open_candidate, {.argument = "[N]", .enabled = &CrowdInspector::choice}),
        Command("crowd.open_pair", "Open as a scene with",
                "Opens what the selected agent and another walk now as a scene with the query between them.", open_pair,
                {.argument = "AGENT",
                 .enabled =
                     [](const Workspace& workspace) {
                         return is_crowd(workspace) && current_path(workspace).has_value();
                     }}),
        Command("conflicts.find", "Find conflicts",
                "Looks for all pairs of people who collide, through the trees, and lists the deepest overlap first.",
                &CrowdInspector::find_conflicts,
                {.enabled = can_find, .also = "collision collide overlap intersect penetration clash"}),
        Command("conflicts.next", "Next conflict",
                "Shows the next two of the list that collide, alone, just before they do.", next_conflict<1>,
                {.shortcut = "Shift+PageDown", .repeats = true, .enabled = has_next_conflict<1>}),
        Command("conflicts.previous", "Previous conflict", "Shows the two of the conflict before.", next_conflict<-1>,
                {.shortcut = "Shift+PageUp", .repeats = true, .enabled = has_next_conflict<-1>}),
        Command("conflicts.go", "To a conflict",
                "Shows the two of a conflict, by its number from 0, alone, just before they collide.", go_conflict,
                {.menu = kNoMenu, .argument = "N", .enabled = has_conflicts}),
        Command("conflicts.choice", "To the choice behind the conflict",
                "Follows who made the conflict of a run that was gone to, at the last choice before it.",
                to_choice_behind, {.enabled = has_choice_behind}),
        Command("conflicts.open", "Open the conflict as a scene",
                "Opens the two of a conflict as a scene with the query between them.", open_conflict,
                {.argument = "[N]", .enabled = has_conflicts}),
        Command("crowd.back", "Back to the whole scene",
                "Leaves the scene of two for the scene or run that they were taken from.", &Excerpts::leave,
                {.shortcut = "Backspace", .enabled = &Workspace::in_excerpt}),
    };
    return in_menu("Go/Crowd", rows);
}

}  // namespace mobbscope::app
