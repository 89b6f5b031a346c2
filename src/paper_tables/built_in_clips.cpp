#include <base/random.h>
#include <paper_tables/built_in_clips.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

namespace mobbscope {

namespace {

constexpr double kRate = 30;  // samples per second

/// Arms and legs swing: the disk breathes with the steps.
double radius(double mean, double step_rate, double t) {
    return mean * (1 + 0.12 * std::sin(2 * std::numbers::pi * step_rate * t));
}

mobb::ClipPtr clip_of(std::vector<mobb::Disk> samples) {
    return std::make_shared<const mobb::Clip>(1 / kRate, std::move(samples));
}

/// Wanders about; near the edge of the volume it turns back, now and then it slows down.
mobb::ClipPtr walk_in_a_volume(Uniform& uniform, double seconds) {
    constexpr double kVolume = 2.0;  // metres from the middle at which it turns back
    const double speed = uniform.within(1.0, 1.5);
    const double mean_radius = uniform.within(0.33, 0.45);
    const double step_rate = uniform.within(1.5, 2.1);
    const double pause_rate = uniform.within(0.03, 0.12);
    double x = uniform.within(-1.5, 1.5), y = uniform.within(-1.5, 1.5);
    double heading = uniform.within(0, 2 * std::numbers::pi);
    double turn = 0;  // radians per second
    std::vector<mobb::Disk> samples;
    for (int i = 0; i < static_cast<int>(seconds * kRate); ++i) {
        const double t = i / kRate;
        samples.push_back({x, y, radius(mean_radius, step_rate, t)});
        const bool outward = x * std::cos(heading) + y * std::sin(heading) > 0;
        const double side = x * std::sin(heading) - y * std::cos(heading) > 0 ? 1 : -1;
        const double wanted = outward && std::hypot(x, y) > kVolume ? 2.2 * side : uniform.within(-1.5, 1.5);
        turn += (wanted - turn) * 0.15;
        heading += turn / kRate;
        const double slowed = 0.1 + 0.9 * std::abs(std::sin(std::numbers::pi * pause_rate * t));
        x += speed * slowed / kRate * std::cos(heading);
        y += speed * slowed / kRate * std::sin(heading);
    }
    return clip_of(std::move(samples));
}

struct Move {
    double speed;          ///< m/s
    double turn;           ///< radians in all
    double side;           ///< radians from the way it faces to the way it goes
    double mean_radius;    ///< metres
    double likelihood_to;  ///< upper end of its share of a set
};

// In about the shares of a set of locomotion clips: walks, strides, runs, quarter turns, steps to the side and back.
constexpr Move kMoves[] = {{1.2, 0, 0, 0.38, 0.40},  {1.3, 0.5, 0, 0.38, 0.52}, {1.6, 0, 0, 0.50, 0.60},
                           {3.2, 0, 0, 0.42, 0.75},  {0.9, 1.5, 0, 0.34, 0.86}, {0.7, 0, 1.57, 0.41, 0.94},
                           {0.8, 0, 3.14, 0.41, 1.0}};

mobb::ClipPtr short_move(Uniform& uniform, double seconds) {
    const double pick = uniform.within(0, 1);
    const Move& move = *std::find_if(std::begin(kMoves), std::end(kMoves),
                                     [pick](const Move& each) { return pick < each.likelihood_to; });
    const double speed = move.speed * uniform.within(0.85, 1.15);
    const double turn = move.turn * (uniform.within(0, 1) < 0.5 ? 1 : -1) * uniform.within(0.8, 1.1);
    const double side = move.side * (uniform.within(0, 1) < 0.5 ? 1 : -1);
    const double mean_radius = move.mean_radius * uniform.within(0.9, 1.1);
    const double step_rate = 1.4 + 0.35 * speed;
    double x = 0, y = 0;
    std::vector<mobb::Disk> samples;
    const int count = std::max(2, static_cast<int>(seconds * kRate));
    for (int i = 0; i < count; ++i) {
        samples.push_back({x, y, radius(mean_radius, step_rate, i / kRate)});
        const double heading = side + turn * (i + 0.5) / count;
        // The hips sway to the side of the foot that carries.
        const double sway = 0.06 * std::cos(std::numbers::pi * step_rate * i / kRate);
        x += speed / kRate * std::cos(heading) - sway / kRate * std::sin(heading);
        y += speed / kRate * std::sin(heading) + sway / kRate * std::cos(heading);
    }
    return clip_of(std::move(samples));
}

std::vector<mobb::ClipPtr> made(int count, double mean_seconds, std::uint64_t seed,
                                mobb::ClipPtr (*make)(Uniform&, double seconds)) {
    Uniform uniform(seed);
    std::vector<mobb::ClipPtr> clips;
    for (int i = 0; i < count; ++i) clips.push_back(make(uniform, mean_seconds * uniform.within(2.0 / 3, 4.0 / 3)));
    return clips;
}

}  // namespace

std::vector<mobb::ClipPtr> walks_in_a_volume(int count, double mean_seconds, std::uint64_t seed) {
    return made(count, mean_seconds, seed, walk_in_a_volume);
}

std::vector<mobb::ClipPtr> short_moves(int count, double mean_seconds, std::uint64_t seed) {
    return made(count, mean_seconds, seed, short_move);
}

}  // namespace mobbscope
