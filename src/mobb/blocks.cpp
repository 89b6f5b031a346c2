#include <mobb/blocks.h>

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

namespace mobb {

namespace {

constexpr float kNone = std::numeric_limits<float>::quiet_NaN();

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

const Clip& existing(const ClipPtr& clip) {
    if (!clip) throw std::invalid_argument("blocks need a clip");
    return *clip;
}

/// Samples [first, end) of a clip, as a bound sees them that moves by `per_sample` a sample.
class Run {
  public:
    Run(const Clip& clip, glm::dvec2 origin, int first, int end)
        : samples_(clip.samples().data()), origin_(origin), first_(first), end_(end) {
        const bool runs = clip.motion() == Motion::linear;
        // Of a linear clip the last disk of the run is the one that its last sample runs to, if any.
        last_ = runs ? std::min(end, clip.count() - 1) : end - 1;
        stays_ = !runs;
        last_stays_ = last_ < end;
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
        if (stays_ || !last_stays_) return;
        const Disk& d = samples_[last_];
        const double at = end_ - first_;
        visit((d.x - origin_.x) - at * per_sample.x, (d.y - origin_.y) - at * per_sample.y, d.r);
    }

  private:
    const Disk* samples_;
    glm::dvec2 origin_;
    int first_, end_, last_;
    bool stays_;       ///< each disk does
    bool last_stays_;  ///< the last disk does
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

}  // namespace

Blocks::Blocks(ClipPtr clip)
    : dt_(existing(clip).dt()),
      per_dt_(1 / dt_),
      count_(clip->count()),
      linear_(clip->motion() == Motion::linear),
      disks_(clip->samples().data()),
      reach_(clip->reach()),
      clip_(std::move(clip)) {
    const int n = count_;
    Middle middle;
    for (const Disk& d : clip_->samples()) middle.add(d.x, d.y, d.r);
    origin_ = middle.get();
    for (const Disk& d : clip_->samples()) {
        const double x = std::abs(d.x - origin_.x), y = std::abs(d.y - origin_.y);
        extent_ = std::max(extent_, rounded_up(x + y + d.r));
        radius_ = std::max(radius_, std::sqrt(x * x + y * y) + d.r);
    }

    // All that is to be stored, so that it is allocated once.
    const auto blocks_of = [n](int level) { return (n + span(level) - 1) / span(level); };
    const auto values_in = [](int arrays, int count, int pad) {
        return static_cast<std::size_t>(arrays) * static_cast<std::size_t>(count + pad);
    };
    std::size_t values = kSamples + values_in(kStill, n, kSamplePad) + values_in(kStill, n + 1, kSamplePad);
    values += values_in(kStill, blocks_of(0) + 1, kBlockPad);
    for (int level = 0;; ++level) {
        values += values_in(level == 0 ? kStill : kMoving, blocks_of(level), kBlockPad);
        if (blocks_of(level) <= kMostAtTop) break;
    }
    values_.reserve(values);

    // What lies before an array is what lies behind another one.
    values_.assign(kSamples, kNone);
    samples_ = add_samples();
    sample_pairs_ = add_pairs(samples_);
    for (bool more = true; more; ++level_count_) {
        Level& level = levels_[static_cast<std::size_t>(level_count_)];
        level = add_level(level_count_);
        more = level.count > kMostAtTop;
    }
    pairs_ = add_pairs(levels_[0]);
}

Blocks::Level Blocks::add_arrays(int count, int arrays, int pad) {
    const Level level{values_.size(), count + pad, count, arrays};
    values_.resize(values_.size() + static_cast<std::size_t>(arrays) * static_cast<std::size_t>(level.stride), kNone);
    return level;
}

Blocks::Level Blocks::add_level(int number) {
    const int n = count_, size = span(number);
    const bool moves = number > 0;
    const Level level = add_arrays((n + size - 1) / size, moves ? kMoving : kStill, kBlockPad);
    const int stride = level.stride;
    float* const values = values_.data() + level.at;
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
        block[5 * stride] = static_cast<float>(samples) / static_cast<float>(size);
        speed_ = std::max(speed_, rounded_up(glm::length(disk.drift) / (size * dt_)));
    }
    return level;
}

Blocks::Level Blocks::add_samples() {
    const Level level = add_arrays(count_, kStill, kSamplePad);
    float* const x = values_.data() + level.at;
    float* const y = x + level.stride;
    float* const r = y + level.stride;
    for (int i = 0; i < count_; ++i) {
        const Disk& d = disks_[i];
        x[i] = static_cast<float>(d.x - origin_.x);
        y[i] = static_cast<float>(d.y - origin_.y);
        r[i] = static_cast<float>(d.r);
    }
    for (int i = 0; linear_ && i + 1 < count_; ++i) {
        const float dx = x[i + 1] - x[i], dy = y[i + 1] - y[i], way = std::sqrt(dx * dx + dy * dy);
        x[i] += dx / 2;
        y[i] += dy / 2;
        r[i] = std::max(r[i], r[i + 1]) + way / 2;
        speed_ = std::max(speed_, rounded_up(way / dt_));
    }
    return level;
}

Blocks::Level Blocks::add_pairs(const Level& of) {
    const Level level = add_arrays(of.count + 1, kStill, of.stride - of.count);
    const Paths one = paths_of(of);
    float* const x = values_.data() + level.at;
    float* const y = x + level.stride;
    float* const r = y + level.stride;
    for (int j = 0; j <= of.count; ++j) {
        const int before = std::max(j - 1, 0), at = std::min(j, of.count - 1);
        const float dx = one.x()[at] - one.x()[before], dy = one.y()[at] - one.y()[before];
        const float r0 = one.r()[before], r1 = one.r()[at], apart = std::sqrt(dx * dx + dy * dy);
        // Where neither holds the other, both touch the disk from inside.
        r[j] = std::max((r0 + apart + r1) / 2, std::max(r0, r1));
        const float part = apart > 0 ? std::min((r[j] - r0) / apart, 1.0F) : 0;
        x[j] = one.x()[before] + part * dx;
        y[j] = one.y()[before] + part * dy;
    }
    return level;
}

MovingDisk bounding_disk(const Clip& clip, int first, int end) {
    const Run run(clip, {0, 0}, first, end);
    return around<double>(run, run.per_sample(), end - first);
}

MovingDisk Blocks::bound(const Level& level, int block, int span) const {
    const Paths p = paths_of(level);
    MovingDisk out{origin_ + glm::dvec2(p.x()[block], p.y()[block]), glm::dvec2(0), p.r()[block]};
    if (level.arrays == kStill) return out;
    const double part = static_cast<double>(std::min(count_ - block * span, span)) / span;
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
