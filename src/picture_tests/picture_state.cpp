#include <base/json_writer.h>
#include <base/random.h>
#include <base/text.h>
#include <explain/query_progress.h>
#include <explain/query_sentence.h>
#include <picture_tests/picture_state.h>
#include <scene/crowd_scene.h>
#include <scene/drawn_agent.h>
#include <scene/scene_json.h>
#include <scene/view_options.h>

#include <imgui.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <sstream>
#include <string_view>
#include <type_traits>

namespace mobbscope::picture_tests {

namespace {

/// Where the order of drawing is that of a list.
CounterRandom at(std::size_t index) { return CounterRandom(0, 0, index); }
CounterRandom at(const DrawOrder& order) {
    return CounterRandom(static_cast<std::uint64_t>(order.layer), static_cast<std::uint64_t>(order.level),
                         static_cast<std::uint64_t>(order.index));
}

using Numbers = std::vector<double>;

/// Of numbers and vectors.
template <class... Values>
Numbers numbers(const Values&... values) {
    Numbers out;
    const auto add = [&](const auto& value) {
        if constexpr (std::is_arithmetic_v<std::remove_cvref_t<decltype(value)>>) {
            out.push_back(std::abs(double{value}));
        } else {
            for (int i = 0; i < value.length(); ++i) out.push_back(std::abs(double{value[i]}));
        }
    };
    (add(values), ...);
    return out;
}

std::string sum_text(std::uint64_t digest) { return formatted("%016llx", static_cast<unsigned long long>(digest)); }

/// To nine significant digits.
double rounded(double value) { return parse_double(formatted("%.8e", value)).value_or(0); }

/// Elements of one kind.
struct Part {
    std::int64_t count = 0;
    std::uint64_t digest = 0;  ///< of what they stand for
    double places = 0, sizes = 0, colors = 0, order = 0;

    /// `weights`: of its place in the order of drawing.
    void add(CounterRandom weights, std::string_view stands_for, const Numbers& of_place, const Numbers& of_size = {},
             const Numbers& of_color = {}) {
        ++count;
        std::uint64_t hash = 14695981039346656037u;  // FNV-1a
        for (const char c : stands_for) hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211u;
        digest += hash;
        const auto sum = [&](double& to, const Numbers& values) {
            for (const double value : values) {
                to += value;
                order += (1 + weights.unit()) * value;
            }
        };
        sum(places, of_place);
        sum(sizes, of_size);
        sum(colors, of_color);
    }
};

/// Of lines, by DrawLayer.
constexpr std::array<std::string_view, 11> kLayers{
    "the floor and the axes", "nodes",    "the subject", "", "", "", "candidates", "",
    "the time cursor",        "findings", "rings"};

std::map<std::string, Part> parts_of(const DrawList& list) {
    std::map<std::string, Part> parts;
    const auto part = [&](std::string_view what, std::string_view of) -> Part& {
        return parts[std::string(what) + std::string(of)];
    };
    const auto agent = [&](const ObjectId& id) { return list.agents[static_cast<std::size_t>(id.agent)]; };
    for (const DiskInstance& disk : list.disks) {
        part("disks of ", agent(disk.id))
            .add(at(disk.order), std::to_string(disk.id.index), numbers(disk.base, disk.top),
                 numbers(disk.radius, disk.top_radius), numbers(disk.color));
    }
    for (const BoxInstance& box : list.boxes) {
        const std::string level = ", level " + std::to_string(box.order.level);
        (box.pickable ? part("boxes of ", agent(box.id) + level) : part("sheets", ""))
            .add(at(box.order),
                 formatted("%d %d %d", box.pickable ? box.id.index : 0, static_cast<int>(box.state), box.triangle),
                 numbers(box.center), numbers(box.extents[0], box.extents[1], box.extents[2], box.width, box.dash),
                 numbers(box.fill, box.edge));
    }
    const auto add_line = [](Part& to, CounterRandom weights, const auto& line, const auto&... more) {
        to.add(weights, "", numbers(line.from, line.to), numbers(line.width, line.dash, more...), numbers(line.color));
    };
    const auto add_panel = [](Part& to, CounterRandom weights, const OverlayPanel& panel) {
        to.add(weights, "", numbers(panel.rect.min, panel.rect.max), numbers(panel.radius, panel.border_width),
               numbers(panel.fill, panel.border));
    };
    for (const LineInstance& line : list.lines) {
        const std::string_view layer = kLayers[static_cast<std::size_t>(line.order.layer)];
        add_line(part("lines of ", layer), at(line.order), line, line.hidden, line.cap);
    }
    std::size_t next = 0;
    for (const HighlightLine& line : list.highlights) add_line(part("lines of ", name(line.role)), at(next++), line);
    for (const OverlayPanel& panel : list.panels) add_panel(part("panels", ""), at(next++), panel);
    for (const OverlayLine& line : list.overlay_lines) add_line(part("lines over the scene", ""), at(next++), line);
    for (const OverlayPanel& mark : list.marks) add_panel(part("marks", ""), at(next++), mark);
    for (const TextRun& text : list.texts) {
        part("texts of ", name(text.role))
            .add(at(next++), std::to_string(static_cast<int>(text.face)), numbers(text.baseline), numbers(text.size),
                 numbers(text.color));
    }
    part("background", "").add(at(next), "", {}, {}, numbers(list.background.value_or(list.palette.background)));
    return parts;
}

void write_drawn(JsonWriter& json, const DrawList& list) {
    std::map<std::string_view, std::vector<std::string>> words;
    if (!list.headline.empty()) words["headline"].push_back(list.headline);
    for (const TextRun& text : list.texts) words[name(text.role)].push_back(text.text);
    json.begin_object("words");
    for (const auto& [role, texts] : words) json.values(role, texts);
    json.end_object();
    json.begin_object("drawn");
    for (const auto& [what, part] : parts_of(list)) {
        json.key(what);
        json.row("count", part.count, "digest", sum_text(part.digest), "places", rounded(part.places), "sizes",
                 rounded(part.sizes), "colors", rounded(part.colors), "order", rounded(part.order));
    }
    json.end_object();
}

void write_agent(JsonWriter& json, const DrawnAgent& agent) {
    const mobb::Placement& placement = agent.clip().placement();
    const mobb::Clip& clip = agent.clip().clip();
    const mobb::Tree& tree = agent.placed.tree();
    Part samples, nodes;
    for (const mobb::Disk& disk : clip.samples())
        samples.add(at(static_cast<std::size_t>(samples.count)), "", numbers(disk.x, disk.y, disk.r));
    for (const mobb::Node& node : tree.nodes()) {
        const mobb::Box box = tree.box(static_cast<int>(nodes.count));
        nodes.add(at(static_cast<std::size_t>(nodes.count)),
                  formatted("%d %d %d", node.first, node.count, static_cast<int>(box.kind)),
                  numbers(box.center, box.half, box.axes[0], box.axes[1], box.axes[2], box.drift));
    }
    json.begin_object(JsonWriter::Layout::row);
    json.members("name", agent.name, "translate", placement.translate, "rotate_deg", placement.rotate_deg, "start",
                 placement.start);
    json.key("clip");
    json.row("samples", samples.count, "dt", clip.dt(), "motion", mobb::name(clip.motion()), "sum",
             rounded(samples.order));
    json.key("tree");
    json.row("nodes", nodes.count, "digest", sum_text(nodes.digest), "sum", rounded(nodes.order));
    json.end_object();
}

void write_query(JsonWriter& json, const FittedScene& fitted, const ViewState& view,
                 const std::vector<DrawnAgent>& sides) {
    json.key("query");
    if (!view.query) return json.null();
    const auto recorded = fitted.recorded(static_cast<std::size_t>(*view.query));
    const int step = event_of(view.step, recorded->trace, fitted, *view.query);
    json.row("a", sides[0].name, "b", sides[1].name, "step", step, "sentence",
             step_sentence(sides, recorded->trace, step));
}

void write_panel_state(JsonWriter& json, const PicturePanel& panel, const DrawList& list) {
    const FittedScene& all = *panel.fitted;
    const FittedScene fitted = is_run(all.scene()) ? fitted_at(all, panel.view) : all;
    const std::vector<DrawnAgent> agents = drawn_agents(fitted, panel.view);
    ViewState seen_from;
    seen_from.camera = list.camera;
    seen_from.time_height = list.space.time_height;
    json.begin_object();
    if (!panel.title.empty()) json.member("title", panel.title);
    json.member("size", glm::ivec2(list.size.width, list.size.height));
    json.list("agents", agents, [&](const DrawnAgent& agent) { write_agent(json, agent); });
    json.key("fit");
    write_fit(json, fitted.options());
    json.key("view");
    write_view(json, panel.view);
    write_query(json, fitted, panel.view, agents);
    json.key("camera");
    write_view(json, seen_from);
    write_drawn(json, list);
    json.end_object();
}

}  // namespace

std::string picture_state(const Shot& shot, const std::vector<DrawList>& lists) {
    std::ostringstream text;
    JsonWriter json(text);
    json.begin_object();
    json.member("mobbscope_state", kStateVersion);
    json.begin_array("panels");
    for (std::size_t i = 0; i < lists.size(); ++i) write_panel_state(json, shot.panels[i], lists[i]);
    json.end_array();
    json.end_object();
    return std::move(text).str();
}

std::string window_state(const std::string& panels) {
    return "{\"mobbscope_state\": " + std::to_string(kStateVersion) +
           ", \"imgui\": \"" IMGUI_VERSION "\", \"panels\": [\n" + panels + "]}\n";
}

}  // namespace mobbscope::picture_tests
