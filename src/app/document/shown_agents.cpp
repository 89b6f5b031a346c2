#include <app/document/agents.h>
#include <app/document/shown_agents.h>
#include <scene/arrangement.h>
#include <scene/crowd_run.h>

#include <algorithm>
#include <string_view>
#include <unordered_set>

namespace mobbscope::app {

namespace {

using NameSet = std::unordered_set<std::string_view>;

NameSet set_of(const AgentNames& names) { return {names.begin(), names.end()}; }

bool all_in(const AgentNames& who, const AgentNames& names) {
    const NameSet known = set_of(names);
    return !who.empty() && std::ranges::all_of(who, [&](const std::string& name) { return known.contains(name); });
}

/// Puts them into a list of the view, in the scene's order, or takes them out if all are in it.
void toggle_in(Session& session, AgentNames ViewState::*list, const AgentNames& who) {
    const AgentNames& before = session.view().*list;
    const bool out = all_in(who, before);
    const NameSet had = set_of(before);
    const NameSet meant = set_of(who);
    AgentNames after;
    for (const std::string& name : all_agents(session)) {
        if (meant.contains(name) ? !out : had.contains(name)) after.push_back(name);
    }
    session.change_view([&](ViewState& view) { view.*list = after; });
}

/// All but them and what is pinned.
AgentNames all_but(const Session& session, const AgentNames& who) {
    const NameSet kept = set_of(who);
    const NameSet pinned = set_of(session.view().pinned);
    AgentNames out = all_agents(session);
    std::erase_if(out, [&](const std::string& name) { return kept.contains(name) || pinned.contains(name); });
    return out;
}

}  // namespace

AgentNames all_agents(const Session& session) { return names_in_view(session.scene()); }

std::size_t agent_count(const Session& session) {
    const Scene& scene = session.scene();
    return scene.crowd ? scene.crowd->agents.size() : session.fitted().placed_agents().size();
}

AgentNames agents_of_clip(const Session& session, int clip) {
    const Scene& scene = session.scene();
    if (scene.crowd) return {};
    if (scene.agents.empty()) return {scene.clips[static_cast<std::size_t>(clip)].name};
    AgentNames out;
    for (const Agent& agent : scene.agents) {
        if (agent.clip == clip) out.push_back(agent.name);
    }
    return out;
}

AgentNames agents_of_group(const Session& session, const ClipGroup& group) {
    AgentNames out;
    for (const int clip : group.clips) {
        for (std::string& name : agents_of_clip(session, clip)) out.push_back(std::move(name));
    }
    return out;
}

AgentNames selected_agents(const Session& session) {
    const Selection& selected = session.selection;
    if (selected.kind == Selection::Kind::clip) return agents_of_clip(session, selected.index);
    const auto who = selected.on_path() ? placed_agent_of(session.fitted(), selected.path) : std::nullopt;
    // A query may place a clip itself where there are agents.
    if (!who || (who->agent < 0 && !session.scene().agents.empty())) return {};
    return {name_in_view(session.fitted().scene(), *who)};
}

std::string text_of_agent(const std::string& name) {
    const bool is_word = name.starts_with(kOfAgent) || name.starts_with(kOfClip) || name.starts_with(kOfGroup);
    return is_word ? kOfAgent + name : name;
}

AgentNames agents_meant(const Session& session, const std::string& text) {
    if (text.empty()) return selected_agents(session);
    if (text.starts_with(kOfClip)) {
        return agents_of_clip(session, index_of_name(clip_names(session), text.substr(kOfClip.size()), "clip"));
    }
    if (text.starts_with(kOfGroup)) {
        std::vector<std::string> titles;
        for (const ClipGroup& group : session.clip_groups()) titles.push_back(group.title);
        const int at = index_of_name(titles, text.substr(kOfGroup.size()), "group");
        return agents_of_group(session, session.clip_groups()[static_cast<std::size_t>(at)]);
    }
    const AgentNames all = all_agents(session);
    const std::string name = text.starts_with(kOfAgent) ? text.substr(kOfAgent.size()) : text;
    return {all[static_cast<std::size_t>(index_of_name(all, name, "agent"))]};
}

bool are_hidden(const Session& session, const AgentNames& who) { return all_in(who, session.view().hidden); }
bool are_pinned(const Session& session, const AgentNames& who) { return all_in(who, session.view().pinned); }

bool are_alone(const Session& session, const AgentNames& who) {
    const AgentNames& hidden = session.view().hidden;
    // Most are told apart by counting.
    const std::size_t most_in_picture = who.size() + session.view().pinned.size();
    if (who.empty() || hidden.empty() || agent_count(session) > hidden.size() + most_in_picture) return false;
    const AgentNames alone = all_but(session, who);
    return alone.size() == hidden.size() && all_in(alone, hidden);
}

void toggle_hidden(Session& session, const AgentNames& who) { toggle_in(session, &ViewState::hidden, who); }
void toggle_pinned(Session& session, const AgentNames& who) { toggle_in(session, &ViewState::pinned, who); }

void toggle_alone(Session& session, const AgentNames& who) {
    if (who.empty()) return;
    // Going from one that is alone to another, what was before the first is remembered.
    const bool remembers = session.alone && session.alone->hidden == session.view().hidden;
    AgentNames next;
    if (are_alone(session, who)) {
        if (remembers) next = session.alone->before;
        session.alone.reset();
    } else {
        next = all_but(session, who);
        session.alone = Alone{next, remembers ? session.alone->before : session.view().hidden};
    }
    session.change_view([&](ViewState& view) { view.hidden = next; });
}

void show_all(Session& session) {
    session.change_view([](ViewState& view) { view.hidden.clear(); });
}

}  // namespace mobbscope::app
