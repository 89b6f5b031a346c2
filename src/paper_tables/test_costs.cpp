#include <base/thread_clock.h>
#include <mobb/placed_tree.h>
#include <mobb/query.h>
#include <mobb/separation.h>
#include <paper_tables/test_costs.h>

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

namespace mobbscope {

namespace {

constexpr std::size_t kMostPairs = 20000;
constexpr std::size_t kMostSearched = 2000;  // queries of the direct search
constexpr double kLeastSeconds = 0.1;        // of measuring: long enough for the clock, short enough to wait for

/// Two boxes as a query tested them.
struct BoxPair {
    mobb::Box a, b;
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
        const auto [a, b] = placed(trees, query);
        Collector collector;
        collector.kind = kind;
        mobb::query(a, b, collector);
        if (collector.tested.empty()) continue;
        for (const auto& [ia, ib] : collector.tested) {
            out.pairs.push_back({a.tree().box(ia), b.tree().box(ib), out.frames.size()});
        }
        out.frames.emplace_back(a.frame(), b.frame(), a.time_scale());
    }
    return out;
}

/// Nanoseconds of one of the `calls` that a round makes, in round after round. It says how many of them found
/// something: used here, so that the tests are not thought needless.
double time_rounds(std::int64_t calls, const auto& round) {
    std::int64_t rounds = 0, found = 0;
    const auto begin = ThreadClock::now();
    do {
        found += round();
        ++rounds;
    } while (nanoseconds(ThreadClock::now() - begin) < kLeastSeconds * 1e9);
    const double spent = nanoseconds(ThreadClock::now() - begin);
    return found <= calls * rounds ? spent / static_cast<double>(calls * rounds) : 0;
}

std::optional<double> time_pairs(const BoxPairs& pairs, const mobb::PairTest& test) {
    if (pairs.pairs.empty()) return std::nullopt;
    return time_rounds(static_cast<std::int64_t>(pairs.pairs.size()), [&] {
        std::int64_t separated = 0;
        for (const BoxPair& pair : pairs.pairs) {
            separated += test.separate(pair.a, pair.b, pairs.frames[pair.frame]).separated() ? 1 : 0;
        }
        return separated;
    });
}

std::optional<double> time_box_tests(const Workload& workload, mobb::FitOptions options, mobb::BoxKind box) {
    const auto below = [](mobb::TreeKind kind) { return mobb::info(kind).below; };
    options.tree = *std::ranges::find(mobb::kTreeKinds, box, below);
    options.levels = 0;
    const std::vector<mobb::Tree> trees = trees_of(workload, options);
    return time_pairs(collect(trees, workload, box), *std::ranges::find(mobb::kPairTests, box, &mobb::PairTest::test));
}

std::optional<double> time_sample_pairs(const Workload& workload) {
    // Queries that are apart in time would be timed for nothing.
    std::vector<std::pair<mobb::PlacedClip, mobb::PlacedClip>> searched;
    std::int64_t pairs = 0;
    for (const WorkloadQuery& query : workload.queries) {
        if (searched.size() == kMostSearched) break;
        const auto [a, b] = placed(workload, query);
        mobb::Statistics counts;
        mobb::direct_search(a, b, counts);
        if (counts.tests[mobb::TestKind::samples] == 0) continue;
        pairs += counts.tests[mobb::TestKind::samples];
        searched.emplace_back(a, b);
    }
    if (searched.empty()) return std::nullopt;
    return time_rounds(pairs, [&] {
        std::int64_t hits = 0;
        for (const auto& [a, b] : searched) hits += mobb::direct_search(a, b) ? 1 : 0;
        return hits;
    });
}

}  // namespace

TestCosts measure_test_costs(const Workload& workload, const mobb::FitOptions& base) {
    TestCosts costs;
    for (const mobb::BoxKind kind : mobb::kBoxKinds) costs[kind] = time_box_tests(workload, base, kind);
    costs.sample_pair = time_sample_pairs(workload);
    return costs;
}

}  // namespace mobbscope
