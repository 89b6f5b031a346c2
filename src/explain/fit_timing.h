/// What queries take with several fits, measured on this machine.
#pragma once

#include <explain/query_workload.h>
#include <mobb/tree.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

namespace mobbscope {

/// What the caches hold when a query is asked.
enum class Protocol : std::uint8_t {
    warm,  ///< what it reads: a fit's queries are asked once, then again for the clock
    cold,  ///< nothing that it reads: as in a working set of so many clips that each was driven out by others
};
inline constexpr std::array kProtocols{Protocol::warm, Protocol::cold};
/// As in files: "warm", "cold".
std::string_view name(Protocol protocol);

/// Trees of one fit, by clip.
using FitTrees = std::vector<std::shared_ptr<const mobb::Tree>>;

/// Asks queries of a fit's trees on one thread, and gives ns a query for each stretch of so many of them, the last may
/// have fewer. Tests put their own in its place.
using FitTimer = std::function<std::vector<double>(Protocol protocol, const FitTrees& trees,
                                                   std::span<const ClipQuery> queries, std::size_t stretch)>;
/// The one that measures. Clips are placed before; blocks are asked by themselves, as a program does that is to be
/// fast.
std::vector<double> time_queries(Protocol protocol, const FitTrees& trees, std::span<const ClipQuery> queries,
                                 std::size_t stretch);

/// A query's mean time, and half of the interval that it lies in beside the other fits of the same measurement: two
/// standard errors, of the rounds and of the queries that were drawn, and 1 % at least. What all fits share is left
/// out: the speed of the machine, and how costly the queries are.
struct FitTime {
    double ns = 0, error = 0;

    /// Whether it takes less for sure: the intervals do not overlap.
    bool beats(const FitTime& other) const { return ns + error < other.ns - other.error; }
};

struct FitTimes {
    std::size_t queries = 0;  ///< that were asked
    std::vector<FitTime> fits{};
};

/// Measures fits on the same queries, in eleven rounds, or of `cold` in five. In a round they take turns after each
/// block of queries, in an order that is drawn anew each time, from a fixed seed; for each round the trees are laid
/// elsewhere in memory. How long a turn takes is compared with the other turns at the same block, so no fit gains where
/// the machine slows down; of the rounds the median counts. A fit's time does not depend on which others are measured
/// beside it.
///
/// At most 16,384 queries are asked, of `cold` at most 1024, fewer of long clips: the first ones. `is_sample`: they
/// stand for more than themselves. Requires fits and queries. `tell` is called now and then; it may throw to end the
/// work.
FitTimes time_fits(std::span<const FitTrees> fits, std::span<const ClipQuery> queries, bool is_sample,
                   Protocol protocol, const FitTimer& timer, const std::function<void()>& tell);

}  // namespace mobbscope
