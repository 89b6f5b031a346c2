#include <base/text.h>
#include <import/clip/sampling.h>
#include <import/skeleton/disk_sampler.h>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace mobbscope {

namespace {

// What a joint that stands still may seem to move, as a share of the body's size: rounding of poses held in floats.
constexpr double kStandstill = 1e-5;

/// The topmost joint, its only child joint, and so on while there is but one and the joint above is no pivot.
std::vector<std::size_t> only_children(const Motion& motion) {
    const std::span<const Joint> joints = motion.joints();
    std::vector<int> count(joints.size(), 0);
    std::vector<std::size_t> child(joints.size(), 0);
    for (std::size_t i = 0; i < joints.size(); ++i) {
        if (joints[i].parent < 0 || joints[i].end_site) continue;
        const auto parent = static_cast<std::size_t>(joints[i].parent);
        ++count[parent];
        child[parent] = i;
    }
    std::vector<std::size_t> chain{static_cast<std::size_t>(motion.topmost())};
    while (count[chain.back()] == 1 && !motion.is_pivot(static_cast<int>(chain.back()))) {
        chain.push_back(child[chain.back()]);
    }
    return chain;
}

constexpr double kSurveyRate = 30;
constexpr double kMaxSurvey = 10'000;

}  // namespace

DiskSampler::DiskSampler(const GroundedMotion& motion, int root, double step)
    : motion_(motion), root_(static_cast<std::size_t>(root)), step_(step), inside_(subtree(motion.joints(), root)) {}

void DiskSampler::sample(double t, PosedDisk& out) {
    const MotionTimes& times = motion_.times();
    if (!times.frames_only) return take(on_key(t), out);
    const double frame = std::clamp((t - times.first) / *times.dt, 0.0, times.frames - 1.0);
    const double before = std::floor(frame + kFrameTolerance);
    const double share = frame - before;
    const PosedDisk& a = stored(static_cast<std::size_t>(before));
    if (share <= kFrameTolerance) {
        out = a;
        return;
    }
    const PosedDisk& b = stored(static_cast<std::size_t>(before) + 1);
    out.disk = mix(a.disk, b.disk, share);
    out.positions.resize(a.positions.size());
    for (std::size_t i = 0; i < out.positions.size(); ++i) {
        out.positions[i] = a.positions[i] + share * (b.positions[i] - a.positions[i]);
    }
    out.rotations.resize(a.rotations.size());
    for (std::size_t i = 0; i < out.rotations.size(); ++i) {
        out.rotations[i] = glm::slerp(a.rotations[i], b.rotations[i], share);
    }
}

double DiskSampler::on_key(double t) const {
    if (!motion_.times().keys) return t;
    const std::vector<double>& keys = *motion_.times().keys;
    const auto after = std::ranges::upper_bound(keys, t);
    const bool is_between = after != keys.begin() && after != keys.end();
    const double frame = is_between ? std::min(*after - *(after - 1), step_) : step_;
    if (after != keys.begin() && t - *(after - 1) <= kFrameTolerance * frame) return *(after - 1);
    if (after != keys.end() && *after - t <= kFrameTolerance * frame) return *after;
    return t;
}

void DiskSampler::take(double t, PosedDisk& out) const {
    motion_.pose(t, out.positions, &out.rotations);
    const glm::dvec3 centre = out.positions[root_];
    out.disk = {centre.x, centre.y, ground_reach(out.positions, root_, inside_)};
}

const PosedDisk& DiskSampler::stored(std::size_t frame) {
    Slot& slot = slots_[frame % slots_.size()];
    if (slot.frame != frame) {
        take(motion_.times().first + static_cast<double>(frame) * *motion_.times().dt, slot.posed);
        slot.frame = frame;
    }
    return slot.posed;
}

double ground_reach(std::span<const glm::dvec3> positions, std::size_t root, const std::vector<bool>& inside) {
    double reach = 0;
    for (std::size_t i = 0; i < positions.size(); ++i) {
        if (!inside[i]) continue;
        const glm::dvec3 arm = positions[i] - positions[root];
        reach = std::max(reach, std::hypot(arm.x, arm.y));
    }
    return reach;
}

std::vector<bool> subtree(std::span<const Joint> joints, int root) {
    std::vector<bool> inside(joints.size(), false);
    inside[static_cast<std::size_t>(root)] = true;
    for (std::size_t i = 0; i < joints.size(); ++i) {
        if (joints[i].parent >= 0 && inside[static_cast<std::size_t>(joints[i].parent)]) inside[i] = true;
    }
    return inside;
}

DefaultRoot default_root(const GroundedMotion& motion) {
    const std::vector<std::size_t> chain = only_children(motion.motion());
    if (chain.size() == 1) return {static_cast<int>(chain.front()), "the topmost joint"};

    std::vector<glm::dvec3> start;
    std::vector<glm::dvec3> now;
    motion.pose(motion.times().first, start);
    double size = 0;
    for (const glm::dvec3& p : start) size = std::max(size, glm::distance(p, start[chain.front()]));

    // One walk through the motion for the whole chain; `still` is how many of its joints have not moved so far.
    std::size_t still = chain.size();
    for (const double t : motion.survey()) {
        motion.pose(t, now);
        for (std::size_t i = 0; i < still; ++i) {
            const glm::dvec3 step = now[chain[i]] - start[chain[i]];
            if (std::hypot(step.x, step.y) > kStandstill * size) still = i;
        }
        if (still == 0) break;
    }
    const std::size_t taken = std::min(still, chain.size() - 1);
    const std::string above = in_quotes(motion.joints()[chain.front()].name);
    return {static_cast<int>(chain[taken]),
            taken == 0 ? "the topmost joint"
            : still == chain.size()
                ? "the first with several joints below it: " + above + " and those below it stand still"
                : "the topmost joint that moves: " + above + " stands still"};
}

std::size_t root_by_name(std::span<const NamedJoint> joints, const std::string& name) {
    std::vector<std::string> names;
    for (std::size_t i = 0; i < joints.size(); ++i) {
        if (joints[i].name.empty()) continue;
        if (joints[i].name == name) return i;
        names.push_back(joints[i].name);
    }
    throw std::invalid_argument("there is no joint " + in_quotes(name) + " for root; the nearest is " +
                                in_quotes(nearest(name, names)));
}

double median_height(const GroundedMotion& motion, int root) {
    const std::vector<bool> inside = subtree(motion.joints(), root);
    std::vector<glm::dvec3> positions;
    std::vector<double> heights;
    for (const double t : motion.survey()) {
        motion.pose(t, positions);
        double low = std::numeric_limits<double>::infinity();
        double high = -low;
        for (std::size_t i = 0; i < positions.size(); ++i) {
            if (!inside[i]) continue;
            low = std::min(low, positions[i].z);
            high = std::max(high, positions[i].z);
        }
        heights.push_back(high - low);
    }
    const auto middle = heights.begin() + static_cast<std::ptrdiff_t>(heights.size() / 2);
    std::nth_element(heights.begin(), middle, heights.end());
    if (heights.size() % 2 == 1) return *middle;
    return (*std::max_element(heights.begin(), middle) + *middle) / 2;
}

double height_of_limbs(const GroundedMotion& motion, int root) {
    constexpr double kHeightOfWay = 0.74;  // of people, with hands and without
    const std::vector<bool> inside = subtree(motion.joints(), root);
    const std::vector<double> times = motion.survey();
    std::vector<glm::dvec3> positions;
    motion.pose(times[times.size() / 2], positions);
    std::vector<double> down(positions.size(), 0);  // the longest way down from each joint
    double longest = 0;
    for (std::size_t i = positions.size(); i-- > static_cast<std::size_t>(root) + 1;) {
        if (!inside[i]) continue;
        const auto parent = static_cast<std::size_t>(motion.joints()[i].parent);
        const double way = down[i] + glm::distance(positions[i], positions[parent]);
        longest = std::max(longest, down[parent] + way);
        down[parent] = std::max(down[parent], way);
    }
    return kHeightOfWay * longest;
}

void GroundedMotion::pose(double seconds, std::vector<glm::dvec3>& positions,
                          std::vector<glm::dquat>* rotations) const {
    positions.resize(joints().size());
    if (rotations) rotations->resize(joints().size());
    motion_.pose(seconds, positions, rotations ? std::span(*rotations) : std::span<glm::dquat>{});
    if (rotations) turn(*rotations);
    for (std::size_t i = 0; i < positions.size(); ++i) {
        glm::dvec3& p = positions[i];
        if (!std::isfinite(p.x + p.y + p.z)) {
            throw std::invalid_argument("at " + format_double(seconds) + " s the joint " + in_quotes(joints()[i].name) +
                                        " is at no finite place; the file is damaged");
        }
        p = ground_ * p;
    }
}

std::vector<glm::dquat> GroundedMotion::rest() const {
    std::vector<glm::dquat> out = motion_.rest();
    turn(out);
    return out;
}

void GroundedMotion::turn(std::vector<glm::dquat>& rotations) const {
    // A mirrored rotation is none: the joints' own axes are mirrored in x then, so that it becomes one again.
    const bool mirrors = glm::determinant(ground_) < 0;
    const glm::dmat3 mirror{{mirrors ? -1 : 1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    const glm::dquat turned = glm::quat_cast(ground_ * mirror);
    for (glm::dquat& rotation : rotations) {
        if (mirrors) rotation = {rotation.w, rotation.x, -rotation.y, -rotation.z};
        rotation = turned * rotation;
    }
}

std::vector<double> GroundedMotion::survey() const {
    const MotionTimes& t = times();
    double step = t.frames_only ? *t.dt : 1 / kSurveyRate;
    double count = t.frames_only ? t.frames : sample_count(t.first, t.last, step);
    if (!t.frames_only && count > kMaxSurvey) {
        count = kMaxSurvey;
        step = (t.last - t.first) / (kMaxSurvey - 1);
    }
    std::vector<double> out(static_cast<std::size_t>(count));
    for (std::size_t i = 0; i < out.size(); ++i) out[i] = t.first + static_cast<double>(i) * step;
    return out;
}

}  // namespace mobbscope
