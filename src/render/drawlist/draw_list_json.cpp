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

// What enumerators are called, in order.
constexpr std::array kBoxStates{"level",   "under_test", "apart_in_time", "separated",
                                "overlap", "avoidable",  "hit",           "annotation"};
constexpr std::array kLegendMarks{"disk", "ring", "double_ring", "box", "line", "remark"};
constexpr std::array kOverlays{"caption", "legend", "inset"};

template <class Names, class Enum>
const char* name_in(const Names& names, Enum of) {
    return names[static_cast<std::size_t>(of)];
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

void write(JsonWriter& out, const char* key, float value) { out.member(key, double{value}); }
template <int N, class Number>
void write(JsonWriter& out, const char* key, const glm::vec<N, Number>& value) {
    out.begin_array(key, Layout::row);
    for (int i = 0; i < N; ++i) out.value(static_cast<double>(value[i]));
    out.end_array();
}
template <class T>
void write(JsonWriter& out, const char* key, const T& value) {
    out.member(key, value);
}

/// A key and its value, and so on.
template <class T, class... More>
void members(JsonWriter& out, const char* key, const T& value, const More&... more) {
    write(out, key, value);
    if constexpr (sizeof...(more) > 0) members(out, more...);
}

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
    members(out, "id", objects.number(id), "participant", id ? std::optional(id->agent) : std::nullopt, kind,
            id ? std::optional(id->index) : std::nullopt);
}

void write_seen(JsonWriter& out, const Objects& objects, const std::optional<ObjectId>& id, bool on_screen) {
    out.member("on_screen", on_screen);
    if (!objects.counted()) return;
    out.member("pixels", id ? std::optional(objects.pixels(objects.number(id))) : std::nullopt);
}

void write_camera(JsonWriter& out, const ViewProjection& projection) {
    out.begin_object("camera");
    members(out, "eye", projection.eye, "right", projection.right, "up", projection.up, "back", projection.back,
            "perspective", projection.perspective);
    out.begin_array("clip_from_world", Layout::row);
    for (int column = 0; column < 4; ++column) {
        for (int row = 0; row < 4; ++row) out.value(double{projection.clip_from_world[column][row]});
    }
    out.end_array();
    out.end_object();
}

void write_disk(JsonWriter& out, const DiskInstance& disk, const Objects& objects, const ViewProjection& projection) {
    write_object(out, objects, disk.id, "sample");
    members(out, "base", disk.base, "radius", disk.radius, "height", disk.height());
    if (disk.lean() > 0) members(out, "top", disk.top, "top_radius", disk.top_radius);
    members(out, "color", color_text(disk.color));
    write_seen(out, objects, disk.id, on_screen(projection, disk));
}

void write_box(JsonWriter& out, const BoxInstance& box, const Objects& objects, const ViewProjection& projection) {
    const std::optional<ObjectId> id = box.pickable ? std::optional(box.id) : std::nullopt;
    write_object(out, objects, id, "node");
    members(out, "level", box.order.level, "state", name_in(kBoxStates, box.state), "center", box.center);
    out.list("extents", box.extents, [&](const glm::vec3& e) { out.value(e); });
    if (box.triangle) members(out, "triangle", true);
    members(out, "fill", color_text(box.fill), "edge", color_text(box.edge), "width", box.width, "dash", box.dash);
    write_seen(out, objects, id, on_screen(projection, box_corners(box)));
}

void write_panel(JsonWriter& out, const OverlayPanel& panel) {
    members(out, "min", panel.rect.min, "max", panel.rect.max, "radius", panel.radius, "fill", color_text(panel.fill),
            "border", color_text(panel.border), "border_width", panel.border_width);
}

/// In an order of their own, of boxes those last that stand for no node; equal ones by what else tells them apart.
bool comes_first(const BoxInstance& a, const BoxInstance& b) {
    if (a.pickable != b.pickable) return a.pickable;
    if (a.pickable && a.id != b.id) return before(a.id, b.id);
    return std::tie(a.order, a.state, a.center.x, a.center.y, a.center.z) <
           std::tie(b.order, b.state, b.center.x, b.center.y, b.center.z);
}
bool comes_first(const DiskInstance& a, const DiskInstance& b) { return before(a.id, b.id); }
bool comes_first(const LineInstance& a, const LineInstance& b) {
    return std::tie(a.order, a.from.x, a.from.y, a.from.z, a.to.x, a.to.y, a.to.z) <
           std::tie(b.order, b.from.x, b.from.y, b.from.z, b.to.x, b.to.y, b.to.z);
}

template <class Items, class T = typename Items::value_type>
std::vector<T> sorted(const Items& all) {
    std::vector<T> out(all.begin(), all.end());
    std::sort(out.begin(), out.end(), [](const T& a, const T& b) { return comes_first(a, b); });
    return out;
}

}  // namespace

void write_draw_list(std::ostream& stream, const DrawList& list, const IdImage* ids) {
    const Objects objects(list, ids);
    const ViewProjection& seen_by = list.projection;
    const Rect picture{{0, 0}, glm::vec2(list.size.width, list.size.height)};
    JsonWriter out(stream, JsonWriter::Digits::few);
    out.begin_object();
    members(out, "size", glm::ivec2(list.size.width, list.size.height), "background",
            color_text(list.background.value_or(list.palette.background)));
    out.values("participants", list.agents);
    write_camera(out, seen_by);
    if (list.slab) {
        members(out, "slab", glm::vec2(list.slab->low, list.slab->high), "cuts_boxes", list.slab->cuts_boxes);
    }
    rows(out, "disks", sorted(list.disks), [&](const DiskInstance& disk) { write_disk(out, disk, objects, seen_by); });
    rows(out, "boxes", sorted(list.boxes), [&](const BoxInstance& box) { write_box(out, box, objects, seen_by); });
    rows(out, "lines", sorted(list.lines), [&](const LineInstance& line) {
        members(out, "layer", static_cast<int>(line.order.layer), "from", line.from, "to", line.to, "color",
                color_text(line.color), "width", line.width, "dash", line.dash, "cap", line.cap, "hidden", line.hidden,
                "on_screen", on_screen(seen_by, std::array{line.from, line.to}));
    });
    if (!list.highlights.empty()) {
        rows(out, "highlights", list.highlights, [&](const HighlightLine& line) {
            members(out, "role", name(line.role), "from", line.from, "to", line.to, "color", color_text(line.color),
                    "width", line.width, "dash", line.dash, "on_screen",
                    on_screen(seen_by, std::array{line.from, line.to}));
        });
    }
    out.member("headline", list.headline);
    rows(out, "legend", list.legend, [&](const LegendEntry& entry) {
        members(out, "mark", name_in(kLegendMarks, entry.mark), "color", color_text(entry.color), "text", entry.text);
    });
    rows(out, "overlays", list.overlays, [&](const Overlay& overlay) {
        members(out, "name", name_in(kOverlays, overlay.kind), "min", overlay.rect.min, "max", overlay.rect.max,
                "folded", overlay.folded, "no_room", overlay.no_room);
    });
    rows(out, "panels", list.panels, [&](const OverlayPanel& panel) { write_panel(out, panel); });
    rows(out, "overlay_lines", list.overlay_lines, [&](const OverlayLine& line) {
        members(out, "from", line.from, "to", line.to, "color", color_text(line.color), "width", line.width, "dash",
                line.dash);
    });
    rows(out, "marks", list.marks, [&](const OverlayPanel& mark) { write_panel(out, mark); });
    rows(out, "texts", list.texts, [&](const TextRun& text) {
        members(out, "text", text.text, "role", name(text.role), "at", text.baseline, "size", text.size, "face",
                text.face == FontFace::mono ? "mono" : "text", "color", color_text(text.color), "on_screen",
                picture.overlaps(text.box));
    });
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
