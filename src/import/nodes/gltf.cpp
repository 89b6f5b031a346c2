#include <base/error.h>
#include <base/file.h>
#include <base/text.h>
#include <import/nodes/gltf.h>
#include <import/nodes/gltf_accessor.h>
#include <import/nodes/gltf_animation.h>
#include <import/nodes/gltf_characters.h>
#include <import/nodes/gltf_model.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <set>
#include <utility>

namespace mobbscope {

namespace {

constexpr double kTolerance = 1e-6;
// In the order of their enumerations.
constexpr std::array<std::string_view, 3> kProperties{"translation", "rotation", "scale"};
constexpr std::array<std::string_view, 3> kInterpolations{"STEP", "LINEAR", "CUBICSPLINE"};

std::string name_of(const tinygltf::Model& model, int node) {
    const std::string& name = model.nodes[as_index(node)].name;
    return name.empty() ? "node" + std::to_string(node) : name;
}

std::string place_of_node(const tinygltf::Model& model, int node) {
    return "node " + std::to_string(node) + " " + in_quotes(name_of(model, node));
}

glm::dvec3 vec3(const std::vector<double>& v, const glm::dvec3& otherwise) {
    return v.size() == 3 ? glm::dvec3{v[0], v[1], v[2]} : otherwise;
}

/// Fills a scene from a model whose indices exist.
class SceneBuilder {
  public:
    SceneBuilder(const GltfModel& from, const std::string& file)
        : from_(from), model_(from.model), accessors_(from.model, file) {
        scene_.file = file;
        scene_.format = "gltf";
        scene_.unit = 1;  // the specification: metres, y up
        scene_.ground = kYUp;
    }

    NodeScene build() {
        add_nodes();
        link_parents();
        if (model_.animations.empty()) {
            throw InputError(scene_.file, "", "holds no animation; export the clip with its animation");
        }
        for (std::size_t i = 0; i < model_.animations.size(); ++i) add_animation(i);
        std::vector<GltfSkin> skins;
        for (const tinygltf::Skin& skin : model_.skins) skins.push_back({skin.joints, skin.skeleton});
        scene_.characters = gltf_characters(scene_, skins, channels_);
        scene_.body = from_.hips;
        return std::move(scene_);
    }

  private:
    [[noreturn]] void fail_node(int node, const std::string& message) const {
        throw InputError(scene_.file, place_of_node(model_, node), message);
    }

    void add_nodes() {
        for (int i = 0; i < static_cast<int>(model_.nodes.size()); ++i) {
            const tinygltf::Node& from = model_.nodes[as_index(i)];
            GltfRest rest;
            if (!from.matrix.empty()) {
                rest.matrix = matrix_of(i);
            } else {
                rest.parts.translation = vec3(from.translation, glm::dvec3(0));
                rest.parts.scale = vec3(from.scale, glm::dvec3(1));
                if (!from.rotation.empty()) rest.parts.rotation = rotation_of(i);
                rest.matrix = rest.parts.affine();
            }
            rest_->push_back(rest);
            scene_.nodes.push_back({name_of(model_, i)});
        }
    }

    Affine matrix_of(int node) const {
        const std::vector<double>& m = model_.nodes[as_index(node)].matrix;  // column after column
        const bool is_affine = std::abs(m[3]) <= kTolerance && std::abs(m[7]) <= kTolerance &&
                               std::abs(m[11]) <= kTolerance && std::abs(m[15] - 1) <= kTolerance;
        if (!is_affine) fail_node(node, "its matrix must end in a row of 0 0 0 1; export the file again");
        return {{m[0], m[1], m[2], m[4], m[5], m[6], m[8], m[9], m[10]}, {m[12], m[13], m[14]}};
    }

    glm::dquat rotation_of(int node) const {
        const std::vector<double>& r = model_.nodes[as_index(node)].rotation;
        const glm::dquat q{r[3], r[0], r[1], r[2]};
        const double length = glm::length(q);
        if (!(length > kTolerance) || !std::isfinite(length)) {
            fail_node(node, "its rotation is not a unit quaternion; correct it");
        }
        return q / length;
    }

    void link_parents() {
        for (int parent = 0; parent < static_cast<int>(model_.nodes.size()); ++parent) {
            for (const int child : model_.nodes[as_index(parent)].children) {
                int& known = scene_.nodes[as_index(child)].parent;
                if (known >= 0) {
                    fail_node(child, "is a child of both " + place_of_node(model_, known) + " and " +
                                         place_of_node(model_, parent) + "; give it one parent");
                }
                known = parent;
            }
        }
        const std::vector<int> lost = nodes_in_circles(scene_.nodes);
        if (!lost.empty()) fail_node(lost.front(), "is its own ancestor, or below a node that is; break the cycle");
    }

    void add_animation(std::size_t index) {
        const tinygltf::Animation& from = model_.animations[index];
        NodeAnimation animation;
        animation.name = from.name.empty() ? "#" + std::to_string(index) : from.name;
        const std::string place = "animation " + in_quotes(animation.name);
        std::vector<Numbers> times;
        std::vector<GltfChannel> channels;
        std::map<int, std::pair<double, double>> moved;
        bool moves_morph_targets = false;
        std::set<std::pair<int, std::string_view>> targets;
        for (const tinygltf::AnimationChannel& channel : from.channels) {
            std::string_view path = channel.target_path;
            const bool by_pointer = path.starts_with(kByPointer);
            if (by_pointer) path.remove_prefix(kByPointer.size());
            const bool is_weights = path == "weights";
            // Pointers may lead to the weights of one morph target after another.
            if (!targets.emplace(channel.target_node, path).second && !(is_weights && by_pointer)) {
                throw InputError(scene_.file, place,
                                 "has two channels for " + in_quotes(path) + " of " +
                                     place_of_node(model_, channel.target_node) + "; keep one");
            }
            const tinygltf::AnimationSampler& sampler = from.samplers[as_index(channel.sampler)];
            times.push_back(times_of(sampler.input));
            if (is_weights) {
                moves_morph_targets = true;
                continue;
            }
            channels.push_back(channel_of(channel.target_node, path, sampler, times.back(), place));
            const bool has_matrix = !model_.nodes[as_index(channel.target_node)].matrix.empty();
            if (has_matrix && !(by_pointer && path == "translation")) {
                fail_node(channel.target_node,
                          "is animated, so it needs translation, rotation and scale in place of its matrix");
            }
            const std::pair<double, double> keyed{times.back()->front(), times.back()->back()};
            const auto [at, is_new] = moved.try_emplace(channel.target_node, keyed);
            if (!is_new)
                at->second = {std::min(at->second.first, keyed.first), std::max(at->second.second, keyed.second)};
        }
        animation.times = key_times(times);
        for (const auto& [node, keyed] : moved) {
            animation.moved.push_back(node);
            animation.keyed.push_back(keyed);
        }
        animation.pose = gltf_pose(rest_, channels);
        channels_.insert(channels_.end(), channels.begin(), channels.end());
        const auto elsewhere = from_.unread.find(index);
        const std::string unread = elsewhere == from_.unread.end() ? "" : unread_pointers(elsewhere->second);
        if (!unread.empty()) {
            animation.warnings.push_back(unread + ", which " + (elsewhere->second.size() == 1 ? "moves" : "move") +
                                         " no node: ignored");
        }
        if (moves_morph_targets)
            animation.warnings.emplace_back("morph targets are animated too; they do not widen the disks");
        animation.moves_nothing =
            moves_morph_targets
                ? "moves morph targets only, so there is no joint to follow; give a clip that moves nodes"
            : unread.empty() ? "moves no node; give a clip that does"
                             : "moves no node, as " + unread + "; give a clip that does";
        scene_.animations.push_back(std::move(animation));
    }

    /// Where channels of KHR_animation_pointer lead, of which there is one at least; a few are named.
    static std::string unread_pointers(const std::vector<std::string>& pointers) {
        constexpr std::size_t kMostNamed = 3;
        std::string out = "KHR_animation_pointer leads to " + in_quotes(pointers.front());
        for (std::size_t i = 1; i < std::min(pointers.size(), kMostNamed); ++i) out += ", " + in_quotes(pointers[i]);
        if (pointers.size() > kMostNamed) {
            out += " and " + counted(pointers.size() - kMostNamed, "more place", "more places");
        }
        return out;
    }

    Numbers times_of(int accessor) {
        Numbers times = accessors_.read(accessor, TINYGLTF_TYPE_SCALAR);
        if (!checked_times_.insert(accessor).second) return times;
        if (model_.accessors[as_index(accessor)].componentType != TINYGLTF_COMPONENT_TYPE_FLOAT) {
            accessors_.fail(accessor, "key times must be floats; export the file again");
        }
        const auto fall = std::adjacent_find(times->begin(), times->end(), [](double a, double b) { return !(a < b); });
        if (fall != times->end()) {
            accessors_.fail(accessor, "key time " + std::to_string(fall - times->begin() + 1) +
                                          " is not after the one before it; sort the keys");
        }
        return times;
    }

    GltfChannel channel_of(int node, std::string_view path, const tinygltf::AnimationSampler& sampler,
                           const Numbers& times, const std::string& place) {
        GltfChannel channel;
        channel.node = node;
        channel.times = times;
        const auto property = enumerator_named<NodeProperty>(kProperties, path);
        if (!property) {
            throw InputError(scene_.file, place,
                             "channel path " + in_quotes(path) + " must be translation, rotation, scale or weights");
        }
        channel.property = *property;
        const auto interpolation = enumerator_named<Interpolation>(kInterpolations, sampler.interpolation);
        if (!interpolation) {
            throw InputError(
                scene_.file, place,
                "interpolation " + in_quotes(sampler.interpolation) + " must be LINEAR, STEP or CUBICSPLINE");
        }
        channel.interpolation = *interpolation;
        const bool is_rotation = channel.property == NodeProperty::rotation;
        const bool is_cubic = channel.interpolation == Interpolation::cubic_spline;
        const std::size_t width = is_rotation ? 4 : 3;
        channel.values = accessors_.read(sampler.output, is_rotation ? TINYGLTF_TYPE_VEC4 : TINYGLTF_TYPE_VEC3);
        const std::size_t expected = times->size() * (is_cubic ? 3 : 1);
        if (channel.values->size() != expected * width) {
            accessors_.fail(sampler.output, "has " + std::to_string(channel.values->size() / width) +
                                                " elements, but " + std::to_string(times->size()) + " keys of " +
                                                sampler.interpolation + " need " + std::to_string(expected) +
                                                "; export the file again");
        }
        if (is_rotation) check_rotations(sampler.output, *channel.values, is_cubic);
        return channel;
    }

    void check_rotations(int accessor, const std::vector<double>& values, bool is_cubic) {
        if (!checked_rotations_.emplace(accessor, is_cubic).second) return;
        if (!accessors_.is_real(accessor)) {
            accessors_.fail(accessor, "rotations must be floats or normalized integers; export the file again");
        }
        const std::size_t keys = values.size() / (is_cubic ? 12 : 4);
        for (std::size_t key = 0; key < keys; ++key) {
            const double* q = values.data() + (is_cubic ? 12 * key + 4 : 4 * key);
            if (!(std::hypot(std::hypot(q[0], q[1]), std::hypot(q[2], q[3])) > kTolerance)) {
                accessors_.fail(accessor, "the rotation of key " + std::to_string(key) + " is zero; correct it");
            }
        }
    }

    const GltfModel& from_;
    const tinygltf::Model& model_;  ///< of it
    NodeScene scene_;
    std::vector<GltfChannel> channels_;  ///< of all animations
    std::shared_ptr<std::vector<GltfRest>> rest_ = std::make_shared<std::vector<GltfRest>>();
    GltfAccessors accessors_;
    std::set<int> checked_times_;
    std::set<std::pair<int, bool>> checked_rotations_;
};

}  // namespace

MotionFile parse_gltf(std::string_view bytes, const std::filesystem::path& file) {
    const std::string name = file.string();
    const GltfParts parts = split_gltf(bytes, lower_extension(file) == ".glb", name);
    return node_motion_file(SceneBuilder(read_gltf_model(parts, file), name).build());
}

}  // namespace mobbscope
