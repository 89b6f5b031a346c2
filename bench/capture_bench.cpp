/// What remembering queries costs (mobb/capture.h): the same MOBB queries alone, through a ring that is off, and
/// through one that is on, in turns; and what a ring takes to dump.
#include <benchmark/benchmark.h>
#include <fcntl.h>
#include <mobb/capture.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstddef>
#include <limits>
#include <string>
#include <thread>
#include <vector>

#include "walks.h"

namespace {

using namespace mobb;

/// Walks in a room, and pairs near each other.
struct Queries {
    std::vector<Tree> trees;
    std::vector<PlacedTree> sides;  ///< two a query

    Queries(double seconds, int clips) {
        test::Random random(7);
        for (int i = 0; i < clips; ++i) trees.emplace_back(bench::walk(random, seconds), FitOptions{});
        for (int i = 0; i < 2 * 32768; ++i) {
            const auto tree = static_cast<std::size_t>(random.integer(0, clips - 1));
            sides.emplace_back(trees[tree], bench::somewhere(random, i % 2 ? seconds : 0));
        }
    }
};

/// In place of a ring: the query itself.
struct Alone {
    explicit Alone(int) {}
    static std::optional<Contact> query(const PlacedTree& a, const PlacedTree& b) { return mobb::query(a, b); }
};

/// ns a query over some of them.
template <class Ring>
double time_of(Ring& ring, const std::vector<PlacedTree>& sides, std::size_t begin, std::size_t end) {
    const auto from = std::chrono::steady_clock::now();
    for (std::size_t i = begin; i < end; i += 2) benchmark::DoNotOptimize(ring.query(sides[i], sides[i + 1]));
    return std::chrono::duration<double, std::nano>(std::chrono::steady_clock::now() - from).count();
}

/// The three take turns over slices of the queries. Counters: ns a query, the least of each slice, and ratios.
void compare(benchmark::State& state, double seconds, int clips, bool threads) {
    const Queries queries(seconds, clips);
    // Owners are counted at less cost while a program has one thread.
    if (threads) std::thread([] {}).join();
    Alone alone(0);
    NoCaptureRing off(0);
    CaptureRing on(64);
    constexpr std::size_t kSlices = 32;
    const std::size_t step = queries.sides.size() / kSlices;
    std::array<std::vector<double>, 3> least;
    least.fill(std::vector<double>(kSlices, std::numeric_limits<double>::max()));
    for (auto _ : state) {
        for (std::size_t slice = 0; slice < kSlices; ++slice) {
            const auto keep = [&, begin = slice * step](std::vector<double>& of, auto& ring) {
                of[slice] = std::min(of[slice], time_of(ring, queries.sides, begin, begin + step));
            };
            keep(least[0], alone);
            keep(least[1], off);
            keep(least[2], on);
        }
    }
    std::array<double, 3> ns{};
    for (std::size_t i = 0; i < 3; ++i) {
        for (const double slice : least[i]) ns[i] += slice;
        ns[i] /= static_cast<double>(queries.sides.size()) / 2;
    }
    state.counters["alone_ns"] = ns[0];
    state.counters["off_ns"] = ns[1];
    state.counters["on_ns"] = ns[2];
    state.counters["off_ratio"] = ns[1] / ns[0];
    state.counters["on_ratio"] = ns[2] / ns[0];
}

void dump(benchmark::State& state, double seconds) {
    const Queries queries(seconds, 16);
    CaptureRing ring(64);
    for (std::size_t i = 0; i < 128; i += 2) ring.query(queries.sides[i], queries.sides[i + 1]);
    const int nowhere = ::open("/dev/null", O_WRONLY | O_CLOEXEC);
    for (auto _ : state) benchmark::DoNotOptimize(ring.dump(nowhere));
    ::close(nowhere);
}

const bool registered = [] {
    for (const double seconds : {42.0, 2.1}) {
        const std::string length = seconds > 10 ? "42s" : "2s";
        for (const int clips : {1, 16, 4096}) {
            if (seconds > 10 && clips > 16) continue;
            for (const bool threads : {false, true}) {
                const std::string name =
                    "ring/" + length + "/clips" + std::to_string(clips) + (threads ? "/threads" : "/thread");
                benchmark::RegisterBenchmark(name.c_str(),
                                             [=](benchmark::State& state) { compare(state, seconds, clips, threads); });
            }
        }
        benchmark::RegisterBenchmark(("dump64/" + length).c_str(),
                                     [=](benchmark::State& state) { dump(state, seconds); });
    }
    return true;
}();

}  // namespace
