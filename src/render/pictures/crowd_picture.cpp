#include <render/layout/annotations.h>
#include <render/layout/block_layout.h>
#include <render/layout/follow.h>
#include <render/layout/framing.h>
#include <render/layout/legend.h>
#include <render/parts/floor_and_axes.h>
#include <render/parts/node_boxes.h>
#include <render/parts/paths.h>
#include <render/pictures/candidates.h>
#include <render/pictures/crowd_picture.h>
#include <scene/crowd_run.h>
#include <scene/crowd_scene.h>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <set>
#include <stdexcept>

namespace mobbscope {

namespace {

constexpr float kFinestStep = 0.6f;  // pixels: disks nearer to one another are drawn as one
constexpr int kMostTogether = 8;
constexpr double kFlat = 0.4;
constexpr double kMostHeight = 4;  // metres drawn per second: people walk about a third of it
constexpr float kLeastRing = 3;    // pixels of radius

struct Seconds {
    double begin = 0, time = 0, end = 0;
};

/// The space above the floor, as points of a grid: what had better not be covered.
std::vector<Rect> above_floor(const ViewProjection& projection, const std::vector<glm::vec3>& corners) {
    constexpr int kCells = 6;
    const glm::vec3 low = corners.front();
    const glm::vec3 high = corners.back();
    std::vector<Rect> out;
    for (int i = 0; i <= kCells; ++i) {
        for (int j = 0; j <= kCells; ++j) {
            for (int k = 0; k <= kCells; ++k) {
                const glm::vec3 share = glm::vec3(i, j, k) / static_cast<float>(kCells);
                if (const auto at = projection.project(low + share * (high - low)))
                    out.push_back(Rect{*at, *at}.grown(8));
            }
        }
    }
    return out;
}

/// Whether some of a path may be seen: a ball around its tree's root reaches into what the camera sees.
bool may_be_seen(const DrawList& list, const DrawnAgent& agent) {
    if (agent.samples().count == 0) return false;
    const BoxInstance all = node_box(agent, 0, list.space);
    const glm::vec4 middle(all.center, 1);
    float reach = 0;
    for (const glm::vec3& half : all.extents) reach += glm::length(half);
    const glm::mat4 rows = glm::transpose(list.projection.clip_from_world);
    for (const glm::vec4& across : {rows[0], -rows[0], rows[1], -rows[1]}) {
        const glm::vec4 edge = rows[3] + across;
        if (glm::dot(edge, middle) < -reach * glm::length(glm::vec3(edge))) return false;
    }
    return true;
}

/// So many samples cannot be told apart in the picture.
int samples_together(const DrawList& list, const DrawnAgent& agent) {
    const mobb::PlacedClip& clip = agent.clip();
    const mobb::SampleRange shown = agent.samples();
    const mobb::Disk disk = clip.disk(shown.first);
    const float pixels = list.projection.pixels_per_metre(list.space.point(disk.x, disk.y, clip.time(shown.first)));
    const float height = static_cast<float>(clip.clip().dt() * list.space.time_height);
    const float step = height * pixels * std::sqrt(std::max(0.0f, 1 - list.projection.back.z * list.projection.back.z));
    if (!(step > 0)) return 1;
    return std::clamp(static_cast<int>(kFinestStep / step), 1, kMostTogether);
}

std::string headline_of(std::size_t people, double time) {
    char text[96];
    if (people == 0) {
        std::snprintf(text, sizeof text, "Nobody is on the floor at %.2f s", time);
        return text;
    }
    std::snprintf(text, sizeof text, "%zu %s at %.2f s", people, people == 1 ? "agent" : "agents", time);
    return text;
}

/// Before a run some are there already, after it nobody is.
std::size_t people_at(std::span<const DrawnAgent> paths, double time) {
    std::set<int> people;
    for (const DrawnAgent& path : paths) {
        if (sample_at(path, time)) people.insert(path.run_agent);
    }
    return people.size();
}

std::string window_text(const Seconds& s) {
    char text[96];
    std::snprintf(text, sizeof text, "upwards from %.2f to %.2f s", s.begin, s.end);
    return text;
}

/// Boxes that begin before what is shown, or end behind it, would stand there empty.
void keep_within(DrawList& list, std::span<const DrawnAgent> paths, const Seconds& seconds) {
    std::erase_if(list.boxes, [&](const BoxInstance& box) {
        const mobb::PlacedTree& tree = paths[static_cast<std::size_t>(box.id.participant)].placed;
        const mobb::Node& node = tree.node(box.id.index);
        return tree.begin(node) < seconds.begin || tree.end(node) > seconds.end;
    });
}

std::vector<DrawnAgent> boxed(std::span<const DrawnAgent> paths, const ViewState& view, int followed) {
    std::size_t boxes = 0;
    std::vector<DrawnAgent> all;
    std::vector<DrawnAgent> own;
    for (const DrawnAgent& path : paths) {
        if (path.samples().count == 0) continue;
        boxes += shown_nodes(path.placed.tree(), view.levels).size();
        all.push_back(path);
        if (path.run_agent == followed) own.push_back(path);
    }
    return boxes <= kMostCrowdBoxes ? all : own;
}

}  // namespace

DrawList build_crowd(const FittedScene& fitted, const ViewState& view, const PictureOptions& options,
                     const FollowedChoice* choice) {
    const CrowdRun& crowd = *fitted.scene().crowd;
    const PictureSize size = options.size;
    const Metrics metrics = metrics_of(size, options.scale);
    const double time = run_time(fitted.scene(), view);
    const bool outside = time < 0 || time >= crowd.seconds;
    if (outside) choice = nullptr;
    const Seconds seconds{time - view.time_window, time, time + view.time_window};
    const std::vector<DrawnAgent> paths = drawn_agents(fitted, view);
    const int followed = view.follow.empty() ? -1 : run_agent_by_name(crowd, view.follow).value_or(-1);

    DrawList list;
    list.size = size;
    list.palette = palette_for(view.theme, options);
    list.background = options.background;
    for (const DrawnAgent& agent : paths) list.participants.push_back(agent.name);
    Bounds bounds;
    bounds.add(glm::dvec3(-0.5 * crowd.area, seconds.begin));
    bounds.add(glm::dvec3(0.5 * crowd.area, seconds.end));
    list.space = space_for(bounds, view);
    // As tall as wide it would be a forest of poles.
    if (view.time_height <= 0) list.space.time_height = std::min(kFlat * list.space.time_height, kMostHeight);
    list.space.anchor = camera_anchor(fitted, view, time);
    const FloorExtent floor_extent = floor_stage(crowd.area, seconds.begin, seconds.end);

    float top = metrics.pad;
    if (view.labels) {
        Caption caption;
        caption.headlines = {headline_of(outside ? people_at(paths, time) : crowd.agents.size(), time)};
        caption.detail = choice ? choice_sentence(fitted.scene(), *choice) : window_text(seconds);
        if (outside) mention_cursor_outside(caption, time, 0, crowd.seconds);
        if (!view.caption) caption = {};
        caption.panel = scene_may_lie_behind(view, options);
        std::vector<LegendEntry> legend;
        if (view.legend) {
            if (names_fit(crowd.agents.size())) {
                legend = agent_entries(std::span(paths).first(crowd.agents.size()));
            }
            if (choice) {
                const auto fates = candidate_legend(list.palette, choice->choice);
                legend.insert(legend.end(), fates.begin(), fates.end());
            }
            LegendEntry now;
            now.color = list.palette.accent;
            now.width = 1.3f;
            now.text = "now";
            legend.push_back(now);
        }
        TextBudget words = fit_to_budget(caption, std::move(legend), glm::vec2(0), size, metrics);
        list.legend = std::move(words.legend);
        top = add_caption(list, caption, words.caption, metrics.pad, metrics.scale);
    }
    LabelLayout layout(list);
    const std::vector<glm::vec3> corners = floor_corners(floor_extent, list.space);
    // The widest labels of the whole run, so that nothing moves while time runs.
    const FloorExtent last = floor_stage(crowd.area, crowd.seconds - 2 * view.time_window, crowd.seconds);
    const Blocks blocks = aim(list, corners, last, view, metrics, top, glm::vec2(0),
                              [&] { return above_floor(list.projection, corners); });

    if (view.disks) {
        std::size_t samples = 0;
        for (const DrawnAgent& agent : paths) samples += static_cast<std::size_t>(agent.samples().count);
        list.disks.reserve(samples);
        for (const DrawnAgent& agent : paths) {
            if (may_be_seen(list, agent)) add_disks(list, agent, {}, samples_together(list, agent));
        }
    }
    if (view.boxes) {
        add_level_boxes(list, boxed(paths, view, followed), view.levels, view.color_by, metrics.scale);
        keep_within(list, paths, seconds);
        refine_crowded_boxes(list, metrics.scale);
    }
    if (view.floor) {
        add_floor_grid(list, floor_extent, metrics.scale);
        add_walls(list, crowd.area, seconds.begin, seconds.begin, metrics.scale);
    }
    if (view.time_axis) add_time_axis(list, floor_extent, metrics.scale);
    add_time_cursor(list, floor_extent, time, metrics.scale);
    if (view.disks) {
        for (const DrawnAgent& agent : paths) {
            const auto sample = sample_at(agent, time);
            if (!sample) continue;
            const mobb::Disk disk = agent.clip().disk(*sample);
            const glm::vec3 middle = list.space.point(disk.x, disk.y, time);
            const float radius = static_cast<float>(disk.r) * list.projection.pixels_per_metre(middle);
            const auto pixel = list.projection.project(middle);
            const Rect picture{glm::vec2(0), glm::vec2(size.width, size.height)};
            if (radius < kLeastRing || !pixel || !picture.grown(2 * radius).contains({*pixel, *pixel})) continue;
            add_cursor_ring(list, agent, *sample, metrics.scale, std::clamp(static_cast<int>(1.5f * radius), 10, 48));
        }
    }
    std::vector<LabelRequest> notes;
    if (choice) notes = add_candidates(list, fitted, *choice, metrics);
    if (followed >= 0) {
        const auto name = add_followed(list, paths, followed, time, 0, metrics);
        notes.insert(notes.end(), name.begin(), name.end());
    }

    if (!blocks.legend) list.legend.clear();
    if (!view.labels) return list;
    if (blocks.legend) {
        add_legend(list, blocks.legend->min, metrics.small);
        layout.reserve(*blocks.legend);
    }
    add_notes(list, layout, notes, metrics.scale);
    for (const LabelRequest& label :
         floor_and_axis_labels(list, floor_extent, view.floor, view.time_axis, metrics.small)) {
        layout.place(label, list);
    }
    return list;
}

}  // namespace mobbscope
