#include <explain/query_sentence.h>
#include <mobb/traversal.h>
#include <render/layout/annotations.h>
#include <render/parts/paths.h>
#include <render/query/proof_walls.h>
#include <render/query/separation_gap.h>

#include <glm/common.hpp>

#include <algorithm>
#include <cmath>

namespace mobbscope {

namespace {

constexpr std::size_t kMostNames = 12;
constexpr float kLeastCellName = 6;  // times the size of text: the room that a name under a cell has at least

/// What a rectangle of the floor covers in the picture; none if it is not all before the eye.
std::optional<Rect> seen_rect(const DrawList& list, glm::dvec2 low, glm::dvec2 high, double floor) {
    std::optional<Rect> out;
    for (const glm::dvec2 corner : {low, {high.x, low.y}, high, {low.x, high.y}}) {
        const auto at = list.projection.project(list.space.point(corner.x, corner.y, floor));
        if (!at) return std::nullopt;
        out = out ? Rect{glm::min(out->min, *at), glm::max(out->max, *at)} : Rect{*at, *at};
    }
    return out;
}

/// A number at a place in the scene, if that can be seen.
void note(std::vector<LabelRequest>& notes, const DrawList& list, glm::vec3 at, std::string text, Rgba color,
          float text_size) {
    const auto anchor = list.projection.project(at);
    if (!anchor) return;
    notes.push_back({.text = std::move(text),
                     .role = TextRole::note,
                     .face = FontFace::mono,
                     .size = text_size,
                     .color = readable(color, list.palette),
                     .anchor = *anchor,
                     .directions = {{1, -0.5f}, {-1, -0.5f}, {1, 0.5f}, {-1, 0.5f}, {0, -1}, {0, 1}},
                     .distance = 4.5f * text_size,
                     .pill = true,
                     .border = color});
}

}  // namespace

void add_rings(DrawList& list, std::span<const DrawnAgent> agents, const Emphasis& emphasis, float scale) {
    for (std::size_t i = 0; i < emphasis.at_cursor.size(); ++i) {
        if (emphasis.at_cursor[i]) add_cursor_ring(list, agents[i], *emphasis.at_cursor[i], *emphasis.cursor, scale);
    }
    if (!emphasis.hits) return;
    for (std::size_t side = 0; side < 2; ++side) {
        if (agents[side].hidden) continue;
        add_hit_ring(list, agents[side], (*emphasis.hits)[side], emphasis.hit_time, scale);
    }
}

std::vector<LabelRequest> add_findings(DrawList& list, std::span<const DrawnAgent> sides, const RecordedQuery& recorded,
                                       const QueryProgress& progress, const Metrics& metrics) {
    std::vector<LabelRequest> notes;
    // What is found between two is not to be seen of one.
    if (sides[0].hidden || sides[1].hidden) return notes;
    const mobb::Trace::Event& event = progress.event;
    if (const auto gap = separation_gap(sides, event)) {
        const glm::vec3 at = add_separation_gap(list, *gap, sides[0].placed.time_scale(), metrics.scale);
        note(notes, list, at, with_unit(event.gap, "m"), list.palette.separated, metrics.text);
    }
    if (const auto gap = time_gap(sides, event, list.space)) {
        add_time_gap(list, *gap, metrics.scale);
        note(notes, list, 0.5f * (gap->from + gap->to), gap->seconds > 1e-9 ? with_unit(gap->seconds, "s") : "0 s",
             list.palette.apart_in_time, metrics.text);
    }
    if (progress.avoidable) {
        const mobb::PlacedClip& a = sides[0].clip();
        const mobb::PlacedClip& b = sides[1].clip();
        const ProofLine line = proof_line_of(a, b, progress.avoidable->line, clearance_over_time(a, b));
        const WallGap gap = add_avoidable_wall(list, line, metrics.scale);
        note(notes, list, gap.at, with_unit(gap.gap, "m"), list.palette.avoidable, metrics.text);
    }
    if (event.outcome == mobb::Outcome::hit && !event.pairs.empty() && recorded.contact) {
        const mobb::PlacedClip& clip = sides[0].clip();
        const int sample = event.pairs.back().i;
        // A disk that runs is elsewhere when the contact begins.
        const double time = clip.is_linear() ? recorded.contact->time : clip.time(sample);
        const mobb::Disk disk = mobb::swept(clip, sample).at(time);
        note(notes, list, list.space.point(disk.x, disk.y, time), "hit at " + with_unit(recorded.contact->time, "s"),
             list.palette.hit, metrics.text);
    }
    return notes;
}

void add_gap_note(std::vector<LabelRequest>& notes, const DrawList& list, const WallGap& gap, const Metrics& metrics) {
    note(notes, list, gap.at, gap_words(gap.gap), list.palette.separated, metrics.text);
}

void add_region_note(std::vector<LabelRequest>& notes, const DrawList& list, const DrawnAgent& b, glm::vec3 middle,
                     const Metrics& metrics) {
    note(notes, list, middle, b.label + " may start anywhere in here", list.palette.separated, metrics.small);
    if (!notes.empty()) notes.back().face = FontFace::text;
}

void add_notes(DrawList& list, LabelLayout& layout, std::span<const LabelRequest> notes, float scale) {
    for (const LabelRequest& label : notes) {
        if (!layout.place(label, list)) continue;
        const Rect& pill = list.panels.back().rect;
        const glm::vec2 nearest = glm::clamp(label.anchor, pill.min, pill.max);
        list.overlay_lines.push_back({label.anchor, nearest, with_alpha(label.border, 0.9f), scale, kSolid});
    }
}

std::optional<LabelRequest> name_label(const DrawList& list, const DrawnAgent& agent, glm::vec3 top, double radius,
                                       float text_size) {
    const auto anchor = list.projection.project(top);
    if (!anchor) return std::nullopt;
    const float pixels = static_cast<float>(radius) * list.projection.pixels_per_metre(top);
    LabelRequest label;
    label.role = TextRole::name;
    label.text = fit_text(agent.label, FontFace::text, text_size, 0.3f * static_cast<float>(list.size.width));
    label.size = text_size;
    label.color = readable(agent.color, list.palette);
    label.anchor = *anchor;
    label.directions = {{0, -1}, {1, -1}, {-1, -1}, {1, 0}, {-1, 0}, {0, 1}};
    label.distance = pixels * std::max(std::abs(list.projection.back.z), 0.1f) + 0.4f * text_size;
    label.pill = true;
    return label;
}

std::size_t shown_count(std::span<const DrawnAgent> agents) {
    return static_cast<std::size_t>(std::ranges::count(agents, false, &DrawnAgent::hidden));
}

void add_cell_names(DrawList& list, LabelLayout& layout, std::span<const DrawnAgent> agents, double floor,
                    const Metrics& metrics) {
    const NameList names(agents.size(), [&](std::size_t i) { return agents[i].name; });
    for (const DrawnAgent& agent : agents) {
        if (agent.hidden || !agent.cell) continue;
        const GridCell& cell = *agent.cell;
        const auto seen = seen_rect(list, cell.low, cell.high, floor);
        const glm::dvec2 middle = 0.5 * (cell.low + cell.high);
        const auto room = seen_rect(list, middle - 0.5 * cell.size, middle + 0.5 * cell.size, floor);
        if (!seen || !room) continue;
        LabelRequest label;
        label.role = TextRole::name;
        label.text =
            fit_name(agent.name, FontFace::text, metrics.small,
                     std::max(room->max.x - room->min.x - metrics.small, kLeastCellName * metrics.small), names);
        label.size = metrics.small;
        label.color = readable(agent.color, list.palette);
        label.anchor = {0.5f * (seen->min.x + seen->max.x), seen->max.y};
        label.directions = {{0, 1}};
        label.distance = 0.2f * metrics.small;
        label.pill = true;
        label.border = with_alpha(list.palette.panel, 0);
        if (layout.place(label, list)) continue;
        // Below is a panel, or the picture's edge.
        label.anchor.y = seen->min.y;
        label.directions = {{0, -1}};
        if (layout.place(label, list)) continue;
        label.text = fit_name(agent.name, FontFace::text, metrics.small, kLeastCellName * metrics.small, names);
        label.directions = {{0, -1}, {1, 0}, {-1, 0}};
        layout.place(label, list);
    }
}

bool names_fit(std::size_t agents) { return agents <= kMostNames; }

bool all_are_named(std::span<const DrawnAgent> agents) {
    return agents.size() > 1 && names_fit(shown_count(agents)) && std::ranges::none_of(agents, &DrawnAgent::outlined);
}

std::optional<LabelRequest> plate_at(const DrawList& list, const DrawnAgent& agent, const mobb::Disk& disk,
                                     double height, const Rgba& border, const Metrics& metrics) {
    const auto anchor = list.projection.project(list.space.point(disk.x, disk.y, height));
    if (!anchor) return std::nullopt;
    LabelRequest label;
    label.text = agent.label;
    label.role = TextRole::name;
    label.size = metrics.text;
    label.color = readable(agent.color, list.palette);
    label.border = border;
    label.anchor = *anchor;
    label.directions = {{0, -1}, {-1, -1}, {1, -1}, {-1, 0}, {1, 0}};
    label.distance = 1.8f * metrics.text;
    label.pill = true;
    return label;
}

std::vector<LabelRequest> names_at(const DrawList& list, std::span<DrawnAgent> agents, double time,
                                   const Metrics& metrics) {
    std::vector<LabelRequest> out;
    for (DrawnAgent& agent : agents) {
        const std::optional<int> sample = agent.named && !agent.hidden ? sample_at(agent, time) : std::nullopt;
        if (!sample) continue;
        const mobb::Disk disk = mobb::swept(agent.clip(), *sample).at(time);
        if (auto plate = plate_at(list, agent, disk, time, agent.color, metrics)) out.push_back(*std::move(plate));
        agent.named = false;
    }
    return out;
}

void add_names(DrawList& list, LabelLayout& layout, std::span<const DrawnAgent> agents, const Metrics& metrics) {
    const bool all = all_are_named(agents);
    for (const DrawnAgent& agent : agents) {
        if (agent.hidden || !(all || agent.named)) continue;
        const mobb::PlacedClip& clip = agent.clip();
        int sample = clip.count() - 1;
        double time = agent.end();
        if (list.slab) {
            // The upper end of what is seen.
            const auto height = [&](double t) { return list.space.point(0, 0, t).z; };
            if (!list.slab->shows(height(agent.begin()), height(time))) continue;
            time = std::min(time, list.space.place({0, 0, list.slab->high}).z);
            sample = std::min(sample, mobb::first_ending_after(clip, 0, clip.count(), time));
        }
        const mobb::Disk last = clip.disk(sample);
        const glm::vec3 top = list.space.point(last.x, last.y, time);
        auto label = name_label(list, agent, top, last.r, metrics.text);
        if (!label) continue;
        label->border = with_alpha(list.palette.panel, 0);
        layout.place(*label, list);
    }
}

}  // namespace mobbscope
