#include <base/text.h>
#include <crowd/simulation/choice.h>
#include <explain/query_progress.h>
#include <render/layout/annotations.h>
#include <render/layout/block_layout.h>
#include <render/layout/caption.h>
#include <render/layout/follow.h>
#include <render/layout/framing.h>
#include <render/layout/legend.h>
#include <render/parts/floor_inset.h>
#include <render/parts/node_boxes.h>
#include <render/parts/paths.h>
#include <render/pictures/build_draw_list.h>
#include <render/pictures/crowd_picture.h>
#include <render/pictures/disk_projection.h>
#include <render/pictures/moment_picture.h>
#include <render/query/query_boxes.h>
#include <render/text/labels.h>
#include <scene/crowd_scene.h>

#include <stdexcept>

namespace mobbscope {

namespace {

/// The view's query at its step. The progress refers to the trace, so the two stay together where they were made.
struct QueryAtStep {
    RecordedQuery recorded;
    QueryProgress progress;

    QueryAtStep(const FittedScene& fitted, const ViewState& view)
        : recorded(record(fitted, fitted.queries()[static_cast<std::size_t>(*view.query)])),
          progress(progress_at(recorded.trace, event_of(view.step, recorded.trace))) {}
    QueryAtStep(const QueryAtStep&) = delete;
    QueryAtStep& operator=(const QueryAtStep&) = delete;
};

void add_paths(DrawList& list, std::span<const DrawnAgent> agents, const Emphasis& emphasis,
               const QueryProgress* progress, bool behind) {
    for (const DrawnAgent& agent : agents) {
        PathFocus focus;
        focus.behind = behind;
        if (progress) {
            const mobb::Node& tested = agent.placed.node(agent.index == 0 ? progress->event.a : progress->event.b);
            focus.range = mobb::SampleRange{tested.first, tested.count};
            if (emphasis.hits) focus.hit = (*emphasis.hits)[static_cast<std::size_t>(agent.index)];
        }
        add_disks(list, agent, focus);
    }
}

void add_floor_and_axes(DrawList& list, std::span<const DrawnAgent> agents, const FloorExtent& floor_extent,
                        const ViewState& view, float scale) {
    if (view.floor) {
        add_floor_grid(list, floor_extent, scale);
        if (!floor_on_edge(list.projection)) {
            const float height = list.space.point(0, 0, floor_extent.t0).z;
            for (const DrawnAgent& agent : agents) {
                add_floor_trace(list, agent, {0, agent.clip().count()}, height, floor_trace_color(agent, list.palette),
                                1.6f * scale);
            }
        }
    }
    if (view.time_axis) add_time_axis(list, floor_extent, scale);
}

DrawList build_run(const FittedScene& run, const ViewState& view, const PictureOptions& options) {
    const FittedScene seen = fitted_at(run, view);
    if (view.follow.empty() || !view.candidates) return build_draw_list(seen, view, options);
    const MoveSet moves(run);
    const auto choice = choice_in_view(moves, view);
    return build_draw_list(seen, view, options, choice ? &*choice : nullptr);
}

}  // namespace

std::optional<FollowedChoice> choice_in_view(const MoveSet& moves, const ViewState& view) {
    if (view.follow.empty() || !view.candidates) return std::nullopt;
    const Scene& run = moves.fitted().scene();
    const auto run_agent = run_agent_by_name(*run.crowd, view.follow);
    return run_agent ? last_choice(moves, *run_agent, run_time(run, view)) : std::nullopt;
}

DrawList build_draw_list(const FittedScene& fitted, const ViewState& view, PictureSize size, double scale) {
    return build_draw_list(fitted, view, {.size = size, .scale = scale});
}

DrawList build_draw_list(const FittedScene& fitted, const ViewState& view, const PictureOptions& options,
                         const FollowedChoice* choice) {
    const PictureSize size = options.size;
    const double scale = options.scale;
    if (scale != 0 && !(scale >= kLeastScale && scale <= kMostScale)) {
        throw std::invalid_argument("text and lines cannot be drawn " + short_double(scale) + " times as large: give " +
                                    short_double(kLeastScale) + " to " + short_double(kMostScale));
    }
    if (is_run(fitted.scene())) return build_run(fitted, view, options);
    if (view.show == Show::moment) return build_moment(fitted, view, options, choice);
    if (fitted.scene().crowd) return build_crowd(fitted, view, options, choice);
    const std::vector<DrawnAgent> paths = drawn_agents(fitted, view);
    if (paths.empty()) throw std::invalid_argument("the scene has nothing to draw: it has no clips");
    const Metrics metrics = metrics_of(size, scale);
    DrawList list;
    list.size = size;
    list.palette = palette_for(view.theme, options);
    list.background = options.background;
    for (const DrawnAgent& agent : paths) list.participants.push_back(agent.name);

    if (view.projection) {
        add_disk_projection(list, paths, *view.projection, view, options);
        return list;
    }
    const Bounds bounds = bounds_of(paths);
    list.space = space_for(bounds, view);
    list.space.anchor = camera_anchor(fitted, view, view.time.value_or(bounds.min.z));
    std::optional<QueryAtStep> query;
    if (view.query) query.emplace(fitted, view);
    const QueryProgress* progress = query ? &query->progress : nullptr;
    const Emphasis emphasis = emphasis_of(view, paths, bounds.min.z, bounds.max.z, progress);
    const bool has_cursor = emphasis.cursor.has_value();

    if (view.boxes && progress) add_query_boxes(list, paths, *progress, pair_outline(view), metrics.scale);
    const bool levels = view.boxes && !progress;
    if (levels) add_level_boxes(list, paths, view.levels, view.color_by, metrics.scale);
    if (view.disks) add_paths(list, paths, emphasis, progress, levels && view.color_by == ColorBy::level);
    const Bounds all = with_boxes(bounds, list);
    FloorExtent floor_extent = floor_extent_of(all.min, all.max);
    floor_extent.t0 = bounds.min.z;
    floor_extent.t1 = bounds.max.z;

    float top = metrics.pad;
    glm::vec2 map(0);
    if (view.labels) {
        Caption caption = query ? query_caption(list.palette, paths, query->recorded, progress->step)
                                : scene_caption(fitted, paths, view);
        if (view.time && !has_cursor) mention_cursor_outside(caption, *view.time, floor_extent.t0, floor_extent.t1);
        if (!view.caption) caption = {};
        caption.panel = scene_may_lie_behind(view, options);
        std::vector<LegendEntry> legend;
        if (view.legend) legend = legend_entries(list, paths, view, emphasis, progress);
        TextBudget words =
            fit_to_budget(caption, std::move(legend),
                          has_cursor ? inset_size(floor_extent, metrics.scale) : glm::vec2(0), size, metrics);
        list.legend = std::move(words.legend);
        map = words.map;
        top = add_caption(list, caption, words.caption, metrics.pad, metrics.scale);
    }
    LabelLayout layout(list);

    const Blocks blocks = aim(list, points_to_show(list, floor_extent, view, has_cursor), floor_extent, view, metrics,
                              top, map, [&] { return occupied(list, floor_extent, view, metrics); });
    refine_crowded_boxes(list, metrics.scale);
    add_floor_and_axes(list, paths, floor_extent, view, metrics.scale);
    if (view.disks) {
        for (const DrawnAgent& agent : paths) add_thin_path(list, agent, 1.3f * metrics.scale);
    }
    if (progress && view.time_axis && pair_outline(view) == PairOutline::outcome) {
        add_time_intervals(list, floor_extent, paths, progress->event, metrics.scale);
    }
    if (emphasis.cursor) add_time_cursor(list, floor_extent, *emphasis.cursor, metrics.scale);
    add_rings(list, paths, emphasis, metrics.scale);
    std::vector<LabelRequest> notes;
    if (query) notes = add_findings(list, paths, query->recorded, *progress, metrics);

    if (!blocks.legend) list.legend.clear();
    if (!view.labels) return list;
    if (blocks.legend) {
        add_legend(list, blocks.legend->min, metrics.small);
        layout.reserve(*blocks.legend);
    }
    if (blocks.map) {
        add_floor_inset(list, paths, floor_extent, *emphasis.cursor, blocks.map->min, metrics.scale);
        layout.reserve(*blocks.map);
    }
    add_notes(list, layout, notes, metrics.scale);
    for (const LabelRequest& label :
         floor_and_axis_labels(list, floor_extent, view.floor, view.time_axis, metrics.small)) {
        layout.place(label, list);
    }
    add_names(list, layout, paths, metrics);
    return list;
}

}  // namespace mobbscope
