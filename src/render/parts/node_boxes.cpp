#include <render/drawlist/cut.h>
#include <render/parts/node_boxes.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace mobbscope {

namespace {

/// How much of the picture the edges of boxes cover, in coarse cells.
class InkMap {
  public:
    InkMap(PictureSize size, float cell)
        : cell_(cell),
          columns_(static_cast<int>(std::ceil(static_cast<float>(size.width) / cell))),
          rows_(static_cast<int>(std::ceil(static_cast<float>(size.height) / cell))),
          ink_(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_), 0.0f) {}

    void add(const BoxInstance& box, const ViewProjection& projection) {
        each_place(box, projection,
                   [&](float& cell, float length) { cell += length * box.width * box.edge.a / (cell_ * cell_); });
    }

    /// The mean along the box's edges: 1 where edges could cover everything.
    float around(const BoxInstance& box, const ViewProjection& projection) {
        float sum = 0, run = 0;
        each_place(box, projection, [&](float& cell, float length) {
            sum += cell * length;
            run += length;
        });
        return run > 0 ? sum / run : 0;
    }

  private:
    /// Calls `visit` with the cell and the length of each piece of an edge inside the picture.
    template <class Visit>
    void each_place(const BoxInstance& box, const ViewProjection& projection, Visit visit) {
        const auto corners = box_corners(box);
        for (const auto& [a, b] : kBoxEdges) {
            const auto from = projection.project(corners[a]);
            const auto to = projection.project(corners[b]);
            if (!from || !to) continue;
            const float length = glm::length(*to - *from);
            const int pieces = std::clamp(static_cast<int>(length / cell_) + 1, 1, 512);
            for (int i = 0; i < pieces; ++i) {
                const glm::vec2 at = glm::mix(*from, *to, (static_cast<float>(i) + 0.5f) / static_cast<float>(pieces));
                const glm::vec2 place = glm::floor(at / cell_);
                if (!(place.x >= 0 && place.y >= 0 && place.x < static_cast<float>(columns_) &&
                      place.y < static_cast<float>(rows_)))
                    continue;
                visit(ink_[static_cast<std::size_t>(place.y) * static_cast<std::size_t>(columns_) +
                           static_cast<std::size_t>(place.x)],
                      length / static_cast<float>(pieces));
            }
        }
    }

    float cell_;
    int columns_;
    int rows_;
    std::vector<float> ink_;
};

/// The longest way between two corners in the picture, pixels.
float diagonal(const BoxInstance& box, const ViewProjection& projection) {
    const auto corners = box_corners(box);
    float longest = 0;
    for (unsigned i = 0; i < 4; ++i) {
        const auto from = projection.project(corners[i]);
        const auto to = projection.project(corners[7 - i]);
        // Partly behind the eye, a box is as large as can be.
        if (!from || !to) return static_cast<float>(projection.size.width + projection.size.height);
        longest = std::max(longest, glm::length(*to - *from));
    }
    return longest;
}

constexpr float kOutsideRange = 0.2f;  // of its opacity that a box keeps whose figure is outside what is looked for

double figure_of_box(const BoxInstance& box, BoxFigures figures) {
    return figures[static_cast<std::size_t>(box.id.agent)][static_cast<std::size_t>(box.id.index)];
}

}  // namespace

std::vector<int> shown_nodes(const mobb::Tree& tree, const LevelRange& levels) {
    std::vector<int> out;
    for (int i = 0; i < static_cast<int>(tree.nodes().size()); ++i) {
        const int level = tree.level(i);
        const bool on_level = level >= levels.first && level <= levels.last;
        const bool above = level < levels.first && tree.is_leaf(i);
        if (levels.leaves ? tree.is_leaf(i) : on_level || above) out.push_back(i);
    }
    return out;
}

std::vector<int> shown_nodes(const DrawnAgent& agent, const LevelRange& levels) {
    const mobb::Tree& tree = agent.placed.tree();
    std::vector<int> out = shown_nodes(tree, levels);
    if (!agent.subtree) return out;
    std::erase_if(out, [&](int node) { return !is_within(tree, node, *agent.subtree); });
    if (out.empty()) out.push_back(*agent.subtree);
    return out;
}

bool is_within(const mobb::Tree& tree, int node, int top) {
    const mobb::Node& inner = tree.node(node);
    const mobb::Node& outer = tree.node(top);
    return tree.level(node) >= tree.level(top) && inner.first >= outer.first && inner.end() <= outer.end();
}

int last_shown_level(const mobb::Tree& tree, const LevelRange& levels) {
    return std::min(levels.leaves ? tree.depth() - 1 : levels.last, tree.depth() - 1);
}

LevelStyle level_style(int level, int first, int last) {
    if (first >= last) return {0.09f, 0.95f, 1.5f};
    // 0 for the coarsest shown, 1 for the finest.
    const float t = std::clamp(static_cast<float>(level - first) / static_cast<float>(last - first), 0.0f, 1.0f);
    return {0.025f + 0.075f * t, 0.7f + 0.25f * t, 0.9f + 0.9f * t, t};
}

Rgba level_tint(Rgba color, const LevelStyle& style, const Palette& palette) {
    constexpr float kMost = 0.45f;  // more would leave no colour
    const float by = kMost * (2 * style.bright - 1);
    const Rgba strong = palette.dark ? Rgba(1) : Rgba(0, 0, 0, 1);
    return with_alpha(by < 0 ? mix_colors(color, palette.background, -by) : mix_colors(color, strong, by), color.a);
}

void refine_crowded_boxes(DrawList& list, float scale) {
    const float small = 26 * scale;  // pixels between opposite corners, at least
    InkMap ink(list.size, 12 * scale);
    std::vector<BoxInstance*> boxes;
    for (BoxInstance& box : list.boxes) {
        if (box.state != BoxState::level || !is_seen(list.slab, box)) continue;
        const float part = std::clamp(diagonal(box, list.projection) / small, 0.0f, 1.0f);
        box.width *= 0.5f + 0.5f * part;
        box.edge.a *= 0.45f + 0.55f * part;
        ink.add(box, list.projection);
        boxes.push_back(&box);
    }
    constexpr float kMost = 0.45f;  // of the ground may be covered by edges
    for (BoxInstance* box : boxes) {
        const float part = std::min(1.0f, kMost / std::max(ink.around(*box, list.projection), 1e-6f));
        box->edge.a *= part;
        // Faces add up faster than edges: each lies over all that are behind it.
        box->fill.a *= part * part;
    }
}

void add_level_boxes(DrawList& list, std::span<const DrawnAgent> agents, const LevelRange& levels, float scale) {
    for (const DrawnAgent& agent : agents) {
        if (!agent.is_whole()) continue;
        const mobb::Tree& tree = agent.placed.tree();
        const int last = last_shown_level(tree, levels);
        std::vector<int> nodes = shown_nodes(agent, levels);
        const bool around = agent.subtree && std::ranges::find(nodes, *agent.subtree) == nodes.end();
        if (around) nodes.push_back(*agent.subtree);
        for (const int node : nodes) {
            const int level = tree.level(node);
            const LevelStyle style = levels.leaves ? level_style(0, 0, 0) : level_style(level, levels.first, last);
            const Rgba color = level_tint(agent.color, style, list.palette);
            BoxInstance box = node_box(agent, node, list.space);
            box.state = BoxState::level;
            box.fill = with_alpha(color, around && node == *agent.subtree ? 0 : style.face);
            box.edge = with_alpha(outlining(color, list.palette), style.edge);
            box.width = style.width * scale;
            list.boxes.push_back(box);
        }
    }
}

void color_boxes(DrawList& list, BoxFigures figures, const ColorScale& scale) {
    for (BoxInstance& box : list.boxes) {
        if (box.state != BoxState::level) continue;
        const double value = figure_of_box(box, figures);
        const Rgba color = scale.color(value, list.palette);
        const float kept = scale.chosen && scale.outside(value) ? kOutsideRange : 1;
        box.fill = with_alpha(color, kept * box.fill.a);
        box.edge = with_alpha(outlining(color, list.palette), kept * box.edge.a);
    }
}

BoxInstance node_box(const DrawnAgent& agent, int node, const DrawnSpace& space) {
    const mobb::Box box = world_box(agent.placed, node);
    const double w = agent.placed.time_scale();
    BoxInstance out;
    out.center = space.point(box.center.x, box.center.y, box.center.z / w);
    const std::array<glm::dvec3, 3> edges = mobb::half_edges(box);
    for (std::size_t i = 0; i < 3; ++i) out.extents[i] = space.extent(edges[i], w);
    out.id = {agent.index, ObjectId::Kind::box, node};
    // Participants side by side at each level: 2^32 leaves room for every node index.
    out.order = {DrawLayer::nodes, agent.placed.tree().level(node),
                 (static_cast<std::int64_t>(agent.index) << 32) + node};
    return out;
}

}  // namespace mobbscope
