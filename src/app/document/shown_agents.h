/// Which agents are in the picture: hidden, alone, pinned. By the names that views have for them.
#pragma once

#include <app/document/workspace.h>

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace mobbscope::app {

using AgentNames = std::vector<std::string>;

/// All that can be hidden (names_in_view), in order.
AgentNames all_agents(const Workspace& workspace);
std::size_t agent_count(const Workspace& workspace);  ///< how many
/// Those that play a clip, < scene().clips.size(); in a scene without agents the clip itself. Of a run none.
AgentNames agents_of_clip(const Workspace& workspace, int clip);
AgentNames agents_of_group(const Workspace& workspace, const ClipGroup& group);
/// The selected agent, or those of the selected clip; none if neither is selected.
AgentNames selected_agents(const Workspace& workspace);
/// Those that a text means: "walk" or "agent:walk" an agent, "clip:walk" those of a clip, "group:short" those of a
/// group of clips; without a text the selected ones. Throws std::invalid_argument, with the nearest name, if there is
/// none.
AgentNames agents_meant(const Workspace& workspace, const std::string& text);
/// The text that means an agent, whatever it is called.
std::string text_of_agent(const std::string& name);
inline const std::string kOfAgent = "agent:";
inline const std::string kOfClip = "clip:";
inline const std::string kOfGroup = "group:";

/// Whether all of them are hidden; false for none.
bool are_hidden(const Workspace& workspace, const AgentNames& who);
bool are_pinned(const Workspace& workspace, const AgentNames& who);
/// Whether they, with what is pinned, are all that is in the picture, and others are not.
bool are_isolated(const Workspace& workspace, const AgentNames& who);

/// Hides them, or shows them if all of them are hidden.
void toggle_hidden(Workspace& workspace, const AgentNames& who);
/// Hides all others but those that are pinned; of those that are alone shows what was in the picture before.
void toggle_isolated(Workspace& workspace, const AgentNames& who);
void toggle_pinned(Workspace& workspace, const AgentNames& who);
void show_all(Workspace& workspace);

/// Whether all of them are in the foreground; false for none.
bool are_in_foreground(const Workspace& workspace, const AgentNames& who);
/// Brings them there beside who is there, or lets them go if all of them are.
void toggle_foreground(Workspace& workspace, const AgentNames& who);
/// They alone, from a view of their own: `change` makes it.
void show_in_foreground(Workspace& workspace, const AgentNames& who, const std::function<void(ViewState&)>& change);
/// All in full again, seen from where they were before.
void show_in_full(Workspace& workspace);

}  // namespace mobbscope::app
