#include <render/drawlist/cut.h>
#include <render/drawlist/pick.h>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace mobbscope {

namespace {

/// By how much the shader of faces draws them nearer, in OpenGL's normalised depth.
constexpr double kFacesNearer = 4e-4;

/// Surfaces no farther apart than this in normalised depth are equally deep; what is drawn first wins.
constexpr double kEquallyDeep = 1e-6;

/// Of a box whose edges in one direction have no length: so much of the longest, to have an inside.
constexpr double kThin = 1e-9;

/// The part of a line inside a convex shape, as distances along it; empty if enter > leave.
struct Span {
    double enter = -std::numeric_limits<double>::infinity();
    double leave = std::numeric_limits<double>::infinity();

    /// Keeps what is between two parallel planes: where |at + t * rate| <= half.
    void clip(double at, double rate, double half) {
        if (rate == 0) {
            if (std::abs(at) > half) leave = -std::numeric_limits<double>::infinity();
            return;
        }
        const double a = (-half - at) / rate;
        const double b = (half - at) / rate;
        enter = std::max(enter, std::min(a, b));
        leave = std::min(leave, std::max(a, b));
    }
    bool empty() const { return !(enter <= leave); }
};

/// Where |at + t * rate| <= r + t * growth, of a span in which the right side is nowhere below 0.
Span within(glm::dvec2 at, glm::dvec2 rate, double r, double growth, Span span) {
    const double a = glm::dot(rate, rate) - growth * growth;
    const double b = 2 * (glm::dot(at, rate) - r * growth);
    const double c = glm::dot(at, at) - r * r;
    const double square = b * b - 4 * a * c;
    if (a >= 0 && square < 0) return {1, 0};
    const double root = std::sqrt(std::max(square, 0.0));
    // The two roots without cancellation: the one at which the left side falls below the right one, then the other.
    const double q = b > 0 ? -b - root : -b + root;
    if (q == 0) return a > 0 || c > 0 ? Span{1, 0} : span;
    const double falling = b > 0 ? q / (2 * a) : 2 * c / q;
    const double rising = b > 0 ? 2 * c / q : q / (2 * a);
    // A circle that grows faster than the point leaves it holds all that comes after; one that shrinks so, all before.
    if (a >= 0 || growth > 0) span.enter = std::max(span.enter, falling);
    if (a >= 0 || growth < 0) span.leave = std::min(span.leave, rising);
    return span;
}

/// Distances along the ray count from where it comes nearest to the disk's middle, which loses no digits far away.
Span inside(const DiskInstance& disk, const Ray& ray) {
    const glm::dvec3 up = glm::dvec3(disk.top) - glm::dvec3(disk.base);
    const glm::dvec3 to_middle = glm::dvec3(disk.base) + 0.5 * up - ray.origin;
    const double nearest = glm::dot(to_middle, ray.direction);
    const glm::dvec3 from = ray.direction * nearest - to_middle;
    const double reach = 0.5 * glm::length(up) + static_cast<double>(std::max(disk.radius, disk.top_radius));
    const double across_squared = glm::dot(from, from);
    if (across_squared > reach * reach) return {1, 0};
    const double half_chord = std::sqrt(reach * reach - across_squared);
    Span span{-half_chord, half_chord};
    span.clip(from.z, ray.direction.z, 0.5 * up.z);
    if (span.empty()) return {1, 0};
    // In the level plane of each point: against the middle and the radius that the disk has there.
    const double by_height = up.z > 0 ? 1 / up.z : 0;
    const glm::dvec2 lean = glm::dvec2(up) * by_height;
    const double radius = disk.radius;
    const double taper = (static_cast<double>(disk.top_radius) - radius) * by_height;
    span = within(glm::dvec2(from) - lean * from.z, glm::dvec2(ray.direction) - lean * ray.direction.z,
                  radius + taper * (from.z + 0.5 * up.z), taper * ray.direction.z, span);
    return {span.enter + nearest, span.leave + nearest};
}

Span inside(const BoxInstance& box, const Ray& ray) {
    const glm::dvec3 from = ray.origin - glm::dvec3(box.center);
    glm::dmat3 edges(box.extents[0], box.extents[1], box.extents[2]);
    // Most boxes are missed by a wide margin.
    const double reach = glm::length(edges[0]) + glm::length(edges[1]) + glm::length(edges[2]);
    const glm::dvec3 aside = from - ray.direction * glm::dot(from, ray.direction);
    if (glm::dot(aside, aside) > reach * reach) return {1, 0};
    for (int i = 0; i < 3; ++i) {
        if (edges[i] != glm::dvec3(0)) continue;
        const glm::dvec3 normal = glm::cross(edges[(i + 1) % 3], edges[(i + 2) % 3]);
        // A box without an area has no faces.
        if (normal == glm::dvec3(0)) return {1, 0};
        edges[i] = glm::normalize(normal) * (kThin * reach);
    }
    const glm::dmat3 to_local = glm::inverse(edges);
    const glm::dvec3 at = to_local * from;
    const glm::dvec3 rate = to_local * ray.direction;
    Span span;
    for (int i = 0; i < 3; ++i) span.clip(at[i], rate[i], 1);
    return span;
}

struct Found {
    Pick pick;
    double normalised_depth = 0;
    DrawOrder order;
};

/// Nearer surfaces first; equally deep ones as they are drawn, disks before boxes.
std::vector<Pick> pick_order(std::vector<Found> found) {
    std::sort(found.begin(), found.end(),
              [](const Found& a, const Found& b) { return a.normalised_depth < b.normalised_depth; });
    const auto drawn_before = [](const Found& a, const Found& b) {
        if (a.pick.id.kind != b.pick.id.kind) return a.pick.id.kind == ObjectId::Kind::disk;
        return a.order < b.order;
    };
    for (auto first = found.begin(); first != found.end();) {
        auto end = first + 1;
        while (end != found.end() && end->normalised_depth - (end - 1)->normalised_depth <= kEquallyDeep) ++end;
        std::sort(first, end, drawn_before);
        first = end;
    }
    std::vector<Pick> out;
    out.reserve(found.size());
    for (const Found& one : found) out.push_back(one.pick);
    return out;
}

}  // namespace

std::vector<Pick> pick(const DrawList& list, glm::vec2 pixel) {
    const ViewProjection& projection = list.projection;
    const Ray ray = projection.ray(pixel);
    const double near_depth = projection.near_depth;
    const double far_depth = projection.far_depth;
    // Depth grows by `ahead` with each metre along the line of sight.
    const double ahead = -glm::dot(ray.direction, glm::dvec3(projection.back));
    const double depth_at_origin = glm::dot(glm::dvec3(projection.eye) - ray.origin, glm::dvec3(projection.back));
    const double nearest = (near_depth - depth_at_origin) / ahead;
    const auto normalised = [&](double depth) {
        const double range = far_depth - near_depth;
        const double sum = far_depth + near_depth;
        return projection.perspective ? (sum - 2 * far_depth * near_depth / depth) / range : (2 * depth - sum) / range;
    };
    std::vector<Found> found;
    const auto add = [&](ObjectId id, DrawOrder order, double distance, double nearer) {
        const double depth = depth_at_origin + ahead * distance;
        found.push_back(
            {{id, list.space.place(ray.at(distance)), static_cast<float>(depth)}, normalised(depth) - nearer, order});
    };
    const std::optional<DrawnSlab>& slab = list.slab;
    const auto keep_in_slab = [&](Span& span) {
        const double middle = 0.5 * (static_cast<double>(slab->low) + static_cast<double>(slab->high));
        span.clip(ray.origin.z - middle, ray.direction.z, static_cast<double>(slab->high) - middle);
    };
    for (const DiskInstance& disk : list.disks) {
        if (slab && !slab->shows(disk.base.z, disk.top.z)) continue;
        Span span = inside(disk, ray);
        if (slab) keep_in_slab(span);
        // From inside a disk nothing of it is drawn.
        if (span.empty() || span.enter < nearest) continue;
        const double depth = projection.perspective ? depth_at_origin + ahead * span.enter : 1;
        const double behind = static_cast<double>(agent_depth_step(projection)) * (disk.id.agent % kAgentDepths);
        add(disk.id, disk.order, span.enter, -behind / depth);
    }
    for (const BoxInstance& box : list.boxes) {
        if (!box.pickable || !is_seen(slab, box)) continue;
        Span span = inside(box, ray);
        if (slab && is_cut(*slab, box) && !span.empty()) {
            // Where it is cut it is open: only what is left of its faces is met.
            Span seen = span;
            keep_in_slab(seen);
            if (seen.empty() || (seen.enter > span.enter && seen.leave < span.leave)) continue;
            if (seen.enter > span.enter) span.enter = span.leave;
            if (seen.leave < span.leave) span.leave = span.enter;
        }
        if (span.empty() || span.leave < nearest) continue;
        add(box.id, box.order, span.enter >= nearest ? span.enter : span.leave, kFacesNearer);
    }
    return pick_order(std::move(found));
}

std::optional<glm::dvec2> floor_at(const DrawList& list, glm::vec2 pixel, double time) {
    const Ray ray = list.projection.ray(pixel);
    if (std::abs(ray.direction.z) < 1e-9) return std::nullopt;
    const double height = (time - list.space.origin.z) * list.space.time_height;
    const double distance = (height - ray.origin.z) / ray.direction.z;
    if (list.projection.perspective && distance <= 0) return std::nullopt;
    const glm::dvec3 place = list.space.place(ray.at(distance));
    return glm::dvec2(place);
}

}  // namespace mobbscope
