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
#include <future>
#include <limits>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "walks.h"

namespace {

using namespace mobb;

/// Walks in a room, and pairs near each other.
struct Queries {
    std::vector<Tree> trees;
    struct Side {
        const Tree* tree;
        Placement placement;
    };
    std::vector<Side> sides;         ///< two a query
    std::vector<PlacedTree> placed;  ///< the same

    Queries(double seconds, int clips) {
        test::Random random(7);
        for (int i = 0; i < clips; ++i) trees.emplace_back(bench::walk(random, seconds), FitOptions{});
        for (int i = 0; i < 2 * 32768; ++i) {
            const auto tree = static_cast<std::size_t>(random.integer(0, clips - 1));
            sides.push_back({&trees[tree], bench::somewhere(random, i % 2 ? seconds : 0)});
            placed.emplace_back(trees[tree], sides.back().placement);
        }
    }
};

/// In place of a ring: the query itself.
struct Alone {
    explicit Alone(int) {}
    static std::optional<Contact> query(const PlacedTree& a, const PlacedTree& b) { return mobb::query(a, b); }
};

/// What is timed of a query.
enum class Timed { asking, placing_and_asking };

/// ns for the queries of some sides.
template <class Ring>
double time_of(Ring& ring, const Queries& queries, Timed timed, std::size_t begin, std::size_t end) {
    const auto from = std::chrono::steady_clock::now();
    if (timed == Timed::asking) {
        for (std::size_t i = begin; i < end; i += 2)
            benchmark::DoNotOptimize(ring.query(queries.placed[i], queries.placed[i + 1]));
    } else {
        for (std::size_t i = begin; i < end; i += 2) {
            const Queries::Side &a = queries.sides[i], &b = queries.sides[i + 1];
            benchmark::DoNotOptimize(ring.query(PlacedTree(*a.tree, a.placement), PlacedTree(*b.tree, b.placement)));
        }
    }
    return std::chrono::duration<double, std::nano>(std::chrono::steady_clock::now() - from).count();
}

/// The three take turns over slices of the queries. Counters: ns a query, the least of each slice, and ratios.
void compare(benchmark::State& state, double seconds, int clips, Timed timed) {
    const Queries queries(seconds, clips);
    // Owners are counted at less cost while a program has one thread.
    std::promise<void> end;
    std::thread other([ended = end.get_future()] { ended.wait(); });
    Alone alone(0);
    NoCaptureRing off(0);
    CaptureRing on(64);
    constexpr std::size_t kSlices = 32;
    const std::size_t step = queries.sides.size() / kSlices;
    std::array<std::vector<double>, 3> least;
    least.fill(std::vector<double>(kSlices, std::numeric_limits<double>::max()));
    std::size_t turn = 0;
    for (auto _ : state) {
        for (std::size_t slice = 0; slice < kSlices; ++slice) {
            const auto keep = [&, begin = slice * step](std::size_t of, auto& ring) {
                least[of][slice] = std::min(least[of][slice], time_of(ring, queries, timed, begin, begin + step));
            };
            // Who comes first finds the caches cold, and who comes second what the first left there.
            for (std::size_t i = 0; i < 3; ++i) {
                const std::size_t who = (turn + (turn / 3 % 2 == 0 ? i : 3 - i)) % 3;
                if (who == 0) keep(0, alone);
                if (who == 1) keep(1, off);
                if (who == 2) keep(2, on);
            }
        }
        ++turn;
    }
    end.set_value();
    other.join();
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
    for (std::size_t i = 0; i < 128; i += 2) ring.query(queries.placed[i], queries.placed[i + 1]);
    const int nowhere = ::open("/dev/null", O_WRONLY | O_CLOEXEC);
    for (auto _ : state) benchmark::DoNotOptimize(ring.dump(nowhere));
    ::close(nowhere);
}

const bool registered = [] {
    for (const double seconds : {42.0, 2.1}) {
        const std::string length = seconds > 10 ? "42s" : "2s";
        for (const int clips : {1, 16, 4096}) {
            if (seconds > 10 && clips > 16) continue;
            for (const Timed timed : {Timed::asking, Timed::placing_and_asking}) {
                const std::string name = "ring/" + length + "/clips" + std::to_string(clips) +
                                         (timed == Timed::asking ? "/asked" : "/placed_and_asked");
                benchmark::RegisterBenchmark(name.c_str(),
                                             [=](benchmark::State& state) { compare(state, seconds, clips, timed); });
            }
        }
        benchmark::RegisterBenchmark(("dump64/" + length).c_str(),
                                     [=](benchmark::State& state) { dump(state, seconds); });
    }
    return true;
}();

}  // namespace
