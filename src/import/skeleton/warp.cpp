#include <base/text.h>
#include <import/skeleton/disk_sampler.h>
#include <import/skeleton/warp.h>

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <utility>

namespace mobbscope {

namespace {

// Frames that a displacement must last so that it can be given a velocity, and an acceleration too.
constexpr double kFramesOfVelocity = 2;
constexpr double kFramesOfAcceleration = 4;

/// Axis times angle in radians, the shorter way round.
glm::dvec3 turn_of(glm::dquat q) {
    if (q.w < 0) q = -q;
    const glm::dvec3 v(q.x, q.y, q.z);
    const double sine = glm::length(v);
    return sine < 1e-12 ? 2.0 * v : v * (2 * std::atan2(sine, q.w) / sine);
}

glm::dquat turned_by(const glm::dvec3& turn) {
    const double angle = glm::length(turn);
    return angle < 1e-12 ? glm::normalize(glm::dquat(1, turn / 2.0)) : glm::angleAxis(angle, turn / angle);
}

glm::dvec3 on_floor(const mobb::Disk& disk, double height) { return {disk.x, disk.y, height}; }

/// For each joint the one that it hangs on; of the root -1.
std::vector<int> joints_above(const Skeleton& skeleton) {
    const std::vector<bool> below = subtree(skeleton.joints, skeleton.root);
    std::vector<int> out;
    for (std::size_t i = 0; i < skeleton.joints.size(); ++i) {
        const bool is_root = static_cast<int>(i) == skeleton.root;
        out.push_back(is_root ? -1 : below[i] ? skeleton.joints[i].parent : skeleton.root);
    }
    return out;
}

/// One frame, its root apart.
struct HangingPose {
    glm::dvec3 root;                   ///< in the clip
    std::vector<HangingJoint> joints;  ///< without their spin
};

HangingPose hanging(const mobb::Clip& clip, const Skeleton& skeleton, const std::vector<int>& above, int frame,
                    double heading_deg) {
    const auto positions = skeleton.at(frame);
    const auto rotations = skeleton.rotations_at(frame);
    const auto root = static_cast<std::size_t>(skeleton.root);
    HangingPose out{on_floor(clip.samples()[static_cast<std::size_t>(frame)], positions[root].z), {}};
    for (std::size_t i = 0; i < above.size(); ++i) {
        const glm::dquat own(rotations[i]);
        if (above[i] < 0) {
            out.joints.push_back({glm::normalize(about_up(mobb::Rotation::from_degrees(-heading_deg)) * own)});
            continue;
        }
        const auto on = static_cast<std::size_t>(above[i]);
        const glm::dquat back = glm::inverse(glm::dquat(rotations[on]));
        out.joints.push_back({glm::normalize(back * own), {}, back * glm::dvec3(positions[i] - positions[on])});
    }
    return out;
}

/// A displacement that is given in the first frames and fades to nothing.
class Fade {
  public:
    Fade() = default;  ///< none
    /// In the first frame and a step later.
    Fade(const glm::dvec3& first, const glm::dvec3& second, double step, double seconds)
        : first_(first), seconds_(seconds) {
        const double s = step / seconds;
        if (s * kFramesOfVelocity <= 1) slope_ = (second - first * value(s)) / slope(s);
    }

    /// In the first frame, a step and two steps later.
    Fade(const glm::dvec3& first, const glm::dvec3& second, const glm::dvec3& third, double step, double seconds)
        : Fade(first, second, step, seconds) {
        const double s = step / seconds;
        if (s * kFramesOfAcceleration > 1) return;
        const glm::dvec3 left = second - first * value(s);
        const glm::dvec3 left_later = third - first * value(2 * s);
        const double determinant = slope(s) * curve(2 * s) - curve(s) * slope(2 * s);
        slope_ = (left * curve(2 * s) - left_later * curve(s)) / determinant;
        curve_ = (left_later * slope(s) - left * slope(2 * s)) / determinant;
    }

    /// `t` seconds from the end of the clip, less than the fade lasts.
    glm::dvec3 at(double t) const {
        const double s = t / seconds_;
        return first_ * value(s) + slope_ * slope(s) + curve_ * curve(s);
    }

  private:
    // Of the quintic Hermite polynomials those of value, slope and second derivative at 0; the last without its factor.
    static double value(double s) { return (1 - s) * (1 - s) * (1 - s) * (1 + 3 * s + 6 * s * s); }
    static double slope(double s) { return s * (1 - s) * (1 - s) * (1 - s) * (1 + 3 * s); }
    static double curve(double s) { return s * s * (1 - s) * (1 - s) * (1 - s); }

    glm::dvec3 first_{0};
    glm::dvec3 slope_{0};
    glm::dvec3 curve_{0};
    double seconds_ = 1;
};

/// What one end of a clip is displaced by.
class EndDisplacement {
  public:
    /// `frame` is to be in the pose; `inwards` is 1 at the begin and -1 at the end.
    EndDisplacement(const mobb::Clip& clip, const Skeleton& skeleton, const std::vector<int>& above, int frame,
                    int inwards, const WarpEnd& to, double seconds)
        : heading_deg_(to.heading_deg), seconds_(seconds) {
        const double dt = clip.dt();
        const HangingPose own = hanging(clip, skeleton, above, frame, heading_deg_);
        const HangingPose next = hanging(clip, skeleton, above, frame + inwards, heading_deg_);
        const int third = std::clamp(frame + 2 * inwards, 0, clip.count() - 1);
        const glm::dvec3 after_next = hanging(clip, skeleton, above, third, heading_deg_).root;
        const glm::dvec3 step =
            about_up(mobb::Rotation::from_degrees(heading_deg_)) * (to.pose->velocity * (inwards * dt));
        const glm::dvec3 target(own.root.x, own.root.y, to.pose->height);
        // The root goes on evenly for two frames, so its velocity does not change where moves join.
        root_ = Fade(target - own.root, target + step - next.root, target + 2.0 * step - after_next, dt, seconds);
        for (std::size_t i = 0; i < above.size(); ++i) {
            const HangingJoint& joint = to.pose->joints[i];
            const glm::dquat later = turned_by(joint.spin * (inwards * dt)) * joint.rotation;
            turns_.emplace_back(turn_of(joint.rotation * glm::inverse(own.joints[i].rotation)),
                                turn_of(later * glm::inverse(next.joints[i].rotation)), dt, seconds);
            // A bone is as long a step later.
            const glm::dvec3 longer = joint.offset - own.joints[i].offset;
            offsets_.emplace_back(longer, longer, dt, seconds);
        }
    }

    double seconds() const { return seconds_; }
    double heading_deg() const { return heading_deg_; }

    void displace(HangingPose& pose, double t) const {
        pose.root += root_.at(t);
        for (std::size_t i = 0; i < pose.joints.size(); ++i) {
            HangingJoint& joint = pose.joints[i];
            joint.rotation = glm::normalize(turned_by(turns_[i].at(t)) * joint.rotation);
            joint.offset += offsets_[i].at(t);
        }
    }

  private:
    double heading_deg_;
    double seconds_;
    Fade root_;
    std::vector<Fade> turns_;
    std::vector<Fade> offsets_;
};

/// Joints from the pose, their places counted from the root on the floor.
void put_together(const HangingPose& pose, const std::vector<int>& above, int root, double heading_deg,
                  std::vector<glm::dvec3>& positions, std::vector<glm::dquat>& rotations) {
    const auto at = static_cast<std::size_t>(root);
    positions[at] = {0, 0, pose.root.z};
    rotations[at] = about_up(mobb::Rotation::from_degrees(heading_deg)) * pose.joints[at].rotation;
    for (std::size_t i = 0; i < above.size(); ++i) {
        if (above[i] < 0) continue;
        const auto on = static_cast<std::size_t>(above[i]);
        positions[i] = positions[on] + rotations[on] * pose.joints[i].offset;
        rotations[i] = rotations[on] * pose.joints[i].rotation;
    }
}

}  // namespace

MovingPose moving_pose(const mobb::Clip& clip, const Skeleton& skeleton, int frame, double heading_deg) {
    const std::vector<int> above = joints_above(skeleton);
    const HangingPose before = hanging(clip, skeleton, above, frame - 1, heading_deg);
    const HangingPose after = hanging(clip, skeleton, above, frame + 1, heading_deg);
    HangingPose now = hanging(clip, skeleton, above, frame, heading_deg);
    const double seconds = 2 * clip.dt();
    for (std::size_t i = 0; i < above.size(); ++i) {
        now.joints[i].spin = turn_of(after.joints[i].rotation * glm::inverse(before.joints[i].rotation)) / seconds;
    }
    const glm::dvec3 velocity =
        about_up(mobb::Rotation::from_degrees(-heading_deg)) * ((after.root - before.root) / seconds);
    return {now.root.z, velocity, std::move(now.joints)};
}

MovingPose mean(std::span<const MovingPose> poses) {
    const auto count = static_cast<double>(poses.size());
    MovingPose out;
    out.joints.resize(poses.front().joints.size(), {glm::dquat(0, 0, 0, 0)});
    for (const MovingPose& pose : poses) {
        out.height += pose.height / count;
        out.velocity += pose.velocity / count;
        for (std::size_t i = 0; i < out.joints.size(); ++i) {
            const HangingJoint& joint = pose.joints[i];
            // A quaternion and its negative are one rotation.
            const bool opposite = glm::dot(joint.rotation, poses.front().joints[i].rotation) < 0;
            out.joints[i].rotation = out.joints[i].rotation + (opposite ? -joint.rotation : joint.rotation);
            out.joints[i].spin += joint.spin / count;
            out.joints[i].offset += joint.offset / count;
        }
    }
    for (HangingJoint& joint : out.joints) joint.rotation = glm::normalize(joint.rotation);
    return out;
}

WarpedClip warped(const mobb::Clip& clip, const Skeleton& skeleton, const ClipWarp& warp, bool keep_radii) {
    const std::size_t joints = skeleton.joints.size();
    const auto root = static_cast<std::size_t>(skeleton.root);
    for (const WarpEnd* end : {&warp.begin, &warp.end}) {
        const std::vector<HangingJoint>& of_pose = end->pose->joints;
        if (of_pose.size() != joints) {
            throw std::invalid_argument("the pose " + end->name + " has " + std::to_string(of_pose.size()) +
                                        " joints, the skeleton " + std::to_string(joints));
        }
        // The root alone lies on what it hangs on.
        if (of_pose[root].offset != glm::dvec3(0)) {
            throw std::invalid_argument("the pose " + end->name + " has another root than " +
                                        in_quotes(skeleton.joints[root].name) +
                                        "; take the root that it was made with");
        }
    }
    const int count = clip.count() - 1;
    const double duration = count * clip.dt();
    const double seconds = std::min(warp.seconds, duration / 2);
    const std::vector<int> above = joints_above(skeleton);
    const std::vector<bool> below = subtree(skeleton.joints, skeleton.root);
    const EndDisplacement begin(clip, skeleton, above, 0, 1, warp.begin, seconds);
    const EndDisplacement end(clip, skeleton, above, count, -1, warp.end, seconds);

    std::vector<mobb::Disk> disks(clip.samples().begin(), clip.samples().end() - 1);
    auto body = std::make_shared<Skeleton>(skeleton);
    body->positions.resize(static_cast<std::size_t>(count) * joints);
    body->rotations.resize(static_cast<std::size_t>(count) * joints);
    std::vector<glm::dvec3> positions(joints);
    std::vector<glm::dquat> rotations(joints);
    for (int frame = 0; frame < count; ++frame) {
        const double since = frame * clip.dt();
        const bool at_begin = since < begin.seconds();
        const double t = at_begin ? since : (count - frame) * clip.dt();
        const EndDisplacement& by = at_begin ? begin : end;
        if (t >= by.seconds()) continue;
        HangingPose pose = hanging(clip, skeleton, above, frame, by.heading_deg());
        by.displace(pose, t);
        put_together(pose, above, skeleton.root, by.heading_deg(), positions, rotations);
        const auto sample = static_cast<std::size_t>(frame);
        disks[sample] = {pose.root.x, pose.root.y, keep_radii ? disks[sample].r : ground_reach(positions, root, below)};
        std::copy(positions.begin(), positions.end(),
                  body->positions.begin() + static_cast<std::ptrdiff_t>(sample * joints));
        std::copy(rotations.begin(), rotations.end(),
                  body->rotations.begin() + static_cast<std::ptrdiff_t>(sample * joints));
    }
    return {std::make_shared<const mobb::Clip>(clip.dt(), std::move(disks), clip.motion()), std::move(body)};
}

}  // namespace mobbscope
