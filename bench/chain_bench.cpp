/// Chains composed of their clips' trees beside trees rebuilt over all samples, and beside one query for each two clips
/// of theirs that overlap in time: time to build, tests and time per query.
#include <benchmark/benchmark.h>
#include <mobb/placed_chain.h>
#include <mobb/query.h>

#include <algorithm>
#include <cstddef>
#include <map>
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

/// One link at the end of a chain of so many, whose past is dropped again at the same quality.
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
    struct Side {
        std::size_t chain;
        Placement placement;
    };
    std::vector<std::vector<ChainLink>> links;  ///< by chain
    std::vector<Chain> chains;
    std::vector<Tree> rebuilt;
    std::vector<Side> sides;  ///< two a query

    explicit Queries(int count) {
        test::Random random(8);
        for (int i = 0; i < 12; ++i) {
            links.push_back(workload().links(random, count));
            chains.emplace_back(links.back());
            rebuilt.emplace_back(std::make_shared<const Clip>(flattened(chains.back())), FitOptions{});
        }
        for (int i = 0; i < 2048; ++i) {
            const auto chain = static_cast<std::size_t>(random.integer(0, 11));
            sides.push_back({chain, bench::somewhere(random, i % 2 ? chains[chain].duration() : 0)});
        }
    }

    template <class Placed, class Sources>
    std::vector<Placed> placed(const Sources& sources) const {
        std::vector<Placed> out;
        for (const Side& side : sides) out.emplace_back(sources[side.chain], side.placement);
        return out;
    }
    /// Each clip of a side's chain by itself.
    std::vector<std::vector<PlacedTree>> placed_segments() const {
        std::vector<std::vector<PlacedTree>> out;
        for (const Side& side : sides) {
            out.emplace_back();
            const Rotation rotation = side.placement.rotation();
            const Chain& chain = chains[side.chain];
            for (int k = 0; k < chain.links(); ++k) {
                const ChainLink& link = links[side.chain][static_cast<std::size_t>(k)];
                const Placement there{.translate = rotation(link.translate) + side.placement.translate,
                                      .rotate_deg = side.placement.rotate_deg + link.rotate_deg,
                                      .start = side.placement.start + chain.first_sample(k) * chain.dt()};
                out.back().emplace_back(link.part->tree(), there);
            }
        }
        return out;
    }
};

const Queries& queries(int links) {
    static std::map<int, Queries> made;
    return made.try_emplace(links, links).first->second;
}

template <NodeSource Placed, TraversalObserver Observer>
bool collide_ever(const Placed& a, const Placed& b, Observer& observer) {
    return query(a, b, observer).has_value();
}

/// One query for each two segments that overlap in time, in order of time, up to the first hit.
template <TraversalObserver Observer>
bool collide_ever(const std::vector<PlacedTree>& a, const std::vector<PlacedTree>& b, Observer& observer) {
    std::size_t i = 0, j = 0;
    while (i < a.size() && j < b.size()) {
        const double end_a = a[i].end(a[i].node(0)), end_b = b[j].end(b[j].node(0));
        if (overlap_in_time(a[i].begin(a[i].node(0)), end_a, b[j].begin(b[j].node(0)), end_b) &&
            query(a[i], b[j], observer).has_value()) {
            return true;
        }
        ++(end_a < end_b ? i : j);
    }
    return false;
}

template <class Placed>
void ask(benchmark::State& state, const std::vector<Placed>& placed) {
    Statistics statistics;
    int hits = 0;
    for (std::size_t i = 0; i < placed.size(); i += 2) hits += collide_ever(placed[i], placed[i + 1], statistics);
    const double count = static_cast<double>(placed.size()) / 2;
    state.counters["2D"] = static_cast<double>(statistics.tests[BoxKind::obb2d]) / count;
    state.counters["time"] = static_cast<double>(statistics.tests[TestKind::time]) / count;
    state.counters["samples"] = static_cast<double>(statistics.tests[TestKind::samples]) / count;
    state.counters["hits"] = hits / count;
    NoObserver nobody;
    std::size_t i = 0;
    for (auto _ : state) {
        benchmark::DoNotOptimize(collide_ever(placed[i], placed[i + 1], nobody));
        i = (i + 2) % placed.size();
    }
}

void query_composed(benchmark::State& state) {
    const Queries& q = queries(static_cast<int>(state.range(0)));
    ask(state, q.placed<PlacedChain>(q.chains));
}
void query_rebuilt(benchmark::State& state) {
    const Queries& q = queries(static_cast<int>(state.range(0)));
    ask(state, q.placed<PlacedTree>(q.rebuilt));
}
void query_segments(benchmark::State& state) {
    ask(state, queries(static_cast<int>(state.range(0))).placed_segments());
}

BENCHMARK(compose)->Arg(10)->Arg(100)->Arg(1000)->Arg(10000)->Unit(benchmark::kMicrosecond);
BENCHMARK(rebuild)->Arg(10)->Arg(100)->Arg(1000)->Unit(benchmark::kMicrosecond);
BENCHMARK(append_one)->Arg(10)->Arg(1000);
BENCHMARK(part)->Unit(benchmark::kMicrosecond);
BENCHMARK(tree)->Unit(benchmark::kMicrosecond);
#define FOR_CHAINS(f) BENCHMARK(f)->Arg(2)->Arg(4)->Arg(8)->Arg(32)->Arg(200)
FOR_CHAINS(query_composed);
FOR_CHAINS(query_rebuilt);
FOR_CHAINS(query_segments);

}  // namespace
