#include <render/drawlist/draw_list_json.h>

#include <base/json.h>
#include <base/json_writer.h>
#include <base/text.h>
#include <render/drawlist/draw_list.h>

#include <glm/vec2.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <stdexcept>
#include <tuple>
#include <variant>
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
    out.list("extents", box.extents, [&](const glm::vec3& e) { out.numbers({e.x, e.y, e.z}); });
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

constexpr double kNear = 1e-4;
constexpr double kNearPixels = 0.01;
constexpr double kFewPixels = 16;

bool agree(double a, double b, bool pixels) {
    const double size = std::max(std::abs(a), std::abs(b));
    return std::abs(a - b) <= (pixels ? std::max(kFewPixels, kNearPixels * size) : std::max(kNear, kNear * size));
}

/// Two values of one type that hold no others.
bool agree(const JsonValue& a, const JsonValue& b, bool pixels) {
    if (const auto* number = std::get_if<double>(&a.data)) return agree(*number, std::get<double>(b.data), pixels);
    if (const auto* text = std::get_if<std::string>(&a.data)) return *text == std::get<std::string>(b.data);
    if (const auto* boolean = std::get_if<bool>(&a.data)) return *boolean == std::get<bool>(b.data);
    return true;
}

/// A place for a message.
std::string named(const std::string& place) { return place.empty() ? "the whole" : place; }

/// A value for a message.
std::string shown(const JsonValue& value) {
    struct Show {
        std::string operator()(std::nullptr_t) const { return "null"; }
        std::string operator()(bool boolean) const { return boolean ? "true" : "false"; }
        std::string operator()(double number) const { return brief(number); }
        std::string operator()(const std::string& text) const { return in_quotes(text); }
        std::string operator()(const JsonValue::Array&) const { return "an array"; }
        std::string operator()(const JsonValue::Object&) const { return "an object"; }
    };
    return std::visit(Show{}, value.data);
}

const JsonValue* find(const JsonValue::Object& object, const std::string& key) {
    const auto found =
        std::find_if(object.begin(), object.end(), [&](const JsonMember& member) { return member.key == key; });
    return found == object.end() ? nullptr : &found->value;
}

/// What differs at a place (RFC 6901).
struct Difference {
    std::string place;
    std::string what;  ///< "1.02 instead of 1"
};

/// Differences as they are found, until there are enough.
class Differences {
  public:
    explicit Differences(std::size_t most) : most_(most) {}

    bool full() const { return found_.size() >= most_; }
    const std::vector<Difference>& found() const { return found_; }

    /// `pixels`: whether they are numbers of pixels.
    void compare(const std::string& place, const JsonValue& actual, const JsonValue& golden, bool pixels) {
        if (full()) return;
        if (actual.data.index() == golden.data.index()) {
            if (const auto* object = std::get_if<JsonValue::Object>(&golden.data))
                return compare(place, std::get<JsonValue::Object>(actual.data), *object);
            if (const auto* array = std::get_if<JsonValue::Array>(&golden.data)) {
                if (!add_length(place, actual, golden)) compare(place, std::get<JsonValue::Array>(actual.data), *array);
                return;
            }
            if (agree(actual, golden, pixels)) return;
        }
        add(place, shown(actual) + " instead of " + shown(golden));
    }

  private:
    void add(const std::string& place, std::string what) {
        if (!full()) found_.push_back({place, std::move(what)});
    }

    /// Where two values have another number of elements: those that are missing shift all that come after.
    bool add_length(const std::string& place, const JsonValue& actual, const JsonValue& golden) {
        const auto* here = std::get_if<JsonValue::Array>(&actual.data);
        const auto* there = std::get_if<JsonValue::Array>(&golden.data);
        if (!here || !there || here->size() == there->size()) return false;
        add(place, counted(static_cast<long long>(here->size()), "element", "elements") + " instead of " +
                       std::to_string(there->size()));
        return true;
    }

    void compare(const std::string& place, const JsonValue::Array& actual, const JsonValue::Array& golden) {
        for (std::size_t i = 0; i < golden.size(); ++i) {
            compare(place + '/' + std::to_string(i), actual[i], golden[i], false);
        }
    }

    /// That something is missing or of another number comes before what differs in it.
    void compare(const std::string& place, const JsonValue::Object& actual, const JsonValue::Object& golden) {
        std::vector<const JsonMember*> alike;
        for (const JsonMember& member : golden) {
            const std::string there = place + pointer_token(member.key);
            const JsonValue* found = find(actual, member.key);
            if (!found) {
                add(there, "missing");
            } else if (!add_length(there, *found, member.value)) {
                alike.push_back(&member);
            }
        }
        for (const JsonMember& member : actual) {
            if (!find(golden, member.key)) add(place + pointer_token(member.key), "not expected");
        }
        for (const JsonMember* member : alike) {
            compare(place + pointer_token(member->key), *find(actual, member->key), member->value,
                    member->key == "pixels");
        }
    }

    std::size_t most_;
    std::vector<Difference> found_;
};

// --- differences in words

/// The keys and numbers of a place.
std::vector<std::string> tokens_of(const std::string& place) {
    std::vector<std::string> out;
    for (std::size_t at = 0; at < place.size();) {
        const std::size_t end = std::min(place.find('/', at + 1), place.size());
        out.push_back(place.substr(at + 1, end - at - 1));
        at = end;
    }
    return out;
}

/// What one element of a list is called.
struct ElementName {
    std::string_view list, element;
    std::string_view number;  ///< the key that tells it from others of its agent; empty: its place does
};
constexpr std::array<ElementName, 9> kElementNames{{{"disks", "disk", "sample"},
                                                    {"boxes", "box", "node"},
                                                    {"lines", "line", ""},
                                                    {"highlights", "highlight", ""},
                                                    {"legend", "legend's row", ""},
                                                    {"panels", "panel", ""},
                                                    {"overlay_lines", "line over the scene", ""},
                                                    {"marks", "mark", ""},
                                                    {"texts", "text", ""}}};

template <class Held>
const Held* held(const JsonValue::Object& object, std::string_view key) {
    const JsonValue* value = find(object, std::string(key));
    return value ? std::get_if<Held>(&value->data) : nullptr;
}

/// "box of A, node 3", "line 4", "text 'A'". `list`: the draw list, which names the participants.
std::string element_words(const ElementName& name, const JsonValue& element, std::size_t index,
                          const JsonValue::Object& list) {
    std::string numbered = std::string(name.element) + ' ' + std::to_string(index + 1);
    const auto* object = std::get_if<JsonValue::Object>(&element.data);
    if (!object) return numbered;
    if (const auto* text = held<std::string>(*object, "text"))
        return std::string(name.element) + ' ' + in_quotes(*text);
    const auto* participant = held<double>(*object, "participant");
    const auto* number = held<double>(*object, name.number);
    const auto* names = held<JsonValue::Array>(list, "participants");
    if (!participant || !number || !names || *participant >= static_cast<double>(names->size())) return numbered;
    const auto* who = std::get_if<std::string>(&(*names)[static_cast<std::size_t>(*participant)].data);
    return std::string(name.element) + " of " + cleaned(who ? *who : "?") + ", " + std::string(name.number) + ' ' +
           brief(*number);
}

/// "box of A, node 3, extents"; what is deeper in an element is one.
std::string place_words(const std::string& place, const JsonValue& golden) {
    std::vector<std::string> tokens = tokens_of(place);
    std::string out;
    const JsonValue* at = &golden;
    const auto add = [&out](const std::string& words) { out += (out.empty() ? "" : ", ") + words; };
    std::size_t next = 0;
    if (const auto* several = std::get_if<JsonValue::Array>(&at->data); several && !tokens.empty()) {
        const int index = parse_int(tokens[0]).value_or(0);
        add("picture " + std::to_string(index + 1));
        at = &(*several)[static_cast<std::size_t>(index)];
        next = 1;
    }
    for (int named_keys = 0; next < tokens.size() && named_keys < 2; ++next, ++named_keys) {
        const std::string& key = tokens[next];
        const auto* object = std::get_if<JsonValue::Object>(&at->data);
        const JsonValue* list = object ? find(*object, key) : nullptr;
        const auto name = std::ranges::find(kElementNames, key, &ElementName::list);
        const auto* elements = list ? std::get_if<JsonValue::Array>(&list->data) : nullptr;
        const std::optional<int> index =
            next + 1 < tokens.size() && elements ? parse_int(tokens[next + 1]) : std::nullopt;
        if (name == kElementNames.end() || !index) {
            add(key);
            if (!list) break;
            at = list;
            continue;
        }
        at = &(*elements)[static_cast<std::size_t>(*index)];
        add(element_words(*name, *at, static_cast<std::size_t>(*index), *object));
        ++next;
    }
    return out.empty() ? "the whole" : out;
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

std::optional<std::string> first_difference(std::string_view actual, const std::string& actual_name,
                                            std::string_view golden, const std::string& golden_name) {
    Differences differences(1);
    differences.compare("", parse_json(actual, actual_name), parse_json(golden, golden_name), false);
    if (differences.found().empty()) return std::nullopt;
    const Difference& first = differences.found().front();
    return named(first.place) + ": " + first.what;
}

std::vector<std::string> differences_in_words(std::string_view actual, const std::string& actual_name,
                                              std::string_view golden, const std::string& golden_name,
                                              std::size_t most) {
    constexpr std::size_t kLookedAt = 10'000;  // a list that is another one differs all over
    const JsonValue golden_value = parse_json(golden, golden_name);
    Differences differences(kLookedAt);
    differences.compare("", parse_json(actual, actual_name), golden_value, false);
    std::vector<std::string> out;
    std::string last;
    std::size_t places = 0;
    for (const Difference& difference : differences.found()) {
        const std::string place = place_words(difference.place, golden_value);
        // Of the numbers of one thing the first says enough.
        if (place == last) continue;
        // It follows from where the camera is.
        if (places > 0 && difference.place.find("/clip_from_world") != std::string::npos) continue;
        last = place;
        if (++places <= most) out.push_back(place + ": " + difference.what);
    }
    if (places > most)
        out.push_back("and " + std::to_string(places - most) + (differences.full() ? " or more" : "") + " more");
    return out;
}

}  // namespace mobbscope
