// Runs made again as a whole: the first play that the simulator would not have chosen.
#include "walker_moves.h"

#include <crowd/simulation/run_check.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <utility>

namespace mobbscope {
namespace {

/// A run of 24 on a floor where all find their way, with its moves.
struct CheckedRun {
    explicit CheckedRun(Scene moves, double plan = 4) : scene(with_run(std::move(moves), 24, {14, 14}, plan)) {}

    CrowdRun run() const { return *scene.crowd; }
    RunCheck check(CrowdRun run) const {
        Scene edited = scene;
        edited.crowd = std::make_shared<const CrowdRun>(std::move(run));
        const FittedScene fitted(std::move(edited), {});
        return check_run(MoveSet(fitted));
    }
    std::int64_t plays() const {
        std::int64_t count = 0;
        for (const CrowdAgent& agent : scene.crowd->agents) count += std::ssize(agent.plays);
        return count;
    }

    Scene scene;
};

TEST(RunCheck, ARunAsItWasSimulatedComesOut) {
    for (const CheckedRun& checked :
         {CheckedRun(walker_scene()), CheckedRun(walker_scene(), 0), CheckedRun(with_linear_clips(walker_scene())),
          CheckedRun(with_linear_clips(walker_scene(), 2))}) {
        const RunCheck found = checked.check(checked.run());
        EXPECT_FALSE(found.difference);
        EXPECT_EQ(found.plays, checked.plays());
    }
}

/// The last play of an agent, as if a candidate of that outcome had been taken; none: there is none.
template <class Wanted>
std::optional<Play> last_play_as(const MoveSet& moves, const CrowdRun& run, int agent, const Wanted& wanted) {
    const std::vector<Play>& plays = run.agents[static_cast<std::size_t>(agent)].plays;
    const Choice choice = choice_of(moves, run, agent, static_cast<int>(plays.size()) - 1);
    for (std::size_t i = 0; i < choice.candidates.size(); ++i) {
        const Candidate& candidate = choice.candidates[i];
        const auto graph_moves = static_cast<int>(moves.graph().moves.size());
        if (i == choice.taken || candidate.played >= graph_moves || !wanted(candidate)) continue;
        return Play{candidate.played, candidate.placement, choice.time, PlayKind::chosen, {}};
    }
    return std::nullopt;
}

TEST(RunCheck, TheFirstWrongChoiceIsNamedWhetherItLeadsToAContactOrNot) {
    const CheckedRun checked(walker_scene());
    const FittedScene fitted(checked.scene, {});
    const MoveSet moves(fitted);
    int colliding = 0, free = 0;
    for (int agent = 0; agent < 24; ++agent) {
        SCOPED_TRACE(agent);
        for (const bool collides : {true, false}) {
            CrowdRun edited = checked.run();
            const auto play = last_play_as(moves, edited, agent, [&](const Candidate& candidate) {
                return !candidate.leaves_floor && (collides ? candidate.met == Met::play : candidate.is_free());
            });
            if (!play) continue;
            std::vector<Play>& plays = edited.agents[static_cast<std::size_t>(agent)].plays;
            plays.back() = *play;
            const RunCheck found = checked.check(edited);
            ASSERT_TRUE(found.difference);
            const RunDifference& difference = *found.difference;
            EXPECT_EQ(difference.remade.agent, agent);
            EXPECT_EQ(difference.remade.play, static_cast<int>(plays.size()) - 1);
            EXPECT_FALSE(difference.remade.comes_out);
            ASSERT_TRUE(difference.played);
            const Candidate& played = difference.remade.choice.candidates[*difference.played];
            EXPECT_EQ(played.placement, play->placement);
            (collides ? colliding : free) += 1;
            if (!collides || (difference.other && difference.other->candidate != *difference.played)) continue;
            ASSERT_TRUE(difference.query) << "what rules it out";
            EXPECT_TRUE(difference.query->collides);
            EXPECT_EQ(difference.query->candidate.agent, agent);
            EXPECT_EQ(difference.query->other.agent, played.blocker->agent);
        }
    }
    EXPECT_GT(colliding, 5);
    EXPECT_GT(free, 5);
}

TEST(RunCheck, TheAnswerThatDecidesIsFound) {
    const CheckedRun checked(walker_scene());
    const FittedScene fitted(checked.scene, {});
    const MoveSet moves(fitted);
    int found_same = 0, wrong_hits = 0, wrong_misses = 0;
    for (int agent = 0; agent < 24; ++agent) {
        SCOPED_TRACE(agent);
        const CrowdRun run = checked.run();
        const std::vector<Play>& plays = run.agents[static_cast<std::size_t>(agent)].plays;
        const int last = static_cast<int>(plays.size()) - 1;
        const ChoicePoint point{agent, last, plays[static_cast<std::size_t>(last) - 1], plays.back().chosen_at};
        ReservationTable reservations(moves, run.area, run.grace);
        for (int other = 0; other < 24; ++other) {
            const std::vector<Play>& theirs = run.agents[static_cast<std::size_t>(other)].plays;
            for (int i = 0; other != agent && i < static_cast<int>(theirs.size()); ++i) {
                const Play& play = theirs[static_cast<std::size_t>(i)];
                const bool is_later = std::pair(play.chosen_at, other) > std::pair(point.time, agent);
                if (i == 0 || !is_later) reservations.reserve(other, i, play);
            }
        }
        PlanSearch search(moves, reservations, run);
        const Choice now = choose(moves, reservations, run, point, search);
        ASSERT_TRUE(comes_out_as(plays.back(), now));
        for (std::size_t i = 0; i < now.candidates.size(); ++i) {
            const Choice told = choose(moves, reservations, run, point, search, nullptr, OtherAnswer{i});
            const Candidate& taken = told.candidates[told.taken];
            if (comes_out_as(plays.back(), told) || taken.played >= static_cast<int>(moves.graph().moves.size()))
                continue;
            CrowdRun edited = run;
            edited.agents[static_cast<std::size_t>(agent)].plays.back() = {taken.played, taken.placement, point.time,
                                                                           told.kind, told.plan};
            const RunCheck found = checked.check(edited);
            ASSERT_TRUE(found.difference);
            EXPECT_EQ(found.difference->remade.agent, agent);
            EXPECT_EQ(found.difference->remade.play, last);
            if (found.difference->played == found.difference->remade.choice.taken) continue;
            ASSERT_TRUE(found.difference->other) << "one other answer leads to it";
            found_same += found.difference->other->candidate == i;
            if (found.difference->query) ++(found.difference->query->collides ? wrong_misses : wrong_hits);
            break;
        }
    }
    EXPECT_GT(found_same, 3);
    EXPECT_GT(wrong_hits + wrong_misses, 5);
}

TEST(RunCheck, AChoiceAtAnotherTimeIsADifference) {
    const CheckedRun checked(walker_scene());
    CrowdRun edited = checked.run();
    std::vector<Play>& plays = edited.agents[4].plays;
    const double was = plays.back().chosen_at;
    plays.back().chosen_at = std::max(plays[plays.size() - 2].chosen_at, was - 0.1);
    const RunCheck found = checked.check(edited);
    ASSERT_TRUE(found.difference);
    EXPECT_EQ(found.difference->remade.agent, 4);
    ASSERT_TRUE(found.difference->due);
    EXPECT_NEAR(*found.difference->due, was, 1e-9);
}

TEST(RunCheck, AFirstPlayElsewhereIsADifference) {
    const CheckedRun checked(walker_scene());
    CrowdRun edited = checked.run();
    // One who plays that alone, so that nothing has to join it.
    edited.agents.back().plays.resize(1);
    edited.agents.back().plays[0].placement.translate.x += 1e-3;
    const RunCheck found = checked.check(edited);
    ASSERT_TRUE(found.difference);
    EXPECT_EQ(found.difference->remade.agent, 23);
    EXPECT_EQ(found.difference->remade.play, 0);
    EXPECT_EQ(found.plays, 23);
}

}  // namespace
}  // namespace mobbscope
