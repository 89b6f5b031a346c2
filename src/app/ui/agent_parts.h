/// What lists and menus offer for agents: eye, pin, shown alone.
#pragma once

#include <app/document/shown_agents.h>
#include <app/ui/ui.h>

#include <string>

namespace mobbscope::app {

/// One agent, or all of a clip or a group, in the scene panel's lists and in menus.
struct ListedAgents {
    std::string text;  ///< as agents_meant takes it
    AgentNames who;    ///< what it means
};

/// Pixels that a row leaves to agent_buttons, and those of them that are always drawn.
float agent_buttons_width(const Ui& ui);
float shown_buttons_width(const Ui& ui, const ListedAgents& listed);

/// The last things on a row's line: shown alone, pin and eye. `lit`: the row is under the mouse; else only those are
/// drawn that say something. `mark`: the row's; ".solo", ".pin" and ".eye" are added.
void agent_buttons(Ui& ui, const std::string& mark, const ListedAgents& listed, bool lit);

}  // namespace mobbscope::app
