/// How the history and the menu call what was done: what has changed, and to which value.
#pragma once

#include <app/document/history.h>
#include <mobb/clip.h>

#include <string>

namespace mobbscope::app {

/// "moving A: x 1.20 m". It joins the edit before if that placed the same agent in the same way, and is still open.
EditName name_of_placing(const std::string& agent, const mobb::Placement& before, const mobb::Placement& after);

/// "stepping to 17", "showing level 3"; of looking around all that is of one kind has one group.
EditName name_of_looking(const Document& from, const ViewState& to);

}  // namespace mobbscope::app
