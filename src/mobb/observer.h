/// What may watch a traversal. The traversal calls these hooks and nothing else; with NoObserver they compile to
/// nothing.
#pragma once

#include <mobb/box.h>
#include <mobb/separation.h>

#include <array>
#include <concepts>
#include <cstdint>
#include <numeric>

namespace mobb {

/// How many tests of each kind a query made: what the paper's tables count, and those of the kinds beyond it.
struct TestCounts {
    std::array<std::int64_t, kTestKindCount> by_kind{};  ///< of samples: pairs (i, j) whose distance was measured

    std::int64_t& operator[](TestKind test) { return by_kind[test.index()]; }
    std::int64_t operator[](TestKind test) const { return by_kind[test.index()]; }
    std::int64_t all() const { return std::accumulate(by_kind.begin(), by_kind.end(), std::int64_t{0}); }
    std::int64_t boxes() const { return all() - (*this)[TestKind::time] - (*this)[TestKind::samples]; }

    friend bool operator==(const TestCounts&, const TestCounts&) = default;
};

/// Nobody watches: the calls of the hooks are not even compiled.
struct NoObserver {
    static constexpr bool watches = false;
};

/// The hooks, doing nothing: a base for observers that need only some of them.
struct ObserverBase {
    static constexpr bool watches = true;

    void enter(int /*a*/, int /*b*/) {}  ///< a pair of nodes is about to be tested
    void leave() {}                      ///< ... and it and all below it is done
    void time_test(bool /*overlap*/) {}
    void box_test(BoxKind /*test*/, const Separation&) {}
    void sample_pair(int /*i*/, int /*j*/, double /*squared_distance*/) {}
    void sample_test(bool /*hit*/) {}  ///< after the pairs of two leaves
};

/// NoObserver, or a type with the hooks of ObserverBase.
template <class T>
concept TraversalObserver = !T::watches || requires(T & observer, const Separation& separation) {
    observer.enter(0, 0);
    observer.leave();
    observer.time_test(true);
    observer.box_test(BoxKind::obb2d, separation);
    observer.sample_pair(0, 0, 0.0);
    observer.sample_test(true);
};

/// Counts tests.
struct Statistics : ObserverBase {
    TestCounts tests;

    void time_test(bool) { ++tests[TestKind::time]; }
    void box_test(BoxKind test, const Separation&) { ++tests[test]; }
    void sample_pair(int, int, double) { ++tests[TestKind::samples]; }
};

}  // namespace mobb
