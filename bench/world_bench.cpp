/// A whole crowd: simulating one, and finding who collides in one.
#include <benchmark/benchmark.h>
#include <conflicts/conflicts.h>
#include <crowd/graph/build_graph.h>
#include <crowd/simulation/simulate.h>
#include <paper_tables/built_in_clips.h>
#include <scene/fitted_scene.h>
#include <scene/motion_graph.h>

#include <cmath>
#include <memory>
#include <optional>
#include <string>

#include "walks.h"

namespace {

using namespace mobbscope;

/// So many agents, 12 m^2 for each, that play 51 moves of about 2 s for so many seconds, on one thread. Counters:
/// queries that the trees were asked, and how many a second.
void simulate_crowd(benchmark::State& state) {
    Scene scene;
    for (const mobb::ClipPtr& clip : short_moves(51, 2.1, 1)) {
        scene.clips.push_back({"move" + std::to_string(scene.clips.size()), std::nullopt, {}, clip});
    }
    scene.graph = std::make_shared<const MotionGraph>(graph_of_whole_clips(scene));
    const FittedScene fitted(std::move(scene), {});
    const MoveSet moves(fitted);
    SimulateOptions options;
    options.agents = static_cast<int>(state.range(0));
    const double side = std::sqrt(12.0 * options.agents);
    options.area = {side, side};
    options.seconds = static_cast<double>(state.range(1));
    options.plan = static_cast<double>(state.range(2));
    options.threads = 1;
    std::int64_t queries = 0;
    for (auto _ : state) queries += simulate(moves, options).counts.queries;
    state.counters["queries"] = benchmark::Counter(static_cast<double>(queries), benchmark::Counter::kAvgIterations);
    state.counters["queries_per_s"] = benchmark::Counter(static_cast<double>(queries), benchmark::Counter::kIsRate);
}

/// So many people, 12 m^2 for each, who walk for a minute and heed nobody.
void find_conflicts(benchmark::State& state) {
    mobb::test::Random random(2);
    const auto people = static_cast<int>(state.range(0));
    const double side = std::sqrt(12.0 * people);
    Scene scene;
    for (int i = 0; i < people; ++i) {
        scene.clips.push_back({"walk" + std::to_string(i), std::nullopt, {}, mobb::bench::wander(random, 60)});
        scene.agents.push_back(
            {"person " + std::to_string(i),
             i,
             {.translate = {random.real(0, side), random.real(0, side)}, .start = random.real(0, 60)},
             std::nullopt});
    }
    std::size_t conflicts = 0;
    for (auto _ : state) conflicts = conflicts_in(scene).size();
    state.counters["conflicts"] = static_cast<double>(conflicts);
}

BENCHMARK(simulate_crowd)
    ->ArgNames({"agents", "seconds", "plan"})
    ->Args({100, 120, 0})
    ->Args({100, 120, 8})
    ->Args({2000, 10, 0})
    ->Unit(benchmark::kMillisecond);
BENCHMARK(find_conflicts)->ArgName("people")->Arg(100)->Arg(1000)->Unit(benchmark::kMillisecond);

}  // namespace
