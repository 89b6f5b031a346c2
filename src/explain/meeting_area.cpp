#include <explain/meeting_area.h>
#include <mobb/separation.h>

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>
#include <numbers>
#include <optional>
#include <span>

namespace mobbscope {

namespace {

using std::numbers::pi;

/// The share of the sums of three numbers, each uniform between minus and plus one of `reach`, that lie within `limit`
/// of `from`. Of the widest it is exact; the two others are taken at three points each (Gauss-Legendre).
double share_within(double from, std::array<double, 3> reach, double limit) {
    for (double& r : reach) r = std::abs(r);
    std::ranges::sort(reach);
    const double widest = reach[2];
    from = std::abs(from);
    const double sum = reach[0] + reach[1] + widest;
    if (from + sum <= limit) return 1;
    if (from - sum >= limit) return 0;
    struct Point {
        double at, weight;
    };
    constexpr std::array<Point, 3> kPoints{
        {{-0.7745966692414834, 5.0 / 18}, {0, 8.0 / 18}, {0.7745966692414834, 5.0 / 18}}};
    constexpr std::array<Point, 1> kMiddle{{{0, 1}}};
    const auto points = [&](double r) {
        return r > 0 ? std::span<const Point>(kPoints) : std::span<const Point>(kMiddle);
    };
    double share = 0;
    for (const Point& i : points(reach[0])) {
        for (const Point& j : points(reach[1])) {
            const double middle = from + i.at * reach[0] + j.at * reach[1];
            const double inside = std::min(middle + widest, limit) - std::max(middle - widest, -limit);
            const double part = std::max(inside, 0.0) / (2 * widest);
            share += i.weight * j.weight * part;
        }
    }
    return share;
}

/// The six half edges of two boxes: their Minkowski sum is the zonotope of these. It is cut into parallelepipeds, one
/// for every three (Shephard 1974).
class Zonotope {
  public:
    Zonotope(const std::array<glm::dvec3, 3>& a, const std::array<glm::dvec3, 3>& b, double heading) {
        const double c = std::cos(heading), s = std::sin(heading);
        for (std::size_t i = 0; i < 3; ++i) {
            edges_[i] = a[i];
            edges_[3 + i] = {c * b[i].x - s * b[i].y, s * b[i].x + c * b[i].y, b[i].z};
        }
        for (std::size_t i = 0; i < kEdges; ++i) {
            for (std::size_t j = i + 1; j < kEdges; ++j) {
                const glm::dvec3 normal = glm::cross(edges_[i], edges_[j]);
                for (std::size_t k = j + 1; k < kEdges; ++k) {
                    const double d = glm::dot(normal, edges_[k]);
                    det_[i][j][k] = det_[j][k][i] = det_[k][i][j] = d;
                    det_[j][i][k] = det_[i][k][j] = det_[k][j][i] = -d;
                }
            }
        }
    }

    /// Of the points whose third coordinate is within `limit` of the middle.
    double volume_within(double limit) const {
        double volume = 0;
        for (std::size_t i = 0; i < kEdges; ++i) {
            for (std::size_t j = i + 1; j < kEdges; ++j) {
                for (std::size_t k = j + 1; k < kEdges; ++k) {
                    const double d = std::abs(det_[i][j][k]);
                    if (d == 0) continue;
                    volume += 8 * d * share_within(middle_of(i, j, k), {edges_[i].z, edges_[j].z, edges_[k].z}, limit);
                }
            }
        }
        return volume;
    }

  private:
    static constexpr std::size_t kEdges = 6;
    /// Any numbers without a relation between them: as heights of the edges in a fourth dimension they choose a cut.
    static constexpr std::array<double, kEdges> kHeights{0.3141, -0.2718, 0.5772, 0.1618, -0.4142, 0.6931};

    /// The third coordinate of the middle of the parallelepiped of three edges: the others are added with the sign of
    /// how high each is above the plane through the three.
    double middle_of(std::size_t i, std::size_t j, std::size_t k) const {
        const double d = det_[i][j][k];
        double middle = 0;
        for (std::size_t l = 0; l < kEdges; ++l) {
            if (l == i || l == j || l == k) continue;
            const double above = kHeights[l] * d - kHeights[i] * det_[l][j][k] - kHeights[j] * det_[i][l][k] -
                                 kHeights[k] * det_[i][j][l];
            middle += (above > 0) == (d > 0) ? edges_[l].z : -edges_[l].z;
        }
        return middle;
    }

    std::array<glm::dvec3, kEdges> edges_;
    std::array<std::array<std::array<double, kEdges>, kEdges>, kEdges> det_;  ///< of three different edges
};

double area_in_space_time(const BoxOutline& a, const BoxOutline& b, int headings, double first_heading) {
    const double limit = a.time_scale * (a.duration + b.duration) / 2;
    double sum = 0;
    for (int i = 0; i < headings; ++i) {
        sum += Zonotope(a.half_edges, b.half_edges, first_heading + 2 * pi * i / headings).volume_within(limit);
    }
    return sum / (headings * 2 * limit);
}

/// Along the axes of A, which stays as it is; B is turned and wrapped again.
double area_along_axes(const BoxOutline& a, const BoxOutline& b) {
    const double sum_a = a.half.x + a.half.y, sum_b = b.half.x + b.half.y;
    return 4 * (a.half.x * a.half.y + sum_a * sum_b * 2 / pi + b.half.x * b.half.y +
                (b.half.x * b.half.x + b.half.y * b.half.y) / pi);
}

}  // namespace

BoxOutline::BoxOutline(const mobb::Tree& tree, int node) : kind(tree.node(node).kind), time_scale(tree.time_scale()) {
    const mobb::Box box = tree.box(node);
    duration = tree.t1(tree.node(node)) - tree.t0(tree.node(node));
    half = {box.half.x, box.half.y};
    area = 4 * half.x * half.y;
    perimeter = 4 * (half.x + half.y);
    speed = duration > 0 ? 2 * glm::length(box.drift) / duration : 0;
    half_edges = mobb::half_edges(box);
}

std::optional<mobb::BoxKind> test_of(const BoxOutline& a, const BoxOutline& b) {
    const auto* const at = std::ranges::find_if(
        mobb::kPairTests, [&](const mobb::PairTest& test) { return test.a == a.kind && test.b == b.kind; });
    if (at == std::end(mobb::kPairTests) || (at->mixes_time && a.time_scale != b.time_scale)) return std::nullopt;
    return at->test;
}

double meeting_area(const BoxOutline& a, const BoxOutline& b, int headings, double first_heading) {
    const double blaschke = a.area + b.area + a.perimeter * b.perimeter / (2 * pi);
    // Of the time that they share, over the starts at which they share some.
    const double mean_common = a.duration * b.duration / (a.duration + b.duration);
    switch (test_of(a, b).value_or(mobb::BoxKind::block)) {
        case mobb::BoxKind::obb2d:
            return blaschke;
        case mobb::BoxKind::moving:
            return blaschke + (a.perimeter + b.perimeter) / pi * std::hypot(a.speed, b.speed) * mean_common;
        case mobb::BoxKind::aabb:
            return area_along_axes(a, b);
        case mobb::BoxKind::obb3d:
            return area_in_space_time(a, b, headings, first_heading);
        case mobb::BoxKind::block:
            break;
    }
    return std::numeric_limits<double>::quiet_NaN();
}

}  // namespace mobbscope
