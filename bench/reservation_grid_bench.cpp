/// The broad phase of a crowd, both ways: a uniform grid over the floor, as the crowd's ReservationGrid has it, and
/// Boost.Geometry's R-tree over (x, y, t). Committed clips are boxes; the question is which of them a candidate's box
/// overlaps.
#include <benchmark/benchmark.h>
#include <mobb/random_motion.h>

#include <boost/geometry.hpp>
#include <boost/geometry/index/rtree.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace {

using mobb::test::Random;

/// Metres and seconds.
struct Extent {
    std::array<double, 3> low, high;

    bool meets(const Extent& o) const {
        for (std::size_t k = 0; k < 3; ++k) {
            if (low[k] > o.high[k] || o.low[k] > high[k]) return false;
        }
        return true;
    }
};

class Grid {
  public:
    explicit Grid(double side) : count_(std::max(1, static_cast<int>(side / kCell))) {
        cells_.resize(static_cast<std::size_t>(count_) * static_cast<std::size_t>(count_));
    }
    void insert(std::span<const Extent> all, std::uint32_t i) {
        for_cells(all[i], [&](std::vector<std::uint32_t>& cell, int, int) { cell.push_back(i); });
    }
    void remove(std::span<const Extent> all, std::uint32_t i) {
        for_cells(all[i], [&](std::vector<std::uint32_t>& cell, int, int) { std::erase(cell, i); });
    }
    int overlaps(std::span<const Extent> all, const Extent& e) {
        int found = 0;
        for_cells(e, [&](const std::vector<std::uint32_t>& cell, int x, int y) {
            for (const std::uint32_t i : cell) {
                // Of the cells that both reach into, the first one reports the pair.
                const bool first =
                    x == std::max(at(e.low[0]), at(all[i].low[0])) && y == std::max(at(e.low[1]), at(all[i].low[1]));
                found += first && all[i].meets(e);
            }
        });
        return found;
    }

  private:
    static constexpr double kCell = 4;

    int at(double x) const { return std::clamp(static_cast<int>(x / kCell), 0, count_ - 1); }
    void for_cells(const Extent& e, auto visit) {
        for (int y = at(e.low[1]); y <= at(e.high[1]); ++y) {
            for (int x = at(e.low[0]); x <= at(e.high[0]); ++x)
                visit(cells_[static_cast<std::size_t>(y * count_ + x)], x, y);
        }
    }
    int count_;
    std::vector<std::vector<std::uint32_t>> cells_;
};

class RTree {
  public:
    explicit RTree(double) {}
    void insert(std::span<const Extent> all, std::uint32_t i) { tree_.insert({box(all[i]), i}); }
    void remove(std::span<const Extent> all, std::uint32_t i) { tree_.remove(Value{box(all[i]), i}); }
    int overlaps(std::span<const Extent>, const Extent& e) {
        int found = 0;
        const auto intersecting = boost::geometry::index::intersects(box(e));
        for (auto it = tree_.qbegin(intersecting); it != tree_.qend(); ++it) ++found;
        return found;
    }

  private:
    using Point = boost::geometry::model::point<double, 3, boost::geometry::cs::cartesian>;
    using Box = boost::geometry::model::box<Point>;
    using Value = std::pair<Box, std::uint32_t>;

    static Box box(const Extent& e) { return {{e.low[0], e.low[1], e.low[2]}, {e.high[0], e.high[1], e.high[2]}}; }

    boost::geometry::index::rtree<Value, boost::geometry::index::quadratic<16>> tree_;
};

/// A hundred agents on 30 x 40 m, or as many more on as much more; each is committed to two clips of about two seconds.
double side_of(std::int64_t agents) { return std::sqrt(12.0 * static_cast<double>(agents)); }

std::vector<Extent> extents(std::int64_t agents, int seed) {
    Random random(static_cast<std::uint64_t>(seed));
    const double side = side_of(agents);
    std::vector<Extent> out;
    for (std::int64_t i = 0; i < 2 * agents; ++i) {
        const double x = random.real(0, side), y = random.real(0, side), t = random.real(0, 4);
        out.push_back({{x, y, t}, {x + random.real(1, 3.5), y + random.real(1, 3.5), t + random.real(1, 3)}});
    }
    return out;
}

template <class Phase>
Phase filled(const std::vector<Extent>& all, std::int64_t agents) {
    Phase phase(side_of(agents));
    for (std::uint32_t i = 0; i < all.size(); ++i) phase.insert(all, i);
    return phase;
}

/// One committed clip goes, another comes.
template <class Phase>
void replace(benchmark::State& state) {
    const std::vector<Extent> all = extents(state.range(0), 1);
    Phase phase = filled<Phase>(all, state.range(0));
    std::uint32_t i = 0;
    for (auto _ : state) {
        phase.remove(all, i);
        phase.insert(all, i);
        i = (i + 1) % static_cast<std::uint32_t>(all.size());
    }
}

template <class Phase>
void ask(benchmark::State& state) {
    const std::vector<Extent> all = extents(state.range(0), 1), candidates = extents(state.range(0), 2);
    Phase phase = filled<Phase>(all, state.range(0));
    std::size_t i = 0;
    std::int64_t found = 0;
    for (auto _ : state) {
        found += phase.overlaps(all, candidates[i]);
        i = (i + 1) % candidates.size();
    }
    state.counters["found"] = benchmark::Counter(static_cast<double>(found), benchmark::Counter::kAvgIterations);
}

#define FOR_CROWDS(f) BENCHMARK(f)->Arg(100)->Arg(1000)->Arg(2000)->Arg(10000)
FOR_CROWDS(replace<Grid>);
FOR_CROWDS(replace<RTree>);
FOR_CROWDS(ask<Grid>);
FOR_CROWDS(ask<RTree>);

}  // namespace
