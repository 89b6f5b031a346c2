#include <base/text.h>
#include <motion_files/formats.h>
#include <tiny_gltf.h>

#include <cmath>
#include <cstddef>
#include <cstring>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <vector>

namespace mobbscope {

namespace {

std::string name_in_gltf(const std::string& name) { return is_utf8(name) ? name : cleaned(name); }

std::vector<double> numbers(const glm::dvec3& v) { return {v.x, v.y, v.z}; }
std::vector<double> numbers(const glm::dquat& q) { return {q.x, q.y, q.z, q.w}; }

/// What moves a joint, as floats, frame after frame.
struct JointTrack {
    std::vector<float> rotations;     ///< x y z w
    std::vector<float> translations;  ///< x y z; empty where the bone stays as long as it is
    glm::dquat last{1, 0, 0, 0};
};

class GlbWriter {
  public:
    explicit GlbWriter(const PlayedMotion& motion)
        : motion_(motion), joints_(motion.joints()), bones_(motion.bones()), tracks_(joints_.size()) {}

    std::string write() {
        collect();
        model_.asset.version = "2.0";
        model_.asset.generator = "Mobbscope";
        model_.buffers.emplace_back();
        add_nodes();
        add_animation();
        tinygltf::TinyGLTF writer;
        std::ostringstream out;
        if (!writer.WriteGltfSceneToStream(&model_, out, false, true)) {
            throw std::runtime_error("tinygltf could not write the motion");
        }
        return std::move(out).str();
    }

  private:
    void collect() {
        motion_.each_frame([&](std::span<const JointPose> pose) {
            // Floats are finest near 0, so places count from where the motion begins.
            if (tracks_.front().translations.empty()) start_ = {pose[0].position.x, 0, pose[0].position.z};
            for (std::size_t j = 0; j < joints_.size(); ++j) {
                const bool is_root = j == 0;
                const JointPose* above = is_root ? nullptr : &pose[static_cast<std::size_t>(joints_[j].parent)];
                JointTrack& track = tracks_[j];
                if (is_root || bones_[j].varies) {
                    const glm::dvec3 p = is_root ? pose[j].position - start_ : bone_offset(*above, pose[j]);
                    for (int i = 0; i < 3; ++i) track.translations.push_back(static_cast<float>(p[i]));
                }
                glm::dquat q = is_root ? pose[j].rotation : glm::conjugate(above->rotation) * pose[j].rotation;
                if (glm::dot(q, track.last) < 0) q = -q;  // the same rotation, without a detour in between
                track.last = q;
                for (const double number : numbers(q)) track.rotations.push_back(static_cast<float>(number));
            }
        });
    }

    void add_nodes() {
        tinygltf::Node place;
        place.name = name_in_gltf(motion_.name());
        place.translation = numbers(start_);
        place.children = {1};
        model_.nodes.push_back(std::move(place));
        tinygltf::Skin skin;
        skin.skeleton = 1;
        for (std::size_t j = 0; j < joints_.size(); ++j) {
            const std::size_t above = j == 0 ? 0 : static_cast<std::size_t>(joints_[j].parent);
            tinygltf::Node node;
            node.name = name_in_gltf(joints_[j].end_site ? joints_[above].name + "_tip" : joints_[j].name);
            const glm::dquat& rest = motion_.rest()[j];
            node.rotation = numbers(j == 0 ? rest : glm::conjugate(motion_.rest()[above]) * rest);
            if (j > 0) {
                node.translation = numbers(bones_[j].offset);
                model_.nodes[above + 1].children.push_back(static_cast<int>(j) + 1);
            }
            model_.nodes.push_back(std::move(node));
            skin.joints.push_back(static_cast<int>(j) + 1);
        }
        model_.skins.push_back(std::move(skin));
        tinygltf::Scene scene;
        scene.nodes = {0};
        model_.scenes.push_back(std::move(scene));
        model_.defaultScene = 0;
    }

    void add_animation() {
        tinygltf::Animation animation;
        animation.name = name_in_gltf(motion_.name());
        const int times = add_accessor(key_times(), TINYGLTF_TYPE_SCALAR, 1);
        const auto channel = [&](std::size_t joint, const char* path, int values) {
            tinygltf::AnimationSampler sampler;
            sampler.input = times;
            sampler.output = values;
            sampler.interpolation = "LINEAR";
            tinygltf::AnimationChannel to;
            to.sampler = static_cast<int>(animation.samplers.size());
            to.target_node = static_cast<int>(joint) + 1;
            to.target_path = path;
            animation.samplers.push_back(std::move(sampler));
            animation.channels.push_back(std::move(to));
        };
        for (std::size_t j = 0; j < tracks_.size(); ++j) {
            const JointTrack& track = tracks_[j];
            if (!track.translations.empty()) {
                channel(j, "translation", add_accessor(track.translations, TINYGLTF_TYPE_VEC3, 3));
            }
            // A tip has no axes of its own.
            if (!joints_[j].end_site) channel(j, "rotation", add_accessor(track.rotations, TINYGLTF_TYPE_VEC4, 4));
        }
        model_.animations.push_back(std::move(animation));
    }

    std::vector<float> key_times() const {
        std::vector<float> out;
        for (int i = 0; i < motion_.frames(); ++i) out.push_back(static_cast<float>(motion_.lead() + i * motion_.dt()));
        // Samples are taken up to the last key: rounding must not bring it forward.
        const double last = motion_.lead() + (motion_.frames() - 1) * motion_.dt();
        if (out.back() < last) out.back() = std::nextafter(out.back(), std::numeric_limits<float>::infinity());
        return out;
    }

    int add_accessor(const std::vector<float>& values, int type, std::size_t width) {
        std::vector<unsigned char>& bytes = model_.buffers.front().data;
        tinygltf::BufferView view;
        view.buffer = 0;
        view.byteOffset = bytes.size();
        view.byteLength = values.size() * sizeof(float);
        bytes.resize(bytes.size() + view.byteLength);
        std::memcpy(bytes.data() + view.byteOffset, values.data(), view.byteLength);
        tinygltf::Accessor accessor;
        accessor.bufferView = static_cast<int>(model_.bufferViews.size());
        accessor.componentType = TINYGLTF_COMPONENT_TYPE_FLOAT;
        accessor.type = type;
        accessor.count = values.size() / width;
        if (width == 1) {  // the specification asks it of key times
            accessor.minValues = {values.front()};
            accessor.maxValues = {values.back()};
        }
        model_.bufferViews.push_back(std::move(view));
        model_.accessors.push_back(std::move(accessor));
        return static_cast<int>(model_.accessors.size()) - 1;
    }

    const PlayedMotion& motion_;
    const std::vector<Joint>& joints_;
    const std::vector<Bone> bones_;
    std::vector<JointTrack> tracks_;
    glm::dvec3 start_{0};
    tinygltf::Model model_;
};

}  // namespace

std::string to_glb(const PlayedMotion& motion) { return GlbWriter(motion).write(); }

}  // namespace mobbscope
