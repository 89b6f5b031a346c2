#include <base/text.h>
#include <mobb/placed_tree.h>
#include <mobb/query.h>
#include <paper_tables/measure.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <memory>
#include <optional>
#include <thread>

namespace mobbscope {

namespace {

/// Queries between two turns of a method: enough to make the clock's own time vanish, few enough to stay in the cache.
constexpr std::size_t kBlock = 1024;

/// What the tables count of one query.
struct TableCounts : mobb::Statistics {
    std::int64_t sample_steps = 0;
    int last_i = -1;
    int entered = 0;
    bool measured = false;

    void enter(int, int) { ++entered; }
    void sample_pair(int i, int j, double squared_distance) {
        Statistics::sample_pair(i, j, squared_distance);
        if (i != last_i) ++sample_steps;
        last_i = i;
    }
    void sample_test(bool) {
        measured = true;
        last_i = -1;
    }
    bool rejected_by_roots() const { return entered == 1 && !measured; }
};

/// A method with its trees, by clip.
struct FittedMethod {
    const Method* method = nullptr;
    std::vector<mobb::Tree> trees;
};

TableRow count(const FittedMethod& fitted, const Workload& workload,
               const std::vector<std::optional<mobb::Contact>>& truth) {
    mobb::TestCounts sum;
    std::int64_t steps = 0, rejected = 0, root_boxes = 0;
    for (std::size_t i = 0; i < workload.queries.size(); ++i) {
        const WorkloadQuery& query = workload.queries[i];
        TableCounts counts;
        std::optional<mobb::Contact> contact;
        if (fitted.trees.empty()) {
            const auto [a, b] = placed(workload, query);
            contact = mobb::direct_search(a, b, counts);
        } else {
            const auto [a, b] = placed(fitted.trees, query);
            contact = mobb::query(a, b, counts);
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
    }
    const auto mean = [&](std::int64_t of) { return static_cast<double>(of) / static_cast<double>(truth.size()); };
    TableRow row;
    row.method = fitted.method->name;
    row.leaf = fitted.method->options ? fitted.method->options->leaf : 0;
    for (const mobb::TestKind test : mobb::kTestKinds) row[test] = mean(sum[test]);
    row.sample_steps = mean(steps);
    row.root_rejected = mean(rejected);
    row.root_box_tests = mean(root_boxes);
    return row;
}

/// Nanoseconds for the queries [first, end), their placing left out. `hits` is what they answer.
double time_block(const FittedMethod& fitted, const Workload& workload, std::size_t first, std::size_t end, int hits) {
    using Clock = std::chrono::steady_clock;
    const auto run = [&](const auto& placed_in, const auto& ask) {
        std::vector<decltype(placed(placed_in, workload.queries.front()))> pairs;
        pairs.reserve(end - first);
        for (std::size_t i = first; i < end; ++i) pairs.push_back(placed(placed_in, workload.queries[i]));
        int found = 0;
        const auto begin = Clock::now();
        for (const auto& pair : pairs) found += ask(pair) ? 1 : 0;
        const auto finish = Clock::now();
        if (found != hits) throw DisagreementError(fitted.method->name + " and the direct search disagree");
        return std::chrono::duration<double, std::nano>(finish - begin).count();
    };
    if (fitted.trees.empty()) {
        return run(workload, [](const auto& pair) { return mobb::direct_search(pair.a, pair.b).has_value(); });
    }
    return run(fitted.trees, [](const auto& pair) { return mobb::query(pair.a, pair.b).has_value(); });
}

double quantile(const std::vector<double>& sorted, double share) {
    const double at = share * static_cast<double>(sorted.size() - 1);
    const auto below = static_cast<std::size_t>(at);
    const std::size_t above = std::min(below + 1, sorted.size() - 1);
    return sorted[below] + (at - static_cast<double>(below)) * (sorted[above] - sorted[below]);
}

Method method_of(mobb::TreeKind kind, int levels, const char* suffix, mobb::FitOptions options) {
    options.tree = kind;
    options.levels = levels;
    return {std::string(mobb::name(kind)) + suffix, options};
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
    const int method_count = static_cast<int>(methods.size());
    std::vector<FittedMethod> fitted;
    for (int m = 0; m < method_count; ++m) {
        tell("fitting", m, method_count);
        const Method& method = methods[static_cast<std::size_t>(m)];
        fitted.push_back({&method, {}});
        if (method.options) fitted.back().trees = trees_of(workload, *method.options);
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
    for (int m = 0; m < method_count; ++m) {
        tell("counting", m, method_count);
        table.rows.push_back(count(fitted[static_cast<std::size_t>(m)], workload, truth));
    }

    std::vector<std::vector<double>> means(methods.size());  // by method and round
    for (int round = 0; round < rounds; ++round) {
        tell("timing", round, rounds);
        std::vector<double> sums(methods.size(), 0);
        for (std::size_t block = 0; block < hits.size(); ++block) {
            const std::size_t first = block * kBlock;
            const std::size_t end = std::min(first + kBlock, truth.size());
            for (std::size_t turn = 0; turn < methods.size(); ++turn) {
                const std::size_t m = (turn + block) % methods.size();
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

std::vector<TableRow> sweep_leaf(const Workload& workload, mobb::FitOptions base, int rounds,
                                 const MeasureProgress& progress) {
    constexpr int kLeaves[] = {1, 2, 3, 5, 8, 10, 15, 20, 30, 50};
    std::vector<Method> methods;
    for (const int leaf : kLeaves) {
        base.leaf = leaf;
        for (Method& method : hierarchical_methods(base)) methods.push_back(std::move(method));
    }
    return measure(workload, methods, rounds, progress).rows;
}

std::vector<Method> hierarchical_methods(const mobb::FitOptions& base) {
    std::vector<Method> methods;
    for (const mobb::TreeKind kind : mobb::kTreeKinds) methods.push_back(method_of(kind, 0, "", base));
    return methods;
}

std::vector<Method> table_methods(const mobb::FitOptions& base) {
    std::vector<Method> methods{{"brute", std::nullopt}};
    for (const mobb::TreeKind kind : {mobb::TreeKind::mobb, mobb::TreeKind::umobb}) {
        methods.push_back(method_of(kind, 1, "_1level", base));
    }
    for (Method& method : hierarchical_methods(base)) methods.push_back(std::move(method));
    return methods;
}

std::string machine_words() {
#ifdef NDEBUG
    const char* const build = "optimised";
#else
    const char* const build = "with assertions: times are no measure";
#endif
    return processor() + ", " + counted(std::thread::hardware_concurrency(), "core", "cores") + ", " +
           (__VERSION__[0] >= '0' && __VERSION__[0] <= '9' ? "GCC " : "") + __VERSION__ + ", " + build;
}

}  // namespace mobbscope
