/// Who collides in a crowd of short tracks: the library's sweep, and beside it the plain grid that one would write for
/// tracks of one clock.
#include <benchmark/benchmark.h>
#include <mobb/random_motion.h>
#include <mobb_tracks/people_conflicts.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <numbers>
#include <numeric>
#include <unordered_map>
#include <utility>
#include <vector>

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

/// Each step's ways are put into cells that are as wide as two ways and two radii, and compared with those of the cells
/// around. It tells who collides, and neither when nor how deep.
void plain_grid(benchmark::State& state) {
    const Walkers walkers(static_cast<int>(state.range(0)), static_cast<int>(state.range(1)),
                          static_cast<double>(state.range(2)));
    constexpr double kCell = 2 * (kSpeed * kDt + kRadius);
    std::vector<int> by_begin(walkers.begins.size());
    std::iota(by_begin.begin(), by_begin.end(), 0);
    std::size_t found = 0;
    for (auto _ : state) {
        std::vector<std::pair<int, int>> pairs;
        std::unordered_map<std::int64_t, std::vector<int>> cells;
        std::size_t first = 0;
        for (int step = 0; step < walkers.begins.back() + kSamples; ++step) {
            while (first < by_begin.size() && walkers.begins[first] + kSamples - 1 <= step) ++first;
            cells.clear();
            for (std::size_t i = first; i < by_begin.size() && walkers.begins[i] <= step; ++i) {
                const SweptDisk way = swept(walkers.placed[i], step - walkers.begins[i]);
                const auto x = static_cast<std::int64_t>(std::floor(way.from.x / kCell));
                const auto y = static_cast<std::int64_t>(std::floor(way.from.y / kCell));
                for (std::int64_t dx = -1; dx <= 1; ++dx) {
                    for (std::int64_t dy = -1; dy <= 1; ++dy) {
                        const auto at = cells.find((x + dx) * 1'000'003 + y + dy);
                        if (at == cells.end()) continue;
                        for (const int other : at->second) {
                            const auto j = static_cast<std::size_t>(other);
                            if (Approach(way, swept(walkers.placed[j], step - walkers.begins[j])).collides())
                                pairs.emplace_back(other, static_cast<int>(i));
                        }
                    }
                }
                cells[x * 1'000'003 + y].push_back(static_cast<int>(i));
            }
        }
        std::ranges::sort(pairs);
        pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
        found = pairs.size();
    }
    state.counters["conflicts"] = static_cast<double>(found);
}

void crowds(benchmark::internal::Benchmark* of) {
    of->ArgNames({"tracks", "at_once", "per_m2"})->Unit(benchmark::kMillisecond);
    of->Args({10'000, 10'000, 2})->Args({100'000, 1'000, 2})->Args({100'000, 200, 1});
}
BENCHMARK(sweep)->Apply(crowds);
BENCHMARK(plain_grid)->Apply(crowds);

}  // namespace
