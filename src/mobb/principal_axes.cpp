#include <mobb/fitting.h>

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

namespace mobb {

namespace {

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

/// A symmetric 3x3 matrix and the rotation that has been taken out of it.
struct Eigen {
    double m[3][3] = {};
    std::array<glm::dvec3, 3> vectors{glm::dvec3{1, 0, 0}, glm::dvec3{0, 1, 0}, glm::dvec3{0, 0, 1}};
};

/// Jacobi's method: turns rows and columns p, q so that m[p][q] vanishes. Both diagonal entries change by a multiple of
/// m[p][q], which keeps a small one accurate beside a large one.
void eliminate(Eigen& e, int p, int q) {
    const double theta = (e.m[q][q] - e.m[p][p]) / (2 * e.m[p][q]);
    const double t = std::copysign(1 / (std::abs(theta) + std::hypot(theta, 1.0)), theta);
    const double c = 1 / std::hypot(t, 1.0);
    const double s = t * c;
    e.m[p][p] -= t * e.m[p][q];
    e.m[q][q] += t * e.m[p][q];
    e.m[p][q] = e.m[q][p] = 0;
    const int k = 3 - p - q;
    const double mp = e.m[k][p], mq = e.m[k][q];
    e.m[k][p] = e.m[p][k] = c * mp - s * mq;
    e.m[k][q] = e.m[q][k] = s * mp + c * mq;
    glm::dvec3& vp = e.vectors[static_cast<std::size_t>(p)];
    glm::dvec3& vq = e.vectors[static_cast<std::size_t>(q)];
    const glm::dvec3 turned = c * vp - s * vq;
    vq = s * vp + c * vq;
    vp = turned;
}

void diagonalise(Eigen& e) {
    constexpr int kMostSweeps = 32;  // it takes five or six
    for (int sweep = 0; sweep < kMostSweeps; ++sweep) {
        bool done = true;
        for (const auto& [p, q] : {std::pair{0, 1}, std::pair{0, 2}, std::pair{1, 2}}) {
            // Relative to its own diagonal entries: time may be scaled far beyond space.
            if (std::abs(e.m[p][q]) <= kEpsilon * std::sqrt(e.m[p][p] * e.m[q][q])) continue;
            eliminate(e, p, q);
            done = false;
        }
        if (done) return;
    }
}

}  // namespace

glm::dvec2 principal_axis(std::span<const Disk> disks) {
    // Offsets from the first centre: a standing figure gives exact zeros, wherever it stands.
    const auto offset = [&](const Disk& d) { return glm::dvec2{d.x - disks[0].x, d.y - disks[0].y}; };
    const double n = static_cast<double>(disks.size());
    glm::dvec2 mean{0};
    for (const Disk& d : disks) mean += offset(d) / n;
    double xx = 0, xy = 0, yy = 0;
    for (const Disk& d : disks) {
        const glm::dvec2 p = offset(d) - mean;
        xx += p.x * p.x, xy += p.x * p.y, yy += p.y * p.y;
    }
    // A direction found below this would be one of rounding, different on every machine.
    const double noise = 64 * kEpsilon * n * (xx + yy);
    if (std::hypot(xx - yy, 2 * xy) <= noise) return {1, 0};
    if (std::abs(xy) <= noise) return xx > yy ? glm::dvec2{1, 0} : glm::dvec2{0, 1};
    const double angle = 0.5 * std::atan2(2 * xy, xx - yy);
    return {std::cos(angle), std::sin(angle)};
}

PrincipalAxes principal_axes(std::span<const Disk> disks, double height) {
    const auto point = [&](std::size_t i) {
        return glm::dvec3{disks[i].x - disks[0].x, disks[i].y - disks[0].y, height * static_cast<double>(i)};
    };
    glm::dvec3 mean{0};
    for (std::size_t i = 0; i < disks.size(); ++i) mean += point(i) / static_cast<double>(disks.size());
    Eigen e;
    for (std::size_t i = 0; i < disks.size(); ++i) {
        const glm::dvec3 p = point(i) - mean;
        for (int r = 0; r < 3; ++r) {
            for (int c = 0; c < 3; ++c) e.m[r][c] += p[r] * p[c];
        }
    }
    diagonalise(e);

    std::array<std::size_t, 3> order{0, 1, 2};
    std::ranges::stable_sort(order, [&](std::size_t a, std::size_t b) { return e.m[a][a] > e.m[b][b]; });
    const glm::dvec3 first = e.vectors[order[0]] * (e.vectors[order[0]].z < 0 ? -1.0 : 1.0);
    const glm::dvec3 second = e.vectors[order[1]];
    constexpr double kLine = 1e-14;  // of the first variance: below it the second is made of rounding errors
    return {{first, second, glm::cross(first, second)}, e.m[order[1]][order[1]] <= kLine * e.m[order[0]][order[0]]};
}

}  // namespace mobb
