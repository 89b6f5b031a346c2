#include <base/random.h>
#include <explain/expected_cost.h>
#include <explain/meeting_area.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>

namespace mobbscope {

namespace {

using std::numbers::pi;

/// A function by points, in order; between them it is linear, beyond them constant.
struct Curve {
    std::vector<double> x, y;

    double at(double where) const { return between(x, y, where); }
    /// Where a function that grows comes to a value.
    double where(double value) const { return between(y, x, value); }

  private:
    static double between(const std::vector<double>& from, const std::vector<double>& to, double value) {
        const auto above = std::ranges::lower_bound(from, value);
        if (above == from.begin()) return to.front();
        if (above == from.end()) return to.back();
        const auto i = static_cast<std::size_t>(above - from.begin());
        return std::lerp(to[i - 1], to[i], (value - from[i - 1]) / (from[i] - from[i - 1]));
    }
};

/// How a clip moves, by how long it is watched: means over all its moments.
struct Wandering {
    Curve square_way;  ///< of the way from where it was, m^2
    Curve reach;       ///< beyond a disk of the mean radius: of all disks that were, in all directions on average, m

    explicit Wandering(const mobb::Clip& clip) {
        constexpr std::size_t kDirections = 16, kMoments = 4096;
        const std::size_t stride = 1 + static_cast<std::size_t>(clip.count() - 1) / kMoments;
        std::vector<mobb::Disk> disks;
        for (std::size_t i = 0; i < clip.samples().size(); i += stride) disks.push_back(clip.samples()[i]);
        const std::size_t count = disks.size();
        double mean_radius = 0;
        // By direction and moment: how far the disks of that moment and those watched before it reach.
        std::array<std::vector<double>, kDirections> reaches;
        for (const mobb::Disk& disk : disks) mean_radius += disk.r / static_cast<double>(count);
        for (std::size_t k = 0; k < kDirections; ++k) {
            const double angle = 2 * pi * static_cast<double>(k) / kDirections;
            for (const mobb::Disk& d : disks) reaches[k].push_back(d.x * std::cos(angle) + d.y * std::sin(angle) + d.r);
        }
        for (std::size_t length = 1;; length *= 2) {
            const std::size_t last = std::min(length, count) - 1;
            double squares = 0, sum = 0;
            for (std::size_t i = last; i < count; ++i) {
                const double x = disks[i].x - disks[i - last].x, y = disks[i].y - disks[i - last].y;
                squares += x * x + y * y;
                for (const std::vector<double>& in_direction : reaches) sum += in_direction[i] / kDirections;
            }
            const auto moments = static_cast<double>(count - last);
            const double time = static_cast<double>(last * stride) * clip.dt();
            square_way.x.push_back(time);
            square_way.y.push_back(squares / moments);
            reach.x.push_back(time);
            reach.y.push_back(length == 1 ? 0 : std::max(0.0, sum / moments - mean_radius));
            if (length >= count) break;
            for (std::vector<double>& far : reaches) {
                for (std::size_t i = count - 1; i >= length; --i) far[i] = std::max(far[i], far[i - length]);
            }
        }
    }
};

/// Where two clips have collided before.
class EarlierHits {
  public:
    EarlierHits(const mobb::Clip& a, const mobb::Clip& b) {
        const Wandering of_a(a), of_b(b);
        const double all = std::max(a.duration(), b.duration());
        double farthest = 0, widest = 0;
        add(0, 0, 0);
        double time = std::min(a.dt(), b.dt());
        for (;;) {
            const double way = std::sqrt(of_a.square_way.at(time) + of_b.square_way.at(time));
            const double reach = std::hypot(of_a.reach.at(time), of_b.reach.at(time));
            farthest = std::max(farthest, way);
            // Disks on a straight way reach by this much less than the way is long.
            widest = std::max(widest, reach - way / pi);
            add(time, farthest, widest);
            if (time >= all) break;
            time *= kStep;
        }
    }

    /// The area of the shifts at which they have, of those of an area around the present one. `radii`: both added;
    /// `time`: for which both were there.
    double area(double radii, double time, double around) const {
        const double edge = std::sqrt(around / pi);
        const double watched = std::min(time, way_.where(edge));
        const double radius = radii + kAtOnce * beyond_.at(watched);
        return pi * radius * radius + 2 * radius * std::clamp(edge - radius, 0.0, way_.at(watched));
    }

  private:
    static constexpr double kStep = 1.5;
    /// Where one of the two reaches farthest, the other often does not: measured on four clips, docs/experiments.md.
    static constexpr double kAtOnce = 0.5;

    void add(double time, double way, double beyond) {
        way_.x.push_back(time);
        way_.y.push_back(way);
        beyond_.x.push_back(time);
        beyond_.y.push_back(beyond);
    }

    Curve way_, beyond_;
};

/// What a pair needs of a node.
struct NodeFigures {
    BoxOutline outline;
    double begin = 0;   ///< s, in the clip
    double radius = 0;  ///< m, the mean
    bool is_leaf = true;
    int count = 0;
    int inner_below = 0;         ///< inner nodes below it, itself included
    double inner_durations = 0;  ///< of these, s
};

std::vector<NodeFigures> figures_of(const mobb::Tree& tree) {
    std::vector<double> radii{0};  // of the samples before
    radii.reserve(tree.clip().samples().size() + 1);
    for (const mobb::Disk& disk : tree.clip().samples()) radii.push_back(radii.back() + disk.r);
    std::vector<NodeFigures> out;
    out.reserve(tree.nodes().size());
    for (int i = 0; i < static_cast<int>(tree.nodes().size()); ++i) {
        const mobb::Node& node = tree.node(i);
        const double sum = radii[static_cast<std::size_t>(node.end())] - radii[static_cast<std::size_t>(node.first)];
        out.push_back({BoxOutline(tree, i), tree.t0(node), sum / node.count, node.is_leaf(), node.count});
    }
    // Children stand behind their parents.
    for (int i = static_cast<int>(out.size()) - 1; i >= 0; --i) {
        NodeFigures& node = out[static_cast<std::size_t>(i)];
        if (node.is_leaf) continue;
        node.inner_below = 1;
        node.inner_durations = node.outline.duration;
        for (const int child : tree.children(i)) {
            node.inner_below += out[static_cast<std::size_t>(child)].inner_below;
            node.inner_durations += out[static_cast<std::size_t>(child)].inner_durations;
        }
    }
    return out;
}

/// Goes down both trees level by level, as the traversal does, with all pairs of a level at once.
class Descent {
  public:
    Descent(const mobb::Tree& a, const mobb::Tree& b, std::size_t most_pairs)
        : a_(a),
          b_(b),
          nodes_a_(figures_of(a)),
          nodes_b_(figures_of(b)),
          hits_(a.clip(), b.clip()),
          most_pairs_(most_pairs),
          out_{StandardPlacements(a.clip(), b.clip()), {}, {}, {}, {}} {
        out_.shares = {std::vector<double>(nodes_a_.size()), std::vector<double>(nodes_b_.size())};
    }

    ExpectedCost run() && {
        std::vector<Pair> pairs{{0, 0, {1, 1}, 1, 1}}, below;
        for (std::uint64_t level = 0; !pairs.empty(); ++level) {
            out_.levels.emplace_back();
            // The roots' times are always tested.
            if (level == 0) expect(mobb::TestKind::time, {1, 1});
            // Of 3D boxes several headings are tried where pairs are few; where they are many, each has others.
            headings_ = static_cast<int>(std::clamp<std::size_t>(kHeadings / pairs.size(), 2, 64));
            below.clear();
            for (Pair& pair : pairs) visit(pair, below);
            thin_out(below, level);
            pairs.swap(below);
        }
        for (const MeanTests& level : out_.levels) out_.tests += level;
        const double boxes = out_.tests.boxes();
        for (std::vector<double>& side : out_.shares) {
            for (double& share : side) share = boxes > 0 ? share / boxes : 0.5 / static_cast<double>(side.size());
        }
        return std::move(out_);
    }

  private:
    /// With hits, and without.
    struct Chances {
        double expected, bound;

        Chances operator*(double factor) const { return {expected * factor, bound * factor}; }
    };

    struct Pair {
        int a, b;
        Chances called;  ///< that the pair which leads here meets, and nothing was hit before this one begins
        double least;    ///< of meeting_area/area, over the pairs that lead here, 1 at most
        double weight;   ///< how many pairs it counts for
    };

    static constexpr std::size_t kHeadings = 512;  ///< of all pairs of a level

    /// The chance that two nodes share time.
    double share(const NodeFigures& p, const NodeFigures& q) const {
        const double h_p = p.outline.duration, h_q = q.outline.duration;
        return h_p > 0 && h_q > 0 ? (h_p + h_q) / (2 * out_.placements.offset) : 0;
    }

    void expect(mobb::TestKind test, Chances tests) {
        out_.levels.back()[test] += tests.expected;
        out_.bound[test] += tests.bound;
    }

    void visit(const Pair& pair, std::vector<Pair>& below) {
        const NodeFigures& p = nodes_a_[static_cast<std::size_t>(pair.a)];
        const NodeFigures& q = nodes_b_[static_cast<std::size_t>(pair.b)];
        const double shared = share(p, q);
        if (shared == 0) return;
        double least = pair.least;
        if (const auto test = test_of(p.outline, q.outline)) {
            const Chances tests = pair.called * (shared * pair.weight);
            expect(*test, tests);
            out_.shares[0][static_cast<std::size_t>(pair.a)] += tests.expected / 2;
            out_.shares[1][static_cast<std::size_t>(pair.b)] += tests.expected / 2;
            least = std::min(least, meeting_area(p.outline, q.outline, headings_, next_heading()) / area());
        }
        const double durations = (p.outline.duration + q.outline.duration) / (2 * out_.placements.offset);
        if (!p.is_leaf && !q.is_leaf) {
            for (const int a : a_.children(pair.a)) {
                for (const int b : b_.children(pair.b)) {
                    const NodeFigures& child_a = nodes_a_[static_cast<std::size_t>(a)];
                    const NodeFigures& child_b = nodes_b_[static_cast<std::size_t>(b)];
                    const Chances called = without_hits(p, q, least, before(child_a, child_b), 0);
                    expect(mobb::TestKind::time, called * (durations * pair.weight));
                    below.push_back({a, b, called, least, pair.weight});
                }
            }
        } else {
            expect_leaf(p, q, without_hits(p, q, least, before(p, q), mean_common(p, q) / 2) * pair.weight);
        }
    }

    /// A leaf meets all leaves below an inner node whose times it shares, or one other leaf; on the way two times are
    /// tested for each inner node.
    void expect_leaf(const NodeFigures& p, const NodeFigures& q, Chances met) {
        const double leaf_duration = p.is_leaf ? p.outline.duration : q.outline.duration;
        const NodeFigures& other = p.is_leaf ? q : p;
        const double twice_offset = 2 * out_.placements.offset;
        const double times = 2 * (other.inner_below * leaf_duration + other.inner_durations) / twice_offset;
        const double pairs = static_cast<double>(p.count) * q.count * (a_.clip().dt() + b_.clip().dt()) / twice_offset;
        expect(mobb::TestKind::time, met * times);
        expect(mobb::TestKind::samples, met * pairs);
    }

    /// The mean time that two nodes share, if they share some.
    static double mean_common(const NodeFigures& p, const NodeFigures& q) {
        return p.outline.duration * q.outline.duration / (p.outline.duration + q.outline.duration);
    }

    /// What comes before the time that two nodes share.
    struct Before {
        double nothing;  ///< the chance that one of the clips begins only then
        double time;     ///< else for how long both were there, s, on average
    };
    static Before before(const NodeFigures& p, const NodeFigures& q) {
        const double earlier = std::min(p.begin, q.begin), apart = std::abs(p.begin - q.begin);
        const double common = mean_common(p, q);
        if (earlier > 0) return {0, earlier + std::min(apart, common) / 2};
        return {1 - std::min(1.0, apart / std::min(p.outline.duration, q.outline.duration)) / 2, common};
    }

    /// That two nodes meet that have the chance `least` without hits, and nothing was hit before the time that two of
    /// theirs share, nor in the first `inside` seconds of it.
    Chances without_hits(const NodeFigures& p, const NodeFigures& q, double least, const Before& earlier,
                         double inside) const {
        const auto hit = [&](double time) {
            return time > 0 ? hits_.area(p.radius + q.radius, time, least * area()) / area() : 0;
        };
        const double hits = earlier.nothing * hit(inside) + (1 - earlier.nothing) * hit(earlier.time + inside);
        return {std::max(0.0, least - hits), least};
    }

    /// Draws one pair at random out of each of as many stretches, equally long, as pairs are worked out.
    void thin_out(std::vector<Pair>& pairs, std::uint64_t level) const {
        if (pairs.size() <= most_pairs_) return;
        const double stretch = static_cast<double>(pairs.size()) / static_cast<double>(most_pairs_);
        for (std::size_t i = 0; i < most_pairs_; ++i) {
            const double at = (static_cast<double>(i) + CounterRandom(0, level, i).unit()) * stretch;
            pairs[i] = pairs[std::min(static_cast<std::size_t>(at), pairs.size() - 1)];
            pairs[i].weight *= stretch;
        }
        pairs.resize(most_pairs_);
    }

    /// Radians, spread evenly by the golden ratio.
    double next_heading() {
        turn_ += std::numbers::phi - 1;
        turn_ -= std::floor(turn_);
        return 2 * pi * turn_;
    }

    double area() const { return out_.placements.area(); }

    const mobb::Tree& a_;
    const mobb::Tree& b_;
    std::vector<NodeFigures> nodes_a_, nodes_b_;
    EarlierHits hits_;
    std::size_t most_pairs_;
    ExpectedCost out_;
    int headings_ = 1;
    double turn_ = 0;
};

}  // namespace

std::vector<double> ExpectedCost::node_shares() const {
    std::vector<double> out = shares[0];
    for (std::size_t i = 0; i < out.size(); ++i) out[i] += shares[1][i];
    return out;
}

std::optional<ExpectedCost> expected_cost(const mobb::Tree& a, const mobb::Tree& b, std::size_t most_pairs) {
    if (a.blocks() || b.blocks()) return std::nullopt;
    return Descent(a, b, most_pairs).run();
}

std::vector<double> expected_shares(const mobb::Tree& tree) {
    const std::optional<ExpectedCost> expected = expected_cost(tree, tree);
    return expected ? expected->node_shares() : std::vector<double>();
}

}  // namespace mobbscope
