#include <crowd/choice.h>
#include <crowd/counter_random.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string>

namespace mobbscope {

namespace {

constexpr double kTurnStep = 15;  // degrees
constexpr double kHalfTurn = 180;

class Chooser {
  public:
    Chooser(const MoveSet& moves, const World& world, const CrowdRun& run, const ChoicePoint& point,
            std::vector<AskedPair>* asked)
        : moves_(moves), world_(world), run_(run), point_(point), asked_(asked) {
        choice_.time = point.time;
    }

    Choice choose() {
        for (double turn = 0; turn <= kHalfTurn; turn += kTurnStep) {
            const std::size_t first = choice_.candidates.size();
            add_candidates(turn);
            if (turn > 0 && turn < kHalfTurn) add_candidates(-turn);
            judge(first);
            if (take_free(first)) {
                choice_.kind = turn == 0 ? PlayKind::chosen : PlayKind::pivoted;
                return std::move(choice_);
            }
        }
        choice_.kind = PlayKind::forced;
        take_latest();
        return std::move(choice_);
    }

  private:
    void add_candidates(double turn) {
        const Play& before = point_.before;
        for (const int move : moves_.after(before.move)) {
            Candidate candidate{move, turn, moves_.following(before.move, before.placement, move, turn), false, {}};
            const mobb::PlacedClip placed(moves_.tree(move).clip(), candidate.placement);
            candidate.leaves_floor = leaves_floor(placed, moves_.outline(move), run_.area);
            choice_.candidates.push_back(std::move(candidate));
        }
    }

    /// Asks the world about the candidates from `first` on whose leaves_floor is `off_floor`.
    void judge(std::size_t first, bool off_floor = false) {
        std::vector<Motion> motions;
        std::vector<std::size_t> of;
        for (std::size_t i = first; i < choice_.candidates.size(); ++i) {
            const Candidate& candidate = choice_.candidates[i];
            if (candidate.leaves_floor != off_floor) continue;
            motions.push_back(moves_.motion(point_.agent, point_.play, candidate.move, candidate.placement));
            of.push_back(i);
        }
        const std::vector<Verdict> verdicts = world_.verdicts(motions, asked_);
        for (std::size_t i = 0; i < of.size(); ++i) {
            choice_.candidates[of[i]].ruling = verdicts[i].ruling;
            choice_.queries += verdicts[i].asked;
        }
    }

    bool take_free(std::size_t first) {
        std::vector<std::size_t> free;
        for (std::size_t i = first; i < choice_.candidates.size(); ++i) {
            if (choice_.candidates[i].is_free()) free.push_back(i);
        }
        if (free.empty()) return false;
        CounterRandom random(run_.seed, static_cast<std::uint64_t>(point_.agent),
                             static_cast<std::uint64_t>(point_.play));
        choice_.taken = free[random.below(static_cast<std::uint32_t>(free.size()))];
        return true;
    }

    /// Of equals the one with the least turn, as turns grow with the index.
    void take_latest() {
        const auto stays = [](const Candidate& candidate) { return !candidate.leaves_floor; };
        const bool some_stay = std::any_of(choice_.candidates.begin(), choice_.candidates.end(), stays);
        if (!some_stay) judge(0, true);
        double latest = -std::numeric_limits<double>::infinity();
        for (std::size_t i = 0; i < choice_.candidates.size(); ++i) {
            const Candidate& candidate = choice_.candidates[i];
            if (some_stay && candidate.leaves_floor) continue;
            const double time =
                candidate.ruling ? candidate.ruling->contact.time : std::numeric_limits<double>::infinity();
            if (time > latest) {
                latest = time;
                choice_.taken = i;
            }
        }
    }

    const MoveSet& moves_;
    const World& world_;
    const CrowdRun& run_;
    const ChoicePoint& point_;
    std::vector<AskedPair>* asked_;
    Choice choice_;
};

/// Commits what `agent` was committed to before a choice and still is at it.
void commit_plays(World& world, const MoveSet& moves, const CrowdRun& run, int agent, const ChoicePoint& point) {
    const std::vector<Play>& plays = run.agents[static_cast<std::size_t>(agent)].plays;
    const auto made_before = [&](const Play& play) {
        return play.chosen_at < point.time || (play.chosen_at == point.time && agent < point.agent);
    };
    // First plays come before all choices.
    const auto end = std::partition_point(plays.begin() + 1, plays.end(), made_before);
    for (auto play = end; play != plays.begin();) {
        --play;
        if (play->placement.start + moves.duration(play->move) <= point.time) break;
        world.commit(moves.motion(agent, static_cast<int>(play - plays.begin()), play->move, play->placement));
    }
}

}  // namespace

Choice choose(const MoveSet& moves, const World& world, const CrowdRun& run, const ChoicePoint& point,
              std::vector<AskedPair>* asked) {
    return Chooser(moves, world, run, point, asked).choose();
}

Choice choice_of(const MoveSet& moves, const CrowdRun& run, int agent, int play) {
    const std::vector<Play>& plays = run.agents.at(static_cast<std::size_t>(agent)).plays;
    const Play& made = plays.at(static_cast<std::size_t>(play));
    if (play == 0) return {made.chosen_at, made.kind, {{made.move, 0, made.placement, false, {}}}, 0, 0};
    const ChoicePoint point{agent, play, plays[static_cast<std::size_t>(play) - 1], made.chosen_at};
    World world(run.area);
    for (int other = 0; other < static_cast<int>(run.agents.size()); ++other) {
        if (other != agent) commit_plays(world, moves, run, other, point);
    }
    return choose(moves, world, run, point);
}

}  // namespace mobbscope
