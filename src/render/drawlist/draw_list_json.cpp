#include <render/drawlist/draw_list_json.h>

#include <base/json_writer.h>
#include <render/drawlist/draw_list.h>

#include <glm/vec2.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

namespace mobbscope {

namespace {

using Layout = JsonWriter::Layout;

constexpr int kMostObjects = (1 << 24) - 1;

bool before(const ObjectId& a, const ObjectId& b) {
    return std::tie(a.agent, a.kind, a.index) < std::tie(b.agent, b.kind, b.index);
}

/// The numbers of what can be pointed at, and how much of it is seen.
class Objects {
  public:
    Objects(const DrawList& list, const IdImage* ids) : counted_(ids != nullptr) {
        for (const DiskInstance& disk : list.disks) ids_.push_back(disk.id);
        for (const BoxInstance& box : list.boxes) {
            if (box.pickable) ids_.push_back(box.id);
        }
        std::sort(ids_.begin(), ids_.end(), before);
        ids_.erase(std::unique(ids_.begin(), ids_.end()), ids_.end());
        pixels_.resize(ids_.size() + 1);
        if (!ids) return;
        for (int y = 0; y < ids->height; ++y) {
            for (int x = 0; x < ids->width; ++x) ++pixels_[number(ids->at(x, y))];
        }
    }

    /// From 1; 0 for nothing and for what is not in the list.
    std::size_t number(const std::optional<ObjectId>& id) const {
        if (!id) return 0;
        const auto found = std::lower_bound(ids_.begin(), ids_.end(), *id, before);
        return found == ids_.end() || *found != *id ? 0 : static_cast<std::size_t>(found - ids_.begin()) + 1;
    }
    std::size_t count() const { return ids_.size(); }
    /// Whether there is an id picture, and how many of its pixels have a number.
    bool counted() const { return counted_; }
    std::int64_t pixels(std::size_t number) const { return pixels_[number]; }

  private:
    std::vector<ObjectId> ids_;
    std::vector<std::int64_t> pixels_;  ///< by number
    bool counted_;
};

/// Whether something with these corners may be in the picture: they are not all beyond one of its sides.
bool on_screen(const ViewProjection& projection, std::span<const glm::vec3> corners) {
    std::array<bool, 5> beyond;
    beyond.fill(true);
    for (const glm::vec3& corner : corners) {
        const glm::vec4 clip = projection.clip_from_world * glm::vec4(corner, 1);
        beyond[0] = beyond[0] && clip.x < -clip.w;
        beyond[1] = beyond[1] && clip.x > clip.w;
        beyond[2] = beyond[2] && clip.y < -clip.w;
        beyond[3] = beyond[3] && clip.y > clip.w;
        beyond[4] = beyond[4] && clip.z < -clip.w;
    }
    return std::find(beyond.begin(), beyond.end(), true) == beyond.end();
}

bool on_screen(const ViewProjection& projection, const DiskInstance& disk) {
    std::array<glm::vec3, 8> corners;
    for (unsigned bits = 0; bits < 8; ++bits) {
        const glm::vec3 way((bits & 1u) ? 1 : -1, (bits & 2u) ? 1 : -1, 0);
        corners[bits] = (bits & 4u) ? disk.top + disk.top_radius * way : disk.base + disk.radius * way;
    }
    return on_screen(projection, corners);
}

std::string_view name(BoxState state) {
    constexpr std::array<std::string_view, 7> kNames{"level",   "under_test", "apart_in_time", "separated",
                                                     "overlap", "hit",        "annotation"};
    return kNames[static_cast<std::size_t>(state)];
}

std::string_view name(LegendEntry::Mark mark) {
    constexpr std::array<std::string_view, 6> kNames{"disk", "ring", "double_ring", "box", "line", "remark"};
    return kNames[static_cast<std::size_t>(mark)];
}

std::string_view name(Overlay::Kind kind) {
    constexpr std::array<std::string_view, 3> kNames{"caption", "legend", "inset"};
    return kNames[static_cast<std::size_t>(kind)];
}

std::string_view name(HighlightLine::Role role) {
    constexpr std::array<std::string_view, 5> kNames{"selection", "hover", "candidate", "conflict", "ghost"};
    return kNames[static_cast<std::size_t>(role)];
}

std::string_view name(TextRole role) {
    constexpr std::array<std::string_view, 8> kNames{"label",   "tick",   "name",   "note",
                                                     "caption", "legend", "header", "map"};
    return kNames[static_cast<std::size_t>(role)];
}

std::string color_text(Rgba color) {
    constexpr std::string_view kDigits = "0123456789ABCDEF";
    std::string out = "#";
    for (int c = 0; c < 4; ++c) {
        const auto level = static_cast<unsigned>(std::lround(255 * std::clamp(color[c], 0.0f, 1.0f)));
        out += {kDigits[level >> 4], kDigits[level & 15]};
    }
    return out;
}

template <class Vector>
void vector(JsonWriter& out, const char* key, const Vector& v) {
    out.begin_array(key, Layout::row);
    for (int i = 0; i < v.length(); ++i) out.value(static_cast<double>(v[i]));
    out.end_array();
}

void number(JsonWriter& out, const char* key, float value) { out.member(key, double{value}); }

void color(JsonWriter& out, const char* key, Rgba value) { out.member(key, color_text(value)); }

/// Rows of an array.
template <class Items, class Write>
void rows(JsonWriter& out, const char* key, const Items& items, const Write& write) {
    out.list(key, items, [&](const auto& item) {
        out.begin_object(Layout::row);
        write(item);
        out.end_object();
    });
}

void write_object(JsonWriter& out, const Objects& objects, const std::optional<ObjectId>& id, const char* kind) {
    out.member("id", objects.number(id));
    out.member("participant", id ? std::optional(id->agent) : std::nullopt);
    out.member(kind, id ? std::optional(id->index) : std::nullopt);
}

void write_seen(JsonWriter& out, const Objects& objects, const std::optional<ObjectId>& id, bool on_screen) {
    out.member("on_screen", on_screen);
    if (!objects.counted()) return;
    out.member("pixels", id ? std::optional(objects.pixels(objects.number(id))) : std::nullopt);
}

void write_camera(JsonWriter& out, const ViewProjection& projection) {
    out.begin_object("camera");
    vector(out, "eye", projection.eye);
    vector(out, "right", projection.right);
    vector(out, "up", projection.up);
    vector(out, "back", projection.back);
    out.member("perspective", projection.perspective);
    out.begin_array("clip_from_world", Layout::row);
    for (int column = 0; column < 4; ++column) {
        for (int row = 0; row < 4; ++row) out.value(double{projection.clip_from_world[column][row]});
    }
    out.end_array();
    out.end_object();
}

void write_disk(JsonWriter& out, const DiskInstance& disk, const Objects& objects, const ViewProjection& projection) {
    write_object(out, objects, disk.id, "sample");
    vector(out, "base", disk.base);
    number(out, "radius", disk.radius);
    number(out, "height", disk.height());
    if (disk.lean() > 0) {
        vector(out, "top", disk.top);
        number(out, "top_radius", disk.top_radius);
    }
    color(out, "color", disk.color);
    write_seen(out, objects, disk.id, on_screen(projection, disk));
}

void write_box(JsonWriter& out, const BoxInstance& box, const Objects& objects, const ViewProjection& projection) {
    const std::optional<ObjectId> id = box.pickable ? std::optional(box.id) : std::nullopt;
    write_object(out, objects, id, "node");
    out.member("level", box.order.level);
    out.member("state", name(box.state));
    vector(out, "center", box.center);
    out.list("extents", box.extents, [&](const glm::vec3& e) { out.value(e); });
    color(out, "fill", box.fill);
    color(out, "edge", box.edge);
    number(out, "width", box.width);
    vector(out, "dash", box.dash);
    write_seen(out, objects, id, on_screen(projection, box_corners(box)));
}

void write_line(JsonWriter& out, const LineInstance& line, const ViewProjection& projection) {
    out.member("layer", static_cast<int>(line.order.layer));
    vector(out, "from", line.from);
    vector(out, "to", line.to);
    color(out, "color", line.color);
    number(out, "width", line.width);
    vector(out, "dash", line.dash);
    number(out, "cap", line.cap);
    number(out, "hidden", line.hidden);
    out.member("on_screen", on_screen(projection, std::array{line.from, line.to}));
}

void write_highlight(JsonWriter& out, const HighlightLine& line, const ViewProjection& projection) {
    out.member("role", name(line.role));
    vector(out, "from", line.from);
    vector(out, "to", line.to);
    color(out, "color", line.color);
    number(out, "width", line.width);
    out.member("on_screen", on_screen(projection, std::array{line.from, line.to}));
}

void write_panel(JsonWriter& out, const OverlayPanel& panel) {
    vector(out, "min", panel.rect.min);
    vector(out, "max", panel.rect.max);
    number(out, "radius", panel.radius);
    color(out, "fill", panel.fill);
    color(out, "border", panel.border);
    number(out, "border_width", panel.border_width);
}

void write_overlay(JsonWriter& out, const Overlay& overlay) {
    out.member("name", name(overlay.kind));
    vector(out, "min", overlay.rect.min);
    vector(out, "max", overlay.rect.max);
    out.member("folded", overlay.folded);
    out.member("no_room", overlay.no_room);
    out.member("more", overlay.more.has_value());
}

void write_overlay_line(JsonWriter& out, const OverlayLine& line) {
    vector(out, "from", line.from);
    vector(out, "to", line.to);
    color(out, "color", line.color);
    number(out, "width", line.width);
    vector(out, "dash", line.dash);
}

void write_text(JsonWriter& out, const TextRun& text, const PictureSize& size) {
    out.member("text", text.text);
    out.member("role", name(text.role));
    vector(out, "at", text.baseline);
    number(out, "size", text.size);
    out.member("face", text.face == FontFace::mono ? "mono" : "text");
    color(out, "color", text.color);
    const Rect picture{{0, 0}, glm::vec2(size.width, size.height)};
    out.member("on_screen", picture.overlaps(text.box));
}

/// In an order of their own: boxes that stand for no node come last; equal ones by what else tells them apart.
std::vector<BoxInstance> sorted(std::vector<BoxInstance> boxes) {
    std::sort(boxes.begin(), boxes.end(), [](const BoxInstance& a, const BoxInstance& b) {
        if (a.pickable != b.pickable) return a.pickable;
        if (a.pickable && a.id != b.id) return before(a.id, b.id);
        return std::tie(a.order, a.state, a.center.x, a.center.y, a.center.z) <
               std::tie(b.order, b.state, b.center.x, b.center.y, b.center.z);
    });
    return boxes;
}

std::vector<DiskInstance> sorted(const SharedValues<DiskInstance>& all) {
    std::vector<DiskInstance> disks(all.begin(), all.end());
    std::sort(disks.begin(), disks.end(),
              [](const DiskInstance& a, const DiskInstance& b) { return before(a.id, b.id); });
    return disks;
}

std::vector<LineInstance> sorted(std::vector<LineInstance> lines) {
    std::sort(lines.begin(), lines.end(), [](const LineInstance& a, const LineInstance& b) {
        return std::tie(a.order, a.from.x, a.from.y, a.from.z, a.to.x, a.to.y, a.to.z) <
               std::tie(b.order, b.from.x, b.from.y, b.from.z, b.to.x, b.to.y, b.to.z);
    });
    return lines;
}

}  // namespace

void write_draw_list(std::ostream& stream, const DrawList& list, const IdImage* ids) {
    const Objects objects(list, ids);
    JsonWriter out(stream, JsonWriter::Digits::few);
    out.begin_object();
    vector(out, "size", glm::ivec2(list.size.width, list.size.height));
    color(out, "background", list.background.value_or(list.palette.background));
    out.values("participants", list.agents);
    write_camera(out, list.projection);
    rows(out, "disks", sorted(list.disks),
         [&](const DiskInstance& disk) { write_disk(out, disk, objects, list.projection); });
    rows(out, "boxes", sorted(list.boxes),
         [&](const BoxInstance& box) { write_box(out, box, objects, list.projection); });
    rows(out, "lines", sorted(list.lines), [&](const LineInstance& line) { write_line(out, line, list.projection); });
    if (!list.highlights.empty()) {
        rows(out, "highlights", list.highlights,
             [&](const HighlightLine& line) { write_highlight(out, line, list.projection); });
    }
    out.member("headline", list.headline);
    rows(out, "legend", list.legend, [&](const LegendEntry& entry) {
        out.member("mark", name(entry.mark));
        color(out, "color", entry.color);
        out.member("text", entry.text);
    });
    rows(out, "overlays", list.overlays, [&](const Overlay& overlay) { write_overlay(out, overlay); });
    rows(out, "panels", list.panels, [&](const OverlayPanel& panel) { write_panel(out, panel); });
    rows(out, "overlay_lines", list.overlay_lines, [&](const OverlayLine& line) { write_overlay_line(out, line); });
    rows(out, "marks", list.marks, [&](const OverlayPanel& mark) { write_panel(out, mark); });
    rows(out, "texts", list.texts, [&](const TextRun& text) { write_text(out, text, list.size); });
    out.end_object();
}

Image id_picture(const DrawList& list, const IdImage& ids) {
    const Objects objects(list, nullptr);
    if (objects.count() > kMostObjects) {
        throw std::invalid_argument(
            "a picture of object ids has room for 16777215 objects; show fewer levels or clips");
    }
    Image image(ids.width, ids.height);
    for (int y = 0; y < ids.height; ++y) {
        for (int x = 0; x < ids.width; ++x) {
            const std::size_t number = objects.number(ids.at(x, y));
            std::uint8_t* pixel = image.at(x, y);
            for (unsigned c = 0; c < 3; ++c) pixel[c] = static_cast<std::uint8_t>(number >> (16 - 8 * c));
            pixel[3] = 255;
        }
    }
    return image;
}

}  // namespace mobbscope
