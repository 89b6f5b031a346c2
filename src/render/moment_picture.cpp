#include <render/aim.h>
#include <render/annotations.h>
#include <render/framing.h>
#include <render/legend.h>
#include <render/moment_bodies.h>
#include <render/moment_caption.h>
#include <render/moment_picture.h>
#include <render/paths.h>
#include <render/words.h>

#include <glm/common.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace mobbscope {

namespace {

constexpr std::size_t kMostPathsInFull = 12;  // ways of more people would hide one another
constexpr double kWayOfMany = 1.5;            // seconds of theirs that are drawn before and after the moment

double beginning(std::span<const Subject> subjects) {
    const auto earlier = [](const Subject& a, const Subject& b) { return a.begin() < b.begin(); };
    return std::min_element(subjects.begin(), subjects.end(), earlier)->begin();
}

/// The corners of upright prisms that people stay inside of, whenever it is: eight below, eight above, and so on.
std::vector<glm::vec3> standing_room(const DrawnSpace& space, std::span<const Subject> subjects,
                                     std::span<const double> heights, double slip) {
    constexpr int kSides = 8;
    const double outside = 1 / std::cos(std::numbers::pi / kSides);
    std::vector<glm::vec3> out;
    for (std::size_t s = 0; s < subjects.size(); ++s) {
        const mobb::PlacedClip& clip = subjects[s].clip();
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
std::vector<Rect> seen_at(const Lens& lens, std::span<const glm::vec3> room) {
    constexpr std::size_t kCorners = 16;
    std::vector<Rect> out;
    for (std::size_t first = 0; first + kCorners <= room.size(); first += kCorners) {
        std::optional<Rect> around;
        for (const glm::vec3& corner : room.subspan(first, kCorners)) {
            const auto at = lens.project(corner);
            if (!at) continue;
            around = around ? Rect{glm::min(around->min, *at), glm::max(around->max, *at)} : Rect{*at, *at};
        }
        if (around) out.push_back(*around);
    }
    return out;
}

/// The samples of a path within some seconds of the moment; count 0 if it has none then.
mobb::SampleRange samples_around(const mobb::PlacedClip& clip, double time, double seconds) {
    const int first = mobb::first_ending_after(clip, 0, clip.count(), time - seconds);
    const int last = mobb::first_ending_after(clip, 0, clip.count(), time + seconds);
    return {first, std::min(last + 1, clip.count()) - first};
}

/// The way that everybody has come, and fainter the one that is still ahead; all of it faint where nobody is there.
void add_ways(DrawList& list, std::span<const Subject> subjects, const Moment& moment, float scale) {
    std::vector<std::optional<int>> sample(subjects.size());
    for (const Body& body : moment.bodies) sample[static_cast<std::size_t>(body.subject)] = body.sample;
    for (std::size_t i = 0; i < subjects.size(); ++i) {
        const Subject& subject = subjects[i];
        mobb::SampleRange shown{0, subject.clip().count()};
        if (subjects.size() > kMostPathsInFull) shown = samples_around(subject.clip(), moment.time, kWayOfMany);
        const Rgba ahead = with_alpha(subject.color, list.palette.dark ? 0.4f : 0.5f);
        if (!sample[i]) {
            add_floor_trace(list, subject, shown, 0, with_alpha(ahead, 0.8f * ahead.a), scale);
            continue;
        }
        const int now = std::clamp(*sample[i], shown.first, shown.end() - 1);
        add_floor_trace(list, subject, {now, shown.end() - now}, 0, ahead, 1.2f * scale);
        add_floor_trace(list, subject, {shown.first, now - shown.first + 1}, 0, with_alpha(subject.color, 0.9f),
                        2.6f * scale);
    }
}

}  // namespace

DrawList build_moment(const FittedScene& fitted, const ViewState& asked, const PictureOptions& options) {
    const PictureSize size = options.size;
    const Metrics metrics = metrics_of(size, options.scale);
    // Time is no direction of this picture.
    ViewState view = asked;
    view.time_axis = false;
    const std::vector<Subject> people = subjects(fitted, view);
    if (people.empty()) throw std::invalid_argument("the scene has nothing to draw: it has no clips");
    const std::vector<double> heights = cylinder_heights(people);
    const Moment moment = moment_of(people, heights, view.time.value_or(beginning(people)));

    DrawList list;
    list.size = size;
    list.palette = palette_for(view.theme, options);
    list.background = options.background;
    list.moment = moment.time;
    for (const Subject& subject : people) list.participants.push_back(subject.name);
    const Bounds bounds = bounds_of(people);
    const glm::dvec3 middle = 0.5 * (bounds.min + bounds.max);
    list.space = {{middle.x, middle.y, 0}, 1};
    const double highest = *std::max_element(heights.begin(), heights.end());
    const Stage stage = make_stage({bounds.min.x, bounds.min.y, 0}, {bounds.max.x, bounds.max.y, highest});
    std::vector<glm::vec3> points = standing_room(list.space, people, heights, 0.02 * stage.step);
    const std::size_t standing = points.size();
    const std::vector<glm::vec3> corners = stage_corners(stage, list.space);
    points.insert(points.end(), corners.begin(), corners.begin() + 4);

    float top = metrics.pad;
    if (view.labels) {
        Caption caption = moment_caption(list.palette, people, moment);
        if (moment.time < bounds.min.z || moment.time >= bounds.max.z) {
            mention_cursor_outside(caption, moment.time, bounds.min.z, bounds.max.z);
        }
        if (!view.caption) caption = {};
        std::vector<LegendEntry> legend;
        if (view.legend) legend = moment_legend(list.palette, people, view);
        Words words = words_that_fit(caption, std::move(legend), glm::vec2(0), size, metrics);
        list.legend = std::move(words.legend);
        top = add_caption(list, caption, words.caption, metrics.pad, metrics.scale);
    }
    LabelLayout layout(size);
    for (const TextRun& run : list.texts) layout.reserve(run.box);
    const Blocks blocks = aim(list, points, stage, view, metrics, top, glm::vec2(0), [&] {
        std::vector<Rect> busy = occupied(list, stage, view, metrics);
        const std::vector<Rect> bodies = seen_at(list.lens, std::span(points).first(standing));
        busy.insert(busy.end(), bodies.begin(), bodies.end());
        return busy;
    });

    if (view.floor) {
        add_floor_grid(list, stage, metrics.scale);
        if (!floor_on_edge(list.lens)) add_ways(list, people, moment, metrics.scale);
    }
    add_bodies(list, people, moment, {view.disks, view.boxes}, metrics.scale);
    std::vector<LabelRequest> notes;
    const auto add = [&](const std::vector<LabelRequest>& some) {
        notes.insert(notes.end(), some.begin(), some.end());
    };
    if (moment.nearest && view.disks && names_fit(people.size())) {
        const auto body = [&](int i) -> const Body& { return moment.bodies[static_cast<std::size_t>(i)]; };
        add(add_clearance(list, body(moment.nearest->a), body(moment.nearest->b), metrics));
    }
    // Where two overlap, that is what the picture is about.
    if (view.disks && may_show_radii(people) && moment.overlaps.empty()) {
        for (const Body& body : moment.bodies) {
            if (!sets_radius(body)) continue;
            const auto length = add_radius(list, people[static_cast<std::size_t>(body.subject)], body, metrics);
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
    for (const LabelRequest& label : stage_labels(list, stage, view.floor, false, metrics.small)) {
        layout.place(label, list);
    }
    add_body_names(list, layout, people, moment, metrics);
    return list;
}

}  // namespace mobbscope
