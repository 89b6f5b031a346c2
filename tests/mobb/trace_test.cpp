#include <gtest/gtest.h>
#include <mobb/query.h>
#include <mobb/random_motion.h>
#include <mobb/trace.h>

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <span>
#include <tuple>

namespace mobb {
namespace {

using test::Random;

/// A node's box in the world, from what `fit --json` and the scene say of it.
struct WorldBox {
    glm::dvec3 center;
    glm::dvec3 axes[3];
    glm::dvec3 half;
    glm::dvec2 velocity;  ///< per w*t
    bool round = false;   ///< the cylinder inside it
};
WorldBox world_box(const Box& box, const Placement& placement, double w) {
    const double angle = placement.rotate_deg * std::acos(-1.0) / 180;
    const auto turned = [angle](glm::dvec3 v) {
        return glm::dvec3{std::cos(angle) * v.x - std::sin(angle) * v.y, std::sin(angle) * v.x + std::cos(angle) * v.y,
                          v.z};
    };
    WorldBox out;
    out.center = turned(box.center) + glm::dvec3{placement.translate, w * placement.start};
    for (std::size_t k = 0; k < 3; ++k) out.axes[k] = turned(box.axes[k]);
    out.half = box.half;
    out.round = info(box.kind).round;
    out.velocity = turned(glm::dvec3(box.drift / box.half.z, 0));
    return out;
}

/// What a box that moves is at a time, without extent in time.
WorldBox at_time(WorldBox box, double wt) {
    box.center += glm::dvec3(box.velocity * (wt - box.center.z), wt - box.center.z);
    box.half.z = 0;
    return box;
}

/// The box along the world's axes around it.
WorldBox wrapped(const WorldBox& box) {
    WorldBox out{box.center, {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {0, 0, 0}, {0, 0}, box.round};
    for (int k = 0; k < 3; ++k) out.half += glm::abs(box.half[k] * box.axes[k]);
    return out;
}

/// The gap between the projections of two boxes' corners, or rims, on a unit axis; negative where they overlap.
double gap_along(const WorldBox& a, const WorldBox& b, glm::dvec3 axis) {
    const auto reach = [axis](const WorldBox& box, double sign) {
        if (box.round) return box.half.x * std::hypot(axis.x, axis.y) + box.half.z * std::abs(axis.z);
        double best = -1e300;
        for (int corner = 0; corner < 8; ++corner) {
            // Relative to a's center, so that a far scene costs no digits here.
            glm::dvec3 p{0};
            for (int k = 0; k < 3; ++k) p += ((corner >> k) & 1 ? 1.0 : -1.0) * box.half[k] * box.axes[k];
            best = std::max(best, sign * glm::dot(p, axis));
        }
        return best;
    };
    const double offset = glm::dot(b.center - a.center, axis);
    return std::max(offset - reach(b, -1) - reach(a, 1), -offset - reach(b, 1) - reach(a, -1));
}

/// The common time of two boxes, w*t.
Interval common_time(const WorldBox& a, const WorldBox& b) {
    return {std::max(a.center.z - a.half.z, b.center.z - b.half.z),
            std::min(a.center.z + a.half.z, b.center.z + b.half.z)};
}

/// When the centres of two boxes are nearest in their common time.
double nearest_time(const WorldBox& a, const WorldBox& b) {
    const auto [begin, end] = common_time(a, b);
    const auto apart = [&](double wt) { return glm::dvec2(at_time(b, wt).center - at_time(a, wt).center); };
    const glm::dvec2 way = b.velocity - a.velocity;
    const double squared = glm::dot(way, way);
    return squared > 0 ? std::clamp(begin - glm::dot(apart(begin), way) / squared, begin, end) : begin;
}

/// Of two moving boxes over their common time: the lesser of the gaps at its ends, if they are on one side; else below
/// zero.
double moving_gap_along(const WorldBox& a, const WorldBox& b, glm::dvec3 axis) {
    const auto [begin, end] = common_time(a, b);
    const auto gap = [&](double wt) { return gap_along(at_time(a, wt), at_time(b, wt), axis); };
    const auto side = [&](double wt) { return glm::dot(at_time(b, wt).center - at_time(a, wt).center, axis) > 0; };
    return side(begin) == side(end) ? std::min(gap(begin), gap(end)) : -1;
}

/// Replays a trace against the contract's description of the traversal, with box tests of its own.
class Replay {
  public:
    Replay(const PlacedTree& a, const PlacedTree& b, const Trace& trace) : a_(a), b_(b), trace_(trace) {}

    /// True if the traversal of the trace ends in a hit. Every event must have been used up.
    bool run() {
        const bool hit = visit(0, 0, 0, -1);
        EXPECT_EQ(step_, trace_.size());
        return hit;
    }

  private:
    bool visit(int ia, int ib, int depth, int parent) {
        const Node& na = a_.node(ia);
        const Node& nb = b_.node(ib);
        if (!time(ia, ib, depth, parent)) return false;
        if (!box(ia, ib, depth, parent)) return false;
        const int caller = step_ - 1;
        if (na.is_leaf() && nb.is_leaf()) return samples(ia, ib, depth, parent);
        if (na.is_leaf()) return walk(ia, ib, false, depth, caller);
        if (nb.is_leaf()) return walk(ib, ia, true, depth, caller);
        for (const int ca : a_.tree().children(ia)) {
            for (const int cb : b_.tree().children(ib)) {
                if (visit(ca, cb, depth + 1, caller)) return true;
            }
        }
        return false;
    }

    bool walk(int leaf, int inner, bool inner_is_a, int depth, int caller) {
        for (const int child : (inner_is_a ? a_ : b_).tree().children(inner)) {
            const int ia = inner_is_a ? child : leaf, ib = inner_is_a ? leaf : child;
            if (!time(ia, ib, depth + 1, caller)) continue;
            const Node& child_node = inner_is_a ? a_.node(child) : b_.node(child);
            const bool hit = child_node.is_leaf() ? samples(ia, ib, depth + 1, caller)
                                                  : walk(leaf, child, inner_is_a, depth + 1, step_ - 1);
            if (hit) return true;
        }
        return false;
    }

    Trace::Event next(int ia, int ib, int depth, int parent) {
        if (step_ >= trace_.size()) throw std::runtime_error("the trace ends early");
        const Trace::Event event = trace_[step_++];
        EXPECT_EQ(event.a, ia);
        EXPECT_EQ(event.b, ib);
        EXPECT_EQ(event.depth, depth);
        EXPECT_EQ(event.parent, parent);
        return event;
    }

    bool time(int ia, int ib, int depth, int parent) {
        const Trace::Event event = next(ia, ib, depth, parent);
        EXPECT_EQ(event.test, mobb::TestKind::time);
        const auto interval = [](const PlacedTree& tree, const Node& node) {
            const double dt = tree.tree().clip().dt(), start = tree.placed_clip().placement().start;
            return Interval{start + node.first * dt, start + node.end() * dt};
        };
        const Interval x = interval(a_, a_.node(ia)), y = interval(b_, b_.node(ib));
        const bool overlap = std::min(x.t1, y.t1) - std::max(x.t0, y.t0) > 1e-9;
        EXPECT_EQ(event.outcome, overlap ? Outcome::overlap : Outcome::disjoint_in_time);
        EXPECT_EQ(event.axis, -1);
        return overlap;
    }

    bool box(int ia, int ib, int depth, int parent) {
        const Box box_a = a_.tree().box(ia);
        const Box box_b = b_.tree().box(ib);
        const auto free_or_not = [](BoxKind kind) { return kind == BoxKind::obb2d || kind == BoxKind::obb3d; };
        if (box_a.kind != box_b.kind && !(free_or_not(box_a.kind) && free_or_not(box_b.kind))) return true;
        const Trace::Event event = next(ia, ib, depth, parent);
        EXPECT_EQ(name(event.test), box_a.kind == box_b.kind ? name(box_a.kind) : "obb3d");
        const double w = a_.time_scale();
        WorldBox a = world_box(box_a, a_.placed_clip().placement(), w);
        WorldBox b = world_box(box_b, b_.placed_clip().placement(), w);
        const BoxInfo& shape = info(event.test.box());
        const auto gap = shape.moves && !shape.round ? moving_gap_along : gap_along;

        std::vector<glm::dvec3> axes;
        switch (shape.axes) {
            case BoxAxes::world:
                a = wrapped(a);
                b = wrapped(b);
                axes = {{1, 0, 0}, {0, 1, 0}};
                break;
            case BoxAxes::floor:
                axes = {a.axes[0], a.axes[1], b.axes[0], b.axes[1]};
                break;
            case BoxAxes::centers: {
                const double nearest = nearest_time(a, b);
                a = at_time(a, nearest);
                b = at_time(b, nearest);
                const glm::dvec3 way = b.center - a.center;
                axes = {glm::length(way) > 0 ? glm::normalize(way) : way};
                break;
            }
            case BoxAxes::space_time:
                for (const auto& axis : a.axes) axes.push_back(axis);
                for (const auto& axis : b.axes) axes.push_back(axis);
                for (const auto& u : a.axes)
                    for (const auto& v : b.axes) axes.push_back(glm::cross(u, v));
                break;
        }
        const bool separated = event.outcome == Outcome::separated;
        EXPECT_TRUE(separated || event.outcome == Outcome::overlap);
        EXPECT_EQ(event.axis >= 0, separated);
        const int last = separated ? event.axis : static_cast<int>(axes.size());
        for (int k = 0; k < last; ++k) {
            const glm::dvec3 axis = axes[static_cast<std::size_t>(k)];
            const double length = glm::length(axis);
            if (length < 1e-3) continue;
            EXPECT_LE(gap(a, b, axis / length), 1e-8 / length) << "axis " << k;
        }
        if (separated) {
            const glm::dvec3 axis = axes[static_cast<std::size_t>(event.axis)];
            EXPECT_GE(glm::length(axis), 0.9e-3);
            EXPECT_GT(event.gap, 0);
            EXPECT_NEAR(gap(a, b, glm::normalize(axis)), event.gap, 1e-8 / glm::length(axis));
        }
        return !separated;
    }

    bool samples(int ia, int ib, int depth, int parent) {
        const Trace::Event event = next(ia, ib, depth, parent);
        EXPECT_EQ(event.test, mobb::TestKind::samples);
        const Node& na = a_.node(ia);
        const Node& nb = b_.node(ib);
        const PlacedClip& a = a_.placed_clip();
        const PlacedClip& b = b_.placed_clip();
        std::vector<MeasuredPair> expected;
        for (int i = na.first; i < na.end(); ++i) {
            for (int j = nb.first; j < nb.end(); ++j) {
                if (!overlap_in_time(a.time(i), a.time(i + 1), b.time(j), b.time(j + 1))) continue;
                expected.push_back({i, j, std::sqrt(squared_distance(a.disk(i), b.disk(j)))});
            }
        }
        std::sort(expected.begin(), expected.end(),
                  [](const MeasuredPair& x, const MeasuredPair& y) { return x.i + x.j < y.i + y.j; });
        bool hit = false;
        std::size_t measured = 0;
        for (; measured < expected.size() && !hit; ++measured) {
            hit = collide(a.disk(expected[measured].i), b.disk(expected[measured].j));
        }
        expected.resize(measured);
        EXPECT_EQ(event.outcome, hit ? Outcome::hit : Outcome::no_hit);
        EXPECT_EQ(event.pairs.size(), expected.size());
        for (std::size_t k = 0; k < std::min(expected.size(), event.pairs.size()); ++k) {
            EXPECT_EQ(event.pairs[k].i, expected[k].i);
            EXPECT_EQ(event.pairs[k].j, expected[k].j);
            EXPECT_EQ(event.pairs[k].distance, expected[k].distance);
        }
        return hit;
    }

    const PlacedTree& a_;
    const PlacedTree& b_;
    const Trace& trace_;
    int step_ = 0;
};

TEST(Trace, EveryEventReEvaluatedGivesTheSame) {
    Random random(20);
    std::int64_t events = 0, edge_axes = 0;
    std::map<std::string_view, std::int64_t> separations;
    for (int round = 0; round < 1500; ++round) {
        const ClipPtr a = test::random_clip(random, 400), b = test::random_partner(random, *a, 400);
        FitOptions fit_a = test::random_fit(random), fit_b = test::random_partner_fit(random, fit_a);
        fit_b.time_scale = fit_a.time_scale;
        const Tree tree_a(a, fit_a), tree_b(b, fit_b);
        for (int k = 0; k < 5; ++k) {
            Placement place_a, place_b;
            test::random_placements(random, *a, *b, place_a, place_b);
            const PlacedTree placed_a(tree_a, place_a), placed_b(tree_b, place_b);
            TraceRecorder recorder;
            const std::optional<Contact> contact = query(placed_a, placed_b, recorder);
            const Trace& trace = recorder.trace();
            ASSERT_EQ(Replay(placed_a, placed_b, trace).run(), contact.has_value());
            ASSERT_EQ(contact, query(placed_a, placed_b));
            Statistics statistics;
            query(placed_a, placed_b, statistics);
            ASSERT_EQ(trace.counts(), statistics.tests);
            events += trace.size();
            for (int step = 0; step < trace.size(); ++step) {
                separations[name(trace[step].test)] += trace[step].outcome == Outcome::separated;
                edge_axes += trace[step].axis >= 6;
            }
            if (HasFailure()) FAIL() << "round " << round << ", " << name(fit_a.tree) << " / " << name(fit_b.tree);
        }
    }
    EXPECT_GT(events, 50000);
    for (const TreeKind kind : test::kFittedTrees) EXPECT_GT(separations[name(info(kind).below)], 200) << name(kind);
    EXPECT_GT(edge_axes, 20);
}

/// Whether the events are the first ones of `whole`.
bool begins(const Trace& part, const Trace& whole) {
    for (int step = 0; step < part.size(); ++step) {
        const Trace::Event a = part[step], b = whole[step];
        const auto same = [](const MeasuredPair& p, const MeasuredPair& q) {
            return p.i == q.i && p.j == q.j && p.distance == q.distance;
        };
        if (std::tie(a.parent, a.depth, a.a, a.b, a.axis, a.gap, a.outcome) !=
                std::tie(b.parent, b.depth, b.a, b.b, b.axis, b.gap, b.outcome) ||
            a.test != b.test || !std::ranges::equal(a.pairs, b.pairs, same)) {
            return false;
        }
    }
    return part.size() <= whole.size();
}

TEST(Trace, RecordingStopsAtItsBoundAndTheAnswerDoesNot) {
    Random random(21);
    int by_events = 0, by_pairs = 0;
    for (int round = 0; round < 300; ++round) {
        const ClipPtr a = test::random_clip(random, 400), b = test::random_partner(random, *a, 400);
        const Tree tree_a(a, test::random_fit(random)), tree_b(b, tree_a.options());
        Placement place_a, place_b;
        test::random_placements(random, *a, *b, place_a, place_b);
        const PlacedTree placed_a(tree_a, place_a), placed_b(tree_b, place_b);
        TraceRecorder unbounded;
        const std::optional<Contact> contact = query(placed_a, placed_b, unbounded);
        const Trace& whole = unbounded.trace();
        for (const TraceBound bound : {TraceBound{whole.size() / 2, 1000}, TraceBound{1000, whole.pairs() / 2},
                                       TraceBound{whole.size(), whole.pairs()}}) {
            TraceRecorder recorder(bound);
            ASSERT_EQ(query(placed_a, placed_b, recorder), contact);
            ASSERT_EQ(recorder.tests(), unbounded.tests());
            const Trace& trace = recorder.trace();
            ASSERT_TRUE(begins(trace, whole));
            ASSERT_EQ(trace.events(), whole.size());
            ASSERT_EQ(trace.stopped(), trace.size() < whole.size());
            ASSERT_LE(trace.size(), bound.events);
            ASSERT_LE(trace.pairs(), bound.pairs);
            by_events += trace.stopped() && trace.size() == bound.events;
            by_pairs += trace.stopped() && trace.size() < bound.events;
        }
    }
    EXPECT_GT(by_events, 100);
    EXPECT_GT(by_pairs, 50);
}

TEST(Trace, CountsAreKnownAfterAnyEvent) {
    Trace trace;
    TestCounts counts;
    const std::array<MeasuredPair, 3> pairs{};
    for (int step = 0; step < 5000; ++step) {
        ASSERT_EQ(trace.counts(step), counts);
        const TestKind test = step % 7 == 0   ? TestKind::samples
                              : step % 3 == 0 ? TestKind(BoxKind::obb2d)
                                              : TestKind::time;
        if (test == TestKind::samples) {
            trace.push({.parent = step - 1,
                        .test = test,
                        .pairs = std::span(pairs).first(static_cast<std::size_t>(step % 4))});
            counts[test] += step % 4;
        } else {
            trace.push({.parent = step - 1, .test = test});
            ++counts[test];
        }
    }
    EXPECT_EQ(trace.counts(), counts);
    trace.shrink_to_fit();
    EXPECT_LE(trace.bytes(), 5000 * 32 + trace.pairs() * sizeof(MeasuredPair)) << "bytes";
}

TEST(Trace, AHitIsAHitWhoeverListens) {
    // A traversal that goes on after a hit still records it as one.
    const auto clip = std::make_shared<const Clip>(0.1, std::vector<Disk>(4, Disk{0, 0, 1}));
    const Tree tree(clip, {.leaf = 2});
    const PlacedTree a(tree, {}), b(tree, {});
    TraceRecorder recorder;
    int hits = 0;
    auto go_on = [&](int, int) { return ++hits, false; };
    EXPECT_FALSE(visit_hits(a, b, recorder, go_on));
    EXPECT_EQ(hits, 4);
    const Trace trace = recorder.take();
    EXPECT_TRUE(recorder.trace().empty());
    int recorded = 0;
    for (int step = 0; step < trace.size(); ++step) recorded += trace[step].outcome == Outcome::hit;
    EXPECT_EQ(recorded, 2) << "one for each pair of leaves";
}

TEST(Trace, FreeBoxesOfDifferentScalesAreNotTested) {
    std::vector<Disk> walk;
    for (int i = 0; i < 40; ++i) walk.push_back({0.1 * i, 0.001 * i * i, 0.3});
    const auto clip = std::make_shared<const Clip>(0.1, walk);
    const Tree tree_a(clip, {.tree = TreeKind::umobb}), tree_b(clip, {.tree = TreeKind::umobb, .time_scale = 2});
    Statistics statistics;
    EXPECT_TRUE(query(PlacedTree(tree_a, {}), PlacedTree(tree_b, {.translate = {0.5, 0}}), statistics));
    EXPECT_EQ(statistics.tests[mobb::BoxKind::obb3d], 0);
}

TEST(Trace, BoxesWithoutACommonTestAreNotTested) {
    std::vector<Disk> walk;
    for (int i = 0; i < 40; ++i) walk.push_back({0.1 * i, 0.001 * i * i, 0.3});
    const auto clip = std::make_shared<const Clip>(0.1, walk);
    const Tree moving(clip, {.tree = TreeKind::moving}), faster(clip, {.tree = TreeKind::moving, .time_scale = 2});
    const Tree aligned(clip, {.tree = TreeKind::aabb}), mobb(clip, {});
    const auto box_tests = [](const Tree& a, const Tree& b) {
        Statistics statistics;
        EXPECT_FALSE(query(PlacedTree(a, {}), PlacedTree(b, {.translate = {0, 9}}), statistics));
        return statistics.tests.boxes();
    };
    EXPECT_EQ(box_tests(moving, moving), 1);
    EXPECT_EQ(box_tests(aligned, aligned), 1);
    EXPECT_EQ(box_tests(moving, faster), 0);
    EXPECT_EQ(box_tests(moving, mobb), 0);
    EXPECT_EQ(box_tests(mobb, aligned), 0);
}

TEST(Trace, OfTheDirectSearchIsOneEvent) {
    const Clip clip(0.1, {{0, 0, 0.5}, {1, 0, 0.5}, {1.5, 0, 0.5}});
    const PlacedClip a(clip, {}), b(clip, {.translate = {3, 0}, .rotate_deg = 180});
    TraceRecorder recorder;
    const std::optional<Contact> contact = direct_search(a, b, recorder);
    ASSERT_TRUE(contact.has_value());
    EXPECT_EQ(*contact, (Contact{0.2, 2, 2, 0, 1})) << "they touch at sample 1 and meet at sample 2";
    ASSERT_EQ(recorder.trace().size(), 1);
    EXPECT_EQ(recorder.trace()[0].outcome, Outcome::hit);
    EXPECT_EQ(recorder.trace()[0].pairs.size(), 3u);
}

TEST(Trace, PushKeepsThePairsOfEachEventApart) {
    Trace trace;
    const MeasuredPair pairs[] = {{1, 2, 0.5}, {3, 4, 0.25}};
    trace.push({.test = mobb::TestKind::samples, .outcome = Outcome::no_hit, .pairs = std::span(pairs).first(1)});
    trace.push({.parent = 0,
                .depth = 1,
                .a = 5,
                .b = 6,
                .test = mobb::BoxKind::obb3d,
                .outcome = Outcome::separated,
                .axis = 7,
                .gap = 2});
    trace.push({.test = mobb::TestKind::samples, .outcome = Outcome::hit, .pairs = pairs});
    ASSERT_EQ(trace.size(), 3);
    EXPECT_EQ(trace[0].pairs.size(), 1u);
    EXPECT_TRUE(trace[1].pairs.empty());
    EXPECT_EQ(trace[1].axis, 7);
    EXPECT_EQ(trace[1].b, 6);
    ASSERT_EQ(trace[2].pairs.size(), 2u);
    EXPECT_EQ(trace[2].pairs[1].j, 4);
    TestCounts expected;
    expected[BoxKind::obb3d] = 1;
    expected[mobb::TestKind::samples] = 3;
    EXPECT_EQ(trace.counts(), expected);
}

}  // namespace
}  // namespace mobb
