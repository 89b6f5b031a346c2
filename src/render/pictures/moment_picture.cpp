#include <render/layout/annotations.h>
#include <render/layout/block_layout.h>
#include <render/layout/follow.h>
#include <render/layout/framing.h>
#include <render/layout/legend.h>
#include <render/parts/floor_and_axes.h>
#include <render/parts/paths.h>
#include <render/pictures/candidates.h>
#include <render/pictures/moment_caption.h>
#include <render/pictures/moment_picture.h>
#include <render/pictures/standing_agents.h>
#include <scene/crowd_run.h>
#include <scene/crowd_scene.h>

#include <glm/common.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace mobbscope {

namespace {

constexpr std::size_t kMostPathsInFull = 12;  // ways of more people would hide one another

double beginning(std::span<const DrawnAgent> agents) {
    const auto earlier = [](const DrawnAgent& a, const DrawnAgent& b) { return a.begin() < b.begin(); };
    return std::min_element(agents.begin(), agents.end(), earlier)->begin();
}

/// The corners of upright prisms that people stay inside of, whenever it is: eight below, eight above, and so on.
std::vector<glm::vec3> standing_room(const DrawnSpace& space, std::span<const DrawnAgent> agents,
                                     std::span<const double> heights, double slip) {
    constexpr int kSides = 8;
    const double outside = 1 / std::cos(std::numbers::pi / kSides);
    std::vector<glm::vec3> out;
    for (std::size_t s = 0; s < agents.size(); ++s) {
        const mobb::PlacedClip& clip = agents[s].clip();
        std::optional<mobb::Disk> last;
        for (int i = 0; i < clip.count(); ++i) {
            const mobb::Disk d = clip.disk(i);
            if (last && std::hypot(d.x - last->x, d.y - last->y) + d.r <= last->r + slip) continue;
            last = d;
            const double radius = (d.r + slip) * outside;
            for (const double height : {0.0, heights[s]}) {
                for (int side = 0; side < kSides; ++side) {
                    const double angle = (side + 0.5) * 2 * std::numbers::pi / kSides;
                    out.push_back(space.point(d.x + radius * std::cos(angle), d.y + radius * std::sin(angle), height));
                }
            }
        }
    }
    return out;
}

/// Where those prisms are seen.
std::vector<Rect> seen_at(const ViewProjection& projection, std::span<const glm::vec3> room) {
    constexpr std::size_t kCorners = 16;
    std::vector<Rect> out;
    for (std::size_t first = 0; first + kCorners <= room.size(); first += kCorners) {
        std::optional<Rect> around;
        for (const glm::vec3& corner : room.subspan(first, kCorners)) {
            const auto at = projection.project(corner);
            if (!at) continue;
            around = around ? Rect{glm::min(around->min, *at), glm::max(around->max, *at)} : Rect{*at, *at};
        }
        if (around) out.push_back(*around);
    }
    return out;
}

/// Where the floor is seen, as small rectangles.
std::vector<Rect> seen_floor(const ViewProjection& projection, std::span<const glm::vec3> corners) {
    constexpr int kCells = 10;
    std::vector<Rect> out;
    for (int i = 0; i <= kCells; ++i) {
        for (int j = 0; j <= kCells; ++j) {
            const glm::vec3 along = glm::mix(corners[0], corners[2], static_cast<float>(i) / kCells);
            const glm::vec3 across = glm::mix(corners[0], corners[1], static_cast<float>(j) / kCells) - corners[0];
            if (const auto at = projection.project(along + across)) out.push_back(Rect{*at, *at}.grown(8));
        }
    }
    return out;
}

/// The samples of a path within some seconds of the moment; count 0 if it has none then.
mobb::SampleRange samples_around(const mobb::PlacedClip& clip, double time, double seconds) {
    const int first = mobb::first_ending_after(clip, 0, clip.count(), time - seconds);
    const int last = mobb::first_ending_after(clip, 0, clip.count(), time + seconds);
    return {first, std::min(last + 1, clip.count()) - first};
}

/// Of a run the bounds are its walls, else those of the paths.
Bounds moment_bounds(const FittedScene& fitted, std::span<const DrawnAgent> people) {
    if (!fitted.scene().crowd) return bounds_of(people);
    const CrowdRun& crowd = *fitted.scene().crowd;
    Bounds bounds;
    bounds.add(glm::dvec3(-0.5 * crowd.area, 0));
    bounds.add(glm::dvec3(0.5 * crowd.area, crowd.seconds));
    return bounds;
}

/// The way that everybody has come, and fainter the one that is still ahead; all of it faint where nobody is there.
void add_ways(DrawList& list, std::span<const DrawnAgent> agents, const Moment& moment, float scale) {
    std::vector<std::optional<int>> sample(agents.size());
    for (const Body& body : moment.bodies) sample[static_cast<std::size_t>(body.agent)] = body.sample;
    for (std::size_t i = 0; i < agents.size(); ++i) {
        const DrawnAgent& agent = agents[i];
        mobb::SampleRange shown{0, agent.clip().count()};
        if (agents.size() > kMostPathsInFull || agent.run_agent >= 0)
            shown = samples_around(agent.clip(), moment.time, kWaySeconds);
        if (shown.count <= 0) continue;
        const Rgba ahead = with_alpha(agent.color, list.palette.dark ? 0.4f : 0.5f);
        // What somebody in a run played before is way so far.
        if (!sample[i] && agent.run_agent >= 0 && agent.begin() < moment.time) {
            add_floor_trace(list, agent, shown, 0, with_alpha(agent.color, 0.9f), 2.6f * scale);
            continue;
        }
        if (!sample[i] && agent.run_agent >= 0) {
            add_floor_trace(list, agent, shown, 0, ahead, 1.2f * scale);
            continue;
        }
        if (!sample[i]) {
            add_floor_trace(list, agent, shown, 0, with_alpha(ahead, 0.8f * ahead.a), scale);
            continue;
        }
        const int now = std::clamp(*sample[i], shown.first, shown.end() - 1);
        add_floor_trace(list, agent, {now, shown.end() - now}, 0, ahead, 1.2f * scale);
        add_floor_trace(list, agent, {shown.first, now - shown.first + 1}, 0, with_alpha(agent.color, 0.9f),
                        2.6f * scale);
    }
}

}  // namespace

DrawList build_moment(const FittedScene& fitted, const ViewState& asked, const PictureOptions& options,
                      const FollowedChoice* choice) {
    const PictureSize size = options.size;
    const Metrics metrics = metrics_of(size, options.scale);
    // Time is no direction of this picture.
    ViewState view = asked;
    view.time_axis = false;
    const std::vector<DrawnAgent> people = drawn_agents(fitted, view);
    if (people.empty()) throw std::invalid_argument("the scene has nothing to draw: it has no clips");
    const std::vector<double> heights = cylinder_heights(people);
    const bool is_crowd = fitted.scene().crowd != nullptr;
    const double time = is_crowd ? run_time(fitted.scene(), view) : view.time.value_or(beginning(people));
    const Moment moment = moment_of(people, heights, time);
    // Of a run each person stands there with several plays.
    const std::size_t count = is_crowd ? fitted.scene().crowd->agents.size() : people.size();
    const std::span<const DrawnAgent> persons = std::span(people).first(count);

    DrawList list;
    list.size = size;
    list.palette = palette_for(view.theme, options);
    list.background = options.background;
    list.moment = moment.time;
    for (const DrawnAgent& agent : people) list.participants.push_back(agent.name);
    const Bounds bounds = moment_bounds(fitted, people);
    const bool outside = moment.time < bounds.min.z || moment.time >= bounds.max.z;
    if (outside) choice = nullptr;
    const glm::dvec3 middle = 0.5 * (bounds.min + bounds.max);
    list.space = {{middle.x, middle.y, 0}, 1, camera_anchor(fitted, view, time)};
    const double highest = *std::max_element(heights.begin(), heights.end());
    const FloorExtent floor_extent =
        is_crowd ? floor_stage(fitted.scene().crowd->area, 0, highest)
                 : floor_extent_of({bounds.min.x, bounds.min.y, 0}, {bounds.max.x, bounds.max.y, highest});
    // Walls hold everybody, wherever they will stand.
    std::vector<glm::vec3> points;
    if (!is_crowd) points = standing_room(list.space, people, heights, 0.02 * floor_extent.step);
    const std::size_t standing = points.size();
    const std::vector<glm::vec3> corners = floor_corners(floor_extent, list.space);
    points.insert(points.end(), corners.begin(), corners.begin() + (is_crowd ? 8 : 4));

    float top = metrics.pad;
    if (view.labels) {
        Caption caption = moment_caption(list.palette, people, moment, count);
        if (outside) mention_cursor_outside(caption, moment.time, bounds.min.z, bounds.max.z);
        if (choice) caption.detail = choice_sentence(fitted.scene(), *choice);
        if (!view.caption) caption = {};
        caption.panel = scene_may_lie_behind(view, options);
        std::vector<LegendEntry> legend;
        if (view.legend) legend = moment_legend(list.palette, persons, view);
        if (view.legend && choice) {
            const auto fates = candidate_legend(list.palette, choice->choice);
            legend.insert(legend.begin(), fates.begin(), fates.end());
        }
        TextBudget words = fit_to_budget(caption, std::move(legend), glm::vec2(0), size, metrics);
        list.legend = std::move(words.legend);
        top = add_caption(list, caption, words.caption, metrics.pad, metrics.scale);
    }
    LabelLayout layout(list);
    const Blocks blocks = aim(list, points, floor_extent, view, metrics, top, glm::vec2(0), [&] {
        std::vector<Rect> busy = occupied(list, floor_extent, view, metrics);
        const std::vector<Rect> bodies = seen_at(list.projection, std::span(points).first(standing));
        busy.insert(busy.end(), bodies.begin(), bodies.end());
        if (is_crowd) {
            const std::vector<Rect> floor = seen_floor(list.projection, corners);
            busy.insert(busy.end(), floor.begin(), floor.end());
        }
        return busy;
    });

    if (view.floor) {
        add_floor_grid(list, floor_extent, metrics.scale);
        if (is_crowd) add_walls(list, fitted.scene().crowd->area, 0, kWallHeight, metrics.scale);
        if (!floor_on_edge(list.projection) && count <= kMostWithWays) add_ways(list, people, moment, metrics.scale);
    }
    add_bodies(list, people, moment, {view.disks, view.boxes}, metrics.scale);
    std::vector<LabelRequest> notes;
    const auto add = [&](const std::vector<LabelRequest>& some) {
        notes.insert(notes.end(), some.begin(), some.end());
    };
    if (choice) add(add_candidates(list, fitted, *choice, metrics));
    if (is_crowd && !view.follow.empty()) {
        const int followed = run_agent_by_name(*fitted.scene().crowd, view.follow).value_or(-1);
        add(add_followed(list, people, followed, time, heights.front(), metrics));
    }
    if (moment.nearest && view.disks && names_fit(count)) {
        const auto body = [&](int i) -> const Body& { return moment.bodies[static_cast<std::size_t>(i)]; };
        add(add_clearance(list, body(moment.nearest->a), body(moment.nearest->b), metrics));
    }
    // Where two overlap, that is what the picture is about.
    if (view.disks && may_show_radii(persons) && moment.overlaps.empty()) {
        for (const Body& body : moment.bodies) {
            if (!sets_radius(body)) continue;
            const auto length = add_radius(list, people[static_cast<std::size_t>(body.agent)], body, metrics);
            if (moment.bodies.size() == 1) add(length);
        }
    }

    if (!blocks.legend) list.legend.clear();
    if (!view.labels) return list;
    if (blocks.legend) {
        add_legend(list, blocks.legend->min, metrics.small);
        layout.reserve(*blocks.legend);
    }
    add_notes(list, layout, notes, metrics.scale);
    for (const LabelRequest& label : floor_and_axis_labels(list, floor_extent, view.floor, false, metrics.small)) {
        layout.place(label, list);
    }
    add_body_names(list, layout, people, moment, metrics);
    return list;
}

}  // namespace mobbscope
