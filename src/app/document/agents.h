/// Agents by name and by selection: which one commands edit, and which one the panels of a crowd are about.
#pragma once

#include <app/document/session.h>

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace mobbscope::app {

// The agent that commands edit: the selected one, or the one whose node or sample is selected.

/// Whether an agent is selected; in a scene without agents a clip that is seen counts as one, as an edit makes it one.
bool has_selected_agent(const Session& session);

/// Whether it is an agent of the scene, and no clip.
bool has_true_agent(const Session& session);

/// Whether such an agent is selected and there is another.
bool has_selected_of_several(const Session& session);

/// Whether what is seen are clips: there are no agents yet.
bool shows_bare_clips(const Session& session);

/// Why a command about an agent of the scene cannot be done; and one that a clip may have too, as it makes it an agent.
std::string_view why_no_agent(const Session& session);
std::string_view why_nothing_to_place(const Session& session);

/// Its index among the scene's agents, or its clip's in a scene without agents, which is the agent's that an edit
/// makes. Requires has_selected_agent.
int selected_agent(const Session& session);
std::string selected_agent_name(const Session& session);

/// Edits it, after clips became agents where there are none.
void edit_selected_agent(Session& session, const EditName& name, const std::function<void(Scene&, int agent)>& change);

std::vector<std::string> clip_names(const Session& session);

/// The names of agents, or of the clips where there are no agents.
std::vector<std::string> path_names(const Session& session);

/// The index of `name` in `names`, the first of equals. Throws std::invalid_argument, with the nearest name, if there
/// is none; `what` they name: "agent".
int index_of_name(const std::vector<std::string>& names, std::string_view name, const std::string& what);

// The current agent: the selected one, else the one that the view follows.

/// Its name; empty if there is none.
std::string current_agent(const Session& session);

/// Its index in CrowdRun::agents; none without a run, or if no agent is current.
std::optional<int> current_run_agent(const Session& session);

/// Its clip and placement at the view's time.
std::optional<PlacedAgent> current_path(const Session& session);

/// The names of all agents of a run, or of a scene in the order in which FittedScene::placed_agents() begins.
std::vector<std::string> agent_names(const Session& session);

void select_agent_named(Session& session, const std::string& name);

/// The time that the picture shows, seconds; without a time cursor the begin of the first path.
double shown_time(const Session& session);

/// How many there are: of a run its people.
std::size_t people_in(const Session& session);

/// Whether there are two agents that could collide.
bool can_conflict(const Session& session);

/// "2 conflicts among 22 agents, 1.3 s in all", as `mobbscope conflicts` says it. Requires Session::conflicts.
std::string conflict_summary(const Session& session);

/// How a conflict is looked at.
struct ConflictPlace {
    PlacedAgent followed, other;
    double time = 0;  ///< global seconds
};

/// Half a second before the two touch, along with one of them. Of a run it is who made the conflict; where that play is
/// not yet chosen then, or the next one is already, the time is that of its choice, so that it is the last choice.
ConflictPlace conflict_place(const Session& session, const SceneConflict& conflict);

}  // namespace mobbscope::app
