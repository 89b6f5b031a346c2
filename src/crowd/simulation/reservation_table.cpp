#include <crowd/simulation/reservation_table.h>
#include <scene/crowd_run.h>
#include <scene/motion_graph.h>

#include <algorithm>
#include <cmath>
#include <memory>

namespace mobbscope {

namespace {

constexpr double kHeadroom = 1;  // metres before the wall that the next move needs to turn away

}  // namespace

ReservationTable::ReservationTable(const MoveSet& moves, glm::dvec2 area, double grace)
    : moves_(moves), area_(area), motions_(area), plans_(area), stands_(area) {
    if (grace == 0) return;
    for (const SceneClip& clip : moves.fitted().scene().clips) {
        const std::vector<mobb::Disk> disk{{0, 0, clip.clip->samples().back().r}};
        const auto standing = std::make_shared<const mobb::Clip>(grace, disk);
        stand_of_clip_.push_back({mobb::Tree(standing, moves.fitted().options()), ClipBounds(*standing)});
    }
}

PlayedMove ReservationTable::stand(int agent, int index, const Play& play) const {
    const GraphMove& move = moves_.move(play.move);
    const Stand& stand = stand_of_clip_[static_cast<std::size_t>(move.clip)];
    const mobb::Placement& placed = play.placement;
    const glm::dvec2 at = mobb::Rotation::from_degrees(placed.rotate_deg)(move.exit.position) + placed.translate;
    return {agent, index, &stand.tree, &stand.clip_bounds, {at, 0, placed.start + moves_.duration(play.move)}};
}

void ReservationTable::reserve(int agent, int index, const Play& play) {
    motions_.reserve(moves_.motion(agent, index, play.move, play.placement));
    const auto place = static_cast<std::size_t>(agent);
    if (place >= plan_of_agent_.size()) plan_of_agent_.resize(place + 1);
    // A plan begins with the play that takes its place, and is not yet forgotten.
    for (const std::size_t planned : plan_of_agent_[place]) plans_.withdraw(planned);
    plan_of_agent_[place].clear();
    for (PlayedMove& planned : moves_.planned(agent, index, play))
        plan_of_agent_[place].push_back(plans_.reserve(planned));
    if (stand_of_clip_.empty()) return;
    if (place >= stand_of_agent_.size()) stand_of_agent_.resize(place + 1);
    // The stand after the play before begins with this play, and is not yet forgotten.
    if (stand_of_agent_[place]) stands_.withdraw(*stand_of_agent_[place]);
    stand_of_agent_[place] = stands_.reserve(stand(agent, index, play));
}

void ReservationTable::forget_before(double now) {
    motions_.forget_before(now);
    plans_.forget_before(now);
    stands_.forget_before(now);
}

bool ReservationTable::faces_wall(const Play& play) const {
    const GraphMove& move = moves_.move(play.move);
    const mobb::Rotation heading =
        mobb::Rotation::from_degrees(play.placement.rotate_deg) * mobb::Rotation::from_degrees(move.exit.heading_deg);
    const glm::dvec2 at = stand(0, 0, play).placement.translate + heading({kHeadroom, 0});
    const double radius = moves_.tree(play.move).clip().samples().back().r;
    return std::abs(at.x) + radius > area_.x / 2 || std::abs(at.y) + radius > area_.y / 2;
}

std::vector<bool> ReservationTable::in_the_way(int agent, int index, std::span<const Play> plays) const {
    std::vector<bool> out(plays.size(), false);
    if (stand_of_clip_.empty()) return out;
    std::vector<PlayedMove> bodies, stands;
    for (const Play& play : plays) {
        bodies.push_back(moves_.motion(agent, index, play.move, play.placement));
        stands.push_back(stand(agent, index, play));
    }
    const std::vector<CandidateCheck> through = stands_.check_all(bodies);
    const std::vector<CandidateCheck> beside = stands_.check_all(stands);
    const std::vector<CandidateCheck> before = motions_.check_all(stands);
    for (std::size_t i = 0; i < plays.size(); ++i) {
        out[i] = through[i].blocker || beside[i].blocker || before[i].blocker || faces_wall(plays[i]);
    }
    return out;
}

MoveSet::MoveSet(const FittedScene& fitted) : fitted_(&fitted), by_hub_(moves_by_hub(graph())) {
    bounds_.reserve(fitted.scene().clips.size());
    for (const SceneClip& clip : fitted.scene().clips) bounds_.emplace_back(*clip.clip);
    const auto room = [this](int move) {
        const FloorRect rect = bounds(move).bounds({});
        return (rect.high.x - rect.low.x) * (rect.high.y - rect.low.y) * duration(move);
    };
    by_room_ = by_hub_;
    for (std::vector<int>& moves : by_room_) std::ranges::stable_sort(moves, {}, room);
}

std::vector<PlayedMove> MoveSet::planned(int agent, int index, const Play& play) const {
    std::vector<PlayedMove> out;
    int last = play.move;
    mobb::Placement at = play.placement;
    for (const PlannedMove& next : play.plan) {
        at = following(last, at, next.move, next.turn_deg);
        last = next.move;
        out.push_back(motion(agent, index, last, at));
        out.back().planned = static_cast<int>(out.size());
    }
    return out;
}

mobb::Placement MoveSet::following(int before, const mobb::Placement& placed, int next, double turn_deg) const {
    Stance exit = move(before).exit;
    exit.heading_deg += turn_deg;
    return mobbscope::following(placed, exit, duration(before), move(next).entry);
}

}  // namespace mobbscope
