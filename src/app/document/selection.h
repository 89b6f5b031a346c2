/// What is selected, or under the mouse: the same thing in every panel.
#pragma once

#include <render/drawlist/draw_list.h>
#include <scene/fitted_scene.h>

#include <array>
#include <optional>
#include <string_view>
#include <vector>

namespace mobbscope::app {

/// An agent that can be selected. In a scene without agents each clip counts as one, and so does a side of a query that
/// places a clip by itself.
struct AgentRef {
    int agent = -1;  ///< index into FittedScene::placed_agents(), or -1:
    int query = -1;  ///< then the side of this query
    int side = 0;    ///< 0 a, 1 b
    friend bool operator==(const AgentRef&, const AgentRef&) = default;
};

struct Selection {
    enum class Kind { none, path, node, sample, clip, query };
    Kind kind = Kind::none;
    AgentRef path;   ///< of an agent (Kind::path), or the agent of a node or sample
    int index = -1;  ///< node, sample, clip or query
    friend bool operator==(const Selection&, const Selection&) = default;

    bool on_path() const { return kind == Kind::path || kind == Kind::node || kind == Kind::sample; }
    /// Of the agent. Requires on_path.
    AgentPart part() const {
        if (kind == Kind::path) return {};
        return {kind == Kind::node ? AgentPart::Kind::node : AgentPart::Kind::sample, index};
    }
};

/// As files and scripts call the kinds, in their order.
inline constexpr std::array<std::string_view, 6> kSelectionKinds{"none", "path", "node", "sample", "clip", "query"};

/// The agents of a picture of `view`: all, or the two of its query.
template <class Use>
void for_each_agent_in_view(const FittedScene& fitted, const ViewState& view, const Use& use) {
    if (!view.query) {
        for (const PlacedAgent& who : fitted.placed_agents()) use(who);
        return;
    }
    const SceneQuery asked = fitted.queries()[static_cast<std::size_t>(*view.query)];
    use(asked.a);
    use(asked.b);
}

/// The agent that ObjectId::agent means in a picture of `view`.
AgentRef agent_in_view(const FittedScene& fitted, const ViewState& view, int agent);
/// ... and back: its index among the picture's agents; none if it is not in the picture.
std::optional<int> index_in_view(const FittedScene& fitted, const ViewState& view, const AgentRef& path);

/// Its clip and placement; none if there is no such agent (any more).
std::optional<PlacedAgent> placed_agent_of(const FittedScene& fitted, const AgentRef& path);

/// Whether the scene has it.
bool exists(const FittedScene& fitted, const Selection& selection);

/// Whether a picture of `view` has the disk and the node of `view.projection`.
bool has_projection(const FittedScene& fitted, const ViewState& view);

/// The selection after a change of the scene. A node of a tree that was fitted anew becomes its path, as the number
/// means another node now. What is gone becomes nothing.
Selection remapped(const Selection& selection, const FittedScene& before, const FittedScene& now);

/// What goes with a selection where the same scene has another fit: of a node the one over the same samples.
Selection counterpart(const Selection& selection, const FittedScene& from, const FittedScene& to);

}  // namespace mobbscope::app
