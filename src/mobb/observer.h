/// What may watch a traversal. The traversal calls these hooks and nothing else; with NoObserver they compile to
/// nothing.
#pragma once

#include <mobb/box.h>
#include <mobb/separation.h>

#include <concepts>
#include <cstdint>

namespace mobb {

/// How many tests of each kind a query made: what the paper's tables count, and those of the kinds beyond it.
struct TestCounts {
    std::int64_t time = 0;
    std::int64_t obb2d = 0;
    std::int64_t obb3d = 0;
    std::int64_t moving = 0;
    std::int64_t aabb = 0;
    std::int64_t samples = 0;  ///< pairs (i, j) whose distance was measured

    std::int64_t boxes() const { return obb2d + obb3d + moving + aabb; }

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

    void time_test(bool) { ++tests.time; }
    void box_test(BoxKind test, const Separation&) {
        switch (test) {
            case BoxKind::obb2d:
                ++tests.obb2d;
                break;
            case BoxKind::obb3d:
                ++tests.obb3d;
                break;
            case BoxKind::moving:
                ++tests.moving;
                break;
            case BoxKind::aabb:
                ++tests.aabb;
                break;
        }
    }
    void sample_pair(int, int, double) { ++tests.samples; }
};

}  // namespace mobb
