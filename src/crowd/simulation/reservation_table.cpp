#include <crowd/simulation/reservation_table.h>
#include <scene/motion_graph.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

namespace mobbscope {

namespace {

constexpr double kHeadroom = 1;  // metres before the wall that who turns at once needs to turn away

/// Points of a half circle of radius 1 that begins at the origin along x and goes round to the left.
constexpr std::array<glm::dvec2, 6> kHalfCircle{{{0.5, 0.1339745962155614},
                                                 {0.8660254037844386, 0.5},
                                                 {1, 1},
                                                 {0.8660254037844386, 1.5},
                                                 {0.5, 1.8660254037844386},
                                                 {0, 2}}};

}  // namespace

ReservationTable::ReservationTable(const MoveSet& moves, glm::dvec2 area, double grace)
    : moves_(moves), area_(area), grace_(grace), motions_(area), plans_(area), stands_(area) {
    if (grace == 0) return;
    for (const SceneClip& clip : moves.fitted().scene().clips) {
        const std::vector<mobb::Disk> disk{{0, 0, clip.clip->samples().back().r}};
        const auto standing = std::make_shared<const mobb::Clip>(grace, disk);
        stand_of_clip_.push_back(moves.playable(standing));
    }
}

PlayedMove ReservationTable::stand(const PlayedMove& motion) const {
    // A turned clip's last disk is as large as the clip's itself.
    const PlayableClip& standing = stand_of_clip_[static_cast<std::size_t>(moves_.move(motion.move).clip)];
    const MoveEnd end = end_of(motion.at, moves_.exit(motion.move), moves_.until_joint(motion.move));
    mobb::Placement at;
    at.translate = end.position;
    at.start = end.time;
    return {motion.agent, motion.play, -1, standing, at};
}

void ReservationTable::reserve(int agent, int index, const Play& play) {
    const PlayedMove motion = moves_.motion(agent, index, play.move, play.placement);
    const auto place = static_cast<std::size_t>(agent);
    if (place >= plan_of_agent_.size()) {
        plan_of_agent_.resize(place + 1);
        runs_on_.resize(place + 1);
    }
    if (runs_on_[place]) motions_.reserve(moves_.joint(agent, index, *runs_on_[place], play));
    runs_on_[place].reset();
    if (moves_.runs_on(play.move)) runs_on_[place] = play;
    motions_.reserve(motion);
    // A plan begins with the play that takes its place, and is not yet forgotten.
    for (const std::size_t planned : plan_of_agent_[place]) plans_.withdraw(planned);
    plan_of_agent_[place].clear();
    for (const PlayedMove& planned : moves_.planned(agent, index, play))
        plan_of_agent_[place].push_back(plans_.reserve(planned));
    if (stand_of_clip_.empty()) return;
    if (place >= stand_of_agent_.size()) stand_of_agent_.resize(place + 1);
    // The stand after the play before begins with this play, and is not yet forgotten.
    if (stand_of_agent_[place]) stands_.withdraw(*stand_of_agent_[place]);
    stand_of_agent_[place] = stands_.reserve(stand(motion));
}

void ReservationTable::forget_before(double now) {
    motions_.forget_before(now);
    plans_.forget_before(now);
    stands_.forget_before(now);
}

bool ReservationTable::faces_wall(int move, const mobb::Placement& placed) const {
    const glm::dvec2 at = placed.rotation()(moves_.exit(move).position) + placed.translate;
    const mobb::Rotation heading = placed.rotation() * moves_.exit_rotation(move);
    const double radius = moves_.clip(move).last.r;
    const auto is_on_floor = [&](glm::dvec2 ahead) {
        const glm::dvec2 point = at + heading(ahead);
        return std::abs(point.x) + radius <= area_.x / 2 && std::abs(point.y) + radius <= area_.y / 2;
    };
    const std::optional<double> turning = moves_.turning_radius(move);
    if (!turning) return !is_on_floor({kHeadroom, 0});
    return std::ranges::none_of(std::array{-1.0, 1.0}, [&](double side) {
        return std::ranges::all_of(kHalfCircle, [&](const glm::dvec2& point) {
            return is_on_floor(*turning * glm::dvec2(point.x, side * point.y));
        });
    });
}

ReservationTable::Nearby ReservationTable::nearby(int agent, const MoveSet::Room& room) const {
    const double end = room.end + grace_;
    return {motions_.around(agent, room.bounds, room.begin, end),
            plans_.around(agent, room.bounds, room.begin, room.end),
            stands_.around(agent, room.bounds, room.begin, end)};
}

ReservationTable::Nearby ReservationTable::nearby(const PlayedMove& motion) const {
    const FloorRect bounds = stand_of_clip_.empty() ? motion.bounds : motion.bounds.with(stand(motion).bounds);
    return nearby(motion.agent, {bounds, motion.begin(), motion.end()});
}

bool ReservationTable::in_the_way(const PlayedMove& motion, const Nearby& nearby) const {
    if (stand_of_clip_.empty()) return false;
    if (faces_wall(motion.move, motion.at) || !nearby.stands.is_clear(motion)) return true;
    const PlayedMove standing = stand(motion);
    return !nearby.stands.is_clear(standing) || !nearby.motions.is_clear(standing);
}

}  // namespace mobbscope
