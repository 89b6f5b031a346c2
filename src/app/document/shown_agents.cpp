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
    if (who.empty() || names.empty()) return false;
    // Lists ask this of each row: a set of few names against a thousand takes no time.
    NameSet missing = set_of(who);
    for (const std::string& name : names) missing.erase(name);
    return missing.empty();
}

/// A list of the view with them, in the scene's order, or without them if all are in it.
AgentNames toggled(const Workspace& workspace, const AgentNames& before, const AgentNames& who) {
    const bool out = all_in(who, before);
    const NameSet had = set_of(before);
    const NameSet meant = set_of(who);
    AgentNames after;
    for (const std::string& name : all_agents(workspace)) {
        if (meant.contains(name) ? !out : had.contains(name)) after.push_back(name);
    }
    return after;
}

void toggle_in(Workspace& workspace, AgentNames ViewState::*list, const AgentNames& who) {
    const AgentNames after = toggled(workspace, workspace.view().*list, who);
    workspace.change_view([&](ViewState& view) { view.*list = after; });
}

/// All but them and what is pinned.
AgentNames all_but(const Workspace& workspace, const AgentNames& who) {
    const NameSet kept = set_of(who);
    const NameSet pinned = set_of(workspace.view().pinned);
    AgentNames out = all_agents(workspace);
    std::erase_if(out, [&](const std::string& name) { return kept.contains(name) || pinned.contains(name); });
    return out;
}

}  // namespace

AgentNames all_agents(const Workspace& workspace) { return names_in_view(workspace.scene()); }

std::size_t agent_count(const Workspace& workspace) {
    const Scene& scene = workspace.scene();
    return scene.crowd ? scene.crowd->agents.size() : workspace.fitted().placed_agents().size();
}

AgentNames agents_of_clip(const Workspace& workspace, int clip) {
    const Scene& scene = workspace.scene();
    if (scene.crowd) return {};
    if (scene.agents.empty()) return {scene.clips[static_cast<std::size_t>(clip)].name};
    AgentNames out;
    for (const Agent& agent : scene.agents) {
        if (agent.clip == clip) out.push_back(agent.name);
    }
    return out;
}

AgentNames agents_of_group(const Workspace& workspace, const ClipGroup& group) {
    AgentNames out;
    for (const int clip : group.clips) {
        for (std::string& name : agents_of_clip(workspace, clip)) out.push_back(std::move(name));
    }
    return out;
}

AgentNames selected_agents(const Workspace& workspace) {
    const Selection& selected = workspace.selection;
    if (selected.kind == Selection::Kind::clip) return agents_of_clip(workspace, selected.index);
    const auto who = selected.on_path() ? placed_agent_of(workspace.fitted(), selected.path) : std::nullopt;
    // A query may place a clip itself where there are agents.
    if (!who || (who->agent < 0 && !workspace.scene().agents.empty())) return {};
    return {name_in_view(workspace.fitted().scene(), *who)};
}

std::string text_of_agent(const std::string& name) {
    const bool is_word = name.starts_with(kOfAgent) || name.starts_with(kOfClip) || name.starts_with(kOfGroup);
    return is_word ? kOfAgent + name : name;
}

AgentNames agents_meant(const Workspace& workspace, const std::string& text) {
    if (text.empty()) return selected_agents(workspace);
    if (text.starts_with(kOfClip)) {
        return agents_of_clip(workspace, index_of_name(clip_names(workspace), text.substr(kOfClip.size()), "clip"));
    }
    if (text.starts_with(kOfGroup)) {
        std::vector<std::string> titles;
        for (const ClipGroup& group : clip_groups(workspace)) titles.push_back(group.title);
        const int at = index_of_name(titles, text.substr(kOfGroup.size()), "group");
        return agents_of_group(workspace, clip_groups(workspace)[static_cast<std::size_t>(at)]);
    }
    const AgentNames all = all_agents(workspace);
    const std::string name = text.starts_with(kOfAgent) ? text.substr(kOfAgent.size()) : text;
    return {all[static_cast<std::size_t>(index_of_name(all, name, "agent"))]};
}

bool are_hidden(const Workspace& workspace, const AgentNames& who) { return all_in(who, workspace.view().hidden); }
bool are_pinned(const Workspace& workspace, const AgentNames& who) { return all_in(who, workspace.view().pinned); }

bool are_isolated(const Workspace& workspace, const AgentNames& who) {
    const AgentNames& hidden = workspace.view().hidden;
    const AgentNames& pinned = workspace.view().pinned;
    // Most are told apart by counting.
    const std::size_t count = agent_count(workspace);
    if (who.empty() || hidden.empty() || count > hidden.size() + who.size() + pinned.size()) return false;
    NameSet in_picture = set_of(who);
    in_picture.insert(pinned.begin(), pinned.end());
    return count == hidden.size() + in_picture.size() &&
           std::ranges::none_of(hidden, [&](const std::string& name) { return in_picture.contains(name); });
}

void toggle_hidden(Workspace& workspace, const AgentNames& who) { toggle_in(workspace, &ViewState::hidden, who); }
void toggle_pinned(Workspace& workspace, const AgentNames& who) { toggle_in(workspace, &ViewState::pinned, who); }

void toggle_isolated(Workspace& workspace, const AgentNames& who) {
    if (who.empty()) return;
    // Going from one that is alone to another, what was before the first is remembered.
    const bool remembers = workspace.isolation && workspace.isolation->hidden == workspace.view().hidden;
    AgentNames next;
    if (are_isolated(workspace, who)) {
        if (remembers) next = workspace.isolation->before;
        workspace.isolation.reset();
    } else {
        next = all_but(workspace, who);
        workspace.isolation = Isolation{next, remembers ? workspace.isolation->before : workspace.view().hidden};
    }
    workspace.change_view([&](ViewState& view) { view.hidden = next; });
}

bool are_in_foreground(const Workspace& workspace, const AgentNames& who) {
    return all_in(who, workspace.view().foreground);
}

void toggle_foreground(Workspace& workspace, const AgentNames& who) {
    show_in_foreground(workspace, toggled(workspace, workspace.view().foreground, who), [](ViewState&) {});
}

void show_in_foreground(Workspace& workspace, const AgentNames& who, const std::function<void(ViewState&)>& change) {
    const ViewState& before = workspace.view();
    const bool remembers = workspace.overview && workspace.overview->foreground == before.foreground;
    if (!remembers) workspace.overview = Overview{{}, before.camera, before.time_height, before.follow};
    workspace.overview->foreground = who;
    workspace.change_view([&](ViewState& view) {
        view.foreground = who;
        change(view);
    });
}

void show_in_full(Workspace& workspace) {
    const bool remembers = workspace.overview && workspace.overview->foreground == workspace.view().foreground;
    workspace.change_view([&](ViewState& view) {
        view.foreground.clear();
        if (!remembers) return;
        view.camera = workspace.overview->camera;
        view.time_height = workspace.overview->time_height;
        view.follow = workspace.overview->follow;
    });
    workspace.overview.reset();
}

void show_all(Workspace& workspace) {
    workspace.change_view([](ViewState& view) { view.hidden.clear(); });
}

}  // namespace mobbscope::app
