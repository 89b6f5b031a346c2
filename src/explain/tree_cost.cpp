#include <base/threads.h>
#include <explain/tree_cost.h>
#include <mobb/query.h>

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>

namespace mobbscope {

namespace {

constexpr std::size_t kOfAThread = 4096;  // placements that one thread counts
constexpr double kApart = 2.02;           // times the reach of a root, from middle to middle: more than rounding
constexpr double kMostSlack = 1e-6;       // of the lengths involved: more than the slack of any box test

/// As a part of the mean; 0 where none were made.
double error_of(double sum, double squares, std::size_t count) {
    const auto numbers = static_cast<double>(count);
    return sum > 0 ? standard_error(std::max(0.0, squares - sum * sum / numbers), count) * numbers / sum : 0;
}

/// Whether every one of them is a placement.
bool can_be_placed(const StandardPlacements& placements) {
    const glm::dvec2 a = glm::abs(placements.middle_a);
    const double farthest = placements.side / 2 + glm::length(placements.middle_b);
    return mobb::is_valid({.translate = a + farthest, .rotate_deg = 180, .start = placements.offset});
}

/// Divides counted tests as expected ones are; those of a kind that none is expected of are of the last level.
std::vector<MeanTests> divided(const MeanTests& tests, const ExpectedCost& expected) {
    std::vector<MeanTests> out = expected.levels;
    for (const mobb::TestKind kind : mobb::kTestKinds) {
        const double all = expected.tests[kind];
        for (MeanTests& level : out) level[kind] *= all > 0 ? tests[kind] / all : 0;
        if (all <= 0) out.back()[kind] = tests[kind];
    }
    return out;
}

/// How many placements are counted once the next step is done: the error falls with the root of the number.
std::size_t next_end(const PlacementCount& count, std::size_t most) {
    const std::size_t now = count.placements;
    if (now == 0) return std::min(kFirstCounted, most);
    const double times = 1.1 * std::pow(count.standard_error() / kCountedError, 2);
    const auto wanted = static_cast<std::size_t>(static_cast<double>(now) * std::clamp(times, 1.1, 2.0));
    return std::min(wanted, most);
}

/// How far the root's box reaches around the middle, in metres.
double root_reach(const mobb::Tree& tree, glm::dvec2 middle) {
    const mobb::Box root = tree.box(0);
    double reach = glm::length(glm::dvec2(root.center) - middle) + glm::length(root.drift);
    for (int i = 0; i < 3; ++i) reach += glm::length(glm::dvec2(root.axes[static_cast<std::size_t>(i)])) * root.half[i];
    return reach;
}

/// Standard placements of a tree against itself, asked.
class PlacementCounter {
  public:
    PlacementCounter(const mobb::Tree& tree, const StandardPlacements& placements)
        : tree_(tree), placements_(placements), a_(tree, {}) {
        const double reach = root_reach(tree, placements.middle_a);
        const double lengths = 2 * (tree.clip().reach() + glm::length(placements.middle_b) + placements.side);
        // Where slack is as wide as the room, roots that are apart are not seen apart.
        if (kApart * reach >= placements.side / 2 || (kApart - 2) * reach <= kMostSlack * lengths) return;
        far_ = kApart * reach;
        tests_of_far_ = tests_of({.shift = {far_, 0}});
    }

    PlacementCount count(std::size_t first, std::size_t end) const {
        PlacementCount out;
        std::size_t far_ones = 0;
        for (std::size_t i = first; i < end; ++i) {
            const StandardPlacements::Draw drawn = placements_.draw(kCountedSeed, i);
            if (is_far(drawn))
                ++far_ones;
            else
                out.add(tests_of(drawn));
        }
        out.add(tests_of_far_, far_ones);
        return out;
    }

  private:
    mobb::TestCounts tests_of(const StandardPlacements::Draw& drawn) const {
        mobb::Statistics statistics;
        mobb::query(a_, mobb::PlacedTree(tree_, placements_.place(drawn)), statistics);
        return statistics.tests;
    }
    /// The two share time, and their roots are apart: all of these end after the same tests.
    bool is_far(const StandardPlacements::Draw& drawn) const {
        return glm::dot(drawn.shift, drawn.shift) > far_ * far_ && std::abs(drawn.start) < 0.99 * placements_.offset;
    }

    const mobb::Tree& tree_;
    StandardPlacements placements_;
    mobb::PlacedTree a_;
    double far_ = std::numeric_limits<double>::infinity();  ///< m, from middle to middle
    mobb::TestCounts tests_of_far_{};
};

/// Counts up to placement `end`, on all processors.
void count_on(PlacementCount& count, std::size_t end, const PlacementCounter& counter, const Progress& progress) {
    const std::size_t first = count.placements;
    std::vector<PlacementCount> parts((end - first + kOfAThread - 1) / kOfAThread);
    limit_worker_threads();
    std::mutex telling;
    std::size_t done = 0;
    tbb::parallel_for(std::size_t{0}, parts.size(), [&](std::size_t i) {
        const std::size_t begin = first + i * kOfAThread;
        parts[i] = counter.count(begin, std::min(begin + kOfAThread, end));
        if (!progress) return;
        const std::scoped_lock lock(telling);
        progress(done += parts[i].placements, end - first);
    });
    for (const PlacementCount& part : parts) count.add(part);
}

}  // namespace

void PlacementCount::add(const mobb::TestCounts& tests, std::size_t times) {
    const auto all = static_cast<double>(times);
    const auto boxes = static_cast<double>(tests.boxes());
    const auto pairs = static_cast<double>(tests[mobb::TestKind::samples]);
    placements += times;
    for (const mobb::TestKind kind : mobb::kTestKinds) sums[kind] += all * static_cast<double>(tests[kind]);
    box_squares += all * boxes * boxes;
    pair_squares += all * pairs * pairs;
}

void PlacementCount::add(const PlacementCount& others) {
    placements += others.placements;
    sums += others.sums;
    box_squares += others.box_squares;
    pair_squares += others.pair_squares;
}

double PlacementCount::standard_error() const {
    return std::max(error_of(sums.boxes(), box_squares, placements),
                    error_of(sums[mobb::TestKind::samples], pair_squares, placements));
}

bool PlacementCount::is_enough(std::size_t most) const {
    return placements >= most || (sums[mobb::TestKind::samples] > 0 && standard_error() < kCountedError);
}

std::string_view why_no_cost(const mobb::Tree& tree) {
    if (tree.blocks())
        return "Blocks are not counted: a query that nobody watches makes other tests than a counted one. A sweep "
               "measures them.";
    const bool has_room = can_be_placed(StandardPlacements(tree.clip(), tree.clip()));
    return has_room ? "" : "The clip is so far out that it cannot be placed anew.";
}

std::shared_ptr<const TreeCost> counted_on(const std::shared_ptr<const mobb::Tree>& tree, const TreeCost* so_far,
                                           std::size_t most, const Progress& progress) {
    if (!why_no_cost(*tree).empty()) return nullptr;
    auto out = std::make_shared<TreeCost>(so_far ? *so_far : TreeCost{.tree = tree});
    if (!so_far) {
        out->expected = std::make_shared<const ExpectedCost>(expected_cost(*tree, *tree).value());
        out->shares = out->expected->node_shares();
    }
    PlacementCount& count = out->count;
    count_on(count, next_end(count, most), PlacementCounter(*tree, out->expected->placements), progress);
    out->queries = count.placements;
    out->tests = mean_of(count.sums, count.placements);
    out->levels = divided(out->tests, *out->expected);
    return out;
}

std::shared_ptr<const TreeCost> standard_cost(const std::shared_ptr<const mobb::Tree>& tree, std::size_t most,
                                              const Progress& progress) {
    std::shared_ptr<const TreeCost> out = counted_on(tree, nullptr, most, progress);
    while (out && !out->count.is_enough(most)) out = counted_on(tree, out.get(), most, progress);
    return out;
}

TreeCost cost_in_scene(const SceneCosts& costs, int clip, const std::shared_ptr<const mobb::Tree>& tree) {
    TreeCost out{.tree = tree, .workload = QueryWorkload::Kind::queries, .queries = costs.tests.size()};
    out.tests = mean_of(as_numbers(costs.kinds), out.queries);
    mobb::TestCounts in_levels;
    for (const mobb::TestCounts& level : costs.levels) {
        out.levels.push_back(mean_of(as_numbers(level), out.queries));
        for (const mobb::TestKind kind : mobb::kTestKinds) in_levels[kind] += level[kind];
    }
    out.shares.resize(tree->nodes().size());
    if (in_levels.boxes() == 0) return out;
    for (const NodeCost& cost : costs.nodes) {
        if (cost.at.clip == clip)
            out.shares[static_cast<std::size_t>(cost.at.node)] =
                static_cast<double>(cost.boxes) / (2 * static_cast<double>(in_levels.boxes()));
    }
    return out;
}

double TreeCost::part(const MeanTests& some) const {
    const double all = ns();
    return all > 0 ? ns(some) / all : 0;
}

}  // namespace mobbscope
