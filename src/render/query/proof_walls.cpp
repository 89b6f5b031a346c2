#include <render/drawlist/pen.h>
#include <render/query/proof_walls.h>

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace mobbscope {

namespace {

constexpr float kLeastRegion = 40;  // pixels across at scale 1: a smaller region has no room for words
constexpr double kHatches = 40;     // lines across the floor's diagonal

/// How a wall looks: one stands out, the others step back.
struct WallStyle {
    float fill = 0.10f, edge = 0.55f, width = 1.2f;
};
constexpr WallStyle kStandsOut{0.24f, 1.0f, 2.2f};

glm::vec3 wall_point(const DrawnSpace& space, const ProofLine& line, double time, double along) {
    const glm::dvec2 at = line.at(time, along);
    return space.point(at.x, at.y, time);
}

void add_wall(DrawList& list, const ProofLine& line, Rgba color, const WallStyle& style, int index, float scale) {
    const auto corner = [&](double time, double along) { return wall_point(list.space, line, time, along); };
    const glm::vec3 corners[4] = {corner(line.t0, line.along.t0), corner(line.t0, line.along.t1),
                                  corner(line.t1, line.along.t1), corner(line.t1, line.along.t0)};
    const DrawOrder order{DrawLayer::findings, 2, 4 * index};
    list.boxes.push_back(annotation_sheet(0.5f * (corners[0] + corners[2]), 0.5f * (corners[1] - corners[0]),
                                          0.5f * (corners[3] - corners[0]), with_alpha(color, style.fill), order));
    Pen pen(list, order);
    pen.path(
        4, [&](int i) { return corners[i % 4]; },
        scaled(
            {.color = with_alpha(color, style.edge), .width = style.width, .hidden = 0.3f, .cap = 0.5f * style.width},
            scale));
}

/// What lies free across a line when the two are nearest: its ends are where neither disk comes while the line holds.
WallGap add_gap(DrawList& list, const ProofLine& line, Rgba color, float scale) {
    const glm::dvec2 middle = line.at(line.nearest, line.nearest_along);
    const glm::dvec2 half = 0.5 * std::max(line.gap, 0.0) * line.direction;
    const glm::dvec2 from = middle - half, to = middle + half;
    Pen(list, {DrawLayer::findings, 3})
        .line(list.space.point(from.x, from.y, line.nearest), list.space.point(to.x, to.y, line.nearest),
              scaled({.color = color, .width = 3, .hidden = 0.6f}, scale));
    return {wall_point(list.space, line, line.nearest, line.nearest_along), line.gap};
}

/// Where a line along `u`, at `at` across it, runs in a convex polygon.
std::optional<mobb::Interval> chord(const std::vector<glm::dvec2>& polygon, glm::dvec2 u, double at) {
    const glm::dvec2 across(-u.y, u.x);
    std::optional<mobb::Interval> out;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const glm::dvec2 from = polygon[i], to = polygon[(i + 1) % polygon.size()];
        const double a = glm::dot(across, from) - at, b = glm::dot(across, to) - at;
        if (a == b || (a < 0) == (b < 0)) continue;
        const double here = glm::dot(u, from + a / (a - b) * (to - from));
        out = out ? mobb::Interval{std::min(out->t0, here), std::max(out->t1, here)} : mobb::Interval{here, here};
    }
    return out;
}

/// The gap of the last line that is drawn.
double widest_drawn(const std::vector<ProofLine>& lines) {
    if (lines.size() <= kMostWalls) return std::numeric_limits<double>::infinity();
    std::vector<double> gaps;
    gaps.reserve(lines.size());
    for (const ProofLine& line : lines) gaps.push_back(line.gap);
    const auto last = gaps.begin() + static_cast<std::ptrdiff_t>(kMostWalls - 1);
    std::ranges::nth_element(gaps, last);
    return *last;
}

}  // namespace

std::vector<WallGap> add_proof_walls(DrawList& list, const QueryProof& proof, std::optional<double> time, float scale) {
    const std::optional<std::size_t> at_time = time ? proof.at(*time) : std::nullopt;
    const std::optional<std::size_t> stands_out = at_time ? at_time : proof.tightest;
    const Rgba color = list.palette.separated;
    std::vector<WallGap> out;
    const double widest = widest_drawn(proof.lines);
    for (std::size_t i = 0; i < proof.lines.size(); ++i) {
        const bool first = i == stands_out;
        if (!first && proof.lines[i].gap > widest) continue;
        add_wall(list, proof.lines[i], color, first ? kStandsOut : WallStyle{}, static_cast<int>(i), scale);
        if (first || i == proof.tightest) out.push_back(add_gap(list, proof.lines[i], color, scale));
    }
    return out;
}

WallGap add_avoidable_wall(DrawList& list, const ProofLine& line, float scale) {
    add_wall(list, line, list.palette.avoidable, kStandsOut, 0, scale);
    return add_gap(list, line, list.palette.avoidable, scale);
}

void add_proof_pane(DrawList& list, const QueryProof& proof, double time, double height, float scale) {
    const std::optional<std::size_t> index = proof.at(time);
    if (!index) return;
    const ProofLine& line = proof.lines[*index];
    const auto corner = [&](double along, double above) {
        const glm::dvec2 at = line.at(time, along);
        return list.space.point(at.x, at.y, above);
    };
    const glm::vec3 corners[4] = {corner(line.along.t0, 0), corner(line.along.t1, 0), corner(line.along.t1, height),
                                  corner(line.along.t0, height)};
    const Rgba color = list.palette.separated;
    const DrawOrder order{DrawLayer::findings, 2};
    list.boxes.push_back(annotation_sheet(0.5f * (corners[0] + corners[2]), 0.5f * (corners[1] - corners[0]),
                                          0.5f * (corners[3] - corners[0]), with_alpha(color, kStandsOut.fill), order));
    Pen pen(list, order);
    pen.line(corners[0], corners[1], scaled({.color = color, .width = 2.4f, .hidden = 0.5f}, scale));
    pen.path(
        3, [&](int i) { return corners[(i + 1) % 4]; },
        scaled({.color = with_alpha(color, 0.5f), .width = 1, .hidden = 0.2f}, scale));
}

std::vector<glm::dvec2> cut_to(std::vector<glm::dvec2> region, glm::dvec2 low, glm::dvec2 high) {
    for (const auto& [u, most] : {std::pair(glm::dvec2(1, 0), high.x), std::pair(glm::dvec2(-1, 0), -low.x),
                                  std::pair(glm::dvec2(0, 1), high.y), std::pair(glm::dvec2(0, -1), -low.y)})
        region = cut_off(region, u, most);
    return region;
}

std::vector<glm::dvec2> region_of_start(const mobb::PlacedClip& b, const Margins& margins) {
    const mobb::Disk first = b.disk(0);
    std::vector<glm::dvec2> out;
    for (const glm::dvec2 shift : margins.free_region) out.push_back(glm::dvec2(first.x, first.y) + shift);
    return out;
}

std::optional<glm::vec3> add_free_region(DrawList& list, const DrawnAgent& b, const Margins& margins,
                                         const FloorExtent& s, float scale) {
    const std::vector<glm::dvec2> region = cut_to(region_of_start(b.clip(), margins), {s.x0, s.y0}, {s.x1, s.y1});
    if (region.size() < 3) return std::nullopt;
    const double time = b.begin();
    const auto drawn = [&](glm::dvec2 at) { return list.space.point(at.x, at.y, time); };
    const Rgba color = list.palette.separated;
    Pen pen(list, {DrawLayer::surroundings, 5});
    const glm::dvec2 along = glm::normalize(glm::dvec2(1, 1)), across(-along.y, along.x);
    const double step = std::hypot(s.x1 - s.x0, s.y1 - s.y0) / kHatches;
    double low = glm::dot(across, region.front()), high = low;
    for (const glm::dvec2 corner : region) {
        low = std::min(low, glm::dot(across, corner));
        high = std::max(high, glm::dot(across, corner));
    }
    for (int line = static_cast<int>(std::ceil(low / step)); line * step < high; ++line) {
        const double at = line * step;
        if (const auto run = chord(region, along, at))
            pen.line(drawn(run->t0 * along + at * across), drawn(run->t1 * along + at * across),
                     scaled({.color = with_alpha(color, 0.22f), .width = 1}, scale));
    }
    const int corners = static_cast<int>(region.size());
    glm::dvec2 middle{0};
    for (const glm::dvec2 corner : region) middle += corner / static_cast<double>(corners);
    pen.path(
        corners, [&](int i) { return drawn(region[static_cast<std::size_t>(i % corners)]); },
        scaled({.color = color, .width = 1.8f, .hidden = 0.4f}, scale));
    const float across_it = static_cast<float>(high - low) * list.projection.pixels_per_metre(drawn(middle));
    if (across_it < kLeastRegion * scale) return std::nullopt;
    return drawn(middle);
}

}  // namespace mobbscope
