#include <base/text.h>
#include <mobb/clip.h>
#include <scene/view_options.h>

#include <algorithm>
#include <optional>
#include <stdexcept>

namespace mobbscope {

namespace {

constexpr double kSmallestDistance = 1e-6;  // metres

CameraPreset read_preset(const JsonPlace& place) {
    if (const auto preset = camera_preset(place.string())) return *preset;
    place.fail(in_quotes(place.string()) + " is not a camera; give iso, top, front, side or free");
}

Camera read_camera(const JsonPlace& place) {
    place.allow_only({"preset", "yaw_deg", "pitch_deg", "perspective", "fov_deg", "target", "distance", "shift"});
    Camera camera;
    if (const auto preset = place.find("preset")) camera.preset = read_preset(*preset);
    if (const auto yaw = place.find("yaw_deg")) camera.yaw_deg = yaw->number(-1e9, 1e9);
    if (const auto pitch = place.find("pitch_deg")) camera.pitch_deg = pitch->number(-90, 90);
    if (const auto perspective = place.find("perspective")) camera.perspective = perspective->boolean();
    if (const auto fov = place.find("fov_deg")) camera.fov_deg = fov->number(kLeastFov, kMostFov);
    if (const auto target = place.find("target")) {
        camera.target = target->vector<glm::dvec3>(mobb::kMaxLength, "[x, y, height] in metres");
        camera.distance = place.require("distance").number(kSmallestDistance, mobb::kMaxLength);
        if (const auto shift = place.find("shift")) {
            camera.shift = shift->vector<glm::dvec2>(1, "[right, up] in widths and heights of the picture");
        }
    } else if (const auto distance = place.find("distance")) {
        distance->fail("a distance needs a target; add one, or leave both out and the camera frames the scene");
    } else if (const auto shift = place.find("shift")) {
        shift->fail("a shift needs a target; add one, or leave it out and the camera frames the scene");
    }
    return camera;
}

DiskProjection read_projection(const JsonPlace& place) {
    place.allow_only({"participant", "node", "sample"});
    DiskProjection projection;
    if (const auto agent = place.find("participant")) projection.agent = agent->integer(0, kMaxInt);
    if (const auto node = place.find("node")) projection.node = node->integer(0, kMaxInt);
    if (const auto sample = place.find("sample")) projection.sample = sample->integer(0, kMaxInt);
    return projection;
}

DrawnNode read_drawn_node(const JsonPlace& place) {
    place.allow_only({"participant", "node"});
    return {place.require("participant").integer(0, kMaxInt), place.require("node").integer(0, kMaxInt)};
}

ValueRange read_range(const JsonPlace& place) {
    const auto ends = place.vector<glm::dvec2>(mobb::kMaxTime, "[least, most]");
    if (!(ends.x <= ends.y)) place.fail("the first must not be more than the second");
    return {ends.x, ends.y};
}

/// A whole number, or text that `parse` understands.
template <class Parse>
auto read_number_or_text(const JsonPlace& place, const Parse& parse) {
    try {
        return parse(place.is_number() ? std::to_string(place.integer(0, kMaxInt)) : place.string());
    } catch (const std::invalid_argument& error) {
        place.fail(error.what());
    }
}

void write_camera(JsonWriter& out, const Camera& camera) {
    const Camera standard;
    out.begin_object(JsonWriter::Layout::row);
    out.member("preset", name(camera.preset));
    if (camera.yaw_deg != standard.yaw_deg) out.member("yaw_deg", camera.yaw_deg);
    if (camera.pitch_deg != standard.pitch_deg) out.member("pitch_deg", camera.pitch_deg);
    if (camera.perspective != standard.perspective) out.member("perspective", camera.perspective);
    if (camera.fov_deg != standard.fov_deg) out.member("fov_deg", camera.fov_deg);
    if (camera.target) {
        out.member("target", {camera.target->x, camera.target->y, camera.target->z});
        out.member("distance", camera.distance);
        if (camera.shift != standard.shift) out.member("shift", {camera.shift.x, camera.shift.y});
    }
    out.end_object();
}

void write_projection(JsonWriter& out, const DiskProjection& projection) {
    out.begin_object(JsonWriter::Layout::row);
    out.member("participant", projection.agent);
    out.member("node", projection.node);
    out.member("sample", projection.sample);
    out.end_object();
}

// --- the rows

/// "Shows the upright scale in seconds."
std::string doc_of(const std::string& verb, std::string_view what) {
    return verb + ' ' + lower(what.substr(0, 1)) + std::string(what.substr(1)) + '.';
}

/// A row about a member of the view that is no toggle and no choice; the caller says how it is read and written.
template <auto member>
ViewOption field(ViewOption row) {
    row.schema = R"({"description": ")" + std::string(row.what) + "\", " + row.schema + '}';
    row.same = [](const ViewState& a, const ViewState& b) { return a.*member == b.*member; };
    row.copy = [](const ViewState& from, ViewState& to) { to.*member = from.*member; };
    return row;
}

/// A row about what stands in files, as on the command line, as a text or a whole number that `read` understands.
template <auto member, auto read>
ViewOption text_or_number(ViewOption row) {
    row.read = [](const JsonPlace& place, ViewState& view) { view.*member = read_number_or_text(place, read); };
    row.write = [](JsonWriter& out, const ViewState& view) { out.value(to_string(view.*member)); };
    row.text = [](const ViewState& view) { return to_string(view.*member); };
    return field<member>(std::move(row));
}

/// A row about a range of numbers, or none; `none`: as the command line calls that.
template <auto member>
ViewOption range(ViewOption row, const char* none) {
    row.schema =
        R"("anyOf": [{"type": "null"}, {"type": "array", "items": {"$ref": "#/$defs/time"}, "minItems": 2, "maxItems": 2}])";
    row.read = [](const JsonPlace& place, ViewState& view) {
        view.*member = place.is_null() ? std::nullopt : std::optional(read_range(place));
    };
    row.write = [](JsonWriter& out, const ViewState& view) {
        view.*member ? out.tuple((view.*member)->least, (view.*member)->most) : out.null();
    };
    row.parse = [](const std::string& text, ViewState& view) { view.*member = parse_value_range(text); };
    row.text = [none](const ViewState& view) { return view.*member ? to_string(*(view.*member)) : std::string(none); };
    return field<member>(std::move(row));
}

/// A row about something that is shown or not.
template <auto member>
ViewOption toggle(ViewOption row) {
    row.toggle = member;
    row.schema = R"("type": "boolean")";
    const std::string key(row.key);
    if (row.command.empty()) row.command = "view." + key;
    std::string word = key;
    std::ranges::replace(word, '_', '-');
    if (row.option.empty()) row.option = "--" + word + ",!--no-" + word;
    row.doc = doc_of("Shows", row.what);
    if (row.menu == "View/Show") row.without = "false";
    row.read = [](const JsonPlace& place, ViewState& view) { view.*member = place.boolean(); };
    row.write = [](JsonWriter& out, const ViewState& view) { out.value(view.*member); };
    row.parse = [](const std::string& text, ViewState& view) { view.*member = text == "true"; };
    row.text = [](const ViewState& view) { return std::string(view.*member ? "true" : "false"); };
    return field<member>(std::move(row));
}

/// A row about one of a few, which `find` finds by name.
template <auto member, auto find>
ViewOption choice(ViewOption row) {
    std::string quoted;
    for (const std::string_view name : row.choices) {
        quoted += (quoted.empty() ? "\"" : ", \"") + std::string(name) + '"';
        row.argument += (row.argument.empty() ? '[' : '|') + std::string(name);
    }
    row.schema = "\"enum\": [" + quoted + ']';
    row.argument += ']';
    row.doc = doc_of("Chooses", row.what);
    row.read = [names = row.choices, refused = row.refused_in_file](const JsonPlace& place, ViewState& view) {
        const auto value = find(place.string());
        if (!value) place.fail(refusal_of(refused, place.string()) + "; give " + either(names));
        view.*member = *value;
    };
    row.write = [](JsonWriter& out, const ViewState& view) { out.value(name(view.*member)); };
    row.parse = [names = row.choices](const std::string& text, ViewState& view) {
        const auto value = find(text);
        if (!value) throw std::invalid_argument(in_quotes(text) + " is not one of " + listed(names));
        view.*member = *value;
    };
    row.text = [](const ViewState& view) { return std::string(name(view.*member)); };
    return field<member>(std::move(row));
}

bool is_nobody(std::string_view text) { return text.empty() || text == kNobody; }

/// A row about a list of agents' names.
template <auto member>
ViewOption name_list(ViewOption row) {
    row.names = member;
    row.schema = R"("type": "array", "items": {"type": "string"})";
    row.placeholder = "NAME...";
    row.read = [](const JsonPlace& place, ViewState& view) {
        (view.*member).clear();
        for (int i = 0; i < place.size(); ++i) (view.*member).push_back(place[i].string());
    };
    row.write = [](JsonWriter& out, const ViewState& view) {
        out.begin_array(JsonWriter::Layout::row);
        for (const std::string& name : view.*member) out.value(name);
        out.end_array();
    };
    row.take_agent = [](const std::string& name, ViewState& view) { (view.*member).push_back(name); };
    row.parse = [](const std::string& text, ViewState& view) {
        is_nobody(text) ? (view.*member).clear() : (view.*member).push_back(text);
    };
    return field<member>(std::move(row));
}

/// Of another figure the same range would mean something else.
ViewOption with_its_own_range(ViewOption row) {
    row.parse = [parse = row.parse](const std::string& text, ViewState& view) {
        const ColorBy before = view.color_by;
        parse(text, view);
        if (view.color_by != before) view.color_range.reset();
    };
    row.read = [read = row.read](const JsonPlace& place, ViewState& view) {
        const ColorBy before = view.color_by;
        read(place, view);
        if (view.color_by != before) view.color_range.reset();
    };
    return row;
}

std::vector<ViewOption> all_view_options() {
    return {
        choice<&ViewState::show, show_from_name>(
            {.key = "show",
             .what = "Stacks and boxes in space-time, the floor at one moment (time), or its plan with the sections of "
                     "boxes",
             .option = "--show",
             .placeholder = "WHAT",
             .choices = {"space-time", "moment", "plan"},
             .refused_in_file = "a picture cannot show {}"}),
        field<&ViewState::camera>(
            {.key = "camera",
             .what = "From where the picture is seen",
             .schema = R"("type": "object",
          "additionalProperties": false,
          "properties": {
            "preset": {"enum": ["iso", "top", "front", "side", "free"]},
            "yaw_deg": {"description": "free: direction from the target to the eye", "$ref": "#/$defs/angle"},
            "pitch_deg": {"description": "free: above the floor", "type": "number", "minimum": -90, "maximum": 90},
            "perspective": {"type": "boolean"},
            "fov_deg": {"description": "Vertical, of the whole picture", "type": "number", "minimum": 0.5, "maximum": 150},
            "target": {"description": "World metres, time drawn as height; without it the camera frames the scene", "type": "array", "items": {"$ref": "#/$defs/length"}, "minItems": 3, "maxItems": 3},
            "distance": {"description": "From the target to the eye", "type": "number", "minimum": 1e-6, "maximum": 1e9},
            "shift": {"description": "How far to the right and upwards of the picture's middle the target is seen, in widths and heights of the picture", "type": "array", "items": {"type": "number", "minimum": -1, "maximum": 1}, "minItems": 2, "maxItems": 2}
          },
          "dependentRequired": {"target": ["distance"], "distance": ["target"], "shift": ["target"]}
        )",
             .read = [](const JsonPlace& place, ViewState& view) { view.camera = read_camera(place); },
             .write = [](JsonWriter& out, const ViewState& view) { write_camera(out, view.camera); }}),
        text_or_number<&ViewState::levels, parse_level_range>(
            {.key = "levels",
             .what = "A level, a range such as 1:3, or leaves",
             .schema =
                 R"("type": ["integer", "string"], "pattern": "^([0-9]+(:[0-9]+)?|leaves)$", "minimum": 0, "maximum": 1000)",
             .option = "--level",
             .placeholder = "LEVELS",
             .parse =
                 [](const std::string& text, ViewState& view) {
                     view.levels = parse_level_range(text);
                     view.query.reset();
                 },
             .needed = [](const ViewState& from,
                          const ViewState& to) { return !to.query && (to.levels != from.levels || from.query); }}),
        field<&ViewState::query>(
            {.key = "query",
             .what = "The query that is drawn instead of levels: its number, from 0",
             .schema = R"("type": ["integer", "null"], "minimum": 0)",
             .option = "--query",
             .placeholder = "K",
             .read =
                 [](const JsonPlace& place, ViewState& view) {
                     view.query = place.is_null() ? std::nullopt : std::optional(place.integer(0, kMaxInt));
                 },
             .write = [](JsonWriter& out, const ViewState& view) { view.query ? out.value(*view.query) : out.null(); },
             .parse =
                 [](const std::string& text, ViewState& view) {
                     const std::optional<int> index = parse_int(text);
                     if (!index || *index < 0) {
                         throw std::invalid_argument(in_quotes(text) + " is not a query: give its number, from 0");
                     }
                     view.query = *index;
                 },
             .text = [](const ViewState& view) { return std::to_string(*view.query); }}),
        text_or_number<&ViewState::step, parse_step>(
            {.key = "step",
             .what =
                 "Step of the query: an event number, a percentage such as 40%, end, hit, leaf:3 (the third; likewise "
                 "separated, overlap, avoidable) or depth:4",
             .schema = R"("type": ["integer", "string"],
          "pattern": "^([0-9]+|[+]?([0-9]+[.]?[0-9]*|[.][0-9]+)([eE][+-]?[0-9]+)?%|end|(separated|overlap|hit|avoidable|leaf)(:0*[1-9][0-9]*)?|depth:[0-9]+)$",
          "minimum": 0,
          "maximum": 2147483647
        )",
             .option = "--step",
             .placeholder = "STEP",
             .parse = [](const std::string& text, ViewState& view) { view.step = parse_step(text); },
             .needed = [](const ViewState& from, const ViewState& to) { return to.query && to.step != from.step; }}),
        field<&ViewState::projection>(
            {.key = "projection",
             .what = "One disk's extent along the axes of a box, drawn instead of the levels, or none",
             .schema = R"("anyOf": [
            {"type": "null"},
            {
              "type": "object",
              "additionalProperties": false,
              "properties": {
                "participant": {"description": "Index into what is drawn", "type": "integer", "minimum": 0},
                "node": {"type": "integer", "minimum": 0},
                "sample": {"type": "integer", "minimum": 0}
              }
            }
          ]
        )",
             .read =
                 [](const JsonPlace& place, ViewState& view) {
                     view.projection = place.is_null() ? std::nullopt : std::optional(read_projection(place));
                 },
             .write =
                 [](JsonWriter& out, const ViewState& view) {
                     view.projection ? write_projection(out, *view.projection) : out.null();
                 }}),
        field<&ViewState::time>(
            {.key = "time",
             .what = "The time cursor, global seconds, or none",
             .schema = R"("anyOf": [{"$ref": "#/$defs/time"}, {"type": "null"}])",
             .option = "--time",
             .placeholder = "T",
             .read =
                 [](const JsonPlace& place, ViewState& view) {
                     view.time =
                         place.is_null() ? std::nullopt : std::optional(place.number(-mobb::kMaxTime, mobb::kMaxTime));
                 },
             .write = [](JsonWriter& out, const ViewState& view) { view.time ? out.value(*view.time) : out.null(); },
             .parse =
                 [](const std::string& text, ViewState& view) {
                     view.time.reset();
                     if (text != "none") view.time = parse_number_within(text, -mobb::kMaxTime, mobb::kMaxTime);
                 },
             .text = [](const ViewState& view) { return view.time ? format_double(*view.time) : "none"; }}),
        field<&ViewState::time_window>(
            {.key = "time_window",
             .what = "Of a crowd's run: seconds before and after the time that space-time shows (2)",
             .schema = R"("type": "number", "minimum": 0.1, "maximum": 60)",
             .option = "--time-window",
             .placeholder = "S",
             .read = [](const JsonPlace& place,
                        ViewState& view) { view.time_window = place.number(kLeastTimeWindow, kMostTimeWindow); },
             .write = [](JsonWriter& out, const ViewState& view) { out.value(view.time_window); },
             .parse =
                 [](const std::string& text, ViewState& view) {
                     view.time_window = parse_number_within(text, kLeastTimeWindow, kMostTimeWindow);
                 },
             .text = [](const ViewState& view) { return format_double(view.time_window); }}),
        field<&ViewState::follow>(
            {.key = "follow",
             .what = "The agent that the camera goes along with, 5 m around it unless there is a target; of a run with "
                     "its last choice; or none",
             .schema = R"("type": ["string", "null"])",
             .option = "--follow",
             .placeholder = "AGENT",
             .read = [](const JsonPlace& place,
                        ViewState& view) { view.follow = place.is_null() ? "" : place.string(); },
             .write = [](JsonWriter& out, const ViewState& view) { out.value(view.follow); },
             .parse = [](const std::string& text,
                         ViewState& view) { view.follow = is_nobody(text) ? std::string() : text; },
             .take_agent = [](const std::string& name, ViewState& view) { view.follow = name; },
             .text = [](const ViewState& view) { return view.follow; }}),
        name_list<&ViewState::hidden>(
            {.key = "hidden",
             .what = "Agents, or clips where there are none, that are left out of the picture, not of answers; or none",
             .option = "--hide"}),
        name_list<&ViewState::pinned>(
            {.key = "pinned",
             .what = "Agents that stay when another is shown alone, and keep their colour where others dim; or none",
             .option = "--pin"}),
        name_list<&ViewState::foreground>(
            {.key = "foreground",
             .what = "Agents that are drawn whole and named, not with a query: of all others that are not pinned an "
                     "outline is left; or none",
             .option = "--foreground"}),
        choice<&ViewState::arrange, arrange_from_name>(
            {.key = "arrange",
             .what = "Where agents or clips are drawn, not of a run or a query: none (where they are) or grid (apart, "
                     "with names); queries are asked where they are",
             .option = "--arrange",
             .placeholder = "HOW",
             .command = "view.arrange",
             .title = "Lay out in a grid",
             .menu = "View/Agents",
             .choices = {"none", "grid"},
             .refused_in_file = "agents cannot be arranged as {}",
             .refused_in_window = "agents cannot be arranged as {}"}),
        field<&ViewState::time_height>(
            {.key = "time_height",
             .what = "Metres drawn per second; 0, the default, or auto: as tall as wide",
             .schema = R"("type": "number", "minimum": 0, "maximum": 1e6)",
             .option = "--time-height",
             .placeholder = "M",
             .read = [](const JsonPlace& place,
                        ViewState& view) { view.time_height = place.number(0, kMostTimeHeight); },
             .write = [](JsonWriter& out, const ViewState& view) { out.value(view.time_height); },
             .parse =
                 [](const std::string& text, ViewState& view) {
                     view.time_height =
                         text == "auto" ? 0 : parse_number_within(text, kLeastTimeHeight, kMostTimeHeight);
                 },
             .text =
                 [](const ViewState& view) {
                     return view.time_height > 0 ? format_double(view.time_height) : "auto";
                 }}),
        with_its_own_range(choice<&ViewState::color_by, color_by_from_name>(
            {.key = "color_by",
             .what = "What the colour of boxes says: agent (whose they are), level, or another figure of their node",
             .option = "--color-by",
             .placeholder = "WHAT",
             .command = "view.color_by",
             .title = "Colour boxes by",
             .menu = "View",
             .shortcut = "C",
             .also = "heatmap color waste worst loose tight histogram volume",
             .choices = {"agent", "level", "volume", "empty", "waste", "fill", "floor", "overhang", "share", "tests",
                         "avoidable"},
             .choice_titles = {"agent", "level", "volume", "empty space", "wasted space", "fill", "area on the floor",
                               "overhang in time", "part of the cost", "tests", "avoidable overlaps"},
             .refused_in_file = "boxes cannot be coloured by {}",
             .refused_in_window = "colours cannot be by {}"})),
        range<&ViewState::color_range>(
            {.key = "color_range",
             .what = "The figures at both ends of the colours, of parts in per cent, where boxes are coloured by one: "
                     "what is outside steps back; or auto",
             .option = "--color-range",
             .placeholder = "LEAST:MOST"},
            "auto"),
        range<&ViewState::slab>({.key = "slab",
                                 .what = "From when to when it is shown, global seconds: what is outside is cut away; "
                                         "or none",
                                 .option = "--slab",
                                 .placeholder = "T0:T1"},
                                "none"),
        field<&ViewState::subtree>(
            {.key = "subtree",
             .what = "A node of an agent's tree: only its box and those below are drawn of that agent, or none",
             .schema = R"("anyOf": [
            {"type": "null"},
            {
              "type": "object",
              "additionalProperties": false,
              "required": ["participant", "node"],
              "properties": {
                "participant": {"description": "Index into what is drawn", "type": "integer", "minimum": 0},
                "node": {"type": "integer", "minimum": 0}
              }
            }
          ]
        )",
             .read =
                 [](const JsonPlace& place, ViewState& view) {
                     view.subtree = place.is_null() ? std::nullopt : std::optional(read_drawn_node(place));
                 },
             .write =
                 [](JsonWriter& out, const ViewState& view) {
                     if (!view.subtree) return out.null();
                     out.row("participant", view.subtree->agent, "node", view.subtree->node);
                 }}),
        choice<&ViewState::theme, theme_from_name>({.key = "theme",
                                                    .what = "The colours of the window and its pictures: dark or light",
                                                    .option = "--theme",
                                                    .placeholder = "NAME",
                                                    .command = "view.theme",
                                                    .title = "Theme",
                                                    .menu = "View",
                                                    .shortcut = "T",
                                                    .also = "dark light mode night appearance settings preferences",
                                                    .choices = {"dark", "light"},
                                                    .refused_in_file = "{} is not a theme",
                                                    .refused_in_window = "a theme cannot be {}"}),
        choice<&ViewState::past, past_from_name>(
            {.key = "past",
             .what = "What a query shows beside the pair under test: nothing (pair), the pairs that called it "
                     "(ancestors), those that its parent called before it too (siblings), or all that were tested "
                     "before",
             .option = "--past",
             .placeholder = "WHICH",
             .short_form = {"--pair-only", "pair"},
             .former_toggle = {"tested_before", "all", "pair"},
             .command = "view.past",
             .title = "Past tests",
             .without = "pair",
             .may_be_seen = [](const ViewState& view) { return view.query.has_value(); },
             .choices = {"pair", "ancestors", "siblings", "all"},
             .choice_titles = {"Only the pair under test", "+ ancestors", "+ siblings", "All"},
             .refused_in_file = "{} is not a choice of past tests",
             .refused_in_window = "past tests cannot be {}"}),
        toggle<&ViewState::candidates>(
            {.key = "candidates",
             .what = "The moves that the followed agent could choose, and what became of each",
             .command = "crowd.candidates",
             .title = "Candidates",
             .menu = "Go/Crowd",
             .shortcut = "A",
             .draws = DrawnPart::surroundings,
             .without = "false",
             .may_be_seen = [](const ViewState& view) { return !view.follow.empty(); }}),
        toggle<&ViewState::disks>(
            {.key = "disks",
             .what = "The samples: a disk for as long as it holds; at a moment those on the floor",
             .title = "Disks",
             .menu = "View/Show",
             .shortcut = "D",
             .at_hand = true}),
        toggle<&ViewState::boxes>({.key = "boxes",
                                   .what = "The boxes of the trees; at a moment the walls of the cylinders",
                                   .title = "Boxes",
                                   .menu = "View/Show",
                                   .shortcut = "B",
                                   .at_hand = true}),
        toggle<&ViewState::heat>({.key = "heat",
                                  .what = "The disks in the colour of how many tests of boxes hold them",
                                  .title = "Heat of tests on the disks",
                                  .menu = "View/Show",
                                  .also = "heatmap map hot cost",
                                  .draws = DrawnPart::colors,
                                  .may_be_seen = [](const ViewState& view) { return view.disks && !view.query; }}),
        toggle<&ViewState::cut_boxes>(
            {.key = "cut_boxes",
             .what = "Where a slab in time is shown, boxes cut at its planes; else they stay whole",
             .title = "Cut boxes at the slab",
             .menu = "View/Slab",
             .draws = DrawnPart::surroundings,
             .may_be_seen = [](const ViewState& view) { return view.boxes && view.slab.has_value(); }}),
        toggle<&ViewState::slice>({.key = "slice",
                                   .what = "At the time cursor, the cross-sections of boxes on its plane",
                                   .title = "Sections at the time cursor",
                                   .menu = "View/Show",
                                   .also = "slice cut plane cross",
                                   .draws = DrawnPart::surroundings,
                                   .may_be_seen = [](const ViewState& view) { return view.time.has_value(); }}),
        toggle<&ViewState::ancestors>({.key = "ancestors",
                                       .what = "The boxes above the selected node, as ghosts",
                                       .title = "Ancestors",
                                       .menu = "View/Show",
                                       .also = "parents ghosts",
                                       .draws = DrawnPart::surroundings}),
        toggle<&ViewState::frame_boxes>({.key = "frame_boxes",
                                         .what = "The boxes too, where the camera frames the scene",
                                         .title = "Frame boxes too",
                                         .menu = "View/Camera",
                                         .also = "fit bounds",
                                         .draws = DrawnPart::surroundings}),
        toggle<&ViewState::proof>({.key = "proof",
                                   .what = "The lines that keep the two of a query apart: as walls at its last step, "
                                           "of a miss in place of the pair tested last, and at an overlap that is "
                                           "avoidable; at a moment on the floor",
                                   .title = "Proof",
                                   .menu = "View/Show",
                                   .draws = DrawnPart::surroundings,
                                   .may_be_seen = [](const ViewState& view) { return view.query.has_value(); }}),
        toggle<&ViewState::free_region>(
            {.key = "free_region",
             .what = "With the proof of a miss: the region of the floor where the second one may start and never "
                     "meets the first",
             .title = "Free region",
             .menu = "View/Show",
             .draws = DrawnPart::surroundings,
             .may_be_seen = [](const ViewState& view) { return view.query && view.show == Show::space_time; }}),
        toggle<&ViewState::floor>({.key = "floor",
                                   .what = "The grid in metres with the paths' traces on it",
                                   .title = "Floor",
                                   .menu = "View/Show",
                                   .shortcut = "G",
                                   .at_hand = true,
                                   .draws = DrawnPart::surroundings}),
        toggle<&ViewState::boundary>(
            {.key = "boundary",
             .what = "With a query, on the floor: the line within which B's path may not begin, or the two collide",
             .title = "Collision boundary",
             .menu = "View/Show",
             .draws = DrawnPart::surroundings,
             .may_be_seen =
                 [](const ViewState& view) { return view.query.has_value() && view.show == Show::space_time; }}),
        toggle<&ViewState::cost>(
            {.key = "cost",
             .what = "In the caption: the tests of boxes that a query of these trees makes in standard placements",
             .title = "Cost in the caption",
             .menu = "View/Show",
             .draws = DrawnPart::words,
             .may_be_seen = [](const ViewState& view) { return view.boxes && !view.query; }}),
        toggle<&ViewState::time_axis>({.key = "time_axis",
                                       .what = "The upright scale in seconds",
                                       .title = "Time axis",
                                       .menu = "View/Show",
                                       .shortcut = "X",
                                       .draws = DrawnPart::surroundings}),
        toggle<&ViewState::labels>({.key = "labels",
                                    .what = "All text in the picture",
                                    .title = "Labels",
                                    .menu = "View/Show",
                                    .shortcut = "L",
                                    .at_hand = true,
                                    .draws = DrawnPart::words}),
        toggle<&ViewState::caption>({.key = "caption",
                                     .what = "The sentences at the top of the picture",
                                     .title = "Caption",
                                     .menu = "View/Show",
                                     .draws = DrawnPart::words}),
        toggle<&ViewState::legend>({.key = "legend",
                                    .what = "What colours and lines stand for",
                                    .title = "Legend",
                                    .menu = "View/Show",
                                    .shortcut = "K",
                                    .at_hand = true,
                                    .draws = DrawnPart::words}),
        toggle<&ViewState::inset>(
            {.key = "inset",
             .what = "The small picture of the floor at the time cursor, in the corner",
             .title = "Floor inset",
             .menu = "View/Show",
             .draws = DrawnPart::words,
             .may_be_seen =
                 [](const ViewState& view) { return view.time.has_value() && view.show == Show::space_time; }}),
        toggle<&ViewState::fold_caption>({.key = "fold_caption",
                                          .what = "The sentences at the top as one short line",
                                          .option = "--fold-caption,!--unfold-caption",
                                          .title = "Fold the caption",
                                          .menu = "View/Overlays",
                                          .draws = DrawnPart::words}),
        toggle<&ViewState::fold_legend>({.key = "fold_legend",
                                         .what = "The legend as its header alone",
                                         .option = "--fold-legend,!--unfold-legend",
                                         .title = "Fold the legend",
                                         .menu = "View/Overlays",
                                         .draws = DrawnPart::words}),
        toggle<&ViewState::fold_inset>({.key = "fold_inset",
                                        .what = "The small picture of the floor as its header alone",
                                        .option = "--fold-inset,!--unfold-inset",
                                        .title = "Fold the floor inset",
                                        .menu = "View/Overlays",
                                        .draws = DrawnPart::words}),
        toggle<&ViewState::whole_legend>({.key = "whole_legend",
                                          .what = "All rows of the legend, not only the first six",
                                          .option = "--whole-legend,!--short-legend",
                                          .title = "Whole legend",
                                          .menu = "View/Overlays",
                                          .draws = DrawnPart::words}),
    };
}

}  // namespace

std::span<const ViewOption> view_options() {
    static const std::vector<ViewOption> table = all_view_options();
    return table;
}

const ViewOption& view_option(std::string_view key) {
    return *std::ranges::find(view_options(), key, &ViewOption::key);
}

bool can_leave_out(const ViewOption& option, const ViewState& view) {
    if (option.without.empty() || (option.may_be_seen && !option.may_be_seen(view))) return false;
    return option.text(view) != option.without;
}

namespace {

bool is_called_nobody(const std::vector<std::string>& agents) {
    return std::ranges::find(agents, kNobody) != agents.end();
}

}  // namespace

void parse_option(const ViewOption& option, const std::string& text, const std::vector<std::string>& agents,
                  ViewState& view) {
    const bool is_name = option.take_agent && text == kNobody && is_called_nobody(agents);
    is_name ? option.take_agent(text, view) : option.parse(text, view);
}

std::string in_command_line(const ViewOption& option, const ViewState& view, const std::vector<std::string>& agents) {
    if (option.take_agent) {
        std::vector<std::string> names = option.names ? view.*option.names : std::vector{option.text(view)};
        std::erase(names, "");
        if (names.empty()) names.emplace_back(is_called_nobody(agents) ? "" : kNobody);
        std::string out = ' ' + std::string(option.option);
        for (const std::string& name : names) out += ' ' + shell_word(name);
        return out;
    }
    if (!option.toggle) return ' ' + std::string(option.option) + ' ' + shell_word(option.text(view));
    const std::size_t off = option.option.find(",!");
    return ' ' + std::string(view.*option.toggle ? option.option.substr(0, off) : option.option.substr(off + 2));
}

std::string refusal_of(std::string_view refused, std::string_view text) {
    return std::string(refused).replace(refused.find("{}"), 2, in_quotes(text));
}

ViewState read_view(const JsonPlace& place, ViewState view) {
    std::vector<std::string_view> keys;
    for (const ViewOption& option : view_options()) {
        keys.push_back(option.key);
        if (!option.former_toggle.key.empty()) keys.push_back(option.former_toggle.key);
    }
    place.allow_only(keys);
    for (const ViewOption& option : view_options()) {
        const auto value = place.find(option.key);
        if (value) option.read(*value, view);
        const FormerToggle& former = option.former_toggle;
        const auto old = former.key.empty() ? std::nullopt : place.find(former.key);
        if (!old) continue;
        if (value) old->fail("says the same as " + in_quotes(option.key) + " in an older way; leave it out");
        option.parse(std::string(old->boolean() ? former.on : former.off), view);
    }
    return view;
}

void write_view(JsonWriter& out, const ViewState& view) {
    out.begin_object();
    for (const ViewOption& option : view_options()) {
        if (option.same(view, ViewState{})) continue;
        out.key(option.key);
        option.write(out, view);
    }
    out.end_object();
}

}  // namespace mobbscope
