/// Whom of a crowd commands and panels speak of.
#pragma once

#include <app/document/session.h>
#include <scene/crowd_run.h>

#include <optional>
#include <string>
#include <vector>

namespace mobbscope::app {

/// The name of the selected agent, else of the followed one; empty if there is none.
std::string agent_in_question(const Session& session);

/// Of a run: where that agent stands in CrowdRun::agents; none if there is none.
std::optional<int> run_agent_in_question(const Session& session);

/// What that agent walks at the present time.
std::optional<PlacedAgent> path_in_question(const Session& session);

/// What an agent walks at the present time; none if there is no agent of that name.
std::optional<PlacedAgent> path_in_crowd(const Session& session, const std::string& name);

/// Of all agents of a run, or a scene.
std::vector<std::string> names_in_crowd(const Session& session);

void select_in_crowd(Session& session, const std::string& name);

/// The time that the view shows; without a time cursor that of the first path.
double run_or_cursor_time(const Session& session);

/// Whether there are two who could collide.
bool can_conflict(const Session& session);

}  // namespace mobbscope::app
