/// What sweeps rest on, measured on this machine. Files or folders of clips after the first word:
///
///     bench_advice prices PATH...   what each test costs, from times and counts of many fits: kTestPrices
///     bench_advice check PATH...    how far what a sweep recommends is from the best of all its fits, measured again
#include <base/random.h>
#include <base/thread_clock.h>
#include <explain/fit_sweep.h>
#include <explain/tree_cost.h>
#include <mobb/query.h>
#include <scene/load_files.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <memory>
#include <span>
#include <utility>
#include <vector>

namespace {

using namespace mobbscope;

FitTrees fit_all(std::span<const mobb::ClipPtr> clips, const mobb::FitOptions& fit) {
    FitTrees out;
    for (const mobb::ClipPtr& clip : clips) out.push_back(std::make_shared<const mobb::Tree>(clip, fit));
    return out;
}

// --- prices

/// Tests of a query, and its time.
struct Paid {
    MeanTests tests;
    double ns;
};

/// Prices of all kinds but that of times, which is given: least squares of the relative error.
MeanTests fitted_prices(const std::vector<Paid>& all, double of_time) {
    constexpr std::size_t n = mobb::kTestKindCount;
    std::array<std::array<double, n + 1>, n> rows{};
    for (const Paid& paid : all) {
        const double rest = 1 - paid.tests[mobb::TestKind::time] * of_time / paid.ns;
        for (std::size_t i = 1; i < n; ++i) {
            for (std::size_t j = 1; j < n; ++j)
                rows[i][j] += paid.tests.by_kind[i] * paid.tests.by_kind[j] / paid.ns / paid.ns;
            rows[i][n] += paid.tests.by_kind[i] / paid.ns * rest;
        }
    }
    MeanTests out;
    out[mobb::TestKind::time] = of_time;
    for (std::size_t i = 1; i < n; ++i) {  // Gauss and Jordan; what no fit tests stays 0
        if (rows[i][i] <= 0) continue;
        for (std::size_t k = 1; k < n; ++k) {
            if (k == i) continue;
            const double factor = rows[k][i] / rows[i][i];
            for (std::size_t j = 1; j <= n; ++j) rows[k][j] -= factor * rows[i][j];
        }
    }
    for (std::size_t i = 1; i < n; ++i) out.by_kind[i] = rows[i][i] > 0 ? rows[i][n] / rows[i][i] : 0;
    return out;
}

void print_prices(const std::vector<mobb::ClipPtr>& clips) {
    std::vector<Paid> all;
    for (const mobb::ClipPtr& clip : clips) {
        const std::array one{clip};
        const QueryWorkload workload = standard_workload(one, 6000, kCountedSeed);
        std::vector<FitTrees> fits;
        for (const mobb::TreeKind tree : mobb::kTreeKinds) {
            if (mobb::info(tree).has_blocks()) continue;
            for (const int leaf : {1, 3, 10, 30, 100}) fits.push_back(fit_all(one, {.tree = tree, .leaf = leaf}));
        }
        const FitTimes times = time_fits(fits, workload.queries, true, Protocol::warm, time_queries, [] {});
        for (std::size_t i = 0; i < fits.size(); ++i)
            all.push_back({mean_tests(count_tests(workload, fits[i])), times.fits[i].ns});
    }
    const MeanTests prices = fitted_prices(all, kTestPrices[mobb::TestKind::time]);
    double squares = 0, before = 0;
    for (const Paid& paid : all) {
        squares += std::pow(cost_of(paid.tests, prices) / paid.ns - 1, 2);
        before += std::pow(cost_of(paid.tests) / paid.ns - 1, 2);
    }
    const auto error = [&](double sum) { return 100 * std::sqrt(sum / static_cast<double>(all.size())); };
    std::printf("ns a test, of %zu fits; in the source:\n", all.size());
    const auto print = [&](const char* name, mobb::TestKind kind) {
        std::printf("  %-8s %6.2f  %6.2f\n", name, prices[kind], kTestPrices[kind]);
    };
    print("time", mobb::TestKind::time);
    for (const mobb::BoxKind kind : mobb::kBoxKinds) {
        if (!std::isnan(kTestPrices[kind])) print(mobb::info(kind).heading.data(), kind);
    }
    print("samples", mobb::TestKind::samples);
    std::printf("  error of a fit's time %.0f %%, of the prices in the source %.0f %%\n", error(squares),
                error(before));
}

// --- check

/// By itself, not by what sweeps measure with: the median of rounds of all fits in turns; cold after other memory was
/// read.
std::vector<double> measured_again(const std::vector<FitTrees>& fits, std::span<const ClipQuery> queries,
                                   Protocol protocol) {
    const std::size_t rounds_of = protocol == Protocol::cold ? 3 : 5;
    std::vector<unsigned char> other(protocol == Protocol::cold ? std::size_t{2} << 20 : 0, 1);
    const std::size_t count = std::min<std::size_t>(queries.size(), protocol == Protocol::cold ? 200 : 4096);
    volatile unsigned used = 0;
    std::vector<std::vector<double>> rounds(fits.size());
    std::vector<std::size_t> turns(fits.size());
    for (std::size_t i = 0; i < turns.size(); ++i) turns[i] = i;
    Uniform uniform(7);
    const auto ask = [&](const auto& a, const auto& b) { used = used + (mobb::query(a, b) ? 1U : 0U); };
    const auto ask_in = [&](const FitTrees& trees, const ClipQuery& query, bool timed) {
        const mobb::Tree& a = *trees[static_cast<std::size_t>(query.clip_a)];
        const mobb::Tree& b = *trees[static_cast<std::size_t>(query.clip_b)];
        const auto time = [&](const auto& placed_a, const auto& placed_b) {
            for (std::size_t i = 0; i < other.size(); i += 64) used = used + other[i];
            const auto begin = std::chrono::steady_clock::now();
            ask(placed_a, placed_b);
            const auto taken = std::chrono::steady_clock::now() - begin;
            return timed ? std::chrono::duration<double, std::nano>(taken).count() : 0.0;
        };
        if (a.blocks())
            return time(mobb::PlacedBlocks(*a.blocks(), query.place_a), mobb::PlacedBlocks(*b.blocks(), query.place_b));
        return time(mobb::PlacedTree(a, query.place_a), mobb::PlacedTree(b, query.place_b));
    };
    const auto warm = [&](const FitTrees& trees, auto place) {
        std::vector<decltype(place(*trees[0], queries[0].place_a))> placed;
        for (const ClipQuery& query : queries.first(count)) {
            placed.push_back(place(*trees[static_cast<std::size_t>(query.clip_a)], query.place_a));
            placed.push_back(place(*trees[static_cast<std::size_t>(query.clip_b)], query.place_b));
        }
        double taken = 0;
        for (int pass = 0; pass < 2; ++pass) {
            const auto begin = ThreadClock::now();
            for (std::size_t i = 0; i < placed.size(); i += 2) ask(placed[i], placed[i + 1]);
            taken = nanoseconds(ThreadClock::now() - begin);
        }
        return taken / static_cast<double>(count);
    };
    for (std::size_t round = 0; round < rounds_of; ++round) {
        for (std::size_t left = turns.size(); left > 1; --left)
            std::swap(turns[left - 1], turns[static_cast<std::size_t>(uniform.below(static_cast<int>(left)))]);
        for (const std::size_t fit : turns) {
            const FitTrees& trees = fits[fit];
            if (protocol == Protocol::cold) {
                std::vector<double> times;
                for (const ClipQuery& query : queries.first(count)) times.push_back(ask_in(trees, query, true));
                std::ranges::sort(times);  // what was interrupted is left out
                double sum = 0;
                for (const double ns : std::span(times).first(count - count / 50)) sum += ns;
                rounds[fit].push_back(sum / static_cast<double>(count - count / 50));
            } else if (trees.front()->blocks()) {
                rounds[fit].push_back(warm(trees, [](const mobb::Tree& tree, const mobb::Placement& at) {
                    return mobb::PlacedBlocks(*tree.blocks(), at);
                }));
            } else {
                rounds[fit].push_back(warm(trees, [](const mobb::Tree& tree, const mobb::Placement& at) {
                    return mobb::PlacedTree(tree, at);
                }));
            }
        }
    }
    std::vector<double> out;
    for (std::vector<double>& of : rounds) {
        std::ranges::sort(of);
        out.push_back(of[rounds_of / 2]);
    }
    return out;
}

void check_advice(const std::vector<mobb::ClipPtr>& clips, bool boxes_alone) {
    SweepOrder order = usual_sweep({});
    if (boxes_alone) std::erase(order.trees, mobb::TreeKind::blocks);
    const QueryWorkload workload = standard_workload(clips, order.most_queries, kCountedSeed);
    const auto begin = std::chrono::steady_clock::now();
    const SweepResult result = sweep_fits(clips, workload, order);
    std::printf("%s: %zu fits, %.1f s\n", boxes_alone ? "trees of boxes" : "all kinds", result.rows.size(),
                std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
    std::vector<FitTrees> fits;
    for (const SweepRow& row : result.rows) fits.push_back(fit_all(clips, row.fit));
    const QueryWorkload fresh = standard_workload(clips, 4096, kCountedSeed + 1);
    for (const Protocol protocol : kProtocols) {
        const std::vector<double> times = measured_again(fits, fresh.queries, protocol);
        const auto best = static_cast<std::size_t>(std::ranges::min_element(times) - times.begin());
        const std::size_t taken = result.fastest(protocol);
        std::printf("  %s: %s\n      measured again: %s %.1f ns, best %s %.1f ns: %+.1f %%\n", name(protocol).data(),
                    result.of(protocol).why.c_str(), sweep_words(result.rows[taken].fit, {}).c_str(), times[taken],
                    sweep_words(result.rows[best].fit, {}).c_str(), times[best],
                    100 * (times[taken] / times[best] - 1));
    }
}

}  // namespace

int main(int argc, char** argv) {
    std::setvbuf(stdout, nullptr, _IOLBF, 0);
    if (argc < 3 || (std::strcmp(argv[1], "prices") != 0 && std::strcmp(argv[1], "check") != 0)) {
        std::fprintf(stderr, "bench_advice prices|check PATH...\n");
        return 2;
    }
    std::vector<mobb::ClipPtr> clips;
    for (const SceneClip& clip : load_files({argv + 2, argv + argc}).clips) clips.push_back(clip.clip);
    if (std::strcmp(argv[1], "prices") == 0) {
        print_prices(clips);
    } else {
        for (const bool boxes_alone : {false, true}) check_advice(clips, boxes_alone);
    }
}
