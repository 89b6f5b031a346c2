#include <crowd/simulation/run_check.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>
#include <vector>

namespace mobbscope {

namespace {

constexpr double kSameTime = 1e-6;          // seconds: as precisely as plays must join
constexpr std::size_t kMostSupposed = 300;  // candidates whose answers are tried the other way round

/// Metres between the disks of two motions where they are nearest; infinite where they share no time.
double least_distance(const PlayedMove& a, const PlayedMove& b) {
    double least = std::numeric_limits<double>::infinity();
    const mobb::PlacedBlocks &one = a.placed, &other = b.placed;
    for (int i = 0, first = 0; i < one.end(); ++i) {
        while (first < other.end() && other.time(first + 1) <= one.time(i)) ++first;
        for (int j = first; j < other.end() && other.time(j) < one.time(i + 1); ++j) {
            const mobb::Disk p = one.disk(i), q = other.disk(j);
            least = std::min(least, std::hypot(p.x - q.x, p.y - q.y) - p.r - q.r);
        }
    }
    return least;
}

class RunChecker {
  public:
    explicit RunChecker(const MoveSet& moves)
        : moves_(moves), run_(*moves.fitted().scene().crowd), reservations_(moves, run_.area, run_.grace) {}

    RunCheck check(const Progress& progress) {
        std::vector<ChoicePoint> points = choice_points();
        const std::size_t all = points.size() + run_.agents.size();
        std::size_t done = 0;
        RunCheck out;
        const auto advance = [&] {
            ++out.plays;
            if (progress) progress(++done, all);
        };
        for (int agent = 0; agent < static_cast<int>(run_.agents.size()); ++agent) {
            out.difference = check_first(agent);
            if (out.difference) return out;
            reservations_.reserve(agent, 0, play_of(agent, 0));
            advance();
        }
        for (const ChoicePoint& point : points) {
            // What an edited run plans may end where the next play begins, and is withdrawn only then.
            reservations_.forget_before(point.time - std::max(1.0, 1e-9 * std::abs(point.time)));
            const Play& play = play_of(point.agent, point.play);
            const double due =
                std::max(0.0, point.before.placement.start + moves_.until_joint(point.before.move) - run_.ahead);
            const bool in_time = std::abs(point.time - due) <= kSameTime;
            if (!in_time || !comes_out_as(play, choose(moves_, reservations_, run_, point, search_))) {
                out.difference = explain(point);
                if (!in_time) out.difference->due = due;
                return out;
            }
            reservations_.reserve(point.agent, point.play, play);
            advance();
        }
        return out;
    }

  private:
    const Play& play_of(int agent, int play) const {
        return run_.agents[static_cast<std::size_t>(agent)].plays[static_cast<std::size_t>(play)];
    }

    /// In the order in which they were made.
    std::vector<ChoicePoint> choice_points() const {
        std::vector<ChoicePoint> out;
        for (int agent = 0; agent < static_cast<int>(run_.agents.size()); ++agent) {
            const int plays = static_cast<int>(run_.agents[static_cast<std::size_t>(agent)].plays.size());
            for (int play = 1; play < plays; ++play)
                out.push_back({agent, play, play_of(agent, play - 1), play_of(agent, play).chosen_at});
        }
        std::ranges::sort(out, {}, [](const ChoicePoint& p) { return std::tuple(p.time, p.agent, p.play); });
        return out;
    }

    std::optional<RunDifference> check_first(int agent) {
        const Play& play = play_of(agent, 0);
        Choice choice = choice_of(moves_, run_, agent, 0);
        choice.candidates.clear();
        if (const auto made = first_play(moves_, reservations_, run_, agent, search_)) {
            const PlannedMove& origin = moves_.origin(made->move);
            choice.candidates.push_back({origin.move, origin.turn_deg, made->move, made->placement});
            choice.plan = made->plan;
            choice.kind = made->kind;
            if (comes_out_as(play, choice)) return std::nullopt;
        }
        return RunDifference{{agent, 0, std::move(choice), false}};
    }

    RunDifference explain(const ChoicePoint& point) {
        const Play& play = play_of(point.agent, point.play);
        RunDifference out{{point.agent, point.play, choice_of(moves_, run_, point.agent, point.play), false}};
        const Choice& choice = out.remade.choice;
        out.played = candidate_played(play, choice);
        // With the same move only its kind or plan is another.
        if (out.played == choice.taken) return out;
        for (const OtherAnswer& other : answers_to_try(choice, out.played)) {
            const Choice then = choose(moves_, reservations_, run_, point, search_, nullptr, other);
            if (candidate_played(play, then) != then.taken) continue;
            out.other = other;
            if (!other.about_way) out.query = query_about(point, choice.candidates[other.candidate]);
            return out;
        }
        if (out.played && choice.candidates[*out.played].blocker)
            out.query = query_about(point, choice.candidates[*out.played]);
        return out;
    }

    /// Those first that are most likely: about what the run plays, then about what would have been taken.
    static std::vector<OtherAnswer> answers_to_try(const Choice& choice, std::optional<std::size_t> played) {
        std::vector<std::size_t> candidates;
        if (played) candidates.push_back(*played);
        if (played != choice.taken) candidates.push_back(choice.taken);
        for (std::size_t i = 0; i < choice.candidates.size() && candidates.size() < kMostSupposed; ++i) {
            if (i != played && i != choice.taken) candidates.push_back(i);
        }
        std::vector<OtherAnswer> out;
        for (const bool about_way : {false, true}) {
            for (const std::size_t i : candidates) {
                const Candidate& of = choice.candidates[i];
                if (!of.leaves_floor && (!about_way || of.met == Met::nobody)) out.push_back({i, about_way});
            }
        }
        return out;
    }

    /// Of a candidate that collides with the one it meets, else with the one that comes nearest.
    std::optional<DecidingQuery> query_about(const ChoicePoint& point, const Candidate& candidate) const {
        DecidingQuery out{{point.agent, candidate.played, false, false, candidate.clip, candidate.placement}, {}};
        if (const auto& blocker = candidate.blocker) {
            if (blocker->before_candidate) {
                out.candidate.is_joint = true;
                out.candidate.clip = candidate.joint->clip;
                out.candidate.placement = candidate.joint->placement;
            }
            out.other = {blocker->agent,       blocker->move, blocker->is_joint,
                         blocker->planned > 0, blocker->clip, blocker->placement};
            out.collides = true;
            return out;
        }
        const PlayedMove motion = moves_.motion(point.agent, point.play, candidate.played, candidate.placement);
        std::vector<AskedPair> pairs;
        for (const ReservationGrid* others : {&reservations_.motions(), &reservations_.plans()})
            others->all_pairs(motion, 0, pairs);
        double least = std::numeric_limits<double>::infinity();
        for (const AskedPair& pair : pairs) {
            const double distance = least_distance(motion, pair.reserved);
            if (!(distance < least)) continue;
            least = distance;
            out.other = {pair.reserved.agent,
                         pair.reserved.move,
                         pair.reserved.is_joint,
                         pair.reserved.planned > 0,
                         pair.reserved.playable->blocks.shared_clip(),
                         pair.reserved.at};
        }
        return out.other.clip ? std::optional(std::move(out)) : std::nullopt;
    }

    const MoveSet& moves_;
    const CrowdRun& run_;
    ReservationTable reservations_;
    PlanSearch search_{moves_, reservations_, run_};
};

}  // namespace

RunCheck check_run(const MoveSet& moves, const Progress& progress) { return RunChecker(moves).check(progress); }

}  // namespace mobbscope
