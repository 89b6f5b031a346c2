/// Going along with somebody of a crowd, for commands.
#pragma once

#include <app/document/session.h>

#include <string>

namespace mobbscope::app {

bool follows(const Session& session);

/// Follows and selects an agent, with so many metres around it in the picture. Throws std::invalid_argument if there is
/// no agent of that name.
void follow_agent(Session& session, const std::string& name, double metres);

/// Brings so many metres around the followed agent into the picture.
void frame_followed(Session& session, double metres);

/// Puts the followed agent in the middle again, seen from as far as before.
void center_followed(Session& session);

}  // namespace mobbscope::app
