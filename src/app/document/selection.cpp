#include <app/document/selection.h>
#include <explain/compared_fits.h>

#include <algorithm>

namespace mobbscope::app {

namespace {

AgentRef path_of_side(const FittedScene& fitted, int query, int side) {
    const SceneQuery asked = fitted.queries()[static_cast<std::size_t>(query)];
    const PlacedAgent& who = side == 0 ? asked.a : asked.b;
    // With agents, the placed agents are these in their order. Of a body it is one of its disks that is asked.
    return who.agent >= 0 && who.member < 0 ? AgentRef{who.agent, -1, 0} : AgentRef{-1, query, side};
}

}  // namespace

AgentRef agent_in_view(const FittedScene& fitted, const ViewState& view, int agent) {
    return view.query ? path_of_side(fitted, *view.query, agent) : AgentRef{agent, -1, 0};
}

std::optional<int> index_in_view(const FittedScene& fitted, const ViewState& view, const AgentRef& path) {
    const int count = view.query ? 2 : static_cast<int>(fitted.placed_agents().size());
    if (!view.query) return path.agent >= 0 && path.agent < count ? std::optional(path.agent) : std::nullopt;
    for (int side = 0; side < count; ++side) {
        if (path_of_side(fitted, *view.query, side) == path) return side;
    }
    return std::nullopt;
}

std::optional<PlacedAgent> placed_agent_of(const FittedScene& fitted, const AgentRef& path) {
    if (path.agent >= 0) {
        const auto index = static_cast<std::size_t>(path.agent);
        if (index >= fitted.placed_agents().size()) return std::nullopt;
        return fitted.placed_agents()[index];
    }
    if (path.query < 0 || static_cast<std::size_t>(path.query) >= fitted.queries().size()) return std::nullopt;
    const SceneQuery asked = fitted.queries()[static_cast<std::size_t>(path.query)];
    return path.side == 0 ? asked.a : asked.b;
}

bool exists(const FittedScene& fitted, const Selection& selection) {
    const auto within = [&](std::size_t count) {
        return selection.index >= 0 && static_cast<std::size_t>(selection.index) < count;
    };
    switch (selection.kind) {
        case Selection::Kind::none:
            return true;
        case Selection::Kind::clip:
            return within(fitted.scene().clips.size());
        case Selection::Kind::query:
            return within(fitted.queries().size());
        case Selection::Kind::path:
        case Selection::Kind::node:
        case Selection::Kind::sample:
            break;
    }
    const auto agent = placed_agent_of(fitted, selection.path);
    if (!agent) return false;
    if (selection.kind == Selection::Kind::path) return true;
    const mobb::Tree& tree = fitted.tree(*agent);
    return within(selection.kind == Selection::Kind::node ? tree.nodes().size()
                                                          : static_cast<std::size_t>(tree.clip().count()));
}

bool has_projection(const FittedScene& fitted, const ViewState& view) {
    const DiskProjection& asked = *view.projection;
    const AgentRef agent = agent_in_view(fitted, view, asked.agent);
    if (!exists(fitted, {Selection::Kind::node, agent, asked.node})) return false;
    const mobb::Node& node = fitted.tree(*placed_agent_of(fitted, agent)).nodes()[static_cast<std::size_t>(asked.node)];
    return asked.sample >= node.first && asked.sample < node.end();
}

namespace {

/// Of a run the agents are others at another time: the person stays selected, and what is of one of its plays as long
/// as that is there.
Selection still_of_run(const Selection& selection, const FittedScene& before, const FittedScene& now) {
    const auto& was = before.scene().agents;
    const auto index = static_cast<std::size_t>(selection.path.agent);
    if (selection.path.agent < 0 || index >= was.size()) return {};
    const auto& agents = now.scene().agents;
    const auto is_it = [&](const Agent& agent) {
        return agent.run_agent == was[index].run_agent && agent.play == was[index].play;
    };
    const auto at = std::find_if(agents.begin(), agents.end(), is_it);
    if (at == agents.end() || selection.kind == Selection::Kind::path) {
        return {Selection::Kind::path, {was[index].run_agent, -1, 0}, -1};
    }
    return {selection.kind, {static_cast<int>(at - agents.begin()), -1, 0}, selection.index};
}

}  // namespace

Selection remapped(const Selection& selection, const FittedScene& before, const FittedScene& now) {
    if (&before != &now && selection.on_path() && before.scene().crowd && before.scene().crowd == now.scene().crowd) {
        const Selection out = still_of_run(selection, before, now);
        return exists(now, out) ? out : Selection{};
    }
    if (selection.kind == Selection::Kind::node) {
        const auto was = placed_agent_of(before, selection.path);
        const auto is = placed_agent_of(now, selection.path);
        if (was && is && &before.tree(*was) != &now.tree(*is)) {
            return {Selection::Kind::path, selection.path, -1};
        }
    }
    return exists(now, selection) ? selection : Selection{};
}

Selection counterpart(const Selection& selection, const FittedScene& from, const FittedScene& to) {
    if (selection.kind != Selection::Kind::node || !exists(from, selection)) return selection;
    const int clip = placed_agent_of(from, selection.path)->clip;
    const mobb::Tree &before = from.tree(clip), &now = to.tree(clip);
    if (&before == &now) return selection;
    return {selection.kind, selection.path, node_over_same_samples(before, selection.index, now)};
}

}  // namespace mobbscope::app
