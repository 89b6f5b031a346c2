/// Many fits of the same clips on the same queries: which of them costs least?
#pragma once

#include <explain/query_workload.h>
#include <mobb/tree.h>
#include <scene/scene.h>

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

    friend bool operator==(const SweepValues&, const SweepValues&) = default;
};

/// What a fit costs.
enum class SweepCost {
    price,  ///< tests times their prices (prices_of): the same on every machine
    time,   ///< measured on one thread, the fits in turns
};
/// As in files and on the command line: "price", "time".
std::string_view name(SweepCost cost);
std::optional<SweepCost> sweep_cost_from_name(std::string_view name);
/// "ns, tests times price", "ns, measured"
std::string_view unit_of(SweepCost cost);

struct SweepOrder {
    mobb::FitOptions present;  ///< is always tried; options that are not varied are as in it
    std::vector<mobb::TreeKind> trees{};
    std::vector<mobb::Axes> axes{};
    SweepValues leaf{}, time_scale{};
    SweepCost cost = SweepCost::price;
    std::size_t most_queries = kMostJudgedBy;  ///< fewer are asked if fewer tell the fits apart

    bool varies() const {
        return !trees.empty() || !axes.empty() || !leaf.values.empty() || !time_scale.values.empty();
    }

    friend bool operator==(const SweepOrder&, const SweepOrder&) = default;
};

/// All kinds of trees, and leaves from 1 to 200.
SweepOrder usual_sweep(const mobb::FitOptions& present);

/// Reads what an option is varied over: "tree=all", "leaf=5,10,20", "time_scale=0.1:30". Throws std::invalid_argument,
/// saying what is allowed; also if the option is varied already.
void set_over(SweepOrder& order, std::string_view text);
/// Throws likewise.
void check(const SweepOrder& order);

/// The queries in which a clip takes part.
struct SweepClip {
    std::size_t queries = 0;
    MeanTests tests{};
    Spread cost{};
};

struct SweepRow {
    mobb::FitOptions fit;                         ///< options that do not matter to its kind are the present ones
    MeanTests tests;                              ///< of a query, mean
    Spread cost;                                  ///< of a query, ns; measured time has no quantiles, they are 0
    double difference = 0, difference_error = 0;  ///< to the recommended fit: mean over the queries, standard error
    std::size_t nodes = 0, bytes = 0;             ///< of the trees of all clips
    std::vector<SweepClip> clips{};               ///< if there are several; none for measured time and before the end
};

/// Another fit that would serve a clip better than the recommended one.
struct SweepException {
    int clip = 0;
    std::size_t row = 0;
    double saving = 0;  ///< a share of the cost of the recommended one, in the queries in which the clip takes part
};

struct SweepResult {
    SweepOrder order;
    std::size_t queries = 0;       ///< that each row was asked, the first of the workload
    std::vector<SweepRow> rows{};  ///< by tree, axes, time scale and leaf
    std::size_t present = 0, recommended = 0;
    std::size_t flat_from = 0, flat_to = 0;    ///< rows around the recommended one that cost at most 1 % more
    std::string why{};                         ///< one sentence; empty before the end
    std::vector<SweepException> exceptions{};  ///< by clip, those that save more than 5 %; none before the end
};

/// Is given the rows so far, one thread at a time; it may keep them. They always have the present fit.
using SweepPass = std::function<void(const std::shared_ptr<const SweepResult>&)>;

/// Tries the fits of an order. An option that does not matter to a kind of tree is not varied for it. A range is tried
/// at 12 values by equal factors; if there are two ranges, the time scales are tried at the best leaf. Then nearer
/// values follow, around the best fit of each kind that costs at most 5 % more than the best of all or of the second
/// best kind, until the next ones cost at most 1 % more; the search ends early at 5000 rows. All rows are asked the
/// same queries. The number of queries doubles until the best fit differs from all others by 3 standard errors of the
/// paired difference, or by less than 1 %. The present fit stays recommended unless another costs at least 1 % less.
///
/// Measured time compares fits that are measured in turns, a pass at a time; between passes the machine may change its
/// speed. Otherwise the result depends on the arguments alone, not on the machine.
///
/// Requires clips and queries. `progress` is told how many rows are done, of those known so far, by one thread at a
/// time; it may throw to end the work. Throws std::invalid_argument as check does, if the order has more than 5000
/// fits, or if a placement is not valid.
SweepResult sweep_fits(std::span<const mobb::ClipPtr> clips, const QueryWorkload& workload, const SweepOrder& order,
                       const Progress& progress = {}, const SweepPass& pass = {});

/// "moving boxes, leaf 34": the options that matter to the kind. Levels and time scale only if they are not the usual
/// ones, axes only if they are not the usual ones or not as in `base`.
std::string sweep_words(const mobb::FitOptions& fit, const mobb::FitOptions& base);

}  // namespace mobbscope
