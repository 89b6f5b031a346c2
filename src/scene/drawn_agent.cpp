#include <base/name_list.h>
#include <base/text.h>
#include <mobb/separation.h>
#include <scene/arrangement.h>
#include <scene/crowd_run.h>
#include <scene/crowd_scene.h>
#include <scene/drawn_agent.h>
#include <scene/view_state.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <unordered_set>

namespace mobbscope {

namespace {

constexpr std::size_t kLongestLabel = 24;

// The colours of Okabe and Ito that no outcome has, then tints of them.
constexpr std::array<std::uint32_t, 8> kAgentColors{0xE69F00, 0x56B4E9, 0xCC79A7, 0x0072B2,
                                                    0xF3CF80, 0xABDAF4, 0xE6BCD3, 0x6BA9D0};

Rgba palette_color(int index) { return hex(kAgentColors[static_cast<std::size_t>(index) % kAgentColors.size()]); }

bool fits_a_label(const std::string& name) {
    return name.size() <= kLongestLabel || code_points(name).size() <= kLongestLabel;
}

DrawnAgent make_drawn_agent(const FittedScene& fitted, const ViewState& view, const PlacedAgent& who, int index,
                            const Rgba& color, const NameList& names) {
    const Scene& scene = fitted.scene();
    const SceneClip& clip = scene.clips[static_cast<std::size_t>(who.clip)];
    DrawnAgent out{{fitted.tree(who), shown_placement(fitted, view, who)},
                   who.name,
                   names.shortened(who.name, fits_a_label),
                   color,
                   index,
                   clip.members.empty() ? clip.skeleton.get() : nullptr};
    out.members = drawn_members(scene, who, out.clip().placement());
    if (who.agent < 0) return out;
    const Agent& agent = scene.agents[static_cast<std::size_t>(who.agent)];
    out.run_agent = agent.run_agent;
    if (scene.crowd) {
        const CrowdAgent& person = scene.crowd->agents[static_cast<std::size_t>(agent.run_agent)];
        out.goes_on = static_cast<std::size_t>(agent.play) + 1 < person.plays.size();
    }
    return out;
}

/// The samples that hold at some time between two.
mobb::SampleRange samples_between(const mobb::PlacedClip& clip, double begin, double end) {
    const int first = mobb::first_ending_after(clip, 0, clip.count(), begin);
    int last = mobb::first_ending_after(clip, 0, clip.count(), end);
    if (last < clip.count() && clip.time(last) < end) ++last;
    return {first, std::max(last - first, 0)};
}

/// Whose part is shown alone. Throws ViewMismatch if there is no such agent, or it has no such node.
DrawnAgent& with_subtree(std::vector<DrawnAgent>& agents, const DrawnNode& part) {
    if (part.agent < 0 || static_cast<std::size_t>(part.agent) >= agents.size()) {
        throw ViewMismatch("subtree", "there is no participant " + std::to_string(part.agent) + ": " +
                                          std::to_string(agents.size()) + (agents.size() == 1 ? " is" : " are") +
                                          " drawn, counted from 0");
    }
    DrawnAgent& agent = agents[static_cast<std::size_t>(part.agent)];
    const std::size_t nodes = agent.placed.tree().nodes().size();
    if (part.node >= 0 && static_cast<std::size_t>(part.node) < nodes) return agent;
    throw ViewMismatch("subtree", "there is no node " + std::to_string(part.node) + " in the tree of " +
                                      in_quotes(agent.name) + ": it has " + std::to_string(nodes) + ", counted from 0");
}

}  // namespace

const std::string& name_in_view(const Scene& scene, const DrawnAgent& agent) {
    return agent.run_agent >= 0 ? scene.crowd->agents[static_cast<std::size_t>(agent.run_agent)].name : agent.name;
}

mobb::Placement shown_placement(const FittedScene& fitted, const ViewState& view, const PlacedAgent& who) {
    mobb::Placement out = who.placement;
    if (!is_in_grid(fitted.scene(), view)) return out;
    // What stands in the grid is an agent, or without agents a clip.
    const int index = who.agent >= 0 ? who.agent : who.clip;
    out.translate += fitted.grid()[static_cast<std::size_t>(index)].offset;
    return out;
}

std::vector<mobb::PlacedClip> drawn_members(const Scene& scene, const PlacedAgent& who, const mobb::Placement& at) {
    std::vector<mobb::PlacedClip> out;
    for (const mobb::ClipPtr& member : scene.clips[static_cast<std::size_t>(who.clip)].members)
        out.emplace_back(*member, at);
    return out;
}

Rgba agent_color(const Scene& scene, const PlacedAgent& who, int index) {
    if (who.agent >= 0) {
        const Agent& agent = scene.agents[static_cast<std::size_t>(who.agent)];
        if (agent.color) return Rgba(agent.color->r, agent.color->g, agent.color->b, 255) / 255.0f;
        // All that one person plays looks alike.
        if (agent.run_agent >= 0) index = agent.run_agent;
    }
    return palette_color(index);
}

std::array<Rgba, 2> query_colors(const Scene& scene, const PlacedAgent& a, const PlacedAgent& b) {
    const int index_a = a.agent >= 0 ? a.agent : 0;
    const Rgba first = agent_color(scene, a, index_a);
    const Rgba second = agent_color(scene, b, b.agent >= 0 ? b.agent : index_a + 1);
    if (second != first) return {first, second};
    const Rgba other = palette_color(index_a + 1);
    return {first, other != first ? other : palette_color(index_a + 2)};
}

std::vector<DrawnAgent> drawn_agents(const FittedScene& fitted, const ViewState& view) {
    std::vector<DrawnAgent> out;
    const Scene& scene = fitted.scene();
    const std::unordered_set<std::string_view> hidden(view.hidden.begin(), view.hidden.end());
    const std::unordered_set<std::string_view> pinned(view.pinned.begin(), view.pinned.end());
    const std::unordered_set<std::string_view> foreground(view.foreground.begin(), view.foreground.end());
    const auto mark = [&](DrawnAgent& agent, const PlacedAgent& who) {
        // What a query places itself is no agent, unless clips are all there is.
        if (who.agent < 0 && !scene.agents.empty()) return;
        const std::string& name = name_in_view(scene, who);
        agent.hidden = hidden.contains(name);
        agent.pinned = pinned.contains(name);
        if (view.query || foreground.empty()) return;
        agent.named = foreground.contains(name);
        agent.outlined = !agent.named && !agent.pinned;
    };
    if (!view.query) {
        const std::vector<PlacedAgent>& all = fitted.placed_agents();
        const NameList names(all.size(), [&](std::size_t i) { return all[i].name; });
        for (const PlacedAgent& who : all) {
            const int index = static_cast<int>(out.size());
            out.push_back(make_drawn_agent(fitted, view, who, index, agent_color(scene, who, index), names));
            mark(out.back(), who);
            if (is_in_grid(scene, view)) out.back().cell = fitted.grid()[static_cast<std::size_t>(index)];
        }
        if (view.subtree && !scene.crowd) with_subtree(out, *view.subtree).subtree = view.subtree->node;
        if (scene.crowd && view.show == Show::space_time) {
            const double time = run_time(scene, view);
            for (DrawnAgent& agent : out) {
                agent.window = samples_between(agent.clip(), time - view.time_window, time + view.time_window);
            }
        }
        return out;
    }
    const std::size_t count = fitted.queries().size();
    if (*view.query < 0 || static_cast<std::size_t>(*view.query) >= count) {
        throw ViewMismatch("query", "there is no query " + std::to_string(*view.query) + ": the scene has " +
                                        (count == 0 ? "none" : std::to_string(count) + ", counted from 0"));
    }
    const SceneQuery query = fitted.queries()[static_cast<std::size_t>(*view.query)];
    const NameList names({query.a.name, query.b.name});
    const auto [color_a, color_b] = query_colors(scene, query.a, query.b);
    out.push_back(make_drawn_agent(fitted, view, query.a, 0, color_a, names));
    out.push_back(make_drawn_agent(fitted, view, query.b, 1, color_b, names));
    mark(out[0], query.a);
    mark(out[1], query.b);
    // What is said of a query with bodies is true of these two disks alone.
    for (const auto& [side, who] : {std::pair(&out[0], &query.a), std::pair(&out[1], &query.b)}) {
        if (who->member < 0) continue;
        side->name += disk_words(*who);
        side->label += disk_words(*who);
    }
    // Two sides of one name could not be told apart.
    if (out[1].name == out[0].name) {
        out[0].name += " (A)";
        out[1].name += " (B)";
    }
    if (out[1].label == out[0].label) {
        out[0].label += " (A)";
        out[1].label += " (B)";
    }
    return out;
}

std::optional<int> sample_at(const DrawnAgent& agent, double time) {
    const mobb::PlacedClip& clip = agent.clip();
    // Whoever was last seen at this very moment is there. Times are rounded.
    if (!agent.goes_on && clip.clip().runs() && std::abs(time - agent.end()) <= mobb::kMinOverlap)
        return clip.count() - 1;
    if (time < agent.begin() || time >= agent.end()) return std::nullopt;
    const int i = mobb::first_ending_after(clip, 0, clip.count(), time);
    return i < clip.count() ? std::optional(i) : std::nullopt;
}

mobb::Box world_box(const mobb::PlacedTree& tree, int node) {
    mobb::Box box = tree.tree().box(node);
    const mobb::PlacedClip& clip = tree.placed_clip();
    const auto turn = [&](glm::dvec3 v) {
        const glm::dvec2 turned = clip.rotation()(glm::dvec2(v.x, v.y));
        return glm::dvec3(turned.x, turned.y, v.z);
    };
    if (mobb::info(box.kind).axes == mobb::BoxAxes::world) {
        // Its test wraps it again along the world's axes.
        const glm::dvec2 half = mobb::half_in_world(glm::dvec2(box.half), clip.rotation());
        box.half = {half.x, half.y, box.half.z};
    } else {
        for (glm::dvec3& axis : box.axes) axis = turn(axis);
        box.drift = clip.rotation()(box.drift);
    }
    const mobb::Placement& placement = clip.placement();
    box.center = turn(box.center) +
                 glm::dvec3(placement.translate.x, placement.translate.y, tree.time_scale() * placement.start);
    return box;
}

}  // namespace mobbscope
