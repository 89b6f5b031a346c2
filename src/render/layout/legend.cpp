#include <base/text.h>
#include <explain/query_sentence.h>
#include <mobb/traversal.h>
#include <render/drawlist/cut.h>
#include <render/layout/legend.h>
#include <render/parts/node_boxes.h>
#include <render/parts/paths.h>
#include <render/text/labels.h>

#include <glm/common.hpp>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <utility>

namespace mobbscope {

namespace {

constexpr int kMostLevels = 5;
constexpr float kSwatchFill = 0.3f;  // opacity

using Mark = LegendEntry::Mark;

LegendEntry remark(std::string text) { return {.mark = Mark::remark, .color = Rgba(0), .text = std::move(text)}; }

LegendEntry dot_entry(Rgba color, std::string text) {
    return {.mark = Mark::disk, .color = color, .text = std::move(text)};
}

LegendEntry dim_entry(const Palette& palette, const std::string& within) {
    const Rgba dim = mix_colors(palette.panel, palette.quiet_text, kOutOfFocus);
    return dot_entry(with_alpha(dim, 1), "dim: outside " + within);
}

/// What of the scene is inside the picture, and in its slab.
class Sight {
  public:
    explicit Sight(const DrawList& list)
        : list_(list), picture_{glm::vec2(0), glm::vec2(list.size.width, list.size.height)} {}

    /// From where it begins to where it ends.
    bool sample(const DrawnAgent& agent, int index) const {
        const mobb::SweptDisk swept = mobb::swept(agent.clip(), index);
        const auto height_at = [&](double time) { return list_.space.point(0, 0, time).z; };
        if (list_.slab && !list_.slab->shows(height_at(swept.begin), height_at(swept.end))) return false;
        std::optional<Rect> around;
        for (const auto& [disk, time] : {std::pair(swept.from, swept.begin), std::pair(swept.to, swept.end)}) {
            // Of a moment it is the floor that is seen.
            const glm::vec3 at = list_.space.point(disk.x, disk.y, list_.moment ? 0 : time);
            const auto pixel = list_.projection.project(at);
            if (!pixel) continue;
            const float r = static_cast<float>(disk.r) * list_.projection.pixels_per_metre(at);
            const Rect one = Rect{*pixel, *pixel}.grown(std::max(r, 0.5f));
            around = around ? Rect{glm::min(around->min, one.min), glm::max(around->max, one.max)} : one;
        }
        return around && around->overlaps(picture_);
    }
    bool path(const DrawnAgent& agent) const {
        const mobb::SampleRange shown = agent.samples();
        for (int i = shown.first; i < shown.end(); ++i) {
            if (sample(agent, i)) return true;
        }
        return false;
    }
    /// One that reaches behind the eye counts as seen.
    bool box(const BoxInstance& box) const {
        if (!is_seen(list_.slab, box)) return false;
        std::optional<Rect> around;
        bool behind = false;
        for (const glm::vec3& corner : box_corners(box)) {
            const auto at = list_.projection.project(corner);
            behind = behind || !at;
            if (at) around = around ? Rect{glm::min(around->min, *at), glm::max(around->max, *at)} : Rect{*at, *at};
        }
        return around && (behind || around->grown(0.5f).overlaps(picture_));
    }
    /// The boxes that stand for nodes.
    std::vector<const BoxInstance*> boxes() const {
        std::vector<const BoxInstance*> out;
        for (const BoxInstance& one : list_.boxes) {
            if (one.pickable && box(one)) out.push_back(&one);
        }
        return out;
    }

  private:
    const DrawList& list_;
    Rect picture_;
};

using SeenBoxes = std::vector<const BoxInstance*>;

std::set<int> levels_of(const SeenBoxes& boxes) {
    std::set<int> out;
    for (const BoxInstance* box : boxes) out.insert(box->order.level);
    return out;
}

/// A range of levels goes from dim to bright in every agent's colour, so it is shown in the text's.
void add_levels(std::vector<LegendEntry>& entries, const DrawList& list, const SeenBoxes& boxes,
                std::span<const DrawnAgent> agents, const LevelRange& levels) {
    const auto add = [&](const LevelStyle& style, std::string text) {
        const Rgba color = level_tint(list.palette.quiet_text, style, list.palette);
        entries.push_back({Mark::box, color, with_alpha(color, kSwatchFill), style.width, kSolid, std::move(text)});
    };
    if (levels.leaves) return add(level_style(0, 0, 0), "leaves");
    int last = 0;
    for (const DrawnAgent& agent : agents) last = std::max(last, last_shown_level(agent.placed.tree(), levels));
    const std::set<int> seen = levels_of(boxes);
    // Of many levels the coarsest and the finest tell how those between look.
    const bool few = static_cast<int>(seen.size()) <= kMostLevels;
    for (const int level : seen) {
        const bool coarsest = level == *seen.begin();
        if (!few && !coarsest && level != *seen.rbegin()) continue;
        add(level_style(level, levels.first, last), "level " + std::to_string(level) +
                                                        (few        ? ""
                                                         : coarsest ? ", coarsest"
                                                                    : ", finest"));
    }
}

void add_query(std::vector<LegendEntry>& entries, const DrawList& list, const SeenBoxes& boxes,
               std::span<const DrawnAgent> sides, const QueryProgress& progress, PairOutline outline,
               std::vector<LegendEntry>& remarks) {
    for (const DrawnAgent& side : sides) {
        const bool seen = std::ranges::any_of(boxes, [&](const BoxInstance* box) {
            return box->state == BoxState::under_test && box->id.agent == side.index;
        });
        if (!seen) continue;
        if (side.hidden) continue;
        const Rgba color = outline == PairOutline::owner
                               ? side.color
                               : pair_style(outline, side, state_found(progress), list.palette).color;
        entries.push_back({Mark::box, color, with_alpha(side.color, 0.3f), 2, kSolid, side.label + ", under test"});
    }
    const auto present = [&](BoxState state) {
        return std::ranges::any_of(boxes, [&](const BoxInstance* box) { return box->state == state; });
    };
    const std::pair<BoxState, const char*> outcomes[] = {{BoxState::separated, "separated in space"},
                                                         {BoxState::apart_in_time, "apart in time"},
                                                         {BoxState::overlap, "overlap without a hit so far"},
                                                         {BoxState::avoidable, "avoidable overlap"},
                                                         {BoxState::hit, "hit"}};
    for (const auto& [state, text] : outcomes) {
        // What the test under way found is shown between its boxes.
        if (present(state) || state_found(progress) == state)
            entries.push_back(line_entry(outcome_style(state, list.palette), text));
    }
    const auto is_earlier = [](const NodeProgress& node) { return !node.open; };
    const bool earlier =
        std::ranges::any_of(progress.nodes[0], is_earlier) || std::ranges::any_of(progress.nodes[1], is_earlier);
    if (earlier) remarks.push_back(remark("fine boxes: the latest test of a node"));
}

/// A free box is fitted with w metres to the second but drawn with another height, so it is not seen as a cuboid.
bool has_sheared_boxes(const DrawList& list, std::span<const DrawnAgent> agents) {
    return std::any_of(list.boxes.begin(), list.boxes.end(), [&](const BoxInstance& box) {
        if (!box.pickable) return false;
        const mobb::PlacedTree& tree = agents[static_cast<std::size_t>(box.id.agent)].placed;
        return mobb::info(tree.node(box.id.index).kind).axes == mobb::BoxAxes::space_time &&
               std::abs(list.space.time_height / tree.time_scale() - 1) > 0.01;
    });
}

/// What kinds of boxes look like that the paper does not have.
std::optional<std::string> beyond_the_paper(const DrawList& list, std::span<const DrawnAgent> agents) {
    for (const BoxInstance& box : list.boxes) {
        if (!box.pickable) continue;
        const mobb::PlacedTree& tree = agents[static_cast<std::size_t>(box.id.agent)].placed;
        const std::string_view looks = mobb::info(tree.node(box.id.index).kind).looks;
        if (!looks.empty()) return std::string(looks);
    }
    return std::nullopt;
}

std::string short_number(double value) { return formatted("%.3g", value); }

float mark_width(float text_size) { return std::round(1.7f * text_size); }

}  // namespace

LegendEntry line_entry(const LineStyle& style, std::string text) {
    return {.color = style.color, .width = style.width, .dash = style.dash, .text = std::move(text)};
}

LegendEntry proof_entry(const Palette& palette) {
    return {LegendEntry::Mark::box,         palette.separated, with_alpha(palette.separated, kSwatchFill), 1.5f, kSolid,
            "line that keeps the two apart"};
}

std::vector<LegendEntry> agent_entries(const DrawList& list, std::span<const DrawnAgent> agents,
                                       std::span<const DrawnAgent> paths) {
    const Sight sight(list);
    std::vector<LegendEntry> entries;
    for (const DrawnAgent& agent : agents) {
        const bool seen = std::ranges::any_of(paths, [&](const DrawnAgent& path) {
            const bool own = agent.run_agent >= 0 ? path.run_agent == agent.run_agent : path.index == agent.index;
            return own && sight.path(path);
        });
        if (seen && agent.is_whole()) entries.push_back(dot_entry(agent.color, agent.label));
    }
    return entries;
}

std::vector<LegendEntry> legend_entries(const DrawList& list, std::span<const DrawnAgent> agents, const ViewState& view,
                                        const Emphasis& emphasis, const QueryProgress* progress) {
    const Sight sight(list);
    const SeenBoxes boxes = sight.boxes();
    std::vector<LegendEntry> entries;
    std::vector<LegendEntry> remarks;
    if (progress) {
        if (view.boxes) add_query(entries, list, boxes, agents, *progress, pair_outline(view), remarks);
        if (!view.boxes && view.disks) entries = agent_entries(list, agents, agents);
        const auto is_seen = [&](std::size_t side) { return sight.sample(agents[side], (*emphasis.hits)[side]); };
        if (emphasis.hits && (is_seen(0) || is_seen(1))) {
            entries.push_back({.mark = Mark::double_ring, .color = list.palette.hit, .text = "samples that hit"});
        }
        if (emphasis.dims) entries.push_back(dim_entry(list.palette, "the nodes under test"));
    } else {
        // In a grid each has its name.
        if (!agents.front().cell) entries = agent_entries(list, agents, agents);
        // Of a figure the colour bar says it.
        if (view.color_by == ColorBy::agent && !boxes.empty()) add_levels(entries, list, boxes, agents, view.levels);
        for (const DrawnAgent& agent : agents) {
            if (!agent.subtree || !agent.is_whole() || !view.disks) continue;
            entries.push_back(dim_entry(list.palette, node_name(agent, *agent.subtree)));
        }
    }
    if (emphasis.cursor) entries.push_back(line_entry({list.palette.accent, 1.3f}, "time cursor"));
    for (std::size_t i = 0; i < emphasis.at_cursor.size(); ++i) {
        if (!emphasis.at_cursor[i] || !sight.sample(agents[i], *emphasis.at_cursor[i])) continue;
        entries.push_back({.mark = Mark::ring, .color = list.palette.text, .text = "sample at that time"});
        break;
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

float legend_row(float text_size) { return std::round(1.55f * text_size); }

float legend_indent(const LegendEntry& row, float text_size) {
    return row.mark == Mark::remark ? 0 : mark_width(text_size) + std::round(0.7f * text_size);
}

glm::vec2 legend_size(std::span<const LegendEntry> rows, float text_size, float text_room) {
    float widest = 0;
    for (const LegendEntry& row : rows) {
        const float words = std::min(Font::of(FontFace::text).width(row.text, text_size), text_room);
        widest = std::max(widest, legend_indent(row, text_size) + words);
    }
    return glm::ceil(glm::vec2(widest, legend_row(text_size) * static_cast<float>(rows.size()) - 0.3f * text_size));
}

bool add_legend(DrawList& list, std::span<const LegendEntry> rows, glm::vec2 corner, float text_size, float text_room) {
    glm::vec2 at = corner;
    const float mark_room = mark_width(text_size);
    const float height = line_height(FontFace::text, text_size);
    const NameList names(rows.size(), [&](std::size_t i) { return rows[i].text; });
    bool whole = true;
    for (const LegendEntry& entry : rows) {
        const bool remark = entry.mark == Mark::remark;
        const glm::vec2 middle = at + glm::vec2(0.5f * mark_room, 0.5f * height);
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
            const glm::vec2 half(0.5f * mark_room - 1, 0.38f * text_size);
            list.panels.push_back(
                {{middle - half, middle + half}, 1, entry.fill, entry.color, entry.width * text_size / 12});
        } else if (!remark) {
            const glm::vec2 half(0.5f * mark_room, 0);
            list.overlay_lines.push_back({middle - half, middle + half, entry.color,
                                          std::max(entry.width, 1.4f) * text_size / 12,
                                          0.6f * entry.dash * text_size / 11.0f});
        }
        const std::string words = entry.mark == Mark::disk
                                      ? fit_name(entry.text, FontFace::text, text_size, text_room, names)
                                      : fit_text(entry.text, FontFace::text, text_size, text_room);
        whole = whole && words == entry.text;
        list.texts.push_back(text_at(TextRole::legend, words, FontFace::text, text_size,
                                     remark ? list.palette.quiet_text : list.palette.text,
                                     at + glm::vec2(legend_indent(entry, text_size), 0)));
        at.y += legend_row(text_size);
    }
    return whole;
}

}  // namespace mobbscope
