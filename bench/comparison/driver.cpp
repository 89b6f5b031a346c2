/// One side of bench/compare: answers queries with the library that it is built with, and says how long it took. It
/// must compile with any state of the library from commit 77c694f on, so it uses what all of them have, and what came
/// later only where it is there.
///
/// Usage: compare_driver long|short QUERIES SEED RANGE OFFSET SLICES [--count ROW] [FILE.csv...]
/// It reads commands, one a line, and answers each with a line:
///   rows            "ROW:UNIT ...": what can be measured, and how many of which unit a slice of it has
///   answers ROW     "HITS BITS CONTACTS COUNTS": numbers that are equal if all answers are
///   time ROW SLICE  nanoseconds of processor time
/// RANGE and OFFSET are those of QueryDraw. --count ROW asks the queries of slice 0 once, for callgrind, and ends.
#include <base/thread_clock.h>
#include <mobb/query.h>
#include <paper_tables/built_in_clips.h>
#include <paper_tables/random_queries.h>

#if __has_include(<mobb/production.h>)
#include <mobb/production.h>  // what was so called is in mobb/blocks.h since
#define COMPARE_BLOCKS 1
#elif __has_include(<mobb/blocks.h>)
#include <mobb/blocks.h>
#define COMPARE_BLOCKS 1
#endif

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <iostream>
#include <memory>
#include <numeric>
#include <optional>
#include <span>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "../clip_csv.h"

namespace {

using namespace mobb;
using mobbscope::ThreadClock;
using mobbscope::WorkloadQuery;

struct Workload {
    std::vector<ClipPtr> clips;
    std::vector<WorkloadQuery> queries;
    std::size_t slices = 1;

    std::span<const WorkloadQuery> slice(std::size_t i) const {
        const std::size_t first = queries.size() * i / slices, end = queries.size() * (i + 1) / slices;
        return std::span(queries).subspan(first, end - first);
    }
    /// Other queries than those of the slice, asked before its time is taken: so the other side's turn leaves no mark
    /// on caches and predictors.
    std::span<const WorkloadQuery> before(std::size_t i) const { return slice((i + slices - 1) % slices); }
};

/// FNV-1a.
struct Hash {
    std::uint64_t value = 0xcbf29ce484222325u;

    void add(std::uint64_t x) {
        for (int byte = 0; byte < 8; ++byte, x >>= 8) value = (value ^ (x & 0xff)) * 0x100000001b3u;
    }
    void add(const std::optional<Contact>& contact) {
        if (!contact) return;
        for (const double x : {contact->time, contact->distance, contact->radii}) add(std::bit_cast<std::uint64_t>(x));
        add(static_cast<std::uint64_t>(contact->a_sample) << 32 | static_cast<std::uint64_t>(contact->b_sample));
    }
};

struct Answers {
    int hits = 0;
    Hash bits;
    std::optional<Hash> contacts{};       ///< of a row that gives them
    std::optional<std::string> counts{};  ///< likewise

    void add(bool hit) {
        hits += hit;
        bits.add(hit);
    }
};

struct Row {
    std::string name, unit;
    std::function<double(std::size_t slice)> amount;
    std::function<double(std::size_t slice)> time;
    std::function<Answers()> answers{};  ///< none of a fit
    std::function<void()> count{};       ///< to be counted by callgrind
};

/// What the paper counts; Statistics has other members in other states of the library.
struct Counts : ObserverBase {
    std::int64_t times = 0, boxes = 0, sampled = 0, pairs = 0;

    void time_test(bool) { ++times; }
    void box_test(BoxKind, const Separation&) { ++boxes; }
    void sample_pair(int, int, double) { ++pairs; }
    void sample_test(bool) { ++sampled; }
};

template <class Placed>
struct Pair {
    Placed a, b;
};

template <class Placed, class Source>
std::vector<Pair<Placed>> place(const std::vector<Source>& sources, std::span<const WorkloadQuery> queries) {
    std::vector<Pair<Placed>> out;
    out.reserve(queries.size());
    for (const WorkloadQuery& q : queries) {
        out.push_back(
            {{*sources[static_cast<std::size_t>(q.clip_a)], q.a}, {*sources[static_cast<std::size_t>(q.clip_b)], q.b}});
    }
    return out;
}

int g_found = 0;  // what is counted here, the compiler cannot leave out

}  // namespace

/// callgrind collects inside this function only. It neither is copied nor ends in a jump.
extern "C" [[gnu::noinline, gnu::noipa]] void compare_counted(const std::function<void()>& asked) {
    asked();
    ++g_found;
}

namespace {

/// A row that answers each pair by itself: ask(pair, observer), which gives an optional contact or a bool.
template <class Placed, class Source, class Ask>
Row pair_row(std::string name, const Workload& w, std::shared_ptr<const std::vector<Source>> sources, Ask ask) {
    const auto run = [ask](const std::vector<Pair<Placed>>& pairs) {
        NoObserver nobody;
        int found = 0;
        for (const Pair<Placed>& pair : pairs) found += ask(pair, nobody) ? 1 : 0;
        g_found += found;
    };
    Row row{.name = std::move(name),
            .unit = "query",
            .amount = [&w](std::size_t slice) { return static_cast<double>(w.slice(slice).size()); },
            .time =
                [&w, sources, run](std::size_t slice) {
                    const auto pairs = place<Placed>(*sources, w.slice(slice));
                    run(place<Placed>(*sources, w.before(slice)));
                    const auto begin = ThreadClock::now();
                    run(pairs);
                    return mobbscope::nanoseconds(ThreadClock::now() - begin);
                }};
    row.answers = [&w, sources, ask] {
        Answers out;
        Counts counts;
        for (std::size_t slice = 0; slice < w.slices; ++slice) {
            for (const Pair<Placed>& pair : place<Placed>(*sources, w.slice(slice))) {
                const auto answer = ask(pair, counts);
                out.add(static_cast<bool>(answer));
                if constexpr (!std::is_same_v<decltype(answer), const bool>) {
                    if (!out.contacts) out.contacts.emplace();
                    out.contacts->add(answer);
                }
            }
        }
        if (out.contacts) {
            std::ostringstream text;
            text << counts.times << ',' << counts.boxes << ',' << counts.sampled << ',' << counts.pairs;
            out.counts = text.str();
        }
        return out;
    };
    row.count = [&w, sources, run] {
        const auto pairs = place<Placed>(*sources, w.slice(0));
        compare_counted([&] { run(pairs); });
    };
    return row;
}

/// A row that builds something over every clip; its unit is a sample.
template <class Build>
Row fit_row(std::string name, const Workload& w, Build build) {
    const auto run = [&w, build] {
        for (const ClipPtr& clip : w.clips) g_found += build(clip) ? 1 : 0;
    };
    return {.name = std::move(name),
            .unit = "sample",
            .amount =
                [&w](std::size_t) {
                    return std::accumulate(w.clips.begin(), w.clips.end(), 0.0,
                                           [](double sum, const ClipPtr& clip) { return sum + clip->count(); });
                },
            .time =
                [run](std::size_t) {
                    run();
                    const auto begin = ThreadClock::now();
                    run();
                    return mobbscope::nanoseconds(ThreadClock::now() - begin);
                },
            .count = [run] { compare_counted(run); }};
}

FitOptions options_of(TreeKind kind, int leaf, int levels = 0) {
    return {.tree = kind, .leaf = leaf, .levels = levels};
}

void add_tree(std::vector<Row>& rows, const Workload& w, const std::string& name, const FitOptions& options) {
    auto trees = std::make_shared<std::vector<std::unique_ptr<const Tree>>>();
    for (const ClipPtr& clip : w.clips) trees->push_back(std::make_unique<const Tree>(clip, options));
    const auto ask = [](const Pair<PlacedTree>& pair, auto& observer) { return query(pair.a, pair.b, observer); };
    rows.push_back(pair_row<PlacedTree, std::unique_ptr<const Tree>>(name, w, trees, ask));
}

#ifdef COMPARE_BLOCKS
/// The pairs of a slice, asked at once.
struct Batch {
    std::vector<Pair<PlacedBlocks>> placed;
    std::vector<BlocksPair> pairs;
    std::vector<char> hits;

    Batch(const std::vector<std::unique_ptr<const Blocks>>& blocks, std::span<const WorkloadQuery> queries)
        : placed(place<PlacedBlocks>(blocks, queries)), hits(queries.size()) {
        for (const Pair<PlacedBlocks>& pair : placed) pairs.push_back({&pair.a, &pair.b});
    }
    std::ptrdiff_t ask() {
        intersects_each(pairs, {reinterpret_cast<bool*>(hits.data()), hits.size()});
        return std::count(hits.begin(), hits.end(), 1);
    }
};

void add_blocks(std::vector<Row>& rows, const Workload& w) {
    auto blocks = std::make_shared<std::vector<std::unique_ptr<const Blocks>>>();
    for (const ClipPtr& clip : w.clips) blocks->push_back(std::make_unique<const Blocks>(clip));
    using Source = std::unique_ptr<const Blocks>;
    const auto ask = [](const Pair<PlacedBlocks>& pair, auto&) { return intersects(pair.a, pair.b); };
    rows.push_back(pair_row<PlacedBlocks, Source>("blocks", w, blocks, ask));
    const auto contact = [](const Pair<PlacedBlocks>& pair, auto&) { return query(pair.a, pair.b); };
    rows.push_back(pair_row<PlacedBlocks, Source>("blocks contact", w, blocks, contact));
    Row batch = rows.back();
    batch.name = "blocks batch";
    batch.time = [&w, blocks](std::size_t slice) {
        Batch of_slice(*blocks, w.slice(slice));
        g_found += static_cast<int>(Batch(*blocks, w.before(slice)).ask());
        const auto begin = ThreadClock::now();
        g_found += static_cast<int>(of_slice.ask());
        return mobbscope::nanoseconds(ThreadClock::now() - begin);
    };
    batch.answers = [&w, blocks] {
        Answers out;
        for (std::size_t slice = 0; slice < w.slices; ++slice) {
            Batch of_slice(*blocks, w.slice(slice));
            of_slice.ask();
            for (const char hit : of_slice.hits) out.add(hit != 0);
        }
        return out;
    };
    batch.count = [&w, blocks] {
        Batch of_slice(*blocks, w.slice(0));
        compare_counted([&] { g_found += static_cast<int>(of_slice.ask()); });
    };
    rows.push_back(std::move(batch));
    rows.push_back(fit_row("fit blocks", w, [](const ClipPtr& clip) { return Blocks(clip).clip().count() > 0; }));
}
#endif

/// All that this state of the library has but those of blocks, which have rows of their own.
std::vector<TreeKind> fitted_kinds() {
    std::vector<TreeKind> out;
    for (const std::string_view kind : tree_kind_names())
        if (kind != "blocks" && kind != "production") out.push_back(*tree_kind_from_name(kind));
    return out;
}

std::vector<Row> rows_of(const Workload& w) {
    std::vector<Row> rows;
    rows.push_back(pair_row<PlacedClip, ClipPtr>(
        "brute", w, std::make_shared<const std::vector<ClipPtr>>(w.clips),
        [](const Pair<PlacedClip>& pair, auto& observer) { return direct_search(pair.a, pair.b, observer); }));
    add_tree(rows, w, "mobb 1 level", options_of(TreeKind::mobb, 10, 1));
    add_tree(rows, w, "umobb 1 level", options_of(TreeKind::umobb, 10, 1));
    for (const int leaf : {10, 20, 30, 50}) {
        add_tree(rows, w, "mobb leaf " + std::to_string(leaf), options_of(TreeKind::mobb, leaf));
    }
    for (const TreeKind kind : fitted_kinds()) {
        if (kind != TreeKind::mobb) add_tree(rows, w, std::string(name(kind)) + " leaf 10", options_of(kind, 10));
    }
#ifdef COMPARE_BLOCKS
    add_blocks(rows, w);
#endif
    for (const TreeKind kind : fitted_kinds()) {
        rows.push_back(fit_row("fit " + std::string(name(kind)), w,
                               [kind](const ClipPtr& clip) { return Tree(clip, options_of(kind, 10)).depth() > 0; }));
    }
    return rows;
}

Row& row_named(std::vector<Row>& rows, const std::string& name) {
    const auto row = std::find_if(rows.begin(), rows.end(), [&](const Row& each) { return each.name == name; });
    if (row == rows.end()) throw std::runtime_error("no row " + name);
    return *row;
}

void run(int argc, char** argv) {
    if (argc < 7) throw std::runtime_error("see the head of driver.cpp for what is to be given");
    Workload w;
    const std::uint64_t seed = std::strtoull(argv[3], nullptr, 10);
    w.slices = std::strtoull(argv[6], nullptr, 10);
    int next = 7;
    std::string counted;
    if (next + 1 < argc && std::string_view(argv[next]) == "--count") counted = argv[next + 1], next += 2;
    for (; next < argc; ++next) w.clips.push_back(bench::clip_from_csv(argv[next]));
    if (w.clips.empty()) {
        w.clips = std::string_view(argv[1]) == "long" ? mobbscope::walks_in_a_volume(14, 42, seed)
                                                      : mobbscope::short_moves(51, 2.1, seed);
    }
    w.queries = mobbscope::random_queries(w.clips, std::atoi(argv[2]),
                                          {.range = std::atof(argv[4]), .offset = std::atof(argv[5]), .seed = seed});
    std::vector<Row> rows = rows_of(w);
    if (!counted.empty()) {
        row_named(rows, counted).count();
        std::cout << static_cast<std::int64_t>(row_named(rows, counted).amount(0)) << '\n';
        return;
    }
    for (std::string line; std::getline(std::cin, line);) {
        std::istringstream in(line);
        std::string command;
        std::getline(in, command, '\t');
        std::string row;
        std::getline(in, row, '\t');
        if (command == "rows") {
            for (const Row& each : rows) {
                std::cout << each.name << ':' << each.unit << ':' << static_cast<std::int64_t>(each.amount(0)) << '\t';
            }
        } else if (command == "answers") {
            const auto& ask = row_named(rows, row).answers;
            if (!ask) {
                std::cout << "-";
            } else {
                const Answers answers = ask();
                std::cout << answers.hits << ' ' << answers.bits.value << ' '
                          << (answers.contacts ? std::to_string(answers.contacts->value) : "-") << ' '
                          << answers.counts.value_or("-");
            }
        } else if (command == "time") {
            std::size_t slice = 0;
            in >> slice;
            std::cout << row_named(rows, row).time(slice);
        } else {
            throw std::runtime_error("no command " + command);
        }
        std::cout << std::endl;
    }
}

}  // namespace

int main(int argc, char** argv) {
    try {
        run(argc, argv);
        return g_found < 0;
    } catch (const std::exception& error) {
        std::cerr << "compare_driver: " << error.what() << '\n';
        return 2;
    }
}
