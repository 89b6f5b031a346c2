/// What the right-click menus hold, for each kind of thing. The ids stand in one place: a command that is about such a
/// thing is one more word in a row here.
#pragma once

#include <app/ui/agent_parts.h>
#include <app/ui/command_menu.h>

#include <vector>

namespace mobbscope::app {

/// Of the picture, where there is nothing under the mouse.
std::vector<MenuEntry> picture_menu(const Session& session);
/// Of what is selected: an agent, a node, a sample, a clip or a query; of nothing none.
std::vector<MenuEntry> selection_menu(const Session& session);
/// What takes agents out of the picture and brings them back.
std::vector<MenuEntry> shown_menu(const Workspace& workspace, const ListedAgents& listed);
/// Of an event of the query in view.
std::vector<MenuEntry> test_menu(const Workspace& workspace, const QueryInspector& queries, int event);
/// Of a moment, seconds.
std::vector<MenuEntry> time_menu(const Session& session, double time);
/// Of a candidate of the last choice, of a play of who chose, and of a conflict that was found.
std::vector<MenuEntry> candidate_menu(const CrowdInspector& crowds, const Workspace& workspace, int candidate);
std::vector<MenuEntry> play_menu(int play);
std::vector<MenuEntry> conflict_menu(int conflict);

}  // namespace mobbscope::app
