/// Seeded random clips and placements that look for trouble: standing, loops, points, aligned frames, touching disks.
#pragma once

#include <mobb/kinds.h>
#include <mobb/query.h>

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <numbers>
#include <random>
#include <vector>

namespace mobb::test {

/// How many random queries the suite asks; MOBBSCOPE_QUERIES gives longer or shorter runs.
inline int query_budget() {
    const char* text = std::getenv("MOBBSCOPE_QUERIES");
    return text ? std::atoi(text) : 1'000'000;
}

class Random {
  public:
    explicit Random(std::uint64_t seed) : engine_(seed) {}

    /// Uniform integer in [low, high].
    int integer(int low, int high) {
        return low + static_cast<int>(engine_() % static_cast<std::uint64_t>(high - low + 1));
    }
    /// Uniform in [low, high).
    double real(double low, double high) {
        return low + (high - low) * (static_cast<double>(engine_() >> 11) * 0x1p-53);
    }
    bool chance(double probability) { return real(0, 1) < probability; }

  private:
    std::mt19937_64 engine_;
};

enum class Path { standing, straight, wander, loop, circles, jitter, jumps, count };

/// 1 to `most` samples; most clips are short, some are long, and one in ten lies far from its own origin. dt > 0 is
/// taken if given.
inline ClipPtr random_clip(Random& random, int most = 2000, double given_dt = 0) {
    int n = 1;
    switch (random.integer(0, 4)) {
        case 0:
            n = random.integer(1, 3);
            break;
        case 1:
            n = random.integer(1, 40);
            break;
        case 2:
        case 3:
            n = random.integer(20, 200);
            break;
        default:
            n = random.integer(100, 2000);
            break;
    }
    n = std::min(n, most);
    constexpr double kSpacings[] = {1.0 / 30, 1.0 / 60, 1.0 / 25, 0.1, 0.0333333, 1.0};
    const double dt = given_dt > 0         ? given_dt
                      : random.chance(0.7) ? kSpacings[random.integer(0, 5)]
                                           : random.real(0.005, 0.3);
    const auto path = static_cast<Path>(random.integer(0, static_cast<int>(Path::count) - 1));
    const double speed = random.real(0.1, 5);
    const double radius = random.chance(0.1) ? 0 : random.real(0.05, 0.6);
    const double sway = random.chance(0.5) ? random.real(0, 0.15) : 0;

    const double far_away = random.chance(0.1) ? 1e5 : 0;
    double x = random.real(-2, 2) + far_away, y = random.real(-2, 2) - far_away, heading = random.real(-4, 4);
    std::vector<Disk> samples;
    for (int i = 0; i < n; ++i) {
        const double phase = static_cast<double>(i) / n;
        Disk d{x, y, std::max(0.0, radius + sway * std::sin(0.7 * i))};
        switch (path) {
            case Path::standing:
                break;
            case Path::straight:
                x += speed * dt * std::cos(heading), y += speed * dt * std::sin(heading);
                break;
            case Path::wander:
                heading += random.real(-0.3, 0.3);
                x += speed * dt * std::cos(heading), y += speed * dt * std::sin(heading);
                break;
            case Path::loop:  // the last centre is the first
                d.x += speed * std::cos(2 * std::numbers::pi * (n > 1 ? i / double(n - 1) : 0));
                d.y += speed * std::sin(2 * std::numbers::pi * (n > 1 ? i / double(n - 1) : 0));
                break;
            case Path::circles:
                d.x += 2 * std::cos(20 * phase), d.y += 2 * std::sin(20 * phase);
                break;
            case Path::jitter:
                d.x += random.real(-0.2, 0.2), d.y += random.real(-0.2, 0.2);
                break;
            case Path::jumps:
                d.x += random.chance(0.05) ? 3 : 0, d.r *= random.chance(0.1) ? 0 : 1;
                break;
            case Path::count:
                break;
        }
        samples.push_back(d);
    }
    return std::make_shared<const Clip>(dt, std::move(samples));
}

/// Held or linear, the same samples.
inline ClipPtr random_motion(Random& random, const ClipPtr& clip) {
    const Motion motion = random.chance(0.5) ? Motion::linear : Motion::held;
    return std::make_shared<const Clip>(clip->dt(), std::vector(clip->samples().begin(), clip->samples().end()),
                                        motion);
}

/// How far a disk at (x, y, w*t) stands out of a box, metres; below 0 if it lies within.
inline double overhang(const Box& box, glm::dvec3 p, double r) {
    p -= box.center;
    if (info(box.kind).moves && box.half.z > 0) p -= glm::dvec3(p.z / box.half.z * box.drift, 0);
    if (info(box.kind).round) return std::max(std::hypot(p.x, p.y) + r - box.half.x, std::abs(p.z) - box.half.z);
    double out = -1e300;
    for (std::size_t k = 0; k < 3; ++k) {
        const glm::dvec3 axis = box.axes[k];
        const double along = std::abs(glm::dot(p, axis)) + r * std::hypot(axis.x, axis.y);
        out = std::max(out, along - box.half[static_cast<int>(k)]);
    }
    return out;
}

/// A second clip for a pair: now and then with the first one's dt, so that their frames can be aligned.
inline ClipPtr random_partner(Random& random, const Clip& clip, int most = 2000) {
    return random_clip(random, most, random.chance(0.4) ? clip.dt() : 0);
}

/// The kinds of trees whose boxes are fitted: all but those that have blocks.
inline const std::vector<TreeKind> kFittedTrees = [] {
    std::vector<TreeKind> out(kTreeKinds.begin(), kTreeKinds.end());
    std::erase_if(out, [](TreeKind kind) { return info(kind).has_blocks(); });
    return out;
}();

/// A tree of boxes.
inline FitOptions random_fit(Random& random) {
    FitOptions fit;
    fit.tree = kFittedTrees[static_cast<std::size_t>(random.integer(0, static_cast<int>(kFittedTrees.size()) - 1))];
    fit.leaf = random.chance(0.5) ? 10 : random.integer(1, 50);
    fit.levels = random.chance(0.6) ? 0 : random.integer(1, 6);
    fit.axes = static_cast<Axes>(random.integer(0, 2));
    // From 1e-3 to 1e3 m/s, evenly in orders of magnitude; mostly the paper's.
    if (random.chance(0.3)) fit.time_scale = std::pow(10, random.real(-3, 3));
    return fit;
}

/// A tree of boxes, or of blocks.
inline FitOptions random_any_fit(Random& random) {
    FitOptions fit = random_fit(random);
    if (random.chance(0.2)) fit.tree = TreeKind::blocks;
    return fit;
}

/// A change at some node of a tree of boxes.
inline NodeChange random_change(Random& random, const Tree& tree) {
    NodeChange change{random.integer(0, static_cast<int>(tree.nodes().size()) - 1)};
    if (random.chance(0.5)) change.axes = static_cast<Axes>(random.integer(0, 2));
    if (random.chance(0.5)) change.kind = static_cast<BoxKind>(random.integer(0, static_cast<int>(BoxKind::aabb)));
    const bool on_last_level = tree.level(change.node) + 1 == tree.options().levels;
    if (random.chance(0.5)) change.split = on_last_level ? 0 : random.integer(0, tree.node(change.node).count - 1);
    return change;
}

/// For a second tree: as often as not of the first one's kind, as trees of different kinds prune little.
inline FitOptions random_partner_fit(Random& random, const FitOptions& first) {
    FitOptions fit = random_fit(random);
    if (random.chance(0.5)) fit.tree = first.tree;
    return fit;
}

inline double random_angle(Random& random) {
    return random.chance(0.2) ? 90.0 * random.integer(-8, 8) : random.real(-400, 400);
}

/// Places b against a: anywhere near; or so that one pair of samples that share time touches, but for a hair. Now and
/// then both are 10 km and 10^5 s away.
inline void random_placements(Random& random, const Clip& a, const Clip& b, Placement& place_a, Placement& place_b) {
    place_a.translate = {random.real(-3, 3), random.real(-3, 3)};
    place_a.rotate_deg = random_angle(random);
    place_a.start = random.chance(0.3) ? 0 : random.real(-2, 2);
    const bool far_away = random.chance(0.1);
    if (far_away) {
        place_a.translate += glm::dvec2{1e4, -1e4};
        place_a.start += 1e5;
    }
    place_b.rotate_deg = random_angle(random);
    place_b.translate = {random.real(-6, 6), random.real(-6, 6)};
    if (far_away) place_b.translate += glm::dvec2{1e4, -1e4};
    const double span = a.duration() + b.duration();
    place_b.start = place_a.start + random.real(-1, 1) * span / 2;
    if (random.chance(0.4)) place_b.start = place_a.start + a.dt() * random.integer(-a.count() / 2, a.count() / 2);
    if (!random.chance(0.5)) return;

    const int i = random.integer(0, a.count() - 1);
    const int j = random.integer(0, b.count() - 1);
    if (random.chance(0.7)) place_b.start = place_a.start + i * a.dt() - j * b.dt();
    place_b.translate = {0, 0};
    const Disk disk_a = PlacedClip(a, place_a).disk(i);
    const Disk disk_b = PlacedClip(b, place_b).disk(j);
    constexpr double kHairs[] = {0, 1e-15, -1e-15, 1e-12, -1e-12, 1e-9, -1e-9, 1e-5, -1e-5};
    const double reach = (disk_a.r + disk_b.r) * (1 + kHairs[random.integer(0, 8)]);
    const double angle = random.chance(0.3) ? std::numbers::pi / 2 * random.integer(0, 3) : random.real(0, 7);
    place_b.translate = {disk_a.x + reach * std::cos(angle) - disk_b.x, disk_a.y + reach * std::sin(angle) - disk_b.y};
}

}  // namespace mobb::test
