#include <base/text.h>
#include <import/skeleton/motion.h>
#include <scene/clip_turn.h>
#include <scene/motion_graph.h>
#include <scene/scene.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <utility>
#include <vector>

namespace mobbscope {

namespace {

constexpr double kSteepest = 1.5;  // of smoothstep: its slope in the middle

glm::dvec2 place_of(const mobb::Disk& disk) { return {disk.x, disk.y}; }

/// The way from sample `i` to the next as it is in the bent clip.
glm::dvec2 bent_step(const ClipTurn& turn, double dt, int i, glm::dvec2 step) {
    return mobb::Rotation::from_degrees(turn.at((i + 0.5) * dt))(step);
}

}  // namespace

double ClipTurn::at(double time) const {
    const double done = std::clamp(time / seconds, 0.0, 1.0);
    return deg * done * done * (3 - 2 * done);
}

ClipTurn turn_at_rate(double deg, double rate) { return {deg, kSteepest * std::abs(deg) / rate}; }

mobb::ClipPtr bent(const mobb::Clip& clip, const ClipTurn& turn) {
    std::vector<mobb::Disk> disks(clip.samples().begin(), clip.samples().end());
    for (int i = 0; i + 1 < clip.count(); ++i) {
        const auto from = static_cast<std::size_t>(i);
        const glm::dvec2 step = place_of(clip.samples()[from + 1]) - place_of(clip.samples()[from]);
        const glm::dvec2 to = place_of(disks[from]) + bent_step(turn, clip.dt(), i, step);
        disks[from + 1].x = to.x;
        disks[from + 1].y = to.y;
    }
    return std::make_shared<const mobb::Clip>(clip.dt(), std::move(disks), clip.motion());
}

Stance bent_exit(const mobb::Clip& clip, const mobb::Clip& bent_clip, const Stance& exit, const ClipTurn& turn) {
    const glm::dvec2 step = exit.position - place_of(clip.samples().back());
    return {place_of(bent_clip.samples().back()) + bent_step(turn, clip.dt(), clip.count() - 1, step),
            exit.heading_deg + turn.deg};
}

std::shared_ptr<const Skeleton> turned_skeleton(const Skeleton& skeleton, const mobb::Clip& clip,
                                                const ClipTurn& turn) {
    auto out = std::make_shared<Skeleton>(skeleton);
    const std::size_t joints = skeleton.joints.size();
    for (int sample = 0; sample < clip.count(); ++sample) {
        const mobb::Rotation by = mobb::Rotation::from_degrees(turn.at(sample * clip.dt()));
        const glm::quat about(about_up(by));
        const std::size_t first = static_cast<std::size_t>(sample) * joints;
        for (std::size_t j = first; j < first + joints; ++j) {
            glm::vec3& position = out->positions[j];
            const glm::dvec2 aside = by({position.x, position.y});
            position = {aside.x, aside.y, position.z};
            out->rotations[j] = about * out->rotations[j];
        }
    }
    return out;
}

void bend(SceneClip& clip, const ClipTurn& turn) {
    // Of a linear clip a crowd's turn may go on until the next one begins.
    if (turn.seconds > clip.clip->until_next()) {
        throw std::invalid_argument("a turn of " + brief(turn.seconds) + " s does not fit into a clip of " +
                                    brief(clip.clip->until_next()) + " s; give fewer seconds, or leave the turn out");
    }
    mobb::ClipPtr bent_clip = bent(*clip.clip, turn);
    if (clip.skeleton) clip.skeleton = turned_skeleton(*clip.skeleton, *clip.clip, turn);
    for (std::size_t i = 0; i < clip.headings.size(); ++i)
        clip.headings[i] += turn.at(static_cast<double>(i) * bent_clip->dt());
    clip.clip = std::move(bent_clip);
    clip.turn = turn;
}

}  // namespace mobbscope
