#include <crowd/graph/pose_track.h>

#include <glm/geometric.hpp>

#include <algorithm>

namespace mobbscope {

namespace {

constexpr float kLeastBone = 0.1F;  // of the longest one

/// Two skeletons have the same if and only if their joints are the same.
std::string key_of(const Skeleton& skeleton) {
    std::string key;
    // A name may hold any byte but NUL.
    for (const Joint& joint : skeleton.joints) key += joint.name + '\0' + std::to_string(joint.parent) + '\0';
    return key + std::to_string(skeleton.root);
}

std::vector<std::size_t> joints_that_count(const Skeleton& skeleton) {
    const auto pose = skeleton.at(0);
    std::vector<float> bones(skeleton.joints.size(), 0);
    for (std::size_t i = 0; i < bones.size(); ++i) {
        const Joint& joint = skeleton.joints[i];
        if (joint.parent >= 0 && !joint.end_site) {
            bones[i] = glm::distance(pose[i], pose[static_cast<std::size_t>(joint.parent)]);
        }
    }
    const float longest = *std::max_element(bones.begin(), bones.end());
    std::vector<std::size_t> out;
    for (std::size_t i = 0; i < bones.size(); ++i) {
        const bool is_root = static_cast<int>(i) == skeleton.root;
        if (is_root || (bones[i] > 0 && bones[i] >= kLeastBone * longest)) out.push_back(i);
    }
    return out;
}

}  // namespace

PoseTrack Rigs::track(const mobb::Clip& clip, const Skeleton& skeleton) {
    const std::string key = key_of(skeleton);
    auto rig = std::find_if(rigs_.begin(), rigs_.end(), [&](const Rig& r) { return r.key == key; });
    if (rig == rigs_.end()) rig = rigs_.insert(rigs_.end(), {key, joints_that_count(skeleton)});

    PoseTrack out;
    out.dt = clip.dt();
    out.rig = static_cast<int>(rig - rigs_.begin());
    out.joints = rig->joints.size();
    out.points.reserve(rig->joints.size() * clip.samples().size());
    for (int i = 0; i < clip.count(); ++i) {
        const mobb::Disk& disk = clip.samples()[static_cast<std::size_t>(i)];
        out.root.emplace_back(disk.x, disk.y);
        const auto pose = skeleton.at(i);
        for (const std::size_t joint : rig->joints) out.points.push_back(pose[joint]);
    }
    return out;
}

}  // namespace mobbscope
