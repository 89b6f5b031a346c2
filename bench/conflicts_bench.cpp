/// Who collides in a crowd of short tracks: the library's sweep, and beside it the plain grid and the k-d trees that
/// one would write for tracks of one clock.
#include <benchmark/benchmark.h>
#include <mobb/random_motion.h>
#include <mobb_tracks/people_conflicts.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <numbers>
#include <numeric>
#include <unordered_map>
#include <utility>
#include <vector>
#ifdef MOBBSCOPE_NANOFLANN
#include <nanoflann.hpp>
#endif

namespace {

using namespace mobb;

constexpr int kSamples = 12;
constexpr double kDt = 0.4, kRadius = 0.2, kSpeed = 1.3;

/// People who walk straight on for 12 points, `density` of them on a square metre. `at_once`: all of them are there at
/// the same time; else so many are.
struct Walkers {
    std::vector<ClipPtr> clips;
    std::vector<PlacedClip> placed;
    std::vector<int> begins;  ///< by walker: the step at which it begins
    std::vector<int> person_of;

    Walkers(int count, int at_once, double density) {
        test::Random random(3);
        const double side = std::sqrt(at_once / density);
        for (int i = 0; i < count; ++i) {
            const double x = random.real(0, side), y = random.real(0, side);
            const double heading = random.real(0, 2 * std::numbers::pi);
            std::vector<Disk> samples;
            for (int k = 0; k < kSamples; ++k) {
                const double way = kSpeed * kDt * k;
                samples.push_back({x + way * std::cos(heading), y + way * std::sin(heading), kRadius});
            }
            clips.push_back(std::make_shared<const Clip>(kDt, std::move(samples), Motion::linear));
            begins.push_back(i / at_once * kSamples);
            placed.emplace_back(*clips.back(), Placement{{0, 0}, 0, begins.back() * kDt});
        }
        person_of.resize(static_cast<std::size_t>(count));
        std::iota(person_of.begin(), person_of.end(), 0);
    }
};

void sweep(benchmark::State& state) {
    const Walkers walkers(static_cast<int>(state.range(0)), static_cast<int>(state.range(1)),
                          static_cast<double>(state.range(2)));
    std::size_t found = 0;
    for (auto _ : state) found = PeopleConflicts(walkers.placed, walkers.person_of).size();
    state.counters["conflicts"] = static_cast<double>(found);
}

/// What one would write for tracks of one clock: `pairs_near(ways, visit)` tells, for a step, all pairs of ways that
/// may be near each other, by their index, and perhaps others. It tells who collides, and neither when nor how deep.
template <class PairsNear>
void step_by_step(benchmark::State& state, const PairsNear& pairs_near) {
    const Walkers walkers(static_cast<int>(state.range(0)), static_cast<int>(state.range(1)),
                          static_cast<double>(state.range(2)));
    std::size_t found = 0;
    for (auto _ : state) {
        std::vector<std::pair<int, int>> pairs;
        std::vector<SweptDisk> ways;
        std::size_t first = 0;
        for (int step = 0; step < walkers.begins.back() + kSamples; ++step) {
            while (first < walkers.begins.size() && walkers.begins[first] + kSamples - 1 <= step) ++first;
            ways.clear();
            for (std::size_t i = first; i < walkers.begins.size() && walkers.begins[i] <= step; ++i)
                ways.push_back(swept(walkers.placed[i], step - walkers.begins[i]));
            pairs_near(ways, [&](std::size_t a, std::size_t b) {
                if (Approach(ways[a], ways[b]).collides())
                    pairs.emplace_back(static_cast<int>(first + a), static_cast<int>(first + b));
            });
        }
        std::ranges::sort(pairs);
        pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
        found = pairs.size();
    }
    state.counters["conflicts"] = static_cast<double>(found);
}

/// Cells that are as wide as two ways and two radii: who is in one is compared with those of the cells around.
void plain_grid(benchmark::State& state) {
    constexpr double kCell = 2 * (kSpeed * kDt + kRadius);
    std::unordered_map<std::int64_t, std::vector<std::size_t>> cells;
    step_by_step(state, [&](const std::vector<SweptDisk>& ways, const auto& visit) {
        cells.clear();
        for (std::size_t i = 0; i < ways.size(); ++i) {
            const auto x = static_cast<std::int64_t>(std::floor((ways[i].from.x + ways[i].to.x) / 2 / kCell));
            const auto y = static_cast<std::int64_t>(std::floor((ways[i].from.y + ways[i].to.y) / 2 / kCell));
            for (std::int64_t dx = -1; dx <= 1; ++dx) {
                for (std::int64_t dy = -1; dy <= 1; ++dy) {
                    const auto at = cells.find((x + dx) * 1'000'003 + y + dy);
                    if (at == cells.end()) continue;
                    for (const std::size_t other : at->second) visit(other, i);
                }
            }
            cells[x * 1'000'003 + y].push_back(i);
        }
    });
}

#ifdef MOBBSCOPE_NANOFLANN
/// The middles of ways, as nanoflann wants them.
struct Middles {
    std::vector<std::array<double, 2>> at;
    std::size_t kdtree_get_point_count() const { return at.size(); }
    double kdtree_get_pt(std::size_t i, std::size_t axis) const { return at[i][axis]; }
    template <class Box>
    bool kdtree_get_bbox(Box&) const {
        return false;
    }
};

/// A k-d tree of each step, which is what SciPy's cKDTree would be asked for: nanoflann's.
void kd_tree(benchmark::State& state) {
    constexpr double kNear = kSpeed * kDt + 2 * kRadius;
    using Tree = nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<double, Middles>, Middles, 2>;
    Middles middles;
    std::vector<std::pair<std::uint32_t, double>> near;
    step_by_step(state, [&](const std::vector<SweptDisk>& ways, const auto& visit) {
        middles.at.clear();
        for (const SweptDisk& way : ways)
            middles.at.push_back({(way.from.x + way.to.x) / 2, (way.from.y + way.to.y) / 2});
        const Tree tree(2, middles);
        for (std::size_t i = 0; i < ways.size(); ++i) {
            tree.radiusSearch(middles.at[i].data(), kNear * kNear, near, {32, 0, false});
            for (const auto& [other, squared] : near) {
                if (other < i) visit(other, i);
            }
        }
    });
}
#endif

void crowds(benchmark::internal::Benchmark* of) {
    of->ArgNames({"tracks", "at_once", "per_m2"})->Unit(benchmark::kMillisecond);
    of->Args({10'000, 10'000, 2})->Args({100'000, 1'000, 2})->Args({100'000, 200, 1});
}
BENCHMARK(sweep)->Apply(crowds);
BENCHMARK(plain_grid)->Apply(crowds);
#ifdef MOBBSCOPE_NANOFLANN
BENCHMARK(kd_tree)->Apply(crowds);
#endif

}  // namespace
