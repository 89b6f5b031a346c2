#include <app/document/run_agents.h>
#include <scene/crowd_run.h>
#include <scene/crowd_scene.h>

#include <algorithm>

namespace mobbscope::app {

namespace {

/// Of a run the first participants are its people.
std::optional<int> choice_index(const Session& session, const std::string& name) {
    if (session.crowd()) return run_agent_by_name(*session.crowd(), name);
    const auto& all = session.fitted().placed_agents();
    const auto at = std::find_if(all.begin(), all.end(), [&](const PlacedAgent& who) { return who.name == name; });
    if (at == all.end()) return std::nullopt;
    return static_cast<int>(at - all.begin());
}

}  // namespace

std::string agent_in_question(const Session& session) {
    if (session.selection.on_path() && session.selection.path.participant >= 0) {
        const auto index = static_cast<std::size_t>(session.selection.path.participant);
        if (!session.crowd()) return session.fitted().placed_agents()[index].name;
        const int run_agent = session.fitted().scene().agents[index].run_agent;
        return session.crowd()->agents[static_cast<std::size_t>(run_agent)].name;
    }
    return session.view().follow;
}

std::optional<int> run_agent_in_question(const Session& session) {
    if (!session.crowd()) return std::nullopt;
    return run_agent_by_name(*session.crowd(), agent_in_question(session));
}

std::optional<PlacedAgent> path_in_question(const Session& session) {
    return path_in_crowd(session, agent_in_question(session));
}

std::optional<PlacedAgent> path_in_crowd(const Session& session, const std::string& name) {
    const auto index = choice_index(session, name);
    if (!index) return std::nullopt;
    return session.fitted().placed_agents()[static_cast<std::size_t>(*index)];
}

std::vector<std::string> names_in_crowd(const Session& session) {
    std::vector<std::string> out;
    if (session.crowd()) {
        for (const CrowdAgent& agent : session.crowd()->agents) out.push_back(agent.name);
    } else {
        for (const PlacedAgent& who : session.fitted().placed_agents()) out.push_back(who.name);
    }
    return out;
}

void select_in_crowd(Session& session, const std::string& name) {
    if (const auto index = choice_index(session, name)) session.select({Selection::Kind::path, {*index, -1, 0}, -1});
}

double run_or_cursor_time(const Session& session) {
    if (session.crowd()) return run_time(session.scene(), session.view());
    return session.view().time.value_or(session.time_span().t0);
}

bool can_conflict(const Session& session) {
    return (session.crowd() ? session.crowd()->agents.size() : session.fitted().placed_agents().size()) > 1;
}

}  // namespace mobbscope::app
