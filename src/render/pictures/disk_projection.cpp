#include <base/text.h>
#include <explain/query_sentence.h>
#include <render/drawlist/pen.h>
#include <render/layout/caption.h>
#include <render/layout/framing.h>
#include <render/layout/legend.h>
#include <render/parts/node_boxes.h>
#include <render/pictures/disk_projection.h>
#include <render/text/labels.h>
#include <scene/view_state.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace mobbscope {

namespace {

constexpr int kCirclePieces = 64;
constexpr double kAxisBeyond = 0.35;     // of the radius: how far axes go beyond what is marked on them
constexpr double kMarginForNames = 0.3;  // they stand beyond the ends of the axes and of the perpendiculars
constexpr double kAside = 0.16;          // ... and perpendiculars, and how far the height stands beside the disk

const DrawnAgent& checked(std::span<const DrawnAgent> agents, const DiskProjection& projection) {
    if (projection.agent < 0 || static_cast<std::size_t>(projection.agent) >= agents.size()) {
        throw ViewMismatch("projection", "there is no participant " + std::to_string(projection.agent) + ": " +
                                             std::to_string(agents.size()) + (agents.size() == 1 ? " is" : " are") +
                                             " drawn, counted from 0");
    }
    const DrawnAgent& agent = agents[static_cast<std::size_t>(projection.agent)];
    const auto nodes = agent.placed.tree().nodes();
    if (projection.node < 0 || static_cast<std::size_t>(projection.node) >= nodes.size()) {
        throw ViewMismatch("projection", "there is no node " + std::to_string(projection.node) + " in the tree of " +
                                             in_quotes(agent.name) + ": it has " + std::to_string(nodes.size()) +
                                             ", counted from 0");
    }
    const mobb::Node& node = agent.placed.node(projection.node);
    if (projection.sample < node.first || projection.sample >= node.end()) {
        throw ViewMismatch("projection", "there is no sample " + std::to_string(projection.sample) + " in node " +
                                             std::to_string(projection.node) + " of " + in_quotes(agent.name) +
                                             ": it has those from " + std::to_string(node.first) + " to " +
                                             std::to_string(node.end() - 1));
    }
    return agent;
}

/// "a₀".
std::string axis_name(const char* word, int axis) {
    const char* const subscripts[] = {"\u2080", "\u2081", "\u2082"};
    return std::string(word) + subscripts[axis];
}

/// The drawing, on top of the disk and never hidden by it.
class Diagram {
  public:
    Diagram(DrawList& list, const DiskExtents& extents, double time_scale, float scale)
        : list_(list), extents_(extents), time_scale_(time_scale), scale_(scale) {}

    /// A place given from the centre of the base, in (x, y, w*t), as it is drawn.
    glm::vec3 at(glm::dvec3 from_base) const {
        const glm::dvec3 p = extents_.base + from_base;
        return list_.space.point(p.x, p.y, p.z / time_scale_);
    }
    void line(glm::dvec3 from, glm::dvec3 to, Rgba color, float width, Dash dash = kSolid) {
        add(at(from), at(to), color, width, dash);
    }
    /// A line with a head at its end; needs the projection.
    void arrow(glm::dvec3 from, glm::dvec3 to, Rgba color, float width) {
        line(from, to, color, width);
        const glm::vec3 tip = at(to);
        const glm::vec3 way = tip - at(from);
        const glm::vec3 seen = way - list_.projection.back * glm::dot(way, list_.projection.back);
        const float pixels = list_.projection.pixels_per_metre(tip);
        if (pixels <= 0 || glm::length(seen) * pixels < 1) return;
        const glm::vec3 along = glm::normalize(seen) * (7 * scale_ / pixels);
        const glm::vec3 across = 0.45f * glm::cross(list_.projection.back, along);
        add(tip, tip - along + across, color, width, kSolid);
        add(tip, tip - along - across, color, width, kSolid);
    }
    void circle(glm::dvec3 middle, double radius, Rgba color, float width) {
        const auto rim = [&](int i) { return middle + radius * glm::dvec3(on_circle<double>(i, kCirclePieces), 0); };
        for (int i = 0; i < kCirclePieces; ++i) line(rim(i), rim(i + 1), color, width);
    }
    /// The way in the picture from a place outwards, unit; upwards where none is seen.
    glm::vec2 seen_way(glm::dvec3 place, glm::dvec3 outward) const {
        // A short step, as what is far outside may lie behind the eye.
        const auto from = list_.projection.project(at(place));
        const auto to = list_.projection.project(at(place + 0.1 * extents_.radius * outward));
        const glm::vec2 way = from && to ? *to - *from : glm::vec2(0);
        return glm::length(way) > 1e-3f ? glm::normalize(way) : glm::vec2(0, -1);
    }
    void dot(glm::dvec3 place, Rgba color, float radius) {
        const auto middle = list_.projection.project(at(place));
        if (!middle) return;
        const float r = radius * scale_;
        list_.marks.push_back({{*middle - r, *middle + r}, r, color, list_.palette.background, 0.5f * scale_});
    }

  private:
    void add(glm::vec3 from, glm::vec3 to, Rgba color, float width, Dash dash) {
        const DrawOrder order{DrawLayer::findings, 0, static_cast<std::int64_t>(list_.lines.size())};
        LineStyle style = scaled({color, width, dash, 1}, scale_);
        if (dash == kSolid) style.cap = 0.3f * style.width;
        list_.lines.push_back({style, from, to, order});
    }

    DrawList& list_;
    const DiskExtents& extents_;
    double time_scale_;
    float scale_;
};

glm::dvec3 axis_begin(const AxisExtent& axis, double radius) {
    return axis.direction * (axis.min - kAxisBeyond * radius);
}
glm::dvec3 axis_end(const AxisExtent& axis, double radius) {
    return axis.direction * (axis.max + kAxisBeyond * radius);
}

/// Where the height is marked: left of the disk, its middle.
glm::dvec3 beside_disk(const DiskExtents& extents) {
    const double leans_left = extents.top_radius - glm::dot(extents.rise, extents.heading) - extents.radius;
    const double aside = (1 + 1.6 * kAside) * extents.radius + std::max(leans_left, 0.0);
    return -aside * extents.heading + glm::dvec3(0, 0, 0.5 * extents.rise.z);
}

/// From the mark on the axis to the disk's corner and a little beyond both; along the other axis where the two are one
/// point.
struct Perpendicular {
    glm::dvec3 from{0};
    glm::dvec3 to{0};
};
Perpendicular perpendicular(const AxisExtent& axis, double value, glm::dvec3 corner, glm::dvec3 other, double radius) {
    const glm::dvec3 mark = axis.direction * value;
    const glm::dvec3 way = corner - mark;
    const glm::dvec3 unit = glm::length(way) > 1e-9 * radius ? glm::normalize(way) : other;
    return {mark - kAside * radius * unit, corner + kAside * radius * unit};
}

std::vector<glm::vec3> projected_points(const Diagram& diagram, const DiskExtents& extents) {
    std::vector<glm::vec3> out;
    for (int i = 0; i < 16; ++i) {
        const glm::dvec3 way(on_circle<double>(i, 16), 0);
        out.push_back(diagram.at(extents.radius * way));
        out.push_back(diagram.at(extents.rise + extents.top_radius * way));
    }
    for (std::size_t i = 0; i < 2; ++i) {
        const AxisExtent& axis = extents.along[i];
        out.push_back(diagram.at(axis_begin(axis, extents.radius)));
        out.push_back(diagram.at(axis_end(axis, extents.radius)));
        const glm::dvec3 other = extents.along[1 - i].direction;
        for (const auto& [value, corner] : {std::pair(axis.min, axis.min_corner), {axis.max, axis.max_corner}}) {
            out.push_back(diagram.at(perpendicular(axis, value, corner, other, extents.radius).from));
        }
    }
    out.push_back(diagram.at(beside_disk(extents)));
    return out;
}

void draw(Diagram& diagram, const DiskExtents& extents, const ViewProjection& projection, const Palette& palette,
          Rgba disk) {
    const glm::dvec3 r = extents.radius * extents.heading;
    const glm::dvec3 top_r = extents.top_radius * extents.heading;
    const glm::dvec3 height(0, 0, extents.rise.z);
    const Rgba rim = outlining(disk, palette);
    if (!floor_on_edge(projection)) {
        diagram.circle(glm::dvec3(0), extents.radius, rim, 1.2f);
        diagram.circle(extents.rise, extents.top_radius, rim, 1.2f);
    }
    // The section through p that the radius vector lies in.
    const glm::dvec3 section[] = {-r, r, extents.rise + top_r, extents.rise - top_r};
    for (std::size_t i = 0; i < 4; ++i) diagram.line(section[i], section[(i + 1) % 4], rim, 1.2f);
    for (std::size_t i = 0; i < 2; ++i) {
        const AxisExtent& axis = extents.along[i];
        const glm::dvec3 other = extents.along[1 - i].direction;
        diagram.line(axis.direction * axis.min, axis.direction * axis.max, with_alpha(palette.accent, 0.45f), 5);
        diagram.arrow(axis_begin(axis, extents.radius), axis_end(axis, extents.radius), palette.text, 1.4f);
        for (const auto& [value, corner] : {std::pair(axis.min, axis.min_corner), {axis.max, axis.max_corner}}) {
            const Perpendicular line = perpendicular(axis, value, corner, other, extents.radius);
            diagram.line(line.from, line.to, palette.accent, 1.4f, {5, 3, 5, 3});
            diagram.dot(axis.direction * value, palette.accent, 3.4f);
        }
    }
    diagram.arrow(glm::dvec3(0), r, palette.text, 2.2f);
    if (!time_on_end(projection)) {
        const glm::dvec3 beside = beside_disk(extents);
        const glm::dvec3 serif = 0.5 * kAside * extents.radius * extents.heading;
        diagram.line(beside - 0.5 * height, beside + 0.5 * height, palette.text, 1.2f);
        for (const double end : {-0.5, 0.5}) {
            diagram.line(beside + end * height - serif, beside + end * height + serif, palette.text, 1.2f);
        }
    }
    diagram.dot(glm::dvec3(0), palette.text, 3.6f);
}

std::vector<LegendEntry> legend(const DiskExtents& extents, const Palette& palette, Rgba disk, int sample, double dt) {
    std::vector<LegendEntry> out;
    std::string lengths = ": r " + with_unit(extents.radius, "m");
    if (extents.top_radius != extents.radius) lengths += " to " + with_unit(extents.top_radius, "m");
    lengths += ", dt " + with_unit(dt, "s");
    out.push_back(
        {.mark = LegendEntry::Mark::disk, .color = disk, .text = "sample " + std::to_string(sample) + lengths});
    for (const AxisExtent& axis : extents.along) {
        out.push_back(
            line_entry({palette.accent, 5}, axis_name("min", axis.axis) + " \u2212" + with_unit(-axis.min, "m") + ", " +
                                                axis_name("max", axis.axis) + ' ' + with_unit(axis.max, "m")));
    }
    out.push_back({.mark = LegendEntry::Mark::remark, .color = Rgba(0), .text = "lengths along the axes, from p"});
    return out;
}

/// Beside a place, on the side that `outward` leads to (unit).
void add_label(DrawList& list, LabelLayout& layout, const Diagram& diagram, glm::dvec3 place, glm::dvec3 outward,
               const std::string& text, Rgba color, float size) {
    const auto anchor = list.projection.project(diagram.at(place));
    if (!anchor) return;
    LabelRequest label;
    label.text = text;
    label.size = size;
    label.color = color;
    label.anchor = *anchor;
    const glm::vec2 away = diagram.seen_way(place, outward);
    const glm::vec2 aside(-away.y, away.x);
    label.directions = {away, away + aside, away - aside, aside, -aside, -away};
    label.distance = 0.3f * size;
    layout.place(label, list);
}

void add_labels(DrawList& list, LabelLayout& layout, const Diagram& diagram, const DiskExtents& extents,
                float text_size) {
    const float size = 1.15f * text_size;
    const Rgba plain = list.palette.text;
    const Rgba marked = readable(list.palette.accent, list.palette);
    for (std::size_t i = 0; i < 2; ++i) {
        const AxisExtent& axis = extents.along[i];
        const glm::dvec3 other = extents.along[1 - i].direction;
        add_label(list, layout, diagram, axis_end(axis, extents.radius), axis.direction, axis_name("a", axis.axis),
                  plain, size);
        const auto mark = [&](const char* word, double value, glm::dvec3 corner) {
            // Beyond the end of the perpendicular, clear of the disk.
            const Perpendicular line = perpendicular(axis, value, corner, other, extents.radius);
            add_label(list, layout, diagram, line.from, glm::normalize(line.from - line.to), axis_name(word, axis.axis),
                      marked, size);
        };
        mark("min", axis.min, axis.min_corner);
        mark("max", axis.max, axis.max_corner);
    }
    const glm::dvec3 down(0, 0, -1);
    add_label(list, layout, diagram, glm::dvec3(0), down, "p", plain, size);
    add_label(list, layout, diagram, 0.6 * extents.radius * extents.heading, down, "r", plain, size);
    if (!time_on_end(list.projection)) {
        add_label(list, layout, diagram, beside_disk(extents), -extents.heading, "dt", plain, size);
    }
}

/// Seconds; 0 of the last sample of a linear clip.
double lasts(const mobb::PlacedClip& clip, int sample) { return clip.time(sample + 1) - clip.time(sample); }

}  // namespace

DiskExtents disk_extents(const DrawnAgent& agent, int node, int sample) {
    const mobb::Box box = world_box(agent.placed, node);
    const mobb::PlacedClip& clip = agent.clip();
    const mobb::Disk disk = clip.disk(sample);
    const mobb::Disk at_end = clip.disk_at_end(sample);
    const double w = agent.placed.time_scale();
    DiskExtents out;
    out.base = {disk.x, disk.y, w * clip.time(sample)};
    out.radius = disk.r;
    out.rise = {at_end.x - disk.x, at_end.y - disk.y, w * lasts(clip, sample)};
    out.top_radius = at_end.r;
    const auto on_floor = [](glm::dvec3 v) {
        const glm::dvec3 flat(v.x, v.y, 0);
        const double length = glm::length(flat);
        return length > 1e-12 ? flat / length : glm::dvec3(0);
    };
    out.heading = on_floor(box.axes[0]);
    const std::array<int, 2> axes =
        mobb::info(box.kind).axes == mobb::BoxAxes::space_time ? std::array{0, 2} : std::array{0, 1};
    for (std::size_t i = 0; i < 2; ++i) {
        AxisExtent& axis = out.along[i];
        axis.axis = axes[i];
        axis.direction = box.axes[static_cast<std::size_t>(axes[i])];
        const glm::dvec3 way = on_floor(axis.direction);
        const auto along = [&](glm::dvec3 corner) { return glm::dot(corner, axis.direction); };
        // Of an upright disk the height lies on the side that the axis leans to (Fig. 6; its signs hold for one
        // orientation only); one that leans may reach farther above on both.
        const glm::dvec3 least = -out.radius * way, least_above = out.rise - out.top_radius * way;
        const glm::dvec3 most = out.radius * way, most_above = out.rise + out.top_radius * way;
        axis.min_corner = along(least_above) <= along(least) ? least_above : least;
        axis.max_corner = along(most_above) > along(most) ? most_above : most;
        axis.min = along(axis.min_corner);
        axis.max = along(axis.max_corner);
    }
    return out;
}

namespace {

class DiskProjectionPicture final : public Picture {
  public:
    DiskProjectionPicture(const FittedScene& fitted, const ViewState& view, const PictureOptions& options)
        : Picture(fitted, view, options),
          agent_(checked(agents_, *view.projection)),
          extents_(disk_extents(agent_, view.projection->node, view.projection->sample)) {
        const double w = agent_.placed.time_scale();
        list_.space.origin = {extents_.base.x, extents_.base.y, extents_.base.z / w};
        list_.space.time_height = view.time_height > 0 ? view.time_height : w;
        const Diagram diagram(list_, extents_, w, metrics_.scale);
        framed_ = ShownPoints(projected_points(diagram, extents_));
        points_ = framed_;
        margin_ = kMarginForNames;
        if (!view.disks) return;
        DiskInstance disk;
        disk.radius = static_cast<float>(extents_.radius);
        const double seconds = lasts(agent_.clip(), view.projection->sample);
        disk.stand_upright(static_cast<float>(seconds * list_.space.time_height));
        disk.top += glm::vec3(glm::dvec3(extents_.rise.x, extents_.rise.y, 0));
        disk.top_radius = static_cast<float>(extents_.top_radius);
        disk.color = with_alpha(agent_.color, 0.5f);
        disk.id = {agent_.index, ObjectId::Kind::disk, view.projection->sample};
        list_.disks.edit().push_back(disk);
    }

  private:
    OverlayContents words() override {
        OverlayContents out;
        const std::string who = "how far sample " + std::to_string(view_.projection->sample) + " reaches";
        out.caption.headlines = {who + " along the axes of " + node_name(agent_, view_.projection->node), who};
        out.legend = legend(extents_, list_.palette, agent_.color, view_.projection->sample, agent_.clip().clip().dt());
        return out;
    }

    std::vector<LabelRequest> content() override {
        Diagram diagram(list_, extents_, agent_.placed.time_scale(), metrics_.scale);
        mobbscope::draw(diagram, extents_, list_.projection, list_.palette, agent_.color);
        return {};
    }

    std::vector<LabelRequest> floor_labels() const override { return {}; }

    void add_names_to(LabelLayout& layout) override {
        const Diagram diagram(list_, extents_, agent_.placed.time_scale(), metrics_.scale);
        add_labels(list_, layout, diagram, extents_, metrics_.text);
    }

    const DrawnAgent& agent_;
    DiskExtents extents_;
};

}  // namespace

std::unique_ptr<Picture> disk_projection_picture(const FittedScene& fitted, const ViewState& view,
                                                 const PictureOptions& options) {
    return std::make_unique<DiskProjectionPicture>(fitted, view, options);
}

}  // namespace mobbscope
