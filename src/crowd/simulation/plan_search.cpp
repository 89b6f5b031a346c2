#include <crowd/simulation/plan_search.h>

#include <algorithm>
#include <cstddef>
#include <optional>

namespace mobbscope {

namespace {

constexpr double kLongest = 2;      // times as long as asked: a plan that leads away from a wall by then, or none
constexpr int kMostLookedAt = 100;  // moves: what has no way on among those that take least room has hardly any

}  // namespace

void PlanSearch::Level::find_first(const std::vector<PlayedMove>& of) {
    candidates.clear();
    for (const PlayedMove& motion : of) candidates.push_back(&motion);
    motions.find_first(candidates, found);
    plans.find_first(candidates, found);
}

bool PlanSearch::look(int move, const mobb::Placement& placed, std::span<const PlannedMove> kept) {
    if (tick_) tick_();
    ++looks_;
    plan_.clear();
    longest_.clear();
    reach_ = 0;
    left_ = kMostLookedAt;
    collides_ = false;
    if (run_.plan == 0) return true;
    if (!kept.empty()) {
        int last = move;
        mobb::Placement at = placed;
        for (const PlannedMove& next : kept) {
            const std::optional<int> turned = moves_.turned(next);
            if (!turned) break;
            at = moves_.following(last, at, next);
            last = *turned;
            add(next, reach_ + moves_.until_next(last));
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

bool PlanSearch::extend(int before, const mobb::Placement& placed, double seconds) {
    if (seconds >= run_.plan && (run_.grace == 0 || !reservations_.faces_wall(before, placed))) return true;
    if (seconds >= kLongest * run_.plan) return false;
    while (levels_.size() <= plan_.size()) levels_.push_back(std::make_unique<Level>(moves_));
    Level& level = *levels_[plan_.size()];
    level.placements.start(before, placed, moves_.after_by_room(before));
    for (const MoveSet::FollowerGroup& group : moves_.followers(before)) {
        bool is_looked_up = false;
        for (auto next = group.moves.begin(); next != group.moves.end();) {
            // Where one collides, those that are like it mostly do, and are looked at together; where none does, the
            // first is mostly gone on from.
            const auto most = static_cast<std::size_t>(collides_ ? std::max(left_, 1) : 1);
            level.clear();
            for (; next != group.moves.end() && level.looked_at.size() < most; ++next) {
                const mobb::Placement* const at = level.placements.at(next->number, next->planned.turn_deg);
                // Most that leave the floor have left it at their end.
                if (!at || is_over_wall(next->last, *at, run_.area)) continue;
                const PlayableClip& clip = moves_.clip(next->played);
                const std::optional<FloorRect> bounds = bounds_on_floor(clip, *at, run_.area);
                if (!bounds) continue;
                level.looked_at.emplace_back(agent_, play_, next->played, clip, *at, *bounds);
                level.followers.push_back(&*next);
                if (!moves_.runs_on(before)) continue;
                level.joints.push_back(
                    moves_.joint(agent_, play_, before, placed, next->played, next->planned.turn_deg));
            }
            if (level.looked_at.empty()) break;
            if (left_ <= 0) return false;
            // Looked up once for all of them, when the first one stays on the floor.
            if (!is_looked_up) {
                const auto [all, begin, end] = moves_.room_after(before, placed, group.room);
                reservations_.motions().find_around(agent_, all, begin, end, level.motions);
                reservations_.plans().find_around(agent_, all, begin, end, level.plans);
                is_looked_up = true;
            }
            level.found.assign(level.looked_at.size(), {});
            if (!level.joints.empty()) level.find_first(level.joints);
            level.find_first(level.looked_at);
            for (std::size_t i = 0; i < level.looked_at.size(); ++i) {
                if (--left_ < 0) return false;
                const PlayedMove& motion = level.looked_at[i];
                const FirstMet& met = level.found[i];
                queries_ += met.asked;
                if (asked_) {
                    const auto append = [&](const PlayedMove& of, int count) {
                        return level.plans.append(of, level.motions.append(of, count, *asked_), *asked_);
                    };
                    append(motion, level.joints.empty() ? met.asked : append(level.joints[i], met.asked));
                }
                collides_ = met.collides();
                if (collides_) continue;
                const double seconds_then = seconds + moves_.until_next(motion.move);
                add(level.followers[i]->planned, seconds_then);
                if (extend(motion.move, motion.at, seconds_then)) return true;
                plan_.pop_back();
            }
        }
    }
    return false;
}

}  // namespace mobbscope
