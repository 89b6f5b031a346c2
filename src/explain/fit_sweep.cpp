#include <base/text.h>
#include <base/thread_clock.h>
#include <base/threads.h>
#include <explain/fit_sweep.h>
#include <mobb/query.h>
#include <scene/scene_json.h>

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <chrono>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <mutex>
#include <optional>
#include <set>
#include <stdexcept>
#include <tuple>
#include <utility>

namespace mobbscope {

namespace {

constexpr std::size_t kFirstValues = 12;     // of a range
constexpr std::size_t kFirstQueries = 4096;  // of placements; a scene's are all asked
constexpr std::size_t kStretch = 64;         // queries that are measured together, at least
constexpr std::size_t kMostRows = 5000;
constexpr double kMostLeaf = 1e6;
constexpr double kSame = 0.01;                 // costs nearer than this share are as good as equal
constexpr double kContender = 0.05;            // kinds within this share of the best are looked at as closely
constexpr double kException = 0.05;            // a clip that would be served better by this share is named
constexpr std::size_t kExceptionQueries = 30;  // fewer say too little of a clip
constexpr double kTold = 3;                    // standard errors that tell two fits apart
constexpr double kNextScale = 1.02;            // time scales nearer than this factor are neighbours

constexpr std::array<std::string_view, 2> kCostNames{"price", "time"};
constexpr std::array<std::string_view, 4> kOptions{"tree", "leaf", "axes", "time_scale"};

/// Three significant digits.
double rounded(double value) { return parse_double(formatted("%.3g", value)).value_or(value); }

/// For people; whole numbers in full.
std::string in_full(double value) {
    return value == std::round(value) && std::abs(value) < 1e15 ? formatted("%.0f", value) : brief(value);
}

double middle(double low, double high, bool whole) {
    const double factor = std::sqrt(low * high);
    return whole ? std::clamp(std::round(factor), low + 1, high - 1) : rounded(factor);
}

bool are_next(double low, double high, bool whole) { return whole ? high - low <= 1 : high <= low * kNextScale; }

/// Values from the least to the largest, by equal factors.
std::vector<double> spread_over(double from, double to, bool whole) {
    std::vector<double> out;
    if (whole && to - from < static_cast<double>(kFirstValues)) {
        for (int i = 0; from + i <= to; ++i) out.push_back(from + i);
        return out;
    }
    for (std::size_t i = 0; i < kFirstValues; ++i) {
        const double share = static_cast<double>(i) / static_cast<double>(kFirstValues - 1);
        const double value = from * std::pow(to / from, share);
        const double near = std::clamp(whole ? std::round(value) : rounded(value), from, to);
        out.push_back(i == 0 ? from : i + 1 == kFirstValues ? to : near);
    }
    out.erase(std::unique(out.begin(), out.end()), out.end());
    return out;
}

/// The numbers of samples that nodes have, in order: leaves between two of them make the same tree.
std::vector<int> node_sizes(std::span<const mobb::ClipPtr> clips) {
    std::set<int> out{1};
    for (const mobb::ClipPtr& clip : clips) {
        // A level's nodes hold one of two numbers of samples, of which one is the next.
        for (int size = clip->count(); size > 0; size /= 2) out.insert({size, size + 1});
    }
    return {out.begin(), out.end()};
}

using Trees = std::vector<std::shared_ptr<const mobb::Tree>>;

Trees fit_all(std::span<const mobb::ClipPtr> clips, const mobb::FitOptions& fit) {
    Trees out;
    out.reserve(clips.size());
    for (const mobb::ClipPtr& clip : clips) out.push_back(std::make_shared<const mobb::Tree>(clip, fit));
    return out;
}

/// What was measured of a fit.
struct Measured {
    mobb::FitOptions fit;
    MeanTests tests;                      ///< sums
    std::vector<double> costs{};          ///< of each query, ns; of measured time of each stretch of queries
    std::vector<MeanTests> clip_tests{};  ///< sums over the queries in which a clip takes part; of one clip none
    std::size_t nodes = 0, bytes = 0;

    double mean() const {
        double sum = 0;
        for (const double cost : costs) sum += cost;
        return sum / static_cast<double>(costs.size());
    }
};

struct Difference {
    double mean = 0, error = 0;
};

/// Of two fits on the same queries.
Difference difference(const std::vector<double>& costs, const std::vector<double>& from) {
    assert(costs.size() == from.size());
    const auto count = static_cast<double>(costs.size());
    double sum = 0, squares = 0;
    for (std::size_t i = 0; i < costs.size(); ++i) sum += costs[i] - from[i];
    const double mean = sum / count;
    for (std::size_t i = 0; i < costs.size(); ++i) {
        const double off = costs[i] - from[i] - mean;
        squares += off * off;
    }
    return {mean, standard_error(squares, costs.size())};
}

/// Whether a fit costs more than another for sure. A single number does not say.
bool is_sure(const Difference& more) { return more.mean >= kTold * more.error; }

/// Fits that differ by what is searched as a range alone.
struct Family {
    bool leaf_range = false, scale_range = false;
    std::map<std::pair<double, int>, std::size_t> points{};  ///< by time scale and leaf: what was measured
    std::set<double> leaves{}, scales{};                     ///< that any point has
};

MeanTests as_sums(const mobb::TestCounts& counts) { return mean_tests(std::span(&counts, 1)); }

class FitSearch {
  public:
    FitSearch(std::span<const mobb::ClipPtr> clips, const QueryWorkload& workload, const SweepOrder& order,
              const Progress& progress, const SweepPass& pass)
        : clips_(clips), order_(order), progress_(progress), pass_(pass), sizes_(node_sizes(clips)) {
        const std::size_t most = std::max<std::size_t>(order.most_queries, 1);
        queries_ = std::span(workload.queries).first(std::min(workload.queries.size(), most));
        placements_ = workload.kind == QueryWorkload::Kind::placements;
        asked_ = to_ask(placements_ ? kFirstQueries : queries_.size());
    }

    SweepResult run() {
        plan();
        measure_new();
        add_time_scales();
        for (;;) {
            measure_new();
            if (refine()) continue;
            if (asked_ == queries_.size() || told_apart()) return result(true);
            ask_more();
        }
    }

  private:
    const Measured& at(std::size_t point) const { return *measured_[point]; }

    /// All queries are divided into stretches of equal size, give or take one query. So a fit that is measured in parts
    /// has the same stretches as one that is measured at once.
    std::size_t stretch_count() const { return std::max<std::size_t>(queries_.size() / kStretch, 1); }
    std::size_t stretch_begin(std::size_t stretch) const { return stretch * queries_.size() / stretch_count(); }
    /// The first that begins at that query or later.
    std::size_t stretch_from(std::size_t query) const {
        return (query * stretch_count() + queries_.size() - 1) / queries_.size();
    }

    /// About so many queries, of which measured time has whole stretches.
    std::size_t to_ask(std::size_t count) const {
        const std::size_t some = std::min(count, queries_.size());
        return order_.cost == SweepCost::time ? stretch_begin(stretch_from(some)) : some;
    }

    /// The options that matter to a kind; the others as they are now.
    mobb::FitOptions that_matter(mobb::FitOptions fit) const {
        const mobb::TreeInfo& kind = mobb::info(fit.tree);
        if (!kind.splits()) {
            fit.leaf = order_.present.leaf;
            fit.levels = order_.present.levels;
        }
        if (!kind.chooses_axes()) fit.axes = order_.present.axes;
        if (!kind.uses_time_scale()) fit.time_scale = order_.present.time_scale;
        return fit;
    }

    void add(Family& family, const mobb::FitOptions& fit) {
        const std::pair<double, int> place{fit.time_scale, fit.leaf};
        if (family.points.contains(place)) return;
        if (is_full()) throw std::invalid_argument(too_many());
        const int size = *std::prev(std::ranges::upper_bound(sizes_, std::max(fit.leaf, 1)));
        const auto [known, is_new] =
            same_trees_.try_emplace({fit.tree, fit.axes, fit.time_scale, size}, measured_.size());
        if (is_new) measured_.push_back(std::make_shared<const Measured>(Measured{.fit = fit, .tests = {}}));
        family.points.emplace(place, known->second);
        family.leaves.insert(fit.leaf);
        family.scales.insert(fit.time_scale);
        ++rows_;
    }

    bool is_full() const { return rows_ >= kMostRows; }

    static std::string too_many() {
        return "a sweep has " + std::to_string(kMostRows) + " fits at most; give fewer values, or a range A:B";
    }

    /// The fits that are tried at first.
    void plan() {
        using Key = std::tuple<mobb::TreeKind, mobb::Axes, double, double>;
        std::map<Key, Family> families;
        const auto or_present = [](const auto& values, auto present) {
            return values.empty() ? std::vector<decltype(present)>{present} : values;
        };
        const auto listed_or_one = [](const SweepValues& values, double present) {
            if (values.values.empty()) return std::vector<double>{present};
            if (!values.is_range) return values.values;
            return std::vector<double>{std::clamp(present, values.values[0], values.values[1])};
        };
        for (const mobb::TreeKind tree : or_present(order_.trees, order_.present.tree)) {
            for (const mobb::Axes axes : or_present(order_.axes, order_.present.axes)) {
                for (const double leaf : listed_or_one(order_.leaf, order_.present.leaf)) {
                    for (const double scale : listed_or_one(order_.time_scale, order_.present.time_scale)) {
                        mobb::FitOptions fit = order_.present;
                        fit.tree = tree;
                        fit.axes = axes;
                        fit.leaf = static_cast<int>(leaf);
                        fit.time_scale = scale;
                        fit = that_matter(fit);
                        Family& family = families[{fit.tree, fit.axes, fit.leaf, fit.time_scale}];
                        family.leaf_range = order_.leaf.is_range && mobb::info(tree).splits();
                        family.scale_range = order_.time_scale.is_range && mobb::info(tree).uses_time_scale();
                        if (!family.leaf_range) {
                            add(family, fit);
                            continue;
                        }
                        for (const double each : values_of(order_.leaf, true)) {
                            fit.leaf = static_cast<int>(each);
                            add(family, fit);
                        }
                    }
                }
            }
        }
        for (auto& [key, family] : families) families_.push_back(std::move(family));
        add_present();
        const auto searched = static_cast<std::size_t>(std::ranges::count_if(families_, &Family::scale_range));
        if (rows_ + searched * kFirstValues > kMostRows) throw std::invalid_argument(too_many());
    }

    static std::set<double> values_of(const SweepValues& range, bool whole) {
        const std::vector<double> values = spread_over(range.values[0], range.values[1], whole);
        return {values.begin(), values.end()};
    }

    /// The present fit joins the family whose list or range has it. Otherwise it stands alone, so that no search leaves
    /// its range.
    void add_present() {
        const mobb::FitOptions& present = order_.present;
        const auto is_in = [](const SweepValues& range, double value) {
            return range.values[0] <= value && value <= range.values[1];
        };
        const auto takes = [&](const Family& family) {
            const auto& [place, first] = *family.points.begin();
            mobb::FitOptions fit = at(first).fit;
            fit.leaf = present.leaf;
            fit.time_scale = present.time_scale;
            return fit == present &&
                   (family.leaf_range ? is_in(order_.leaf, present.leaf) : place.second == present.leaf) &&
                   (family.scale_range ? is_in(order_.time_scale, present.time_scale)
                                       : place.first == present.time_scale);
        };
        auto family = std::ranges::find_if(families_, takes);
        if (family == families_.end()) family = families_.insert(families_.end(), Family{});
        add(*family, present);
        present_ = family->points.at({present.time_scale, present.leaf});
    }

    /// Of two ranges the second is tried at the best of the first.
    void add_time_scales() {
        for (std::size_t i = 0; i < families_.size(); ++i) {
            if (!families_[i].scale_range) continue;
            mobb::FitOptions fit = at(best_of(i).measured).fit;
            fit.leaf = best_of(i).at.second;
            for (const double scale : values_of(order_.time_scale, false)) {
                fit.time_scale = scale;
                add(families_[i], fit);
            }
        }
    }

    /// A pass over the fits that nothing is known of yet.
    void measure_new() {
        std::vector<std::size_t> fresh;
        for (std::size_t i = 0; i < measured_.size(); ++i) {
            if (at(i).costs.empty()) fresh.push_back(i);
        }
        // The present fit comes first: what is shown is compared with it.
        const auto present = std::ranges::find(fresh, present_);
        if (present != fresh.end()) std::rotate(fresh.begin(), present, present + 1);
        measure(fresh, 0);
    }

    void ask_more() {
        const std::size_t first = asked_;
        asked_ = to_ask(2 * asked_);
        std::vector<std::size_t> all(measured_.size());
        for (std::size_t i = 0; i < all.size(); ++i) all[i] = i;
        done_ = 0;
        measure(all, first);
    }

    /// Adds the queries [first, asked_) to what is known of fits.
    void measure(const std::vector<std::size_t>& points, std::size_t first) {
        order_.cost == SweepCost::time ? time(points, first) : count(points, first);
        tell_rows();
    }

    /// Each fit on one processor: so no more trees are kept than there are processors.
    void count(const std::vector<std::size_t>& points, std::size_t first) {
        limit_worker_threads();
        tbb::parallel_for(std::size_t{0}, points.size(), [&](std::size_t i) {
            Measured more = at(points[i]);
            const Trees trees = fit_all(clips_, more.fit);
            note_size(more, trees);
            more.clip_tests.resize(clips_.size() > 1 ? clips_.size() : 0);
            more.costs.reserve(asked_);
            const MeanTests& prices = prices_of(more.fit.tree);
            constexpr std::size_t kTogether = 1024;
            for (std::size_t q = first; q < asked_; ++q) {
                const ClipQuery& asked = queries_[q];
                const MeanTests tests = as_sums(count_tests(asked, trees));
                more.tests += tests;
                more.costs.push_back(cost_of(tests, prices));
                if (!more.clip_tests.empty()) {
                    more.clip_tests[static_cast<std::size_t>(asked.clip_a)] += tests;
                    if (asked.clip_b != asked.clip_a) more.clip_tests[static_cast<std::size_t>(asked.clip_b)] += tests;
                }
                if ((q - first) % kTogether == kTogether - 1) tell(0);
            }
            publish(points[i], std::move(more), first == 0);
        });
    }

    static void note_size(Measured& of, const Trees& trees) {
        of.nodes = of.bytes = 0;
        for (const auto& tree : trees) {
            of.nodes += tree->nodes().size();
            of.bytes += tree->bytes();
        }
    }

    /// As many fits at a time as fit into some memory, in turns after each stretch of queries; the least of some rounds
    /// counts.
    void time(const std::vector<std::size_t>& points, std::size_t first) {
        constexpr std::size_t kMostBytes = std::size_t{1} << 29;
        for (std::size_t begin = 0; begin < points.size();) {
            std::vector<Trees> trees;
            std::size_t bytes = 0, end = begin;
            for (; end < points.size() && (end == begin || bytes < kMostBytes); ++end) {
                trees.push_back(fit_all(clips_, at(points[end]).fit));
                for (const auto& tree : trees.back()) bytes += tree->bytes();
                tell(0);
            }
            time_in_turns(std::span(points).subspan(begin, end - begin), trees, first);
            begin = end;
        }
    }

    void time_in_turns(std::span<const std::size_t> points, const std::vector<Trees>& trees, std::size_t first) {
        constexpr int kRounds = 5;
        std::vector<Measured> more;
        for (std::size_t i = 0; i < points.size(); ++i) {
            more.push_back(at(points[i]));
            note_size(more.back(), trees[i]);
            // The counts that go with it.
            for (std::size_t q = first; q < asked_; ++q) {
                more.back().tests += as_sums(count_tests(queries_[q], trees[i]));
            }
            tell(0);
        }
        const std::size_t begin = stretch_from(first), end = stretch_from(asked_);
        std::vector<std::vector<double>> least(
            points.size(), std::vector<double>(end - begin, std::numeric_limits<double>::infinity()));
        for (int round = 0; round < kRounds; ++round) {
            for (std::size_t stretch = begin; stretch < end; ++stretch) {
                const std::size_t from = stretch_begin(stretch), count = stretch_begin(stretch + 1) - from;
                for (std::size_t i = 0; i < points.size(); ++i) {
                    const double taken = time_queries(trees[i], queries_.subspan(from, count));
                    double& of = least[i][stretch - begin];
                    of = std::min(of, taken / static_cast<double>(count));
                }
                tell(0);
            }
        }
        for (std::size_t i = 0; i < points.size(); ++i) {
            more[i].costs.insert(more[i].costs.end(), least[i].begin(), least[i].end());
            publish(points[i], std::move(more[i]), first == 0);
        }
    }

    /// ns. Blocks are asked by themselves, as a program does that is to be fast.
    double time_queries(const Trees& trees, std::span<const ClipQuery> queries) {
        const auto time = [&](const auto& place) {
            std::vector<decltype(place(queries[0].clip_a, queries[0].place_a))> placed;
            for (const ClipQuery& asked : queries) {
                placed.push_back(place(asked.clip_a, asked.place_a));
                placed.push_back(place(asked.clip_b, asked.place_b));
            }
            const auto begin = ThreadClock::now();
            for (std::size_t i = 0; i < placed.size(); i += 2) hits_ += mobb::query(placed[i], placed[i + 1]) ? 1U : 0U;
            return nanoseconds(ThreadClock::now() - begin);
        };
        const auto tree = [&](int clip) -> const mobb::Tree& { return *trees[static_cast<std::size_t>(clip)]; };
        if (trees.front()->blocks()) {
            return time(
                [&](int clip, const mobb::Placement& at) { return mobb::PlacedBlocks(*tree(clip).blocks(), at); });
        }
        return time([&](int clip, const mobb::Placement& at) { return mobb::PlacedTree(tree(clip), at); });
    }

    void publish(std::size_t point, Measured&& measured, bool show) {
        auto ready = std::make_shared<const Measured>(std::move(measured));
        const std::scoped_lock lock(telling_);
        measured_[point] = std::move(ready);
        tell_locked(1);
        // While more queries are asked, rows cannot be compared.
        const bool can_compare = show && !at(present_).costs.empty();
        if (can_compare && Clock::now() - shown_ > kBetweenPasses) tell_rows();
    }

    void tell(std::size_t more) {
        const std::scoped_lock lock(telling_);
        tell_locked(more);
    }
    void tell_locked(std::size_t more) {
        done_ += more;
        if (progress_) progress_(done_, measured_.size());
    }

    void tell_rows() {
        if (pass_) pass_(std::make_shared<const SweepResult>(result(false)));
        shown_ = Clock::now();
    }

    struct Place {
        std::size_t family = 0;
        std::pair<double, int> at{};
        std::size_t measured = 0;
    };

    /// The cheapest of a family; of equal ones the first.
    Place best_of(std::size_t family) const {
        Place out{.family = family};
        double least = std::numeric_limits<double>::infinity();
        for (const auto& [place, point] : families_[family].points) {
            const double mean = at(point).mean();
            if (mean >= least) continue;
            least = mean;
            out.at = place;
            out.measured = point;
        }
        return out;
    }

    /// Adds fits around the best of each family that may have the best of all, or of the second best kind. Returns
    /// whether there were any to add.
    bool refine() {
        const std::vector<std::size_t> leaders = leading();
        const std::size_t before = rows_;
        for (std::size_t i = 0; i < families_.size(); ++i) {
            const Place place = best_of(i);
            const double cost = at(place.measured).mean();
            const auto is_near = [&](std::size_t leader) {
                return cost >= at(leader).mean() && cost <= at(leader).mean() * (1 + kContender);
            };
            if (std::ranges::none_of(leaders, is_near)) continue;
            if (families_[i].leaf_range) refine_along(place, true);
            if (families_[i].scale_range) refine_along(place, false);
        }
        return rows_ > before;
    }

    /// The best fit, and the best of another kind, if there is one.
    std::vector<std::size_t> leading() const {
        std::vector<std::size_t> out;
        for (int rank = 0; rank < 2; ++rank) {
            std::optional<std::size_t> best;
            for (std::size_t i = 0; i < measured_.size(); ++i) {
                if (!out.empty() && at(i).fit.tree == at(out.front()).fit.tree) continue;
                if (!best || at(i).mean() < at(*best).mean()) best = i;
            }
            if (best) out.push_back(*best);
        }
        return out;
    }

    void refine_along(const Place& best, bool is_leaf) {
        Family& family = families_[best.family];
        const double here = is_leaf ? best.at.second : best.at.first;
        const double cost = at(best.measured).mean();
        const auto with = [&](double value) {
            mobb::FitOptions fit = at(best.measured).fit;
            fit.time_scale = is_leaf ? best.at.first : value;
            fit.leaf = is_leaf ? static_cast<int>(value) : best.at.second;
            return fit;
        };
        const auto look_at = [&](double next) {
            const auto known = family.points.find({with(next).time_scale, with(next).leaf});
            if (is_full()) return;
            if (known == family.points.end()) {
                add(family, with(next));
                return;
            }
            const double low = std::min(here, next), high = std::max(here, next);
            if (are_next(low, high, is_leaf) || at(known->second).mean() - cost <= kSame * cost) return;
            const double between = middle(low, high, is_leaf);
            if (between > low && between < high) add(family, with(between));
        };
        const std::set<double>& tried = is_leaf ? family.leaves : family.scales;
        const auto above = tried.upper_bound(here), found = tried.lower_bound(here);
        const std::optional<double> next_above = above == tried.end() ? std::nullopt : std::optional(*above);
        if (found != tried.begin()) look_at(*std::prev(found));
        if (next_above) look_at(*next_above);
    }

    /// Whether the best fit, and that of the second best kind, differ for sure from all that cost more, or by too
    /// little to matter.
    bool told_apart() const {
        return std::ranges::all_of(leading(), [this](std::size_t leader) {
            return std::ranges::none_of(measured_, [&](const auto& other) {
                const Difference apart = difference(other->costs, at(leader).costs);
                return apart.mean > kSame * at(leader).mean() && !is_sure(apart);
            });
        });
    }

    /// The rows that are known; the present one is among them.
    SweepResult result(bool is_last) const {
        SweepResult out{.order = order_};
        out.queries = asked_;
        std::vector<std::pair<mobb::FitOptions, std::size_t>> rows;
        for (const Family& family : families_) {
            for (const auto& [place, point] : family.points) {
                if (at(point).costs.empty()) continue;
                mobb::FitOptions fit = at(point).fit;
                fit.time_scale = place.first;
                fit.leaf = place.second;
                rows.emplace_back(fit, point);
            }
        }
        std::ranges::sort(rows, {}, [](const auto& row) {
            const mobb::FitOptions& fit = row.first;
            return std::tuple(fit.tree, fit.axes, fit.time_scale, fit.leaf);
        });
        std::size_t best = 0;
        for (std::size_t i = 0; i < rows.size(); ++i) {
            if (rows[i].first == order_.present) out.present = i;
            if (at(rows[i].second).mean() < at(rows[best].second).mean()) best = i;
        }
        const double least = at(rows[best].second).mean();
        const bool stays = at(rows[out.present].second).mean() <= least * (1 + kSame);
        out.recommended = stays ? out.present : best;
        const Measured& chosen = at(rows[out.recommended].second);
        for (const auto& [fit, point] : rows) {
            const Measured& of = at(point);
            SweepRow row{.fit = fit, .tests = mean_of(of.tests, asked_), .cost = spread_of(of.costs)};
            if (order_.cost == SweepCost::time) row.cost.p95 = row.cost.p99 = row.cost.max = 0;
            const Difference from = difference(of.costs, chosen.costs);
            row.difference = from.mean;
            row.difference_error = from.error;
            row.nodes = of.nodes;
            row.bytes = of.bytes;
            out.rows.push_back(std::move(row));
        }
        find_flat(out);
        if (!is_last) return out;
        if (clips_.size() > 1 && order_.cost == SweepCost::price) add_clips(out, rows);
        out.why = why(out);
        return out;
    }

    static MeanTests mean_of(MeanTests sums, std::size_t count) {
        for (double& sum : sums.by_kind) sum /= static_cast<double>(count);
        return sums;
    }

    /// Neighbours by leaf, or where there are none by time scale, that cost as good as the same.
    static void find_flat(SweepResult& out) {
        const SweepRow& chosen = out.rows[out.recommended];
        const auto extend = [&](auto same_line) {
            const auto is_flat = [&](std::size_t i) {
                return same_line(out.rows[i].fit) && out.rows[i].cost.mean <= chosen.cost.mean * (1 + kSame);
            };
            out.flat_from = out.flat_to = out.recommended;
            while (out.flat_from > 0 && is_flat(out.flat_from - 1)) --out.flat_from;
            while (out.flat_to + 1 < out.rows.size() && is_flat(out.flat_to + 1)) ++out.flat_to;
        };
        extend([&](mobb::FitOptions fit) {
            fit.leaf = chosen.fit.leaf;
            return fit == chosen.fit;
        });
        if (out.flat_from == out.flat_to) {
            extend([&](mobb::FitOptions fit) {
                fit.time_scale = chosen.fit.time_scale;
                return fit == chosen.fit;
            });
        }
    }

    void add_clips(SweepResult& out, const std::vector<std::pair<mobb::FitOptions, std::size_t>>& rows) const {
        std::vector<std::vector<std::size_t>> takes_part(clips_.size());
        for (std::size_t q = 0; q < asked_; ++q) {
            takes_part[static_cast<std::size_t>(queries_[q].clip_a)].push_back(q);
            if (queries_[q].clip_b != queries_[q].clip_a)
                takes_part[static_cast<std::size_t>(queries_[q].clip_b)].push_back(q);
        }
        for (std::size_t clip = 0; clip < clips_.size(); ++clip) {
            const std::vector<std::size_t>& queries = takes_part[clip];
            const auto costs = [&](std::size_t row) {
                std::vector<double> all;
                all.reserve(queries.size());
                for (const std::size_t q : queries) all.push_back(at(rows[row].second).costs[q]);
                return all;
            };
            std::size_t best = out.recommended;
            for (std::size_t row = 0; row < rows.size(); ++row) {
                SweepClip of{.queries = queries.size()};
                if (!queries.empty()) {
                    of.tests = mean_of(at(rows[row].second).clip_tests[clip], queries.size());
                    of.cost = spread_of(costs(row));
                }
                out.rows[row].clips.push_back(of);
            }
            for (std::size_t row = 0; row < rows.size(); ++row) {
                if (out.rows[row].clips[clip].cost.mean < out.rows[best].clips[clip].cost.mean) best = row;
            }
            if (best == out.recommended || queries.size() < kExceptionQueries) continue;
            const double chosen = out.rows[out.recommended].clips[clip].cost.mean;
            const Difference saved = difference(costs(out.recommended), costs(best));
            if (saved.mean > kException * chosen && is_sure(saved))
                out.exceptions.push_back({static_cast<int>(clip), best, saved.mean / chosen});
        }
    }

    std::string why(const SweepResult& out) const {
        const SweepRow& chosen = out.rows[out.recommended];
        const SweepRow& now = out.rows[out.present];
        std::string text = sweep_words(chosen.fit, order_.present);
        const std::string over =
            ", over " + counted(asked_, placements_ ? "placement" : "query", placements_ ? "placements" : "queries");
        if (out.recommended == out.present) {
            const auto cheapest =
                std::ranges::min_element(out.rows, {}, [](const SweepRow& row) { return row.cost.mean; });
            text += ", as now: ";
            text += out.rows.size() == 1                     ? "nothing else was tried"
                    : cheapest->cost.mean < chosen.cost.mean ? "no other fit costs 1 % less"
                                                             : "no other fit costs less";
            text += over;
        } else {
            const auto percent = [&](double cost) { return figure(100 * cost / now.cost.mean, 2) + " %"; };
            text += ": " + percent(now.difference);
            if (std::isnan(now.difference_error)) {
                text += asked_ == 1 ? " (of one query)" : " (of one measurement)";
            } else if (!is_sure({now.difference, now.difference_error})) {
                text += " (+-" + percent(now.difference_error) + ")";
            }
            text += " less than " + sweep_words(now.fit, order_.present) + " (now)" + over;
        }
        if (out.flat_from != out.flat_to) {
            const mobb::FitOptions &from = out.rows[out.flat_from].fit, &to = out.rows[out.flat_to].fit;
            const auto range = [](const std::string& what, const std::string& first, const std::string& last) {
                return first == last ? "" : "; within 1 % from " + what + ' ' + first + " to " + last;
            };
            text += range("leaf", std::to_string(from.leaf), std::to_string(to.leaf));
            text += range("time scale", brief(from.time_scale), brief(to.time_scale));
        }
        std::vector<const SweepRow*> others;
        for (const SweepRow& row : out.rows) {
            if (row.fit.tree != chosen.fit.tree) others.push_back(&row);
        }
        if (!others.empty()) {
            const SweepRow& next =
                **std::ranges::min_element(others, {}, [](const SweepRow* row) { return row->cost.mean; });
            const double times = next.cost.mean / chosen.cost.mean;
            text += "; the next kind is " + sweep_words(next.fit, order_.present) + ", which costs ";
            text += times < 1 + kSame ? "as much within 1 %"
                    : times < 2       ? figure(100 * (times - 1), 2) + " % more"
                                      : figure(times, 2) + " times as much";
        }
        return text;
    }

    using Clock = std::chrono::steady_clock;
    static constexpr std::chrono::milliseconds kBetweenPasses{100};

    std::span<const mobb::ClipPtr> clips_;
    SweepOrder order_;
    const Progress& progress_;
    const SweepPass& pass_;
    std::vector<int> sizes_;
    std::span<const ClipQuery> queries_;
    bool placements_ = true;
    std::size_t asked_ = 0;  ///< of the queries
    std::vector<Family> families_;
    std::size_t rows_ = 0;
    std::vector<std::shared_ptr<const Measured>> measured_;
    std::size_t present_ = 0;  ///< what was measured of the present fit
    std::map<std::tuple<mobb::TreeKind, mobb::Axes, double, int>, std::size_t> same_trees_;
    std::mutex telling_;
    std::size_t done_ = 0;
    Clock::time_point shown_ = Clock::now();
    std::size_t hits_ = 0;  // what measured queries answer is used, or they would not be asked
};

[[noreturn]] void refuse(std::string_view option, std::string_view value, const std::string& give) {
    throw std::invalid_argument(std::string(option) + " cannot be " + in_quotes(value) + ": give " + give);
}

std::vector<std::string_view> split(std::string_view text, char separator) {
    std::vector<std::string_view> out;
    for (;;) {
        const std::size_t end = std::min(text.find(separator), text.size());
        out.push_back(trimmed(text.substr(0, end)));
        if (end == text.size()) return out;
        text.remove_prefix(end + 1);
    }
}

/// "all", or a list of names.
template <class Find>
auto parse_names(std::string_view option, std::string_view text, std::span<const std::string_view> names, Find find) {
    std::vector<typename decltype(find(text))::value_type> out;
    for (const std::string_view name : text == "all" ? std::vector(names.begin(), names.end()) : split(text, ',')) {
        const auto value = find(name);
        if (!value) refuse(option, name, "all, or some of " + listed(names));
        if (std::ranges::find(out, *value) == out.end()) out.push_back(*value);
    }
    return out;
}

SweepValues parse_values(std::string_view option, std::string_view text, const std::string& give) {
    SweepValues out;
    out.is_range = text.find(':') != std::string_view::npos;
    for (const std::string_view part : split(text, out.is_range ? ':' : ',')) {
        const std::optional<double> value = parse_double(part);
        if (!value) refuse(option, text, give);
        if (std::ranges::find(out.values, *value) == out.values.end() || out.is_range) out.values.push_back(*value);
    }
    if (out.is_range && out.values.size() != 2) refuse(option, text, give);
    return out;
}

void check_values(const SweepValues& values, std::string_view option, double least, double most, bool whole) {
    for (const double value : values.values) {
        if (!(value >= least && value <= most) || (whole && value != std::round(value)))
            refuse(option, in_full(value),
                   (whole ? "whole numbers from " : "numbers from ") + in_full(least) + " to " + in_full(most));
    }
    if (values.is_range && values.values[0] > values.values[1])
        refuse(option, in_full(values.values[0]) + ':' + in_full(values.values[1]), "the smaller end of a range first");
}

constexpr const char* kLeafValues = "numbers such as 5,10,20, or a range such as 1:200";
constexpr const char* kScaleValues = "numbers in m/s such as 0.5,1,2, or a range such as 0.1:30";

}  // namespace

std::string_view name(SweepCost cost) { return kCostNames[static_cast<std::size_t>(cost)]; }

std::optional<SweepCost> sweep_cost_from_name(std::string_view name) {
    return enumerator_named<SweepCost>(kCostNames, name);
}

std::string_view unit_of(SweepCost cost) { return cost == SweepCost::price ? "ns, tests times price" : "ns, measured"; }

SweepOrder usual_sweep(const mobb::FitOptions& present) {
    return {.present = present,
            .trees = {mobb::kTreeKinds.begin(), mobb::kTreeKinds.end()},
            .leaf = {.values = {1, 200}, .is_range = true}};
}

void set_over(SweepOrder& order, std::string_view text) {
    const auto set = [](auto& values, std::string_view option, auto parsed) {
        if (values != decltype(parsed){}) {
            throw std::invalid_argument(std::string(option) + " is varied already; give all of its values at once");
        }
        values = std::move(parsed);
    };
    const std::size_t equals = std::min(text.find('='), text.size());
    const std::string_view option = trimmed(text.substr(0, equals));
    const std::string_view values = equals == text.size() ? "" : trimmed(text.substr(equals + 1));
    if (option == "tree") {
        set(order.trees, option, parse_names(option, values, mobb::tree_kind_names(), find_tree_kind));
    } else if (option == "axes") {
        set(order.axes, option, parse_names(option, values, mobb::axes_names(), mobb::axes_from_name));
    } else if (option == "leaf") {
        set(order.leaf, option, parse_values(option, values, kLeafValues));
    } else if (option == "time_scale") {
        set(order.time_scale, option, parse_values(option, values, kScaleValues));
    } else {
        throw std::invalid_argument(in_quotes(option) + " is no option to sweep over; write one of " +
                                    listed(kOptions) + ", such as leaf=1:200");
    }
    check(order);
}

void check(const SweepOrder& order) {
    mobb::check(order.present);
    check_values(order.leaf, "leaf", 1, kMostLeaf, true);
    check_values(order.time_scale, "time_scale", 1 / mobb::kMaxTimeScale, mobb::kMaxTimeScale, false);
}

SweepResult sweep_fits(std::span<const mobb::ClipPtr> clips, const QueryWorkload& workload, const SweepOrder& order,
                       const Progress& progress, const SweepPass& pass) {
    check(order);
    for (const ClipQuery& query : workload.queries) {
        mobb::checked(query.place_a, clips[static_cast<std::size_t>(query.clip_a)]->most_start());
        mobb::checked(query.place_b, clips[static_cast<std::size_t>(query.clip_b)]->most_start());
    }
    return FitSearch(clips, workload, order, progress, pass).run();
}

std::string sweep_words(const mobb::FitOptions& fit, const mobb::FitOptions& base) {
    const mobb::TreeInfo& kind = mobb::info(fit.tree);
    std::string out(kind.title);
    if (kind.splits()) out += ", leaf " + std::to_string(fit.leaf);
    if (kind.splits() && fit.levels != 0) out += ", levels " + std::to_string(fit.levels);
    if (kind.chooses_axes() && (fit.axes != base.axes || fit.axes != mobb::FitOptions{}.axes)) {
        out += ", axes ";
        out += mobb::name(fit.axes);
    }
    if (kind.uses_time_scale() && fit.time_scale != mobb::FitOptions{}.time_scale)
        out += ", time scale " + brief(fit.time_scale);
    return out;
}

}  // namespace mobbscope
