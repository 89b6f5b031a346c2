// Tables of the window, sorted by each column and filtered: a million events of a query, and the nodes of a tree.
#include <explain/event_table.h>
#include <explain/node_table.h>

#include <benchmark/benchmark.h>

#include <cmath>
#include <iterator>
#include <memory>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

namespace mobbscope {
namespace {

constexpr int kSamples = 1 << 14;
constexpr int kDepth = 9;

mobb::Tree walk(double y) {
    std::vector<mobb::Disk> samples;
    for (int i = 0; i < kSamples; ++i) samples.push_back({0.01 * i, y, 0.3});
    return {std::make_shared<const mobb::Clip>(0.01, std::move(samples)), {}};
}

/// Every pair of nodes down to a depth, whatever they cover: three tests each.
class Recorded {
  public:
    Recorded() {
        record(0, 0, 0);
        trace_ = recorder_.take();
        recursion_ = recursion_of(trace_, a_, b_);
    }

    EventValues values() const { return {trace_, recursion_, a_, b_}; }

  private:
    void record(int a, int b, int depth) {
        const double gap = 1e-6 * ((a * 7919 + b * 104729) % 1000003);
        recorder_.enter(a, b);
        recorder_.time_test(true);
        recorder_.box_test(mobb::kBoxKinds.front(), {.axis = -1, .gap = 0});
        if (depth == kDepth) {
            recorder_.box_test(mobb::kBoxKinds.front(), {.axis = (a + b) % 4, .gap = gap});
        } else {
            for (const int child_a : a_.tree().children(a))
                for (const int child_b : b_.tree().children(b)) record(child_a, child_b, depth + 1);
        }
        recorder_.leave();
    }

    mobb::Tree tree_a_ = walk(0), tree_b_ = walk(1);
    mobb::PlacedTree a_{tree_a_, {}}, b_{tree_b_, {}};
    mobb::TraceRecorder recorder_;
    mobb::Trace trace_;
    Recursion recursion_;
};

const Recorded& recorded() {
    static const Recorded all;
    return all;
}

void sort_events(benchmark::State& state) {
    const EventColumn& column = event_columns()[static_cast<std::size_t>(state.range(0))];
    const EventValues values = recorded().values();
    std::vector<int> steps(static_cast<std::size_t>(values.size()));
    for (auto _ : state) {
        std::iota(steps.begin(), steps.end(), 0);
        sort_steps(steps, values, column.field, column.side, true);
        benchmark::DoNotOptimize(steps.data());
    }
    state.SetLabel(column_name(column) + " of " + std::to_string(values.size()));
}
BENCHMARK(sort_events)->DenseRange(0, static_cast<int>(event_columns().size()) - 1)->Unit(benchmark::kMillisecond);

constexpr const char* kFilters[] = {"gap < 0.05", "gap < 0.05 and level(a) >= 3 and outcome = separated",
                                    "node(a) = 9.17 or sample(b) = 113 and not tests_below > 100",
                                    "time > 20 and time < 40 and (leaf(a) or hit_below or shared < 1)"};

void filter_events(benchmark::State& state) {
    const EventFilter filter(kFilters[state.range(0)]);
    const EventValues values = recorded().values();
    for (auto _ : state) benchmark::DoNotOptimize(passing_steps(values, filter));
    state.SetLabel(filter.text());
}
BENCHMARK(filter_events)->DenseRange(0, static_cast<int>(std::size(kFilters)) - 1)->Unit(benchmark::kMillisecond);

// --- nodes

/// Of leaves of one sample, so of twice as many nodes; in free boxes, which overhang.
const NodeValues& many_nodes() {
    static const NodeValues all = [] {
        std::vector<mobb::Disk> samples;
        for (int i = 0; i < 1 << 16; ++i) samples.push_back({std::sin(0.01 * i), 0.01 * i, 0.3});
        auto clip = std::make_shared<const mobb::Clip>(0.01, std::move(samples));
        return NodeValues(std::make_shared<const mobb::Tree>(
                              std::move(clip), mobb::FitOptions{.tree = mobb::TreeKind::umobb, .leaf = 1}),
                          {});
    }();
    return all;
}

void find_node_values(benchmark::State& state) {
    const auto tree = std::make_shared<const mobb::Tree>(many_nodes().tree());
    for (auto _ : state) benchmark::DoNotOptimize(NodeValues(tree, {}));
    state.SetLabel(std::to_string(many_nodes().size()));
}
BENCHMARK(find_node_values)->Unit(benchmark::kMillisecond);

void sort_all_nodes(benchmark::State& state) {
    const NodeField field = node_columns()[static_cast<std::size_t>(state.range(0))];
    for (auto _ : state) {
        std::vector<int> nodes = nodes_that_pass(many_nodes(), nullptr);
        sort_nodes(nodes, many_nodes(), field, true);
        benchmark::DoNotOptimize(nodes.data());
    }
    state.SetLabel(std::string(info(field).name));
}
BENCHMARK(sort_all_nodes)->DenseRange(0, static_cast<int>(node_columns().size()) - 1)->Unit(benchmark::kMillisecond);

constexpr const char* kNodeFilters[] = {"fill < 50 %", "fill < 50 % and not leaf and sample < 30000 or node = 9.17"};

void filter_nodes(benchmark::State& state) {
    const NodeFilter filter(kNodeFilters[state.range(0)]);
    for (auto _ : state) benchmark::DoNotOptimize(nodes_that_pass(many_nodes(), &filter));
    state.SetLabel(filter.text());
}
BENCHMARK(filter_nodes)->DenseRange(0, static_cast<int>(std::size(kNodeFilters)) - 1)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace mobbscope
