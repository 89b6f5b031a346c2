#include <base/text.h>
#include <render/layout/legend.h>
#include <render/parts/node_boxes.h>
#include <render/parts/paths.h>
#include <render/query/query_boxes.h>
#include <render/text/labels.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

namespace mobbscope {

namespace {

constexpr int kMostLevels = 5;
constexpr std::size_t kMostAgents = 8;  // more would cover the picture; the rest are counted

using Mark = LegendEntry::Mark;

LegendEntry remark(std::string text) { return {.mark = Mark::remark, .color = Rgba(0), .text = std::move(text)}; }

LegendEntry dot_entry(Rgba color, std::string text) {
    return {.mark = Mark::disk, .color = color, .text = std::move(text)};
}

/// The colours of the levels that are drawn; of many, a few from the coarsest to the finest.
void add_level_colors(std::vector<LegendEntry>& entries, const DrawList& list, std::span<const DrawnAgent> agents) {
    std::set<int> drawn;
    for (const BoxInstance& box : list.boxes) drawn.insert(box.order.level);
    const std::vector<int> levels(drawn.begin(), drawn.end());
    const int count = std::min(static_cast<int>(levels.size()), kMostLevels);
    for (int i = 0; i < count; ++i) {
        const std::size_t which =
            count < 2 ? 0 : (static_cast<std::size_t>(i) * (levels.size() - 1)) / static_cast<std::size_t>(count - 1);
        const Rgba color = level_color(levels[which], deepest_level(agents), list.palette);
        entries.push_back({Mark::box, outlining(color, list.palette), with_alpha(color, 0.3f), 1.5f, kSolid,
                           "level " + std::to_string(levels[which])});
    }
}

/// Levels look alike in all colours, so they are shown in the text's.
void add_levels(std::vector<LegendEntry>& entries, const DrawList& list, std::span<const DrawnAgent> agents,
                const LevelRange& levels) {
    const Rgba color = list.palette.quiet_text;
    if (levels.leaves) {
        entries.push_back({Mark::box, color, with_alpha(color, 0.2f), 1.5f, kSolid, "leaves"});
        return;
    }
    int last = 0;
    for (const DrawnAgent& agent : agents) last = std::max(last, last_shown_level(agent.placed.tree(), levels));
    const int first = std::min(levels.first, last);
    // Of many levels the coarsest and the finest tell how those between look.
    const bool few = last - first < kMostLevels;
    for (int level = first; level <= last; level += few ? 1 : last - first) {
        const LevelStyle style = level_style(level, levels.first, last);
        entries.push_back({Mark::box, with_alpha(color, style.edge), with_alpha(color, 2.2f * style.face), style.width,
                           kSolid,
                           "level " + std::to_string(level) +
                               (few              ? ""
                                : level == first ? ", coarsest"
                                                 : ", finest")});
    }
}

void add_query(std::vector<LegendEntry>& entries, const DrawList& list, std::span<const DrawnAgent> sides,
               const QueryProgress& progress, PairOutline outline, std::vector<LegendEntry>& remarks) {
    for (const DrawnAgent& side : sides) {
        if (side.hidden) continue;
        const Rgba color = outline == PairOutline::owner
                               ? side.color
                               : pair_style(outline, side, progress.event.outcome, list.palette).color;
        entries.push_back({Mark::box, color, with_alpha(side.color, 0.3f), 2, kSolid, side.label + ", under test"});
    }
    const auto present = [&](BoxState state) {
        return std::any_of(list.boxes.begin(), list.boxes.end(),
                           [&](const BoxInstance& b) { return b.state == state; });
    };
    const std::pair<BoxState, const char*> outcomes[] = {{BoxState::separated, "separated in space"},
                                                         {BoxState::apart_in_time, "apart in time"},
                                                         {BoxState::overlap, "overlap without a hit so far"},
                                                         {BoxState::hit, "hit"}};
    for (const auto& [state, text] : outcomes) {
        // What the test under way found is shown between its boxes.
        if (present(state) || box_state(progress.event.outcome) == state)
            entries.push_back(line_entry(outcome_style(state, list.palette), text));
    }
    const bool earlier = outline == PairOutline::owner && (!progress.nodes[0].empty() || !progress.nodes[1].empty());
    if (earlier) remarks.push_back(remark("fine boxes: the latest test of a node"));
}

/// A free box is fitted with w metres to the second but drawn with another height, so it is not seen as a cuboid.
bool has_sheared_boxes(const DrawList& list, std::span<const DrawnAgent> agents) {
    return std::any_of(list.boxes.begin(), list.boxes.end(), [&](const BoxInstance& box) {
        if (!box.pickable) return false;
        const mobb::PlacedTree& tree = agents[static_cast<std::size_t>(box.id.agent)].placed;
        return mobb::info(tree.node(box.id.index).box.kind).axes == mobb::BoxAxes::space_time &&
               std::abs(list.space.time_height / tree.time_scale() - 1) > 0.01;
    });
}

/// What kinds of boxes look like that the paper does not have.
std::optional<std::string> beyond_the_paper(const DrawList& list, std::span<const DrawnAgent> agents) {
    for (const BoxInstance& box : list.boxes) {
        if (!box.pickable) continue;
        const mobb::PlacedTree& tree = agents[static_cast<std::size_t>(box.id.agent)].placed;
        const std::string_view looks = mobb::info(tree.node(box.id.index).box.kind).looks;
        if (!looks.empty()) return std::string(looks);
    }
    return std::nullopt;
}

std::string short_number(double value) { return formatted("%.3g", value); }

struct LegendLayout {
    float row, mark, padding, gap;
    explicit LegendLayout(float size)
        : row(std::round(1.55f * size)),
          mark(std::round(1.7f * size)),
          padding(panel_padding(size)),
          gap(std::round(0.7f * size)) {}
};

}  // namespace

LegendEntry line_entry(const LineStyle& style, std::string text) {
    return {.color = style.color, .width = style.width, .dash = style.dash, .text = std::move(text)};
}

std::vector<LegendEntry> agent_entries(std::span<const DrawnAgent> agents) {
    std::vector<LegendEntry> entries;
    std::size_t more = 0;
    for (const DrawnAgent& agent : agents) {
        if (agent.hidden) continue;
        if (entries.size() < kMostAgents) {
            entries.push_back(dot_entry(agent.color, agent.label));
        } else {
            ++more;
        }
    }
    if (more > 0) entries.push_back(dot_entry(Rgba(0), "and " + std::to_string(more) + " more"));
    return entries;
}

std::vector<LegendEntry> legend_entries(const DrawList& list, std::span<const DrawnAgent> agents, const ViewState& view,
                                        const Emphasis& emphasis, const QueryProgress* progress) {
    std::vector<LegendEntry> entries;
    std::vector<LegendEntry> remarks;
    if (progress) {
        if (view.boxes) add_query(entries, list, agents, *progress, pair_outline(view), remarks);
        if (!view.boxes && view.disks) entries = agent_entries(agents);
        if (emphasis.dims) {
            const Rgba dim = mix_colors(list.palette.panel, list.palette.quiet_text, kOutOfFocus);
            entries.push_back(dot_entry(with_alpha(dim, 1), "dim: outside the nodes under test"));
        }
        if (emphasis.hits) {
            entries.push_back({.mark = Mark::double_ring, .color = list.palette.hit, .text = "samples that hit"});
        }
    } else {
        // In a grid each has its name.
        if (!agents.front().cell) entries = agent_entries(agents);
        if (view.boxes && !list.boxes.empty()) {
            if (view.color_by == ColorBy::level) {
                add_level_colors(entries, list, agents);
            } else {
                add_levels(entries, list, agents, view.levels);
            }
        }
    }
    if (emphasis.cursor) entries.push_back(line_entry({list.palette.accent, 1.3f}, "time cursor"));
    if (emphasis.cuts()) {
        entries.push_back({.mark = Mark::ring, .color = list.palette.text, .text = "sample at that time"});
    }
    if (const auto text = beyond_the_paper(list, agents)) remarks.push_back(remark(*text));
    if (has_sheared_boxes(list, agents)) {
        remarks.push_back(remark("boxes look sheared: fitted"));
        remarks.push_back(remark("with " + short_number(agents[0].placed.time_scale()) + " m/s, drawn with " +
                                 short_number(list.space.time_height) + " m/s"));
    }
    entries.insert(entries.end(), remarks.begin(), remarks.end());
    return entries;
}

glm::vec2 legend_size(std::span<const LegendEntry> entries, float text_size) {
    if (entries.empty()) return glm::vec2(0);
    const LegendLayout layout(text_size);
    float widest = 0;
    for (const LegendEntry& entry : entries) {
        const bool remark = entry.mark == Mark::remark;
        const float indent = remark ? 0 : layout.mark + layout.gap;
        widest = std::max(widest, indent + Font::of(FontFace::text).width(entry.text, text_size));
    }
    return {std::ceil(2 * layout.padding + widest),
            2 * layout.padding + layout.row * static_cast<float>(entries.size()) - 0.3f * text_size};
}

void add_legend(DrawList& list, glm::vec2 corner, float text_size) {
    const LegendLayout layout(text_size);
    const glm::vec2 size = legend_size(list.legend, text_size);
    list.panels.push_back(text_panel({corner, corner + size}, list.palette, text_size));
    glm::vec2 at = corner + layout.padding;
    const float height = line_height(FontFace::text, text_size);
    for (const LegendEntry& entry : list.legend) {
        const bool remark = entry.mark == Mark::remark;
        const glm::vec2 middle = at + glm::vec2(0.5f * layout.mark, 0.5f * height);
        const float r = 0.36f * text_size;
        if (entry.mark == Mark::disk) {
            list.panels.push_back({{middle - r, middle + r}, r, entry.color, Rgba(0), 0});
        } else if (entry.mark == Mark::ring || entry.mark == Mark::double_ring) {
            const bool twice = entry.mark == Mark::double_ring;
            const float unit = text_size / 11;
            list.panels.push_back({{middle - r, middle + r}, r, Rgba(0), entry.color, (twice ? 2.2f : 1.4f) * unit});
            const float around = r + 2.4f * unit;
            if (twice)
                list.panels.push_back({{middle - around, middle + around}, around, Rgba(0), entry.color, 0.9f * unit});
        } else if (entry.mark == Mark::box) {
            const glm::vec2 half(0.5f * layout.mark - 1, 0.38f * text_size);
            list.panels.push_back(
                {{middle - half, middle + half}, 1, entry.fill, entry.color, entry.width * text_size / 12});
        } else if (!remark) {
            const glm::vec2 half(0.5f * layout.mark, 0);
            list.overlay_lines.push_back({middle - half, middle + half, entry.color,
                                          std::max(entry.width, 1.4f) * text_size / 12,
                                          0.6f * entry.dash * text_size / 11.0f});
        }
        const glm::vec2 text_corner = remark ? at : at + glm::vec2(layout.mark + layout.gap, 0);
        list.texts.push_back(text_at(entry.text, FontFace::text, text_size,
                                     remark ? list.palette.quiet_text : list.palette.text, text_corner));
        at.y += layout.row;
    }
}

}  // namespace mobbscope
