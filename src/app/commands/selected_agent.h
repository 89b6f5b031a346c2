/// The agent that commands edit: the selected one, or the one whose node or sample is selected.
#pragma once

#include <app/document/session.h>

#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace mobbscope::app {

/// Whether an agent is selected; in a scene without agents a clip that is seen counts as one, as an edit makes it one.
bool has_selected_agent(const Session& session);

/// Why a command about an agent cannot be done.
std::string_view why_no_agent(const Session& session);

/// Its index among the scene's agents, or its clip's in a scene without agents, which is the agent's that an edit
/// makes. Requires has_selected_agent.
int selected_agent(const Session& session);
std::string selected_agent_name(const Session& session);

/// Edits it as "<doing> <its name>", after clips became agents where there are none.
void edit_selected_agent(Session& session, const std::string& doing,
                         const std::function<void(Scene&, int agent)>& change);

std::vector<std::string> clip_names(const Session& session);

/// The names of agents, or of the clips where there are no agents.
std::vector<std::string> path_names(const Session& session);

/// The index of a path among them. Throws std::invalid_argument, with the nearest name, if there is none.
int path_by_name(const Session& session, const std::string& name);

}  // namespace mobbscope::app
