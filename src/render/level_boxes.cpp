#include <render/level_boxes.h>
#include <render/world_box.h>

#include <algorithm>

namespace mobbscope {

std::vector<int> shown_nodes(const mobb::Tree& tree, const LevelRange& levels) {
    std::vector<int> out;
    const auto nodes = tree.nodes();
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        const mobb::Node& node = nodes[i];
        const bool on_level = node.level >= levels.first && node.level <= levels.last;
        const bool above = node.level < levels.first && node.is_leaf();
        if (levels.leaves ? node.is_leaf() : on_level || above) out.push_back(static_cast<int>(i));
    }
    return out;
}

int last_shown_level(const mobb::Tree& tree, const LevelRange& levels) {
    return std::min(levels.leaves ? tree.depth() - 1 : levels.last, tree.depth() - 1);
}

LevelStyle level_style(int level, int first, int last) {
    if (first >= last) return {0.09f, 0.95f, 1.5f};
    // 0 for the coarsest shown, 1 for the finest.
    const float t = std::clamp(static_cast<float>(level - first) / static_cast<float>(last - first), 0.0f, 1.0f);
    return {0.025f + 0.075f * t, 0.45f + 0.5f * t, 0.9f + 0.9f * t};
}

void refine_small_boxes(DrawList& list) {
    constexpr float kSmall = 26;  // pixels between opposite corners, at least
    for (BoxInstance& box : list.boxes) {
        if (box.state != BoxState::level) continue;
        float height = 0;
        for (const glm::vec3& extent : box.extents) height += 2 * std::abs(extent.z);
        const float pixels = height * list.lens.pixels_per_metre(box.center);
        const float part = std::clamp(pixels / kSmall, 0.0f, 1.0f);
        box.width *= 0.5f + 0.5f * part;
        box.edge.a *= 0.45f + 0.55f * part;
    }
}

void add_level_boxes(DrawList& list, const Subject& subject, const LevelRange& levels, float scale) {
    const mobb::Tree& tree = subject.placed.tree();
    const int last = last_shown_level(tree, levels);
    for (const int node : shown_nodes(tree, levels)) {
        const LevelStyle style =
            levels.leaves ? level_style(0, 0, 0) : level_style(subject.placed.node(node).level, levels.first, last);
        BoxInstance box = node_box(subject, node, list.space);
        box.state = BoxState::level;
        box.fill = with_alpha(subject.color, style.face);
        box.edge = with_alpha(outlining(subject.color, list.palette), style.edge);
        box.width = style.width * scale;
        list.boxes.push_back(box);
    }
}

}  // namespace mobbscope
