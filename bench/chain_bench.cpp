/// Chains composed of their clips' trees beside trees rebuilt over all samples: time to build, tests and time per
/// query.
#include <benchmark/benchmark.h>
#include <mobb/placed_chain.h>
#include <mobb/query.h>

#include <algorithm>
#include <vector>

#include "walks.h"

namespace {

using namespace mobb;

/// Parts of two-second walks, and links that play them at random, each where the one before ends and the way it goes.
struct Workload {
    std::vector<ChainPartPtr> parts;

    explicit Workload(test::Random& random) {
        for (int i = 0; i < 50; ++i) {
            const auto tree = std::make_shared<const Tree>(bench::walk(random, random.real(1, 4)), FitOptions{});
            parts.push_back(std::make_shared<const ChainPart>(tree));
        }
    }
    std::vector<ChainLink> links(test::Random& random, int count) const {
        std::vector<ChainLink> out;
        glm::dvec2 end{0};
        for (int k = 0; k < count; ++k) {
            const ChainPartPtr& part = parts[static_cast<std::size_t>(random.integer(0, 49))];
            // Back towards the middle when the floor (20 x 20 m) ends.
            const std::span<const Disk> samples = part->clip().samples();
            ChainLink best;
            glm::dvec2 best_end{1e9};
            for (int attempt = 0; attempt < 3; ++attempt) {
                const double turn = random.real(-180, 180);
                const Rotation rotation = Rotation::from_degrees(turn);
                const glm::dvec2 from = rotation({samples.front().x, samples.front().y});
                const glm::dvec2 to = end - from + rotation({samples.back().x, samples.back().y});
                const auto outside = [](glm::dvec2 p) { return std::max({std::abs(p.x), std::abs(p.y), 10.0}); };
                if (attempt == 0 || outside(to) < outside(best_end)) {
                    best = {part, end - from, turn};
                    best_end = to;
                }
            }
            out.push_back(best);
            end = best_end;
        }
        return out;
    }
};

const Workload& workload() {
    static const Workload w = [] {
        test::Random random(5);
        return Workload(random);
    }();
    return w;
}

std::vector<ChainLink> some_links(int count) {
    test::Random random(6);
    return workload().links(random, count);
}

void compose(benchmark::State& state) {
    const std::vector<ChainLink> links = some_links(static_cast<int>(state.range(0)));
    for (auto _ : state) benchmark::DoNotOptimize(Chain(links));
}

void rebuild(benchmark::State& state) {
    const Chain chain(some_links(static_cast<int>(state.range(0))));
    for (auto _ : state) {
        benchmark::DoNotOptimize(Tree(std::make_shared<const Clip>(flattened(chain)), FitOptions{}));
    }
}

/// One link at the end of a chain of so many, whose past is dropped again at the same pace.
void append_one(benchmark::State& state) {
    const std::vector<ChainLink> links = some_links(static_cast<int>(state.range(0)));
    Chain chain(links);
    std::size_t next = 0;
    int appended = 0;
    for (auto _ : state) {
        chain.append(links[next]);
        next = (next + 1) % links.size();
        if (++appended < state.range(0)) continue;
        chain.drop_before(chain.first_sample(appended) * chain.dt());
        appended = 0;
    }
}

/// What is done once per clip: its tree, and the part that chains are made of.
void tree(benchmark::State& state) {
    const ClipPtr& clip = workload().parts.front()->tree().shared_clip();
    for (auto _ : state) benchmark::DoNotOptimize(Tree(clip, FitOptions{}));
}
void part(benchmark::State& state) {
    const auto tree = std::make_shared<const Tree>(workload().parts.front()->tree().shared_clip(), FitOptions{});
    for (auto _ : state) benchmark::DoNotOptimize(ChainPart(tree));
}

/// Chains, and queries between them: side by side on the floor, apart in time by up to their length.
struct Queries {
    std::vector<Chain> chains;
    std::vector<Tree> rebuilt;
    std::vector<std::pair<std::size_t, Placement>> sides;

    explicit Queries(int links) {
        test::Random random(8);
        for (int i = 0; i < 12; ++i) {
            chains.emplace_back(workload().links(random, links));
            rebuilt.emplace_back(std::make_shared<const Clip>(flattened(chains.back())), FitOptions{});
        }
        for (int i = 0; i < 2048; ++i) {
            const auto chain = static_cast<std::size_t>(random.integer(0, 11));
            sides.emplace_back(chain, bench::somewhere(random, i % 2 ? chains[chain].duration() : 0));
        }
    }
};

const Queries& queries(int links) {
    static const Queries few(8), many(200);
    return links == 8 ? few : many;
}

template <class Placed, class Sources>
void ask(benchmark::State& state, const Sources& sources, const Queries& q) {
    std::vector<Placed> placed;
    for (const auto& [chain, placement] : q.sides) placed.emplace_back(sources[chain], placement);
    Statistics statistics;
    int hits = 0;
    for (std::size_t i = 0; i < placed.size(); i += 2) {
        hits += query(placed[i], placed[i + 1], statistics).has_value();
    }
    const double count = static_cast<double>(placed.size()) / 2;
    state.counters["2D"] = static_cast<double>(statistics.tests[BoxKind::obb2d]) / count;
    state.counters["time"] = static_cast<double>(statistics.tests[TestKind::time]) / count;
    state.counters["samples"] = static_cast<double>(statistics.tests[TestKind::samples]) / count;
    state.counters["hits"] = hits / count;
    std::size_t i = 0;
    for (auto _ : state) {
        benchmark::DoNotOptimize(query(placed[i], placed[i + 1]));
        i = (i + 2) % placed.size();
    }
}

void query_composed(benchmark::State& state) {
    const Queries& q = queries(static_cast<int>(state.range(0)));
    ask<PlacedChain>(state, q.chains, q);
}
void query_rebuilt(benchmark::State& state) {
    const Queries& q = queries(static_cast<int>(state.range(0)));
    ask<PlacedTree>(state, q.rebuilt, q);
}

BENCHMARK(compose)->Arg(10)->Arg(100)->Arg(1000)->Arg(10000)->Unit(benchmark::kMicrosecond);
BENCHMARK(rebuild)->Arg(10)->Arg(100)->Arg(1000)->Unit(benchmark::kMicrosecond);
BENCHMARK(append_one)->Arg(10)->Arg(1000);
BENCHMARK(part)->Unit(benchmark::kMicrosecond);
BENCHMARK(tree)->Unit(benchmark::kMicrosecond);
BENCHMARK(query_composed)->Arg(8)->Arg(200);
BENCHMARK(query_rebuilt)->Arg(8)->Arg(200);

}  // namespace
