/// Proofs of answers (explain/certificate.h) and their margins: of walks of some seconds, as the window makes them with
/// each move of a drag, and of long ones side by side whose traces are large.
#include <benchmark/benchmark.h>
#include <explain/certificate.h>
#include <explain/margins.h>

#include <cstddef>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "walks.h"

namespace {

using namespace mobb;
using namespace mobbscope;

/// Two placed trees with the record of their query.
struct Asked {
    Tree tree_a, tree_b;
    Placement place_b;
    RecordedQuery recorded;

    Asked(const ClipPtr& clip_a, const ClipPtr& clip_b, const Placement& place)
        : tree_a(clip_a, {}), tree_b(clip_b, {}), place_b(place) {
        TraceRecorder recorder;
        recorded.contact = query(a(), b(), recorder);
        recorded.trace = recorder.take();
    }
    PlacedTree a() const { return {tree_a, {}}; }
    PlacedTree b() const { return {tree_b, place_b}; }
};
using AskedPtr = std::unique_ptr<const Asked>;

/// Queries of walks of so many seconds that pass the roots.
std::vector<AskedPtr> walks(double seconds) {
    test::Random random(35);
    std::vector<AskedPtr> out;
    while (out.size() < 64) {
        const Placement place{{random.real(-4, 4), random.real(-4, 4)}, random.real(0, 360), random.real(-2, 2)};
        auto asked = std::make_unique<const Asked>(bench::walk(random, seconds), bench::walk(random, seconds), place);
        if (asked->recorded.trace.size() > 2) out.push_back(std::move(asked));
    }
    return out;
}

/// Two who walk the same way for so many seconds, one beside the other: nearly every pair of samples is measured.
std::vector<AskedPtr> side_by_side(double seconds) {
    test::Random random(36);
    const ClipPtr clip = bench::wander(random, seconds);
    std::vector<AskedPtr> out;
    out.push_back(std::make_unique<const Asked>(clip, clip, Placement{{0.95, 0}, 0, 0}));
    return out;
}

void prove(benchmark::State& state, const std::vector<AskedPtr>& all) {
    std::size_t next = 0, tiles = 0;
    for (auto _ : state) {
        const Asked& asked = *all[next++ % all.size()];
        tiles += certify(asked.a(), asked.b(), asked.recorded).tiles.size();
    }
    state.counters["tiles"] = static_cast<double>(tiles) / static_cast<double>(next);
    state.counters["events"] = all[0]->recorded.trace.size();
}

void push(benchmark::State& state, const std::vector<AskedPtr>& all) {
    std::vector<Certificate> proofs;
    proofs.reserve(all.size());
    for (const AskedPtr& asked : all) proofs.push_back(certify(asked->a(), asked->b(), asked->recorded));
    std::size_t next = 0;
    for (auto _ : state) {
        const std::size_t i = next++ % all.size();
        benchmark::DoNotOptimize(margins_of(all[i]->a().placed_clip(), all[i]->b().placed_clip(), proofs[i]));
    }
}

void add(const std::string& of, std::vector<AskedPtr> made) {
    const auto all = std::make_shared<const std::vector<AskedPtr>>(std::move(made));
    benchmark::RegisterBenchmark(("certify/" + of).c_str(), [all](benchmark::State& state) {
        prove(state, *all);
    })->Unit(benchmark::kMicrosecond);
    benchmark::RegisterBenchmark(("margins/" + of).c_str(), [all](benchmark::State& state) {
        push(state, *all);
    })->Unit(benchmark::kMicrosecond);
}

}  // namespace

int main(int argc, char** argv) {
    for (const int seconds : {2, 13, 130}) add("walks/" + std::to_string(30 * seconds), walks(seconds));
    for (const int seconds : {130, 3400}) add("beside/" + std::to_string(30 * seconds), side_by_side(seconds));
    benchmark::Initialize(&argc, argv);
    benchmark::RunSpecifiedBenchmarks();
}
