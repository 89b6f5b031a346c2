#include <crowd/simulation/plan_search.h>
#include <mobb/clip.h>

namespace mobbscope {

namespace {

constexpr int kMostLookedAt = 100;  // moves: what has no way on among those that take least room has hardly any

}  // namespace

bool PlanSearch::look(int move, const mobb::Placement& placement, std::span<const PlannedMove> kept) {
    plan_.clear();
    longest_.clear();
    reach_ = 0;
    left_ = kMostLookedAt;
    if (run_.plan == 0) return true;
    if (!kept.empty()) {
        int last = move;
        mobb::Placement at = placement;
        for (const PlannedMove& next : kept) {
            at = moves_.following(last, at, next.move, next.turn_deg);
            last = next.move;
            add(next, reach_ + moves_.duration(last));
        }
        if (extend(last, at, reach_)) return true;
        plan_.clear();
    }
    return extend(move, placement, 0);
}

void PlanSearch::add(const PlannedMove& next, double seconds) {
    plan_.push_back(next);
    if (seconds <= reach_) return;
    reach_ = seconds;
    longest_ = plan_;
}

bool PlanSearch::extend(int before, const mobb::Placement& placed, double seconds) {
    if (seconds >= run_.plan) return true;
    for (const double turn : kTurns) {
        for (const int next : moves_.after_by_room(before)) {
            const mobb::Placement at = moves_.following(before, placed, next, turn);
            if (!mobb::is_valid(at)) continue;
            if (leaves_floor({moves_.tree(next).clip(), at}, moves_.bounds(next), run_.area)) continue;
            if (--left_ < 0) return false;
            if (!is_free(next, at)) continue;
            const double end = seconds + moves_.duration(next);
            add({next, turn}, end);
            if (extend(next, at, end)) return true;
            plan_.pop_back();
        }
    }
    return false;
}

bool PlanSearch::is_free(int move, const mobb::Placement& placement) {
    const PlayedMove motion = moves_.motion(agent_, play_, move, placement);
    return reservations_.motions().is_clear(motion, queries_, asked_) &&
           reservations_.plans().is_clear(motion, queries_, asked_);
}

}  // namespace mobbscope
