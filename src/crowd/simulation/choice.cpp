#include <base/error.h>
#include <base/random.h>
#include <crowd/simulation/choice.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <tuple>
#include <utility>

namespace mobbscope {

namespace {

constexpr double kTravels = 0.3;     // metres from a move's begin to its end: what is less is standing
constexpr double kSamePlace = 1e-6;  // metres, degrees, seconds: as precisely as plays must join
constexpr int kTries = 2000;         // places looked at for an agent before the floor counts as full

/// Metres by which a disk reaches over a wall.
double beyond_wall(const mobb::Disk& disk, glm::dvec2 area) {
    return std::max({std::abs(disk.x) + disk.r - area.x / 2, std::abs(disk.y) + disk.r - area.y / 2, 0.0});
}

class Chooser {
  public:
    Chooser(const MoveSet& moves, const ReservationTable& reservations, const CrowdRun& run, const ChoicePoint& point,
            PlanSearch& search, std::vector<AskedPair>* asked, const std::optional<OtherAnswer>& other)
        : moves_(moves),
          reservations_(reservations),
          run_(run),
          point_(point),
          asked_(asked),
          other_(other),
          search_(search) {
        search_.start(point.agent, point.play, asked);
        choice_.time = point.time;
        placements_.start(point.before.move, before_, moves.after(point.before.move));
        reserve(1);
    }

    Choice choose() {
        for (std::size_t turn = 0; turn < kTurns.size();) {
            const std::size_t first = choice_.candidates.size();
            // Both ways by one angle belong together.
            const double angle = std::abs(kTurns[turn]);
            for (; turn < kTurns.size() && std::abs(kTurns[turn]) == angle; ++turn) add_candidates(kTurns[turn]);
            // Often no turn is needed, and often more than the least.
            if (angle <= kTurnStep) look_up(angle == 0 ? 0 : 180);
            if (angle == kTurnStep) reserve(kTurns.size());
            check_candidates(first);
            if (take_clear(first)) return done();
        }
        if ((stood_ && take_with_way_on(those(0, is_clear))) || take_in_the_way() || take_longest_plan() ||
            take_against_plans())
            return done();
        take_least_harm();
        choice_.kind = PlayKind::forced;
        return std::move(choice_);
    }

  private:
    /// What is near all candidates that turn by no more than that.
    void look_up(double most_turn_deg) {
        nearby_ = reservations_.nearby(point_.agent, moves_.room_after(point_.before.move, before_, most_turn_deg));
    }

    void reserve(std::size_t turns) {
        const std::size_t count = turns * moves_.after(point_.before.move).size();
        choice_.candidates.reserve(count);
        motions_.reserve(count);
        if (moves_.runs_on(point_.before.move)) joints_.reserve(count);
    }

    void add_candidates(double turn) {
        const std::vector<int>& moves = moves_.after(point_.before.move);
        for (std::size_t i = 0; i < moves.size(); ++i) {
            const std::optional<int> played = moves_.turned({moves[i], turn});
            if (!played) continue;
            const mobb::Placement* const at = placements_.at(i, turn);
            // A graph whose moves lead far away would in the end leave what can be placed.
            if (!at) continue;
            const PlayableClip& clip = moves_.clip(*played);
            const std::optional<FloorRect> on_floor = bounds_on_floor(clip, *at, run_.area);
            choice_.candidates.push_back({moves[i], turn, *played, *at, !on_floor});
            auto& motion = motions_.emplace_back();
            if (on_floor) motion.emplace(point_.agent, point_.play, *played, clip, *at, *on_floor);
            if (moves_.runs_on(point_.before.move))
                joints_.push_back(moves_.joint(point_.agent, point_.play, point_.before.move, before_, *played, turn));
        }
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

    Choice done() {
        choice_.kind = choice_.candidates[choice_.taken].turn_deg == 0 ? PlayKind::chosen : PlayKind::pivoted;
        return std::move(choice_);
    }

    /// Those from `first` on.
    void check_candidates(std::size_t first) {
        check_against_others(first, false);
        Candidate* const other = supposed_of(first);
        if (other && !other_->about_way) other->met = other->met == Met::nobody ? Met::play : Met::nobody;
        for (const std::size_t i : those(first, &Candidate::is_free))
            choice_.candidates[i].in_the_way = reservations_.in_the_way(*motions_[i], nearby_);
        if (other && other_->about_way) other->in_the_way = !other->in_the_way;
    }

    /// The candidate of the other answer, if it is one of those from `first` on and stays on the floor; else null.
    Candidate* supposed_of(std::size_t first) {
        if (!other_ || other_->candidate < first || other_->candidate >= choice_.candidates.size()) return nullptr;
        Candidate& out = choice_.candidates[other_->candidate];
        return out.leaves_floor ? nullptr : &out;
    }

    /// If all leave the floor, the least harm is done by one of them.
    void check_off_floor() {
        for (std::size_t i = 0; i < motions_.size(); ++i) {
            const Candidate& candidate = choice_.candidates[i];
            motions_[i] = moves_.motion(point_.agent, point_.play, candidate.played, candidate.placement);
        }
        check_against_others(0, true);
    }

    /// Of the candidates from `first` on that leave the floor, or of those that do not.
    void check_against_others(std::size_t first, bool off_floor) {
        const auto against = [&](const Surroundings& others, Met met, const auto& motion_of) {
            const std::vector<std::size_t> of = those(first, [&](const Candidate& candidate) {
                return candidate.leaves_floor == off_floor && candidate.met == Met::nobody;
            });
            std::vector<const PlayedMove*> motions;
            for (const std::size_t i : of) motions.push_back(&motion_of(i));
            const std::vector<CandidateCheck> checks = others.check_all(motions, asked_);
            for (std::size_t i = 0; i < of.size(); ++i) {
                if (checks[i].collides) choice_.candidates[of[i]].met = met;
                choice_.queries += checks[i].asked;
            }
        };
        const auto joint_of = [&](std::size_t i) -> const PlayedMove& { return joints_[i]; };
        const auto motion_of = [&](std::size_t i) -> const PlayedMove& { return *motions_[i]; };
        if (!joints_.empty()) against(nearby_.motions, Met::play, joint_of);
        against(nearby_.motions, Met::play, motion_of);
        if (!joints_.empty()) against(nearby_.plans, Met::plan, joint_of);
        against(nearby_.plans, Met::plan, motion_of);
    }

    /// One of the free candidates that are in nobody's way and have a way on. At most one turn either way has any: the
    /// last.
    bool take_clear(std::size_t first) {
        return take_with_way_on(those(first, [this](const Candidate& candidate) {
            return is_clear(candidate) && (!stood_ || travels(candidate.move));
        }));
    }

    static bool is_clear(const Candidate& candidate) {
        return candidate.is_free() && !candidate.in_the_way && !candidate.no_way_on;
    }

    bool travels(int index) const {
        const GraphMove& move = moves_.move(index);
        const glm::dvec2 way = move.exit.position - move.entry.position;
        return std::hypot(way.x, way.y) >= kTravels;
    }

    bool take_in_the_way() {
        return take_at_least_turn(
            [](const Candidate& candidate) { return candidate.is_free() && candidate.in_the_way; });
    }

    /// Of the free candidates, none of which has a way on.
    bool take_longest_plan() {
        if (!longest_) return false;
        choice_.taken = *longest_;
        choice_.plan = longest_plan_;
        return true;
    }

    /// Whoever planned to go there may have to choose something else.
    bool take_against_plans() {
        return take_at_least_turn(
                   [](const Candidate& candidate) { return !candidate.leaves_floor && candidate.met == Met::plan; }) ||
               take_longest_plan();
    }

    /// Of the candidates that meet a condition, one that turns least and has a way on.
    template <class Allowed>
    bool take_at_least_turn(const Allowed& allowed) {
        const std::vector<std::size_t> indices = those(0, allowed);
        const auto turn = [this](std::size_t index) { return std::abs(choice_.candidates[index].turn_deg); };
        for (auto begin = indices.begin(); begin != indices.end();) {
            const auto end = std::find_if(begin, indices.end(), [&](std::size_t i) { return turn(i) != turn(*begin); });
            if (take_with_way_on({begin, end})) return true;
            begin = end;
        }
        return false;
    }

    /// Draws from candidates until one has a way on, and takes it.
    bool take_with_way_on(std::vector<std::size_t> indices) {
        CounterRandom random = draws();
        while (!indices.empty()) {
            const auto drawn = indices.begin() + random.below(static_cast<std::uint32_t>(indices.size()));
            if (has_way_on(*drawn)) {
                choice_.taken = *drawn;
                choice_.plan = search_.plan();
                return true;
            }
            indices.erase(drawn);
        }
        return false;
    }

    bool has_way_on(std::size_t index) {
        Candidate& candidate = choice_.candidates[index];
        std::span<const PlannedMove> kept = point_.before.plan;
        const bool was_planned =
            !kept.empty() && kept[0].move == candidate.move && kept[0].turn_deg == candidate.turn_deg;
        kept = was_planned ? kept.subspan(1) : kept.first(0);
        const std::int64_t before = search_.queries();
        candidate.no_way_on = !search_.look(candidate.played, motions_[index]->at, kept);
        choice_.queries += search_.queries() - before;
        if (candidate.no_way_on && (!longest_ || search_.seconds() > longest_seconds_)) {
            longest_ = index;
            longest_plan_ = search_.plan();
            longest_seconds_ = search_.seconds();
        }
        return !candidate.no_way_on;
    }

    void take_least_harm() {
        if (choice_.candidates.empty()) {
            throw InputError(moves_.fitted().scene().file,
                             "the graph's moves lead beyond all bounds; check their stances");
        }
        const auto stays = [](const Candidate& candidate) { return !candidate.leaves_floor; };
        const bool some_stay = std::ranges::any_of(choice_.candidates, stays);
        if (!some_stay) check_off_floor();
        const std::vector<std::size_t> of = those(0, [&](const Candidate& c) { return c.leaves_floor != some_stay; });
        std::vector<std::size_t> best;
        Harm least{std::numeric_limits<double>::infinity(), 0, 0};
        for (const std::size_t i : of) {
            // What is more than the least so far is measured no farther than that.
            const Harm harm = harm_of(i, std::get<0>(least));
            if (best.empty() || harm < least) {
                best.clear();
                least = harm;
            }
            if (harm == least) best.push_back(i);
        }
        choice_.taken = best[draws().below(static_cast<std::uint32_t>(best.size()))];
    }

    /// The less, the better: seconds of contact with what others play, metres that it ends beyond a wall, and how early
    /// the first contact is.
    using Harm = std::tuple<double, double, double>;

    /// Seconds that are more than `most` may be counted in part.
    Harm harm_of(std::size_t index, double most) const {
        const PlayedMove& motion = *motions_[index];
        const mobb::PlacedBlocks& way = motion.placed;
        const double beyond = beyond_wall(way.disk(way.end() - 1), run_.area);
        ContactTimes contact;
        if (choice_.candidates[index].met == Met::play) {
            if (!joints_.empty()) contact = nearby_.motions.contact_times(joints_[index], most);
            const ContactTimes then = nearby_.motions.contact_times(motion, most - contact.seconds);
            contact = {contact.seconds + then.seconds, std::min(contact.first, then.first)};
        }
        return {contact.seconds, beyond, -contact.first};
    }

    CounterRandom draws() const {
        return {run_.seed, static_cast<std::uint64_t>(point_.agent), static_cast<std::uint64_t>(point_.play)};
    }

    const MoveSet& moves_;
    const ReservationTable& reservations_;
    const CrowdRun& run_;
    const ChoicePoint& point_;
    std::vector<AskedPair>* asked_;
    std::optional<OtherAnswer> other_;
    mobb::Placement before_{point_.before.placement};
    FollowingPlacements placements_{moves_};
    PlanSearch& search_;
    Choice choice_;
    ReservationTable::Nearby nearby_;                 ///< what is near the candidates
    std::vector<std::optional<PlayedMove>> motions_;  ///< by candidate; none: it leaves the floor
    std::vector<PlayedMove> joints_;                  ///< by candidate; none behind a held move
    /// Who stands has a way on nearly always, in front of a wall too: nobody would leave it again.
    bool stood_ = run_.plan > 0 && !travels(point_.before.move);
    std::optional<std::size_t> longest_;  ///< of the candidates without a way on, the one whose plan is longest
    std::vector<PlannedMove> longest_plan_;
    double longest_seconds_ = 0;
};

/// Commits what `agent` was reservations to at a choice: what has not ended, and its last play before the choice, which
/// may end at it.
void reserve_plays(ReservationTable& reservations, const MoveSet& moves, const CrowdRun& run, int agent,
                   const ChoicePoint& point) {
    const std::vector<Play>& plays = run.agents[static_cast<std::size_t>(agent)].plays;
    const auto made_before = [&](const Play& play) {
        return play.chosen_at < point.time || (play.chosen_at == point.time && agent < point.agent);
    };
    const auto ended = [&](const Play& play) {
        return play.placement.start + moves.until_next(play.move) <= point.time;
    };
    // First plays come before all choices.
    const auto end = std::partition_point(plays.begin() + 1, plays.end(), made_before);
    const auto begin = std::partition_point(plays.begin(), end - 1, ended);
    for (auto play = begin; play != end; ++play) {
        reservations.reserve(agent, static_cast<int>(play - plays.begin()), *play);
    }
}

/// What leads to a candidate; none behind a held move.
std::optional<PlayedMove> joint_to(const MoveSet& moves, const ChoicePoint& point, const Candidate& candidate) {
    if (!moves.runs_on(point.before.move)) return std::nullopt;
    return moves.joint(point.agent, point.play, point.before.move, point.before.placement, candidate.played,
                       candidate.turn_deg);
}

/// The same move at the same place and time.
bool is_played(const Candidate& candidate, const Play& play) {
    const glm::dvec2 aside = candidate.placement.translate - play.placement.translate;
    const double turn = std::remainder(candidate.placement.rotate_deg - play.placement.rotate_deg, 360.0);
    return candidate.played == play.move && std::hypot(aside.x, aside.y) <= kSamePlace &&
           std::abs(turn) <= kSamePlace && std::abs(candidate.placement.start - play.placement.start) <= kSamePlace;
}

std::optional<Blocker> blocker_of(const MoveSet& moves, const ReservationTable& reservations, const ChoicePoint& point,
                                  const Candidate& candidate) {
    if (candidate.met == Met::nobody) return std::nullopt;
    const ReservationGrid& others = candidate.met == Met::play ? reservations.motions() : reservations.plans();
    if (const auto joint = joint_to(moves, point, candidate)) {
        if (auto blocker = others.around(*joint).blocker(*joint)) return blocker;
    }
    const PlayedMove motion = moves.motion(point.agent, point.play, candidate.played, candidate.placement);
    return others.around(motion).blocker(motion);
}

}  // namespace

Choice choose(const MoveSet& moves, const ReservationTable& reservations, const CrowdRun& run, const ChoicePoint& point,
              PlanSearch& search, std::vector<AskedPair>* asked, const std::optional<OtherAnswer>& other) {
    return Chooser(moves, reservations, run, point, search, asked, other).choose();
}

std::optional<Play> first_play(const MoveSet& moves, const ReservationTable& reservations, const CrowdRun& run,
                               int agent, PlanSearch& search) {
    CounterRandom random(run.seed, static_cast<std::uint64_t>(agent), 0);
    for (int i = 0; i < kTries; ++i) {
        const int move = moves.unturned()[random.below(static_cast<std::uint32_t>(moves.unturned().size()))];
        mobb::Placement placement;
        placement.rotate_deg = 360 * random.unit() - 180;
        placement.start = -moves.until_joint(move) * random.unit();
        // The clip's bounds, wherever its own origin is, come to lie anywhere on the floor.
        mobb::Placement at = placement;
        const FloorRect bounds = moves.clip(move).bounds.bounds(at);
        const glm::dvec2 room = run.area - (bounds.high - bounds.low);
        const double across = random.unit(), along = random.unit();
        if (room.x < 0 || room.y < 0) continue;
        at.translate = -run.area / 2.0 + room * glm::dvec2(across, along) - bounds.low;
        if (!bounds_on_floor(moves.clip(move), at, run.area)) continue;
        const PlayedMove motion = moves.motion(agent, 0, move, at);
        const ReservationTable::Nearby nearby = reservations.nearby(motion);
        if (!nearby.motions.is_clear(motion) || !nearby.plans.is_clear(motion)) continue;
        search.start(agent, 0);
        const bool has_way_on = search.look(move, at);
        // Where the floor is nearly full, any place will do.
        if (i < kTries / 2 && (!has_way_on || reservations.in_the_way(motion, nearby))) continue;
        return Play{move, at, at.start, PlayKind::chosen, search.plan()};
    }
    return std::nullopt;
}

Choice choice_of(const MoveSet& moves, const CrowdRun& run, int agent, int play) {
    const std::vector<Play>& plays = run.agents.at(static_cast<std::size_t>(agent)).plays;
    const Play& made = plays.at(static_cast<std::size_t>(play));
    const auto clip_of = [&](const Candidate& candidate) { return moves.clip(candidate.played).blocks.shared_clip(); };
    if (play == 0) {
        const PlannedMove& origin = moves.origin(made.move);
        Candidate placed{origin.move, origin.turn_deg, made.move, made.placement};
        placed.clip = clip_of(placed);
        return {made.chosen_at, made.kind, {placed}, 0, made.plan, 0};
    }
    const ChoicePoint point{agent, play, plays[static_cast<std::size_t>(play) - 1], made.chosen_at};
    ReservationTable reservations(moves, run.area, run.grace);
    for (int other = 0; other < static_cast<int>(run.agents.size()); ++other) {
        if (other != agent) reserve_plays(reservations, moves, run, other, point);
    }
    PlanSearch search(moves, reservations, run);
    Choice choice = choose(moves, reservations, run, point, search);
    for (Candidate& candidate : choice.candidates) {
        candidate.clip = clip_of(candidate);
        if (const auto joint = joint_to(moves, point, candidate))
            candidate.joint = PlayJoint{joint->playable->blocks.shared_clip(), joint->at};
        candidate.blocker = blocker_of(moves, reservations, point, candidate);
    }
    return choice;
}

std::optional<std::size_t> candidate_played(const Play& play, const Choice& choice) {
    const auto at = std::ranges::find_if(choice.candidates, [&](const Candidate& of) { return is_played(of, play); });
    return at == choice.candidates.end() ? std::nullopt
                                         : std::optional(static_cast<std::size_t>(at - choice.candidates.begin()));
}

bool comes_out_as(const Play& play, const Choice& choice) {
    return is_played(choice.candidates[choice.taken], play) && choice.kind == play.kind && choice.plan == play.plan;
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
