#include <import/text.h>
#include <render/annotations.h>
#include <render/block_layout.h>
#include <render/build_draw_list.h>
#include <render/caption.h>
#include <render/emphasis.h>
#include <render/floor_inset.h>
#include <render/framing.h>
#include <render/label_layout.h>
#include <render/legend.h>
#include <render/level_boxes.h>
#include <render/paths.h>
#include <render/query_boxes.h>
#include <render/query_progress.h>
#include <render/words.h>

#include <glm/common.hpp>

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

void add_paths(DrawList& list, std::span<const Subject> subjects, const Emphasis& emphasis,
               const QueryProgress* progress, bool behind) {
    for (const Subject& subject : subjects) {
        PathFocus focus;
        focus.behind = behind;
        if (progress) {
            const mobb::Node& tested = subject.placed.node(subject.index == 0 ? progress->event.a : progress->event.b);
            focus.range = mobb::SampleRange{tested.first, tested.count};
            if (emphasis.hits) focus.hit = (*emphasis.hits)[static_cast<std::size_t>(subject.index)];
        }
        add_disks(list, subject, focus);
    }
}

/// Where legend and map would shrink the scene to less than this they are left out.
constexpr float kLeastShare = 0.62f;

/// The lens, so that everything fits into what caption, labels and blocks leave, and the places of the blocks.
Blocks aim(DrawList& list, const Stage& stage, const ViewState& view, const Metrics& metrics, float top,
           bool has_cursor, glm::vec2 map) {
    const std::vector<glm::vec3> points = points_to_show(list, stage, view, has_cursor);
    const glm::vec2 legend = legend_size(list.legend, metrics.small);
    const Rect area{{metrics.pad, top + 0.3f * metrics.pad},
                    glm::vec2(list.size.width, list.size.height) - metrics.pad};
    const auto place = [&] { return place_blocks(area, legend, map, occupied(list, stage, view, metrics)); };
    const Frame frame = free_frame(list.size, top, stage, view, metrics);
    list.lens = lens_for(list, view, points, frame);
    list.frame = frame;
    Blocks blocks = place();
    if (!blocks.covers || view.camera.target) return blocks;
    // No corner is free: the scene makes room, beside or below it, whichever costs it less.
    const glm::vec2 room = glm::max(legend, map) + metrics.pad;
    Frame beside = frame;
    beside.min.x += room.x;
    Frame above = frame;
    above.max.y -= room.y;
    const Lens lens_beside = lens_for(list, view, points, beside);
    const Lens lens_above = lens_for(list, view, points, above);
    const glm::vec3 middle = 0.5f * (points.front() + points.back());
    const bool fits_beside = lens_beside.pixels_per_metre(middle) >= lens_above.pixels_per_metre(middle);
    const Lens& larger = fits_beside ? lens_beside : lens_above;
    if (larger.pixels_per_metre(middle) < kLeastShare * list.lens.pixels_per_metre(middle)) {
        // The scene is what the picture is for.
        list.legend.clear();
        return place_blocks(area, glm::vec2(0), glm::vec2(0), {});
    }
    list.lens = larger;
    list.frame = fits_beside ? beside : above;
    return place();
}

void add_stage(DrawList& list, std::span<const Subject> subjects, const Stage& stage, const ViewState& view,
               float scale) {
    if (view.floor) {
        add_floor_grid(list, stage, scale);
        if (!floor_on_edge(list.lens)) {
            const float height = list.space.point(0, 0, stage.t0).z;
            for (const Subject& subject : subjects) add_floor_trace(list, subject, height, 1.6f * scale);
        }
    }
    if (view.time_axis) add_time_axis(list, stage, scale);
}

}  // namespace

DrawList build_draw_list(const FittedScene& fitted, const ViewState& view, PictureSize size, double scale) {
    return build_draw_list(fitted, view, {.size = size, .scale = scale});
}

DrawList build_draw_list(const FittedScene& fitted, const ViewState& view, const PictureOptions& options) {
    const PictureSize size = options.size;
    const double scale = options.scale;
    if (scale != 0 && !(scale >= kLeastScale && scale <= kMostScale)) {
        throw std::invalid_argument("text and lines cannot be drawn " + short_double(scale) + " times as large: give " +
                                    short_double(kLeastScale) + " to " + short_double(kMostScale));
    }
    const std::vector<Subject> paths = subjects(fitted, view);
    if (paths.empty()) throw std::invalid_argument("the scene has nothing to draw: it has no clips");
    const Metrics metrics = metrics_of(size, scale);
    DrawList list;
    list.size = size;
    list.palette = palette(view.theme);
    list.background = options.background;
    if (options.background && options.background->a >= 1) list.palette.background = *options.background;
    for (const Subject& subject : paths) list.participants.push_back(subject.name);

    const Bounds bounds = bounds_of(paths);
    list.space = space_for(bounds, view);
    std::optional<QueryAtStep> query;
    if (view.query) query.emplace(fitted, view);
    const QueryProgress* progress = query ? &query->progress : nullptr;
    const Emphasis emphasis = emphasis_of(view, paths, bounds.min.z, bounds.max.z, progress);
    const bool has_cursor = emphasis.cursor.has_value();

    if (view.boxes && progress) add_query_boxes(list, paths, *progress, metrics.scale);
    const bool levels = view.boxes && !progress;
    if (levels) add_level_boxes(list, paths, view.levels, view.color_by, metrics.scale);
    if (view.disks) add_paths(list, paths, emphasis, progress, levels && view.color_by == ColorBy::level);
    const Bounds all = with_boxes(bounds, list);
    Stage stage = make_stage(all.min, all.max);
    stage.t0 = bounds.min.z;
    stage.t1 = bounds.max.z;

    float top = metrics.pad;
    glm::vec2 map(0);
    if (view.labels) {
        Caption caption = query ? query_caption(list.palette, paths, query->recorded, progress->step)
                                : scene_caption(fitted, paths, view);
        if (view.time && !has_cursor) mention_cursor_outside(caption, *view.time, stage.t0, stage.t1);
        std::vector<LegendEntry> legend;
        if (view.legend) legend = legend_entries(list, paths, view, emphasis, progress);
        Words words = words_that_fit(caption, std::move(legend),
                                     has_cursor ? inset_size(stage, metrics.scale) : glm::vec2(0), size, metrics);
        list.legend = std::move(words.legend);
        map = words.map;
        top = add_caption(list, caption, words.caption, metrics.pad, metrics.scale);
    }
    LabelLayout layout(size);
    for (const TextRun& run : list.texts) layout.reserve(run.box);

    const Blocks blocks = aim(list, stage, view, metrics, top, has_cursor, map);
    refine_crowded_boxes(list, metrics.scale);
    add_stage(list, paths, stage, view, metrics.scale);
    if (view.disks) {
        for (const Subject& subject : paths) add_thin_path(list, subject, 1.3f * metrics.scale);
    }
    if (emphasis.cursor) add_time_cursor(list, stage, *emphasis.cursor, metrics.scale);
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
        add_floor_inset(list, paths, stage, *emphasis.cursor, blocks.map->min, metrics.scale);
        layout.reserve(*blocks.map);
    }
    add_notes(list, layout, notes, metrics.scale);
    for (const LabelRequest& label : stage_labels(list, stage, view.floor, view.time_axis, metrics.small)) {
        layout.place(label, list);
    }
    add_names(list, layout, paths, metrics);
    return list;
}

}  // namespace mobbscope
