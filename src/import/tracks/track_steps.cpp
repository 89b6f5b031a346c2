#include <base/text.h>
#include <import/clip/sampling.h>
#include <import/tracks/track_steps.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace mobbscope {

double steps_between(const TrackPoint& a, const TrackPoint& b, double step) {
    return std::max(std::round((b.frame - a.frame) / step), 1.0);
}

namespace {

// Points of equal steps, each within kFrameTolerance of its place, are at most so much nearer or farther than others.
constexpr double kSpread = 4 * kFrameTolerance;
// Rounded ones are at most apart what they are rounded to; a little more, as doubles add to it.
constexpr double kRounded = 1.001;

// Steps of a track that are together so little from as many of the file's are those, of which it is so much.
constexpr double kSameStep = 1e-6;

/// So many points are so many frames after the one before.
struct StepCount {
    double step = 0;
    std::size_t count = 0;
};

/// All steps. Nearly always many in a row are equal.
class StepCounts {
  public:
    void add(std::span<const TrackPoint> points) {
        if (points.empty()) return;
        largest_ = std::max({largest_, std::abs(points.front().frame), std::abs(points.back().frame)});
        for (std::size_t i = 1; i < points.size(); ++i) {
            const double step = points[i].frame - points[i - 1].frame;
            if (counts_.empty() || counts_.back().step != step) {
                if (counts_.size() >= most_) put_together();
                counts_.push_back({step, 0});
            }
            ++counts_.back().count;
        }
    }
    std::optional<double> most_frequent(double rounding);

  private:
    /// Sorts, and makes one of equal steps: of a large file there are few different ones.
    void put_together() {
        std::ranges::sort(counts_, {}, &StepCount::step);
        std::size_t last = 0;
        for (std::size_t i = 1; i < counts_.size(); ++i) {
            if (counts_[i].step == counts_[last].step) {
                counts_[last].count += counts_[i].count;
            } else {
                counts_[++last] = counts_[i];
            }
        }
        counts_.resize(std::min(counts_.size(), last + 1));
        most_ = std::max(most_, 2 * counts_.size());
    }

    std::vector<StepCount> counts_;
    std::size_t most_ = 4096;  ///< counts that are not put together
    double largest_ = 0;       ///< of all times
};

/// With so many significant digits.
double rounded_to(double value, int digits) { return *parse_double(formatted("%.*g", digits, value)); }

/// Of what doubles as large as `largest` cannot tell from the step, the number of fewest digits, or of fewest a second.
double without_noise(double step, double largest) {
    constexpr int kMostDigits = 12;
    if (!std::isnormal(step) || !std::isnormal(1 / step)) return step;  // they have no digits to count
    const double noise = 4 * std::numeric_limits<double>::epsilon() * std::max(largest, step);
    for (int digits = 1; digits <= kMostDigits; ++digits) {
        for (const double candidate : {rounded_to(step, digits), 1 / rounded_to(1 / step, digits)}) {
            if (std::abs(candidate - step) <= noise) return candidate;
        }
    }
    return step;
}

/// Frame numbers are not rounded: there the most frequent one counts. `largest`: of all times.
double common_step(std::span<const StepCount> counts, double largest) {
    double most_frequent = 0;
    std::size_t most = 0;
    std::size_t in_row = 0;
    long double sum = 0;
    std::size_t all = 0;
    bool whole = true;
    for (std::size_t i = 0; i < counts.size(); ++i) {
        const auto& [step, count] = counts[i];
        in_row = i > 0 && counts[i - 1].step == step ? in_row + count : count;
        if (in_row > most) {
            most = in_row;
            most_frequent = step;
        }
        sum += static_cast<long double>(step) * static_cast<long double>(count);
        all += count;
        whole = whole && step == std::floor(step);
    }
    return whole ? most_frequent : without_noise(static_cast<double>(sum / static_cast<long double>(all)), largest);
}

/// How many steps a track lasts whose points are whole steps apart, to time_tolerance; none if they are not. The step
/// that is held against the points is what the track's span makes of so many, so `step` need not be exact.
std::optional<double> steps_in(std::span<const TrackPoint> points, double step, double rounding) {
    double steps = 0;
    for (std::size_t i = 1; i < points.size(); ++i) steps += steps_between(points[i - 1], points[i], step);
    if (!(steps <= kMaxFrame)) return std::nullopt;
    const double first = points.front().frame;
    const double exact = (points.back().frame - first) / steps;
    const double tolerance = time_tolerance(exact, rounding);
    double at = 0;
    for (std::size_t i = 1; i < points.size(); ++i) {
        at += steps_between(points[i - 1], points[i], step);
        if (std::abs(points[i].frame - (first + at * exact)) > tolerance) return std::nullopt;
    }
    return steps;
}

}  // namespace

std::optional<double> StepCounts::most_frequent(double rounding) {
    put_together();
    const std::vector<StepCount>& counts = counts_;
    std::span<const StepCount> best;
    std::size_t most = 0;
    std::size_t within = 0;  // counts [begin, end)
    std::size_t end = 0;
    for (std::size_t begin = 0; begin < counts.size(); ++begin) {
        const double shortest = counts[begin].step;
        const double spread = std::max(kSpread * shortest, kRounded * time_tolerance(shortest, rounding));
        for (; end < counts.size() && counts[end].step <= shortest + spread; ++end) within += counts[end].count;
        if (within > most) {
            most = within;
            best = std::span(counts).subspan(begin, end - begin);
        }
        within -= counts[begin].count;
    }
    if (best.empty()) return std::nullopt;
    return common_step(best, largest_);
}

std::optional<double> most_frequent_step(std::span<const Track> tracks, double rounding) {
    StepCounts counts;
    for (const Track& track : tracks) counts.add(track.points);
    return counts.most_frequent(rounding);
}

std::optional<double> most_frequent_step(std::span<const TrackPoint> points, double rounding) {
    StepCounts counts;
    counts.add(points);
    return counts.most_frequent(rounding);
}

TrackGrid grid_of_all(std::span<const TrackPoint> points, double usual, double rounding) {
    if (points.size() == 1) return {0, usual};
    const auto rows = static_cast<double>(points.size() - 1);
    const double step = (points.back().frame - points.front().frame) / rows;
    return {rows, step, steps_in(points, step, rounding) == rows};
}

TrackGrid grid_of(std::span<const TrackPoint> points, double usual, double rounding) {
    if (points.size() == 1) return {0, usual};
    const double span = points.back().frame - points.front().frame;
    const auto rows = static_cast<double>(points.size() - 1);
    const auto grid = [&](double steps) {
        // Tracks of one file share its step, whatever their times were rounded to.
        const double step = std::abs(span - steps * usual) <= kSameStep * usual ? usual : span / steps;
        return TrackGrid{steps, step, true, steps > rows};
    };
    if (steps_in(points, span / rows, rounding) == rows) return grid(rows);
    for (const double step : {usual, *most_frequent_step(points, rounding)}) {
        if (const auto steps = steps_in(points, step, rounding)) return grid(*steps);
    }
    return {.in_step = false};
}

}  // namespace mobbscope
