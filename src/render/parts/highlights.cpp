#include <base/text.h>
#include <mobb/traversal.h>
#include <render/drawlist/cut.h>
#include <render/drawlist/pen.h>
#include <render/parts/highlights.h>
#include <render/parts/node_boxes.h>
#include <scene/crowd_scene.h>

#include <algorithm>
#include <array>
#include <optional>
#include <span>
#include <stdexcept>
#include <utility>
#include <vector>

namespace mobbscope {

namespace {

using Role = HighlightLine::Role;
using Points = std::vector<glm::vec3>;

constexpr int kRingSides = 48;
constexpr int kMostWayPoints = 1000;
constexpr float kGroundOpacity = 0.75f;
constexpr float kGroundBeyond = 2;  // pixels at scale 1 that the ground line is wider
constexpr std::size_t kMostListedAgents = 8;
// Of the boxes above a node: each is fainter than the one below it.
constexpr float kParentOpacity = 0.85f;
constexpr float kFainterAbove = 0.75f;
constexpr float kLeastAncestorOpacity = 0.2f;
constexpr float kAncestorWidth = 1;        // pixels at scale 1
constexpr Dash kAncestorDash{4, 4, 4, 4};  // likewise

struct HighlightStyle {
    Rgba color{1};
    float width = 1;  ///< pixels at scale 1
};

HighlightStyle highlight_style(Role role, const Palette& palette) {
    switch (role) {
        case Role::selection:
            return {palette.text, 2};
        case Role::hover:
            return {palette.text, 1};
        case Role::candidate:
            return {palette.accent, 3.5f};
        case Role::conflict:
            return {palette.hit, 2.5f};
        case Role::measure:
            return {palette.accent, 2};
        case Role::ghost:
        case Role::ancestor:
            break;
    }
    return {palette.quiet_text, 1.2f};
}

/// The outline of a sample's disk at a height that is a time.
Points disk_outline(const DrawnSpace& space, const mobb::Disk& disk, double time) {
    Points out;
    for (int i = 0; i <= kRingSides; ++i) {
        const glm::dvec2 rim = glm::dvec2(disk.x, disk.y) + disk.r * on_circle<double>(i, kRingSides);
        out.push_back(space.point(rim.x, rim.y, time));
    }
    return out;
}

/// Of what is seen of the disk; empty: nothing is.
Points outline_at_half_height(const DrawList& list, const mobb::PlacedClip& clip, int sample) {
    double begin = clip.time(sample), end = clip.time(sample + 1);
    if (list.slab) {
        const auto height = [&](double t) { return list.space.point(0, 0, t).z; };
        if (!list.slab->shows(height(begin), height(end))) return {};
        begin = std::max(begin, list.space.place({0, 0, list.slab->low}).z);
        end = std::min(end, list.space.place({0, 0, list.slab->high}).z);
    }
    const double time = 0.5 * (begin + end);
    return disk_outline(list.space, mobb::swept(clip, sample).at(time), time);
}

/// Of what is seen of a path.
std::vector<Points> outlines_of_ends(const DrawList& list, const mobb::PlacedClip& clip) {
    int first = 0, last = clip.count() - 1;
    if (list.slab) {
        const auto sample_at = [&](float height) {
            const double time = list.space.place({0, 0, height}).z;
            return std::min(mobb::first_ending_after(clip, 0, clip.count(), time), last);
        };
        first = sample_at(list.slab->low);
        last = sample_at(list.slab->high);
    }
    return {outline_at_half_height(list, clip, first), outline_at_half_height(list, clip, last)};
}

/// Of what is seen of the box.
std::vector<Points> box_edges(const DrawList& list, const BoxInstance& box) {
    if (!is_seen(list.slab, box)) return {};
    const bool cut = list.slab && is_cut(*list.slab, box);
    const auto corners = box_corners(box);
    std::vector<Points> out;
    for (const auto& [a, b] : kBoxEdges) {
        glm::vec3 from = corners[a], to = corners[b];
        if (!cut || cut_line(*list.slab, from, to)) out.push_back({from, to});
    }
    if (!cut) return out;
    for (const float height : {list.slab->low, list.slab->high}) {
        Points section = level_section(box, height);
        if (section.empty()) continue;
        section.push_back(section.front());
        out.push_back(std::move(section));
    }
    return out;
}

Points centres(const DrawList& list, const mobb::PlacedClip& way) {
    const int stride = (way.count() - 1) / kMostWayPoints + 1;
    Points out;
    const auto add = [&](int sample) {
        const mobb::Disk disk = way.disk(sample);
        out.push_back(list.space.point(disk.x, disk.y, list.moment ? 0 : way.time(sample)));
    };
    for (int i = 0; i < way.count() - 1; i += stride) add(i);
    add(way.count() - 1);
    return out;
}

/// "'A', 'B' and 3 more".
std::string names_of(std::span<const DrawnAgent> agents) {
    std::string out;
    const std::size_t named = std::min(agents.size(), kMostListedAgents);
    for (std::size_t i = 0; i < named; ++i) out += (i == 0 ? "" : ", ") + in_quotes(agents[i].name);
    return agents.size() > named ? out + " and " + std::to_string(agents.size() - named) + " more" : out;
}

const DrawnAgent& agent_named(std::span<const DrawnAgent> agents, const std::string& name) {
    const auto found = std::ranges::find(agents, name, &DrawnAgent::name);
    if (found == agents.end()) {
        throw std::invalid_argument("the picture is not of an agent " + in_quotes(name) + ": it is of " +
                                    names_of(agents));
    }
    return *found;
}

void check_part(const DrawnAgent& agent, const AgentPart& part) {
    if (part.kind == AgentPart::Kind::path) return;
    const bool node = part.kind == AgentPart::Kind::node;
    const std::size_t count =
        node ? agent.placed.tree().nodes().size() : static_cast<std::size_t>(agent.clip().count());
    if (part.index >= 0 && static_cast<std::size_t>(part.index) < count) return;
    throw std::invalid_argument(in_quotes(agent.name) + " has no " + (node ? "node " : "sample ") +
                                std::to_string(part.index) + ": give 0 to " + std::to_string(count - 1));
}

struct PartName {
    AgentPart::Kind kind;
    std::string_view text;
};
constexpr std::array<PartName, 2> kPartNames{{{AgentPart::Kind::node, "node"}, {AgentPart::Kind::sample, "sample"}}};
constexpr std::string_view kPathSuffix = ":path";

}  // namespace

void add_highlight_lines(DrawList& list, std::span<const Points> lines, Role role, float scale) {
    const HighlightStyle style = highlight_style(role, list.palette);
    const auto add = [&](Rgba color, float width) {
        for (const Points& points : lines) {
            for (std::size_t i = 1; i < points.size(); ++i) {
                list.highlights.push_back({role, points[i - 1], points[i], color, width * scale});
            }
        }
    };
    add(with_alpha(list.palette.background, kGroundOpacity), style.width + kGroundBeyond);
    add(style.color, style.width);
}

bool add_highlight(DrawList& list, const DrawnAgent& agent, const AgentPart& part, Role role, float scale) {
    const auto add = [&](const std::vector<Points>& lines) { add_highlight_lines(list, lines, role, scale); };
    if (list.moment) {
        const std::optional<int> then =
            part.kind == AgentPart::Kind::sample ? part.index : sample_at(agent, *list.moment);
        // A node is no thing of one moment.
        if (!then || part.kind == AgentPart::Kind::node) return false;
        for (const mobb::PlacedClip& path : agent.paths())
            add({disk_outline(list.space, mobb::swept(path, *then).at(*list.moment), 0)});
    } else if (part.kind == AgentPart::Kind::node) {
        add(box_edges(list, node_box(agent, part.index, list.space)));
    } else {
        for (const mobb::PlacedClip& path : agent.paths()) {
            part.kind == AgentPart::Kind::sample ? add({outline_at_half_height(list, path, part.index)})
                                                 : add(outlines_of_ends(list, path));
        }
    }
    return true;
}

void add_ancestors(DrawList& list, const DrawnAgent& agent, int node, float scale) {
    std::erase_if(list.highlights, [](const HighlightLine& line) { return line.role == Role::ancestor; });
    if (list.moment) return;
    const mobb::Tree& tree = agent.placed.tree();
    float opacity = kParentOpacity;
    for (int above = tree.parent(node); above >= 0; above = tree.parent(above)) {
        const Rgba color = with_alpha(list.palette.text, std::max(opacity, kLeastAncestorOpacity));
        for (const Points& edge : box_edges(list, node_box(agent, above, list.space)))
            list.highlights.push_back(
                {Role::ancestor, edge.front(), edge.back(), color, kAncestorWidth * scale, kAncestorDash * scale});
        opacity *= kFainterAbove;
    }
}

void add_ancestors_of_part(DrawList& list, std::span<const DrawnAgent> agents, const ViewState& view, float scale) {
    if (!view.ancestors) return;
    for (const DrawnAgent& agent : agents) {
        if (agent.subtree && agent.is_whole()) add_ancestors(list, agent, *agent.subtree, scale);
    }
}

void add_way_highlight(DrawList& list, const mobb::PlacedClip& way, Role role, float scale) {
    add_highlight_lines(list, std::array{centres(list, way)}, role, scale);
}

void add_ghost(DrawList& list, const mobb::PlacedClip& before, float scale) {
    std::vector<Points> lines = outlines_of_ends(list, before);
    lines.push_back(centres(list, before));
    add_highlight_lines(list, lines, Role::ghost, scale);
}

NamedPart parse_named_part(std::string_view text) {
    if (text.empty()) throw std::invalid_argument("give AGENT, AGENT:path, AGENT:node:N or AGENT:sample:N");
    if (text.ends_with(kPathSuffix)) return {std::string(text.substr(0, text.size() - kPathSuffix.size())), {}};
    const std::size_t last = text.rfind(':');
    if (last != std::string_view::npos) {
        const std::optional<int> index = parse_int(text.substr(last + 1));
        const std::string_view before = text.substr(0, last);
        for (const auto& [kind, name] : kPartNames) {
            const std::string suffix = ":" + std::string(name);
            if (!index || !before.ends_with(suffix)) continue;
            return {std::string(before.substr(0, before.size() - suffix.size())), {kind, *index}};
        }
    }
    return {std::string(text), {}};
}

std::string text_of(const NamedPart& named) {
    for (const auto& [kind, name] : kPartNames) {
        if (named.part.kind != kind) continue;
        return named.agent + ":" + std::string(name) + ":" + std::to_string(named.part.index);
    }
    return parse_named_part(named.agent) == named ? named.agent : named.agent + std::string(kPathSuffix);
}

void add_selection(DrawList& list, const FittedScene& fitted, const ViewState& view, const NamedPart& named,
                   float scale) {
    if (is_run(fitted.scene())) return add_selection(list, fitted_at(fitted, view), view, named, scale);
    std::vector<DrawnAgent> agents = drawn_agents(fitted, view);
    const bool of_one = view.projection && !list.moment && !fitted.scene().crowd;
    if (of_one) agents = {agents.at(static_cast<std::size_t>(view.projection->agent))};
    const DrawnAgent& agent = agent_named(agents, named.agent);
    check_part(agent, named.part);
    if (agent.hidden) throw std::invalid_argument(in_quotes(named.agent) + " is hidden: leave it out of --hide");
    if (list.moment && named.part.kind == AgentPart::Kind::node) {
        throw std::invalid_argument("a node is not shown in the picture of a moment: leave out --show");
    }
    if (view.ancestors && !of_one && named.part.kind == AgentPart::Kind::node)
        add_ancestors(list, agent, named.part.index, scale);
    if (!add_highlight(list, agent, named.part, Role::selection, scale)) {
        throw std::invalid_argument(in_quotes(named.agent) + " is not there at " + brief(*list.moment) + " s");
    }
}

}  // namespace mobbscope
