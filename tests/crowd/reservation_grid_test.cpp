// The grid's blockers are those of the direct search over all that is reserved.
#include "walker_moves.h"

#include <base/random.h>
#include <crowd/simulation/reservation_grid.h>

#include <gtest/gtest.h>

#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <tuple>
#include <vector>

namespace mobbscope {
namespace {

class WorldTest : public ::testing::Test {
  protected:
    const FittedScene fitted{walker_scene(), {}};
    const MoveSet moves{fitted};
    CounterRandom random{1, 2, 3};

    /// Some lie over the edge of a floor of `area`.
    PlayedMove random_motion(int agent, int play, glm::dvec2 area, double seconds, double begin = 0) {
        const int move = static_cast<int>(random.below(static_cast<std::uint32_t>(moves.count())));
        const glm::dvec2 at{1.2 * area.x * (random.unit() - 0.5), 1.2 * area.y * (random.unit() - 0.5)};
        const mobb::Placement placement{at, 360 * random.unit(), begin + seconds * random.unit()};
        return moves.motion(agent, play, move, placement);
    }

    static std::vector<const PlayedMove*> pointers(const std::vector<PlayedMove>& motions) {
        std::vector<const PlayedMove*> out;
        for (const PlayedMove& motion : motions) out.push_back(&motion);
        return out;
    }

    /// What a candidate is asked against and found to collide with, looked up for it alone.
    static std::optional<Blocker> blocker(const ReservationGrid& reservations, const PlayedMove& candidate) {
        return reservations.around(candidate).blocker(candidate);
    }

    /// Of the motions that have begun by the earliest contact, those whose bounds and times meet the candidate's.
    static int asked_of(const PlayedMove& candidate, const std::vector<PlayedMove>& reserved,
                        const std::optional<Blocker>& blocker) {
        return static_cast<int>(std::ranges::count_if(reserved, [&](const PlayedMove& other) {
            return other.agent != candidate.agent && other.bounds.meets(candidate.bounds) &&
                   mobb::overlap_in_time(candidate.begin(), candidate.end(), other.begin(), other.end()) &&
                   (!blocker || other.begin() <= blocker->contact.time);
        }));
    }

    static std::optional<Blocker> direct(const PlayedMove& candidate, const std::vector<PlayedMove>& reserved) {
        std::optional<Blocker> first;
        for (const PlayedMove& other : reserved) {
            if (other.agent == candidate.agent) continue;
            const mobb::PlacedClip a(candidate.playable->clip(), candidate.at);
            const mobb::PlacedClip b(other.playable->clip(), other.at);
            const auto contact = mobb::direct_search(a, b);
            if (!contact) continue;
            if (!first || std::tuple(contact->time, other.agent) < std::tuple(first->contact.time, first->agent)) {
                first = {other.agent, other.play, *contact, 0, other.move, other.playable->blocks.shared_clip(),
                         other.at};
            }
        }
        return first;
    }
};

TEST_F(WorldTest, VerdictsAreThoseOfTheDirectSearch) {
    const glm::dvec2 area{23, 17};
    ReservationGrid reservations(area);
    std::vector<PlayedMove> reserved;
    for (int agent = 0; agent < 60; ++agent) {
        for (int play = 0; play < 3; ++play) {
            reserved.push_back(random_motion(agent, play, area, 8));
            reservations.reserve(reserved.back());
        }
    }
    EXPECT_EQ(reservations.size(), 180u);
    std::vector<PlayedMove> candidates;
    for (int i = 0; i < 1500; ++i) candidates.push_back(random_motion(99, 9, area, 8));
    std::vector<AskedPair> asked;
    // One look-up serves all that no agent plays, and those of an agent one for each.
    constexpr double kEver = 1e6;
    const FloorRect everywhere{glm::dvec2(-kEver), glm::dvec2(kEver)};
    const Surroundings all = reservations.around(99, everywhere, -kEver, kEver);
    const std::vector<CandidateCheck> checks = all.check_all(pointers(candidates), &asked);
    int ruled_out = 0, all_asked = 0;
    for (std::size_t i = 0; i < candidates.size(); ++i) {
        const std::optional<Blocker> expected = direct(candidates[i], reserved);
        EXPECT_EQ(all.blocker(candidates[i]), expected) << i;
        EXPECT_EQ(blocker(reservations, candidates[i]), expected) << i;
        EXPECT_EQ(checks[i].collides, expected.has_value()) << i;
        EXPECT_EQ(checks[i].asked, asked_of(candidates[i], reserved, expected)) << i;
        EXPECT_EQ(all.is_clear(candidates[i]), !expected);
        ruled_out += checks[i].collides;
        all_asked += checks[i].asked;
    }
    EXPECT_GT(ruled_out, 200);
    EXPECT_LT(ruled_out, 1300);
    EXPECT_EQ(asked.size(), static_cast<std::size_t>(all_asked));
    // The grid leaves few of the 180 pairs of each candidate.
    EXPECT_LT(all_asked, 180 * 1500 / 10);
    // On one thread and on many.
    for (const int threads : {1, 5}) {
        tbb::task_arena arena(threads);
        const std::vector<CandidateCheck> again = arena.execute([&] { return all.check_all(pointers(candidates)); });
        for (std::size_t i = 0; i < checks.size(); ++i) {
            EXPECT_EQ(again[i].collides, checks[i].collides);
            EXPECT_EQ(again[i].asked, checks[i].asked);
        }
    }
}

TEST_F(WorldTest, WhomSeveralMeetFirstIsWhomEachMeetsFirst) {
    const glm::dvec2 area{12, 9};
    ReservationGrid reservations(area);
    for (int agent = 0; agent < 100; ++agent) reservations.reserve(random_motion(agent, 0, area, 6));
    std::vector<PlayedMove> candidates;
    for (int i = 0; i < 200; ++i) candidates.push_back(random_motion(99, 9, area, 6));
    const std::vector<const PlayedMove*> asked_about = pointers(candidates);
    constexpr double kEver = 1e6;
    const FloorRect everywhere{glm::dvec2(-kEver), glm::dvec2(kEver)};
    const Surroundings all = reservations.around(99, everywhere, -kEver, kEver);
    std::vector<FirstMet> found(candidates.size());
    all.find_first(asked_about, found);
    std::vector<FirstMet> once_more = found;
    all.find_first(asked_about, once_more);
    int colliding = 0, late = 0;
    for (std::size_t i = 0; i < candidates.size(); ++i) {
        FirstMet alone;
        all.find_first(std::span(&asked_about[i], 1), std::span(&alone, 1));
        EXPECT_EQ(found[i].index, alone.index) << i;
        EXPECT_EQ(found[i].asked, alone.asked) << i;
        // Who has met somebody is asked about no more; others are, as by further surroundings.
        EXPECT_EQ(once_more[i].index, alone.index) << i;
        EXPECT_EQ(once_more[i].asked, (alone.collides() ? 1 : 2) * alone.asked) << i;
        std::vector<AskedPair> pairs;
        EXPECT_EQ(all.append(candidates[i], alone.asked, pairs), 0);
        EXPECT_EQ(pairs.size(), static_cast<std::size_t>(alone.asked));
        for (std::size_t k = 0; k < pairs.size(); ++k) {
            const bool is_last = k + 1 == pairs.size();
            EXPECT_EQ(mobb::intersects(pairs[k].candidate.placed, pairs[k].reserved.placed),
                      is_last && alone.collides());
        }
        pairs.clear();
        if (!alone.collides()) {
            EXPECT_EQ(all.append(candidates[i], alone.asked + 3, pairs), 3);
        }
        colliding += alone.collides();
        late += alone.index >= 64 && alone.collides();
    }
    EXPECT_GT(colliding, 50);
    EXPECT_LT(colliding, 190);
    EXPECT_GT(late, 5);
}

TEST_F(WorldTest, TheOnlyOneThatIsMetIsFoundAmongAnyNumber) {
    // Walkers that come near the candidate's way from the side and stop before it; they are asked in the order of
    // agents.
    const PlayedMove candidate = moves.motion(5000, 0, 0, mobb::Placement{{0, 0}, 0, 0});
    const mobb::Placement aside{{0, -2.6}, 90, 0}, other_side{{0, 2.6}, -90, 0};
    for (const int count : {1, 2, 63, 64, 65, 127, 128, 129, 150, 200, 1000}) {
        ReservationGrid nobody({20, 20});
        for (int agent = 0; agent < count; ++agent) nobody.reserve(moves.motion(agent, 0, 0, aside));
        EXPECT_TRUE(nobody.around(candidate).is_clear(candidate));
        for (const int place : {0, 1, 62, 63, 64, 65, 126, 127, 128, 129, 199, count - 1}) {
            if (place >= count) continue;
            ReservationGrid reservations({20, 20});
            for (int agent = 0; agent < count; ++agent)
                reservations.reserve(moves.motion(agent, 0, 0, agent == place ? candidate.at : aside));
            const Surroundings all = reservations.around(candidate);
            FirstMet met;
            const PlayedMove* const asked_about = &candidate;
            all.find_first(std::span(&asked_about, 1), std::span(&met, 1));
            EXPECT_EQ(met.index, static_cast<std::size_t>(place)) << count;
            EXPECT_EQ(met.asked, place + 1) << count;
            EXPECT_FALSE(all.is_clear(candidate));
            const std::optional<Blocker> found = all.blocker(candidate);
            ASSERT_TRUE(found) << place << " of " << count;
            EXPECT_EQ(found->agent, place);
            EXPECT_EQ(all.contact_times(candidate).first, 0) << place << " of " << count;
        }
    }

    // The other way round: one of many candidates meets the last of 130.
    ReservationGrid reservations({20, 20});
    for (int agent = 0; agent < 130; ++agent)
        reservations.reserve(moves.motion(agent, 0, 0, agent == 129 ? other_side : aside));
    const PlayedMove meeting = moves.motion(5000, 0, 0, other_side);
    const Surroundings all = reservations.around(5000, {glm::dvec2(-10), glm::dvec2(10)}, 0, 10);
    for (const std::size_t count : {1U, 2U, 63U, 64U, 65U, 127U, 128U, 129U, 200U, 1000U}) {
        for (const std::size_t place : {std::size_t{0}, std::size_t{1}, std::size_t{63}, std::size_t{64},
                                        std::size_t{65}, std::size_t{127}, std::size_t{128}, count - 1}) {
            if (place >= count) continue;
            std::vector<const PlayedMove*> candidates(count, &candidate);
            candidates[place] = &meeting;
            std::vector<FirstMet> met(count);
            all.find_first(candidates, met);
            const std::vector<CandidateCheck> checks = all.check_all(candidates);
            for (std::size_t i = 0; i < count; ++i) {
                EXPECT_EQ(met[i].index, i == place ? 129 : FirstMet::kNobody) << i << " of " << count;
                EXPECT_EQ(checks[i].collides, i == place) << i << " of " << count;
                EXPECT_EQ(checks[i].asked, met[i].asked) << i << " of " << count;
            }
        }
    }
}

TEST_F(WorldTest, OfContactsAtOneTimeTheFirstAgentCounts) {
    ReservationGrid reservations({20, 20});
    const mobb::Placement placement{{1, 2}, 30, 0};
    for (const int agent : {7, 3, 5}) reservations.reserve(moves.motion(agent, agent, 0, placement));
    const PlayedMove candidate = moves.motion(3, 0, 1, placement);
    const std::optional<Blocker> found = blocker(reservations, candidate);
    ASSERT_TRUE(found);
    EXPECT_EQ(found->agent, 5);
    EXPECT_EQ(found->play, 5);
    EXPECT_EQ(found->contact.time, 0);
}

TEST_F(WorldTest, WhatHasEndedIsForgottenAndItsRoomUsedAgain) {
    const glm::dvec2 area{30, 30};
    ReservationGrid reservations(area);
    std::vector<PlayedMove> reserved;
    for (int i = 0; i < 300; ++i) {
        reserved.push_back(random_motion(i % 40, i / 40, area, 20));
        reservations.reserve(reserved.back());
    }
    for (const double now : {4.0, 9.0, 15.0}) {
        reservations.forget_before(now);
        std::erase_if(reserved, [&](const PlayedMove& motion) {
            const mobb::PlacedClip clip(motion.playable->clip(), motion.at);
            return clip.time(clip.count()) <= now;
        });
        EXPECT_EQ(reservations.size(), reserved.size());
        for (int i = 0; i < 30; ++i) {
            reserved.push_back(random_motion(i, 9, area, 20, now));
            reservations.reserve(reserved.back());
        }
        std::vector<PlayedMove> candidates;
        for (int i = 0; i < 200; ++i) {
            candidates.push_back(random_motion(99, 0, area, 20, now));
        }
        for (const PlayedMove& candidate : candidates)
            EXPECT_EQ(blocker(reservations, candidate), direct(candidate, reserved));
    }
}

TEST_F(WorldTest, WhatIsWithdrawnRulesNothingOut) {
    ReservationGrid reservations({20, 20});
    const mobb::Placement placement{{1, 2}, 30, 0};
    const std::size_t first = reservations.reserve(moves.motion(1, 0, 0, placement));
    reservations.reserve(moves.motion(2, 0, 0, placement));
    const PlayedMove candidate = moves.motion(0, 0, 0, placement);
    EXPECT_EQ(blocker(reservations, candidate)->agent, 1);
    reservations.withdraw(first);
    EXPECT_EQ(blocker(reservations, candidate)->agent, 2);
    std::vector<AskedPair> pairs;
    reservations.all_pairs(candidate, 0, pairs);
    EXPECT_EQ(pairs.size(), 1u);
    reservations.forget_before(1000);
    EXPECT_EQ(reservations.size(), 0u);
    EXPECT_FALSE(blocker(reservations, candidate));
}

TEST_F(WorldTest, WhatTouchesIsNearAndWhatLiesBesideIsNot) {
    // Bounds meet where they touch; times must share more than an instant.
    const glm::dvec2 area{23, 17};
    ReservationGrid reservations(area);
    constexpr double kFar = 100, kLeast = 2 * mobb::kMinOverlap;
    for (int i = 0; i < 300; ++i) {
        const PlayedMove motion = random_motion(1, i, area, 8);
        const std::size_t reservation = reservations.reserve(motion);
        // The shortest move, of who asks: what is near does not depend on what was reserved last.
        const std::size_t own = reservations.reserve(moves.motion(2, 1, 6, motion.at));
        const PlayedMove same = moves.motion(2, 0, motion.move, motion.at);
        const auto is_near = [&](glm::dvec2 low, glm::dvec2 high, double begin, double end) {
            return !reservations.around(2, {low, high}, begin, end).is_clear(same);
        };
        const auto& [low, high] = motion.bounds;
        const double begin = motion.begin(), end = motion.end();
        for (const int axis : {0, 1}) {
            glm::dvec2 from = low, to = high;  // a rectangle that touches the bounds on this side
            from[axis] = high[axis];
            to[axis] = high[axis] + 3;
            EXPECT_TRUE(is_near(from, to, begin, end)) << i;
            from[axis] = std::nextafter(high[axis], kFar);
            EXPECT_FALSE(is_near(from, to, begin, end)) << i;
            from[axis] = low[axis] - 3;
            to[axis] = low[axis];
            EXPECT_TRUE(is_near(from, to, begin, end)) << i;
            to[axis] = std::nextafter(low[axis], -kFar);
            EXPECT_FALSE(is_near(from, to, begin, end)) << i;
        }
        EXPECT_TRUE(is_near(low, high, end - kLeast, end + 3)) << i;
        EXPECT_FALSE(is_near(low, high, end, end + 3)) << i;
        EXPECT_TRUE(is_near(low, high, begin - 3, begin + kLeast)) << i;
        EXPECT_FALSE(is_near(low, high, begin - 3, begin)) << i;
        reservations.withdraw(own);
        reservations.withdraw(reservation);
    }
}

TEST(CountBefore, LeavesOutWhatEqualsTheLimit) {
    CounterRandom random{4, 5, 6};
    for (std::uint32_t size = 0; size < 70; ++size) {
        std::vector<double> numbers;
        for (std::uint32_t i = 0; i < size; ++i) numbers.push_back(random.below(20));
        std::ranges::sort(numbers);
        for (double limit = -1; limit <= 20; limit += 0.5) {
            const auto less = std::ranges::count_if(numbers, [&](double number) { return number < limit; });
            EXPECT_EQ(count_before(limit, numbers), static_cast<std::size_t>(less)) << limit << " of " << size;
        }
    }
}

TEST_F(WorldTest, WhatEndsNowIsForgotten) {
    ReservationGrid reservations({20, 20});
    const PlayedMove motion = moves.motion(1, 0, 0, mobb::Placement{{1, 2}, 30, 3});
    reservations.reserve(motion);
    reservations.forget_before(std::nextafter(motion.end(), 0.0));
    EXPECT_EQ(reservations.size(), 1u);
    reservations.forget_before(motion.end());
    EXPECT_EQ(reservations.size(), 0u);
}

TEST_F(WorldTest, WhoBeginsAtTheEarliestContactCanBeMetThen) {
    const PlayedMove candidate = moves.motion(9, 0, 0, mobb::Placement{{0, 0}, 0, 0});
    const PlayedMove ahead = moves.motion(7, 0, 0, mobb::Placement{{3, 0}, 180, 0});
    const double met = mobb::query(candidate.placed, ahead.placed)->time;
    ASSERT_GT(met, 0);
    const PlayedMove later = moves.motion(3, 0, 0, mobb::Placement{{1, 0}, 0, met});
    ReservationGrid reservations({20, 20});
    reservations.reserve(ahead);
    reservations.reserve(later);
    const std::optional<Blocker> found = blocker(reservations, candidate);
    ASSERT_TRUE(found);
    EXPECT_EQ(found->agent, 3);
    EXPECT_EQ(found->contact.time, met);
    const std::vector<const PlayedMove*> asked_about(100, &candidate);
    for (const CandidateCheck& check : reservations.around(candidate).check_all(asked_about)) EXPECT_EQ(check.asked, 2);
}

TEST_F(WorldTest, MemoryIsUsedAgain) {
    const glm::dvec2 area{30, 30};
    // What is planned is withdrawn long before it would end: all but its number is free at once.
    ReservationGrid plans(area);
    const PlayedMove planned = random_motion(1, 0, area, 8);
    plans.withdraw(plans.reserve(planned));
    const std::size_t empty = plans.bytes();
    constexpr std::size_t kRounds = 4096;
    for (std::size_t round = 0; round < kRounds; ++round) plans.withdraw(plans.reserve(planned));
    EXPECT_LT(plans.bytes() - empty, kRounds * sizeof(PlayedMove) / 4);

    // As time goes on nothing grows, whether motions end or are withdrawn.
    ReservationGrid reservations(area);
    std::vector<PlayedMove> motions;
    for (int agent = 0; agent < 200; ++agent) motions.push_back(random_motion(agent, 0, area, 1));
    std::size_t bytes = 0;
    for (int round = 0; round < 100; ++round) {
        const double now = 8.0 * round;
        reservations.forget_before(now);
        std::vector<std::size_t> withdrawn;
        for (const PlayedMove& motion : motions) {
            mobb::Placement at = motion.at;
            at.start += now;
            const std::size_t reservation = reservations.reserve(moves.motion(motion.agent, round, motion.move, at));
            if (motion.agent % 3 == 0) withdrawn.push_back(reservation);
        }
        for (const std::size_t reservation : withdrawn) reservations.withdraw(reservation);
        if (round == 1) bytes = reservations.bytes();
        if (round > 1) {
            EXPECT_EQ(reservations.bytes(), bytes) << round;
        }
    }
}

TEST_F(WorldTest, WhatIsNotANumberIsRefused) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const double infinity = std::numeric_limits<double>::infinity();
    const mobb::Clip& clip = moves.clip(0).clip();
    for (const double bad : {nan, infinity, -infinity}) {
        for (const mobb::Placement& place :
             {mobb::Placement{.translate = {bad, 0}}, mobb::Placement{.translate = {0, bad}},
              mobb::Placement{.rotate_deg = bad}, mobb::Placement{.start = bad}}) {
            EXPECT_THROW(static_cast<void>(moves.motion(0, 0, 0, place)), std::invalid_argument);
        }
        EXPECT_THROW(ReservationGrid({bad, 10}), std::invalid_argument);
        EXPECT_THROW(ReservationGrid({10, bad}), std::invalid_argument);
    }
    EXPECT_THROW(ReservationGrid({0, 10}), std::invalid_argument);
    ReservationGrid reservations({20, 20});
    const PlayedMove motion = moves.motion(1, 0, 0, mobb::Placement{{1, 2}, 30, 0});
    reservations.reserve(motion);
    const auto around = [&](const FloorRect& bounds, double begin, double end) {
        static_cast<void>(reservations.around(2, bounds, begin, end));
    };
    const FloorRect bounds = motion.bounds;
    for (const int axis : {0, 1}) {
        FloorRect bad = bounds;
        bad.low[axis] = nan;
        EXPECT_THROW(around(bad, 0, clip.duration()), std::invalid_argument);
        bad = bounds;
        bad.high[axis] = nan;
        EXPECT_THROW(around(bad, 0, clip.duration()), std::invalid_argument);
    }
    EXPECT_THROW(around(bounds, nan, 1), std::invalid_argument);
    EXPECT_THROW(around(bounds, 0, nan), std::invalid_argument);
    EXPECT_THROW(reservations.forget_before(nan), std::invalid_argument);
    std::vector<AskedPair> pairs;
    EXPECT_THROW(reservations.all_pairs(motion, nan, pairs), std::invalid_argument);
    // Everywhere and ever are places and times.
    const PlayedMove same = moves.motion(2, 0, 0, motion.at);
    EXPECT_FALSE(
        reservations.around(2, {glm::dvec2(-infinity), glm::dvec2(infinity)}, -infinity, infinity).is_clear(same));
}

TEST_F(WorldTest, ContactIsMeasuredInFullUpToTheMostThatCounts) {
    const glm::dvec2 area{12, 12};
    ReservationGrid reservations(area);
    for (int agent = 0; agent < 30; ++agent) reservations.reserve(random_motion(agent, 0, area, 3));
    int over = 0;
    for (int i = 0; i < 300; ++i) {
        const PlayedMove candidate = random_motion(99, 0, area, 3);
        const Surroundings others = reservations.around(candidate);
        const ContactTimes times = others.contact_times(candidate);
        const std::optional<Blocker> first = others.blocker(candidate);
        EXPECT_EQ(times.first, first ? first->contact.time : std::numeric_limits<double>::infinity()) << i;
        const double most = 2 * random.unit();
        const ContactTimes measured = others.contact_times(candidate, most);
        if (times.seconds <= most) {
            EXPECT_EQ(measured.seconds, times.seconds) << i;
            EXPECT_EQ(measured.first, times.first) << i;
        } else {
            EXPECT_GT(measured.seconds, most) << i;
            ++over;
        }
        const ContactTimes just = others.contact_times(candidate, times.seconds);
        EXPECT_EQ(just.seconds, times.seconds) << i;
        EXPECT_EQ(just.first, times.first) << i;
        // Up to none, and up to exactly what is found then.
        const double some = others.contact_times(candidate, 0).seconds;
        EXPECT_EQ(some > 0, times.seconds > 0) << i;
        if (some < times.seconds) {
            EXPECT_GT(others.contact_times(candidate, some).seconds, some) << i;
        }
    }
    EXPECT_GT(over, 30);
    EXPECT_LT(over, 270);
}

TEST_F(WorldTest, AllPairsAreThoseOfOtherAgentsWithinARange) {
    ReservationGrid reservations({40, 20});
    const auto at = [&](int agent, double x, double start) {
        return moves.motion(agent, 0, 0, mobb::Placement{{x, 0}, 90, start});
    };
    for (int agent = 0; agent < 5; ++agent) reservations.reserve(at(agent, 4.0 * agent - 8, 100.0 * agent));
    const auto others = [&](double range) {
        std::vector<AskedPair> pairs;
        reservations.all_pairs(at(2, 0, 0), range, pairs);
        std::vector<int> agents;
        for (const AskedPair& pair : pairs) agents.push_back(pair.reserved.agent);
        return agents;
    };
    EXPECT_EQ(others(std::numeric_limits<double>::infinity()), (std::vector<int>{0, 1, 3, 4}));
    EXPECT_EQ(others(4), (std::vector<int>{1, 3}));
    EXPECT_EQ(others(2), (std::vector<int>{}));
}

TEST_F(WorldTest, OutlinesHoldTheirDisksClosely) {
    for (int i = 0; i < 500; ++i) {
        const PlayedMove motion = random_motion(0, 0, {1000, 10}, 1);
        const FloorRect& bounds = motion.bounds;
        const mobb::PlacedClip clip(motion.playable->clip(), motion.at);
        FloorRect tight{glm::dvec2(1e9), glm::dvec2(-1e9)};
        for (int k = 0; k < clip.count(); ++k) {
            const mobb::Disk disk = clip.disk(k);
            tight.low = {std::min(tight.low.x, disk.x - disk.r), std::min(tight.low.y, disk.y - disk.r)};
            tight.high = {std::max(tight.high.x, disk.x + disk.r), std::max(tight.high.y, disk.y + disk.r)};
        }
        EXPECT_TRUE(bounds.low.x <= tight.low.x && bounds.low.y <= tight.low.y);
        EXPECT_TRUE(bounds.high.x >= tight.high.x && bounds.high.y >= tight.high.y);
        const glm::dvec2 wide = bounds.high - bounds.low, least = tight.high - tight.low;
        const double most = 0.2 * std::hypot(least.x, least.y);
        EXPECT_LT(wide.x, least.x + most);
        EXPECT_LT(wide.y, least.y + most);
        // A wall exactly at the tight bound is touched, one just inside is crossed.
        const double reach = std::max(std::abs(tight.low.x), std::abs(tight.high.x));
        EXPECT_TRUE(bounds_on_floor(*motion.playable, motion.at, {2 * (reach + 1e-9), 1e6}));
        EXPECT_FALSE(bounds_on_floor(*motion.playable, motion.at, {2 * (reach - 1e-9), 1e6}));
    }
}

TEST_F(WorldTest, TouchingAWallIsNotOverIt) {
    const PlayableClip clip(std::make_shared<const mobb::Clip>(0.5, std::vector<mobb::Disk>{{0, 0, 0.5}, {1, 0, 0.5}}));
    const PlayableClip back(std::make_shared<const mobb::Clip>(0.5, std::vector<mobb::Disk>{{1, 0, 0.5}, {0, 0, 0.5}}));
    for (const double turn : {0.0, 90.0, 180.0, 270.0}) {
        const mobb::Placement at{{0, 0}, turn, 0};
        const int ahead = turn == 0 || turn == 180 ? 0 : 1;
        const auto is_on_floor = [&](double length, double width) {
            glm::dvec2 area(length);
            area[1 - ahead] = width;
            const bool last = bounds_on_floor(clip, at, area).has_value();
            EXPECT_EQ(bounds_on_floor(back, at, area).has_value(), last);
            return last;
        };
        EXPECT_TRUE(is_on_floor(3, 1)) << turn;
        EXPECT_FALSE(is_on_floor(std::nextafter(3.0, 0.0), 1)) << turn;
        EXPECT_FALSE(is_on_floor(3, std::nextafter(1.0, 0.0))) << turn;
    }
}

}  // namespace
}  // namespace mobbscope
