#include <base/text.h>
#include <base/threads.h>
#include <crowd/simulation/move_set.h>
#include <mobb/separation.h>
#include <scene/clip_turn.h>
#include <scene/crowd_scene.h>
#include <scene/scene_edits.h>

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <utility>

namespace mobbscope {

namespace {

constexpr double kSpeedOver = 0.25;  // seconds: of a moment, as a walker's root is not equally fast within a step

/// Place of a turn among all from -180 degrees on.
std::size_t heading_index(double turn_deg) { return static_cast<std::size_t>(turn_deg / kTurnStep + 12.5); }

double rate_of(const FittedScene& fitted, std::optional<double> turn_rate) {
    if (!turn_rate) return fitted.scene().crowd ? fitted.scene().crowd->turn_rate : kDefaultTurnRate;
    if ((*turn_rate >= 0 && *turn_rate <= kMaxTurnRate) || *turn_rate == kTurnsAtOnce) return *turn_rate;
    throw std::invalid_argument("the turn rate is " + brief(*turn_rate) + "; give a number from 0 to " +
                                brief(kMaxTurnRate));
}

std::optional<double> turning_radius_of(const mobb::Clip& clip, const Stance& exit, double turn_rate) {
    if (turn_rate == 0 || turn_rate == kTurnsAtOnce) return std::nullopt;
    const int steps = static_cast<int>(std::min<double>(clip.count(), std::ceil(kSpeedOver / clip.dt())));
    const mobb::Disk& before = clip.samples()[static_cast<std::size_t>(clip.count() - steps)];
    const glm::dvec2 way = exit.position - glm::dvec2(before.x, before.y);
    // A turn by so many degrees lasts as long as one at a constant rate of two thirds.
    const ClipTurn radian = turn_at_rate(180 / std::numbers::pi, turn_rate);
    return std::hypot(way.x, way.y) / (steps * clip.dt()) * radian.seconds;
}

}  // namespace

MoveSet::Move::Move(const PlannedMove& of, PlayableClip playable, const Stance& end, double turn_rate)
    : origin(of),
      clip(std::move(playable)),
      exit(end),
      exit_rotation(mobb::Rotation::from_degrees(end.heading_deg)),
      turning_radius(turning_radius_of(clip.clip(), end, turn_rate)) {}

MoveSet::MoveSet(const FittedScene& fitted, std::optional<double> turn_rate, QueriedBy queried_by)
    : fitted_(&fitted),
      turn_rate_(rate_of(fitted, turn_rate)),
      queried_by_(queried_by),
      by_hub_(moves_by_hub(graph())) {
    const std::vector<GraphMove>& moves = graph().moves;
    for (int i = 0; i < static_cast<int>(moves.size()); ++i) {
        const GraphMove& move = moves[static_cast<std::size_t>(i)];
        const PlannedMove origin = move.turned ? PlannedMove{move.turned->move, move.turned->deg} : PlannedMove{i, 0};
        const std::shared_ptr<const mobb::Tree>& tree = fitted.shared_tree(move.clip);
        moves_.emplace_back(origin, PlayableClip(tree->shared_clip(), queried_by == QueriedBy::trees ? tree : nullptr),
                            move.exit, turn_rate_);
        if (!move.turned) unturned_.push_back(i);
    }
    for (std::vector<int>& of_hub : by_hub_)
        std::erase_if(of_hub, [&](int move) { return moves[static_cast<std::size_t>(move)].turned.has_value(); });
    add_turned();
    const auto room = [this](int move) {
        const FloorRect rect = clip(move).bounds.bounds({});
        return (rect.high.x - rect.low.x) * (rect.high.y - rect.low.y) * until_next(move);
    };
    by_room_ = by_hub_;
    for (std::vector<int>& of_hub : by_room_) {
        std::ranges::stable_sort(of_hub, {}, room);
        followers_.push_back(turned_each_way(of_hub));
    }
}

MoveSet::Room MoveSet::room_of(const std::vector<Follower>& moves) const {
    Room out;
    for (const Follower& next : moves) {
        const double turn_at_once = turns_at_once() ? next.planned.turn_deg : 0;
        const mobb::Placement at = beginning_at({{}, turn_at_once, 0}, move(next.played).entry);
        const glm::dvec2 end = end_of(at, exit(next.played), 0).position;
        const FloorRect last{end - next.last.r, end + next.last.r};
        out.bounds = out.bounds.with(clip(next.played).bounds.bounds(at)).with(last);
        out.end = std::max(out.end, until_next(next.played));
    }
    return out;
}

MoveSet::Room MoveSet::room_after(int move, const mobb::Placement& placed, double most_turn_deg) const {
    Room all;
    for (const FollowerGroup& group : followers(move)) {
        if (std::abs(group.moves.front().planned.turn_deg) > most_turn_deg) break;
        all = {all.bounds.with(group.room.bounds), 0, std::max(all.end, group.room.end)};
    }
    return room_after(move, placed, all);
}

MoveSet::Room MoveSet::room_after(int move, const mobb::Placement& placed, const Room& room) const {
    const MoveEnd end = end_of(placed, exit(move), until_next(move));
    const mobb::Rotation heading = placed.rotation() * exit_rotation(move);
    const glm::dvec2 half = (room.bounds.high - room.bounds.low) / 2.0;
    const glm::dvec2 center = end.position + heading(room.bounds.low + half);
    // Far more than all rounding made here and where candidates are placed.
    const double margin = 1e-6 + 1e-9 * (std::abs(center.x) + std::abs(center.y) + half.x + half.y);
    const glm::dvec2 reach = mobb::half_in_world(half, heading) + margin;
    const double spare = 1e-6 + 1e-9 * (std::abs(end.time) + room.end);
    Room out{{center - reach, center + reach}, end.time - spare, end.time + room.end + spare};
    if (runs_on(move)) {
        const mobb::Disk from = mobb::placed(clip(move).last, placed.rotation(), placed.translate);
        const glm::dvec2 at(from.x, from.y);
        out.bounds = out.bounds.with({at - from.r - margin, at + from.r + margin});
        out.begin -= clip(move).clip().dt();
    }
    return out;
}

std::vector<MoveSet::FollowerGroup> MoveSet::turned_each_way(const std::vector<int>& moves) const {
    std::vector<FollowerGroup> out;
    for (const double turn : kTurns) {
        bool is_new = true;
        for (std::size_t i = 0; i < moves.size(); ++i) {
            const PlannedMove planned{moves[i], turn};
            const std::optional<int> played = turned(planned);
            if (!played) continue;
            if (is_new || out.back().moves.size() == kMostTogether) out.emplace_back();
            is_new = false;
            out.back().moves.push_back({planned, *played, i, clip(*played).last});
        }
    }
    for (FollowerGroup& group : out) group.room = room_of(group.moves);
    return out;
}

void MoveSet::add_turned() {
    ByHeading none;
    none.fill(-1);
    turned_.assign(graph().moves.size(), none);
    for (int i = 0; i < static_cast<int>(graph().moves.size()); ++i) {
        const PlannedMove& origin = at(i).origin;
        // Turns by other steps are played where a run says so, and not chosen.
        if (std::remainder(origin.turn_deg, kTurnStep) != 0) continue;
        int& place = turned_[static_cast<std::size_t>(origin.move)][heading_index(origin.turn_deg)];
        if (place < 0) place = i;
    }
    if (turn_rate_ == 0 || turn_rate_ == kTurnsAtOnce) return;
    std::vector<PlannedMove> wanted;
    for (const int move : unturned_) {
        for (const double turn : kTurns) {
            if (turn != 0 && !turned({move, turn})) wanted.push_back({move, turn});
        }
    }
    std::vector<std::optional<Move>> made(wanted.size());
    limit_worker_threads();
    tbb::parallel_for(std::size_t{0}, wanted.size(), [&](std::size_t i) { made[i] = turned_move(wanted[i]); });
    for (std::size_t i = 0; i < wanted.size(); ++i) {
        if (!made[i]) continue;
        turned_[static_cast<std::size_t>(wanted[i].move)][heading_index(wanted[i].turn_deg)] =
            static_cast<int>(moves_.size());
        moves_.push_back(std::move(*made[i]));
    }
}

std::optional<MoveSet::Move> MoveSet::turned_move(const PlannedMove& origin) const {
    const GraphMove& move = this->move(origin.move);
    const SceneClip& clip = fitted_->scene().clips[static_cast<std::size_t>(move.clip)];
    const ClipTurn turn = turn_at_rate(origin.turn_deg, turn_rate_);
    // A clip in a file has one turn.
    if (clip.turn || turn.seconds > clip.clip->until_next()) return std::nullopt;
    try {
        const mobb::ClipPtr turned = bent(*clip.clip, turn);
        return Move(origin, playable(turned), bent_exit(*clip.clip, *turned, move.exit, turn), turn_rate_);
    } catch (const std::invalid_argument&) {
        return std::nullopt;  // it leads beyond what a clip holds
    }
}

PlayableClip MoveSet::playable(const mobb::ClipPtr& clip) const {
    if (queried_by_ == QueriedBy::blocks) return PlayableClip(clip);
    return PlayableClip(clip, std::make_shared<const mobb::Tree>(clip, fitted_->options()));
}

std::optional<int> MoveSet::turned(const PlannedMove& wanted) const {
    if (turns_at_once()) return wanted.move;
    const int move = turned_[static_cast<std::size_t>(wanted.move)][heading_index(wanted.turn_deg)];
    return move < 0 ? std::nullopt : std::optional(move);
}

mobb::Placement MoveSet::following(int before, const mobb::Placement& placed, const PlannedMove& next) const {
    Stance exit = this->exit(before);
    if (turns_at_once()) exit.heading_deg += next.turn_deg;
    return beginning_at(end_of(placed, exit, until_next(before)), move(next.move).entry);
}

const PlayableClip& MoveSet::joint_of(int before, const PlannedMove& next) const {
    const std::lock_guard lock(joints_->mutex);
    const std::tuple key(before, next.move, turns_at_once() ? next.turn_deg : 0);
    const auto known = joints_->made.find(key);
    if (known != joints_->made.end()) return known->second;
    const mobb::PlacedClip from(clip(before).clip(), {});
    // However far a move turns on its way, its first disk stays.
    const mobb::PlacedClip to(clip(next.move).clip(), following(before, {}, next));
    const std::vector<mobb::Disk> ends{from.disk(from.end() - 1), runs_on_to(from, to)};
    const auto made = std::make_shared<const mobb::Clip>(from.dt(), ends, mobb::Motion::linear);
    return joints_->made.emplace(key, playable(made)).first->second;
}

PlayedMove MoveSet::joint(int agent, int play, int before, const mobb::Placement& placed, int next,
                          double turn_deg) const {
    mobb::Placement at = placed;
    at.start += until_joint(before);
    PlayedMove out(agent, play, next, joint_of(before, {origin(next).move, turn_deg}), at);
    out.is_joint = true;
    return out;
}

PlayedMove MoveSet::joint(int agent, int play, const Play& before, const Play& next) const {
    // A play does not say how far its agent turned at once.
    const double heading = next.placement.rotate_deg + move(next.move).entry.heading_deg;
    const double turn = heading - before.placement.rotate_deg - exit(before.move).heading_deg;
    const double step = kTurnStep * std::round(std::remainder(turn, 360.0) / kTurnStep);
    return joint(agent, play, before.move, before.placement, next.move, step);
}

std::vector<PlayedMove> MoveSet::planned(int agent, int index, const Play& play) const {
    std::vector<PlayedMove> out;
    int last = play.move, number = 0;
    mobb::Placement at = play.placement;
    for (const PlannedMove& next : play.plan) {
        const std::optional<int> move = turned(next);
        // Where a clip was edited since, the rest of a plan may not be there any more.
        if (!move) break;
        ++number;
        if (runs_on(last)) {
            out.push_back(joint(agent, index, last, at, *move, next.turn_deg));
            out.back().planned = number;
        }
        at = following(last, at, next);
        last = *move;
        out.push_back(motion(agent, index, last, at));
        out.back().planned = number;
    }
    return out;
}

MoveSet::Extended MoveSet::extended(std::span<const int> used, TurnedSkeletons skeletons) const {
    Extended out{fitted_->scene(), std::vector<int>(moves_.size(), -1)};
    out.scene.crowd = nullptr;
    MotionGraph graph = this->graph();
    UnusedNames names(out.scene.clips);
    const int stored = static_cast<int>(graph.moves.size());
    for (int i = 0; i < stored; ++i) out.index[static_cast<std::size_t>(i)] = i;
    std::vector<int> added(used.begin(), used.end());
    std::erase_if(added, [&](int move) { return move < stored; });
    std::ranges::sort(added);
    added.erase(std::unique(added.begin(), added.end()), added.end());
    for (const int index : added) {
        const PlannedMove& origin = this->origin(index);
        GraphMove move = this->move(index);
        SceneClip clip = out.scene.clips[static_cast<std::size_t>(move.clip)];
        clip.turn = turn_at_rate(origin.turn_deg, turn_rate_);
        if (clip.source && skeletons == TurnedSkeletons::left_out) clip.skeleton = nullptr;
        if (clip.skeleton) clip.skeleton = turned_skeleton(*clip.skeleton, *clip.clip, *clip.turn);
        clip.name = names.take(clip.name + formatted(" turned %+.0f", origin.turn_deg));
        clip.clip = this->clip(index).blocks.shared_clip();
        // Of samples in the scene those that are bent are kept.
        if (!clip.source) clip.turn.reset();
        move.clip = static_cast<int>(out.scene.clips.size());
        move.exit = exit(index);
        move.turned = {origin.move, origin.turn_deg};
        out.index[static_cast<std::size_t>(index)] = static_cast<int>(graph.moves.size());
        graph.moves.push_back(move);
        out.scene.clips.push_back(std::move(clip));
    }
    out.scene.graph = std::make_shared<const MotionGraph>(std::move(graph));
    return out;
}

}  // namespace mobbscope
