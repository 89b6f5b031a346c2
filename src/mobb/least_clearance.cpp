#include <mobb/halves_search.h>
#include <mobb/least_clearance.h>
#include <mobb/separation.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace mobb {

namespace {

constexpr int kMostInLeaf = 8;

/// Branch and bound over pairs of ranges that share time.
class NearestSearch {
  public:
    NearestSearch(const PlacedClip& a, const ClipDisks& disks_a, const PlacedClip& b, const ClipDisks& disks_b)
        : a_(a), b_(b), disks_a_(disks_a), disks_b_(disks_b) {
        // The predicate may see disks nearer than bounds do.
        RelativeFrame frame(a.frame(), b.frame(), 1);
        if (a.is_linear() || b.is_linear()) frame.cover_swept_disks(a.frame(), b.frame());
        slack_ = frame.slack2d();
        to_a_ = frame.rotation();
        offset_ = frame.offset();
    }

    std::optional<NearestPair> run(const std::optional<NearestPair>& near) {
        if (near) measure(near->a_sample, near->a_sample + 1, near->b_sample, near->b_sample + 1);
        const auto bound = [this](int a, int b) { return this->bound(a, b); };
        const auto leaves = [this](const ClipDisks::Range& a, const ClipDisks::Range& b) {
            measure(a.first, a.end, b.first, b.end);
        };
        HalvesSearch(disks_a_, disks_b_, bound, leaves, least_).run();
        return found_;
    }

  private:
    /// No more than the clearance of any two samples of the ranges; infinity if these share no time.
    double bound(int ia, int ib) const {
        const ClipDisks::Range& a = disks_a_[ia];
        const ClipDisks::Range& b = disks_b_[ib];
        if (!overlap_in_time(a_.time(a.first), a_.time(a.end), b_.time(b.first), b_.time(b.end)))
            return std::numeric_limits<double>::infinity();
        const glm::dvec2 between = to_a_(b.center) + offset_ - a.center;
        return std::sqrt(between.x * between.x + between.y * between.y) - a.radius - b.radius - slack_;
    }

    void measure(int first_a, int end_a, int first_b, int end_b) {
        Measuring measuring{{}, *this};
        visit_sample_pairs(a_, first_a, end_a, b_, first_b, end_b, measuring, measuring);
    }

    /// Is told of each pair of samples that share time, and then whether they collide.
    struct Measuring : ObserverBase {
        NearestSearch& search;

        void sample_pair(int i, int j, double squared) {
            double apart = 0;
            if (search.a_.is_linear() || search.b_.is_linear()) {
                const Approach approach = approach_of(search.a_, i, search.b_, j);
                apart = approach.clearance(approach.nearest());
            } else {
                apart = std::sqrt(squared) - (search.a_.disk(i).r + search.b_.disk(j).r);
            }
            colliding = std::min(apart, -std::numeric_limits<double>::denorm_min());
            search.take(std::max(apart, 0.0), i, j);
        }
        bool operator()(int i, int j) {
            search.take(colliding, i, j);
            return false;
        }

        double colliding = 0;  ///< clearance of the last pair if it collides
    };

    void take(double clearance, int i, int j) {
        if (clearance >= least_) return;
        least_ = clearance;
        found_ = NearestPair{clearance, i, j};
    }

    const PlacedClip& a_;
    const PlacedClip& b_;
    const ClipDisks& disks_a_;
    const ClipDisks& disks_b_;
    double slack_ = 0;
    Rotation to_a_;
    glm::dvec2 offset_{0};
    double least_ = std::numeric_limits<double>::infinity();
    std::optional<NearestPair> found_;
};

}  // namespace

std::optional<NearestPair> least_clearance(const PlacedClip& a, const ClipDisks& disks_a, const PlacedClip& b,
                                           const ClipDisks& disks_b, const std::optional<NearestPair>& near) {
    return NearestSearch(a, disks_a, b, disks_b).run(near);
}

ClipDisks::ClipDisks(const Clip& clip) : clip_(&clip) { build(0, clip.steps()); }

int ClipDisks::build(int first, int end) {
    const auto index = ranges_.size();
    ranges_.emplace_back();
    Range range{first, end};
    // One that runs to the next sample lies between the two.
    const int stop = clip_->runs() ? std::min(end + 1, clip_->count()) : end;
    const auto disks =
        clip_->samples().subspan(static_cast<std::size_t>(first), static_cast<std::size_t>(stop - first));
    glm::dvec2 least(std::numeric_limits<double>::max()), most(std::numeric_limits<double>::lowest());
    for (const Disk& disk : disks) {
        least = {std::min(least.x, disk.x), std::min(least.y, disk.y)};
        most = {std::max(most.x, disk.x), std::max(most.y, disk.y)};
    }
    range.center = (least + most) / 2.0;
    for (const Disk& disk : disks)
        range.radius = std::max(range.radius, std::hypot(disk.x - range.center.x, disk.y - range.center.y) + disk.r);
    if (end - first > kMostInLeaf) {
        const int middle = first + (end - first) / 2;
        build(first, middle);
        range.second = build(middle, end);
    }
    ranges_[index] = range;
    return static_cast<int>(index);
}

}  // namespace mobb
