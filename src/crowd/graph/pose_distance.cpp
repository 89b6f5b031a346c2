#include <crowd/graph/pose_distance.h>

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace mobbscope {

namespace {

constexpr double kWindowStep = 2.0 / 30;  // seconds between the frames of a moment

/// Sums of squares of the differences of two poses.
double squares_between(const PoseTrack& a, int frame_a, glm::dvec2 from_a, const mobb::Rotation& turn_a,
                       const PoseTrack& b, int frame_b, glm::dvec2 from_b, const mobb::Rotation& turn_b) {
    const auto pose_a = a.at(frame_a);
    const auto pose_b = b.at(frame_b);
    const glm::dvec2 root_a = a.root[static_cast<std::size_t>(frame_a)] - from_a;
    const glm::dvec2 root_b = b.root[static_cast<std::size_t>(frame_b)] - from_b;
    double sum = 0;
    for (std::size_t i = 0; i < pose_a.size(); ++i) {
        const glm::dvec2 floor = turn_a(root_a + glm::dvec2(pose_a[i])) - turn_b(root_b + glm::dvec2(pose_b[i]));
        const double height = double{pose_a[i].z} - double{pose_b[i].z};
        sum += floor.x * floor.x + floor.y * floor.y + height * height;
    }
    return sum;
}

}  // namespace

std::array<int, kWindowFrames> window_offsets(double dt) {
    std::array<int, kWindowFrames> out{};
    for (std::size_t i = 0; i < kWindowFrames; ++i) {
        const int k = static_cast<int>(i) - static_cast<int>(kWindowFrames / 2);
        out[i] = static_cast<int>(std::lround(std::min(k * kWindowStep / dt, 1e6)));
    }
    return out;
}

PoseWindows::PoseWindows(const PoseTrack& track) : size_(track.joints * kWindowFrames) {
    const auto offsets = window_offsets(track.dt);
    reach_ = offsets.back();
    end_ = track.frames() - reach_;
    for (int frame = reach_; frame < end_; ++frame) {
        const std::size_t first = points_.size();
        points_.resize(first + 3 * size_);
        float* to = points_.data() + first;
        double squares = 0;
        for (const int offset : offsets) {
            const int at_frame = frame + offset;
            const glm::vec2 root{track.root[static_cast<std::size_t>(at_frame)] -
                                 track.root[static_cast<std::size_t>(frame)]};
            for (const glm::vec3& p : track.at(at_frame)) {
                const glm::vec3 at{p.x + root.x, p.y + root.y, p.z};
                to[0] = at.x;
                to[size_] = at.y;
                to[2 * size_] = at.z;
                squares += double{at.x} * at.x + double{at.y} * at.y + double{at.z} * at.z;
                ++to;
            }
        }
        squares_.push_back(squares);
    }
}

Alignment PoseWindows::compare(const PoseWindows& a, int frame_a, const PoseWindows& b, int frame_b) {
    const std::size_t n = a.size_;
    const float* p = a.moment(frame_a).data();
    const float* q = b.moment(frame_b).data();
    double along = 0, across = 0, up = 0;
    for (std::size_t i = 0; i < n; ++i) {
        const double ax = p[i];
        const double ay = p[n + i];
        const double bx = q[i];
        const double by = q[n + i];
        along += ax * bx + ay * by;
        across += bx * ay - by * ax;
        up += double{p[2 * n + i]} * q[2 * n + i];
    }
    // |a - R(t) b|^2 summed is least where R(t) b has the most of a: at t = atan2(across, along).
    const double squares = a.squares_[static_cast<std::size_t>(frame_a - a.reach_)] +
                           b.squares_[static_cast<std::size_t>(frame_b - b.reach_)] -
                           2 * (std::hypot(along, across) + up);
    return {std::sqrt(std::max(squares, 0.0) / static_cast<double>(n)),
            std::atan2(across, along) * 180 / std::numbers::pi};
}

double joined_distance(const PoseTrack& a, int frame_a, double heading_a, const PoseTrack& b, int frame_b,
                       double heading_b) {
    const mobb::Rotation turn_a = mobb::Rotation::from_degrees(-heading_a);
    const mobb::Rotation turn_b = mobb::Rotation::from_degrees(-heading_b);
    const auto has = [](const PoseTrack& track, int frame) { return frame >= 0 && frame < track.frames(); };
    const int near_a = std::clamp(frame_a, 0, a.frames() - 1);
    const int near_b = std::clamp(frame_b, 0, b.frames() - 1);
    const glm::dvec2 from_a = a.root[static_cast<std::size_t>(near_a)];
    const glm::dvec2 from_b = b.root[static_cast<std::size_t>(near_b)];
    double sum = 0;
    std::size_t poses = 0;
    if (has(a, frame_a)) {
        for (const int offset : window_offsets(a.dt)) {
            if (!has(a, frame_a + offset) || !has(b, frame_b + offset)) continue;
            sum += squares_between(a, frame_a + offset, from_a, turn_a, b, frame_b + offset, from_b, turn_b);
            ++poses;
        }
    }
    if (poses == 0) {
        sum = squares_between(a, near_a, from_a, turn_a, b, near_b, from_b, turn_b);
        poses = 1;
    }
    return std::sqrt(sum / static_cast<double>(poses * a.joints));
}

PoseTrack pose_track(const mobb::Clip& clip, const Skeleton& skeleton, int rig, std::span<const std::size_t> joints) {
    PoseTrack out;
    out.dt = clip.dt();
    out.rig = rig;
    out.joints = joints.size();
    out.points.reserve(joints.size() * clip.samples().size());
    for (int i = 0; i < clip.count(); ++i) {
        const mobb::Disk& disk = clip.samples()[static_cast<std::size_t>(i)];
        out.root.emplace_back(disk.x, disk.y);
        const auto pose = skeleton.at(i);
        for (const std::size_t joint : joints) out.points.push_back(pose[joint]);
    }
    return out;
}

}  // namespace mobbscope
