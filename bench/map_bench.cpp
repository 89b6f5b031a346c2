/// Placement maps of two long clips, cold: `bench_map [A.csv B.csv]`, without files built-in walks of a minute.
#include "clip_csv.h"
#include "walks.h"

#include <benchmark/benchmark.h>
#include <explain/placement_map.h>

#include <chrono>
#include <iostream>
#include <string>
#include <tuple>
#include <utility>

namespace mobbscope {
namespace {

FittedScene scene_of(const mobb::ClipPtr& a, const mobb::ClipPtr& b) {
    Scene scene;
    scene.clips = {{"a", {}, {}, a}, {"b", {}, {}, b}};
    scene.agents = {{"A", 0, {}, {}}, {"B", 1, {}, {}}};
    return {std::move(scene), {}};
}

/// Over the region in which the two can meet. Counters: the first picture's milliseconds, and the share of hits.
void map_of(benchmark::State& state, const FittedScene& fitted, MapShow show, MapAxis across, MapAxis up) {
    const SceneQuery query = fitted.queries()[0];
    MapOrder order{{across}, {up}};
    order.width = order.height = static_cast<int>(state.range(0));
    order.show = show;
    choose_ranges(fitted.placed(query.a).placed_clip(), fitted.placed(query.b).placed_clip(), order);
    double first = 0, hits = 0;
    for (auto _ : state) {
        const auto begin = std::chrono::steady_clock::now();
        const auto pass = [&](const PlacementMap& map) {
            if (map.step != 8) return;
            first += std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
        };
        hits = static_cast<double>(map_placements(fitted, query, order, pass).hit_count());
    }
    state.counters["first_ms"] = benchmark::Counter(first, benchmark::Counter::kAvgIterations);
    state.counters["hits_percent"] = 100 * hits / order.width / order.height;
}

void add_all(const FittedScene& fitted) {
    for (const auto& [axes, across, up] : {std::tuple("dx_dy", MapAxis::dx, MapAxis::dy),
                                           std::tuple("dheading_dstart", MapAxis::dheading, MapAxis::dstart)}) {
        for (const MapShow show : {MapShow::answer, MapShow::clearance, MapShow::tests}) {
            const std::string what = "map/" + std::string(name(show)) + '/' + axes;
            const auto body = [&fitted, show, across = across, up = up](benchmark::State& state) {
                map_of(state, fitted, show, across, up);
            };
            benchmark::RegisterBenchmark(what.c_str(), body)
                ->Arg(256)
                ->Arg(512)
                ->Unit(benchmark::kMillisecond)
                ->UseRealTime();
        }
    }
}

}  // namespace
}  // namespace mobbscope

int main(int argc, char** argv) {
    benchmark::Initialize(&argc, argv);
    if (argc != 1 && argc != 3) {
        std::cerr << "bench_map takes two clips as CSV files, or none\n";
        return 1;
    }
    mobb::test::Random random(1);
    const bool built_in = argc == 1;
    const mobb::ClipPtr a = built_in ? mobb::bench::walk(random, 60) : mobb::bench::clip_from_csv(argv[1]);
    const mobb::ClipPtr b = built_in ? mobb::bench::walk(random, 60) : mobb::bench::clip_from_csv(argv[2]);
    const mobbscope::FittedScene fitted = mobbscope::scene_of(a, b);
    mobbscope::add_all(fitted);
    benchmark::RunSpecifiedBenchmarks();
    benchmark::Shutdown();
    return 0;
}
