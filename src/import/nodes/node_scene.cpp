#include <base/error.h>
#include <base/text.h>
#include <import/clip/sampling.h>
#include <import/nodes/node_scene.h>

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <memory>
#include <optional>
#include <set>
#include <utility>

namespace mobbscope {

namespace {

// How many times as many joints a body has as what stands beside it.
constexpr int kFarMore = 2;

/// The rotation in a matrix that may scale, shear and mirror too; none where it leaves no volume.
glm::dquat rotation_of(const glm::dmat3& linear) {
    const glm::dvec3 x = glm::normalize(linear[0]);
    const glm::dvec3 y = glm::normalize(linear[1] - glm::dot(linear[1], x) * x);
    const glm::dvec3 z = glm::cross(x, y);
    const double mirrored = glm::dot(z, linear[2]) < 0 ? -1 : 1;
    const glm::dquat out = glm::normalize(glm::quat_cast(glm::dmat3(mirrored * x, mirrored * y, z)));
    return std::isfinite(out.w + out.x + out.y + out.z) ? out : glm::dquat{1, 0, 0, 0};
}

/// A scene, and what all of its motions need of it.
struct Rig {
    NodeScene scene;
    std::vector<int> order;  ///< of the nodes, parents first
    /// As NodeScene::characters; never empty. One of no joints: no animation moves a node.
    std::vector<std::vector<int>> characters;
    std::vector<int> topmost;        ///< the topmost joint of each; -1 where it has none
    std::vector<int> character_of;   ///< of each node; -1: it is nobody's
    std::vector<std::size_t> named;  ///< by node: its place among MotionFile::joints
};

/// The node nearest to a scene root that any animation moves: all clips of a file have one root. Of several at one
/// depth the first in `order`; -1: none.
int topmost_animated(const NodeScene& scene, const std::vector<int>& order) {
    const std::vector<bool> moved = moved_nodes(scene);
    const auto first = std::find_if(order.begin(), order.end(), [&](int node) { return moved[as_index(node)]; });
    return first == order.end() ? -1 : *first;
}

/// A node and all below it, parents first.
std::vector<int> nodes_below(int top, const Rig& rig) {
    std::vector<bool> inside(rig.scene.nodes.size());
    inside[as_index(top)] = true;
    std::vector<int> out;
    for (const int node : rig.order) {
        const int parent = rig.scene.nodes[as_index(node)].parent;
        if (parent >= 0 && inside[as_index(parent)]) inside[as_index(node)] = true;
        if (inside[as_index(node)]) out.push_back(node);
    }
    return out;
}

/// A node that is nobody's, and what counts below it: joints of characters that the file names, or else all nodes.
std::vector<int> joints_below(int top, const Rig& rig) {
    std::vector<int> out = nodes_below(top, rig);
    const auto is_joint = [&](int node) { return rig.character_of[as_index(node)] >= 0; };
    if (!rig.scene.characters.empty() && std::ranges::any_of(out, is_joint))
        std::erase_if(out, [&](int node) { return node != top && !is_joint(node); });
    return out;
}

class NodeMotion : public Motion {
  public:
    /// `nodes`: those that are joints, among them `topmost`.
    NodeMotion(std::shared_ptr<const Rig> rig, std::size_t animation, const std::vector<int>& nodes, int topmost)
        : rig_(std::move(rig)), animation_(&rig_->scene.animations[animation]) {
        const std::vector<int> joint_of = choose_joints(nodes);
        topmost_ = joint_of[as_index(topmost)];
        choose_posed_nodes(joint_of);
        times_ = animation_->times;
        if (rig_->characters.size() > 1) take_own_times();
        steps_ = posed_.size() + (animation_->more_steps ? animation_->more_steps(posed_) : 0);
        is_pivot_.resize(joints_.size());
        if (!rig_->scene.has_pivots) return;
        for (const int node : animation_->turned) {
            const int joint = joint_of[as_index(node)];
            if (joint >= 0) is_pivot_[as_index(joint)] = true;
        }
    }

    std::span<const Joint> joints() const override { return joints_; }
    std::size_t in_file(int joint) const override { return rig_->named[as_index(nodes_[as_index(joint)])]; }
    int topmost() const override { return topmost_; }
    bool is_pivot(int joint) const override { return is_pivot_[as_index(joint)]; }
    const MotionTimes& times() const override { return times_; }
    std::size_t posed() const override { return steps_; }

    void pose(double seconds, std::span<glm::dvec3> positions, std::span<glm::dquat> rotations) const override {
        each_joint(seconds, [&](std::size_t joint, const Affine& global) {
            positions[joint] = global.offset;
            if (!rotations.empty()) rotations[joint] = rotation_of(global.linear);
        });
    }

    std::vector<glm::dquat> rest() const override {
        std::vector<glm::dquat> out(joints_.size());
        each_joint(std::nullopt,
                   [&](std::size_t joint, const Affine& global) { out[joint] = rotation_of(global.linear); });
        return out;
    }

    std::vector<std::string> warnings() const override { return animation_->warnings; }

    /// -1: none.
    int joint_of(int node) const {
        const auto at = std::find(nodes_.begin(), nodes_.end(), node);
        return at == nodes_.end() ? -1 : static_cast<int>(at - nodes_.begin());
    }

  private:
    /// Of several characters each is there from its own first key to its last; one with a single key, all the time.
    void take_own_times() {
        std::optional<std::pair<double, double>> own;
        for (std::size_t i = 0; i < animation_->keyed.size(); ++i) {
            const int node = animation_->moved[i];
            if (std::ranges::find(posed_, node, &PosedNode::node) == posed_.end()) continue;
            const auto [first, last] = animation_->keyed[i];
            own = own ? std::pair(std::min(own->first, first), std::max(own->second, last)) : std::pair(first, last);
        }
        if (!own || own->first == own->second || (own->first == times_.first && own->second == times_.last)) return;
        std::vector<double> keys;
        std::ranges::copy_if(*times_.keys, std::back_inserter(keys),
                             [&](double key) { return key >= own->first && key <= own->second; });
        times_ = key_times({std::make_shared<const std::vector<double>>(std::move(keys))});
    }

    /// Calls `visit` with each joint and what leads from its own axes to those of the file.
    template <class Visit>
    void each_joint(std::optional<double> seconds, const Visit& visit) const {
        std::vector<Affine> global(posed_.size());
        animation_->pose(seconds, posed_, global);
        for (std::size_t joint = 0; joint < joints_.size(); ++joint) visit(joint, global[place_[joint]]);
    }

    /// Fills joints_ and nodes_; gives the joint of every node, -1 where it is none.
    std::vector<int> choose_joints(const std::vector<int>& of) {
        const std::vector<Node>& nodes = rig_->scene.nodes;
        std::vector<bool> is_joint(nodes.size());
        for (const int node : of) is_joint[as_index(node)] = true;
        std::vector<int> joint_of(nodes.size(), -1);
        std::vector<int> joint_above(nodes.size(), -1);  // the nearest one, or the node's own
        for (const int node : rig_->order) {
            const int parent = nodes[as_index(node)].parent;
            const int above = parent < 0 ? -1 : joint_above[as_index(parent)];
            joint_above[as_index(node)] = above;
            if (!is_joint[as_index(node)]) continue;
            joint_of[as_index(node)] = joint_above[as_index(node)] = static_cast<int>(joints_.size());
            joints_.push_back({nodes[as_index(node)].name, above, false});
            nodes_.push_back(node);
        }
        return joint_of;
    }

    void choose_posed_nodes(const std::vector<int>& joint_of) {
        const std::vector<Node>& nodes = rig_->scene.nodes;
        std::vector<bool> is_needed(nodes.size());
        for (auto node = rig_->order.rbegin(); node != rig_->order.rend(); ++node) {
            const int parent = nodes[as_index(*node)].parent;
            if (joint_of[as_index(*node)] >= 0) is_needed[as_index(*node)] = true;
            if (parent >= 0 && is_needed[as_index(*node)]) is_needed[as_index(parent)] = true;
        }
        std::vector<int> posed_of(nodes.size(), -1);
        place_.resize(joints_.size());
        for (const int node : rig_->order) {
            if (!is_needed[as_index(node)]) continue;
            const int parent = nodes[as_index(node)].parent;
            posed_of[as_index(node)] = static_cast<int>(posed_.size());
            const int joint = joint_of[as_index(node)];
            if (joint >= 0) place_[as_index(joint)] = posed_.size();
            posed_.push_back({node, parent < 0 ? -1 : posed_of[as_index(parent)]});
        }
    }

    std::shared_ptr<const Rig> rig_;
    const NodeAnimation* animation_;
    MotionTimes times_;
    std::vector<Joint> joints_;
    std::vector<int> nodes_;  ///< by joint
    int topmost_ = 0;
    std::vector<bool> is_pivot_;  ///< by joint
    std::vector<PosedNode> posed_;
    std::vector<std::size_t> place_;  ///< by joint: which of the posed nodes it is
    std::size_t steps_ = 0;           ///< of one pose
};

/// The nodes that an animation moves, themselves or with a node above them.
std::vector<bool> carried_nodes(const Rig& rig, const NodeAnimation& animation) {
    std::vector<bool> out(rig.scene.nodes.size());
    for (const int node : animation.moved) out[as_index(node)] = true;
    for (const int node : rig.order) {
        const int parent = rig.scene.nodes[as_index(node)].parent;
        if (parent >= 0 && out[as_index(parent)]) out[as_index(node)] = true;
    }
    return out;
}

MovedCharacters moved_characters(const Rig& rig, const NodeAnimation& animation) {
    MovedCharacters out;
    if (animation.moved.empty()) {
        out.nothing = animation.moves_nothing;
    } else if (rig.characters.size() == 1) {
        out.characters.push_back(0);
    } else {
        const std::vector<bool> carried = carried_nodes(rig, animation);
        const auto is_carried = [&](int node) { return carried[as_index(node)]; };
        for (std::size_t i = 0; i < rig.characters.size(); ++i) {
            if (std::ranges::any_of(rig.characters[i], is_carried)) out.characters.push_back(i);
        }
    }
    return out;
}

void require_moved(const Rig& rig, std::size_t animation) {
    const NodeAnimation& it = rig.scene.animations[animation];
    if (it.moved.empty()) throw InputError(rig.scene.file, "animation " + in_quotes(it.name), it.moves_nothing);
}

/// The character of each node, -1 where it is nobody's.
std::vector<int> characters_of_nodes(const Rig& rig) {
    std::vector<int> out(rig.scene.nodes.size(), -1);
    for (std::size_t i = 0; i < rig.characters.size(); ++i) {
        for (const int node : rig.characters[i]) out[as_index(node)] = static_cast<int>(i);
    }
    return out;
}

/// All nodes, those of characters first. Fills rig.named.
std::vector<NamedJoint> named_joints(Rig& rig) {
    const std::vector<Node>& nodes = rig.scene.nodes;
    std::vector<int> in_order;
    for (const std::vector<int>& joints : rig.characters) in_order.insert(in_order.end(), joints.begin(), joints.end());
    for (const int node : rig.order) {
        if (rig.character_of[as_index(node)] < 0) in_order.push_back(node);
    }
    std::vector<std::string> names;
    for (const int node : in_order) names.push_back(nodes[as_index(node)].name);
    names = distinct_names(std::move(names));
    std::vector<NamedJoint> out;
    rig.named.resize(nodes.size());
    for (std::size_t i = 0; i < in_order.size(); ++i) {
        rig.named[as_index(in_order[i])] = i;
        out.push_back({std::move(names[i]), rig.character_of[as_index(in_order[i])]});
    }
    return out;
}

/// The topmost joint of each character; -1 where it has none. Of several the first in its list, unless that has far
/// fewer joints below it than another: controls and props stand beside a body.
std::vector<int> topmost_joints(const Rig& rig) {
    const std::vector<Node>& nodes = rig.scene.nodes;
    const std::vector<int>& character_of = rig.character_of;
    std::vector<int> joint_above(nodes.size(), -1);  // the nearest one, whosever it is
    std::vector<int> top_of(nodes.size(), -1);       // of its character, above a joint or itself
    std::vector<int> joints_from(nodes.size(), 0);   // by topmost joint
    for (const int node : rig.order) {
        const int parent = nodes[as_index(node)].parent;
        if (parent >= 0)
            joint_above[as_index(node)] = character_of[as_index(parent)] >= 0 ? parent : joint_above[as_index(parent)];
        if (character_of[as_index(node)] < 0) continue;
        int above = joint_above[as_index(node)];
        while (above >= 0 && character_of[as_index(above)] != character_of[as_index(node)])
            above = joint_above[as_index(above)];
        top_of[as_index(node)] = above < 0 ? node : top_of[as_index(above)];
        ++joints_from[as_index(top_of[as_index(node)])];
    }
    const auto count = [&](int node) { return joints_from[as_index(node)]; };
    std::vector<int> out;
    for (const std::vector<int>& joints : rig.characters) {
        const auto first = std::ranges::find_if(joints, [&](int node) { return count(node) > 0; });
        const auto largest = std::ranges::max_element(joints, {}, count);
        const bool is_aside = first != joints.end() && count(*largest) > kFarMore * count(*first);
        out.push_back(first == joints.end() ? -1 : is_aside ? *largest : *first);
    }
    return out;
}

}  // namespace

Affine TranslationRotationScale::affine() const {
    glm::dmat3 linear = glm::mat3_cast(rotation);
    linear[0] *= scale.x;
    linear[1] *= scale.y;
    linear[2] *= scale.z;
    return {linear, translation};
}

std::vector<bool> moved_nodes(const NodeScene& scene) {
    std::vector<bool> out(scene.nodes.size());
    for (const NodeAnimation& animation : scene.animations) {
        for (const int node : animation.moved) out[as_index(node)] = true;
    }
    return out;
}

std::vector<int> parents_first(const std::vector<Node>& nodes) {
    const std::size_t count = nodes.size();
    std::vector<std::vector<int>> children(count);
    std::vector<int> order;
    order.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
        const int parent = nodes[i].parent;
        if (parent < 0) {
            order.push_back(static_cast<int>(i));
        } else {
            children[static_cast<std::size_t>(parent)].push_back(static_cast<int>(i));
        }
    }
    for (std::size_t next = 0; next < order.size(); ++next) {
        const std::vector<int>& below = children[static_cast<std::size_t>(order[next])];
        order.insert(order.end(), below.begin(), below.end());
    }
    return order;
}

std::vector<int> nodes_in_circles(const std::vector<Node>& nodes) {
    std::vector<bool> is_reached(nodes.size());
    for (const int node : parents_first(nodes)) is_reached[as_index(node)] = true;
    std::vector<int> out;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        if (!is_reached[i]) out.push_back(static_cast<int>(i));
    }
    return out;
}

MotionTimes key_times(const std::vector<Numbers>& lists) {
    // Exporters write one list for all channels, or equal lists: merging each anew would be slow.
    std::vector<double> all;
    std::set<const std::vector<double>*> seen;
    for (const Numbers& list : lists) {
        if (!seen.insert(list.get()).second || *list == *lists.front()) continue;
        all.insert(all.end(), list->begin(), list->end());
    }
    if (!lists.empty()) all.insert(all.end(), lists.front()->begin(), lists.front()->end());
    std::sort(all.begin(), all.end());
    all.erase(std::unique(all.begin(), all.end()), all.end());
    MotionTimes times;
    if (all.empty()) return times;
    times.first = all.front();
    times.last = all.back();
    times.frames = static_cast<int>(all.size());
    if (all.size() > 1) {
        std::vector<TimedDisk> frames(all.size());
        std::transform(all.begin(), all.end(), frames.begin(), [](double t) { return TimedDisk{t, {}}; });
        if (is_uniform(frames)) times.dt = (times.last - times.first) / static_cast<double>(all.size() - 1);
    }
    times.keys = std::make_shared<const std::vector<double>>(std::move(all));
    return times;
}

MotionFile node_motion_file(NodeScene scene) {
    check_character_count(scene.characters.size(), scene.file);
    auto making = std::make_shared<Rig>(Rig{std::move(scene), {}, {}, {}, {}, {}});
    making->order = parents_first(making->scene.nodes);
    making->characters = making->scene.characters;
    if (making->characters.empty()) {
        const int top = making->scene.body.value_or(topmost_animated(making->scene, making->order));
        making->characters.push_back(top < 0 ? std::vector<int>() : nodes_below(top, *making));
    }
    making->character_of = characters_of_nodes(*making);
    making->topmost = topmost_joints(*making);
    MotionFile out;
    out.format = making->scene.format;
    out.unit = making->scene.unit;
    out.unit_doubt = making->scene.unit_doubt;
    out.ground = making->scene.ground;
    out.up_doubt = making->scene.up_doubt;
    out.joints = named_joints(*making);
    const std::shared_ptr<const Rig> rig = std::move(making);
    for (const NodeAnimation& animation : rig->scene.animations) out.animations.push_back(animation.name);
    for (const int top : rig->topmost)
        out.characters.push_back(top < 0 ? "" : out.joints[rig->named[as_index(top)]].name);
    out.moved = [rig](std::size_t animation) { return moved_characters(*rig, rig->scene.animations[animation]); };
    out.motion = [rig](std::size_t animation, std::size_t character) {
        require_moved(*rig, animation);
        return std::make_shared<NodeMotion>(rig, animation, rig->characters[character], rig->topmost[character]);
    };
    std::vector<int> node_of(rig->named.size());
    for (std::size_t node = 0; node < rig->named.size(); ++node) node_of[rig->named[node]] = static_cast<int>(node);
    out.rooted = [rig, node_of](std::size_t animation, std::size_t joint) -> RootedMotion {
        require_moved(*rig, animation);
        const int node = node_of[joint];
        const int character = rig->character_of[as_index(node)];
        const auto motion = character >= 0
                                ? std::make_shared<NodeMotion>(rig, animation, rig->characters[as_index(character)],
                                                               rig->topmost[as_index(character)])
                                : std::make_shared<NodeMotion>(rig, animation, joints_below(node, *rig), node);
        return {motion, motion->joint_of(node)};
    };
    return out;
}

}  // namespace mobbscope
