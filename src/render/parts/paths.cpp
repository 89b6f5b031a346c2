#include <mobb/predicate.h>
#include <mobb/traversal.h>
#include <render/drawlist/palette.h>
#include <render/drawlist/pen.h>
#include <render/parts/paths.h>

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace mobbscope {

namespace {

constexpr float kDimmedLines = 0.4f;  // of the text's colour
constexpr float kOutline = 0.7f;      // opacity of what is left of who is not in the foreground
constexpr float kEarly = 0.24f;  // towards the background at the beginning of a path, so that later disks stand out

Rgba disk_color(const Palette& palette, const DrawnAgent& agent, const mobb::PlacedClip& path, const PathFocus& focus,
                int sample) {
    if (focus.hit == sample && agent.is_asked(path)) return palette.hit;
    const bool in_focus = !focus.range || (sample >= focus.range->first && sample < focus.range->end());
    if (focus.colors) {
        const Rgba figure = (*focus.colors)[static_cast<std::size_t>(sample)];
        const Rgba shown = agent.dimmed ? mix_colors(palette.background, figure, kDimmed) : figure;
        return with_alpha(shown, in_focus ? shown.a : shown.a * kOutOfFocus);
    }
    const float age = 1 - static_cast<float>(sample) / static_cast<float>(agent.clip().count());
    const float back = kEarly * age;
    return with_alpha(agent.color, (1 - back) * (in_focus ? 1 : kOutOfFocus) * (focus.behind ? kBehind : 1));
}

/// In the drawing order: agents side by side, 2^32 samples of each.
std::int64_t order_index(const DrawnAgent& agent, int sample) {
    return (static_cast<std::int64_t>(agent.index) << 32) + sample;
}

/// Behind the last of the samples that are drawn: that of a linear clip is the end of the disk before it.
int drawn_end(const mobb::PlacedClip& path, mobb::SampleRange shown) {
    return std::min(shown.end(), path.clip().steps());
}

/// What the ring around a disk is drawn around.
struct RingPlace {
    mobb::Disk disk;
    double time = 0;
};

RingPlace ring_place(const mobb::PlacedClip& clip, int sample, double time) {
    // One that stays looks the same all along: the ring lies around its middle.
    if (!clip.is_linear()) time = 0.5 * (clip.time(sample) + clip.time(sample + 1));
    return {mobb::swept(clip, sample).at(time), time};
}

struct RingLine {
    Rgba color;
    float width;
    float radius;  ///< in those of the disk
    int order;     ///< later ones lie above
    int pieces = 48;
};

void add_ring(DrawList& list, const DrawnAgent& agent, int sample, const RingPlace& place, const RingLine& ring) {
    const mobb::Disk& disk = place.disk;
    const double radius = disk.r * static_cast<double>(ring.radius);
    const auto point = [&](int i) {
        const glm::dvec2 rim = glm::dvec2(disk.x, disk.y) + radius * on_circle<double>(i, ring.pieces);
        return list.space.point(rim.x, rim.y, place.time);
    };
    const auto index = (static_cast<std::int64_t>(agent.index) << 40) + sample * ring.pieces;
    Pen(list, {DrawLayer::rings, ring.order, index})
        .path(ring.pieces, point, {.color = ring.color, .width = ring.width, .hidden = 1, .cap = 0.3f * ring.width});
}

/// The way of the centres of the samples that are drawn, in space-time.
void add_centre_line(DrawList& list, const DrawnAgent& agent, const LineStyle& style) {
    const mobb::PlacedClip& clip = agent.clip();
    const mobb::SampleRange shown = agent.samples();
    const float pixels = list.projection.pixels_per_metre(glm::vec3(0));
    const auto centre = [&](int i) {
        const mobb::Disk disk = clip.disk(std::min(i, clip.count() - 1));
        return list.space.point(disk.x, disk.y, clip.time(i));
    };
    // Pieces shorter than a pixel are not seen as such.
    const auto too_short = [&](glm::vec3 from, glm::vec3 to) { return glm::distance(from, to) * pixels < 1; };
    Pen(list, {DrawLayer::surroundings, 2, order_index(agent, shown.first)})
        .joined_path(shown.first, shown.end(), centre, too_short, style);
}

}  // namespace

Rgba line_color_of(const DrawnAgent& agent, const Palette& palette) {
    return agent.dimmed ? mix_colors(palette.background, palette.text, kDimmedLines) : palette.text;
}

void add_disks(DrawList& list, const DrawnAgent& agent, const PathFocus& focus) {
    const mobb::SampleRange shown = agent.samples();
    std::vector<DiskInstance>& disks = list.disks.edit();
    const float height = static_cast<float>(agent.clip().clip().dt() * list.space.time_height);
    for (const mobb::PlacedClip& path : agent.paths()) {
        const auto centre = [&](const mobb::Disk& disk, int i) {
            return list.space.point(disk.x, disk.y, path.time(i));
        };
        const int end = drawn_end(path, shown);
        for (int i = shown.first; i < end; ++i) {
            const mobb::Disk disk = path.disk(i);
            DiskInstance instance;
            instance.base = centre(disk, i);
            instance.radius = static_cast<float>(disk.r);
            instance.stand_upright(height);
            if (path.is_linear()) {
                // What the next one's base is computed from, too: the two faces are one to the last bit.
                const mobb::Disk at_end = path.disk_at_end(i);
                instance.top = centre(at_end, i + 1);
                instance.top_radius = static_cast<float>(at_end.r);
            }
            instance.color = disk_color(list.palette, agent, path, focus, i);
            instance.id = {agent.index, ObjectId::Kind::disk, i};
            instance.order = {DrawLayer::surroundings, 0, order_index(agent, i)};
            disks.push_back(instance);
        }
    }
}

std::size_t color_disks(std::vector<DiskInstance>& disks, std::size_t first, const Palette& palette,
                        const DrawnAgent& agent, const PathFocus& focus) {
    const mobb::SampleRange shown = agent.samples();
    for (const mobb::PlacedClip& path : agent.paths()) {
        const int end = drawn_end(path, shown);
        for (int i = shown.first; i < end; ++i) disks[first++].color = disk_color(palette, agent, path, focus, i);
    }
    return first;
}

void add_thin_path(DrawList& list, const DrawnAgent& agent, float width) {
    double widest = 0;
    for (const mobb::PlacedClip& path : agent.paths()) {
        for (const mobb::Disk& disk : path.clip().samples()) widest = std::max(widest, disk.r);
    }
    const float pixels = list.projection.pixels_per_metre(glm::vec3(0));
    // 0: the scene's middle lies behind the eye, which therefore is near.
    if (pixels <= 0 || static_cast<float>(widest) * pixels > 0.7f) return;
    add_centre_line(list, agent, {agent.color, width});
}

void add_path_outline(DrawList& list, const DrawnAgent& agent, float scale) {
    add_centre_line(list, agent, {with_alpha(agent.color, kOutline), scale});
}

Rgba floor_trace_color(const DrawnAgent& agent, const Palette& palette) {
    return with_alpha(agent.color, palette.dark ? 0.5f : 0.7f);
}

void add_floor_trace(DrawList& list, const DrawnAgent& agent, mobb::SampleRange range, float floor, Rgba color,
                     float width) {
    if (range.count < 2) return;
    const mobb::PlacedClip& clip = agent.clip();
    // Pieces shorter than a pixel or so would only darken one another.
    const float pixels = list.projection.pixels_per_metre(glm::vec3(0, 0, floor));
    const float shortest = pixels > 0 ? 1.5f / pixels : 0;
    const auto on_floor = [&](int i) {
        const mobb::Disk disk = clip.disk(i);
        glm::vec3 p = list.space.point(disk.x, disk.y, 0);
        p.z = floor;
        return p;
    };
    const auto too_short = [&](glm::vec3 from, glm::vec3 to) {
        return std::hypot(to.x - from.x, to.y - from.y) < shortest;
    };
    Pen(list, {DrawLayer::surroundings, 1, order_index(agent, range.first + 1)})
        .joined_path(range.first, range.end() - 1, on_floor, too_short, {color, width});
}

void add_cursor_ring(DrawList& list, const DrawnAgent& agent, int sample, double time, float scale, int pieces) {
    const RingPlace place = ring_place(agent.clip(), sample, time);
    add_ring(list, agent, sample, place,
             {line_color_of(agent, list.palette), (agent.outlined ? 0.8f : 1.6f) * scale, 1.04f, 0, pieces});
}

void add_hit_ring(DrawList& list, const DrawnAgent& agent, int sample, double time, float scale) {
    const RingPlace place = ring_place(agent.clip(), sample, time);
    // The ground's colour around it keeps it apart from disks of a like colour.
    add_ring(list, agent, sample, place, {list.palette.background, 5.4f * scale, 1.04f, 1});
    add_ring(list, agent, sample, place, {list.palette.hit, 3.2f * scale, 1.04f, 2});
    add_ring(list, agent, sample, place, {list.palette.hit, 1.4f * scale, 1.4f, 2});
}

DiskOverlap disk_overlap(const mobb::Disk& a, const mobb::Disk& b, int rows) {
    DiskOverlap out;
    if (!mobb::collide(a, b)) return out;
    const glm::dvec2 from(a.x, a.y);
    const glm::dvec2 way = glm::dvec2(b.x, b.y) - from;
    const double distance = std::sqrt(mobb::squared_distance(a, b));
    const glm::dvec2 along = distance > 0 ? way / distance : glm::dvec2(1, 0);
    const glm::dvec2 across(-along.y, along.x);
    // Half of what the overlap covers across: the smaller disk's radius, unless the circles cross nearer than that.
    double half = std::min(a.r, b.r);
    if (distance > 0) {
        const double foot = (distance * distance + a.r * a.r - b.r * b.r) / (2 * distance);
        const double square = a.r * a.r - foot * foot;
        out.has_tips = square > 0;
        // Where the crossing lies beyond the middle of the smaller disk, that disk is widest before it.
        if (square > 0 && foot > 0 && foot < distance) half = std::sqrt(square);
    }
    for (int i = 0; i < rows; ++i) {
        // Closer together towards the ends, where the outlines turn.
        const double v = -half * std::cos(std::numbers::pi * i / (rows - 1));
        const double reach_a = std::sqrt(std::max(a.r * a.r - v * v, 0.0));
        const double reach_b = std::sqrt(std::max(b.r * b.r - v * v, 0.0));
        const double left = std::max(-reach_a, distance - reach_b);
        const double right = std::max(std::min(reach_a, distance + reach_b), left);
        out.sides[0].push_back(from + along * left + across * v);
        out.sides[1].push_back(from + along * right + across * v);
    }
    return out;
}

}  // namespace mobbscope
