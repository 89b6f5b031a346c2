#include <app/commands/command.h>
#include <app/document/agents.h>
#include <app/document/shown_agents.h>

#include <stdexcept>
#include <string>
#include <vector>

namespace mobbscope::app {

namespace {

using Change = void (*)(Workspace&, const AgentNames&);
using Holds = bool (*)(const Workspace&, const AgentNames&);

bool has_selected_agents(const Workspace& workspace) { return !selected_agents(workspace).empty(); }
std::string_view why_nobody(const Workspace& workspace) {
    return workspace.selection.kind == Selection::Kind::clip ? "no agent plays the clip" : "no agent is selected";
}

/// About those that are selected.
Command of_selected(std::string_view id, std::string_view title, std::string_view key, std::string_view doc,
                    Change change, Holds holds, std::string_view also) {
    const auto act = [change](Workspace& workspace) { change(workspace, selected_agents(workspace)); };
    const auto is_so = [holds](const Workspace& workspace) { return holds(workspace, selected_agents(workspace)); };
    return {id,
            title,
            doc,
            act,
            {.shortcut = key, .enabled = {has_selected_agents, why_nobody}, .checked = is_so, .also = also}};
}

/// What agents_meant takes.
std::vector<std::string> meanings(const Workspace& workspace) {
    std::vector<std::string> out;
    for (const std::string& name : all_agents(workspace)) out.push_back(text_of_agent(name));
    for (const ClipGroup& group : clip_groups(workspace)) {
        if (!agents_of_group(workspace, group).empty()) out.push_back(kOfGroup + group.title);
    }
    const std::vector<std::string> clips = clip_names(workspace);
    for (int clip = 0; clip < static_cast<int>(clips.size()); ++clip) {
        if (!agents_of_clip(workspace, clip).empty()) out.push_back(kOfClip + clips[static_cast<std::size_t>(clip)]);
    }
    return out;
}

/// The same about others, as the lists' buttons have it.
Command of_named(std::string_view id, std::string_view title, std::string_view doc, Change change,
                 std::string_view also) {
    const auto act = [change](Workspace& workspace, const std::string& text) {
        const AgentNames who = agents_meant(workspace, text);
        if (who.empty()) throw std::invalid_argument("no agent plays it");
        change(workspace, who);
    };
    return {id,
            title,
            doc,
            act,
            {.menu = kNoMenu, .argument = "NAME|clip:NAME|group:NAME", .choices = meanings, .also = also}};
}

/// Where a run's people stand is what it is about.
bool may_be_laid_out(const Workspace& workspace) { return has_scene(workspace) && !workspace.crowd(); }
std::string_view why_not_laid_out() { return "a run cannot be shown in a grid"; }

Command arrange_command() {
    Command out = option_command(view_option("arrange"));
    out.enabled = {may_be_laid_out, why_not_laid_out};
    // One of two is a tick in the menu.
    out.choices = {};
    out.chosen = {};
    out.checked = [](const Workspace& workspace) { return workspace.view().arrange == Arrange::grid; };
    return out;
}

}  // namespace

std::vector<Command> shown_commands() {
    const std::vector<Command> rows{
        of_selected("agent.hide", "Hide", "V",
                    "Hides the selected agent, or the agents of the selected clip, or shows them again; answers stay.",
                    toggle_hidden, are_hidden, "invisible visibility eye"),
        of_selected("agent.solo", "Show alone", "I",
                    "Hides all but the selected agent, or the selected clip's, and those that are pinned; again: shows "
                    "what was shown before.",
                    toggle_isolated, are_isolated, "isolate only local solo"),
        of_selected("agent.pin", "Pin", "P",
                    "Keeps the selected agent in the picture when another is shown alone, and its colour where others "
                    "dim.",
                    toggle_pinned, are_pinned, "keep lock"),
        Command("agent.show_all", "Show all", "Shows all hidden agents again.", show_all,
                {.shortcut = "Shift+V",
                 .enabled = {[](const Workspace& workspace) { return !workspace.view().hidden.empty(); },
                             [] { return std::string_view("no agent is hidden"); }},
                 .also = "unhide reveal visible everybody"}),
        of_selected("agent.foreground", "In the foreground", "",
                    "Draws the selected agent, or the selected clip's, whole and named beside those in the foreground, "
                    "and leaves an outline of all others; again: takes it back.",
                    toggle_foreground, are_in_foreground, "highlight spotlight ghost others"),
        Command("agent.all_in_full", "Everybody in full",
                "Ends the foreground: draws all agents, from the camera before it.", show_in_full,
                {.enabled = [](const Workspace& workspace) { return !workspace.view().foreground.empty(); },
                 .also = "unhide reveal reset"}),
        arrange_command(),
        of_named("agents.hide", "Hide by name", "Hides an agent, or all of a clip or a group of clips, or shows them.",
                 toggle_hidden, "invisible visibility"),
        of_named("agents.solo", "Show alone by name",
                 "Shows an agent, or all of a clip or a group of clips, with those that are pinned alone.",
                 toggle_isolated, "isolate only solo filter"),
        of_named("agents.foreground", "In the foreground by name",
                 "Draws an agent, or all of a clip or a group of clips, whole and named, and outlines of all others.",
                 toggle_foreground, "highlight spotlight"),
        of_named("agents.pin", "Pin by name", "Pins an agent, or all of a clip or a group of clips.", toggle_pinned,
                 "keep lock"),
    };
    return in_menu("View/Agents", rows);
}

}  // namespace mobbscope::app
