// Crowds at four densities: conflicts, encounters and parts against an exact search that is written here, in long
// double over every pair of samples.
#include <mobb_tracks/crowds.h>
#include <mobb_tracks/parts.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <tuple>
#include <utility>
#include <vector>

namespace mobb::test {
namespace {

using Exact = long double;

struct ExactSpan {
    Exact begin, end;
};

/// When two are closer than `within`: the roots of |d| = r + within over each pair of samples that share time.
std::vector<ExactSpan> exact_spans(const PlacedClip& a, const PlacedClip& b, double within) {
    std::vector<ExactSpan> out;
    for (int i = 0; i < a.clip().steps(); ++i) {
        for (int j = 0; j < b.clip().steps(); ++j) {
            const Exact from = std::max(a.time(i), b.time(j)), to = std::min(a.time(i + 1), b.time(j + 1));
            if (to - from <= 1e-9L) continue;
            const auto at = [](const PlacedClip& clip, int sample, Exact t) {
                const Disk p = clip.disk(sample), q = clip.disk_at_end(sample);
                const Exact begin = clip.time(sample), s = (t - begin) / (clip.time(sample + 1) - begin);
                return std::array<Exact, 3>{p.x + s * (q.x - p.x), p.y + s * (q.y - p.y), p.r + s * (q.r - p.r)};
            };
            const auto a0 = at(a, i, from), a1 = at(a, i, to), b0 = at(b, j, from), b1 = at(b, j, to);
            const Exact x = a0[0] - b0[0], y = a0[1] - b0[1], r = a0[2] + b0[2] + within;
            const Exact vx = a1[0] - b1[0] - x, vy = a1[1] - b1[1] - y, vr = a1[2] + b1[2] + within - r;
            const Exact square = vx * vx + vy * vy - vr * vr, half = x * vx + y * vy - r * vr;
            const Exact still = x * x + y * y - r * r, root = half * half - square * still;
            Exact s0 = 0, s1 = still < 0 ? 1 : 0;
            if (square > 0) {
                s1 = root > 0 ? std::min<Exact>(1, (-half + std::sqrt(root)) / square) : 0;
                s0 = root > 0 ? std::max<Exact>(0, (-half - std::sqrt(root)) / square) : 0;
            }
            if (s0 < s1) out.push_back({from + s0 * (to - from), from + s1 * (to - from)});
        }
    }
    std::ranges::sort(out, {}, &ExactSpan::begin);
    std::vector<ExactSpan> joined;
    for (const ExactSpan& span : out) {
        if (!joined.empty() && span.begin - joined.back().end <= 1.5e-9L) {
            joined.back().end = std::max(joined.back().end, span.end);
        } else {
            joined.push_back(span);
        }
    }
    return joined;
}

struct Kind {
    bool linear, mixed, one_dt, aligned;
};

/// People who wander for a while on `density` square metres each.
Crowd wanderers(Random& random, int people, double density, const Kind& kind) {
    Crowd crowd;
    const double side = std::sqrt(people / density);
    for (int i = 0; i < people; ++i) {
        const double dt = kind.one_dt ? 0.4 : random.real(0.1, 0.6);
        double x = random.real(0, side), y = random.real(0, side), heading = random.real(0, 7);
        std::vector<Disk> samples;
        const double radius = random.real(0.15, 0.3);
        for (int k = random.integer(1, 20); k > 0; --k) {
            samples.push_back({x, y, radius});
            heading += random.real(-0.4, 0.4);
            x += 1.3 * dt * std::cos(heading), y += 1.3 * dt * std::sin(heading);
        }
        const Motion motion = kind.mixed ? (random.chance(0.5) ? Motion::linear : Motion::held)
                                         : (kind.linear ? Motion::linear : Motion::held);
        const double start = kind.aligned ? 0.4 * random.integer(0, 10) : random.real(0, 4);
        crowd.add(std::make_shared<const Clip>(dt, std::move(samples), motion), {{0, 0}, 0, start});
    }
    return crowd;
}

constexpr double kDensities[] = {0.05, 0.5, 2, 10};  // people per square metre
constexpr Kind kKinds[] = {{true, false, true, true},  {true, false, true, false},   {true, false, false, false},
                           {false, false, true, true}, {false, false, false, false}, {true, true, false, false}};

/// Every second one of `kinds` and densities comes with each distance.
template <class Test>
void for_crowds(const Test& test) {
    Random random(5);
    for (const double density : kDensities) {
        for (const Kind& kind : kKinds) {
            for (const double within : {0.0, 0.7}) {
                const Crowd crowd = wanderers(random, 60, density, kind);
                test(crowd, within);
            }
        }
    }
}

TEST(DenseCrowds, AreAsAnExactSearchHasThem) {
    std::size_t found = 0;
    for_crowds([&](const Crowd& crowd, double within) {
        std::map<std::pair<int, int>, std::vector<ExactSpan>> expected;
        for (int a = 0; a < 60; ++a) {
            for (int b = a + 1; b < 60; ++b) {
                std::vector<ExactSpan> spans = exact_spans(crowd.clip(a), crowd.clip(b), within);
                if (!spans.empty()) expected[{a, b}] = std::move(spans);
            }
        }
        ConflictSearch search;
        search.within = within;
        const std::vector<PeopleConflict> conflicts = all_of(crowd.conflicts(search));
        ASSERT_EQ(conflicts.size(), expected.size());
        for (const PeopleConflict& conflict : conflicts) {
            const auto& spans = expected.at({conflict.a, conflict.b});
            ASSERT_EQ(conflict.intervals.size(), spans.size());
            for (std::size_t i = 0; i < spans.size(); ++i) {
                EXPECT_NEAR(conflict.intervals[i].t0, static_cast<double>(spans[i].begin), 1e-7);
                EXPECT_NEAR(conflict.intervals[i].t1, static_cast<double>(spans[i].end), 1e-7);
            }
            EXPECT_LT(conflict.deepest.least_clearance, within);
        }
        found += conflicts.size();
    });
    EXPECT_GT(found, 5000u);
}

void expect_equal(const PeopleConflict& a, const PeopleConflict& b) {
    EXPECT_EQ(std::pair(a.a, a.b), std::pair(b.a, b.b));
    EXPECT_EQ(a.intervals, b.intervals);
    EXPECT_EQ(a.deepest.least_clearance, b.deepest.least_clearance);
    EXPECT_EQ(a.deepest.time, b.deepest.time);
}

TEST(DenseCrowds, HaveTheSameInPartsAndByTheDirectSearch) {
    for_crowds([&](const Crowd& crowd, double within) {
        ConflictSearch search;
        search.within = within;
        search.least_seconds = 0.3;
        const PeopleConflicts whole = crowd.conflicts(search);
        search.direct = true;
        const PeopleConflicts direct = crowd.conflicts(search);
        ASSERT_EQ(whole.size(), direct.size());
        for (std::size_t i = 0; i < whole.size(); ++i) expect_equal(whole[i], direct[i]);
        search.direct = false;
        for (const int parts : {1, 2, 3, 4, 12}) {
            std::vector<PeopleConflict> of_parts;
            std::size_t tested = 0;
            for (int part = 0; part < parts; ++part) {
                search.region = region_of_part(crowd.clips(), part, parts);
                const PeopleConflicts found = crowd.conflicts(search);
                tested += found.pairs_tested();
                for (PeopleConflict& conflict : all_of(found)) of_parts.push_back(std::move(conflict));
            }
            EXPECT_EQ(tested, whole.pairs_tested());
            ASSERT_EQ(of_parts.size(), whole.size());
            std::ranges::sort(of_parts, {}, [](const PeopleConflict& of) {
                return std::tuple(of.deepest.least_clearance, -of.seconds(), of.worst().t0, of.a, of.b);
            });
            for (std::size_t i = 0; i < whole.size(); ++i) expect_equal(whole[i], of_parts[i]);
        }
    });
}

TEST(DenseCrowds, HaveWhoIsFarWiderThanOthers) {
    Random random(9);
    Crowd crowd;
    for (int i = 0; i < 200; ++i) {
        const double radius = random.chance(0.1) ? random.real(5, 500) : random.real(0.1, 0.3);
        const Disk disk{random.real(-300, 300), random.real(-300, 300), radius};
        const double step = random.chance(0.1) ? 400 : 1;
        crowd.add(
            std::make_shared<const Clip>(0.4, std::vector<Disk>{disk, {disk.x + step, disk.y, radius}}, Motion::linear),
            {{0, 0}, 0, random.real(0, 1)});
    }
    ConflictSearch direct;
    direct.direct = true;
    const PeopleConflicts sweep = crowd.conflicts(), expected = crowd.conflicts(direct);
    ASSERT_EQ(sweep.size(), expected.size());
    EXPECT_GT(sweep.size(), 100u);
    for (std::size_t i = 0; i < sweep.size(); ++i) expect_equal(sweep[i], expected[i]);
}

}  // namespace
}  // namespace mobb::test
