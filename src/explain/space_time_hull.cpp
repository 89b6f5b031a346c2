#include <explain/axis_intervals.h>
#include <explain/space_time_hull.h>
#include <mobb/query.h>

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <ranges>
#include <span>
#include <utility>

namespace mobbscope {

namespace {

/// The first sample of [first, end) that begins at a time or later, or end.
int first_beginning_at(const mobb::PlacedClip& clip, int first, int end, double time) {
    const auto samples = std::views::iota(first, end);
    return *std::ranges::partition_point(samples, [&](int i) { return clip.time(i) < time; });
}

/// Up to four points of the difference of two bodies.
struct Simplex {
    std::array<glm::dvec3, 4> points{};
    std::size_t count = 0;

    void add(glm::dvec3 point) { points[count++] = point; }
};

/// A part of a simplex, with its point that is nearest to the origin.
struct Nearest {
    glm::dvec3 point{0};
    double squared = std::numeric_limits<double>::infinity();
    Simplex part;

    /// The nearest point of all that these span, if it lies between them.
    void offer(std::span<const glm::dvec3> points) {
        glm::dvec3 at = points[0];
        if (points.size() == 2) {
            const glm::dvec3 edge = points[1] - points[0];
            const double squared_length = glm::dot(edge, edge);
            const double s = squared_length > 0 ? -glm::dot(points[0], edge) / squared_length : -1;
            if (s <= 0 || s >= 1) return;
            at = points[0] + s * edge;
        }
        if (points.size() == 3) {
            const glm::dvec3 p = points[1] - points[0], q = points[2] - points[0];
            const double pp = glm::dot(p, p), pq = glm::dot(p, q), qq = glm::dot(q, q);
            const double determinant = pp * qq - pq * pq;
            if (determinant <= 0) return;
            const double op = -glm::dot(points[0], p), oq = -glm::dot(points[0], q);
            const double s = (op * qq - oq * pq) / determinant, t = (oq * pp - op * pq) / determinant;
            if (s <= 0 || t <= 0 || s + t >= 1) return;
            at = points[0] + s * p + t * q;
        }
        const double length = glm::dot(at, at);
        if (length >= squared) return;
        point = at;
        squared = length;
        part.count = 0;
        for (const glm::dvec3& p : points) part.add(p);
    }
};

double orientation(glm::dvec3 a, glm::dvec3 b, glm::dvec3 c, glm::dvec3 d) {
    return glm::dot(b - a, glm::cross(c - a, d - a));
}

bool holds_origin(const std::array<glm::dvec3, 4>& p) {
    const glm::dvec3 o(0);
    const double whole = orientation(p[0], p[1], p[2], p[3]);
    const auto same = [&](double part) { return whole > 0 ? part >= 0 : whole < 0 && part <= 0; };
    return same(orientation(o, p[1], p[2], p[3])) && same(orientation(p[0], o, p[2], p[3])) &&
           same(orientation(p[0], p[1], o, p[3])) && same(orientation(p[0], p[1], p[2], o));
}

/// The nearest of the corners, edges, triangles: each is small enough to look at all. Within a tetrahedron: the origin.
Nearest nearest_of(const Simplex& simplex) {
    Nearest out;
    if (simplex.count == 4 && holds_origin(simplex.points)) {
        out.squared = 0;
        return out;
    }
    for (unsigned set = 1; set < 1u << simplex.count; ++set) {
        std::array<glm::dvec3, 4> chosen{};
        std::size_t count = 0;
        for (std::size_t i = 0; i < simplex.count; ++i) {
            if ((set >> i & 1u) != 0) chosen[count++] = simplex.points[i];
        }
        if (count < 4) out.offer(std::span(chosen).first(count));
    }
    return out;
}

std::optional<SeparatingLine> line_across_axes(const SpaceTimeHull& a, const SpaceTimeHull& b, double least_gap) {
    std::optional<SeparatingLine> best;
    for (const glm::dvec2 u : {glm::dvec2(1, 0), glm::dvec2(-1, 0), glm::dvec2(0, 1), glm::dvec2(0, -1)}) {
        const glm::dvec3 along(u, 0);
        const double gap = glm::dot(along, b.furthest(-along) - a.furthest(along));
        if (gap > least_gap && (!best || gap > best->gap)) best = {u, 0, gap};
    }
    return best;
}

}  // namespace

HullOfDisks::HullOfDisks(const mobb::PlacedTree& tree, int node, mobb::Interval time, glm::dvec3 origin)
    : tree_(tree), node_(node), time_(time), origin_(origin) {
    const mobb::PlacedClip& clip = tree.placed_clip();
    const mobb::Node& n = tree.node(node);
    // Of the samples at its ends, those that are present for a moment only meet nobody.
    first_ = mobb::first_ending_after(clip, n.first, n.end(), time.t0 + mobb::kMinOverlap);
    end_ = first_beginning_at(clip, first_, n.end(), time.t1 - mobb::kMinOverlap);
}

/// Of one direction, in the clip's own frame but for where that stands.
struct HullOfDisks::Search {
    const HullOfDisks& hull;
    const mobb::PlacedClip& clip;
    glm::dvec2 u;  ///< in the clip's frame
    double along_time;
    double of_disk;  ///< how far a disk of radius 1 reaches
    double best = -std::numeric_limits<double>::infinity();
    mobb::Disk disk{};
    double time = 0;

    static constexpr int kFew = 24;  ///< disks that are looked at sooner than the boxes around them

    void look_at(const mobb::Disk& d, double t) {
        const double reach = u.x * d.x + u.y * d.y + of_disk * d.r + along_time * t;
        if (reach <= best) return;
        best = reach;
        disk = d;
        time = t;
    }
    void look_at_samples(int first, int end) {
        const mobb::Disk* samples = clip.stored().disks;
        const bool linear = clip.is_linear();
        for (int i = first; i < end; ++i) {
            const double begin = clip.time(i), until = clip.time(i + 1);
            if (!linear) {
                const double t = along_time > 0 ? std::min(until, hull.time_.t1) : std::max(begin, hull.time_.t0);
                look_at(samples[i], t - hull.origin_.z);
                continue;
            }
            const mobb::Disk& to = samples[std::min(i + 1, clip.count() - 1)];
            const mobb::SweptDisk swept{samples[i], to, begin, until};
            for (const double t : {std::max(begin, hull.time_.t0), std::min(until, hull.time_.t1)})
                look_at(swept.at(t), t - hull.origin_.z);
        }
        hull.visits_ += end - first;
    }
    /// No disk below a node reaches further.
    double bound(int node) const {
        const mobb::Box box = hull.tree_.tree().box(node);
        const double scale = hull.tree_.time_scale();
        const Projection reach = project(box, {u.x, u.y, along_time / scale});
        return reach.max + along_time * (clip.frame().start - hull.origin_.z);
    }
    void look_below(int node) {
        const mobb::Tree& tree = hull.tree_.tree();
        const mobb::Node& n = tree.node(node);
        const int first = std::max(n.first, hull.first_), end = std::min(n.end(), hull.end_);
        if (first >= end) return;
        if (end - first <= kFew || tree.is_leaf(node)) return look_at_samples(first, end);
        auto [first_child, last_child] = tree.children(node);
        if (tree.blocks()) {
            for (int child = first_child; child <= last_child; ++child) look_within(child, bound(child));
            return;
        }
        const double reach_of_first = bound(first_child), reach_of_last = bound(last_child);
        if (reach_of_first >= reach_of_last) {
            look_within(first_child, reach_of_first);
            look_within(last_child, reach_of_last);
        } else {
            look_within(last_child, reach_of_last);
            look_within(first_child, reach_of_first);
        }
    }
    void look_within(int node, double reach) {
        ++hull.visits_;
        if (reach > best) look_below(node);
    }
};

glm::dvec3 HullOfDisks::furthest(glm::dvec3 direction) const {
    const mobb::PlacedClip& clip = tree_.placed_clip();
    const glm::dvec2 floor(direction);
    const double length = glm::length(floor);
    Search search{*this, clip, clip.rotation().inverse()(floor), direction.z, length};
    search.look_below(node_);
    const mobb::Disk placed = mobb::placed(search.disk, clip.rotation(), clip.frame().translate - glm::dvec2(origin_));
    const glm::dvec2 edge = length > 0 ? floor * (placed.r / length) : glm::dvec2(0);
    return {placed.x + edge.x, placed.y + edge.y, search.time};
}

glm::dvec3 HullOfPoints::furthest(glm::dvec3 direction) const {
    return *std::ranges::max_element(points_, {}, [&](glm::dvec3 p) { return glm::dot(p, direction); });
}

std::optional<SeparatingLine> line_between(const SpaceTimeHull& a, const SpaceTimeHull& b, Lines lines,
                                           double steepness, double least_gap) {
    if (a.empty() || b.empty()) return std::nullopt;
    if (lines == Lines::axes) return line_across_axes(a, b, least_gap);
    // Time in metres; not at all for lines that stand still.
    const double scale = lines == Lines::moving ? steepness : 0;
    const auto furthest = [&](glm::dvec3 v) {
        const glm::dvec3 direction(v.x, v.y, v.z * scale);
        glm::dvec3 out = a.furthest(direction) - b.furthest(-direction);
        out.z *= scale;
        return out;
    };
    constexpr int kMostSteps = 64;
    constexpr double kNearEnough = 1e-4;  // of the distance
    Simplex simplex;
    simplex.add(furthest({1, 0, 0}));
    glm::dvec3 v = simplex.points[0];
    std::optional<SeparatingLine> best;
    for (int i = 0; i < kMostSteps; ++i) {
        const double squared = glm::dot(v, v);
        if (squared <= least_gap * least_gap) break;
        const glm::dvec3 w = furthest(-v);
        const double apart = glm::dot(v, w);
        const double floor = glm::length(glm::dvec2(v));
        if (apart > least_gap * floor && floor > 0) {
            const double gap = apart / floor;
            if (!best || gap > best->gap) best = {-glm::dvec2(v) / floor, v.z * scale / floor, gap};
        }
        if (squared - apart <= kNearEnough * squared) break;
        simplex.add(w);
        const Nearest nearest = nearest_of(simplex);
        // No nearer: rounding is all that is left.
        if (nearest.squared <= 0 || nearest.squared >= squared) break;
        simplex = nearest.part;
        v = nearest.point;
    }
    return best;
}

}  // namespace mobbscope
