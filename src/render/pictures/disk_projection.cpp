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
constexpr double kCopyDistance = 0.16;   // ... and perpendiculars, and how far the height stands beside the disk

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

/// Seconds; 0 of the last sample of a linear clip.
double lasts(const mobb::PlacedClip& clip, int sample) { return clip.time(sample + 1) - clip.time(sample); }

/// The drawing lies on top of the disk and is never hidden by it. Places are given from the centre of the base, in
/// (x, y, w*t).
class DiskProjectionPicture final : public Picture {
  public:
    DiskProjectionPicture(const FittedScene& fitted, const ViewState& view, const PictureOptions& options)
        : Picture(fitted, view, options),
          agent_(checked(agents_, *view.projection)),
          extents_(disk_extents(agent_, view.projection->node, view.projection->sample)),
          time_scale_(agent_.placed.time_scale()) {
        view_.time_axis = false;  // the axes of the box are its own
        list_.space.origin = {extents_.base.x, extents_.base.y, extents_.base.z / time_scale_};
        list_.space.time_height = view.time_height > 0 ? view.time_height : time_scale_;
        framed_ = ShownPoints(all_points());
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
        const std::string sample = "sample " + std::to_string(view_.projection->sample);
        const std::string who = "how far " + sample + " reaches";
        out.caption.headlines = {who + " along the axes of " + node_name(agent_, view_.projection->node), who};
        std::string lengths = ": r " + with_unit(extents_.radius, "m");
        if (extents_.top_radius != extents_.radius) lengths += " to " + with_unit(extents_.top_radius, "m");
        lengths += ", dt " + with_unit(agent_.clip().clip().dt(), "s");
        out.legend.push_back({.mark = LegendEntry::Mark::disk, .color = agent_.color, .text = sample + lengths});
        for (const AxisExtent& axis : extents_.along) {
            out.legend.push_back(line_entry({list_.palette.accent, 5},
                                            axis_name("min", axis.axis) + " \u2212" + with_unit(-axis.min, "m") + ", " +
                                                axis_name("max", axis.axis) + ' ' + with_unit(axis.max, "m")));
        }
        out.legend.push_back(
            {.mark = LegendEntry::Mark::remark, .color = Rgba(0), .text = "lengths along the axes, from p"});
        return out;
    }

    std::vector<LabelRequest> content() override {
        const Palette& palette = list_.palette;
        const glm::dvec3 r = extents_.radius * extents_.heading;
        const glm::dvec3 top_r = extents_.top_radius * extents_.heading;
        const Rgba rim = outlining(agent_.color, palette);
        if (!floor_on_edge(list_.projection)) {
            circle(glm::dvec3(0), extents_.radius, rim, 1.2f);
            circle(extents_.rise, extents_.top_radius, rim, 1.2f);
        }
        // The section through p that the radius vector lies in.
        const glm::dvec3 section[] = {-r, r, extents_.rise + top_r, extents_.rise - top_r};
        for (std::size_t i = 0; i < 4; ++i) line(section[i], section[(i + 1) % 4], rim, 1.2f);
        for (std::size_t i = 0; i < 2; ++i) {
            const AxisExtent& axis = extents_.along[i];
            line(axis.direction * axis.min, axis.direction * axis.max, with_alpha(palette.accent, 0.45f), 5);
            arrow(axis_begin(axis), axis_end(axis), palette.text, 1.4f);
            for (const Mark& mark : marks_on(i)) {
                line(mark.from, mark.to, palette.accent, 1.4f, {5, 3, 5, 3});
                dot(mark.place, palette.accent, 3.4f);
            }
        }
        arrow(glm::dvec3(0), r, palette.text, 2.2f);
        if (!time_on_end(list_.projection)) {
            const glm::dvec3 height(0, 0, extents_.rise.z);
            const glm::dvec3 beside = beside_disk();
            const glm::dvec3 serif = 0.5 * kCopyDistance * extents_.radius * extents_.heading;
            line(beside - 0.5 * height, beside + 0.5 * height, palette.text, 1.2f);
            for (const double end : {-0.5, 0.5}) {
                line(beside + end * height - serif, beside + end * height + serif, palette.text, 1.2f);
            }
        }
        dot(glm::dvec3(0), palette.text, 3.6f);
        return {};
    }

    std::vector<LabelRequest> floor_labels() const override { return {}; }

    void add_names_to(LabelLayout& layout) override {
        const Rgba plain = list_.palette.text;
        for (std::size_t i = 0; i < 2; ++i) {
            const AxisExtent& axis = extents_.along[i];
            add_label(layout, axis_end(axis), axis.direction, axis_name("a", axis.axis), plain);
            for (const Mark& mark : marks_on(i)) {
                // Beyond the end of the perpendicular, clear of the disk.
                add_label(layout, mark.from, glm::normalize(mark.from - mark.to), axis_name(mark.word, axis.axis),
                          readable(list_.palette.accent, list_.palette));
            }
        }
        const glm::dvec3 down(0, 0, -1);
        add_label(layout, glm::dvec3(0), down, "p", plain);
        add_label(layout, 0.6 * extents_.radius * extents_.heading, down, "r", plain);
        if (!time_on_end(list_.projection)) add_label(layout, beside_disk(), -extents_.heading, "dt", plain);
    }

    // --- places

    glm::dvec3 axis_begin(const AxisExtent& axis) const {
        return axis.direction * (axis.min - kAxisBeyond * extents_.radius);
    }
    glm::dvec3 axis_end(const AxisExtent& axis) const {
        return axis.direction * (axis.max + kAxisBeyond * extents_.radius);
    }

    /// How far the disk reaches, on an axis; the perpendicular from there to the disk's corner goes a little beyond
    /// both, and along the other axis where the two are one point.
    struct Mark {
        const char* word;
        glm::dvec3 place, from, to;
    };
    std::array<Mark, 2> marks_on(std::size_t i) const {
        const AxisExtent& axis = extents_.along[i];
        const auto mark = [&](const char* word, double value, glm::dvec3 corner) {
            const glm::dvec3 place = axis.direction * value;
            const glm::dvec3 way = corner - place;
            const bool is_long = glm::length(way) > 1e-9 * extents_.radius;
            const glm::dvec3 unit = is_long ? glm::normalize(way) : extents_.along[1 - i].direction;
            const glm::dvec3 beyond = kCopyDistance * extents_.radius * unit;
            return Mark{word, place, place - beyond, corner + beyond};
        };
        return {mark("min", axis.min, axis.min_corner), mark("max", axis.max, axis.max_corner)};
    }

    /// Where the height is marked: left of the disk, its middle.
    glm::dvec3 beside_disk() const {
        const double leans_left = extents_.top_radius - glm::dot(extents_.rise, extents_.heading) - extents_.radius;
        const double aside = (1 + 1.6 * kCopyDistance) * extents_.radius + std::max(leans_left, 0.0);
        return -aside * extents_.heading + glm::dvec3(0, 0, 0.5 * extents_.rise.z);
    }

    std::vector<glm::vec3> all_points() const {
        std::vector<glm::vec3> out;
        for (int i = 0; i < 16; ++i) {
            const glm::dvec3 way(on_circle<double>(i, 16), 0);
            out.push_back(at(extents_.radius * way));
            out.push_back(at(extents_.rise + extents_.top_radius * way));
        }
        for (std::size_t i = 0; i < 2; ++i) {
            out.push_back(at(axis_begin(extents_.along[i])));
            out.push_back(at(axis_end(extents_.along[i])));
            for (const Mark& mark : marks_on(i)) out.push_back(at(mark.from));
        }
        out.push_back(at(beside_disk()));
        return out;
    }

    // --- drawing

    glm::vec3 at(glm::dvec3 from_base) const {
        const glm::dvec3 p = extents_.base + from_base;
        return list_.space.point(p.x, p.y, p.z / time_scale_);
    }
    void add(glm::vec3 from, glm::vec3 to, Rgba color, float width, Dash dash) {
        const DrawOrder order{DrawLayer::findings, 0, static_cast<std::int64_t>(list_.lines.size())};
        LineStyle style = scaled({color, width, dash, 1}, metrics_.scale);
        if (dash == kSolid) style.cap = 0.3f * style.width;
        list_.lines.push_back({style, from, to, order});
    }
    void line(glm::dvec3 from, glm::dvec3 to, Rgba color, float width, Dash dash = kSolid) {
        add(at(from), at(to), color, width, dash);
    }
    /// A line with a head at its end.
    void arrow(glm::dvec3 from, glm::dvec3 to, Rgba color, float width) {
        line(from, to, color, width);
        const glm::vec3 back = list_.projection.back;
        const glm::vec3 tip = at(to);
        const glm::vec3 way = tip - at(from);
        const glm::vec3 seen = way - back * glm::dot(way, back);
        const float pixels = list_.projection.pixels_per_metre(tip);
        if (pixels <= 0 || glm::length(seen) * pixels < 1) return;
        const glm::vec3 along = glm::normalize(seen) * (7 * metrics_.scale / pixels);
        const glm::vec3 across = 0.45f * glm::cross(back, along);
        add(tip, tip - along + across, color, width, kSolid);
        add(tip, tip - along - across, color, width, kSolid);
    }
    void circle(glm::dvec3 middle, double radius, Rgba color, float width) {
        const auto rim = [&](int i) { return middle + radius * glm::dvec3(on_circle<double>(i, kCirclePieces), 0); };
        for (int i = 0; i < kCirclePieces; ++i) line(rim(i), rim(i + 1), color, width);
    }
    void dot(glm::dvec3 place, Rgba color, float radius) {
        const auto middle = list_.projection.project(at(place));
        if (!middle) return;
        const float r = radius * metrics_.scale;
        list_.marks.push_back({{*middle - r, *middle + r}, r, color, list_.palette.background, 0.5f * metrics_.scale});
    }

    /// Beside a place, on the side that `outward` leads to (unit); above where that is not seen.
    void add_label(LabelLayout& layout, glm::dvec3 place, glm::dvec3 outward, const std::string& text, Rgba color) {
        const auto anchor = list_.projection.project(at(place));
        if (!anchor) return;
        // A short step, as what is far outside may lie behind the eye.
        const auto to = list_.projection.project(at(place + 0.1 * extents_.radius * outward));
        const glm::vec2 way = to ? *to - *anchor : glm::vec2(0);
        const glm::vec2 away = glm::length(way) > 1e-3f ? glm::normalize(way) : glm::vec2(0, -1);
        const glm::vec2 aside(-away.y, away.x);
        LabelRequest label;
        label.text = text;
        label.size = 1.15f * metrics_.text;
        label.color = color;
        label.anchor = *anchor;
        label.directions = {away, away + aside, away - aside, aside, -aside, -away};
        label.distance = 0.3f * label.size;
        layout.place(label, list_);
    }

    const DrawnAgent& agent_;
    DiskExtents extents_;
    double time_scale_;
};

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

std::unique_ptr<Picture> disk_projection_picture(const FittedScene& fitted, const ViewState& view,
                                                 const PictureOptions& options) {
    return std::make_unique<DiskProjectionPicture>(fitted, view, options);
}

}  // namespace mobbscope
