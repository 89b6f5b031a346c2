#include <base/median.h>
#include <base/threads.h>
#include <crowd/graph/continuity.h>
#include <crowd/graph/graph_figures.h>
#include <crowd/graph/rigs.h>
#include <import/import.h>
#include <import/skeleton/disk_sampler.h>
#include <scene/clip_turn.h>
#include <scene/crowd_run.h>

#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <numbers>
#include <optional>
#include <tuple>

namespace mobbscope {

namespace {

std::vector<double>& of(LargestChanges& changes, Change change) { return changes[static_cast<std::size_t>(change)]; }

LargestChanges no_changes(std::size_t joints) {
    LargestChanges out;
    of(out, Change::joint_position).resize(joints);
    of(out, Change::heading).resize(1);
    of(out, Change::root_velocity).resize(1);
    of(out, Change::joint_velocity).resize(joints);
    return out;
}

void raise(double& largest, double value) { largest = std::max(largest, value); }

/// How far a rotation turns about the vertical, degrees: its twist.
double turn_about_up(const glm::dquat& q) {
    return std::abs(std::remainder(2 * std::atan2(q.z, q.w), 2 * std::numbers::pi)) * 180 / std::numbers::pi;
}

double squared(const auto& way) { return glm::dot(way, way); }

// What is largest is found among squares: many moves have many frames. lengths() makes lengths of them.
void raise_by_step(LargestChanges& largest, const BodyPose& from, const BodyPose& to) {
    double* const of_joint = of(largest, Change::joint_position).data();
    for (std::size_t j = 0; j < from.joints.size(); ++j) raise(of_joint[j], squared(to.joints[j] - from.joints[j]));
    raise(of(largest, Change::heading)[0], turn_about_up(to.root * glm::conjugate(from.root)));
}

void raise_by_two_steps(LargestChanges& largest, const BodyPose& first, const BodyPose& second, const BodyPose& third,
                        double dt) {
    const auto change = [&](std::size_t joint) {
        return (third.joints[joint] - second.joints[joint] - (second.joints[joint] - first.joints[joint])) / dt;
    };
    raise(of(largest, Change::root_velocity)[0], squared(glm::dvec2(change(0))));
    double* const of_joint = of(largest, Change::joint_velocity).data();
    for (std::size_t j = 0; j < first.joints.size(); ++j) raise(of_joint[j], squared(change(j)));
}

LargestChanges lengths(LargestChanges squares) {
    for (const Change change : {Change::joint_position, Change::root_velocity, Change::joint_velocity}) {
        for (double& largest : of(squares, change)) largest = std::sqrt(largest);
    }
    return squares;
}

glm::dvec2 seen_from(const Stance& stance, const mobb::Rotation& turn, glm::dvec2 place) {
    return turn(place - stance.position);
}

/// Poses of some joints, seen from a stance.
class PoseReader {
  public:
    PoseReader(const mobb::Clip& clip, const Skeleton& skeleton, const std::vector<int>& joints, const Stance& stance)
        : clip_(clip),
          skeleton_(skeleton),
          joints_(joints),
          stance_(stance),
          turn_(mobb::Rotation::from_degrees(-stance.heading_deg)),
          about_up_(about_up(turn_)) {}

    void read(int frame, BodyPose& out) const {
        const mobb::Disk& disk = clip_.samples()[static_cast<std::size_t>(frame)];
        const auto positions = skeleton_.at(frame);
        out.joints.resize(joints_.size());
        for (std::size_t i = 0; i < joints_.size(); ++i) {
            const glm::dvec3 p(positions[static_cast<std::size_t>(joints_[i])]);
            out.joints[i] = glm::dvec3(seen_from(stance_, turn_, {disk.x + p.x, disk.y + p.y}), p.z);
        }
        const glm::quat& root = skeleton_.rotations_at(frame)[static_cast<std::size_t>(skeleton_.root)];
        out.root = glm::normalize(about_up_ * glm::dquat(root));
    }

  private:
    const mobb::Clip& clip_;
    const Skeleton& skeleton_;
    const std::vector<int>& joints_;
    const Stance& stance_;
    mobb::Rotation turn_;
    glm::dquat about_up_;
};

BodyPose turned(BodyPose pose, const mobb::Rotation& turn) {
    for (glm::dvec3& p : pose.joints) p = glm::dvec3(turn({p.x, p.y}), p.z);
    pose.root = about_up(turn) * pose.root;
    return pose;
}

Stand seen_from(const Stance& stance, int joint, std::vector<glm::dvec2> places) {
    const mobb::Rotation turn = mobb::Rotation::from_degrees(-stance.heading_deg);
    for (glm::dvec2& place : places) place = seen_from(stance, turn, place);
    return {joint, std::move(places)};
}

/// A join as it is played, and how often.
struct Join {
    int before;
    int after;
    double turn_deg = 0;
    std::size_t times = 1;
};

class Measurer {
  public:
    Measurer(const Scene& scene, Importer& importer) {
        const std::vector<int> rigs = rig_of_each_clip(scene);
        std::vector<std::vector<Contact>> stands;  // by move
        motions_.reserve(scene.graph->moves.size());
        for (const GraphMove& move : scene.graph->moves) {
            const SceneClip& clip = scene.clips[static_cast<std::size_t>(move.clip)];
            motions_.emplace_back();
            stands.emplace_back();
            // Skeletons that are made here are held one at a time.
            const int of = clip_with_joints(scene, move);
            const SceneClip& straight = scene.clips[static_cast<std::size_t>(of)];
            if (!straight.skeleton || (of != move.clip && !clip.turn)) continue;
            const std::shared_ptr<const Skeleton> skeleton =
                of == move.clip ? clip.skeleton : turned_skeleton(*straight.skeleton, *straight.clip, *clip.turn);
            const std::optional<std::size_t> same = recorded_alike(scene, move, stands.size() - 1);
            stands.back() = same ? stands[*same] : stands_in(scene, move, *skeleton, importer);
            motions_.back() = motion_of(*clip.clip, *skeleton, rigs[static_cast<std::size_t>(of)], move.entry,
                                        move.exit, stands.back());
        }
    }

    /// Every join is between two moves of the graph. `moves`: those whose contacts count.
    Continuity measure(const std::vector<Join>& joins, const std::vector<int>& moves) const {
        limit_worker_threads();
        Continuity out = tbb::parallel_reduce(
            tbb::blocked_range<std::size_t>(0, joins.size()), Continuity{},
            [&](const tbb::blocked_range<std::size_t>& range, Continuity so_far) {
                for (std::size_t i = range.begin(); i < range.end(); ++i) add(joins[i], so_far);
                return so_far;
            },
            [](Continuity first, const Continuity& then) {
                add(then, first);
                return first;
            });
        add_contacts(moves, out);
        return out;
    }

  private:
    /// The move that a turned one is a variant of, if it is among the first `known` and warps the same part of the same
    /// recording: feet stand alike there, and it is read once.
    static std::optional<std::size_t> recorded_alike(const Scene& scene, const GraphMove& move, std::size_t known) {
        if (!move.turned || static_cast<std::size_t>(move.turned->move) >= known) return std::nullopt;
        const auto origin = static_cast<std::size_t>(move.turned->move);
        const SceneClip& clip = scene.clips[static_cast<std::size_t>(move.clip)];
        const SceneClip& other = scene.clips[static_cast<std::size_t>(scene.graph->moves[origin].clip)];
        const bool alike = clip.warp && other.warp && other.skeleton && clip.source == other.source &&
                           clip.options == other.options && clip.clip->count() == other.clip->count() &&
                           clip.clip->dt() == other.clip->dt();
        return alike ? std::optional(origin) : std::nullopt;
    }

    /// Feet stand where they do in the recording: those that a warp makes slide still should.
    static std::vector<Contact> stands_in(const Scene& scene, const GraphMove& move, const Skeleton& skeleton,
                                          Importer& importer) {
        const SceneClip& clip = scene.clips[static_cast<std::size_t>(move.clip)];
        if (!clip.warp) return standing(*clip.clip, skeleton, 0, clip.clip->count());
        const RecordedMove recorded = recorded_move(scene, move, importer);
        return standing(*recorded.clip, *recorded.skeleton, recorded.entry, recorded.exit);
    }

    void add(const Join& join, Continuity& to) const {
        to.joins += join.times;
        const auto& before = motions_[static_cast<std::size_t>(join.before)];
        const auto& after = motions_[static_cast<std::size_t>(join.after)];
        if (!before || !after || before->rig != after->rig || before->dt != after->dt) return;
        to.measured += join.times;
        ++to.different;
        const LargestChanges across = changes_across(*before, *after, join.turn_deg);
        bool is_over = false;
        for (std::size_t c = 0; c < kChanges.size(); ++c) {
            LargestRatio at_join = largest_ratio(c, across[c], *before, *after);
            at_join.before = join.before;
            at_join.after = join.after;
            at_join.over = at_join.ratio > kMostRatio ? join.times : 0;
            is_over = is_over || (kChanges[c].bounded && at_join.over > 0);
            take_larger(at_join, to.largest[c]);
        }
        if (is_over) to.over += join.times;
        take_larger(slide_across(join, *before, *after), to.across);
    }

    static LargestRatio largest_ratio(std::size_t change, const std::vector<double>& across, const MoveMotion& before,
                                      const MoveMotion& after) {
        LargestRatio out;
        for (std::size_t j = 0; j < across.size(); ++j) {
            const double inside = std::max({before.inside[change][j], after.inside[change][j], kChanges[change].least});
            const double ratio = across[j] / inside;
            if (out.joint >= 0 && ratio <= out.ratio) continue;
            out.ratio = ratio;
            out.across = across[j];
            out.inside = inside;
            out.joint = before.joints[j];
        }
        return out;
    }

    static LargestSlide slide_across(const Join& join, const MoveMotion& before, const MoveMotion& after) {
        const mobb::Rotation turn = mobb::Rotation::from_degrees(join.turn_deg);
        LargestSlide out;
        for (const Stand& last : before.stand_last) {
            for (const Stand& first : after.stand_first) {
                if (first.joint != last.joint) continue;
                std::vector<glm::dvec2> places = last.places;
                for (const glm::dvec2& place : first.places) places.push_back(turn(place));
                if (!lasts(static_cast<int>(places.size()), before.dt)) continue;
                take_larger({slide_of(places), last.joint, join.before, join.after}, out);
            }
        }
        return out;
    }

    void add_contacts(const std::vector<int>& moves, Continuity& to) const {
        std::vector<double> slides;
        for (const int move : moves) {
            const auto& motion = motions_[static_cast<std::size_t>(move)];
            if (!motion) continue;
            for (std::size_t i = 0; i < motion->slides.size(); ++i) {
                slides.push_back(motion->slides[i]);
                take_larger({motion->slides[i], motion->slide_joints[i], move, -1}, to.within);
            }
        }
        to.contacts = slides.size();
        if (slides.empty()) return;
        to.median_slide = median(std::move(slides));
    }

    static void add(const Continuity& more, Continuity& to) {
        to.joins += more.joins;
        to.measured += more.measured;
        to.different += more.different;
        to.over += more.over;
        for (std::size_t c = 0; c < kChanges.size(); ++c) take_larger(more.largest[c], to.largest[c]);
        take_larger(more.across, to.across);
    }

    // Of equal ones the first stays, so the number of threads does not matter.
    static void take_larger(const LargestRatio& other, LargestRatio& largest) {
        const std::size_t over = largest.over + other.over;
        if (other.before >= 0 && (largest.before < 0 || other.ratio > largest.ratio)) largest = other;
        largest.over = over;
    }
    static void take_larger(const LargestSlide& other, LargestSlide& largest) {
        if (other.joint >= 0 && (largest.joint < 0 || other.metres > largest.metres)) largest = other;
    }

    std::vector<std::optional<MoveMotion>> motions_;  ///< by move
};

/// How far an agent turns on the spot between two plays.
double turn_between(const MotionGraph& graph, const Play& before, const Play& after) {
    const double straight_on = before.placement.rotate_deg +
                               graph.moves[static_cast<std::size_t>(before.move)].exit.heading_deg -
                               graph.moves[static_cast<std::size_t>(after.move)].entry.heading_deg;
    return std::remainder(after.placement.rotate_deg - straight_on, 360.0);
}

/// The joins of one kind, those that are alike once.
class JoinsOfRun {
  public:
    void add(const Join& join) {
        constexpr double kSteps = 1e3;  // of a degree: what differs less is one turn
        const auto key = std::tuple(join.before, join.after, std::llround(join.turn_deg * kSteps));
        const auto [at, is_new] = known_.try_emplace(key, joins_.size());
        is_new ? joins_.push_back(join) : static_cast<void>(++joins_[at->second].times);
    }
    const std::vector<Join>& joins() const { return joins_; }

  private:
    std::map<std::tuple<int, int, long long>, std::size_t> known_;
    std::vector<Join> joins_;
};

}  // namespace

MoveMotion motion_of(const mobb::Clip& clip, const Skeleton& skeleton, int rig, const Stance& entry, const Stance& exit,
                     const std::vector<Contact>& stands) {
    MoveMotion out;
    out.dt = clip.dt();
    out.rig = rig;
    out.joints = body_of(skeleton);
    const int count = clip.count();
    const auto read = [&](std::vector<BodyPose>& poses, int first, int end, const Stance& from) {
        const PoseReader reader(clip, skeleton, out.joints, from);
        for (int frame = first; frame < end; ++frame) reader.read(frame, poses.emplace_back());
    };
    read(out.begin, 0, std::min(count, 2), entry);
    read(out.end, std::max(0, count - 2), count, exit);
    out.inside = no_changes(out.joints.size());
    const Stance clips_own;
    const PoseReader reader(clip, skeleton, out.joints, clips_own);
    std::array<BodyPose, 3> last;  // by frame
    for (int frame = 0; frame < count; ++frame) {
        const auto before = [&](int frames) -> BodyPose& {
            return last[static_cast<std::size_t>(frame + 3 - frames) % 3];
        };
        reader.read(frame, before(0));
        if (frame > 0) raise_by_step(out.inside, before(1), before(0));
        if (frame > 1) raise_by_two_steps(out.inside, before(2), before(1), before(0), out.dt);
    }
    out.inside = lengths(std::move(out.inside));
    for (const Contact& contact : stands) {
        std::vector<glm::dvec2> places = places_of(contact, clip, skeleton);
        if (lasts(contact.count, out.dt)) {
            out.slides.push_back(slide_of(places));
            out.slide_joints.push_back(contact.joint);
        }
        if (contact.first == 0) out.stand_first.push_back(seen_from(entry, contact.joint, places));
        if (contact.first + contact.count == count)
            out.stand_last.push_back(seen_from(exit, contact.joint, std::move(places)));
    }
    return out;
}

LargestChanges changes_across(const MoveMotion& before, const MoveMotion& after, double turn_deg) {
    const mobb::Rotation turn = mobb::Rotation::from_degrees(turn_deg);
    std::vector<BodyPose> poses = before.end;
    for (const BodyPose& pose : after.begin) poses.push_back(turned(pose, turn));
    LargestChanges out = no_changes(before.joints.size());
    raise_by_step(out, before.end.back(), poses[before.end.size()]);
    for (std::size_t i = 2; i < poses.size(); ++i)
        raise_by_two_steps(out, poses[i - 2], poses[i - 1], poses[i], before.dt);
    return lengths(std::move(out));
}

bool promises_continuity(const Scene& scene) {
    return std::ranges::all_of(scene.graph->moves, [&](const GraphMove& move) {
        return scene.clips[static_cast<std::size_t>(move.clip)].warp != nullptr;
    });
}

Continuity graph_continuity(const Scene& scene) {
    std::vector<Join> joins;
    for (const auto& [before, after] : transitions_of(*scene.graph)) joins.push_back({before, after});
    std::vector<int> moves(scene.graph->moves.size());
    for (std::size_t i = 0; i < moves.size(); ++i) moves[i] = static_cast<int>(i);
    Importer importer;
    return Measurer(scene, importer).measure(joins, moves);
}

int clip_with_joints(const Scene& scene, const GraphMove& move) {
    if (!move.turned || scene.clips[static_cast<std::size_t>(move.clip)].skeleton) return move.clip;
    return scene.graph->moves[static_cast<std::size_t>(move.turned->move)].clip;
}

std::vector<bool> joins_over(const Scene& scene, const std::vector<std::pair<int, int>>& transitions) {
    Importer importer;
    const Measurer measurer(scene, importer);
    std::vector<bool> out;
    for (const auto& [before, after] : transitions) out.push_back(measurer.measure({{before, after}}, {}).over > 0);
    return out;
}

RunContinuity run_continuity(const Scene& scene, Importer& importer) {
    JoinsOfRun free;
    JoinsOfRun forced;
    std::vector<int> moves;
    for (const CrowdAgent& agent : scene.crowd->agents) {
        for (std::size_t i = 0; i < agent.plays.size(); ++i) {
            moves.push_back(agent.plays[i].move);
            if (i == 0) continue;
            const Play& before = agent.plays[i - 1];
            const Play& after = agent.plays[i];
            (after.kind == PlayKind::forced ? forced : free)
                .add({before.move, after.move, turn_between(*scene.graph, before, after)});
        }
    }
    std::sort(moves.begin(), moves.end());
    moves.erase(std::unique(moves.begin(), moves.end()), moves.end());
    const Measurer measurer(scene, importer);
    return {measurer.measure(free.joins(), moves), measurer.measure(forced.joins(), {})};
}

}  // namespace mobbscope
