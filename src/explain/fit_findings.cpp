#include <base/text.h>
#include <explain/fit_findings.h>
#include <explain/query_workload.h>
#include <mobb/level_figures.h>
#include <mobb/predicate.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <memory>
#include <span>
#include <utility>

namespace mobbscope {

namespace {

constexpr std::size_t kPlacements = 2048;  // so that a fifth of the cost is many standard errors
constexpr double kWorthwhile = 0.2;        // of the cost: nearly every clip would be a little cheaper with another fit
constexpr double kAsGood = 0.01;           // of the cost: a difference that nobody would notice
constexpr double kGrown = 1.05;            // times the volume of a level above: less is no trend

constexpr double kSteepest = 64;  // times the time scale: upright at last, where only radii matter

constexpr double kCostlyPart = 0.2;         // of all box tests, in a node and below it
constexpr double kCostlyOfLevel = 1.0 / 3;  // ... and of those in its level and below it
constexpr double kCostlyTimes = 3;          // ... which is so many times its part of the samples

constexpr double kUsual = 0.95;           // the share of changes from sample to sample that is taken as usual
constexpr double kUnusual = 5;            // times what is usual: within that, motions have quick moments
constexpr double kMostAcceleration = 10;  // m/s^2: a person's own is less
constexpr double kWiderBy = 1.25;         // times the radii around: less is a limb
constexpr int kLongest = 3;               // samples: what lasts longer is a motion
constexpr int kAround = 7;                // samples on either side, whose median such samples do not move
constexpr double kSpoiled = 1.25;         // times the volume that a box would have without it
constexpr std::size_t kManySpoiled = 2;   // boxes: one alone costs little

using Kind = FitFinding::Kind;

constexpr std::array<std::string_view, 6> kKindNames{"loose_levels", "small_leaves", "large_leaves",
                                                     "costly_node",  "jump",         "radius_spike"};

std::string percent(double part) { return figure(100 * part, part < 0.1 ? 1 : 2) + " %"; }
std::string volume_words(double volume) { return figure(volume, 3) + " m\u00B2\u00B7s"; }

std::string seconds(double time) { return figure(time, 3) + " s"; }

/// Other fits, and other clips, asked the queries that the tree is asked.
class Trials {
  public:
    Trials(const mobb::Tree& tree, QueryWorkload workload, const Progress& progress)
        : tree_(tree),
          workload_(std::move(workload)),
          progress_(progress),
          // The tree is the caller's.
          now_(costs_of(std::shared_ptr<const mobb::Tree>(std::shared_ptr<void>(), &tree))) {}

    /// The part of the cost that the other one saves; 0 where it saves nothing, where that may be chance, and of
    /// blocks, whose tests have no price.
    double saved_by(std::shared_ptr<const mobb::Tree> other) const {
        std::vector<double> saved = costs_of(std::move(other));
        for (std::size_t i = 0; i < saved.size(); ++i) saved[i] = now_[i] - saved[i];
        const Spread spread = spread_of(saved);
        if (!(spread.mean > kSureErrors * spread.standard_error)) return 0;
        return spread.mean / spread_of(now_).mean;
    }
    double saved_by(const mobb::FitOptions& other) const {
        return saved_by(std::make_shared<const mobb::Tree>(tree_.shared_clip(), other));
    }

  private:
    std::vector<double> costs_of(std::shared_ptr<const mobb::Tree> tree) const {
        std::vector<double> out;
        for (const mobb::TestCounts& tests : count_tests(workload_, std::array{std::move(tree)}, 0, progress_))
            out.push_back(cost_of(tests));
        return out;
    }

    const mobb::Tree& tree_;
    QueryWorkload workload_;
    const Progress& progress_;
    std::vector<double> now_;
};

// --- levels

/// Whether the last level takes more room than one above it.
bool grows(const std::vector<mobb::LevelFigures>& levels) {
    return levels.back().volume > kGrown * std::ranges::min(levels, {}, &mobb::LevelFigures::volume).volume;
}

struct SteeperFit {
    mobb::FitOptions options;
    double volume;  ///< of its last level
};
/// The same fit at the time scale at which its boxes do not grow; none: they always do.
std::optional<SteeperFit> steeper_fit(const mobb::Tree& tree) {
    mobb::FitOptions steeper = tree.options();
    while (steeper.time_scale < kSteepest * tree.time_scale() && steeper.time_scale < mobb::kMaxTimeScale) {
        steeper.time_scale = std::min(2 * steeper.time_scale, mobb::kMaxTimeScale);
        const std::vector<mobb::LevelFigures> levels = mobb::level_figures(mobb::Tree(tree.shared_clip(), steeper));
        if (!grows(levels)) return SteeperFit{steeper, levels.back().volume};
    }
    return std::nullopt;
}

std::optional<FitFinding> loose_levels(const mobb::Tree& tree, const Trials& trials) {
    const std::vector<mobb::LevelFigures> levels = mobb::level_figures(tree);
    if (!grows(levels) || !mobb::info(tree.options().tree).uses_time_scale()) return std::nullopt;
    const auto tightest = std::ranges::min_element(levels, {}, &mobb::LevelFigures::volume);
    FitFinding out{.kind = Kind::loose_levels, .text = {}, .level = levels.back().level};
    out.text = "Boxes grow below level " + std::to_string(tightest->level) + ", from " + figure(tightest->volume, 3) +
               " to " + volume_words(levels.back().volume) + ":";
    const mobb::FitOptions& now = tree.options();
    if (const auto steeper = steeper_fit(tree)) {
        out.text += " at " + figure(now.time_scale, 3) + " m/s they lean too far, at " +
                    figure(steeper->options.time_scale, 3) + " m/s they end at " + figure(steeper->volume, 3) + ';';
        out.cost = trials.saved_by(steeper->options);
        if (out.cost > 0) out.mend = steeper->options;
    }
    std::optional<mobb::FitOptions> other;
    for (const mobb::TreeKind kind : {mobb::TreeKind::moving, mobb::TreeKind::mobb}) {
        mobb::FitOptions tried = now;
        tried.tree = kind;
        const double saved = trials.saved_by(tried);
        if (saved < out.cost + kWorthwhile) continue;
        out.cost = saved;
        other = tried;
    }
    if (other) {
        out.mend = other;
        out.text +=
            " as " + std::string(mobb::info(other->tree).label) + ", a query costs " + percent(out.cost) + " less;";
    }
    if (!out.mend) return std::nullopt;
    out.text.back() = '.';
    return out;
}

// --- leaves

int largest_leaf(const mobb::Tree& tree) {
    int out = 0;
    for (int i = 0; i < static_cast<int>(tree.nodes().size()); ++i) {
        if (tree.is_leaf(i)) out = std::max(out, tree.node(i).count);
    }
    return out;
}

std::optional<FitFinding> leaves(const mobb::Tree& tree, const Trials& trials) {
    const int samples = tree.clip().count();
    const int now = largest_leaf(tree);
    mobb::FitOptions best = tree.options();
    double saved = 0;
    // Towards where it costs less, as long as it does.
    const auto go = [&](auto next, auto goes_on) {
        for (int leaf = next(now); goes_on(leaf); leaf = next(leaf)) {
            mobb::FitOptions tried = tree.options();
            tried.leaf = leaf;
            tried.levels = 0;
            const double by = trials.saved_by(tried);
            if (by <= saved + kAsGood) return;
            saved = by;
            best = tried;
        }
    };
    go([](int leaf) { return 2 * leaf; }, [&](int leaf) { return leaf < 2 * samples; });
    if (saved == 0) go([](int leaf) { return leaf / 2; }, [](int leaf) { return leaf > 0; });
    if (saved < kWorthwhile) return std::nullopt;
    FitFinding out{.kind = best.leaf > now ? Kind::small_leaves : Kind::large_leaves, .text = {}, .cost = saved};
    out.text = "Leaves of " + counted(now, "sample", "samples") + " are too " +
               (out.kind == Kind::small_leaves ? "small" : "large") + ": with up to " + std::to_string(best.leaf) +
               ", a query costs " + percent(saved) + " less.";
    out.level = tree.depth() - 1;
    out.mend = best;
    return out;
}

// --- nodes

std::optional<FitFinding> costly_node(const mobb::Tree& tree, std::span<const double> shares) {
    std::vector<double> below(shares.begin(), shares.end());  // with all nodes below it
    std::vector<double> in_level(static_cast<std::size_t>(tree.depth()));
    const auto count = static_cast<int>(below.size());
    for (int i = count - 1; i > 0; --i)
        below[static_cast<std::size_t>(tree.parent(i))] += below[static_cast<std::size_t>(i)];
    for (int i = 0; i < count; ++i)
        in_level[static_cast<std::size_t>(tree.level(i))] += below[static_cast<std::size_t>(i)];
    int found = -1;
    for (int i = 0; i < count; ++i) {
        const double part = below[static_cast<std::size_t>(i)];
        const double of_level = part / in_level[static_cast<std::size_t>(tree.level(i))];
        const double of_samples = static_cast<double>(tree.node(i).count) / tree.clip().count();
        if (part >= kCostlyPart && of_level >= kCostlyOfLevel && of_level >= kCostlyTimes * of_samples) found = i;
    }
    if (found < 0) return std::nullopt;
    FitFinding out{.kind = Kind::costly_node, .text = {}, .node = found};
    const mobb::Node& node = tree.node(found);
    out.cost = below[static_cast<std::size_t>(found)];
    out.text = "Node " + std::to_string(tree.level(found)) + '.' + std::to_string(tree.place_in_level(found)) + " (" +
               figure(tree.t0(node), 3) + " to " + seconds(tree.t1(node)) + ") and those below it take " +
               percent(out.cost) + " of all box tests in " +
               percent(static_cast<double>(node.count) / tree.clip().count()) + " of the time.";
    return out;
}

// --- samples

/// A sample that does not go with those around it, and how many there are of its kind.
struct OddSample {
    int sample;
    double size, usual;  ///< of what is odd about it, in metres
    int of = 1;
    std::vector<mobb::Disk> without;  ///< the samples of the clip as they would go together
};

/// The number that such a share of them is not above.
double least_above(std::vector<double> numbers, double share) {
    const auto at = numbers.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(numbers.size() - 1));
    std::ranges::nth_element(numbers, at);
    return *at;
}

/// Calls `use` with the first and the last of each few neighbours that are odd.
template <class IsOdd, class Use>
void for_each_few(int count, const IsOdd& is_odd, const Use& use) {
    for (int first = 0; first < count; ++first) {
        int end = first;
        while (end < count && is_odd(end)) ++end;
        if (end > first && end - first <= kLongest) use(first, end - 1);
        first = end;
    }
}

/// The longest step of those that are much longer than steps are in this clip, and longer than anybody could make them.
std::optional<OddSample> jump_of(const mobb::Clip& clip) {
    const std::span<const mobb::Disk> samples = clip.samples();
    std::vector<double> steps;
    for (std::size_t i = 1; i < samples.size(); ++i) {
        steps.push_back(std::sqrt(mobb::squared_distance(samples[i - 1], samples[i])));
    }
    if (steps.empty()) return std::nullopt;
    const auto step = [&](int i) { return steps[static_cast<std::size_t>(i)]; };
    const double usual = least_above(steps, kUsual);
    const double least = kUnusual * usual + kMostAcceleration * clip.dt() * clip.dt();
    OddSample out{-1, 0, usual, 0, {samples.begin(), samples.end()}};
    const int count = static_cast<int>(steps.size());
    std::vector<bool> is_left_out(steps.size());
    for_each_few(
        count, [&](int i) { return step(i) > least; },
        [&](int first, int last) {
            ++out.of;
            for (int i = first; i <= last; ++i) is_left_out[static_cast<std::size_t>(i)] = true;
            // A sample that lies apart has a step to it and one back.
            if (step(first) <= out.size) return;
            out.size = step(first);
            out.sample = first + 1;
        });
    if (out.sample < 0) return std::nullopt;
    // The other steps lead on from where the last one has led.
    for (std::size_t i = 1; i < samples.size(); ++i) {
        const bool stays = is_left_out[i - 1];
        out.without[i].x = out.without[i - 1].x + (stays ? 0 : samples[i].x - samples[i - 1].x);
        out.without[i].y = out.without[i - 1].y + (stays ? 0 : samples[i].y - samples[i - 1].y);
        // One that jumps back time and again may lead anywhere without that.
        if (std::max(std::abs(out.without[i].x), std::abs(out.without[i].y)) > mobb::kMaxLength) return std::nullopt;
    }
    return out;
}

/// The radius that is largest over those around it, of those that are for a few samples only.
std::optional<OddSample> radius_spike_of(const mobb::Clip& clip) {
    const std::span<const mobb::Disk> samples = clip.samples();
    const int count = clip.count();
    if (count < 3) return std::nullopt;
    std::vector<double> changes, around;
    for (std::size_t i = 1; i < samples.size(); ++i) changes.push_back(std::abs(samples[i].r - samples[i - 1].r));
    for (int i = 0; i < count; ++i) {
        std::vector<double> radii;
        for (int k = std::max(i - kAround, 0); k <= std::min(i + kAround, count - 1); ++k)
            radii.push_back(samples[static_cast<std::size_t>(k)].r);
        around.push_back(least_above(std::move(radii), 0.5));
    }
    const auto over = [&](int i) {
        return samples[static_cast<std::size_t>(i)].r - around[static_cast<std::size_t>(i)];
    };
    const double least = kUnusual * least_above(changes, kUsual);
    const auto is_odd = [&](int i) {
        return over(i) > least && over(i) > (kWiderBy - 1) * around[static_cast<std::size_t>(i)];
    };
    OddSample out{-1, 0, 0, 0, {samples.begin(), samples.end()}};
    for_each_few(count, is_odd, [&](int first, int last) {
        ++out.of;
        for (int i = first; i <= last; ++i) {
            const auto at = static_cast<std::size_t>(i);
            out.without[at].r = around[at];
            if (out.sample >= 0 && over(i) <= out.size - out.usual) continue;
            out.sample = i;
            out.size = samples[at].r;
            out.usual = around[at];
        }
    });
    if (out.sample < 0) return std::nullopt;
    return out;
}

/// What the boxes around an odd sample lose by it, if some do.
std::optional<FitFinding> spoiling(const mobb::Tree& tree, const Trials& trials, const OddSample& odd,
                                   FitFinding found) {
    const mobb::Clip& clip = tree.clip();
    // The nodes are the same, as they follow from the number of samples.
    const auto without = std::make_shared<const mobb::Tree>(
        std::make_shared<const mobb::Clip>(clip.dt(), odd.without, clip.motion()), tree.options());
    std::size_t around = 0, spoiled = 0;
    double now = 0, then = 0;
    for (int i = 0; i < static_cast<int>(tree.nodes().size()); ++i) {
        if (tree.node(i).first > odd.sample || tree.node(i).end() <= odd.sample) continue;
        ++around;
        const double with = mobb::volume(tree.box(i), tree.time_scale());
        const double spared = mobb::volume(without->box(i), tree.time_scale());
        if (with <= kSpoiled * spared) continue;
        ++spoiled;
        now += with;
        then += spared;
    }
    if (spoiled == 0 || spoiled < std::min(kManySpoiled, around)) return std::nullopt;
    if (odd.of > 1) found.text += ", the worst of " + std::to_string(odd.of);
    found.text += ": without " + std::string(odd.of > 1 ? "them " : "it ") + counted(spoiled, "box", "boxes") +
                  " around it would take " + figure(then, 3) + " rather than " + volume_words(now) + '.';
    found.sample = odd.sample;
    found.cost = trials.saved_by(without);
    return found;
}

/// "Sample 412 at 13.7 s"
std::string sample_words(const mobb::Clip& clip, int sample) {
    return "Sample " + std::to_string(sample) + " at " + seconds(clip.time(sample));
}

std::optional<FitFinding> jump(const mobb::Tree& tree, const Trials& trials) {
    const auto odd = jump_of(tree.clip());
    if (!odd) return std::nullopt;
    const double dt = tree.clip().dt();
    return spoiling(tree, trials, *odd,
                    {.kind = Kind::jump,
                     .text = sample_words(tree.clip(), odd->sample) + " jumps " + figure(odd->size, 3) + " m (" +
                             figure(odd->size / dt, 3) + " m/s, usual is up to " + figure(odd->usual / dt, 2) + ")"});
}

std::optional<FitFinding> radius_spike(const mobb::Tree& tree, const Trials& trials) {
    const auto odd = radius_spike_of(tree.clip());
    if (!odd) return std::nullopt;
    return spoiling(tree, trials, *odd,
                    {.kind = Kind::radius_spike,
                     .text = sample_words(tree.clip(), odd->sample) + " has a radius of " + figure(odd->size, 3) +
                             " m where " + figure(odd->usual, 3) + " is usual"});
}

}  // namespace

std::string mend_words(const mobb::FitOptions& mend, const mobb::FitOptions& now) {
    std::string out;
    const auto say = [&out](const std::string& what) { out += (out.empty() ? "" : ", ") + what; };
    if (mend.tree != now.tree) say(std::string(mobb::info(mend.tree).label));
    if (mend.time_scale != now.time_scale) say(figure(mend.time_scale, 3) + " m/s");
    if (mend.leaf != now.leaf) say("leaf " + std::to_string(mend.leaf));
    if (mend.levels != now.levels) say(mend.levels == 0 ? "all levels" : "levels " + std::to_string(mend.levels));
    return out;
}

std::string_view name(FitFinding::Kind kind) { return kKindNames[static_cast<std::size_t>(kind)]; }

std::vector<FitFinding> fit_findings(const mobb::Tree& tree, std::span<const double> shares, const Progress& progress) {
    std::vector<FitFinding> out;
    const auto add = [&](std::optional<FitFinding> found) {
        if (found) out.push_back(std::move(*found));
    };
    QueryWorkload workload = standard_workload(std::array{tree.shared_clip()}, kPlacements, 0);
    // Around clips at the end of the world nothing can be placed.
    const auto can_be = [&](const mobb::Placement& b) { return mobb::is_valid(b, tree.clip().most_start()); };
    if (!std::ranges::all_of(workload.queries, can_be, &ClipQuery::place_b)) return {};
    const Trials trials(tree, std::move(workload), progress);
    if (mobb::info(tree.options().tree).splits()) {
        add(loose_levels(tree, trials));
        add(leaves(tree, trials));
    }
    add(jump(tree, trials));
    add(radius_spike(tree, trials));
    if (!shares.empty()) add(costly_node(tree, shares));
    std::ranges::stable_sort(out, std::ranges::greater(), &FitFinding::cost);
    return out;
}

}  // namespace mobbscope
