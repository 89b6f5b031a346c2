/// Time and tests per query, each kind of tree beside the direct search, on long and short walks; what building and
/// recording cost; and how cost grows. --benchmark_filter=grow/ asks for the last alone.
#include <benchmark/benchmark.h>
#include <mobb/blocks.h>
#include <mobb/query.h>
#include <mobb/trace.h>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "walks.h"

namespace {

using namespace mobb;

/// Clips, and queries between them.
struct Workload {
    struct Side {
        std::size_t clip;
        Placement placement;
    };
    std::vector<ClipPtr> clips;
    std::vector<Side> sides;  ///< two a query
};

using WorkloadPtr = std::shared_ptr<const Workload>;

/// What answers queries: made over clips, asked where it is placed.
struct DirectSearch {
    using Placed = PlacedClip;
    std::vector<ClipPtr> made;

    explicit DirectSearch(const std::vector<ClipPtr>& clips) : made(clips) {}
    template <class Observer>
    static bool ask(const Placed& a, const Placed& b, Observer& observer) {
        return direct_search(a, b, observer).has_value();
    }
    /// The first that collides, or how many there are.
    static std::size_t any(const Placed& a, std::span<const Placed> others) {
        std::size_t i = 0;
        while (i < others.size() && !direct_search(a, others[i])) ++i;
        return i;
    }
};

struct Trees {
    using Placed = PlacedTree;
    std::vector<std::unique_ptr<const Tree>> made;

    Trees(const std::vector<ClipPtr>& clips, const FitOptions& options) {
        for (const ClipPtr& clip : clips) made.push_back(std::make_unique<const Tree>(clip, options));
    }
    template <class Observer>
    static bool ask(const Placed& a, const Placed& b, Observer& observer) {
        return query(a, b, observer).has_value();
    }
    /// The first that collides, or how many there are.
    static std::size_t any(const Placed& a, std::span<const Placed> others) {
        std::size_t i = 0;
        while (i < others.size() && !query(a, others[i])) ++i;
        return i;
    }
};

struct BlockTrees {
    /// Blocks are timed; counts come from the tree that they belong to.
    struct Placed {
        Placed(const Tree& of, const Placement& placement) : tree(of, placement), blocks(*of.blocks(), placement) {}
        PlacedTree tree;
        PlacedBlocks blocks;
    };
    std::vector<std::unique_ptr<const Tree>> made;

    explicit BlockTrees(const std::vector<ClipPtr>& clips) {
        for (const ClipPtr& clip : clips)
            made.push_back(std::make_unique<const Tree>(clip, FitOptions{.tree = TreeKind::blocks}));
    }
    template <class Observer>
    static bool ask(const Placed& a, const Placed& b, [[maybe_unused]] Observer& observer) {
        if constexpr (Observer::watches) {
            return query(a.tree, b.tree, observer).has_value();
        } else {
            return intersects(a.blocks, b.blocks);
        }
    }
    static std::size_t any(const Placed& a, std::span<const Placed> others) {
        std::vector<const PlacedBlocks*> blocks;
        blocks.reserve(others.size());
        for (const Placed& other : others) blocks.push_back(&other.blocks);
        return intersects_any(a.blocks, blocks).value_or(others.size());
    }
};

template <class Method>
std::vector<typename Method::Placed> placed(const Method& method, const Workload& w) {
    std::vector<typename Method::Placed> out;
    out.reserve(w.sides.size());
    for (const auto& [clip, placement] : w.sides) out.emplace_back(*method.made[clip], placement);
    return out;
}

void report(benchmark::State& state, const TestCounts& tests, double queries) {
    for (const BoxKind kind : kBoxKinds) {
        if (tests[kind] > 0)
            state.counters[std::string(info(kind).heading)] = static_cast<double>(tests[kind]) / queries;
    }
    state.counters["samples"] = static_cast<double>(tests[TestKind::samples]) / queries;
}

/// Times the workload's queries one after the other, over and over. Its counters: tests a query, and the share of hits.
template <class Method>
void ask_all(benchmark::State& state, const Method& method, const Workload& w) {
    const auto sides = placed(method, w);
    Statistics statistics;
    int hits = 0;
    for (std::size_t i = 0; i < sides.size(); i += 2) hits += Method::ask(sides[i], sides[i + 1], statistics);
    const double queries = static_cast<double>(sides.size()) / 2;
    report(state, statistics.tests, queries);
    state.counters["hits_%"] = 100 * hits / queries;
    NoObserver nobody;
    std::size_t i = 0;
    for (auto _ : state) {
        benchmark::DoNotOptimize(Method::ask(sides[i], sides[i + 1], nobody));
        i = i + 2 < sides.size() ? i + 2 : 0;
    }
}

/// Does A collide with any of 32 B's? Asked in turn up to the first that does. Its counter: how many that were.
template <class Method>
void ask_any(benchmark::State& state, const Method& method, const Workload& w) {
    constexpr std::size_t kOthers = 32;
    std::vector<typename Method::Placed> first, others;
    for (std::size_t i = 0; i < w.sides.size(); ++i) {
        const auto& [clip, placement] = w.sides[i];
        (i % 2 == 0 ? first : others).emplace_back(*method.made[clip], placement);
    }
    const std::size_t batches = others.size() / kOthers;
    std::size_t i = 0;
    std::int64_t asked = 0;
    for (auto _ : state) {
        const std::size_t hit = Method::any(first[i], std::span(others).subspan(i % batches * kOthers, kOthers));
        asked += static_cast<std::int64_t>(std::min(hit + 1, kOthers));
        i = (i + 1) % first.size();
    }
    state.counters["asked"] = benchmark::Counter(static_cast<double>(asked), benchmark::Counter::kAvgIterations);
}

/// Of the queries' times, in ns.
struct Quantiles {
    double median, p90;
};

/// Each query is asked some times in a row for it: with its clips in the cache, and the branches foretold.
template <class Method>
Quantiles quantiles(const Method& method, const Workload& w) {
    const auto sides = placed(method, w);
    NoObserver nobody;
    std::vector<double> times;
    for (std::size_t i = 0; i < sides.size(); i += 2) {
        const auto time = [&](int repeats) {
            using Clock = std::chrono::steady_clock;
            const auto begin = Clock::now();
            for (int k = 0; k < repeats; ++k) benchmark::DoNotOptimize(Method::ask(sides[i], sides[i + 1], nobody));
            return std::chrono::duration<double, std::nano>(Clock::now() - begin).count() / repeats;
        };
        const int repeats = std::clamp(static_cast<int>(5000 / time(1)), 1, 64);
        double least = time(repeats);
        for (int turn = 1; turn < 5; ++turn) least = std::min(least, time(repeats));
        times.push_back(least);
    }
    std::sort(times.begin(), times.end());
    return {times[times.size() / 2], times[times.size() * 9 / 10]};
}

// Workloads --------------------------------------------------------------------------------------------------------

/// Fourteen walks in a room, and pairs near each other.
WorkloadPtr in_a_room(double seconds, Motion motion) {
    test::Random random(7);
    Workload w;
    for (int i = 0; i < 14; ++i) {
        const ClipPtr held = bench::walk(random, seconds);
        w.clips.push_back(std::make_shared<const Clip>(
            held->dt(), std::vector(held->samples().begin(), held->samples().end()), motion));
    }
    for (int i = 0; i < 4096; ++i) {
        const auto clip = static_cast<std::size_t>(random.integer(0, 13));
        w.sides.push_back({clip, bench::somewhere(random, i % 2 ? seconds : 0)});
    }
    return std::make_shared<const Workload>(std::move(w));
}

/// Walks that go where they like, so that their area grows with the path. Pairs are placed at random over that area and
/// overlap in time for at least half of it.
WorkloadPtr at_random(double seconds) {
    test::Random random(3);
    Workload w;
    std::vector<bench::Extent> extents;
    for (int i = 0; i < 12; ++i) {
        w.clips.push_back(bench::wander(random, seconds));
        extents.push_back(bench::extent_of(*w.clips.back()));
    }
    for (int i = 0; i < 501; ++i) {
        const auto a = static_cast<std::size_t>(random.integer(0, 11)),
                   b = static_cast<std::size_t>(random.integer(0, 11));
        // B's middle anywhere within A's rectangle, or a little beyond: else the shortest clips would always collide.
        const glm::dvec2 far = extents[a].half + 1.5;
        const double turn = random.real(0, 360);
        const glm::dvec2 to = extents[a].middle + far * glm::dvec2{random.real(-1, 1), random.real(-1, 1)};
        w.sides.push_back({a, {}});
        w.sides.push_back({b,
                           {.translate = to - Rotation::from_degrees(turn)(extents[b].middle),
                            .rotate_deg = turn,
                            .start = random.real(-0.5, 0.5) * seconds}});
    }
    return std::make_shared<const Workload>(std::move(w));
}

/// Pairs that walk the same way a metre apart and never touch.
WorkloadPtr side_by_side(double seconds) {
    test::Random random(4);
    Workload w;
    for (std::size_t i = 0; i < 4; ++i) {
        w.clips.push_back(bench::wander(random, seconds));
        w.sides.push_back({i, {}});
        w.sides.push_back({i, {.translate = {1, 0}, .start = 0.01}});
    }
    return std::make_shared<const Workload>(std::move(w));
}

/// So many clips of two seconds, of which the pairs are drawn at random.
WorkloadPtr of_many(int clips) {
    test::Random random(5);
    Workload w;
    for (int i = 0; i < clips; ++i) w.clips.push_back(bench::walk(random, 2));
    for (int i = 0; i < 2 * 32768; ++i) {
        const auto clip = static_cast<std::size_t>(random.integer(0, clips - 1));
        w.sides.push_back({clip, bench::somewhere(random, i % 2 ? 2 : 0)});
    }
    return std::make_shared<const Workload>(std::move(w));
}

/// Walks of 42 s in a room, together in time, with B within so many metres.
WorkloadPtr within(double metres) {
    test::Random random(6);
    Workload w;
    for (int i = 0; i < 14; ++i) w.clips.push_back(bench::walk(random, 42));
    for (int i = 0; i < 2048; ++i) {
        w.sides.push_back({static_cast<std::size_t>(random.integer(0, 13)), {}});
        w.sides.push_back({static_cast<std::size_t>(random.integer(0, 13)),
                           {.translate = {random.real(-metres, metres), random.real(-metres, metres)},
                            .rotate_deg = random.real(0, 360),
                            .start = random.real(-20, 20)}});
    }
    return std::make_shared<const Workload>(std::move(w));
}

/// As in_a_room for 42 s, with B's samples so many times as far apart as A's.
WorkloadPtr with_spacing(double ratio) {
    test::Random random(8);
    Workload w;
    for (int i = 0; i < 14; ++i) w.clips.push_back(bench::walk(random, 42));
    for (std::size_t i = 0; i < 14; ++i) {
        const Clip& clip = *w.clips[i];
        std::vector<Disk> samples;
        for (double at = 0; at < clip.count(); at += ratio)
            samples.push_back(clip.samples()[static_cast<std::size_t>(at)]);
        w.clips.push_back(std::make_shared<const Clip>(clip.dt() * ratio, std::move(samples)));
    }
    for (int i = 0; i < 2048; ++i) {
        w.sides.push_back({static_cast<std::size_t>(random.integer(0, 13)), bench::somewhere(random, 0)});
        w.sides.push_back({static_cast<std::size_t>(random.integer(14, 27)), bench::somewhere(random, 42)});
    }
    return std::make_shared<const Workload>(std::move(w));
}

// What is measured -------------------------------------------------------------------------------------------------

/// Made once, when it is first asked for.
template <class Make>
auto once(Make make) {
    return [make, made = std::make_shared<WorkloadPtr>()] {
        if (!*made) *made = make();
        return *made;
    };
}

using MakeWorkload = std::function<WorkloadPtr()>;

void add(const std::string& name, std::function<void(benchmark::State&)> measure) {
    benchmark::RegisterBenchmark(name.c_str(), [measure](benchmark::State& state) { measure(state); });
}

/// The methods that one chooses between, by ask_all. With `by_query` also the quantiles of the queries' times.
void add_methods(const std::string& name, const std::string& label, const MakeWorkload& workload, bool by_query) {
    const auto add_one = [&](const std::string& method_name, auto make) {
        const auto found = std::make_shared<std::optional<Quantiles>>();
        add(name + "/" + method_name + "/" + label, [=](benchmark::State& state) {
            const WorkloadPtr w = workload();
            const auto method = make(w->clips);
            ask_all(state, method, *w);
            if (!by_query) return;
            // The library calls this several times to find out how often to ask.
            if (!*found) *found = quantiles(method, *w);
            state.counters["median_ns"] = (*found)->median;
            state.counters["p90_ns"] = (*found)->p90;
        });
    };
    const auto trees = [](const FitOptions& options) {
        return [options](const std::vector<ClipPtr>& clips) { return Trees(clips, options); };
    };
    add_one("direct", [](const std::vector<ClipPtr>& clips) { return DirectSearch(clips); });
    add_one("blocks", [](const std::vector<ClipPtr>& clips) { return BlockTrees(clips); });
    add_one("mobb_1level", trees({.levels = 1}));
    add_one("mobb_leaf10", trees({.leaf = 10}));
    add_one("mobb_leaf50", trees({.leaf = 50}));
}

/// Queries one by one, about one against many, and recorded, by what make(clips) makes.
template <class Make>
void add_asked(const std::string& label, const MakeWorkload& workload, Make make) {
    add("query/" + label, [=](benchmark::State& state) {
        const WorkloadPtr w = workload();
        ask_all(state, make(w->clips), *w);
    });
    add("any/" + label, [=](benchmark::State& state) {
        const WorkloadPtr w = workload();
        ask_any(state, make(w->clips), *w);
    });
    add("trace/" + label, [=](benchmark::State& state) {
        const WorkloadPtr w = workload();
        const auto method = make(w->clips);
        const auto sides = placed(method, *w);
        TraceRecorder recorder;
        std::int64_t events = 0;
        std::size_t i = 0;
        for (auto _ : state) {
            method.ask(sides[i], sides[i + 1], recorder);
            events += recorder.take().size();
            i = (i + 2) % sides.size();
        }
        state.counters["events"] = benchmark::Counter(static_cast<double>(events), benchmark::Counter::kAvgIterations);
    });
}

void add_queries(const std::string& length, const MakeWorkload& workload) {
    add_asked("direct/" + length, workload, [](const std::vector<ClipPtr>& clips) { return DirectSearch(clips); });
    add_asked("blocks/" + length, workload, [](const std::vector<ClipPtr>& clips) { return BlockTrees(clips); });
    for (const TreeKind kind : test::kFittedTrees) {
        for (const int levels : {1, 0}) {
            const FitOptions options{.tree = kind, .levels = levels};
            add_asked(std::string(name(kind)) + (levels ? "_1level/" : "/") + length, workload,
                      [options](const std::vector<ClipPtr>& clips) { return Trees(clips, options); });
        }
    }
}

/// Builds what make(clip) makes over the first clip. Its counter `per_sample`: seconds.
template <class Make>
void add_fit(const std::string& name, const MakeWorkload& workload, Make make) {
    add(name, [=](benchmark::State& state) {
        const ClipPtr clip = workload()->clips.front();
        for (auto _ : state) benchmark::DoNotOptimize(make(clip));
        state.counters["per_sample"] = benchmark::Counter(
            clip->count(), benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
    });
}

auto tree_of(const FitOptions& options) {
    return [options](const ClipPtr& clip) { return Tree(clip, options); };
}
Blocks blocks_of(const ClipPtr& clip) { return Blocks(clip); }

void add_fits(const std::string& length, const MakeWorkload& workload) {
    for (const Axes axes : {Axes::endpoints, Axes::covariance, Axes::minarea}) {
        for (const TreeKind kind : test::kFittedTrees) {
            const std::string label = std::string(name(kind)) + "/" + std::string(name(axes)) + "/" + length;
            add_fit("fit/" + label, workload, tree_of({.tree = kind, .axes = axes}));
        }
    }
    add_fit("fit/blocks/" + length, workload, blocks_of);
}

const bool registered = [] {
    for (const Motion motion : {Motion::held, Motion::linear}) {
        for (const double seconds : {42.0, 2.1}) {
            const MakeWorkload workload = once([=] { return in_a_room(seconds, motion); });
            const std::string length =
                std::string(seconds > 10 ? "42s" : "2s") + (motion == Motion::held ? "" : "_linear");
            add_queries(length, workload);
            add_fits(length, workload);
        }
    }
    for (const int seconds : {1, 4, 15, 60, 240, 900, 3600}) {
        const std::string label = std::to_string(seconds) + "s";
        const MakeWorkload random = once([=] { return at_random(seconds); });
        add_methods("grow/random", label, random, true);
        for (const TreeKind kind : {TreeKind::mobb, TreeKind::umobb}) {
            add_fit("grow/fit/" + std::string(name(kind)) + "/" + label, random, tree_of({.tree = kind}));
        }
        add_fit("grow/fit/blocks/" + label, random, blocks_of);
        add_methods("grow/side_by_side", label, once([=] { return side_by_side(seconds); }), false);
    }
    for (const int clips : {16, 256, 4096, 32768}) {
        add_methods("grow/clips", std::to_string(clips), once([=] { return of_many(clips); }), false);
    }
    for (const double metres : {2.0, 4.0, 6.0, 10.0}) {
        add_methods("grow/hits", "within" + std::to_string(static_cast<int>(metres)) + "m",
                    once([=] { return within(metres); }), false);
    }
    for (const auto& [label, ratio] :
         std::map<std::string, double>{{"1", 1}, {"1.001", 1.001}, {"1.25", 1.25}, {"2", 2}, {"10", 10}}) {
        add_methods("grow/dt", label, once([r = ratio] { return with_spacing(r); }), false);
    }
    return true;
}();

}  // namespace
