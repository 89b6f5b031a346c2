#include <mobb/blocks.h>
#include <mobb/predicate.h>

#include <glm/geometric.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <utility>

namespace mobb {

namespace {

/// The middle of what is added.
class Middle {
  public:
    void add(double x, double y, double r) {
        low_x_ = std::min(low_x_, x - r);
        high_x_ = std::max(high_x_, x + r);
        low_y_ = std::min(low_y_, y - r);
        high_y_ = std::max(high_y_, y + r);
    }
    glm::dvec2 get() const { return {(low_x_ + high_x_) / 2, (low_y_ + high_y_) / 2}; }

  private:
    static constexpr double kFar = std::numeric_limits<double>::infinity();
    double low_x_ = kFar, high_x_ = -kFar, low_y_ = kFar, high_y_ = -kFar;
};

constexpr bool has_phases_for_all_shifts() {
    for (int apart = -Blocks::kRun; apart <= Blocks::kRun; ++apart) {
        const Blocks::PhasePair phases = Blocks::phases_apart(apart);
        if ((phases.a - phases.b - apart) % Blocks::kRun != 0) return false;
    }
    return true;
}
static_assert(has_phases_for_all_shifts());

const Clip& existing(const ClipPtr& clip) {
    if (!clip) throw std::invalid_argument("blocks need a clip");
    return *clip;
}

/// Samples [first, end) of a clip, as a bound sees them that moves by `per_sample` a sample.
class Run {
  public:
    Run(const Clip& clip, glm::dvec2 origin, int first, int end)
        : samples_(clip.samples().data()), origin_(origin), first_(first) {
        // Where samples run, the last disk of the run is the one that its last sample runs to, if any.
        last_ = clip.runs() ? std::min(end, clip.count() - 1) : end - 1;
        stays_ = !clip.runs();
    }

    /// From the first centre to the last.
    glm::dvec2 per_sample() const {
        if (last_ == first_) return glm::dvec2(0);
        const Disk& a = samples_[first_];
        const Disk& b = samples_[last_];
        return {(b.x - a.x) / (last_ - first_), (b.y - a.y) / (last_ - first_)};
    }

    /// visit(x, y, r) of each disk when it begins and, where it stays, when it ends, less what the bound has moved.
    template <class Visit>
    void for_each(glm::dvec2 per_sample, const Visit& visit) const {
        for (int i = first_; i <= last_; ++i) {
            const Disk& d = samples_[i];
            const double at = i - first_;
            const double x = (d.x - origin_.x) - at * per_sample.x;
            const double y = (d.y - origin_.y) - at * per_sample.y;
            visit(x, y, d.r);
            if (stays_ && per_sample != glm::dvec2(0)) visit(x - per_sample.x, y - per_sample.y, d.r);
        }
    }

  private:
    const Disk* samples_;
    glm::dvec2 origin_;
    int first_, last_;
    bool stays_;  ///< each disk does
};

/// Around a run, moving by `moving_by` metres a sample; `drift` is over `span` samples. Centre and drift are numbers of
/// type Number.
template <class Number>
MovingDisk around(const Run& run, glm::dvec2 moving_by, int span) {
    const auto rounded = [](glm::dvec2 v) {
        return glm::dvec2(static_cast<double>(static_cast<Number>(v.x)), static_cast<double>(static_cast<Number>(v.y)));
    };
    MovingDisk out;
    out.drift = rounded(moving_by * static_cast<double>(span));
    const glm::dvec2 per_sample = out.drift / static_cast<double>(span);
    Middle middle;
    run.for_each(per_sample, [&](double x, double y, double r) { middle.add(x, y, r); });
    out.from = rounded(middle.get());
    run.for_each(per_sample, [&](double x, double y, double r) {
        x -= out.from.x;
        y -= out.from.y;
        out.radius = std::max(out.radius, std::sqrt(x * x + y * y) + r);
    });
    return out;
}

/// Sets reach[j], -beyond <= j <= n + beyond, to the radius about sample j, or else about the nearest one, of what
/// holds the disks (x, y, inner) of those of the samples j - before to j + behind that there are, of n: 0 if there is
/// none.
void find_reaches(const Blocks::Rings& of, int n, int before, int behind, int beyond, float* reach) {
    const auto from = [&of](int center, int i) {
        const float dx = of.x[i] - of.x[center], dy = of.y[i] - of.y[center];
        return std::sqrt(dx * dx + dy * dy) + of.inner[i];
    };
    std::copy_n(of.inner, n, reach);
    // A distance serves both of its ends. As many at a time as stay in the first cache.
    constexpr int kAtATime = 256;
    float apart[kAtATime];
    for (int first = 0; first < n; first += kAtATime) {
        for (int ahead = 1; ahead <= std::max(before, behind); ++ahead) {
            const int count = std::min(kAtATime, n - ahead - first);
            const float* const x = of.x + first;
            const float* const y = of.y + first;
            const float* const r = of.inner + first;
            float* const here = reach + first;
            for (int j = 0; j < count; ++j) {
                const float dx = x[j + ahead] - x[j], dy = y[j + ahead] - y[j];
                apart[j] = std::sqrt(dx * dx + dy * dy);
            }
            for (int j = 0; j < count && ahead <= behind; ++j) here[j] = std::max(here[j], apart[j] + r[j + ahead]);
            for (int j = 0; j < count && ahead <= before; ++j)
                here[j + ahead] = std::max(here[j + ahead], apart[j] + r[j]);
        }
    }
    for (int j = -beyond; j <= n + beyond; ++j) {
        if (j == 0) j = n;
        const int center = j < 0 ? 0 : n - 1;
        reach[j] = 0;
        for (int i = std::max(0, j - before); i <= std::min(n - 1, j + behind); ++i)
            reach[j] = std::max(reach[j], from(center, i));
    }
}

}  // namespace

Blocks::Blocks(ClipPtr clip)
    : dt_(existing(clip).dt()),
      reach_(clip->reach()),
      per_dt_(1 / dt_),
      count_(clip->count()),
      most_start_(clip->most_start()),
      steps_(clip->steps()),
      linear_(clip->motion() == Motion::linear),
      disks_(clip->samples().data()),
      clip_(std::move(clip)) {
    constexpr std::int64_t kWhole = std::int64_t{1} << kLogParts;
    const double sure = 2 * kMinOverlap * per_dt_;  // of a sample; twice, as times are exact to half of it
    sure_parts_ = linear_ || sure > 1 ? kWhole + 1 : static_cast<std::int64_t>(sure * static_cast<double>(kWhole)) + 2;
    const int n = count_;
    const auto reach_from = [this](glm::dvec2 center) {
        double radius = 0;
        for (const Disk& d : clip_->samples()) {
            const double x = d.x - center.x, y = d.y - center.y;
            radius = std::max(radius, std::sqrt(x * x + y * y) + d.r);
        }
        return radius;
    };
    Middle middle;
    for (const Disk& d : clip_->samples()) middle.add(d.x, d.y, d.r);
    origin_ = middle.get();
    double moving_radius = radius_ = reach_from(origin_);
    if (is_short()) {
        const Run run(*clip_, {0, 0}, 0, n);
        const MovingDisk moving = around<double>(run, run.per_sample(), steps_);
        if (moving.radius < radius_) {
            origin_ = moving.from + moving.drift / 2.0;
            velocity_ = moving.drift * per_dt_ / static_cast<double>(steps_);
            root_speed_ = glm::length(velocity_);
            moving_radius = moving.radius;
            radius_ = reach_from(origin_);
        }
    }
    double extent = 0;  // |x| + |y| + r about the origin at most
    for (const Disk& d : clip_->samples())
        extent = std::max(extent, std::abs(d.x - origin_.x) + std::abs(d.y - origin_.y) + d.r);
    // No centre of a root moves farther than this from the origin, nor is it farther from another one's that it meets.
    const double lengths = 3 * radius_;
    constexpr double kTaxicab = 1.4143;  // what |x| + |y| of a length is at most
    // What rounding in single precision adds at most, as a share of the lengths involved, with a wide margin.
    constexpr double kLengthError = 0x1p-17;
    slack_ = rounded_up(kLengthError * (kTaxicab * lengths + extent));
    // Above what the predicate of swept disks leaves out: that takes them for nearer than they are, by up to a share of
    // all lengths involved (see RelativeFrame::cover_swept_disks).
    constexpr double kRootError = 0x1p-19;
    root_radius_ = moving_radius + kRootError * lengths;
    root_begin_ = origin_ - velocity_ * (clip_->duration() / 2);

    // All that is to be stored, so that it is allocated once.
    const auto values_in = [](int arrays, int count) {
        return static_cast<std::size_t>(arrays) * static_cast<std::size_t>(count);
    };
    std::size_t values = kSamples + values_in(kRings, n + 2) +
                         values_in(kRings * static_cast<int>(kPhases.size()), window_stride()) + kReadAhead;
    for (int level = 0;; ++level) {
        const int blocks = (n + span(level) - 1) / span(level);
        values += values_in(level == 0 ? kStill : kMoving, blocks);
        if (level > 0) values += values_in(3 * kFanOut, window_stride(level));
        if (blocks <= kMostAtTop) break;
    }
    values_.reserve(values);

    // What is read before or behind an array is another one.
    values_.assign(kRun, 0);
    add_samples();
    for (bool more = true; more; ++level_count_) {
        Level& level = levels_[static_cast<std::size_t>(level_count_)];
        level = add_level(level_count_);
        more = level.count > kMostAtTop;
    }
    add_windows();
    for (int level = 1; level < level_count_; ++level) add_windows(level);
    values_.resize(values_.size() + kReadAhead);
}

float* Blocks::add_arrays(int count, int arrays) {
    const std::size_t at = values_.size();
    values_.resize(at + static_cast<std::size_t>(arrays) * static_cast<std::size_t>(count));
    return values_.data() + at;
}

Blocks::Level Blocks::add_level(int number) {
    const int n = count_, size = span(number);
    const bool moves = number > 0;
    const int stride = (n + size - 1) / size, arrays = moves ? kMoving : kStill;
    float* const values = add_arrays(stride, arrays);
    Level level;
    level.at = static_cast<std::size_t>(values - values_.data());
    level.count = stride;
    level.arrays = arrays;
    for (int k = 0; k < level.count; ++k) {
        const int samples = std::min(n - k * size, size);
        const Run run(*clip_, origin_, k * size, k * size + samples);
        const MovingDisk disk = around<float>(run, moves ? run.per_sample() : glm::dvec2(0), size);
        float* const block = values + k;
        block[0] = static_cast<float>(disk.from.x);
        block[stride] = static_cast<float>(disk.from.y);
        block[2 * stride] = rounded_up(disk.radius);
        if (!moves) continue;
        block[3 * stride] = static_cast<float>(disk.drift.x);
        block[4 * stride] = static_cast<float>(disk.drift.y);
        block[5 * stride] = static_cast<float>(steps(k * size, size)) / static_cast<float>(size);
        speed_ = std::max(speed_, rounded_up(glm::length(disk.drift) / (size * dt_)));
    }
    return level;
}

void Blocks::add_samples() {
    const int n = count_, stride = n + 2;
    float* const x = add_arrays(stride, kRings) + 1;
    float* const y = x + stride;
    float* const inner = y + stride;
    float* const outer = inner + stride;
    first_sample_ = x;
    for (int i = 0; i < n; ++i) {
        const Disk& d = disks_[i];
        x[i] = static_cast<float>(d.x - origin_.x);
        y[i] = static_cast<float>(d.y - origin_.y);
        inner[i] = static_cast<float>(d.r);
    }
    for (int i = 0; linear_ && i + 1 < n; ++i) {
        const float dx = x[i + 1] - x[i], dy = y[i + 1] - y[i], way = std::sqrt(dx * dx + dy * dy);
        x[i] += dx / 2;
        y[i] += dy / 2;
        inner[i] = std::max(inner[i], inner[i + 1]) + way / 2;
        speed_ = std::max(speed_, rounded_up(way / dt_));
    }
    // Floats that are not negative compare as their bits do, several at a time.
    std::int32_t longest = 0;
    for (int i = 0; i + 1 < n; ++i) {
        const float dx = x[i + 1] - x[i], dy = y[i + 1] - y[i];
        const float step = std::sqrt(dx * dx + dy * dy) + std::abs(inner[i + 1] - inner[i]);
        longest = std::max(longest, std::bit_cast<std::int32_t>(step));
    }
    step_ = std::bit_cast<float>(longest);
    for (float* const values : {x, y}) {
        values[-1] = values[0];
        values[n] = values[n - 1];
    }
    inner[-1] = inner[n] = -kNever;
    find_reaches(samples(), n, 0, 1, 1, outer);
}

void Blocks::add_windows() {
    constexpr int kHalf = kRun / 2;
    const int n = count_;
    std::vector<float> reaches(static_cast<std::size_t>(n + 2 * kHalf + 1));
    float* const outer = reaches.data() + kHalf;
    find_reaches(samples(), n, kHalf, kHalf, kHalf, outer);
    const int stride = window_stride();
    float* values = add_arrays(stride, kRings * static_cast<int>(kPhases.size()));
    first_window_ = values;
    window_stride_ = stride;
    const Rings of = samples();
    for (const int phase : kPhases) {
        for (int place = 0; place < stride; ++place) {
            const int j = std::min(phase + place * kRun - kHalf, n + kHalf);
            const int nearest = std::clamp(j, 0, n - 1);
            values[place] = of.x[nearest];
            values[stride + place] = of.y[nearest];
            values[2 * stride + place] = nearest == j ? of.inner[j] : -kNever;
            values[3 * stride + place] = outer[j];
        }
        values += kRings * stride;
    }
}

int Blocks::window_stride(int level) const {
    const int farthest = count_ - 1 + span(level) / 2 + span(level - 1) / 2;
    return place_of_number(farthest >> log_span(level - 1)) + 1;
}

void Blocks::add_windows(int level) {
    const int n = count_, unit = span(level - 1), reach = (span(level) + unit) / 2;
    const int stride = window_stride(level);
    float* values = add_arrays(stride, 3 * kFanOut);
    Level& of = levels_[static_cast<std::size_t>(level)];
    of.windows = static_cast<std::size_t>(values - values_.data());
    of.window_stride = stride;
    const Rings each = samples();
    const Paths blocks = paths(0);
    for (int phase = 0; phase < kFanOut; ++phase, values += 3 * stride) {
        for (int place = 0; place < stride; ++place) {
            const std::int64_t middle = std::int64_t{place * kFanOut + phase - kFanOut / 2} * unit;
            const auto within = [n](std::int64_t i) { return static_cast<int>(std::clamp<std::int64_t>(i, 0, n - 1)); };
            const int center = within(middle);
            float radius = 0;
            for (int k = within(middle - reach) >> kLogSamples; k <= within(middle + reach) >> kLogSamples; ++k) {
                const float dx = blocks.x()[k] - each.x[center], dy = blocks.y()[k] - each.y[center];
                radius = std::max(radius, std::sqrt(dx * dx + dy * dy) + blocks.r()[k]);
            }
            values[place] = each.x[center];
            values[stride + place] = each.y[center];
            values[2 * stride + place] = radius;
        }
    }
}

MovingDisk bounding_disk(const Clip& clip, int first, int end) {
    const Run run(clip, {0, 0}, first, end);
    return around<double>(run, run.per_sample(), std::max(clip.steps(first, end), 1));
}

MovingDisk Blocks::bound(const Level& level, int block, int span) const {
    const Paths p = paths_of(level);
    MovingDisk out{origin_ + glm::dvec2(p.x()[block], p.y()[block]), glm::dvec2(0), p.r()[block]};
    if (level.arrays == kStill) return out;
    const double part = static_cast<double>(steps(block * span, span)) / span;
    out.drift = part * glm::dvec2(p.dx()[block], p.dy()[block]);
    return out;
}

int Blocks::node_count() const { return node_of(0, count(0) - 1) + 1; }

int Blocks::node_of(int level, int block) const {
    int before = has_root_above() ? 1 : 0;
    for (int above = levels() - 1; above > level; --above) before += count(above);
    return before + block;
}

Blocks::Node Blocks::node(int index) const {
    if (index == 0) return {has_root_above() ? levels() : 0, 0, 0, count_, root()};
    int level = levels() - 1;
    int block = index - 1;
    for (; block >= count(level); --level) block -= count(level);
    const int first = block * span(level);
    return {level, block, first, std::min(count_ - first, span(level)),
            bound(levels_[static_cast<std::size_t>(level)], block, span(level))};
}

std::size_t Blocks::bytes() const { return sizeof(*this) + values_.capacity() * sizeof(float); }

}  // namespace mobb
