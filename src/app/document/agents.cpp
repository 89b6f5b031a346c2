#include <app/document/agents.h>
#include <base/text.h>
#include <conflicts/conflicts.h>
#include <crowd/simulation/choice.h>
#include <scene/crowd_run.h>
#include <scene/crowd_scene.h>
#include <scene/scene_edits.h>

#include <algorithm>
#include <stdexcept>

namespace mobbscope::app {

namespace {

/// The first placed agents of a run are its agents.
std::optional<int> participant_named(const Workspace& workspace, const std::string& name) {
    if (workspace.crowd()) return run_agent_by_name(*workspace.crowd(), name);
    const auto& all = workspace.fitted().placed_agents();
    const auto at = std::find_if(all.begin(), all.end(), [&](const PlacedAgent& who) { return who.name == name; });
    if (at == all.end()) return std::nullopt;
    return static_cast<int>(at - all.begin());
}

}  // namespace

bool has_selected_agent(const Workspace& workspace) {
    // What a run's agents play is the simulation's.
    return !workspace.crowd() && workspace.selection.on_path() && workspace.selection.path.agent >= 0;
}

bool shows_bare_clips(const Workspace& workspace) {
    return !workspace.empty() && !workspace.crowd() && workspace.scene().agents.empty();
}

bool has_true_agent(const Workspace& workspace) {
    return has_selected_agent(workspace) && !shows_bare_clips(workspace);
}

bool has_selected_of_several(const Workspace& workspace) {
    return has_true_agent(workspace) && workspace.fitted().placed_agents().size() > 1;
}

std::string_view why_no_agent(const Workspace& workspace) {
    if (workspace.crowd()) return "a run cannot be edited";
    if (shows_bare_clips(workspace)) return "these are clips: make them agents first (Edit / Make these agents)";
    return has_selected_agent(workspace) ? "there is only one agent" : "no agent is selected";
}

std::string_view why_nothing_to_place(const Workspace& workspace) {
    if (workspace.crowd()) return "a run cannot be edited";
    return shows_bare_clips(workspace) ? "no clip is selected" : "no agent is selected";
}

int selected_agent(const Workspace& workspace) { return workspace.selection.path.agent; }

std::string selected_agent_name(const Workspace& workspace) {
    return placed_agent_of(workspace.fitted(), workspace.selection.path)->name;
}

void edit_selected_agent(Workspace& workspace, const EditName& name,
                         const std::function<void(Scene&, int agent)>& change) {
    const int agent = selected_agent(workspace);
    workspace.edit(name, [&](Scene& scene) {
        add_agents_for_clips(scene);
        change(scene, agent);
    });
}

std::vector<std::string> clip_names(const Workspace& workspace) {
    std::vector<std::string> out;
    for (const SceneClip& clip : workspace.scene().clips) out.push_back(clip.name);
    return out;
}

std::vector<std::string> path_names(const Workspace& workspace) {
    std::vector<std::string> out;
    for (const PlacedAgent& who : workspace.fitted().placed_agents()) out.push_back(who.name);
    return out;
}

NameList names_of_agents(const FittedScene& fitted) {
    const auto* all = &fitted.placed_agents();
    return {all->size(), [all](std::size_t i) { return (*all)[i].name; }};
}

int index_of_name(const std::vector<std::string>& names, std::string_view name, const std::string& what) {
    const auto at = std::find(names.begin(), names.end(), name);
    if (at == names.end()) {
        throw std::invalid_argument("there is no " + what + ' ' + in_quotes(name) + did_you_mean(name, names));
    }
    return static_cast<int>(at - names.begin());
}

std::optional<AgentRef> player_of(const Workspace& workspace, int clip) {
    const auto plays = [&](const AgentRef& path) {
        const auto who = placed_agent_of(workspace.fitted(), path);
        return who && clip_played(workspace, *who) == clip;
    };
    if (workspace.selection.on_path() && plays(workspace.selection.path)) return workspace.selection.path;
    for (int side = 0; side < (workspace.view().query ? 2 : 0); ++side) {
        if (const AgentRef path = agent_in_view(workspace.fitted(), workspace.view(), side); plays(path)) return path;
    }
    for (int i = 0; i < static_cast<int>(workspace.fitted().placed_agents().size()); ++i) {
        if (const AgentRef path{i, -1, 0}; plays(path)) return path;
    }
    return std::nullopt;
}

std::string current_agent(const Workspace& workspace) {
    if (workspace.selection.on_path() && workspace.selection.path.agent >= 0) {
        const auto index = static_cast<std::size_t>(workspace.selection.path.agent);
        if (!workspace.crowd()) return workspace.fitted().placed_agents()[index].name;
        const int run_agent = workspace.fitted().scene().agents[index].run_agent;
        return workspace.crowd()->agents[static_cast<std::size_t>(run_agent)].name;
    }
    return workspace.view().follow;
}

std::optional<int> current_run_agent(const Workspace& workspace) {
    if (!workspace.crowd()) return std::nullopt;
    return run_agent_by_name(*workspace.crowd(), current_agent(workspace));
}

std::optional<PlacedAgent> current_path(const Workspace& workspace) {
    const auto index = participant_named(workspace, current_agent(workspace));
    if (!index) return std::nullopt;
    return workspace.fitted().placed_agents()[static_cast<std::size_t>(*index)];
}

std::vector<std::string> agent_names(const Workspace& workspace) {
    if (!workspace.crowd()) return path_names(workspace);
    std::vector<std::string> out;
    for (const CrowdAgent& agent : workspace.crowd()->agents) out.push_back(agent.name);
    return out;
}

void select_agent_named(Workspace& workspace, const std::string& name) {
    if (const auto index = participant_named(workspace, name))
        workspace.select({Selection::Kind::path, {*index, -1, 0}, -1});
}

double shown_time(const Workspace& workspace) {
    if (workspace.crowd()) return run_time(workspace.scene(), workspace.view());
    return workspace.view().time.value_or(time_span(workspace).t0);
}

std::size_t people_in(const Workspace& workspace) {
    return workspace.crowd() ? workspace.crowd()->agents.size() : workspace.fitted().placed_agents().size();
}

bool can_conflict(const Workspace& workspace) { return people_in(workspace) > 1; }

}  // namespace mobbscope::app
