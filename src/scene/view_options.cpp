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
    place.fail(in_quotes(place.string()) + " is no camera; give iso, top, front, side or free");
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

/// A row about a member of the view that is no toggle and no choice; the caller says how it is read and written.
template <auto member>
ViewOption field(ViewOption row) {
    row.same = [](const ViewState& a, const ViewState& b) { return a.*member == b.*member; };
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

/// A row about something that is shown or not.
template <auto member>
ViewOption toggle(ViewOption row) {
    row.toggle = member;
    if (row.schema.empty()) row.schema = R"({"type": "boolean"})";
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

std::vector<ViewOption> all_view_options() {
    return {
        choice<&ViewState::show, show_from_name>(
            {.key = "show",
             .schema =
                 R"({"description": "Stacks and boxes in space-time, or the floor at the time of `time`", "enum": ["space-time", "moment"]})",
             .option = "--show",
             .placeholder = "WHAT",
             .help = "space-time, or the floor at one moment (--time)",
             .choices = {"space-time", "moment"},
             .refused_in_file = "a picture cannot show {}"}),
        field<&ViewState::camera>(
            {.key = "camera",
             .schema = R"({
          "type": "object",
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
        })",
             .read = [](const JsonPlace& place, ViewState& view) { view.camera = read_camera(place); },
             .write = [](JsonWriter& out, const ViewState& view) { write_camera(out, view.camera); }}),
        text_or_number<&ViewState::levels, parse_level_range>(
            {.key = "levels",
             .schema =
                 R"({"description": "A level, a range such as 1:3, or leaves", "type": ["integer", "string"], "pattern": "^([0-9]+(:[0-9]+)?|leaves)$", "minimum": 0, "maximum": 1000})",
             .option = "--level",
             .placeholder = "LEVELS",
             .help = "Levels: N, A:B or leaves",
             .parse =
                 [](const std::string& text, ViewState& view) {
                     view.levels = parse_level_range(text);
                     view.query.reset();
                 },
             .needed = [](const ViewState& from,
                          const ViewState& to) { return !to.query && (to.levels != from.levels || from.query); }}),
        field<&ViewState::query>(
            {.key = "query",
             .schema =
                 R"({"description": "Index of the query whose state is drawn; null: none", "type": ["integer", "null"], "minimum": 0})",
             .option = "--query",
             .placeholder = "K",
             .help = "A query instead of levels: its number, from 0",
             .read =
                 [](const JsonPlace& place, ViewState& view) {
                     view.query = place.is_null() ? std::nullopt : std::optional(place.integer(0, kMaxInt));
                 },
             .write = [](JsonWriter& out, const ViewState& view) { out.value(*view.query); },
             .parse =
                 [](const std::string& text, ViewState& view) {
                     const std::optional<int> index = parse_int(text);
                     if (!index || *index < 0) {
                         throw std::invalid_argument(in_quotes(text) + " is no query: give its number, from 0");
                     }
                     view.query = *index;
                 },
             .text = [](const ViewState& view) { return std::to_string(*view.query); }}),
        text_or_number<&ViewState::step, parse_step>(
            {.key = "step",
             .schema = R"({
          "description": "An event number, a percentage such as 40%, or end",
          "type": ["integer", "string"],
          "pattern": "^([0-9]+|[+]?([0-9]+[.]?[0-9]*|[.][0-9]+)([eE][+-]?[0-9]+)?%|end)$",
          "minimum": 0,
          "maximum": 2147483647
        })",
             .option = "--step",
             .placeholder = "STEP",
             .help = "Step of the query: an event number, a percentage (40%) or end",
             .parse = [](const std::string& text, ViewState& view) { view.step = parse_step(text); },
             .needed = [](const ViewState& from, const ViewState& to) { return to.query && to.step != from.step; }}),
        field<&ViewState::projection>(
            {.key = "projection",
             .schema = R"({
          "description": "One disk's extent along the axes of a box, drawn instead of the levels; null: none",
          "anyOf": [
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
        })",
             .read =
                 [](const JsonPlace& place, ViewState& view) {
                     view.projection = place.is_null() ? std::nullopt : std::optional(read_projection(place));
                 },
             .write = [](JsonWriter& out, const ViewState& view) { write_projection(out, *view.projection); }}),
        field<&ViewState::time>(
            {.key = "time",
             .schema =
                 R"({"description": "The time cursor, global seconds; null: none", "anyOf": [{"$ref": "#/$defs/time"}, {"type": "null"}]})",
             .option = "--time",
             .placeholder = "T",
             .help = "Time cursor, global seconds, or none",
             .read =
                 [](const JsonPlace& place, ViewState& view) {
                     view.time =
                         place.is_null() ? std::nullopt : std::optional(place.number(-mobb::kMaxTime, mobb::kMaxTime));
                 },
             .write = [](JsonWriter& out, const ViewState& view) { out.value(*view.time); },
             .parse =
                 [](const std::string& text, ViewState& view) {
                     view.time.reset();
                     if (text != "none") view.time = parse_number_within(text, -mobb::kMaxTime, mobb::kMaxTime);
                 },
             .text = [](const ViewState& view) { return view.time ? short_double(*view.time) : "none"; }}),
        field<&ViewState::time_window>(
            {.key = "time_window",
             .schema =
                 R"({"description": "Of a crowd's run: seconds before and after the time that space-time shows", "type": "number", "minimum": 0.1, "maximum": 60})",
             .option = "--time-window",
             .placeholder = "S",
             .help = "Of a crowd's run: seconds before and after the time (2)",
             .read = [](const JsonPlace& place,
                        ViewState& view) { view.time_window = place.number(kLeastTimeWindow, kMostTimeWindow); },
             .write = [](JsonWriter& out, const ViewState& view) { out.value(view.time_window); },
             .parse =
                 [](const std::string& text, ViewState& view) {
                     view.time_window = parse_number_within(text, kLeastTimeWindow, kMostTimeWindow);
                 },
             .text = [](const ViewState& view) { return short_double(view.time_window); }}),
        field<&ViewState::follow>(
            {.key = "follow",
             .schema =
                 R"({"description": "The agent that the camera goes along with, by name; null: nobody", "type": ["string", "null"]})",
             .option = "--follow",
             .placeholder = "AGENT",
             .help = "The agent that the camera goes along with, 5 m around it unless there is a target; of a run with "
                     "its last choice; or none",
             .read = [](const JsonPlace& place,
                        ViewState& view) { view.follow = place.is_null() ? "" : place.string(); },
             .write = [](JsonWriter& out, const ViewState& view) { out.value(view.follow); },
             .parse = [](const std::string& text,
                         ViewState& view) { view.follow = is_nobody(text) ? std::string() : text; },
             .take_agent = [](const std::string& name, ViewState& view) { view.follow = name; },
             .text = [](const ViewState& view) { return view.follow; }}),
        name_list<&ViewState::hidden>(
            {.key = "hidden",
             .schema =
                 R"({"description": "Agents that are not in the picture, by name; without agents clips. Answers stay", "type": "array", "items": {"type": "string"}})",
             .option = "--hide",
             .placeholder = "NAME...",
             .help = "Agents that are left out of the picture, without agents clips; or none"}),
        name_list<&ViewState::pinned>(
            {.key = "pinned",
             .schema =
                 R"({"description": "Agents that stay in the picture when another is shown alone, and keep their colour", "type": "array", "items": {"type": "string"}})",
             .option = "--pin",
             .placeholder = "NAME...",
             .help = "Agents that keep their colour where others dim; or none"}),
        choice<&ViewState::arrange, arrange_from_name>(
            {.key = "arrange",
             .schema =
                 R"({"description": "grid: agents or clips are drawn apart from one another, whatever their places; not of a run or a query", "enum": ["none", "grid"]})",
             .option = "--arrange",
             .placeholder = "HOW",
             .help = "Where agents are drawn: none (where they are) or grid (apart, with names)",
             .command = "view.arrange",
             .title = "Lay out in a grid",
             .menu = "View/Agents",
             .doc =
                 "Draws agents, or clips, apart from one another with their names; queries are asked where they are.",
             .argument = "[none|grid]",
             .choices = {"none", "grid"},
             .refused_in_file = "agents cannot be arranged as {}",
             .refused_in_window = "agents cannot be arranged as {}"}),
        field<&ViewState::time_height>(
            {.key = "time_height",
             .schema =
                 R"({"description": "Metres drawn per second; 0: chosen to suit", "type": "number", "minimum": 0, "maximum": 1e6})",
             .option = "--time-height",
             .placeholder = "M",
             .help = "Metres drawn per second; default: auto, as tall as wide",
             .read = [](const JsonPlace& place,
                        ViewState& view) { view.time_height = place.number(0, kMostTimeHeight); },
             .write = [](JsonWriter& out, const ViewState& view) { out.value(view.time_height); },
             .parse =
                 [](const std::string& text, ViewState& view) {
                     view.time_height =
                         text == "auto" ? 0 : parse_number_within(text, kLeastTimeHeight, kMostTimeHeight);
                 },
             .text =
                 [](const ViewState& view) { return view.time_height > 0 ? short_double(view.time_height) : "auto"; }}),
        choice<&ViewState::color_by, color_by_from_name>(
            {.key = "color_by",
             .schema = R"({"description": "What the colour of a level's boxes says", "enum": ["agent", "level"]})",
             .option = "--color-by",
             .placeholder = "WHAT",
             .help = "What the colour of boxes says: agent or level",
             .command = "view.color_by",
             .title = "Colour boxes by",
             .menu = "View",
             .shortcut = "C",
             .doc = "Colours the boxes of levels by whose they are, or by their level.",
             .argument = "[agent|level]",
             .choices = {"agent", "level"},
             .refused_in_file = "boxes cannot be coloured by {}",
             .refused_in_window = "colours cannot be by {}"}),
        choice<&ViewState::theme, theme_from_name>(
            {.key = "theme",
             .schema = R"({"enum": ["dark", "light"]})",
             .option = "--theme",
             .placeholder = "NAME",
             .help = "dark or light",
             .command = "view.theme",
             .title = "Theme",
             .menu = "View",
             .shortcut = "T",
             .doc = "Changes between dark and light, for the window and its pictures.",
             .argument = "[dark|light]",
             .choices = {"dark", "light"},
             .refused_in_file = "{} is no theme",
             .refused_in_window = "a theme cannot be {}"}),
        choice<&ViewState::past, past_from_name>(
            {.key = "past",
             .schema =
                 R"({"description": "With a query, what is drawn beside the pair under test: nothing, the pairs that called it, those that its parent called before it too, or every pair tested before", "enum": ["pair", "ancestors", "siblings", "all"]})",
             .option = "--past",
             .placeholder = "WHICH",
             .help =
                 "With a query, the pairs before the step's: pair (none), ancestors, siblings (and ancestors) or all",
             .short_form = {"--pair-only", "pair"},
             .former_toggle = {"tested_before", "all", "pair"},
             .command = "view.past",
             .title = "Past tests",
             .doc =
                 "Shows beside the pair under test the pairs that called it (ancestors), those that its parent called "
                 "before it too (siblings), all that were tested before, or none (pair).",
             .argument = "[pair|ancestors|siblings|all]",
             .without = "pair",
             .may_be_seen = [](const ViewState& view) { return view.query.has_value(); },
             .choices = {"pair", "ancestors", "siblings", "all"},
             .choice_titles = {"Only the pair under test", "+ ancestors", "+ siblings", "All"},
             .refused_in_file = "{} are no past tests",
             .refused_in_window = "past tests cannot be {}"}),
        toggle<&ViewState::candidates>(
            {.key = "candidates",
             .schema =
                 R"({"description": "Of a run's followed agent: the moves of its last choice, and what became of each", "type": "boolean"})",
             .option = "--candidates,!--no-candidates",
             .help = "The moves that the followed agent could choose, and what became of each",
             .command = "crowd.candidates",
             .title = "Candidates",
             .menu = "Go/Crowd",
             .shortcut = "A",
             .doc = "Shows the moves that the followed agent could choose, and what became of each.",
             .draws = DrawnPart::surroundings,
             .without = "false",
             .may_be_seen = [](const ViewState& view) { return !view.follow.empty(); }}),
        toggle<&ViewState::disks>(
            {.key = "disks",
             .option = "--disks,!--no-disks",
             .help = "Disks of samples",
             .command = "view.disks",
             .title = "Disks",
             .menu = "View/Show",
             .shortcut = "D",
             .doc = "Shows the samples: a disk for as long as it holds; at a moment those on the floor.",
             .at_hand = true}),
        toggle<&ViewState::boxes>({.key = "boxes",
                                   .option = "--boxes,!--no-boxes",
                                   .help = "Boxes of nodes",
                                   .command = "view.boxes",
                                   .title = "Boxes",
                                   .menu = "View/Show",
                                   .shortcut = "B",
                                   .doc = "Shows the boxes of the trees; at a moment the walls of the cylinders.",
                                   .at_hand = true}),
        toggle<&ViewState::floor>({.key = "floor",
                                   .option = "--floor,!--no-floor",
                                   .help = "The grid, and the paths' traces on it",
                                   .command = "view.floor",
                                   .title = "Floor",
                                   .menu = "View/Show",
                                   .shortcut = "G",
                                   .doc = "Shows the grid in metres with the paths' traces on it.",
                                   .at_hand = true,
                                   .draws = DrawnPart::surroundings}),
        toggle<&ViewState::time_axis>({.key = "time_axis",
                                       .option = "--time-axis,!--no-time-axis",
                                       .help = "Ticks in seconds",
                                       .command = "view.time_axis",
                                       .title = "Time axis",
                                       .menu = "View/Show",
                                       .shortcut = "X",
                                       .doc = "Shows the upright scale in seconds.",
                                       .draws = DrawnPart::surroundings}),
        toggle<&ViewState::labels>({.key = "labels",
                                    .option = "--labels,!--no-labels",
                                    .help = "All text",
                                    .command = "view.labels",
                                    .title = "Labels",
                                    .menu = "View/Show",
                                    .shortcut = "L",
                                    .doc = "Shows all text in the picture.",
                                    .at_hand = true,
                                    .draws = DrawnPart::words}),
        toggle<&ViewState::caption>({.key = "caption",
                                     .option = "--caption,!--no-caption",
                                     .help = "The sentences at the top",
                                     .command = "view.caption",
                                     .title = "Caption",
                                     .menu = "View/Show",
                                     .doc = "Shows the sentences at the top of the picture.",
                                     .draws = DrawnPart::words}),
        toggle<&ViewState::legend>({.key = "legend",
                                    .option = "--legend,!--no-legend",
                                    .help = "What colours and lines mean",
                                    .command = "view.legend",
                                    .title = "Legend",
                                    .menu = "View/Show",
                                    .shortcut = "K",
                                    .doc = "Shows what colours and lines stand for.",
                                    .at_hand = true,
                                    .draws = DrawnPart::words}),
        toggle<&ViewState::inset>(
            {.key = "inset",
             .option = "--inset,!--no-inset",
             .help = "The small map of the floor",
             .command = "view.inset",
             .title = "Floor inset",
             .menu = "View/Show",
             .doc = "Shows the small picture of the floor at the time cursor, in the corner.",
             .draws = DrawnPart::words,
             .may_be_seen =
                 [](const ViewState& view) { return view.time.has_value() && view.show == Show::space_time; }}),
        toggle<&ViewState::fold_caption>({.key = "fold_caption",
                                          .option = "--fold-caption,!--unfold-caption",
                                          .help = "The caption as one short line",
                                          .command = "view.fold_caption",
                                          .title = "Fold the caption",
                                          .menu = "View/Overlays",
                                          .doc = "Folds the sentences at the top to one short line, or unfolds them.",
                                          .draws = DrawnPart::words}),
        toggle<&ViewState::fold_legend>({.key = "fold_legend",
                                         .option = "--fold-legend,!--unfold-legend",
                                         .help = "The legend as its header alone",
                                         .command = "view.fold_legend",
                                         .title = "Fold the legend",
                                         .menu = "View/Overlays",
                                         .doc = "Folds the legend to its header, or unfolds it.",
                                         .draws = DrawnPart::words}),
        toggle<&ViewState::fold_inset>(
            {.key = "fold_inset",
             .option = "--fold-inset,!--unfold-inset",
             .help = "The floor inset as its header alone",
             .command = "view.fold_inset",
             .title = "Fold the floor inset",
             .menu = "View/Overlays",
             .doc = "Folds the small picture of the floor in the corner to its header, or unfolds it.",
             .draws = DrawnPart::words}),
        toggle<&ViewState::whole_legend>({.key = "whole_legend",
                                          .option = "--whole-legend,!--short-legend",
                                          .help = "All rows of the legend, or six",
                                          .command = "view.whole_legend",
                                          .title = "Whole legend",
                                          .menu = "View/Overlays",
                                          .doc = "Shows all rows of the legend, not only the first six.",
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
