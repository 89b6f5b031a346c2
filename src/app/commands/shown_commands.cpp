#include <app/commands/command.h>
#include <app/document/shown_agents.h>

#include <stdexcept>
#include <string>

namespace mobbscope::app {

namespace {

using Change = void (*)(Session&, const AgentNames&);
using Holds = bool (*)(const Session&, const AgentNames&);

Command about_agents(std::string_view id, std::string_view title, std::string_view key, std::string_view doc,
                     Change change, Holds holds) {
    const auto act = [change](Session& session, const std::string& name) {
        const AgentNames who = agents_meant(session, name);
        if (who.empty()) {
            throw std::invalid_argument(name.empty() ? "no agent is selected: select one, or a clip that one plays"
                                                     : "no agent plays it");
        }
        change(session, who);
    };
    const auto is_so = [holds](const Session& session) { return holds(session, selected_agents(session)); };
    return {id, title, doc, act, {.shortcut = key, .argument = "[NAME]", .checked = is_so}};
}

/// Where a run's people stand is what it is about.
bool may_be_laid_out(const Session& session) { return has_scene(session) && !session.crowd(); }
std::string_view why_not_laid_out(const Session&) { return "a run is shown where it takes place"; }

Command arrange_command() {
    Command out = option_command(view_option("arrange"));
    out.enabled = {may_be_laid_out, why_not_laid_out};
    // One of two is a tick in the menu.
    out.choices = {};
    out.chosen = {};
    out.checked = [](const Session& session) { return session.view().arrange == Arrange::grid; };
    return out;
}

}  // namespace

std::vector<Command> shown_commands() {
    const std::vector<Command> rows{
        about_agents("agent.hide", "Hide", "V",
                     "Takes the selected agent, or the agents of the selected clip, out of the picture, or brings them "
                     "back; answers stay.",
                     toggle_hidden, are_hidden),
        about_agents("agent.solo", "Show alone", "I",
                     "Hides all others but those that are pinned; once more shows what was in the picture before.",
                     toggle_alone, are_alone),
        about_agents("agent.pin", "Pin", "P",
                     "Pinned ones stay in the picture when another is shown alone, and keep their colour where others "
                     "dim.",
                     toggle_pinned, are_pinned),
        Command("agent.show_all", "Show all", "Brings everybody who is hidden back into the picture.", show_all,
                {.shortcut = "Shift+V",
                 .enabled = {[](const Session& session) { return !session.view().hidden.empty(); },
                             [](const Session&) { return std::string_view("nobody is hidden"); }}}),
        arrange_command(),
    };
    return in_menu("View/Agents", rows);
}

}  // namespace mobbscope::app
