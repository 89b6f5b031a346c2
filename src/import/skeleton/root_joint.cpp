#include <base/text.h>
#include <import/skeleton/root_joint.h>

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
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

}  // namespace

std::vector<bool> subtree(std::span<const Joint> joints, int root) {
    std::vector<bool> inside(joints.size(), false);
    inside[static_cast<std::size_t>(root)] = true;
    for (std::size_t i = 0; i < joints.size(); ++i) {
        if (joints[i].parent >= 0 && inside[static_cast<std::size_t>(joints[i].parent)]) inside[i] = true;
    }
    return inside;
}

int default_root(const GroundedMotion& motion) {
    const std::vector<std::size_t> chain = only_children(motion.motion());
    if (chain.size() == 1) return static_cast<int>(chain.front());

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
    return static_cast<int>(chain[std::min(still, chain.size() - 1)]);
}

int root_by_name(std::span<const Joint> joints, const std::string& name) {
    std::vector<std::string> names;
    for (std::size_t i = 0; i < joints.size(); ++i) {
        if (joints[i].end_site) continue;
        if (joints[i].name == name) return static_cast<int>(i);
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

}  // namespace mobbscope
