#include <base/error.h>
#include <base/text.h>
#include <import/skeleton/disk_sampler.h>
#include <motion_files/played_motion.h>
#include <scene/crowd_run.h>
#include <scene/crowd_scene.h>
#include <scene/motion_graph.h>

#include <glm/common.hpp>

#include <algorithm>
#include <limits>
#include <numbers>

namespace mobbscope {

namespace {

/// From the ground plane with z up to the axes of motion files, y up.
glm::dvec3 y_up(const glm::dvec3& p) { return {p.x, p.z, 0 - p.y}; }
glm::dquat y_up(const glm::dquat& q) { return glm::angleAxis(-std::numbers::pi / 2, glm::dvec3(1, 0, 0)) * q; }

constexpr std::size_t kMostPoses = 8'000'000;  // joints times frames: as many as an import keeps

bool same_joints(const Skeleton& a, const Skeleton& b) {
    return a.root == b.root && std::ranges::equal(a.joints, b.joints, [](const Joint& p, const Joint& q) {
               return p.name == q.name && p.parent == q.parent && p.end_site == q.end_site;
           });
}

/// The root and all below it, each before what hangs on it, and that before its next sibling.
std::vector<int> depth_first(const Skeleton& skeleton) {
    std::vector<std::vector<int>> children(skeleton.joints.size());
    for (std::size_t i = 0; i < skeleton.joints.size(); ++i) {
        const int parent = skeleton.joints[i].parent;
        if (parent >= 0) children[static_cast<std::size_t>(parent)].push_back(static_cast<int>(i));
    }
    std::vector<int> out;
    std::vector<int> open{skeleton.root};
    while (!open.empty()) {
        out.push_back(open.back());
        open.pop_back();
        const std::vector<int>& below = children[static_cast<std::size_t>(out.back())];
        open.insert(open.end(), below.rbegin(), below.rend());
    }
    return out;
}

/// Who there is in a scene by name, and when each begins: agents of a run, agents, or without agents clips.
struct Cast {
    std::vector<std::string> names;
    std::vector<double> begins;
};

Cast cast_of(const Scene& scene) {
    Cast out;
    const auto add = [&](const std::string& name, double begin) {
        out.names.push_back(name);
        out.begins.push_back(begin);
    };
    if (is_run(scene)) {
        for (const CrowdAgent& agent : scene.crowd->agents) add(agent.name, agent.plays.front().placement.start);
    } else {
        for (const PlacedAgent& agent : placed_agents(scene)) add(agent.name, agent.placement.start);
    }
    return out;
}

std::size_t chosen(const Scene& scene, const Cast& cast, const std::optional<std::string>& name) {
    const std::string file = scene.file.string();
    if (!name && cast.names.size() > 1) {
        throw InputError(file, "a motion file holds one agent, and there are " + std::to_string(cast.names.size()) +
                                   "; name one with --agent, such as " + in_quotes(cast.names.front()));
    }
    const auto at = name ? std::ranges::find(cast.names, *name) : cast.names.begin();
    if (at == cast.names.end()) {
        throw InputError(
            file, "",
            "there is no agent " + in_quotes(*name) + "; the nearest is " + in_quotes(nearest(*name, cast.names)));
    }
    return static_cast<std::size_t>(at - cast.names.begin());
}

}  // namespace

PlayedMotion::PlayedMotion(const Scene& scene, const std::optional<std::string>& name) {
    take_links(scene, name);
    check_links(scene);
    take_joints();
}

void PlayedMotion::take_links(const Scene& scene, const std::optional<std::string>& name) {
    const Cast cast = cast_of(scene);
    const std::size_t agent = chosen(scene, cast, name);
    name_ = cast.names[agent];
    lead_ = cast.begins[agent] - *std::ranges::min_element(cast.begins);
    if (is_run(scene)) {
        for (const Play& play : scene.crowd->agents[agent].plays) {
            const int clip = scene.graph->moves[static_cast<std::size_t>(play.move)].clip;
            add_link(scene.clips[static_cast<std::size_t>(clip)], play.placement);
        }
    } else {
        const PlacedAgent placed = placed_agents(scene)[agent];
        add_link(scene.clips[static_cast<std::size_t>(placed.clip)], placed.placement);
    }
}

void PlayedMotion::add_link(const SceneClip& clip, const mobb::Placement& placement) {
    links_.push_back({clip.clip, clip.skeleton, placement});
    clip_names_.push_back(clip.name);
    dt_ = links_.front().clip->dt();
}

void PlayedMotion::check_links(const Scene& scene) const {
    const std::string agent = "agent " + in_quotes(name_);
    const Link& first = links_.front();
    std::size_t poses = 0;
    for (std::size_t i = 0; i < links_.size(); ++i) {
        const Link& link = links_[i];
        if (!link.skeleton) {
            throw InputError(scene.file.string(), agent,
                             "plays the clip " + in_quotes(clip_names_[i]) +
                                 ", which has no skeleton (its samples are disks alone, or too many to keep one), so "
                                 "no motion file can hold it");
        }
        const std::string both = in_quotes(clip_names_.front()) + " and " + in_quotes(clip_names_[i]);
        if (!same_joints(*first.skeleton, *link.skeleton)) {
            throw InputError(scene.file.string(), agent,
                             "plays clips of different skeletons, such as " + both + " (" +
                                 counted(first.skeleton->joints.size(), "joint", "joints") + " and " +
                                 std::to_string(link.skeleton->joints.size()) +
                                 "); a motion file holds one, so make the run of clips that share theirs");
        }
        if (link.clip->dt() != first.clip->dt()) {
            throw InputError(scene.file.string(), agent,
                             "plays clips of different sample rates, such as " + both + " (every " +
                                 brief(first.clip->dt()) + " and " + brief(link.clip->dt()) +
                                 " s); a motion file has one frame time, so give all clips the same fps");
        }
        poses += static_cast<std::size_t>(link.clip->count()) * link.skeleton->joints.size();
        if (poses > kMostPoses) {
            throw InputError(scene.file.string(), agent,
                             "plays more than " + std::to_string(kMostPoses) +
                                 " poses of joints, which no reader would keep; simulate fewer seconds");
        }
    }
}

void PlayedMotion::take_joints() {
    const Skeleton& skeleton = *links_.front().skeleton;
    order_ = depth_first(skeleton);
    std::vector<int> number(skeleton.joints.size(), -1);
    for (std::size_t j = 0; j < order_.size(); ++j) {
        const auto index = static_cast<std::size_t>(order_[j]);
        Joint joint = skeleton.joints[index];
        joint.parent = j == 0 ? -1 : number[static_cast<std::size_t>(joint.parent)];
        number[index] = static_cast<int>(j);
        joints_.push_back(std::move(joint));
        rest_.push_back(y_up(glm::dquat(skeleton.rest[index])));
    }
}

void PlayedMotion::each_frame(const std::function<void(std::span<const JointPose>)>& visit) const {
    std::vector<JointPose> pose(joints_.size());
    for (const Link& link : links_) {
        const mobb::PlacedClip placed(*link.clip, link.placement);
        const glm::dquat about = about_up(placed.rotation());
        for (int sample = 0; sample < placed.count(); ++sample) {
            const std::span<const glm::quat> rotations = link.skeleton->rotations_at(sample);
            for (std::size_t j = 0; j < pose.size(); ++j) {
                const glm::dquat rotation(rotations[static_cast<std::size_t>(order_[j])]);
                pose[j] = {y_up(joint_place(*link.skeleton, placed, sample, order_[j])),
                           glm::normalize(y_up(about * rotation))};
            }
            visit(pose);
        }
    }
}

int PlayedMotion::frames() const {
    int out = 0;
    for (const Link& link : links_) out += link.clip->count();
    return out;
}

std::vector<mobb::Disk> PlayedMotion::disks() const {
    std::vector<mobb::Disk> out;
    for (const Link& link : links_) {
        const mobb::PlacedClip placed(*link.clip, link.placement);
        for (int sample = 0; sample < placed.count(); ++sample) out.push_back(placed.disk(sample));
    }
    return out;
}

std::vector<Bone> PlayedMotion::bones() const {
    std::vector<glm::dvec3> low(joints_.size(), glm::dvec3(std::numeric_limits<double>::infinity()));
    std::vector<glm::dvec3> high(joints_.size(), -low.front());
    each_frame([&](std::span<const JointPose> pose) {
        for (std::size_t j = 1; j < pose.size(); ++j) {
            const glm::dvec3 offset = bone_offset(pose[static_cast<std::size_t>(joints_[j].parent)], pose[j]);
            low[j] = glm::min(low[j], offset);
            high[j] = glm::max(high[j], offset);
        }
    });
    std::vector<Bone> out(joints_.size());
    for (std::size_t j = 1; j < out.size(); ++j) {
        const glm::dvec3 extent = high[j] - low[j];
        out[j] = {(low[j] + high[j]) / 2.0, std::max({extent.x, extent.y, extent.z}) > kBoneTolerance};
    }
    return out;
}

glm::dvec3 bone_offset(const JointPose& above, const JointPose& joint) {
    return glm::conjugate(above.rotation) * (joint.position - above.position);
}

}  // namespace mobbscope
