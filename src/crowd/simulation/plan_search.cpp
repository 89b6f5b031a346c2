#include <crowd/simulation/plan_search.h>
#include <mobb/clip.h>

#include <optional>

namespace mobbscope {

namespace {

constexpr double kLongest = 2;      // times as long as asked: a plan that leads away from a wall by then, or none
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
            const std::optional<int> turned = moves_.turned(next);
            if (!turned) break;
            at = moves_.following(last, at, next);
            last = *turned;
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
    if (seconds >= run_.plan && (run_.grace == 0 || !reservations_.faces_wall(before, placed))) return true;
    if (seconds >= kLongest * run_.plan) return false;
    for (const double turn : kTurns) {
        for (const int move : moves_.after_by_room(before)) {
            const PlannedMove next{move, turn};
            const std::optional<int> turned = moves_.turned(next);
            if (!turned) continue;
            const mobb::Placement at = moves_.following(before, placed, next);
            if (!mobb::is_valid(at)) continue;
            if (leaves_floor({moves_.tree(*turned).clip(), at}, moves_.bounds(*turned), run_.area)) continue;
            if (--left_ < 0) return false;
            if (!is_free(*turned, at)) continue;
            const double end = seconds + moves_.duration(*turned);
            add(next, end);
            if (extend(*turned, at, end)) return true;
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
