#include <app/commands/selected_agent.h>
#include <base/text.h>
#include <scene/scene_edits.h>

#include <algorithm>
#include <stdexcept>

namespace mobbscope::app {

bool has_selected_agent(const Session& session) {
    // What a run's agents play is the simulation's.
    return !session.crowd() && session.selection.on_path() && session.selection.path.participant >= 0;
}

std::string_view why_no_agent(const Session& session) {
    if (session.crowd()) return "a run is not edited";
    return has_selected_agent(session) ? "there is only one agent" : "no agent is selected";
}

int selected_agent(const Session& session) { return session.selection.path.participant; }

std::string selected_agent_name(const Session& session) {
    return placed_agent_of(session.fitted(), session.selection.path)->name;
}

void edit_selected_agent(Session& session, const std::string& doing,
                         const std::function<void(Scene&, int agent)>& change) {
    const int agent = selected_agent(session);
    session.edit({doing + ' ' + selected_agent_name(session), ""}, [&](Scene& scene) {
        add_agents_for_clips(scene);
        change(scene, agent);
    });
}

std::vector<std::string> clip_names(const Session& session) {
    std::vector<std::string> out;
    for (const SceneClip& clip : session.scene().clips) out.push_back(clip.name);
    return out;
}

std::vector<std::string> path_names(const Session& session) {
    std::vector<std::string> out;
    for (const PlacedAgent& participant : session.fitted().placed_agents()) out.push_back(participant.name);
    return out;
}

int path_by_name(const Session& session, const std::string& name) {
    const std::vector<std::string> names = path_names(session);
    const auto at = std::find(names.begin(), names.end(), name);
    if (at == names.end()) {
        throw std::invalid_argument("there is no agent " + in_quotes(name) + did_you_mean(name, names));
    }
    return static_cast<int>(at - names.begin());
}

}  // namespace mobbscope::app
