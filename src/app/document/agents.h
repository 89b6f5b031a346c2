/// Agents by name and by selection: which one commands edit, and which one the panels of a crowd are about.
#pragma once

#include <app/document/workspace.h>
#include <base/name_list.h>

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace mobbscope::app {

// The agent that commands edit: the selected one, or the one whose node or sample is selected.

/// Whether an agent is selected; in a scene without agents a clip that is seen counts as one, as an edit makes it one.
bool has_selected_agent(const Workspace& workspace);

/// Whether it is an agent of the scene, and no clip.
bool has_true_agent(const Workspace& workspace);

/// Whether such an agent is selected and there is another.
bool has_selected_of_several(const Workspace& workspace);

/// Whether what is seen are clips: there are no agents yet.
bool shows_bare_clips(const Workspace& workspace);

/// Why a command about an agent of the scene cannot be done; and one that a clip may have too, as it makes it an agent.
std::string_view why_no_agent(const Workspace& workspace);
std::string_view why_nothing_to_place(const Workspace& workspace);

/// Its index among the scene's agents, or its clip's in a scene without agents, which is the agent's that an edit
/// makes. Requires has_selected_agent.
int selected_agent(const Workspace& workspace);
std::string selected_agent_name(const Workspace& workspace);

/// Edits it, after clips became agents where there are none.
void edit_selected_agent(Workspace& workspace, const EditName& name,
                         const std::function<void(Scene&, int agent)>& change);

std::vector<std::string> clip_names(const Workspace& workspace);

/// The names of agents, or of the clips where there are no agents.
std::vector<std::string> path_names(const Workspace& workspace);

/// ... to be shortened. Lives as long as the scene.
NameList names_of_agents(const FittedScene& fitted);

/// The index of `name` in `names`, the first of equals. Throws std::invalid_argument, with the nearest name, if there
/// is none; `what` they name: "agent".
int index_of_name(const std::vector<std::string>& names, std::string_view name, const std::string& what);

/// Who plays that clip: the selected agent if it does, else a side of the query in view, else the first; none if nobody
/// in the picture does.
std::optional<AgentRef> player_of(const Workspace& workspace, int clip);

// The current agent: the selected one, else the one that the view follows.

/// Its name; empty if there is none.
std::string current_agent(const Workspace& workspace);

/// Its index in CrowdRun::agents; none without a run, or if no agent is current.
std::optional<int> current_run_agent(const Workspace& workspace);

/// Its clip and placement at the view's time.
std::optional<PlacedAgent> current_path(const Workspace& workspace);

/// The names of all agents of a run, or of a scene in the order in which FittedScene::placed_agents() begins.
std::vector<std::string> agent_names(const Workspace& workspace);

void select_agent_named(Workspace& workspace, const std::string& name);

/// The time that the picture shows, seconds; without a time cursor the begin of the first path.
double shown_time(const Workspace& workspace);

/// How many there are: of a run its people.
std::size_t people_in(const Workspace& workspace);

/// Whether there are two agents that could collide.
bool can_conflict(const Workspace& workspace);

}  // namespace mobbscope::app
