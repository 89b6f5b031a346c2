/// Many fits of the same clips on the same queries: which of them is fastest?
#pragma once

#include <explain/fit_timing.h>
#include <explain/query_workload.h>
#include <mobb/tree.h>
#include <scene/scene.h>

#include <array>
#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace mobbscope {

/// The values of an option that a sweep tries: those listed, or as many of a range as it needs.
struct SweepValues {
    std::vector<double> values{};  ///< a range has its least and its largest; none: the present one
    bool is_range = false;
    bool is_open = false;  ///< a range that goes on beyond its largest, where the best lies there

    friend bool operator==(const SweepValues&, const SweepValues&) = default;
};

struct SweepOrder {
    mobb::FitOptions present;  ///< is always tried; options that are not varied are as in it
    std::vector<mobb::TreeKind> trees{};
    std::vector<mobb::Axes> axes{};
    SweepValues leaf{}, time_scale{};
    std::size_t most_queries = kMostJudgedBy;  ///< more of a workload are not asked

    bool varies() const {
        return !trees.empty() || !axes.empty() || !leaf.values.empty() || !time_scale.values.empty();
    }

    friend bool operator==(const SweepOrder&, const SweepOrder&) = default;
};

/// All kinds of trees, and leaves from 1 to 200, or more where the best has more.
SweepOrder usual_sweep(const mobb::FitOptions& present);

/// Reads what an option is varied over: "tree=all", "leaf=5,10,20", "time_scale=0.1:30". Throws std::invalid_argument,
/// saying what is allowed; also if the option is varied already.
void set_over(SweepOrder& order, std::string_view text);
/// Throws likewise.
void check(const SweepOrder& order);

/// The unit of what is estimated, as in files.
inline constexpr std::string_view kEstimatedUnit = "ns, tests times price";

/// The queries in which a clip takes part.
struct SweepClip {
    std::size_t queries = 0;
    MeanTests tests{};
    Spread cost{};  ///< ns
};

/// What is counted, and what that would cost: the same on every machine.
struct SweepEstimate {
    MeanTests tests{};               ///< of a query, mean
    Spread cost{};                   ///< of a query, ns: tests times their prices
    std::vector<SweepClip> clips{};  ///< if there are several; none before the end
};

struct SweepRow {
    mobb::FitOptions fit;                     ///< options that do not matter to its kind are the present ones
    std::optional<SweepEstimate> estimate{};  ///< none of blocks: their tests have no price
    std::array<std::optional<FitTime>, kProtocols.size()> times{};  ///< by protocol; none: not worth measuring
    std::size_t nodes = 0, bytes = 0;                               ///< of the trees of all clips

    const std::optional<FitTime>& time(Protocol protocol) const { return times[static_cast<std::size_t>(protocol)]; }
};

/// Which fit to take where queries are asked so: by measured time alone.
struct SweepAdvice {
    std::optional<std::size_t> recommended{};  ///< a row; none before the end, and where intervals overlap
    std::vector<std::size_t> undecided{};  ///< rows whose intervals overlap that of the fastest, with it; it is first
    std::size_t queries = 0;               ///< that were measured
    std::string why{};                     ///< one sentence; empty before the end
};

struct SweepResult {
    SweepOrder order;
    std::size_t queries = 0;       ///< that each row was asked, the first of the workload
    std::vector<SweepRow> rows{};  ///< by tree, levels, axes, time scale and leaf
    std::size_t present = 0;
    std::array<SweepAdvice, kProtocols.size()> advice{};  ///< by protocol

    const SweepAdvice& of(Protocol protocol) const { return advice[static_cast<std::size_t>(protocol)]; }
    bool has_ended() const { return !advice.front().why.empty(); }
    /// The row that is recommended, or is the fastest of those that are undecided, or else the present one.
    std::size_t fastest(Protocol protocol) const;
};

/// Is given the rows so far, one thread at a time; it may keep them. They always have the present fit.
using SweepPass = std::function<void(const std::shared_ptr<const SweepResult>&)>;

/// Tries the fits of an order, and measures those that may be the fastest. An option that does not matter to a kind of
/// tree is not varied for it; of each kind of box the tree of one level is tried, too.
///
/// First all fits but blocks are counted on the same queries: their tests times prices are an estimate, which depends
/// on the arguments alone. A range is tried at 12 values by equal factors; if there are two ranges, the time scales are
/// tried at the best leaf. Then nearer values follow, around the best fit of each kind that costs at most 5 % more than
/// the best of all or of the second best kind, until the next ones cost at most 1 % more; the search ends early at 5000
/// rows.
///
/// Then time_fits measures, all in turns: the present fit, the best of each kind by the estimate, where these cost at
/// most 25 % more than the best of all also those with half and twice its leaf, the best tree of one level, and blocks;
/// of up to 12 fits all. As long as the fastest has neighbours that were not measured, these follow, and all are
/// measured again. A fit is recommended where its interval overlaps with no other.
///
/// Requires clips and queries. `timer`: an empty one measures nothing, and nothing is recommended. `progress` is told
/// how many rows are done, of those known so far, by one thread at a time; it may throw to end the work. Throws
/// std::invalid_argument as check does, if the order has more than 5000 fits, or if a placement is not valid.
SweepResult sweep_fits(std::span<const mobb::ClipPtr> clips, const QueryWorkload& workload, const SweepOrder& order,
                       const Progress& progress = {}, const SweepPass& pass = {}, const FitTimer& timer = time_queries);

/// "moving boxes, leaf 34", "MOBB, 1 level": the options that matter to the kind. Levels and time scale only if they
/// are not the usual ones, axes only if they are not the usual ones or not as in `base`.
std::string sweep_words(const mobb::FitOptions& fit, const mobb::FitOptions& base);

}  // namespace mobbscope
