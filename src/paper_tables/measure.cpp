#include <base/random.h>
#include <base/text.h>
#include <base/thread_clock.h>
#include <mobb/blocks.h>
#include <mobb/level_figures.h>
#include <mobb/placed_tree.h>
#include <mobb/query.h>
#include <mobb/traversal.h>
#include <paper_tables/measure.h>

#include <algorithm>
#include <fstream>
#include <numeric>
#include <optional>
#include <span>
#include <thread>
#include <utility>

namespace mobbscope {

namespace {

/// Queries between two turns of a method: enough to make the clock's own time vanish, few enough to stay in the cache.
constexpr std::size_t kBlock = 1024;

/// What the tables count of one query.
struct TableCounts : mobb::Statistics {
    explicit TableCounts(std::vector<PairLevel>& pair_levels) : levels(&pair_levels) {}

    std::vector<PairLevel>* levels;  ///< counts are added
    std::int64_t sample_steps = 0;
    int last_i = -1;
    std::size_t depth = 0, deepest = 0;
    int entered = 0;
    bool measured = false;

    void enter(int, int) {
        ++entered;
        ++depth;
        deepest = std::max(deepest, depth);
        if (levels->size() < depth) levels->resize(depth);
        at_depth().pairs += 1;
    }
    void leave() { --depth; }
    void time_test(bool overlap) {
        Statistics::time_test(overlap);
        if (!overlap) at_depth().apart_in_time += 1;
    }
    void box_test(mobb::BoxKind test, const mobb::Separation& separation) {
        Statistics::box_test(test, separation);
        if (separation.separated()) at_depth().separated += 1;
    }
    void sample_pair(int i, int j, double squared_distance) {
        Statistics::sample_pair(i, j, squared_distance);
        if (i != last_i) ++sample_steps;
        last_i = i;
    }
    void sample_test(bool) {
        measured = true;
        last_i = -1;
        at_depth().sampled += 1;
    }
    PairLevel& at_depth() { return (*levels)[depth - 1]; }
    bool rejected_by_roots() const { return entered == 1 && !measured; }
};

/// A method with its trees, by clip.
struct FittedMethod {
    const Method* method = nullptr;
    std::vector<mobb::Tree> trees;
};

/// The method's answer.
template <class Observer>
std::optional<mobb::Contact> ask(const Method& method, const mobb::PlacedTree& a, const mobb::PlacedTree& b,
                                 Observer& observer) {
    if (!method.boxes_in_walk) return mobb::query(a, b, observer);
    std::optional<mobb::Contact> contact;
    auto on_hit = [&](int i, int j) {
        contact = mobb::contact_of(a.samples(), i, b.samples(), j);
        return true;
    };
    mobb::visit_hits<mobb::WalkTests::time_and_boxes>(a, b, observer, on_hit);
    return contact;
}

TreeFigures tree_figures(const std::vector<mobb::Tree>& trees) {
    TreeFigures out;
    for (const mobb::Tree& tree : trees) {
        out.depth += tree.depth();
        out.nodes += static_cast<double>(tree.nodes().size());
        out.bytes += static_cast<double>(sizeof(mobb::Tree) + tree.bytes());
        out.volumes.resize(std::max(out.volumes.size(), static_cast<std::size_t>(tree.depth())));
    }
    for (const mobb::Tree& tree : trees) {
        const std::vector<mobb::LevelFigures> levels = mobb::level_figures(tree);
        for (std::size_t level = 0; level < out.volumes.size(); ++level) {
            out.volumes[level] += levels[std::min(level, levels.size() - 1)].volume;
        }
    }
    const double count = static_cast<double>(std::max<std::size_t>(trees.size(), 1));
    out.depth /= count;
    out.nodes /= count;
    out.bytes /= count;
    return out;
}

TableRow count(const FittedMethod& fitted, const Workload& workload,
               const std::vector<std::optional<mobb::Contact>>& truth) {
    mobb::TestCounts sum;
    std::int64_t steps = 0, rejected = 0, root_boxes = 0;
    TableRow row;
    row.method = fitted.method->name;
    if (fitted.method->options) {
        row.leaf = fitted.method->options->leaf;
        row.levels = fitted.method->options->levels;
        row.trees = tree_figures(fitted.trees);
    }
    for (std::size_t i = 0; i < workload.queries.size(); ++i) {
        const WorkloadQuery& query = workload.queries[i];
        TableCounts counts(row.pair_levels);
        std::optional<mobb::Contact> contact;
        if (fitted.trees.empty()) {
            const auto [a, b] = placed(workload, query);
            contact = mobb::direct_search(a, b, counts);
        } else {
            const auto [a, b] = placed(fitted.trees, query);
            contact = ask(*fitted.method, a, b, counts);
            if (mobb::overlap_in_time(a.begin(a.node(0)), a.end(a.node(0)), b.begin(b.node(0)), b.end(b.node(0)))) {
                ++root_boxes;
            }
            if (counts.rejected_by_roots()) ++rejected;
        }
        if (contact != truth[i]) {
            throw DisagreementError("query " + std::to_string(i) + ": " + fitted.method->name +
                                    " and the direct search disagree");
        }
        for (const mobb::TestKind test : mobb::kTestKinds) sum[test] += counts.tests[test];
        steps += counts.sample_steps;
        row.pair_levels[counts.deepest - 1].ended += 1;
    }
    const auto mean = [&](auto of) { return static_cast<double>(of) / static_cast<double>(truth.size()); };
    for (const mobb::TestKind test : mobb::kTestKinds) row[test] = mean(sum[test]);
    row.sample_steps = mean(steps);
    row.root_rejected = mean(rejected);
    row.root_box_tests = mean(root_boxes);
    if (fitted.trees.empty()) row.pair_levels.clear();
    for (PairLevel& level : row.pair_levels) {
        level = {mean(level.pairs), mean(level.apart_in_time), mean(level.separated), mean(level.sampled),
                 mean(level.ended)};
    }
    return row;
}

/// As many pairs as mobb::intersects_each says collide.
int count_in_batches(std::span<const PlacedPair<mobb::PlacedBlocks>> pairs) {
    constexpr std::size_t kBatch = 1000;
    std::array<mobb::BlocksPair, kBatch> batch;
    std::array<bool, kBatch> answers;
    int hits = 0;
    for (std::size_t first = 0; first < pairs.size(); first += kBatch) {
        const std::size_t n = std::min(kBatch, pairs.size() - first);
        for (std::size_t i = 0; i < n; ++i) batch[i] = {&pairs[first + i].a, &pairs[first + i].b};
        mobb::intersects_each(std::span(batch).first(n), std::span(answers).first(n));
        hits += static_cast<int>(std::count(answers.begin(), answers.begin() + static_cast<std::ptrdiff_t>(n), true));
    }
    return hits;
}

/// Nanoseconds for the queries [first, end), their placing left out. `hits` is what they answer.
double time_block(const FittedMethod& fitted, const Workload& workload, std::size_t first, std::size_t end, int hits) {
    const Method& method = *fitted.method;
    const auto time = [&](const auto& placed_in, const auto& count_hits) {
        std::vector<decltype(placed(placed_in, workload.queries.front()))> pairs;
        pairs.reserve(end - first);
        for (std::size_t i = first; i < end; ++i) pairs.push_back(placed(placed_in, workload.queries[i]));
        const auto begin = ThreadClock::now();
        const int found = count_hits(pairs);
        const auto finish = ThreadClock::now();
        if (found != hits) throw DisagreementError(method.name + " and the direct search disagree");
        return nanoseconds(finish - begin);
    };
    const auto one_by_one = [&](const auto& placed_in, const auto& answer) {
        return time(placed_in, [&](const auto& pairs) {
            int found = 0;
            for (const auto& pair : pairs) found += answer(pair) ? 1 : 0;
            return found;
        });
    };
    if (fitted.trees.empty()) {
        return one_by_one(workload, [](const auto& pair) { return mobb::direct_search(pair.a, pair.b).has_value(); });
    }
    if (method.batch) {
        return time(BlocksOf{fitted.trees}, [](const auto& pairs) { return count_in_batches(pairs); });
    }
    if (method.options->tree == mobb::TreeKind::blocks) {
        return one_by_one(BlocksOf{fitted.trees}, [](const auto& pair) { return mobb::intersects(pair.a, pair.b); });
    }
    if (method.boxes_in_walk) {
        return one_by_one(fitted.trees, [&](const auto& pair) {
            mobb::NoObserver observer;
            return ask(method, pair.a, pair.b, observer).has_value();
        });
    }
    return one_by_one(fitted.trees, [](const auto& pair) { return mobb::query(pair.a, pair.b).has_value(); });
}

double quantile(const std::vector<double>& sorted, double share) {
    const double at = share * static_cast<double>(sorted.size() - 1);
    const auto below = static_cast<std::size_t>(at);
    const std::size_t above = std::min(below + 1, sorted.size() - 1);
    return sorted[below] + (at - static_cast<double>(below)) * (sorted[above] - sorted[below]);
}

/// Linux says it in /proc/cpuinfo; elsewhere it stays unknown.
std::string processor() {
    std::ifstream file("/proc/cpuinfo");
    for (std::string line; std::getline(file, line);) {
        const std::size_t colon = line.find(':');
        if (line.starts_with("model name") && colon != std::string::npos) {
            return cleaned(trimmed(std::string_view(line).substr(colon + 1)));
        }
    }
    return "unknown processor";
}

}  // namespace

double TableRow::box_tests() const {
    double sum = 0;
    for (const mobb::BoxKind kind : mobb::kBoxKinds) sum += (*this)[kind];
    return sum;
}

TableRows measure(const Workload& workload, const std::vector<Method>& methods, int rounds,
                  const MeasureProgress& progress) {
    const auto tell = [&](const std::string& doing, int done, int all) {
        if (progress) progress(doing, done, all);
    };
    std::vector<FittedMethod> fitted;
    std::vector<std::vector<double>> build_means(methods.size());  // by method and round, nanoseconds a tree
    for (int round = 0; round < rounds; ++round) {
        tell("fitting", round, rounds);
        for (std::size_t m = 0; m < methods.size(); ++m) {
            if (round == 0) fitted.push_back({&methods[m], {}});
            if (!methods[m].options) continue;
            const auto begin = ThreadClock::now();
            std::vector<mobb::Tree> trees = trees_of(workload, *methods[m].options);
            const double spent = nanoseconds(ThreadClock::now() - begin);
            build_means[m].push_back(spent / static_cast<double>(trees.size()));
            if (round == 0) fitted[m].trees = std::move(trees);
        }
    }

    TableRows table;
    std::vector<std::optional<mobb::Contact>> truth;
    std::vector<int> hits;  // by block
    truth.reserve(workload.queries.size());
    for (const WorkloadQuery& query : workload.queries) {
        if (truth.size() % kBlock == 0) hits.push_back(0);
        const auto [a, b] = placed(workload, query);
        truth.push_back(mobb::direct_search(a, b));
        if (!truth.back()) continue;
        ++hits.back();
        ++table.positive;
    }
    table.positive /= static_cast<double>(truth.size());
    for (std::size_t m = 0; m < methods.size(); ++m) {
        tell("counting", static_cast<int>(m), static_cast<int>(methods.size()));
        table.rows.push_back(count(fitted[m], workload, truth));
        if (methods[m].options) {
            std::ranges::sort(build_means[m]);
            table.rows[m].trees.build_ns = quantile(build_means[m], 0.5);
        }
    }

    std::vector<std::vector<double>> means(methods.size());  // by method and round
    std::vector<std::size_t> turns(methods.size());
    std::iota(turns.begin(), turns.end(), std::size_t{0});
    Uniform uniform(1);
    for (int round = 0; round < rounds; ++round) {
        tell("timing", round, rounds);
        std::vector<double> sums(methods.size(), 0);
        for (std::size_t block = 0; block < hits.size(); ++block) {
            const std::size_t first = block * kBlock;
            const std::size_t end = std::min(first + kBlock, truth.size());
            for (std::size_t left = turns.size(); left > 1; --left) {
                std::swap(turns[left - 1], turns[static_cast<std::size_t>(uniform.below(static_cast<int>(left)))]);
            }
            for (const std::size_t m : turns) {
                sums[m] += time_block(fitted[m], workload, first, end, hits[block]);
            }
        }
        for (std::size_t m = 0; m < methods.size(); ++m) {
            means[m].push_back(sums[m] / static_cast<double>(truth.size()));
        }
    }
    for (std::size_t m = 0; m < methods.size(); ++m) {
        std::sort(means[m].begin(), means[m].end());
        table.rows[m].time_ns = quantile(means[m], 0.5);
        table.rows[m].time_ns_q1 = quantile(means[m], 0.25);
        table.rows[m].time_ns_q3 = quantile(means[m], 0.75);
    }
    return table;
}

std::string machine_words() {
#ifdef NDEBUG
    const char* const build = "optimised";
#else
    const char* const build = "with assertions: do not use these times";
#endif
    return processor() + ", " + counted(std::thread::hardware_concurrency(), "core", "cores") + ", " +
           (__VERSION__[0] >= '0' && __VERSION__[0] <= '9' ? "GCC " : "") + __VERSION__ + ", " + build;
}

}  // namespace mobbscope
