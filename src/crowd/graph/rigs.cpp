#include <base/text.h>
#include <crowd/graph/rigs.h>
#include <import/skeleton/disk_sampler.h>

#include <glm/geometric.hpp>

#include <algorithm>
#include <stdexcept>
#include <string>
#include <unordered_map>
#include <unordered_set>

namespace mobbscope {

namespace {

constexpr float kLeastBone = 0.1F;   // of the longest limb
constexpr float kMostChange = 0.1F;  // of its length: what changes more is no bone, but moves its joint

/// Two skeletons have the same if and only if their joints are the same.
std::string key_of(const Skeleton& skeleton) {
    std::string key;
    // A name may hold any byte but NUL.
    for (const Joint& joint : skeleton.joints) key += joint.name + '\0' + std::to_string(joint.parent) + '\0';
    return key + std::to_string(skeleton.root);
}

/// A joint's name in a graph's file. JSON holds UTF-8 alone, so another name gives way to the joint's index.
std::string name_in_graph(const Skeleton& skeleton, std::size_t joint) {
    const std::string& name = skeleton.joints[joint].name;
    return is_utf8(name) ? name : '#' + std::to_string(joint);
}

float value_at(std::vector<float>& values, std::size_t rank) {
    const auto at = values.begin() + static_cast<std::ptrdiff_t>(rank);
    std::nth_element(values.begin(), at, values.end());
    return *at;
}

/// A joint's bone in all clips of a rig.
struct Bone {
    float length = 0;  ///< median, metres
    bool rigid = true;
};

Bone bone_of(const std::vector<const Skeleton*>& skeletons, std::size_t joint) {
    const auto parent = static_cast<std::size_t>(skeletons.front()->joints[joint].parent);
    Bone bone;
    std::vector<float> lengths;  // of all clips
    for (const Skeleton* skeleton : skeletons) {
        std::vector<float> of_clip;
        const int frames = static_cast<int>(skeleton->positions.size() / skeleton->joints.size());
        for (int frame = 0; frame < frames; ++frame) {
            const auto pose = skeleton->at(frame);
            of_clip.push_back(glm::distance(pose[joint], pose[parent]));
        }
        lengths.insert(lengths.end(), of_clip.begin(), of_clip.end());
        // Of the longest and shortest a tenth each is left out: captures have damaged frames.
        const float shortest = value_at(of_clip, of_clip.size() / 10);
        const float longest = value_at(of_clip, of_clip.size() - 1 - of_clip.size() / 10);
        if (longest - shortest > kMostChange * longest) bone.rigid = false;
    }
    bone.length = value_at(lengths, lengths.size() / 2);
    return bone;
}

GraphRig rig_of(const std::vector<const Skeleton*>& skeletons) {
    const Skeleton& first = *skeletons.front();
    const std::vector<bool> below = subtree(first.joints, first.root);
    std::vector<Bone> bones(first.joints.size());
    float longest = 0;
    for (std::size_t i = 0; i < bones.size(); ++i) {
        const Joint& joint = first.joints[i];
        if (!below[i] || joint.end_site || static_cast<int>(i) == first.root) continue;
        bones[i] = bone_of(skeletons, i);
        if (bones[i].rigid && joint.parent != first.root) longest = std::max(longest, bones[i].length);
    }
    GraphRig rig;
    std::unordered_set<std::string> taken;
    for (std::size_t i = 0; i < bones.size(); ++i) {
        const bool counts =
            static_cast<int>(i) == first.root || (bones[i].length > 0 && bones[i].length >= kLeastBone * longest);
        const std::string name = name_in_graph(first, i);
        if (counts && taken.insert(name).second) rig.joints.push_back(name);
    }
    return rig;
}

}  // namespace

std::vector<int> rig_of_each_clip(const Scene& scene) {
    std::vector<int> out;
    std::unordered_map<std::string, int> known;
    for (const SceneClip& clip : scene.clips) {
        out.push_back(clip.skeleton
                          ? known.try_emplace(key_of(*clip.skeleton), static_cast<int>(known.size())).first->second
                          : -1);
    }
    return out;
}

SceneRigs rigs_of(const Scene& scene) {
    SceneRigs out{{}, rig_of_each_clip(scene)};
    std::vector<std::vector<const Skeleton*>> skeletons;
    for (std::size_t c = 0; c < scene.clips.size(); ++c) {
        if (out.of_clip[c] < 0) continue;
        const auto rig = static_cast<std::size_t>(out.of_clip[c]);
        if (rig == skeletons.size()) skeletons.emplace_back();
        skeletons[rig].push_back(scene.clips[c].skeleton.get());
    }
    for (const auto& of_rig : skeletons) out.rigs.push_back(rig_of(of_rig));
    return out;
}

void set_rigs(MotionGraph& graph, const SceneRigs& of_scene) {
    std::vector<int> number(of_scene.rigs.size(), -1);
    graph.rigs.clear();
    for (GraphMove& move : graph.moves) {
        const int rig = of_scene.of_clip[static_cast<std::size_t>(move.clip)];
        move.rig = -1;
        if (rig < 0) continue;
        int& of = number[static_cast<std::size_t>(rig)];
        if (of < 0) {
            of = static_cast<int>(graph.rigs.size());
            graph.rigs.push_back(of_scene.rigs[static_cast<std::size_t>(rig)]);
        }
        move.rig = of;
    }
}

std::vector<std::size_t> joints_of(const GraphRig& rig, const Skeleton& skeleton) {
    const std::vector<bool> below = subtree(skeleton.joints, skeleton.root);
    std::unordered_map<std::string, std::vector<std::size_t>> by_name;
    for (std::size_t i = 0; i < skeleton.joints.size(); ++i) {
        if (below[i] && !skeleton.joints[i].end_site) by_name[name_in_graph(skeleton, i)].push_back(i);
    }
    std::vector<std::size_t> out;
    for (const std::string& name : rig.joints) {
        const auto found = by_name.find(name);
        if (found == by_name.end()) {
            throw std::invalid_argument("there is no joint " + in_quotes(name) + " below its root " +
                                        in_quotes(name_in_graph(skeleton, static_cast<std::size_t>(skeleton.root))));
        }
        out.insert(out.end(), found->second.begin(), found->second.end());
    }
    return out;
}

}  // namespace mobbscope
