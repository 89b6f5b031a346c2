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

constexpr double kBefore = 0.5;  // seconds before a conflict

/// The first placed agents of a run are its agents.
std::optional<int> participant_named(const Session& session, const std::string& name) {
    if (session.crowd()) return run_agent_by_name(*session.crowd(), name);
    const auto& all = session.fitted().placed_agents();
    const auto at = std::find_if(all.begin(), all.end(), [&](const PlacedAgent& who) { return who.name == name; });
    if (at == all.end()) return std::nullopt;
    return static_cast<int>(at - all.begin());
}

}  // namespace

bool has_selected_agent(const Session& session) {
    // What a run's agents play is the simulation's.
    return !session.crowd() && session.selection.on_path() && session.selection.path.agent >= 0;
}

bool shows_bare_clips(const Session& session) {
    return !session.empty() && !session.crowd() && session.scene().agents.empty();
}

bool has_true_agent(const Session& session) { return has_selected_agent(session) && !shows_bare_clips(session); }

bool has_selected_of_several(const Session& session) {
    return has_true_agent(session) && session.fitted().placed_agents().size() > 1;
}

std::string_view why_no_agent(const Session& session) {
    if (session.crowd()) return "a run is not edited";
    if (shows_bare_clips(session)) return "these are clips: make them agents first (Edit / Make these agents)";
    return has_selected_agent(session) ? "there is only one agent" : "no agent is selected";
}

std::string_view why_nothing_to_place(const Session& session) {
    if (session.crowd()) return "a run is not edited";
    return shows_bare_clips(session) ? "no clip is selected" : "no agent is selected";
}

int selected_agent(const Session& session) { return session.selection.path.agent; }

std::string selected_agent_name(const Session& session) {
    return placed_agent_of(session.fitted(), session.selection.path)->name;
}

void edit_selected_agent(Session& session, const EditName& name, const std::function<void(Scene&, int agent)>& change) {
    const int agent = selected_agent(session);
    session.edit(name, [&](Scene& scene) {
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
    for (const PlacedAgent& who : session.fitted().placed_agents()) out.push_back(who.name);
    return out;
}

int index_of_name(const std::vector<std::string>& names, std::string_view name, const std::string& what) {
    const auto at = std::find(names.begin(), names.end(), name);
    if (at == names.end()) {
        throw std::invalid_argument("there is no " + what + ' ' + in_quotes(name) + did_you_mean(name, names));
    }
    return static_cast<int>(at - names.begin());
}

std::string current_agent(const Session& session) {
    if (session.selection.on_path() && session.selection.path.agent >= 0) {
        const auto index = static_cast<std::size_t>(session.selection.path.agent);
        if (!session.crowd()) return session.fitted().placed_agents()[index].name;
        const int run_agent = session.fitted().scene().agents[index].run_agent;
        return session.crowd()->agents[static_cast<std::size_t>(run_agent)].name;
    }
    return session.view().follow;
}

std::optional<int> current_run_agent(const Session& session) {
    if (!session.crowd()) return std::nullopt;
    return run_agent_by_name(*session.crowd(), current_agent(session));
}

std::optional<PlacedAgent> current_path(const Session& session) {
    const auto index = participant_named(session, current_agent(session));
    if (!index) return std::nullopt;
    return session.fitted().placed_agents()[static_cast<std::size_t>(*index)];
}

std::vector<std::string> agent_names(const Session& session) {
    if (!session.crowd()) return path_names(session);
    std::vector<std::string> out;
    for (const CrowdAgent& agent : session.crowd()->agents) out.push_back(agent.name);
    return out;
}

void select_agent_named(Session& session, const std::string& name) {
    if (const auto index = participant_named(session, name))
        session.select({Selection::Kind::path, {*index, -1, 0}, -1});
}

double shown_time(const Session& session) {
    if (session.crowd()) return run_time(session.scene(), session.view());
    return session.view().time.value_or(session.time_span().t0);
}

std::size_t people_in(const Session& session) {
    return session.crowd() ? session.crowd()->agents.size() : session.fitted().placed_agents().size();
}

bool can_conflict(const Session& session) { return people_in(session) > 1; }

std::string conflict_summary(const Session& session) {
    double seconds = 0;
    for (const SceneConflict& conflict : *session.conflicts()) seconds += conflict.facts.seconds();
    return conflict_count(session.conflicts()->size(), people_in(session), seconds);
}

ConflictPlace conflict_place(const Session& session, const SceneConflict& conflict) {
    const double before = std::max(conflict.begin() - kBefore, session.time_span().t0);
    if (!session.crowd()) return {conflict.a, conflict.b, before};
    const bool by_a = made_by_a(*session.crowd(), conflict);
    ConflictPlace out{by_a ? conflict.a : conflict.b, by_a ? conflict.b : conflict.a, before};
    const int play = by_a ? conflict.a_play : conflict.b_play;
    const CrowdAgent& agent = session.crowd()->agents[static_cast<std::size_t>(out.followed.agent)];
    // A first play was placed, not chosen.
    if (play > 0 && last_chosen(agent, before) != play) {
        out.time = agent.plays[static_cast<std::size_t>(play)].chosen_at;
    }
    return out;
}

}  // namespace mobbscope::app
