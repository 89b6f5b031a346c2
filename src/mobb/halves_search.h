/// Branch and bound over two paths that are halved, and halved again.
#pragma once

#include <array>
#include <utility>

namespace mobb {

/// Looks for the two samples, one of either path, that have the least of something. Ranges of a path are numbered from
/// 0, the whole: `a[i]` has `first`, `end`, `second` and `is_leaf()`; the halves of i are i + 1 and its `second`.
template <class Ranges, class Bound, class Leaves>
class HalvesSearch {
  public:
    /// `bound(i, j)`: no more than what any two samples of the ranges have. `leaves(a, b)`: measures the samples of two
    /// ranges that are not halved, and lowers `least` to what it finds below it. What is bound to be no less is passed
    /// over. All are referred to.
    HalvesSearch(const Ranges& a, const Ranges& b, const Bound& bound, const Leaves& leaves, const double& least)
        : a_(a), b_(b), bound_(bound), leaves_(leaves), least_(least) {}

    void run() const { visit({0, 0, bound_(0, 0)}); }

  private:
    struct Pair {
        int a, b;
        double bound;
    };

    void visit(const Pair& at) const {
        if (at.bound >= least_) return;
        const auto& a = a_[at.a];
        const auto& b = b_[at.b];
        if (a.is_leaf() && b.is_leaf()) return leaves_(a, b);
        // The longer of the two is halved, and the more promising half is looked at first.
        const bool halve_a = b.is_leaf() || (!a.is_leaf() && a.end - a.first >= b.end - b.first);
        std::array<Pair, 2> halves{halve_a ? Pair{at.a + 1, at.b, 0} : Pair{at.a, at.b + 1, 0},
                                   halve_a ? Pair{a.second, at.b, 0} : Pair{at.a, b.second, 0}};
        for (Pair& half : halves) half.bound = bound_(half.a, half.b);
        if (halves[1].bound < halves[0].bound) std::swap(halves[0], halves[1]);
        for (const Pair& half : halves) visit(half);
    }

    const Ranges& a_;
    const Ranges& b_;
    const Bound& bound_;
    const Leaves& leaves_;
    const double& least_;
};

}  // namespace mobb
