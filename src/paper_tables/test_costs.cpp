#include <mobb/placed_tree.h>
#include <mobb/query.h>
#include <mobb/separation.h>
#include <paper_tables/test_costs.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <utility>
#include <vector>

namespace mobbscope {

namespace {

using Clock = std::chrono::steady_clock;

constexpr std::size_t kMostPairs = 20000;
constexpr std::size_t kMostSearched = 2000;  // queries of the direct search
constexpr double kLeastSeconds = 0.1;        // of measuring: long enough for the clock, short enough to wait for

double nanoseconds(Clock::duration duration) { return std::chrono::duration<double, std::nano>(duration).count(); }

/// Two boxes as a query tested them.
struct BoxPair {
    const mobb::Box* a;
    const mobb::Box* b;
    std::size_t frame;  ///< index of the query's frame
};

struct BoxPairs {
    std::vector<mobb::RelativeFrame> frames;
    std::vector<BoxPair> pairs;
};

/// Notes which nodes' boxes of one kind were tested.
struct Collector : mobb::ObserverBase {
    mobb::BoxKind kind = mobb::BoxKind::obb2d;
    std::vector<std::pair<int, int>> entered, tested;

    void enter(int a, int b) { entered.emplace_back(a, b); }
    void leave() { entered.pop_back(); }
    void box_test(mobb::BoxKind test, const mobb::Separation&) {
        if (test == kind) tested.push_back(entered.back());
    }
};

BoxPairs collect(const std::vector<mobb::Tree>& trees, const Workload& workload, mobb::BoxKind kind) {
    BoxPairs out;
    for (const WorkloadQuery& query : workload.queries) {
        if (out.pairs.size() >= kMostPairs) break;
        const mobb::PlacedTree a(trees[static_cast<std::size_t>(query.clip_a)], query.a);
        const mobb::PlacedTree b(trees[static_cast<std::size_t>(query.clip_b)], query.b);
        Collector collector;
        collector.kind = kind;
        mobb::query(a, b, collector);
        if (collector.tested.empty()) continue;
        for (const auto& [ia, ib] : collector.tested) {
            out.pairs.push_back({&a.node(ia).box, &b.node(ib).box, out.frames.size()});
        }
        out.frames.emplace_back(a.frame(), b.frame(), a.time_scale());
    }
    return out;
}

/// Nanoseconds of one call of the test on a pair, over all pairs again and again.
std::optional<double> time_pairs(const BoxPairs& pairs, const mobb::PairTest& test) {
    if (pairs.pairs.empty()) return std::nullopt;
    std::int64_t calls = 0, separated = 0;
    const auto begin = Clock::now();
    do {
        for (const BoxPair& pair : pairs.pairs) {
            separated += test.separate(*pair.a, *pair.b, pairs.frames[pair.frame]).separated() ? 1 : 0;
        }
        calls += static_cast<std::int64_t>(pairs.pairs.size());
    } while (nanoseconds(Clock::now() - begin) < kLeastSeconds * 1e9);
    const double spent = nanoseconds(Clock::now() - begin);
    // The answers are used, so that the tests are not thought needless.
    return separated <= calls ? spent / static_cast<double>(calls) : 0;
}

std::optional<double> time_box_tests(const Workload& workload, mobb::FitOptions options, mobb::BoxKind box) {
    const auto below = [](mobb::TreeKind kind) { return mobb::info(kind).below; };
    options.tree = *std::ranges::find(mobb::kTreeKinds, box, below);
    options.levels = 0;
    std::vector<mobb::Tree> trees;
    trees.reserve(workload.clips.size());
    for (const mobb::ClipPtr& clip : workload.clips) trees.emplace_back(clip, options);
    return time_pairs(collect(trees, workload, box), *std::ranges::find(mobb::kPairTests, box, &mobb::PairTest::test));
}

std::optional<double> time_sample_pairs(const Workload& workload) {
    // Queries that are apart in time would be timed for nothing.
    std::vector<std::pair<mobb::PlacedClip, mobb::PlacedClip>> searched;
    std::int64_t pairs = 0;
    for (const WorkloadQuery& query : workload.queries) {
        if (searched.size() == kMostSearched) break;
        const mobb::PlacedClip a(*workload.clips[static_cast<std::size_t>(query.clip_a)], query.a);
        const mobb::PlacedClip b(*workload.clips[static_cast<std::size_t>(query.clip_b)], query.b);
        mobb::Statistics counts;
        mobb::direct_search(a, b, counts);
        if (counts.tests[mobb::TestKind::samples] == 0) continue;
        pairs += counts.tests[mobb::TestKind::samples];
        searched.emplace_back(a, b);
    }
    if (searched.empty()) return std::nullopt;
    std::int64_t measured = 0, hits = 0;
    const auto begin = Clock::now();
    do {
        for (const auto& [a, b] : searched) hits += mobb::direct_search(a, b) ? 1 : 0;
        measured += pairs;
    } while (nanoseconds(Clock::now() - begin) < kLeastSeconds * 1e9);
    const double spent = nanoseconds(Clock::now() - begin);
    return hits <= measured ? spent / static_cast<double>(measured) : 0;
}

}  // namespace

TestCosts measure_test_costs(const Workload& workload, const mobb::FitOptions& base) {
    TestCosts costs;
    for (const mobb::BoxKind kind : mobb::kBoxKinds) costs[kind] = time_box_tests(workload, base, kind);
    costs.sample_pair = time_sample_pairs(workload);
    return costs;
}

}  // namespace mobbscope
