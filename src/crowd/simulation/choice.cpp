#include <base/error.h>
#include <base/random.h>
#include <crowd/simulation/choice.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <stdexcept>
#include <utility>

namespace mobbscope {

namespace {

constexpr double kTurnStep = 15;  // degrees
constexpr double kHalfTurn = 180;
constexpr double kSamePlace = 1e-6;  // metres, degrees: as precisely as plays must join

class Chooser {
  public:
    Chooser(const MoveSet& moves, const ReservationTable& reservations, const CrowdRun& run, const ChoicePoint& point,
            std::vector<AskedPair>* asked)
        : moves_(moves), reservations_(reservations), run_(run), point_(point), asked_(asked) {
        choice_.time = point.time;
    }

    Choice choose() {
        std::size_t straight = 0;
        for (int step = 0; step * kTurnStep <= kHalfTurn; ++step) {
            const double turn = step * kTurnStep;
            const std::size_t first = choice_.candidates.size();
            add_candidates(turn);
            if (turn > 0 && turn < kHalfTurn) add_candidates(-turn);
            if (turn == 0) straight = choice_.candidates.size();
            check_candidates(first);
            if (take_clear()) return done(choice_.taken < straight ? PlayKind::chosen : PlayKind::pivoted);
        }
        if (take_free()) return done(choice_.taken < straight ? PlayKind::chosen : PlayKind::pivoted);
        take_latest();
        return done(PlayKind::forced);
    }

  private:
    void add_candidates(double turn) {
        const Play& before = point_.before;
        for (const int move : moves_.after(before.move)) {
            Candidate candidate{move,  turn, moves_.following(before.move, before.placement, move, turn),
                                false, {},   false};
            // A graph whose moves lead far away would in the end leave what can be placed.
            if (!mobb::is_valid(candidate.placement)) continue;
            const mobb::PlacedClip placed(moves_.tree(move).clip(), candidate.placement);
            candidate.leaves_floor = leaves_floor(placed, moves_.bounds(move), run_.area);
            choice_.candidates.push_back(candidate);
        }
    }

    PlayedMove motion_of(const Candidate& candidate) const {
        return moves_.motion(point_.agent, point_.play, candidate.move, candidate.placement);
    }

    /// Indices of the candidates from `first` on that meet a condition.
    template <class Condition>
    std::vector<std::size_t> those(std::size_t first, const Condition& condition) const {
        std::vector<std::size_t> out;
        for (std::size_t i = first; i < choice_.candidates.size(); ++i) {
            if (std::invoke(condition, choice_.candidates[i])) out.push_back(i);
        }
        return out;
    }

    Choice done(PlayKind kind) {
        choice_.kind = kind;
        return std::move(choice_);
    }

    /// Those from `first` on.
    void check_candidates(std::size_t first) {
        find_blockers(first, false);
        const std::vector<std::size_t> of = those(first, &Candidate::is_free);
        std::vector<Play> plays;
        for (const std::size_t i : of) {
            const Candidate& candidate = choice_.candidates[i];
            plays.push_back({candidate.move, candidate.placement, point_.time, PlayKind::chosen});
        }
        const std::vector<bool> in_the_way = reservations_.in_the_way(point_.agent, point_.play, plays);
        for (std::size_t i = 0; i < of.size(); ++i) choice_.candidates[of[i]].in_the_way = in_the_way[i];
    }

    /// Of the candidates from `first` on that leave the floor, or of those that do not.
    void find_blockers(std::size_t first, bool off_floor) {
        const std::vector<std::size_t> of =
            those(first, [&](const Candidate& candidate) { return candidate.leaves_floor == off_floor; });
        std::vector<PlayedMove> motions;
        for (const std::size_t i : of) motions.push_back(motion_of(choice_.candidates[i]));
        const std::vector<CandidateCheck> checks = reservations_.motions().check_all(motions, asked_);
        for (std::size_t i = 0; i < of.size(); ++i) {
            choice_.candidates[of[i]].blocker = checks[i].blocker;
            choice_.queries += checks[i].asked;
        }
    }

    /// One of the free candidates that are in nobody's way. At most one heading either way has any: the last.
    bool take_clear() {
        return take_one_of([](const Candidate& candidate) { return candidate.is_free() && !candidate.in_the_way; });
    }

    /// One of the free candidates at the least turn that has any.
    bool take_free() {
        const auto first = std::find_if(choice_.candidates.begin(), choice_.candidates.end(),
                                        [](const Candidate& candidate) { return candidate.is_free(); });
        if (first == choice_.candidates.end()) return false;
        const double turn = std::abs(first->turn_deg);
        return take_one_of(
            [turn](const Candidate& candidate) { return candidate.is_free() && std::abs(candidate.turn_deg) == turn; });
    }

    void take_latest() {
        if (choice_.candidates.empty()) {
            throw InputError(moves_.fitted().scene().file.string(), "",
                             "the graph's moves lead beyond all bounds; check their stances");
        }
        const auto stays = [](const Candidate& candidate) { return !candidate.leaves_floor; };
        const bool some_stay = std::any_of(choice_.candidates.begin(), choice_.candidates.end(), stays);
        if (!some_stay) find_blockers(0, true);
        const auto contact = [](const Candidate& candidate) {
            return candidate.blocker ? candidate.blocker->contact.time : std::numeric_limits<double>::infinity();
        };
        double latest = -std::numeric_limits<double>::infinity();
        for (const Candidate& candidate : choice_.candidates) {
            if (candidate.leaves_floor != some_stay) latest = std::max(latest, contact(candidate));
        }
        const auto is_latest = [&](const Candidate& candidate) {
            return candidate.leaves_floor != some_stay && contact(candidate) == latest;
        };
        // Of those that two who overlap already may take, the ones that part them first.
        double shortest = std::numeric_limits<double>::infinity();
        for (const Candidate& candidate : choice_.candidates) {
            if (is_latest(candidate)) shortest = std::min(shortest, seconds_of_contact(candidate));
        }
        take_one_of([&](const Candidate& candidate) {
            return is_latest(candidate) && seconds_of_contact(candidate) == shortest;
        });
    }

    /// With the motion that rules it out.
    double seconds_of_contact(const Candidate& candidate) const {
        if (!candidate.blocker) return 0;
        return reservations_.motions().seconds_of_contact(motion_of(candidate), *candidate.blocker);
    }

    template <class Allowed>
    bool take_one_of(const Allowed& allowed) {
        const std::vector<std::size_t> indices = those(0, allowed);
        if (indices.empty()) return false;
        CounterRandom random(run_.seed, static_cast<std::uint64_t>(point_.agent),
                             static_cast<std::uint64_t>(point_.play));
        choice_.taken = indices[random.below(static_cast<std::uint32_t>(indices.size()))];
        return true;
    }

    const MoveSet& moves_;
    const ReservationTable& reservations_;
    const CrowdRun& run_;
    const ChoicePoint& point_;
    std::vector<AskedPair>* asked_;
    Choice choice_;
};

/// Commits what `agent` was reservations to at a choice: what has not ended, and its last play before the choice, which
/// may end at it.
void reserve_plays(ReservationTable& reservations, const MoveSet& moves, const CrowdRun& run, int agent,
                   const ChoicePoint& point) {
    const std::vector<Play>& plays = run.agents[static_cast<std::size_t>(agent)].plays;
    const auto made_before = [&](const Play& play) {
        return play.chosen_at < point.time || (play.chosen_at == point.time && agent < point.agent);
    };
    const auto ended = [&](const Play& play) { return play.placement.start + moves.duration(play.move) <= point.time; };
    // First plays come before all choices.
    const auto end = std::partition_point(plays.begin() + 1, plays.end(), made_before);
    const auto begin = std::partition_point(plays.begin(), end - 1, ended);
    for (auto play = begin; play != end; ++play) {
        reservations.reserve(agent, static_cast<int>(play - plays.begin()), *play);
    }
}

}  // namespace

Choice choose(const MoveSet& moves, const ReservationTable& reservations, const CrowdRun& run, const ChoicePoint& point,
              std::vector<AskedPair>* asked) {
    return Chooser(moves, reservations, run, point, asked).choose();
}

Choice choice_of(const MoveSet& moves, const CrowdRun& run, int agent, int play) {
    const std::vector<Play>& plays = run.agents.at(static_cast<std::size_t>(agent)).plays;
    const Play& made = plays.at(static_cast<std::size_t>(play));
    if (play == 0) return {made.chosen_at, made.kind, {{made.move, 0, made.placement, false, {}, false}}, 0, 0};
    const ChoicePoint point{agent, play, plays[static_cast<std::size_t>(play) - 1], made.chosen_at};
    ReservationTable reservations(moves, run.area, run.grace);
    for (int other = 0; other < static_cast<int>(run.agents.size()); ++other) {
        if (other != agent) reserve_plays(reservations, moves, run, other, point);
    }
    return choose(moves, reservations, run, point);
}

bool comes_out_as(const Play& play, const Choice& choice) {
    const Candidate& taken = choice.candidates[choice.taken];
    const glm::dvec2 aside = taken.placement.translate - play.placement.translate;
    const double turn = std::remainder(taken.placement.rotate_deg - play.placement.rotate_deg, 360.0);
    return taken.move == play.move && choice.kind == play.kind && std::hypot(aside.x, aside.y) <= kSamePlace &&
           std::abs(turn) <= kSamePlace;
}

std::optional<int> last_chosen(const CrowdAgent& agent, double time) {
    // Plays are chosen in their order; the first was placed.
    const auto later = [](double t, const Play& play) { return t < play.chosen_at; };
    const auto after = std::upper_bound(agent.plays.begin() + 1, agent.plays.end(), time, later);
    const auto play = static_cast<int>(after - agent.plays.begin()) - 1;
    return play > 0 ? std::optional(play) : std::nullopt;
}

std::optional<FollowedChoice> last_choice(const MoveSet& moves, int agent, double time) {
    const CrowdRun& run = *moves.fitted().scene().crowd;
    const auto play = last_chosen(run.agents.at(static_cast<std::size_t>(agent)), time);
    if (!play) return std::nullopt;
    Choice choice = choice_of(moves, run, agent, *play);
    const bool comes_out =
        comes_out_as(run.agents[static_cast<std::size_t>(agent)].plays[static_cast<std::size_t>(*play)], choice);
    return FollowedChoice{agent, *play, std::move(choice), comes_out};
}

}  // namespace mobbscope
