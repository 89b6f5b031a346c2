#include <crowd/simulation/plan_search.h>

#include <optional>

namespace mobbscope {

namespace {

constexpr double kLongest = 2;      // times as long as asked: a plan that leads away from a wall by then, or none
constexpr int kMostLookedAt = 100;  // moves: what has no way on among those that take least room has hardly any

}  // namespace

bool PlanSearch::look(int move, const OrientedPlacement& placed, std::span<const PlannedMove> kept) {
    plan_.clear();
    longest_.clear();
    reach_ = 0;
    left_ = kMostLookedAt;
    if (run_.plan == 0) return true;
    if (!kept.empty()) {
        int last = move;
        OrientedPlacement at = placed;
        for (const PlannedMove& next : kept) {
            const std::optional<int> turned = moves_.turned(next);
            if (!turned) break;
            at = moves_.following(last, at, next);
            last = *turned;
            add(next, reach_ + moves_.duration(last));
        }
        if (extend(last, at, reach_)) return true;
        plan_.clear();
    }
    return extend(move, placed, 0);
}

void PlanSearch::add(const PlannedMove& next, double seconds) {
    plan_.push_back(next);
    if (seconds <= reach_) return;
    reach_ = seconds;
    longest_ = plan_;
}

bool PlanSearch::extend(int before, const OrientedPlacement& placed, double seconds) {
    if (seconds >= run_.plan && (run_.grace == 0 || !reservations_.faces_wall(before, placed))) return true;
    if (seconds >= kLongest * run_.plan) return false;
    FollowingPlacements placements(moves_, before, placed, moves_.after_by_room(before));
    for (const MoveSet::FollowerGroup& group : moves_.followers(before)) {
        // Looked up once for all of them, when the first one stays on the floor.
        std::optional<Surroundings> motions, plans;
        for (const MoveSet::Follower& next : group.moves) {
            const OrientedPlacement* const at = placements.at(next.number, next.planned.turn_deg);
            // Most that leave the floor have left it at their end.
            if (!at || is_over_wall(next.last, *at, run_.area)) continue;
            const PlayableClip& clip = moves_.clip(next.played);
            const std::optional<FloorRect> bounds = bounds_on_floor(clip, *at, run_.area);
            if (!bounds) continue;
            if (--left_ < 0) return false;
            if (!motions) {
                const auto [all, begin, end] = moves_.room_after(before, placed, group.room);
                motions = reservations_.motions().around(agent_, all, begin, end);
                plans = reservations_.plans().around(agent_, all, begin, end);
            }
            const PlayedMove motion(agent_, play_, next.played, clip, *at, *bounds);
            if (!motions->is_clear(motion, queries_, asked_) || !plans->is_clear(motion, queries_, asked_)) continue;
            const double seconds_then = seconds + moves_.duration(next.played);
            add(next.planned, seconds_then);
            if (extend(next.played, *at, seconds_then)) return true;
            plan_.pop_back();
        }
    }
    return false;
}

}  // namespace mobbscope
