// Certificates prove answers without a tree, and what proves nothing is refused.
#include <explain/axis_intervals.h>
#include <explain/certificate.h>
#include <mobb/query.h>

#include "proven_query.h"

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <numbers>
#include <utility>
#include <vector>

namespace mobbscope {
namespace {

/// Proofs of random answers are taken; there are no more tiles than the trace has separated and measured pairs.
void prove(const std::function<ProvenQuery(mobb::test::Random&)>& make) {
    mobb::test::Random random(35);
    int misses = 0, hits = 0;
    for (int i = 0; i < certificate_budget(); ++i) {
        SCOPED_TRACE(i);
        const ProvenQuery asked = make(random);
        EXPECT_EQ(asked.refused(asked.proof), "");
        EXPECT_EQ(asked.proof.contact, asked.recorded.contact);
        std::size_t ends = 0;
        for (int step = 0; step < asked.recorded.trace.size(); ++step) {
            const mobb::Trace::Event event = asked.recorded.trace[step];
            ends += event.outcome == mobb::Outcome::separated ? 1 : event.pairs.size();
        }
        EXPECT_LE(asked.proof.tiles.size(), ends);
        (asked.recorded.contact ? hits : misses) += 1;
    }
    EXPECT_GT(misses, certificate_budget() / 6);
    EXPECT_GT(hits, certificate_budget() / 20);
}

TEST(Certificate, ProvesAnswersOfAllKinds) { prove(random_proven_query); }

TEST(Certificate, ProvesAnswersOfRealClips) {
    if (real_clips().empty()) GTEST_SKIP() << "no test data at " << MOBBSCOPE_SHARED_DATA;
    prove(random_real_query);
}

/// How far a tile's line, moved as far as it can be, is passed by the disks of its time, metres.
double passed_by(const ProvenQuery& asked, const Tile& tile) {
    const auto reach = [&](const mobb::PlacedClip& clip, double way) {
        double out = -std::numeric_limits<double>::infinity();
        for (int i = 0; i < clip.count(); ++i) {
            const double begin = std::max(clip.time(i), tile.t0), end = std::min(clip.time(i + 1), tile.t1);
            if (begin >= end) continue;
            for (const double t : {begin, end}) {
                const mobb::Disk disk = mobb::swept(clip, i).at(t);
                const double along = tile.direction.x * disk.x + tile.direction.y * disk.y - tile.speed * (t - tile.t0);
                out = std::max(out, way * along + disk.r);
            }
        }
        return out;
    };
    return reach(asked.a().placed_clip(), 1) + reach(asked.b().placed_clip(), -1);
}

TEST(Certificate, WhatIsDamagedIsRefused) {
    mobb::test::Random random(38);
    int removed = 0, widened = 0, moved = 0;
    for (int i = 0; i < certificate_budget(); ++i) {
        SCOPED_TRACE(i);
        const ProvenQuery asked = random_proven_query(random);
        const Certificate& proof = asked.proof;
        if (proof.tiles.empty()) continue;
        const auto at = static_cast<std::size_t>(random.integer(0, static_cast<int>(proof.tiles.size()) - 1));
        const Tile tile = proof.tiles[at];
        // More than rounding and what touching disks are allowed.
        const double far = asked.a().frame().reach + asked.b().frame().reach + 3e4;
        const double tolerance = 4e-9 * std::max(1.0, far / 1e4);
        const auto changed = [&](const std::function<void(Certificate&, Tile&)>& change) {
            Certificate out = proof;
            change(out, out.tiles[at]);
            return asked.refused(out);
        };
        if (tile.t1 - tile.t0 > 1e-5) {
            ++removed;
            const auto place = static_cast<std::ptrdiff_t>(at);
            EXPECT_NE(changed([&](Certificate& c, Tile&) { c.tiles.erase(c.tiles.begin() + place); }), "");
        }
        if (at + 1 < proof.tiles.size()) {
            Tile wide = tile;
            wide.t1 = proof.tiles[at + 1].t1;
            wide.gap = 0;
            if (passed_by(asked, wide) > tolerance) {
                ++widened;
                EXPECT_NE(changed([&](Certificate& c, Tile& t) {
                              t = wide;
                              c.tiles.erase(c.tiles.begin() + static_cast<std::ptrdiff_t>(at) + 1);
                          }),
                          "");
            }
        }
        // B nearer by less than the gap, and by more. A gap that is not stated is not asked for.
        if (tile.gap > tolerance && !proof.contact) {
            ++moved;
            Certificate line{std::nullopt, proof.tiles};
            for (Tile& each : line.tiles) each.gap = 0;
            const double least = std::ranges::min(proof.tiles, {}, &Tile::gap).gap;
            const auto refused = [&](double nearer) {
                mobb::Placement place = asked.b().placed_clip().placement();
                place.translate -= nearer * tile.direction;
                return why_not_proven(asked.a().placed_clip(), {asked.b().tree().clip(), place}, line);
            };
            EXPECT_EQ(refused(std::max(0.9 * least, 0.0)), "");
            EXPECT_NE(refused(tile.gap + tolerance), "");
        }
        EXPECT_NE(changed([&](Certificate&, Tile& t) { t.gap += tolerance; }), "");
        EXPECT_EQ(changed([&](Certificate&, Tile& t) { t.gap -= 0.5 * std::max(t.gap, 0.0); }), "");
        EXPECT_NE(changed([&](Certificate&, Tile& t) { t.direction *= 1 + 4e-15; }), "") << "unit means to 1e-15";
        EXPECT_NE(changed([&](Certificate&, Tile& t) { t.t0 = t.t1; }), "");
        const double nan = std::numeric_limits<double>::quiet_NaN();
        for (double Tile::*number : {&Tile::t0, &Tile::t1, &Tile::speed, &Tile::gap})
            EXPECT_NE(changed([&](Certificate&, Tile& t) { t.*number = nan; }), "");
        if (at > 0) {
            EXPECT_NE(changed([&](Certificate& c, Tile& t) { std::swap(c.tiles[at - 1], t); }), "");
        }
        if (proof.contact) {
            EXPECT_NE(changed([&](Certificate& c, Tile&) { c.contact->time += 1e-3; }), "");
            EXPECT_NE(changed([&](Certificate& c, Tile&) { c.contact->distance += 1e-3; }), "");
            EXPECT_NE(changed([&](Certificate& c, Tile&) { c.contact->a_sample = 100'000; }), "");
            EXPECT_NE(changed([&](Certificate& c, Tile&) { c.contact.reset(); }), "");
        }
    }
    EXPECT_GT(removed, 50);
    EXPECT_GT(widened, 10);
    EXPECT_GT(moved, 50);
}

/// A proof of two clips is taken and has so many tiles.
void expect_proven(const mobb::ClipPtr& a, const mobb::ClipPtr& b, const mobb::Placement& place_a,
                   const mobb::Placement& place_b, bool collide, std::size_t tiles) {
    for (const mobb::TreeKind tree : mobb::kTreeKinds) {
        SCOPED_TRACE(mobb::name(tree));
        const ProvenQuery asked(two_agents(a, b, place_a, place_b), {.tree = tree, .leaf = 2});
        EXPECT_EQ(asked.refused(asked.proof), "");
        EXPECT_EQ(asked.proof.contact.has_value(), collide);
        EXPECT_EQ(asked.proof.tiles.size(), tiles);
    }
}

mobb::ClipPtr clip(double dt, std::vector<mobb::Disk> disks, mobb::Motion motion = mobb::Motion::held) {
    return std::make_shared<const mobb::Clip>(dt, std::move(disks), motion);
}

TEST(Certificate, OfTouchingPairs) {
    const mobb::ClipPtr one = clip(1, {{0, 0, 0.5}}), two = clip(1, {{1, 0, 0.5}});
    expect_proven(one, two, {}, {}, false, 1);
    expect_proven(one, two, {}, {{-1e-6, 0}, 0, 0}, true, 0);
    // Everywhere at one angle to each other, far away too.
    for (const double angle : {0.0, 30.0, 77.7})
        expect_proven(one, one, {{1e4, 1e4}, 0, 0},
                      {{1e4 + 1.0000000001 * std::cos(angle), 1e4 + 1.0000000001 * std::sin(angle)}, 0, 0}, false, 1);
    // Points that pass through one another never overlap.
    const mobb::ClipPtr point = clip(1, {{-1, 0, 0}, {1, 0, 0}}, mobb::Motion::linear);
    expect_proven(point, point, {}, {{0, 0}, 90, 0}, false, 1);
}

TEST(Certificate, OfOneSampleAndOfDifferentDt) {
    const mobb::ClipPtr stays = clip(2, {{0, 0, 0.5}}),
                        passes = clip(0.3, {{-3, 1.5, 0.5}, {0, 1.5, 0.5}, {3, 1.5, 0.5}});
    expect_proven(stays, passes, {}, {}, false, 1);
    expect_proven(stays, passes, {}, {{0, -1}, 0, 0}, true, 1);
    expect_proven(stays, stays, {}, {{5, 0}, 0, 2}, false, 0);
}

TEST(Certificate, OfStartsAtUnixTime) {
    std::vector<mobb::Disk> disks;
    for (int i = 0; i < 50; ++i) disks.push_back({0.05 * i, 0, 0.3});
    for (const mobb::Motion motion : {mobb::Motion::held, mobb::Motion::linear}) {
        const mobb::ClipPtr walk = clip(1.0 / 30, disks, motion);
        expect_proven(walk, walk, {{0, 0}, 0, 1.7e9}, {{0, 0.7}, 10, 1.7e9 + 0.4}, false, 1);
        expect_proven(walk, walk, {{0, 0}, 0, 1.7e9}, {{2.4, 0.1}, 180, 1.7e9 + 0.01}, true, 1);
        expect_proven(walk, walk, {{0, 0}, 0, 1.7e9}, {{0, 0.7}, 10, 1.7e9 + 500}, false, 0);
    }
}

TEST(Certificate, WalkersWhoPassEachOtherNeedALineThatMoves) {
    // Side by side at one speed, A behind: no fixed line is between them, and one that moves is.
    std::vector<mobb::Disk> disks;
    for (int i = 0; i < 100; ++i) disks.push_back({0.1 * i, 0, 0.3});
    const mobb::ClipPtr walk = clip(0.1, disks, mobb::Motion::linear);
    const ProvenQuery asked(two_agents(walk, walk, {}, {{0.7, 0}, 0, 0}), {});
    ASSERT_EQ(asked.proof.tiles.size(), 1u);
    EXPECT_NEAR(asked.proof.tiles[0].speed, 1, 0.05);
    EXPECT_GT(asked.proof.tiles[0].gap, 0.09);
    EXPECT_EQ(asked.refused(asked.proof), "");
}

TEST(Certificate, LinesAreSpreadSoThatTheLeastGapIsWide) {
    // One stands, the other walks three quarters of a circle around: four fixed lines are needed, and each is best
    // where it has a fourth of the way.
    constexpr double kAround = 1.5, kRadius = 0.5, kTurn = 300 * std::numbers::pi / 180;
    constexpr int kSteps = 300;
    std::vector<mobb::Disk> disks;
    for (int i = 0; i <= kSteps; ++i) {
        const double angle = kTurn * i / kSteps;
        disks.push_back({kAround * std::cos(angle), kAround * std::sin(angle), kRadius});
    }
    const ProvenQuery asked(two_agents(clip(kSteps, {{0, 0, kRadius}}), clip(1, disks, mobb::Motion::linear), {}, {}),
                            {});
    EXPECT_EQ(asked.refused(asked.proof), "");
    ASSERT_EQ(asked.proof.tiles.size(), 4u);
    const double best = kAround * std::cos(kTurn / 8) - 2 * kRadius;
    EXPECT_GT(std::ranges::min(asked.proof.tiles, {}, &Tile::gap).gap, 0.85 * best);
}

TEST(Certificate, AxesOfSeparatedBoxesAreNeverAlongTime) {
    // Boxes that share time overlap along it. So an axis that separates them crosses the floor.
    mobb::test::Random random(39);
    int boxes = 0;
    for (int i = 0; i < 5 * certificate_budget(); ++i) {
        const mobb::ClipPtr a = mobb::test::random_clip(random, 200), b = mobb::test::random_partner(random, *a, 200);
        mobb::Placement place_a, place_b;
        mobb::test::random_placements(random, *a, *b, place_a, place_b);
        mobb::FitOptions fit = mobb::test::random_fit(random);
        fit.tree = random.chance(0.5) ? mobb::TreeKind::umobb : mobb::TreeKind::hybrid2;
        const ProvenQuery asked(two_agents(a, b, place_a, place_b), fit);
        for (int step = 0; step < asked.recorded.trace.size(); ++step) {
            const mobb::Trace::Event event = asked.recorded.trace[step];
            if (event.outcome != mobb::Outcome::separated) continue;
            ++boxes;
            EXPECT_GT(glm::length(glm::dvec2(separating_axis(asked.a(), asked.b(), event))), 1e-6);
        }
    }
    EXPECT_GT(boxes, 2 * certificate_budget());
}

}  // namespace
}  // namespace mobbscope
