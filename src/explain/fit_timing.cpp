#include <base/median.h>
#include <base/random.h>
#include <base/thread_clock.h>
#include <explain/fit_timing.h>
#include <mobb/query.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numeric>
#include <utility>

#if defined(__x86_64__)
#include <emmintrin.h>
#endif

namespace mobbscope {

namespace {

constexpr std::size_t kLine = 64;         // bytes of a cache's line
constexpr std::size_t kLeastAsked = 256;  // queries that are timed together: the clock takes as long as some
constexpr std::size_t kFewestStretches = 32;
constexpr double kOutlier = 2;        // times the median of its rounds: something else ran meanwhile
constexpr double kErrors = 2;         // standard errors on either side
constexpr double kLeastError = 0.01;  // as a share: so much a program differs from one start to the next

/// How queries are divided.
struct Division {
    std::size_t rounds;
    std::size_t asked;    ///< of all
    std::size_t block;    ///< asked of a fit in one turn
    std::size_t stretch;  ///< timed together
};

#if !defined(__x86_64__)
/// Reads more than the caches next to a processor hold.
void read_other_memory() {
    static const std::vector<unsigned char> other(std::size_t{8} << 20, 1);
    static volatile unsigned sum = 0;
    for (std::size_t i = 0; i < other.size(); i += kLine) sum = sum + other[i];
}
#endif

using Memory = std::vector<std::span<const std::byte>>;

void drive_out(const Memory& memory) {
#if defined(__x86_64__)
    for (const std::span<const std::byte> part : memory) {
        for (std::size_t i = 0; i < part.size(); i += kLine) _mm_clflush(part.data() + i);
        if (!part.empty()) _mm_clflush(&part.back());
    }
    _mm_mfence();
#else
    if (!memory.empty()) read_other_memory();
#endif
}

/// What a query may read of a tree and its clip.
Memory memory_of(const mobb::Tree& tree) {
    Memory out{std::as_bytes(tree.clip().samples())};
    if (const mobb::Blocks* blocks = tree.blocks()) {
        // All of their numbers are in one array, the samples first.
        const float* const first = blocks->samples().x - mobb::Blocks::kRun;
        out.push_back(std::as_bytes(std::span(first, (blocks->bytes() - sizeof(mobb::Blocks)) / sizeof(float))));
        return out;
    }
    out.push_back(std::as_bytes(tree.nodes()));
    for (int i = 0; i < static_cast<int>(tree.nodes().size()); ++i) {
        if (!mobb::is_upright(tree.node(i).kind)) out.push_back(std::as_bytes(std::span(&tree.stored_box(i), 1)));
    }
    return out;
}

/// Of a tree and its clip.
std::size_t bytes_of(const mobb::Tree& tree) { return tree.bytes() + tree.clip().samples().size_bytes(); }

template <class Placed>
void ask(const Placed* pair) {
    // An answer that nobody reads would not be asked for.
    [[maybe_unused]] const volatile bool answer = mobb::query(pair[0], pair[1]).has_value();
}

/// ns a query, of each stretch. Each is repeated until the clock's own time vanishes.
template <class Placed>
std::vector<double> time_warm(const std::vector<Placed>& placed, std::size_t stretch) {
    const std::size_t count = placed.size() / 2;
    for (std::size_t i = 0; i < count; ++i) ask(&placed[2 * i]);
    std::vector<double> out;
    for (std::size_t first = 0; first < count; first += stretch) {
        const std::size_t end = std::min(first + stretch, count);
        const std::size_t times = (kLeastAsked + end - first - 1) / (end - first);
        const auto begin = ThreadClock::now();
        for (std::size_t k = 0; k < times; ++k) {
            for (std::size_t i = first; i < end; ++i) ask(&placed[2 * i]);
        }
        out.push_back(nanoseconds(ThreadClock::now() - begin) / static_cast<double>(times * (end - first)));
    }
    return out;
}

/// The same, each query by itself. The clock of the thread takes longer than a query; what this one takes is left out.
template <class Placed>
std::vector<double> time_cold(const std::vector<Placed>& placed, const std::vector<const Memory*>& memory,
                              std::size_t stretch) {
    using Clock = std::chrono::steady_clock;
    const auto ns = [](Clock::duration taken) { return std::chrono::duration<double, std::nano>(taken).count(); };
    double clock = ns(Clock::duration::max());
    for (int i = 0; i < 20; ++i) {
        const auto begin = Clock::now();
        clock = std::min(clock, ns(Clock::now() - begin));
    }
    const std::size_t count = placed.size() / 2;
    std::vector<double> out;
    for (std::size_t first = 0; first < count; first += stretch) {
        const std::size_t end = std::min(first + stretch, count);
        double sum = 0;
        for (std::size_t i = first; i < end; ++i) {
            drive_out(*memory[2 * i]);
            drive_out(*memory[2 * i + 1]);
            const auto begin = Clock::now();
            ask(&placed[2 * i]);
            sum += std::max(ns(Clock::now() - begin) - clock, 0.0);
        }
        out.push_back(sum / static_cast<double>(end - first));
    }
    return out;
}

template <class Place>
std::vector<double> time_placed(Protocol protocol, const FitTrees& trees, std::span<const ClipQuery> queries,
                                std::size_t stretch, const Place& place) {
    std::vector<decltype(place(*trees[0], queries[0].place_a))> placed;
    placed.reserve(2 * queries.size());
    const auto tree = [&](int clip) -> const mobb::Tree& { return *trees[static_cast<std::size_t>(clip)]; };
    for (const ClipQuery& query : queries) {
        placed.push_back(place(tree(query.clip_a), query.place_a));
        placed.push_back(place(tree(query.clip_b), query.place_b));
    }
    if (protocol == Protocol::warm) return time_warm(placed, stretch);
    std::vector<Memory> by_clip(trees.size());
    std::vector<const Memory*> memory;
    for (const ClipQuery& query : queries) {
        for (const int clip : {query.clip_a, query.clip_b}) {
            Memory& of = by_clip[static_cast<std::size_t>(clip)];
            if (of.empty()) of = memory_of(tree(clip));
            memory.push_back(&of);
        }
    }
    return time_cold(placed, memory, stretch);
}

Division division(std::span<const FitTrees> fits, std::span<const ClipQuery> queries, Protocol protocol) {
    if (protocol == Protocol::warm) {
        constexpr std::size_t kRounds = 11, kMost = 16'384, kBlock = 1024;
        const std::size_t asked = std::min(queries.size(), kMost);
        const std::size_t stretch = std::clamp<std::size_t>(asked / kFewestStretches, 1, kLeastAsked);
        return {kRounds, asked, std::max<std::size_t>(kBlock / stretch, 1) * stretch, stretch};
    }
    // To drive memory out takes longest.
    constexpr std::size_t kRounds = 5, kMost = 1024, kFewest = 64, kBlock = 64, kMostBytes = std::size_t{6} << 30;
    std::size_t bytes = 0;
    for (const FitTrees& trees : fits) {
        std::size_t of_all = 0;
        for (const auto& tree : trees) of_all += bytes_of(*tree);
        bytes += 2 * of_all / trees.size() * kRounds;
    }
    const std::size_t asked = std::clamp(kMostBytes / std::max<std::size_t>(bytes, 1), kFewest, kMost);
    return {kRounds, std::min(queries.size(), asked), kBlock, 1};
}

/// The same trees elsewhere in memory: where numbers lie by chance may cost or save some per cent.
FitTrees laid_anew(const FitTrees& trees) {
    FitTrees out;
    out.reserve(trees.size());
    for (const auto& tree : trees) {
        out.push_back(tree->blocks() ? std::make_shared<const mobb::Tree>(tree->shared_clip(), tree->options())
                                     : std::make_shared<const mobb::Tree>(*tree));
    }
    return out;
}

double mean(std::span<const double> values) {
    return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

/// The square of the standard error of the mean of numbers around `about`.
double squared_error(std::span<const double> values, double about) {
    double squares = 0;
    for (const double value : values) squares += (value - about) * (value - about);
    const double error = standard_error(squares, values.size());
    return error * error;
}

/// ns by fit, round and stretch.
using Times = std::vector<std::vector<std::vector<double>>>;

std::vector<double> over_rounds(const std::vector<std::vector<double>>& rounds, std::size_t stretch) {
    std::vector<double> out;
    out.reserve(rounds.size());
    for (const std::vector<double>& round : rounds) out.push_back(round[stretch]);
    return out;
}

void cut_outliers(Times& times) {
    for (auto& rounds : times) {
        for (std::size_t s = 0; s < rounds.front().size(); ++s) {
            const double most = kOutlier * median(over_rounds(rounds, s));
            for (std::vector<double>& round : rounds) round[s] = std::min(round[s], most);
        }
    }
}

/// As if the machine had been as fast in all rounds: the turns at a block are taken together, by their geometric mean.
void level_rounds(Times& times, std::size_t block) {
    const std::size_t stretches = times.front().front().size(), rounds = times.front().size();
    for (std::size_t first = 0; first < stretches; first += block) {
        const std::size_t count = std::min(block, stretches - first);
        std::vector<double> speeds;
        for (std::size_t round = 0; round < rounds; ++round) {
            double logs = 0;
            for (const auto& of : times)
                logs += std::log(std::max(mean(std::span(of[round]).subspan(first, count)), 1e-3));
            speeds.push_back(std::exp(logs / static_cast<double>(times.size())));
        }
        const double usual = median(speeds);
        for (auto& of : times) {
            for (std::size_t round = 0; round < rounds; ++round) {
                for (double& time : std::span(of[round]).subspan(first, count)) time *= usual / speeds[round];
            }
        }
    }
}

std::vector<FitTime> compare_times(Times times, std::size_t block, bool is_sample) {
    cut_outliers(times);
    level_rounds(times, block);
    const std::size_t stretches = times.front().front().size();
    std::vector<std::vector<double>> medians(times.size());
    std::vector<FitTime> out(times.size());
    std::vector<double> usual(stretches, 0);  // how costly a stretch is: the same for all fits
    for (std::size_t fit = 0; fit < times.size(); ++fit) {
        for (std::size_t s = 0; s < stretches; ++s) medians[fit].push_back(median(over_rounds(times[fit], s)));
        out[fit].ns = mean(medians[fit]);
        for (std::size_t s = 0; s < stretches; ++s)
            usual[s] += medians[fit][s] / std::max(out[fit].ns, 1e-3) / static_cast<double>(times.size());
    }
    // A fit is a part of what it is compared with.
    const auto fits = static_cast<double>(times.size());
    const double own_part = fits > 1 ? fits / (fits - 1) : 1;
    for (std::size_t fit = 0; fit < times.size(); ++fit) {
        std::vector<double> rounds, apart;
        for (const std::vector<double>& round : times[fit]) rounds.push_back(mean(round));
        for (std::size_t s = 0; s < stretches; ++s) apart.push_back(medians[fit][s] - usual[s] * out[fit].ns);
        const double squares = squared_error(rounds, mean(rounds)) + (is_sample ? squared_error(apart, 0) : 0);
        const double error = kErrors * std::sqrt(own_part * squares);
        out[fit].error = std::isnan(error) ? error : std::max(error, kLeastError * out[fit].ns);
    }
    return out;
}

}  // namespace

std::string_view name(Protocol protocol) { return protocol == Protocol::warm ? "warm" : "cold"; }

std::vector<double> time_queries(Protocol protocol, const FitTrees& trees, std::span<const ClipQuery> queries,
                                 std::size_t stretch) {
    if (trees.front()->blocks()) {
        return time_placed(protocol, trees, queries, stretch, [](const mobb::Tree& tree, const mobb::Placement& at) {
            return mobb::PlacedBlocks(*tree.blocks(), at);
        });
    }
    return time_placed(protocol, trees, queries, stretch,
                       [](const mobb::Tree& tree, const mobb::Placement& at) { return mobb::PlacedTree(tree, at); });
}

FitTimes time_fits(std::span<const FitTrees> fits, std::span<const ClipQuery> queries, bool is_sample,
                   Protocol protocol, const FitTimer& timer, const std::function<void()>& tell) {
    const Division divided = division(fits, queries, protocol);
    Times times(fits.size(), std::vector<std::vector<double>>(divided.rounds));
    std::vector<FitTrees> laid(fits.begin(), fits.end());
    std::vector<std::size_t> turns(fits.size());
    std::iota(turns.begin(), turns.end(), std::size_t{0});
    Uniform uniform(1);
    for (std::size_t round = 0; round < divided.rounds; ++round) {
        for (FitTrees& trees : laid) {
            trees = laid_anew(trees);
            tell();
        }
        for (std::size_t first = 0; first < divided.asked; first += divided.block) {
            const auto block = queries.subspan(first, std::min(divided.block, divided.asked - first));
            for (std::size_t left = turns.size(); left > 1; --left)
                std::swap(turns[left - 1], turns[static_cast<std::size_t>(uniform.below(static_cast<int>(left)))]);
            for (const std::size_t fit : turns) {
                const std::vector<double> taken = timer(protocol, laid[fit], block, divided.stretch);
                times[fit][round].insert(times[fit][round].end(), taken.begin(), taken.end());
                tell();
            }
        }
    }
    is_sample = is_sample || divided.asked < queries.size();
    return {divided.asked, compare_times(std::move(times), divided.block / divided.stretch, is_sample)};
}

}  // namespace mobbscope
