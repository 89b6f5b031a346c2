/// Time and tests per query, each kind of tree beside the direct search, on long and short walks.
#include <benchmark/benchmark.h>
#include <mobb/query.h>

#include <string>
#include <vector>

#include "walks.h"

namespace {

using namespace mobb;

struct Workload {
    std::vector<ClipPtr> clips;
    std::vector<std::pair<int, Placement>> sides;  ///< clip and placement; two a query
};

Workload make_workload(double seconds) {
    test::Random random(7);
    Workload w;
    for (int i = 0; i < 14; ++i) w.clips.push_back(bench::walk(random, seconds));
    for (int i = 0; i < 4096; ++i) {
        w.sides.emplace_back(random.integer(0, 13), bench::somewhere(random, i % 2 ? seconds : 0));
    }
    return w;
}

const Workload& workload(double seconds) {
    static const Workload long_walks = make_workload(42), short_walks = make_workload(2.1);
    return seconds > 10 ? long_walks : short_walks;
}

void report(benchmark::State& state, const TestCounts& tests) {
    const auto per_query = [&](std::int64_t n) {
        return benchmark::Counter(static_cast<double>(n), benchmark::Counter::kAvgIterations);
    };
    for (const BoxKind kind : kBoxKinds) state.counters[std::string(info(kind).heading)] = per_query(tests[kind]);
    state.counters["samples"] = per_query(tests[TestKind::samples]);
}

/// Times ask(a, b, observer) on the workload's pairs, over and over, and reports the tests it made.
template <class Placed, class Ask>
void measure(benchmark::State& state, const std::vector<Placed>& placed, Ask ask) {
    Statistics statistics;
    std::size_t i = 0;
    for (auto _ : state) {
        benchmark::DoNotOptimize(ask(placed[i], placed[i + 1], statistics));
        i = (i + 2) % placed.size();
    }
    report(state, statistics.tests);
}

void direct(benchmark::State& state, double seconds) {
    const Workload& w = workload(seconds);
    std::vector<PlacedClip> placed;
    for (const auto& [clip, placement] : w.sides)
        placed.emplace_back(*w.clips[static_cast<std::size_t>(clip)], placement);
    measure(state, placed, [](const auto& a, const auto& b, auto& observer) { return direct_search(a, b, observer); });
}

void tree(benchmark::State& state, double seconds, FitOptions options) {
    const Workload& w = workload(seconds);
    std::vector<Tree> trees;
    for (const ClipPtr& clip : w.clips) trees.emplace_back(clip, options);
    std::vector<PlacedTree> placed;
    for (const auto& [clip, placement] : w.sides) placed.emplace_back(trees[static_cast<std::size_t>(clip)], placement);
    measure(state, placed, [](const auto& a, const auto& b, auto& observer) { return query(a, b, observer); });
}

void fit(benchmark::State& state, double seconds, FitOptions options) {
    const ClipPtr& clip = workload(seconds).clips.front();
    for (auto _ : state) benchmark::DoNotOptimize(Tree(clip, options));
}

const bool registered = [] {
    for (const double seconds : {42.0, 2.1}) {
        const std::string length = seconds > 10 ? "42s" : "2s";
        benchmark::RegisterBenchmark(("query/direct/" + length).c_str(), direct, seconds);
        for (const TreeKind kind : kTreeKinds) {
            for (const int levels : {1, 0}) {
                const std::string label = std::string(name(kind)) + (levels ? "_1level/" : "/") + length;
                benchmark::RegisterBenchmark(("query/" + label).c_str(), tree, seconds,
                                             FitOptions{.tree = kind, .levels = levels});
            }
        }
        for (const Axes axes : {Axes::endpoints, Axes::covariance, Axes::minarea}) {
            for (const TreeKind kind : {TreeKind::mobb, TreeKind::umobb, TreeKind::moving}) {
                const std::string label = std::string(name(kind)) + "/" + std::string(name(axes)) + "/" + length;
                benchmark::RegisterBenchmark(("fit/" + label).c_str(), fit, seconds,
                                             FitOptions{.tree = kind, .axes = axes});
            }
        }
    }
    return true;
}();

}  // namespace
