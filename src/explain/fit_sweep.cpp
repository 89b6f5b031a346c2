#include <base/numbers_in_text.h>
#include <base/text.h>
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

constexpr std::size_t kFirstValues = 12;  // of a range
constexpr std::size_t kMostRows = 5000;
constexpr double kMostLeaf = 1e6;
constexpr double kSame = 0.01;        // estimates nearer than this share are as good as equal
constexpr double kContender = 0.05;   // kinds within this share of the best estimate are searched as closely
constexpr double kNextScale = 1.02;   // time scales nearer than this factor are neighbours
constexpr std::size_t kFewFits = 12;  // are all measured
constexpr double kNearlyBest = 0.25;  // by an estimate: prices err by half of this
constexpr int kNextLeaf = 2;          // a factor: leaves nearer than this make almost the same trees
constexpr int kMostMeasurements = 8;  // where the fastest has neighbours all the time
constexpr std::size_t kNamed = 3;     // fits that a sentence lists

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

FitTrees fit_all(std::span<const mobb::ClipPtr> clips, const mobb::FitOptions& fit) {
    FitTrees out;
    out.reserve(clips.size());
    for (const mobb::ClipPtr& clip : clips) out.push_back(std::make_shared<const mobb::Tree>(clip, fit));
    return out;
}

/// What is known of a fit.
struct Tried {
    mobb::FitOptions fit;
    bool is_counted = false;              ///< or it has no price, and its size is known
    MeanTests tests{};                    ///< sums
    std::vector<double> costs{};          ///< of each query, ns; none of blocks
    std::vector<MeanTests> clip_tests{};  ///< sums over the queries in which a clip takes part; of one clip none
    double estimate = std::numeric_limits<double>::infinity();  ///< mean of the costs
    std::size_t nodes = 0, bytes = 0;
    std::array<std::optional<FitTime>, kProtocols.size()> times{};

    const std::optional<FitTime>& time(Protocol protocol) const { return times[static_cast<std::size_t>(protocol)]; }
};

/// Fits that differ by what is searched as a range alone.
struct Family {
    mobb::FitOptions fit;  ///< but for the leaf and the time scale
    bool leaf_range = false, scale_range = false;
    std::map<std::pair<double, int>, std::size_t> points{};  ///< by time scale and leaf: what was tried
    std::set<double> leaves{}, scales{};                     ///< that any point has
};

/// "141 ns +-1.4"
std::string time_words(const FitTime& time) {
    return figure(time.ns, 3) + " ns" + (std::isnan(time.error) ? "" : " +-" + figure(time.error, 2));
}

class FitSearch {
  public:
    FitSearch(std::span<const mobb::ClipPtr> clips, const QueryWorkload& workload, const SweepOrder& order,
              const Progress& progress, const SweepPass& pass, const FitTimer& timer)
        : clips_(clips),
          order_(order),
          progress_(progress),
          pass_(pass),
          timer_(timer),
          sizes_(node_sizes(clips)),
          longest_(std::ranges::max(clips, {}, &mobb::Clip::count)->count()) {
        const std::size_t most = std::max<std::size_t>(order.most_queries, 1);
        queries_ = std::span(workload.queries).first(std::min(workload.queries.size(), most));
        placements_ = workload.kind == QueryWorkload::Kind::placements;
    }

    SweepResult run() {
        plan();
        count_new();
        add_time_scales();
        do count_new();
        while (refine());
        if (timer_) measure();
        return result(true);
    }

  private:
    const Tried& at(std::size_t point) const { return *tried_[point]; }

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

    static mobb::FitOptions with(mobb::FitOptions fit, const std::pair<double, int>& place) {
        fit.time_scale = place.first;
        fit.leaf = place.second;
        return fit;
    }

    void add(Family& family, const mobb::FitOptions& fit) {
        const std::pair<double, int> place{fit.time_scale, fit.leaf};
        if (family.points.contains(place)) return;
        if (is_full()) throw std::invalid_argument(too_many());
        // A tree of one node has one level, whatever its leaf may have.
        const bool is_single = fit.levels == 1 || fit.leaf >= longest_;
        const int size = is_single ? longest_ : *std::prev(std::ranges::upper_bound(sizes_, std::max(fit.leaf, 1)));
        const auto [known, is_new] = same_trees_.try_emplace(
            {fit.tree, fit.axes, fit.time_scale, size, is_single ? 1 : fit.levels}, tried_.size());
        if (is_new) tried_.push_back(std::make_shared<const Tried>(Tried{.fit = fit}));
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
        using Key = std::tuple<mobb::TreeKind, int, mobb::Axes, double, double>;
        std::map<Key, Family> families;
        const auto family_of = [&](const mobb::FitOptions& fit) -> Family& {
            return families.try_emplace({fit.tree, fit.levels, fit.axes, fit.leaf, fit.time_scale}, Family{.fit = fit})
                .first->second;
        };
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
                mobb::FitOptions fit = order_.present;
                fit.tree = tree;
                fit.axes = axes;
                if (mobb::info(tree).splits()) {
                    mobb::FitOptions single = that_matter(fit);
                    single.levels = 1;
                    add(family_of(single), single);
                }
                for (const double leaf : listed_or_one(order_.leaf, order_.present.leaf)) {
                    for (const double scale : listed_or_one(order_.time_scale, order_.present.time_scale)) {
                        fit = that_matter(with(fit, {scale, static_cast<int>(leaf)}));
                        Family& family = family_of(fit);
                        family.leaf_range = order_.leaf.is_range && mobb::info(tree).splits();
                        family.scale_range = order_.time_scale.is_range && mobb::info(tree).uses_time_scale();
                        if (!family.leaf_range) {
                            add(family, fit);
                            continue;
                        }
                        for (const double each : values_of(order_.leaf, true)) {
                            fit.leaf = least_alike(static_cast<int>(each));
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

    /// The least leaf of the range that makes the same trees: so there is one name for one fit.
    int least_alike(int leaf) const {
        return std::max(*std::prev(std::ranges::upper_bound(sizes_, leaf)), static_cast<int>(order_.leaf.values[0]));
    }

    static std::set<double> values_of(const SweepValues& range, bool whole) {
        const std::vector<double> values = spread_over(range.values[0], range.values[1], whole);
        return {values.begin(), values.end()};
    }

    /// The present fit joins the family whose list or range has it. Otherwise it stands alone, so that no search leaves
    /// its range.
    void add_present() {
        const mobb::FitOptions& present = order_.present;
        const std::pair<double, int> place{present.time_scale, present.leaf};
        const auto is_in = [](const SweepValues& range, double value) {
            return range.values[0] <= value && value <= range.values[1];
        };
        const auto takes = [&](const Family& family) {
            const auto& first = family.points.begin()->first;
            return with(family.fit, place) == present &&
                   (family.leaf_range ? is_in(order_.leaf, present.leaf) : first.second == present.leaf) &&
                   (family.scale_range ? is_in(order_.time_scale, present.time_scale)
                                       : first.first == present.time_scale);
        };
        auto family = std::ranges::find_if(families_, takes);
        if (family == families_.end()) family = families_.insert(families_.end(), Family{.fit = present});
        add(*family, present);
        present_ = family->points.at(place);
    }

    /// Of two ranges the second is tried at the best of the first.
    void add_time_scales() {
        for (std::size_t i = 0; i < families_.size(); ++i) {
            if (!families_[i].scale_range) continue;
            const int leaf = best_of(i).at.second;
            for (const double scale : values_of(order_.time_scale, false))
                add(families_[i], with(families_[i].fit, {scale, leaf}));
        }
    }

    /// A pass over the fits that nothing is known of yet.
    void count_new() {
        std::vector<std::size_t> fresh;
        for (std::size_t i = 0; i < tried_.size(); ++i) {
            if (!at(i).is_counted) fresh.push_back(i);
        }
        // The present fit comes first: what is shown is compared with it.
        const auto present = std::ranges::find(fresh, present_);
        if (present != fresh.end()) std::rotate(fresh.begin(), present, present + 1);
        // Each on one processor: so no more trees are kept than there are processors.
        limit_worker_threads();
        tbb::parallel_for(std::size_t{0}, fresh.size(), [&](std::size_t i) { publish(fresh[i], counted(fresh[i])); });
        tell_rows();
    }

    Tried counted(std::size_t point) {
        Tried out = at(point);
        const FitTrees trees = fit_all(clips_, out.fit);
        out.is_counted = true;
        for (const auto& tree : trees) {
            out.nodes += tree->nodes().size();
            out.bytes += tree->bytes();
        }
        if (mobb::info(out.fit.tree).has_blocks()) return out;
        out.clip_tests.resize(clips_.size() > 1 ? clips_.size() : 0);
        out.costs.reserve(queries_.size());
        constexpr std::size_t kTogether = 1024;
        double sum = 0;
        for (const ClipQuery& asked : queries_) {
            const MeanTests tests = as_numbers(count_tests(asked, trees));
            out.tests += tests;
            out.costs.push_back(cost_of(tests));
            sum += out.costs.back();
            if (!out.clip_tests.empty()) {
                out.clip_tests[static_cast<std::size_t>(asked.clip_a)] += tests;
                if (asked.clip_b != asked.clip_a) out.clip_tests[static_cast<std::size_t>(asked.clip_b)] += tests;
            }
            if (out.costs.size() % kTogether == 0) tell(0);
        }
        out.estimate = sum / static_cast<double>(queries_.size());
        return out;
    }

    void publish(std::size_t point, Tried&& tried) {
        auto ready = std::make_shared<const Tried>(std::move(tried));
        const std::scoped_lock lock(telling_);
        tried_[point] = std::move(ready);
        tell_locked(1);
        if (at(present_).is_counted && Clock::now() - shown_ > kBetweenPasses) tell_rows();
    }

    void tell(std::size_t more) {
        const std::scoped_lock lock(telling_);
        tell_locked(more);
    }
    void tell_locked(std::size_t more) {
        done_ += more;
        if (progress_) progress_(done_, tried_.size());
    }

    void tell_rows() {
        if (pass_) pass_(std::make_shared<const SweepResult>(result(false)));
        shown_ = Clock::now();
    }

    /// A fit of a family.
    struct Place {
        std::size_t family = 0;
        std::pair<double, int> at{};  ///< time scale and leaf
        std::size_t tried = 0;
    };

    /// The one of the least estimate; of equal ones the first.
    Place best_of(std::size_t family) const {
        const auto& points = families_[family].points;
        const auto best = std::ranges::min_element(points, {}, [&](const auto& of) { return at(of.second).estimate; });
        return {family, best->first, best->second};
    }

    /// Adds fits around the best of each family that may have the best of all, or of the second best kind. Returns
    /// whether there were any to add.
    bool refine() {
        const std::vector<std::size_t> leaders = leading();
        const std::size_t before = rows_;
        for (std::size_t i = 0; i < families_.size(); ++i) {
            const Place place = best_of(i);
            const double cost = at(place.tried).estimate;
            const auto is_near = [&](std::size_t leader) {
                return cost >= at(leader).estimate && cost <= at(leader).estimate * (1 + kContender);
            };
            if (std::ranges::none_of(leaders, is_near)) continue;
            if (families_[i].leaf_range) refine_along(place, true);
            if (families_[i].scale_range) refine_along(place, false);
        }
        return rows_ > before;
    }

    /// The fit of the least estimate, and that of another kind, if there is one.
    std::vector<std::size_t> leading() const {
        std::vector<std::size_t> out;
        for (int rank = 0; rank < 2; ++rank) {
            std::optional<std::size_t> best;
            for (std::size_t i = 0; i < tried_.size(); ++i) {
                if (std::isinf(at(i).estimate)) continue;
                if (!out.empty() && at(i).fit.tree == at(out.front()).fit.tree) continue;
                if (!best || at(i).estimate < at(*best).estimate) best = i;
            }
            if (best) out.push_back(*best);
        }
        return out;
    }

    void refine_along(const Place& best, bool is_leaf) {
        Family& family = families_[best.family];
        const double here = is_leaf ? best.at.second : best.at.first;
        const double cost = at(best.tried).estimate;
        const auto place_of = [&](double value) {
            return is_leaf ? std::pair(best.at.first, static_cast<int>(value)) : std::pair(value, best.at.second);
        };
        const auto look_at = [&](double next) {
            const auto known = family.points.find(place_of(next));
            if (is_full()) return;
            if (known == family.points.end()) {
                add(family, with(family.fit, place_of(next)));
                return;
            }
            const double low = std::min(here, next), high = std::max(here, next);
            if (are_next(low, high, is_leaf) || at(known->second).estimate - cost <= kSame * cost) return;
            double between = middle(low, high, is_leaf);
            if (is_leaf && least_alike(static_cast<int>(between)) <= low) {
                const auto larger = std::ranges::upper_bound(sizes_, static_cast<int>(between));
                between = larger == sizes_.end() ? high : *larger;
            } else if (is_leaf) {
                between = least_alike(static_cast<int>(between));
            }
            if (between > low && between < high) add(family, with(family.fit, place_of(between)));
        };
        const std::set<double>& tried = is_leaf ? family.leaves : family.scales;
        const auto above = tried.upper_bound(here), found = tried.lower_bound(here);
        std::optional<double> next_above = above == tried.end() ? std::nullopt : std::optional(*above);
        if (!next_above && is_leaf) next_above = next_leaf(family, best.at.second, true);
        if (found != tried.begin()) look_at(*std::prev(found));
        if (next_above) look_at(*next_above);
    }

    /// Half or twice as many samples, as far as the range goes; none: it ends here.
    std::optional<int> next_leaf(const Family& family, int leaf, bool more) const {
        const int least = static_cast<int>(order_.leaf.values[0]);
        const int most = order_.leaf.is_open ? longest_ : static_cast<int>(order_.leaf.values[1]);
        if (!family.leaf_range) return std::nullopt;
        const int next =
            least_alike(more ? std::min({leaf > most / kNextLeaf ? most : kNextLeaf * leaf, most, longest_})
                             : std::max(std::min((leaf + kNextLeaf - 1) / kNextLeaf, most), least));
        return next != leaf && (next > leaf) == more ? std::optional(next) : std::nullopt;
    }

    /// The next fit with other trees that have smaller leaves, or larger ones; of a range one that may be new.
    std::optional<std::size_t> neighbour(const Place& of, bool more) {
        Family& family = families_[of.family];
        if (family.leaf_range) {
            const auto leaf = next_leaf(family, of.at.second, more);
            if (!leaf) return std::nullopt;
            const std::pair<double, int> place{of.at.first, *leaf};
            if (is_full() && !family.points.contains(place)) return std::nullopt;
            add(family, with(family.fit, place));
            const std::size_t next = family.points.at(place);
            return next == of.tried ? neighbour({of.family, place, next}, more) : next;
        }
        std::optional<std::size_t> out;
        int nearest = 0;
        for (const Family& other : families_) {
            for (const auto& [place, point] : other.points) {
                const int leaf = place.second;
                if (with(other.fit, {place.first, of.at.second}) != with(family.fit, of.at) || point == of.tried ||
                    leaf == of.at.second || (leaf > of.at.second) != more ||
                    (out && std::abs(leaf - of.at.second) >= std::abs(nearest - of.at.second)))
                    continue;
                out = point;
                nearest = leaf;
            }
        }
        return out;
    }

    /// The neighbours of a fit, wherever it is tried. That of one level is beside the largest leaves of its range.
    std::set<std::size_t> neighbours(std::size_t point) {
        std::vector<Place> places;
        for (std::size_t i = 0; i < families_.size(); ++i) {
            const Family& family = families_[i];
            for (const auto& [place, tried] : family.points) {
                if (tried == point) places.push_back({i, place, point});
            }
            mobb::FitOptions single = family.fit;
            single.levels = 1;
            single.leaf = at(point).fit.leaf;
            if (family.leaf_range && single == at(point).fit)
                places.push_back({i, {single.time_scale, longest_}, point});
        }
        std::set<std::size_t> out;
        for (const Place& place : places) {
            for (const bool more : {false, true}) {
                if (const auto next = neighbour(place, more)) out.insert(*next);
            }
        }
        return out;
    }

    Place place_of(std::size_t point) const {
        for (std::size_t i = 0; i < families_.size(); ++i) {
            for (const auto& [place, tried] : families_[i].points) {
                if (tried == point && with(families_[i].fit, place) == at(point).fit) return {i, place, point};
            }
        }
        return {};
    }

    // --- measured time

    std::set<std::size_t> worth_measuring() {
        std::set<std::size_t> out{present_};
        if (tried_.size() <= kFewFits) {
            for (std::size_t i = 0; i < tried_.size(); ++i) out.insert(i);
            return out;
        }
        std::vector<Place> bests;
        for (std::size_t i = 0; i < families_.size(); ++i) bests.push_back(best_of(i));
        std::ranges::stable_sort(bests, {}, [&](const Place& best) { return at(best.tried).estimate; });
        const double least = at(bests.front().tried).estimate;
        std::set<std::pair<mobb::TreeKind, mobb::Axes>> seen;
        std::set<mobb::TreeKind> kinds;
        bool has_single = false;
        for (const Place& best : bests) {
            const mobb::FitOptions& fit = families_[best.family].fit;
            if (fit.levels == 1 && !std::exchange(has_single, true)) out.insert(best.tried);
            const bool is_near = at(best.tried).estimate <= least * (1 + kNearlyBest);
            const bool of_kind = kinds.insert(fit.tree).second, of_axes = seen.insert({fit.tree, fit.axes}).second;
            if (!of_kind && !(of_axes && is_near)) continue;
            out.insert(best.tried);
            if (is_near) out.merge(neighbours(best.tried));
        }
        return out;
    }

    void measure() {
        std::set<std::size_t> points = worth_measuring();
        for (int i = 0; i < kMostMeasurements; ++i) {
            count_new();
            measure({points.begin(), points.end()});
            const std::size_t before = points.size();
            for (const Protocol protocol : kProtocols) points.merge(neighbours(by_time(protocol).front()));
            if (points.size() == before) return;
        }
        count_new();
    }

    void measure(const std::vector<std::size_t>& points) {
        std::vector<FitTrees> trees;
        for (const std::size_t point : points) {
            trees.push_back(fit_all(clips_, at(point).fit));
            tell(0);
        }
        const bool is_sample = placements_ || queries_.size() == order_.most_queries;
        for (const Protocol protocol : kProtocols) {
            const FitTimes times = time_fits(trees, queries_, is_sample, protocol, timer_, [this] { tell(0); });
            timed_queries_[static_cast<std::size_t>(protocol)] = times.queries;
            for (std::size_t i = 0; i < points.size(); ++i) {
                Tried tried = at(points[i]);
                tried.times[static_cast<std::size_t>(protocol)] = times.fits[i];
                tried_[points[i]] = std::make_shared<const Tried>(std::move(tried));
            }
        }
    }

    /// What was measured, the fastest first.
    std::vector<std::size_t> by_time(Protocol protocol) const {
        std::vector<std::size_t> out;
        for (std::size_t i = 0; i < tried_.size(); ++i) {
            if (at(i).time(protocol)) out.push_back(i);
        }
        std::ranges::stable_sort(out, {}, [&](std::size_t i) { return at(i).time(protocol)->ns; });
        return out;
    }

    // --- what came of it

    /// The rows that are known; the present one is among them.
    SweepResult result(bool is_last) {
        SweepResult out{.order = order_, .queries = queries_.size()};
        std::vector<std::pair<mobb::FitOptions, std::size_t>> rows;
        for (const Family& family : families_) {
            for (const auto& [place, point] : family.points) {
                if (at(point).is_counted) rows.emplace_back(with(family.fit, place), point);
            }
        }
        std::ranges::sort(rows, {}, [](const auto& row) {
            const mobb::FitOptions& fit = row.first;
            return std::tuple(fit.tree, fit.levels, fit.axes, fit.time_scale, fit.leaf);
        });
        std::map<std::size_t, std::size_t> row_of;  // of fits that make the same trees the present one, or the first
        for (std::size_t i = 0; i < rows.size(); ++i) {
            const auto& [fit, point] = rows[i];
            const Tried& of = at(point);
            if (fit == order_.present) out.present = i;
            if (fit == order_.present) row_of[point] = i;
            row_of.try_emplace(point, i);
            SweepRow row{.fit = fit, .times = of.times, .nodes = of.nodes, .bytes = of.bytes};
            if (!of.costs.empty()) {
                row.estimate = {.tests = mean_of(of.tests, queries_.size()), .cost = spread_of(of.costs)};
                if (is_last && clips_.size() > 1) row.estimate->clips = clips_of(of);
            }
            out.rows.push_back(std::move(row));
        }
        if (!is_last) return out;
        for (const Protocol protocol : kProtocols) {
            SweepAdvice& advice = out.advice[static_cast<std::size_t>(protocol)];
            advice.queries = timed_queries_[static_cast<std::size_t>(protocol)];
            if (!timer_) {
                advice.why = "nothing was measured";
                continue;
            }
            const std::vector<std::size_t> fits = by_time(protocol);
            const FitTime& best = *at(fits.front()).time(protocol);
            for (const std::size_t fit : fits) {
                if (fit == fits.front() || !best.beats(*at(fit).time(protocol)))
                    advice.undecided.push_back(row_of.at(fit));
            }
            if (advice.undecided.size() == 1) {
                advice.recommended = advice.undecided.front();
                advice.undecided.clear();
            }
            advice.why = why(out, protocol, fits, row_of);
        }
        return out;
    }

    std::vector<SweepClip> clips_of(const Tried& of) {
        if (takes_part_.empty()) {
            takes_part_.resize(clips_.size());
            for (std::size_t q = 0; q < queries_.size(); ++q) {
                takes_part_[static_cast<std::size_t>(queries_[q].clip_a)].push_back(q);
                if (queries_[q].clip_b != queries_[q].clip_a)
                    takes_part_[static_cast<std::size_t>(queries_[q].clip_b)].push_back(q);
            }
        }
        std::vector<SweepClip> out;
        for (std::size_t clip = 0; clip < clips_.size(); ++clip) {
            const std::vector<std::size_t>& queries = takes_part_[clip];
            SweepClip& by_clip = out.emplace_back(SweepClip{.queries = queries.size()});
            if (queries.empty()) continue;
            std::vector<double> costs;
            costs.reserve(queries.size());
            for (const std::size_t q : queries) costs.push_back(of.costs[q]);
            by_clip.tests = mean_of(of.clip_tests[clip], queries.size());
            by_clip.cost = spread_of(costs);
        }
        return out;
    }

    /// `fits`: what was measured, the fastest first.
    std::string why(const SweepResult& out, Protocol protocol, const std::vector<std::size_t>& fits,
                    const std::map<std::size_t, std::size_t>& row_of) {
        const SweepAdvice& advice = out.of(protocol);
        const auto words = [&](std::size_t row) { return sweep_words(out.rows[row].fit, order_.present); };
        const auto time = [&](std::size_t row) { return *out.rows[row].time(protocol); };
        const FitTime now = time(out.present);
        std::string text;
        if (advice.recommended) {
            const std::size_t best = *advice.recommended;
            text = words(best);
            if (best == out.present) {
                text += ", as now: " + time_words(now);
            } else {
                text += ": " + time_words(time(best)) + ", " + figure(100 * (1 - time(best).ns / now.ns), 2) +
                        " % less than " + words(out.present) + " (now)";
            }
        } else {
            const std::vector<std::size_t>& rows = advice.undecided;
            std::vector<std::string> named;
            for (std::size_t i = 0; i < rows.size() && i < kNamed; ++i)
                named.push_back(words(rows[i]) + (rows[i] == out.present ? " (now)" : ""));
            if (rows.size() > kNamed) named.back() = std::to_string(rows.size() - kNamed + 1) + " more";
            text = "undecided between " + named.front();
            for (std::size_t i = 1; i < named.size(); ++i) text += (i + 1 < named.size() ? "; " : " and ") + named[i];
            double most_error = 0;
            for (const std::size_t row : rows) most_error = std::max(most_error, time(row).error);
            text += ": " + figure(time(rows.front()).ns, 3) + " to " + figure(time(rows.back()).ns, 3) + " ns";
            text += std::isnan(time(rows.front()).error) ? ", one measurement" : ", +-" + figure(most_error, 2);
        }
        text += ", over " +
                std::string(placements_ ? grouped(advice.queries) + (advice.queries == 1 ? " placement" : " placements")
                                        : mobbscope::counted(advice.queries, "query", "queries"));
        if (const std::string end = end_of_range(place_of(fits.front())); !end.empty()) text += "; " + end;
        if (!advice.recommended) return text;
        const mobb::TreeKind best = at(fits.front()).fit.tree;
        const auto next = std::ranges::find_if(fits, [&](std::size_t fit) { return at(fit).fit.tree != best; });
        if (next == fits.end()) return fits.size() == 1 ? text + "; nothing else was tried" : text;
        const double times = at(*next).time(protocol)->ns / at(fits.front()).time(protocol)->ns;
        return text + "; the next kind is " + words(row_of.at(*next)) + ", which takes " +
               (times < 2 ? figure(100 * (times - 1), 2) + " % more" : figure(times, 2) + " times as much");
    }

    /// Says where the best could lie beyond what is tried; empty where it could not.
    std::string end_of_range(const Place& best) {
        const Family& family = families_[best.family];
        if (family.fit.levels == 1 || !mobb::info(family.fit.tree).splits()) return "";
        const int leaf = best.at.second;
        const std::vector<double>& leaves = order_.leaf.values;
        const auto is_end = [&](double end) {
            return leaf == (order_.leaf.is_range ? least_alike(static_cast<int>(end)) : static_cast<int>(end));
        };
        if (leaves.size() > 1 && ((is_end(std::ranges::min(leaves)) && leaf > 1) ||
                                  (is_end(std::ranges::max(leaves)) && leaf < longest_ && !order_.leaf.is_open)))
            return "leaf " + std::to_string(leaf) + " is an end of what was tried: try more";
        const std::vector<double>& scales = order_.time_scale.values;
        const bool scale_matters = scales.size() > 1 && mobb::info(family.fit.tree).uses_time_scale();
        if (scale_matters && (best.at.first == std::ranges::min(scales) || best.at.first == std::ranges::max(scales)))
            return "time scale " + brief(best.at.first) + " is an end of what was tried: try more";
        return "";
    }

    using Clock = std::chrono::steady_clock;
    static constexpr std::chrono::milliseconds kBetweenPasses{100};

    std::span<const mobb::ClipPtr> clips_;
    SweepOrder order_;
    const Progress& progress_;
    const SweepPass& pass_;
    const FitTimer& timer_;
    std::vector<int> sizes_;
    int longest_;  ///< samples of a clip
    std::span<const ClipQuery> queries_;
    bool placements_ = true;
    std::vector<Family> families_;
    std::size_t rows_ = 0;
    std::vector<std::shared_ptr<const Tried>> tried_;
    std::size_t present_ = 0;  ///< of what was tried
    std::map<std::tuple<mobb::TreeKind, mobb::Axes, double, int, int>, std::size_t> same_trees_;
    std::array<std::size_t, kProtocols.size()> timed_queries_{};
    std::vector<std::vector<std::size_t>> takes_part_;  ///< by clip: queries
    std::mutex telling_;
    std::size_t done_ = 0;
    Clock::time_point shown_ = Clock::now();
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

SweepOrder usual_sweep(const mobb::FitOptions& present) {
    return {.present = present,
            .trees = {mobb::kTreeKinds.begin(), mobb::kTreeKinds.end()},
            .leaf = {.values = {1, 200}, .is_range = true, .is_open = true}};
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

std::size_t SweepResult::fastest(Protocol protocol) const {
    const SweepAdvice& of_it = of(protocol);
    return of_it.recommended.value_or(of_it.undecided.empty() ? present : of_it.undecided.front());
}

SweepResult sweep_fits(std::span<const mobb::ClipPtr> clips, const QueryWorkload& workload, const SweepOrder& order,
                       const Progress& progress, const SweepPass& pass, const FitTimer& timer) {
    check(order);
    for (const ClipQuery& query : workload.queries) {
        mobb::checked(query.place_a, clips[static_cast<std::size_t>(query.clip_a)]->most_start());
        mobb::checked(query.place_b, clips[static_cast<std::size_t>(query.clip_b)]->most_start());
    }
    return FitSearch(clips, workload, order, progress, pass, timer).run();
}

std::string sweep_words(const mobb::FitOptions& fit, const mobb::FitOptions& base) {
    const mobb::TreeInfo& kind = mobb::info(fit.tree);
    std::string out(kind.title);
    if (kind.splits() && fit.levels == 1) out += ", 1 level";
    if (kind.splits() && fit.levels != 1) out += ", leaf " + std::to_string(fit.leaf);
    if (kind.splits() && fit.levels > 1) out += ", levels " + std::to_string(fit.levels);
    if (kind.chooses_axes() && (fit.axes != base.axes || fit.axes != mobb::FitOptions{}.axes)) {
        out += ", axes ";
        out += mobb::name(fit.axes);
    }
    if (kind.uses_time_scale() && fit.time_scale != mobb::FitOptions{}.time_scale)
        out += ", time scale " + brief(fit.time_scale);
    return out;
}

}  // namespace mobbscope
