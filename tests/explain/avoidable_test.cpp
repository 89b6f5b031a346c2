// Overlaps that a tighter box would have avoided: lines against a dense search, blame against boxes that are made.
#include <explain/avoidable.h>
#include <explain/separating_line.h>
#include <gtest/gtest.h>
#include <mobb/query.h>
#include <scene/drawn_agent.h>

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <set>
#include <string>

#include "explain/random_query.h"

namespace mobbscope {
namespace {

using mobb::Outcome;
using mobb::PlacedTree;
using mobb::Trace;
using mobb::test::Random;

bool is_overlap(const Trace::Event& event) { return event.test.is_box() && event.outcome == Outcome::overlap; }

mobb::Interval common_time(const PlacedTree& a, const PlacedTree& b, const Trace::Event& event) {
    return {std::max(a.begin(a.node(event.a)), b.begin(b.node(event.b))),
            std::min(a.end(a.node(event.a)), b.end(b.node(event.b)))};
}

/// The pairs of samples that share some of a time.
std::vector<SharedTime> within(const Pieces& all, mobb::Interval time) {
    std::vector<SharedTime> out;
    for (const SharedTime& piece : all.pieces) {
        if (piece.t0 >= time.t0 - 1e-12 && piece.t1 <= time.t1 + 1e-12) out.push_back(piece);
    }
    return out;
}

/// The widest gap that a line of one of many directions leaves.
double widest(const std::vector<SharedTime>& pieces, double slack) {
    constexpr int kDirections = 180;
    double best = -std::numeric_limits<double>::infinity();
    for (int i = 0; i < kDirections; ++i) {
        const double angle = 2 * std::numbers::pi * i / kDirections;
        const Sweep sweep(pieces, {std::cos(angle), std::sin(angle)}, slack);
        if (sweep.moving(0) < pieces.size()) continue;
        best = std::max(best, sweep.tile(0, pieces.size(), false).gap);
    }
    return best;
}

/// How far disks pass a line.
double excess(const std::vector<SharedTime>& pieces, const Tile& line) {
    double a = -std::numeric_limits<double>::infinity(), b = a;
    for (const SharedTime& piece : pieces) {
        for (std::size_t end : {0u, 1u}) {
            const double moved = line.speed * ((end == 0 ? piece.t0 : piece.t1) - line.t0);
            a = std::max(a, glm::dot(line.direction, center(piece.a[end])) + piece.a[end].r - moved);
            b = std::max(b, moved - glm::dot(line.direction, center(piece.b[end])) + piece.b[end].r);
        }
    }
    return a + b + line.gap;
}

/// A point of a node's disks or of a box: a moment, and how far it reaches along a direction then.
struct Seen {
    double t, y;
};

/// How far both ends of the samples reach.
std::vector<Seen> disks_along(const PlacedTree& tree, int node, glm::dvec2 u, double way) {
    const mobb::PlacedClip& clip = tree.placed_clip();
    std::vector<Seen> out;
    for (int i = tree.node(node).first; i < tree.node(node).end(); ++i) {
        const mobb::SweptDisk swept = mobb::swept(clip, i);
        out.push_back({swept.begin, glm::dot(u, center(swept.from)) + way * swept.from.r});
        out.push_back({swept.end, glm::dot(u, center(swept.to)) + way * swept.to.r});
    }
    return out;
}

std::vector<Seen> box_along(const PlacedTree& tree, int node, glm::dvec2 u, mobb::Interval common) {
    const mobb::Box box = world_box(tree, node);
    const double w = tree.time_scale();
    std::vector<Seen> out;
    for (glm::dvec3 corner : mobb::corners(box)) {
        if (mobb::info(box.kind).moves && box.half.z > 0) {
            const double t = corner.z > box.center.z ? common.t1 : common.t0;
            const double from = corner.z > box.center.z ? 1 : -1;
            const glm::dvec2 moved = box.drift * ((w * t - box.center.z) / box.half.z - from);
            corner = {corner.x + moved.x, corner.y + moved.y, w * t};
        }
        out.push_back({corner.z / w, glm::dot(u, glm::dvec2(corner))});
    }
    return out;
}

/// The widest gap of a line that crosses a direction, fixed or of any speed.
double gap_between(const std::vector<Seen>& a, const std::vector<Seen>& b, bool moves) {
    const auto gap_at = [&](double speed) {
        double most = -std::numeric_limits<double>::infinity(), least = -most;
        for (const Seen& p : a) most = std::max(most, p.y - speed * (p.t - a[0].t));
        for (const Seen& p : b) least = std::min(least, p.y - speed * (p.t - a[0].t));
        return least - most;
    };
    if (!moves) return gap_at(0);
    double from = -1e3, to = 1e3;
    for (int i = 0; i < 45; ++i) {
        const double low = from + (to - from) / 3, high = to - (to - from) / 3;
        gap_at(low) < gap_at(high) ? from = low : to = high;
    }
    return gap_at(from);
}

enum class Side { a, b, both };

/// The widest gap that another box of A in its place leaves, or of B, or both; by many directions.
double gap_if_tighter(const PlacedTree& a, const PlacedTree& b, const Trace::Event& event, Side side) {
    const mobb::Interval common = common_time(a, b, event);
    const mobb::BoxInfo& box_a = mobb::info(a.node(event.a).kind);
    const mobb::BoxInfo& box_b = mobb::info(b.node(event.b).kind);
    if (box_a.round || box_b.round) return -1;
    const bool world = box_a.axes == mobb::BoxAxes::world;
    const bool upright = (side != Side::b && box_a.is_upright()) || (side != Side::a && box_b.is_upright());
    const int directions = world ? 4 : 72;
    double best = -std::numeric_limits<double>::infinity();
    for (int i = 0; i < directions; ++i) {
        const double angle = 2 * std::numbers::pi * i / directions;
        const glm::dvec2 u(std::cos(angle), std::sin(angle));
        const auto of_a = side == Side::b ? box_along(a, event.a, u, common) : disks_along(a, event.a, u, 1);
        const auto of_b = side == Side::a ? box_along(b, event.b, u, common) : disks_along(b, event.b, u, -1);
        best = std::max(best, gap_between(of_a, of_b, !upright));
    }
    return best;
}

TEST(Avoidable, IsWhatADenseSearchOfLinesFinds) {
    Random random(35);
    int avoidable = 0, others = 0;
    for (int round = 0; round < 400; ++round) {
        SCOPED_TRACE(round);
        const RandomQuery asked = random_query(random, 120);
        const PlacedTree a = asked.a(), b = asked.b();
        const AvoidableOverlaps judged = avoidable_overlaps(asked.trace, a, b);
        EXPECT_TRUE(judged.all_judged());
        const Pieces all = pieces_before(a.placed_clip(), b.placed_clip(), std::numeric_limits<double>::infinity());
        for (int event = 0; event < asked.trace.size(); ++event) {
            const AvoidableOverlap* found = judged.at(event);
            if (!is_overlap(asked.trace[event])) {
                EXPECT_EQ(found, nullptr);
                continue;
            }
            const auto pieces = within(all, common_time(a, b, asked.trace[event]));
            if (pieces.empty()) continue;
            const double gap = widest(pieces, 0);
            if (found) {
                EXPECT_LE(excess(pieces, found->line), 4 * all.slack) << event;
                EXPECT_GT(found->line.gap, 0);
                EXPECT_GE(found->line.gap, 0.97 * gap) << event << ": about the widest";
                ++avoidable;
            } else {
                EXPECT_LE(gap, 8 * all.slack) << event;
                ++others;
            }
        }
    }
    EXPECT_GT(avoidable, 100);
    EXPECT_GT(others, 100);
}

TEST(Avoidable, BlamesTheBoxInWhosePlaceATighterOneWouldHaveCut) {
    Random random(36);
    std::map<Blame, int> seen;
    std::set<std::size_t> tests;
    for (int round = 0; round < 400; ++round) {
        SCOPED_TRACE(round);
        const RandomQuery asked = random_query(random, 100);
        const PlacedTree a = asked.a(), b = asked.b();
        const AvoidableOverlaps judged = avoidable_overlaps(asked.trace, a, b);
        for (std::size_t i = 0; i < judged.events.size(); ++i) {
            const Trace::Event event = asked.trace[judged.events[i]];
            const double of_a = gap_if_tighter(a, b, event, Side::a), of_b = gap_if_tighter(a, b, event, Side::b);
            const double of_both = gap_if_tighter(a, b, event, Side::both);
            constexpr double kNone = 1e-6;  // a narrow one may lie between the directions that are tried
            const Blame blame = judged.found[i].blame;
            if (of_a > kNone && of_b > kNone) {
                EXPECT_TRUE(blame == Blame::a || blame == Blame::b) << judged.events[i];
                const int level_a = a.tree().level(event.a), level_b = b.tree().level(event.b);
                if (level_a != level_b) {
                    EXPECT_EQ(blame, level_a > level_b ? Blame::a : Blame::b);
                }
                if (level_a == level_b && of_a > 1.1 * of_b) {
                    EXPECT_EQ(blame, Blame::a);
                }
                if (level_a == level_b && of_b > 1.1 * of_a) {
                    EXPECT_EQ(blame, Blame::b);
                }
            } else if (of_a > kNone || of_b > kNone) {
                EXPECT_TRUE(blames(blame, of_a > kNone ? 0 : 1) || of_a > -kNone || of_b > -kNone) << judged.events[i];
                EXPECT_NE(blame, Blame::none);
            } else if (of_both > kNone) {
                EXPECT_NE(blame, Blame::none) << judged.events[i];
            }
            if (blame == Blame::a) {
                EXPECT_GT(of_a, -0.1);
            }
            if (blame == Blame::b) {
                EXPECT_GT(of_b, -0.1);
            }
            if (blame == Blame::both) {
                EXPECT_GT(of_both, -0.1);
            }
            ++seen[blame];
            tests.insert(event.test.index());
        }
    }
    EXPECT_GT(seen[Blame::a], 10);
    EXPECT_GT(seen[Blame::b], 10);
    EXPECT_GT(seen[Blame::none], 10);
    EXPECT_GT(seen[Blame::both], 5);
    EXPECT_GE(tests.size(), 4u);
}

/// A walk from a place at a velocity, 10 s long.
mobb::ClipPtr walk(glm::dvec2 from, glm::dvec2 velocity) {
    std::vector<mobb::Disk> samples;
    for (int i = 0; i < 100; ++i)
        samples.push_back({from.x + 0.1 * i * velocity.x, from.y + 0.1 * i * velocity.y, 0.4});
    return std::make_shared<const mobb::Clip>(0.1, std::move(samples));
}

struct Walks {
    Walks(mobb::TreeKind kind, const mobb::ClipPtr& of_a, const mobb::ClipPtr& of_b, double start_b = 0)
        : tree_a(of_a, {.tree = kind}), tree_b(of_b, {.tree = kind}), a(tree_a, {}), b(tree_b, {{}, 0, start_b}) {
        mobb::TraceRecorder recorder;
        static_cast<void>(mobb::query(a, b, recorder));
        trace = recorder.take();
        judged = avoidable_overlaps(trace, a, b);
    }

    mobb::Tree tree_a, tree_b;
    PlacedTree a, b;
    Trace trace;
    AvoidableOverlaps judged;
};

TEST(Avoidable, WalksSideBySideOverlapInBoxesAlongTheAxesThoughALineKeepsThemApart) {
    const mobb::ClipPtr a = walk({0, 0}, {1, 1}), b = walk({2, -2}, {1, 1});
    const Walks aabb(mobb::TreeKind::aabb, a, b);
    ASSERT_FALSE(aabb.judged.events.empty());
    EXPECT_EQ(aabb.judged.events[0], 1) << "the roots' boxes";
    EXPECT_EQ(aabb.judged.events.size(), static_cast<std::size_t>(aabb.judged.overlaps)) << "all of them";
    const AvoidableOverlap& root = aabb.judged.found[0];
    EXPECT_NEAR(root.line.gap, 2 * std::sqrt(2) - 0.8, 1e-3);
    EXPECT_NEAR(glm::dot(root.line.direction, glm::dvec2(std::sqrt(0.5), -std::sqrt(0.5))), 1, 1e-3);
    EXPECT_EQ(root.line.t0, 0);
    EXPECT_NEAR(root.line.t1, 10, 1e-9);
    EXPECT_EQ(root.blame, Blame::none) << "boxes along the axes cannot turn";
    const Walks mobb(mobb::TreeKind::mobb, a, b);
    EXPECT_EQ(mobb.judged.overlaps, 0);
}

TEST(Avoidable, WhoCrossAtAnotherTimeAreKeptApartByALineThatMoves) {
    const Walks upright(mobb::TreeKind::mobb, walk({-5, 0}, {1, 0}), walk({0, -8}, {0, 1}));
    ASSERT_FALSE(upright.judged.events.empty());
    EXPECT_EQ(upright.judged.events[0], 1);
    EXPECT_NE(upright.judged.found[0].line.speed, 0);
    EXPECT_EQ(upright.judged.found[0].blame, Blame::none) << "their paths cross, and upright boxes hold all of them";
    const Walks moving(mobb::TreeKind::moving, walk({-5, 0}, {1, 0}), walk({0, -8}, {0, 1}));
    ASSERT_FALSE(moving.judged.events.empty()) << "along and across their ways they pass each other";
    EXPECT_NE(moving.judged.found[0].blame, Blame::none) << "of boxes that move, one that is turned would have done";
}

TEST(Avoidable, NoneLeadsToAHit) {
    Random random(37);
    int above = 0;
    for (int round = 0; round < 100; ++round) {
        const RandomQuery asked = random_query(random, 200);
        for (int event = 0; event < asked.trace.size(); ++event) {
            if (asked.trace[event].outcome != Outcome::hit) continue;
            for (int i = asked.trace[event].parent; i >= 0; i = asked.trace[i].parent) {
                EXPECT_FALSE(avoidable_overlap(asked.a(), asked.b(), asked.trace[i])) << round << ' ' << i;
                ++above;
            }
        }
    }
    EXPECT_GT(above, 50);
}

TEST(Avoidable, FarFromTheOriginIsTheSame) {
    const auto at = [](glm::dvec2 place, double start) {
        const mobb::ClipPtr a = walk({0, 0}, {1, 1}), b = walk({2, -2}, {1, 1});
        const mobb::Tree tree_a(a, {.tree = mobb::TreeKind::aabb}), tree_b(b, {.tree = mobb::TreeKind::aabb});
        const PlacedTree placed_a(tree_a, {place, 0, start}), placed_b(tree_b, {place, 0, start});
        mobb::TraceRecorder recorder;
        static_cast<void>(mobb::query(placed_a, placed_b, recorder));
        return avoidable_overlaps(recorder.trace(), placed_a, placed_b);
    };
    const AvoidableOverlaps near = at({0, 0}, 0), far = at({1e6, -2e6}, 1.7e9);
    ASSERT_EQ(near.events, far.events);
    for (std::size_t i = 0; i < near.found.size(); ++i)
        EXPECT_NEAR(near.found[i].line.gap, far.found[i].line.gap, 1e-5) << i;
}

TEST(Avoidable, SaysHowManyWereJudgedWhereTheWorkEnds) {
    const mobb::ClipPtr a = walk({0, 0}, {1, 1}), b = walk({2, -2}, {1, 1});
    const Walks all(mobb::TreeKind::aabb, a, b);
    const AvoidableOverlaps some = avoidable_overlaps(all.trace, all.a, all.b, 100);
    EXPECT_EQ(some.overlaps, all.judged.overlaps);
    EXPECT_GT(some.judged, 0);
    EXPECT_LT(some.judged, some.overlaps);
    EXPECT_FALSE(some.all_judged());
    EXPECT_LE(some.events.size(), static_cast<std::size_t>(some.judged));
    EXPECT_EQ(some.before(all.trace.size()), static_cast<std::int64_t>(some.events.size()));
    EXPECT_EQ(some.before(some.events[0]), 0);
}

TEST(Avoidable, NodesAreBlamedForWhatAllQueriesFind) {
    Random random(38);
    Scene scene;
    scene.clips = {{"a", {}, {}, mobb::test::random_clip(random, 300)}};
    scene.clips.push_back({"b", {}, {}, mobb::test::random_partner(random, *scene.clips[0].clip, 300)});
    for (int i = 0; i < 8; ++i)
        scene.agents.push_back({"agent " + std::to_string(i), i % 2, {{0.7 * i, 0.3 * i}, 40.0 * i, 0}, {}});
    const FittedScene fitted(scene, {});
    std::size_t told = 0;
    const BlameInScene blame = blame_in(fitted, [&](std::size_t done, std::size_t all) {
        EXPECT_EQ(all, fitted.queries().size());
        told = done;
    });
    EXPECT_EQ(told, fitted.queries().size());
    std::int64_t overlaps = 0, shares = 0, by_node = 0;
    for (std::size_t i = 0; i < fitted.queries().size(); ++i) {
        const SceneQuery query = fitted.queries()[i];
        const RecordedQuery recorded = record(fitted, query);
        const AvoidableOverlaps judged =
            avoidable_overlaps(recorded.trace, fitted.placed(query.a), fitted.placed(query.b));
        overlaps += static_cast<std::int64_t>(judged.events.size());
        for (const AvoidableOverlap& overlap : judged.found) {
            for (const int side : {0, 1}) shares += blames(overlap.blame, side);
        }
    }
    for (int clip = 0; clip < 2; ++clip) {
        for (int node = 0; node < static_cast<int>(fitted.tree(clip).nodes().size()); ++node)
            by_node += blame.of(clip, node);
    }
    EXPECT_EQ(blame.overlaps, overlaps);
    EXPECT_EQ(by_node, shares);
    EXPECT_GT(by_node, 0);
}

}  // namespace
}  // namespace mobbscope
