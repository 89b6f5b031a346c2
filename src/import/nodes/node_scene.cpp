#include <base/error.h>
#include <base/text.h>
#include <import/clip/sampling.h>
#include <import/nodes/node_scene.h>

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

namespace mobbscope {

namespace {

glm::dquat quaternion(const double* xyzw) { return {xyzw[3], xyzw[0], xyzw[1], xyzw[2]}; }

/// Between two unit quaternions along the shorter arc.
glm::dquat slerp(const glm::dquat& from, glm::dquat to, double share) {
    double cosine = glm::dot(from, to);
    if (cosine < 0) {  // q and -q are one rotation
        to = -to;
        cosine = -cosine;
    }
    // Near-parallel: the sines vanish, and the chord is as good as the arc.
    if (cosine > 1 - 1e-12) return glm::normalize(from * (1 - share) + to * share);
    const double angle = std::acos(cosine);
    return (from * std::sin((1 - share) * angle) + to * std::sin(share * angle)) / std::sin(angle);
}

void put(const glm::dquat& q, double* xyzw) {
    xyzw[0] = q.x;
    xyzw[1] = q.y;
    xyzw[2] = q.z;
    xyzw[3] = q.w;
}

/// Hermite's cubic between key `k` and the next, `span` seconds apart, at `share` of the way.
void cubic(const double* values, std::size_t width, std::size_t k, double span, double share, double* out) {
    const double s2 = share * share;
    const double s3 = s2 * share;
    const double* from = values + 3 * k * width;
    const double* to = from + 3 * width;
    for (std::size_t i = 0; i < width; ++i) {
        const double out_tangent = from[2 * width + i];
        const double in_tangent = to[i];
        out[i] = (2 * s3 - 3 * s2 + 1) * from[width + i] + span * (s3 - 2 * s2 + share) * out_tangent +
                 (3 * s2 - 2 * s3) * to[width + i] + span * (s3 - s2) * in_tangent;
    }
}

/// The rotation in a matrix that may scale, shear and mirror too; none where it leaves no volume.
glm::dquat rotation_of(const glm::dmat3& linear) {
    const glm::dvec3 x = glm::normalize(linear[0]);
    const glm::dvec3 y = glm::normalize(linear[1] - glm::dot(linear[1], x) * x);
    const glm::dvec3 z = glm::cross(x, y);
    const double mirrored = glm::dot(z, linear[2]) < 0 ? -1 : 1;
    const glm::dquat out = glm::normalize(glm::quat_cast(glm::dmat3(mirrored * x, mirrored * y, z)));
    return std::isfinite(out.w + out.x + out.y + out.z) ? out : glm::dquat{1, 0, 0, 0};
}

/// A node that has to be posed, as a joint lies in it or below it.
struct PosedNode {
    int parent = -1;  ///< index into the posed nodes, less than its own
    int joint = -1;   ///< index into the joints; -1: none
    TranslationRotationScale rest;
    Affine matrix;
    std::array<const Channel*, 3> channels{};  ///< by NodeProperty; null where none
    bool moves = false;                        ///< at least one channel
};

/// The node nearest to a scene root that any animation moves: all clips of a file have one root. Of several at one
/// depth the first in `order`; -1: none.
int topmost_animated(const NodeScene& scene, const std::vector<int>& order) {
    std::vector<bool> moved(scene.nodes.size());
    for (const NodeAnimation& animation : scene.animations) {
        for (const Channel& channel : animation.channels) moved[as_index(channel.node)] = true;
    }
    const auto first = std::find_if(order.begin(), order.end(), [&](int node) { return moved[as_index(node)]; });
    return first == order.end() ? -1 : *first;
}

/// True if a rotation is not the same at all keys.
bool turns(const Channel& channel) {
    const std::vector<double>& values = *channel.values;
    const glm::dquat first = glm::normalize(quaternion(values.data()));
    for (std::size_t i = 4; i < values.size(); i += 4) {
        // The cosine of half the angle between them; single precision leaves it within 1e-7 of 1.
        if (std::abs(glm::dot(first, glm::normalize(quaternion(&values[i])))) < 1 - 1e-6) return true;
    }
    return false;
}

class NodeMotion : public Motion {
  public:
    NodeMotion(std::shared_ptr<const NodeScene> scene, std::size_t animation)
        : scene_(std::move(scene)), animation_(&scene_->animations[animation]) {
        if (animation_->channels.empty()) {
            throw InputError(
                scene_->file, "animation " + in_quotes(animation_->name),
                animation_->has_morph_channels
                    ? "moves morph targets only, so there is no joint to follow; give a clip that moves nodes"
                    : "moves no node; give a clip that does");
        }
        const std::vector<int> order = parents_first(scene_->nodes);
        const std::vector<int> joint_of = choose_joints(order);
        choose_posed_nodes(order, joint_of);
        is_pivot_.resize(joints_.size());
        for (const Channel& channel : animation_->channels) {
            const int joint = joint_of[as_index(channel.node)];
            if (scene_->has_pivots && joint >= 0 && channel.property == NodeProperty::rotation && turns(channel)) {
                is_pivot_[as_index(joint)] = true;
            }
        }
    }

    std::span<const Joint> joints() const override { return joints_; }
    int topmost() const override { return topmost_; }
    bool is_pivot(int joint) const override { return is_pivot_[as_index(joint)]; }
    const MotionTimes& times() const override { return animation_->times; }

    void pose(double seconds, std::span<glm::dvec3> positions, std::span<glm::dquat> rotations) const override {
        const auto local = [&](const PosedNode& node) { return node.moves ? local_at(node, seconds) : node.matrix; };
        each_joint(local, [&](std::size_t joint, const Affine& global) {
            positions[joint] = global.offset;
            if (!rotations.empty()) rotations[joint] = rotation_of(global.linear);
        });
    }

    std::vector<glm::dquat> rest() const override {
        std::vector<glm::dquat> out(joints_.size());
        const auto local = [](const PosedNode& node) { return node.moves ? node.rest.affine() : node.matrix; };
        each_joint(local, [&](std::size_t joint, const Affine& global) { out[joint] = rotation_of(global.linear); });
        return out;
    }

    std::vector<std::string> warnings() const override {
        std::vector<std::string> out;
        if (scene_->skins > 1) {
            out.push_back("the file has " + counted(scene_->skins, "skin", "skins") +
                          "; the joints of skin 0 were taken");
        }
        if (animation_->has_morph_channels)
            out.push_back("morph targets are animated too; they do not widen the disks");
        return out;
    }

  private:
    /// Calls `visit` with each joint and what leads from its own axes to those of the file; `local` gives what leads
    /// from a posed node to the one above it.
    template <class Local, class Visit>
    void each_joint(const Local& local, const Visit& visit) const {
        std::vector<Affine> global(posed_.size());
        for (std::size_t i = 0; i < posed_.size(); ++i) {
            const PosedNode& node = posed_[i];
            global[i] = node.parent < 0 ? local(node) : global[as_index(node.parent)] * local(node);
            if (node.joint >= 0) visit(as_index(node.joint), global[i]);
        }
    }

    static Affine local_at(const PosedNode& node, double seconds) {
        TranslationRotationScale local = node.rest;
        std::array<double, 4> v{};
        const auto take = [&](NodeProperty property) {
            const Channel* channel = node.channels[static_cast<std::size_t>(property)];
            if (channel) evaluate(*channel, seconds, v.data());
            return channel != nullptr;
        };
        if (take(NodeProperty::translation)) local.translation = {v[0], v[1], v[2]};
        if (take(NodeProperty::rotation)) local.rotation = {v[3], v[0], v[1], v[2]};
        if (take(NodeProperty::scale)) local.scale = {v[0], v[1], v[2]};
        return local.affine();
    }

    /// Fills joints_ and topmost_; gives the joint of every node, -1 where it is none.
    std::vector<int> choose_joints(const std::vector<int>& order) {
        const std::vector<Node>& nodes = scene_->nodes;
        std::vector<bool> is_joint(nodes.size());
        if (scene_->has_skin) {
            for (const int node : scene_->skin_joints) is_joint[as_index(node)] = true;
        } else {
            is_joint[as_index(topmost_animated(*scene_, order))] = true;
            for (const int node : order) {
                const int parent = nodes[as_index(node)].parent;
                if (parent >= 0 && is_joint[as_index(parent)]) is_joint[as_index(node)] = true;
            }
        }
        std::vector<int> joint_of(nodes.size(), -1);
        std::vector<int> joint_above(nodes.size(), -1);  // the nearest one, or the node's own
        for (const int node : order) {
            const int parent = nodes[as_index(node)].parent;
            const int above = parent < 0 ? -1 : joint_above[as_index(parent)];
            joint_above[as_index(node)] = above;
            if (!is_joint[as_index(node)]) continue;
            joint_of[as_index(node)] = joint_above[as_index(node)] = static_cast<int>(joints_.size());
            joints_.push_back({nodes[as_index(node)].name, above, false});
        }
        // A skin may have several joints without a joint above them: the first that it names.
        const auto is_top = [&](int node) { return joints_[as_index(joint_of[as_index(node)])].parent < 0; };
        if (scene_->has_skin) {
            topmost_ =
                joint_of[as_index(*std::find_if(scene_->skin_joints.begin(), scene_->skin_joints.end(), is_top))];
        }
        return joint_of;
    }

    void choose_posed_nodes(const std::vector<int>& order, const std::vector<int>& joint_of) {
        const std::vector<Node>& nodes = scene_->nodes;
        std::vector<bool> is_needed(nodes.size());
        for (auto node = order.rbegin(); node != order.rend(); ++node) {
            const int parent = nodes[as_index(*node)].parent;
            if (joint_of[as_index(*node)] >= 0) is_needed[as_index(*node)] = true;
            if (parent >= 0 && is_needed[as_index(*node)]) is_needed[as_index(parent)] = true;
        }
        std::vector<int> posed_of(nodes.size(), -1);
        for (const int i : order) {
            if (!is_needed[as_index(i)]) continue;
            const Node& node = nodes[as_index(i)];
            posed_of[as_index(i)] = static_cast<int>(posed_.size());
            posed_.push_back({node.parent < 0 ? -1 : posed_of[as_index(node.parent)],
                              joint_of[as_index(i)],
                              node.rest,
                              node.matrix,
                              {},
                              false});
        }
        for (const Channel& channel : animation_->channels) {
            const int posed = posed_of[as_index(channel.node)];
            if (posed < 0) continue;
            posed_[as_index(posed)].channels[static_cast<std::size_t>(channel.property)] = &channel;
            posed_[as_index(posed)].moves = true;
        }
    }

    std::shared_ptr<const NodeScene> scene_;
    const NodeAnimation* animation_;
    std::vector<Joint> joints_;
    int topmost_ = 0;
    std::vector<bool> is_pivot_;  ///< by joint
    std::vector<PosedNode> posed_;
};

}  // namespace

Affine TranslationRotationScale::affine() const {
    glm::dmat3 linear = glm::mat3_cast(rotation);
    linear[0] *= scale.x;
    linear[1] *= scale.y;
    linear[2] *= scale.z;
    return {linear, translation};
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

void evaluate(const Channel& channel, double seconds, double* out) {
    const std::vector<double>& times = *channel.times;
    const bool is_rotation = channel.property == NodeProperty::rotation;
    const bool is_cubic = channel.interpolation == Interpolation::cubic_spline;
    const std::size_t width = is_rotation ? 4 : 3;
    const double* values = channel.values->data();
    const auto value = [&](std::size_t key) { return values + (is_cubic ? 3 * key + 1 : key) * width; };

    const auto after = static_cast<std::size_t>(std::upper_bound(times.begin(), times.end(), seconds) - times.begin());
    const std::size_t key = after == 0 ? 0 : after - 1;
    const bool is_between = after > 0 && after < times.size() && channel.interpolation != Interpolation::step;
    if (!is_between) {
        std::copy_n(value(key), width, out);
    } else {
        const double span = times[after] - times[key];
        const double share = (seconds - times[key]) / span;
        if (is_cubic) {
            cubic(values, width, key, span, share, out);
        } else if (is_rotation) {
            put(slerp(glm::normalize(quaternion(value(key))), glm::normalize(quaternion(value(after))), share), out);
        } else {
            for (std::size_t i = 0; i < width; ++i) out[i] = value(key)[i] + share * (value(after)[i] - value(key)[i]);
        }
    }
    if (is_rotation) {
        const double length = glm::length(quaternion(out));
        // Tangents may lead a spline through zero, where no rotation is meant; the key before it is.
        put(length > 0 ? quaternion(out) / length : glm::normalize(quaternion(value(key))), out);
    }
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
    return times;
}

MotionFile node_motion_file(NodeScene scene) {
    const auto shared = std::make_shared<const NodeScene>(std::move(scene));
    MotionFile out{shared->format, shared->unit, {}, [shared](std::size_t animation) {
                       return std::make_shared<NodeMotion>(shared, animation);
                   }};
    for (const NodeAnimation& animation : shared->animations) out.animations.push_back(animation.name);
    return out;
}

}  // namespace mobbscope
