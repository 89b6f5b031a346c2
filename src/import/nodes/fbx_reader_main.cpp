// The process that Assimp runs in: mobbscope-fbx FILE writes a packet (scene_packet.h) to standard output. It is
// started by fbx.cpp, not by people.
#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <import/nodes/node_scene.h>
#include <sys/resource.h>
#include <unistd.h>

#include <assimp/Importer.hpp>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <new>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace {

using namespace mobbscope;

constexpr double kDefaultTicksPerSecond = 25;  // Assimp's convention for files that do not say
constexpr double kCentimetre = 0.01;           // the unit of UnitScaleFactor

glm::dvec3 vector_of(const aiVector3D& v) { return {v.x, v.y, v.z}; }

Affine affine(const aiMatrix4x4& m) {
    return {{m.a1, m.b1, m.c1, m.a2, m.b2, m.c2, m.a3, m.b3, m.c3}, {m.a4, m.b4, m.c4}};
}

TranslationRotationScale decomposed(const aiMatrix4x4& m) {
    aiVector3D scale;
    aiQuaternion rotation;
    aiVector3D translation;
    m.Decompose(scale, rotation, translation);
    glm::dquat q{rotation.w, rotation.x, rotation.y, rotation.z};
    const double length = glm::length(q);
    // A scale of zero leaves no rotation to be found.
    q = length > 1e-6 && std::isfinite(length) ? q / length : glm::dquat{1, 0, 0, 0};
    return {vector_of(translation), q, vector_of(scale)};
}

std::vector<double> components(const aiVector3D& v) { return {v.x, v.y, v.z}; }
std::vector<double> components(const aiQuaternion& q) { return {q.x, q.y, q.z, q.w}; }

template <typename Key>
void add_channel(NodeAnimation& animation, int node, NodeProperty property, const Key* keys, unsigned count,
                 double ticks_per_second) {
    std::vector<double> times;
    std::vector<double> values;
    for (unsigned i = 0; i < count; ++i) {
        const double time = keys[i].mTime / ticks_per_second;
        // Curves of one node are merged key by key, which now and then leaves a time twice.
        if (!times.empty() && !(time > times.back())) continue;
        times.push_back(time);
        const std::vector<double> value = components(keys[i].mValue);
        values.insert(values.end(), value.begin(), value.end());
    }
    if (times.empty()) return;
    animation.channels.push_back({node, property, Interpolation::linear,
                                  std::make_shared<const std::vector<double>>(std::move(times)),
                                  std::make_shared<const std::vector<double>>(std::move(values))});
}

NodeAnimation animation_of(const aiAnimation& from, const std::unordered_map<std::string_view, int>& node_of) {
    NodeAnimation animation;
    animation.name = from.mName.C_Str();
    const double ticks = from.mTicksPerSecond > 0 ? from.mTicksPerSecond : kDefaultTicksPerSecond;
    for (unsigned i = 0; i < from.mNumChannels; ++i) {
        const aiNodeAnim& channel = *from.mChannels[i];
        const auto node = node_of.find({channel.mNodeName.data, channel.mNodeName.length});
        if (node == node_of.end()) continue;
        add_channel(animation, node->second, NodeProperty::translation, channel.mPositionKeys, channel.mNumPositionKeys,
                    ticks);
        add_channel(animation, node->second, NodeProperty::rotation, channel.mRotationKeys, channel.mNumRotationKeys,
                    ticks);
        add_channel(animation, node->second, NodeProperty::scale, channel.mScalingKeys, channel.mNumScalingKeys, ticks);
    }
    // Assimp counts time from the start of the take, which may begin and end in a held pose without keys.
    animation.times.last = std::max(0.0, from.mDuration / ticks);
    return animation;
}

NodeScene scene_of(const aiScene& from) {
    NodeScene scene;
    std::unordered_map<std::string_view, int> node_of;
    std::vector<std::pair<const aiNode*, int>> open{{from.mRootNode, -1}};  // no recursion: files may nest without end
    while (!open.empty()) {
        const auto [node, parent] = open.back();
        open.pop_back();
        const int index = static_cast<int>(scene.nodes.size());
        scene.nodes.push_back(
            {node->mName.C_Str(), parent, decomposed(node->mTransformation), affine(node->mTransformation)});
        node_of.try_emplace({node->mName.data, node->mName.length}, index);
        for (unsigned i = node->mNumChildren; i-- > 0;) open.push_back({node->mChildren[i], index});
    }
    for (unsigned i = 0; i < from.mNumAnimations; ++i) {
        scene.animations.push_back(animation_of(*from.mAnimations[i], node_of));
    }
    float factor = 1;
    if (from.mMetaData) from.mMetaData->Get("UnitScaleFactor", factor);
    if (std::isfinite(factor) && factor > 0) scene.unit = static_cast<double>(factor) * kCentimetre;
    return scene;
}

/// A damaged file must not take the machine along.
void limit_resources(std::uintmax_t file_size) {
    const auto limit = [](auto resource, rlim_t value) {
        const rlimit both{value, value};
        ::setrlimit(resource, &both);
    };
    limit(RLIMIT_CORE, 0);
    limit(RLIMIT_CPU, 10 + file_size / 2'000'000);
#if !defined(__SANITIZE_ADDRESS__)  // which reserves address space by the terabyte
    limit(RLIMIT_AS, (rlim_t{1} << 30) + 64 * file_size);
#endif
}

std::string read(const char* file) {
    try {
        Assimp::Importer importer;
        // With pivots preserved, each becomes a node of its own and Assimp 5.2 puts rotations on the wrong ones.
        importer.SetPropertyBool(AI_CONFIG_IMPORT_FBX_PRESERVE_PIVOTS, false);
        importer.SetPropertyBool(AI_CONFIG_IMPORT_FBX_READ_MATERIALS, false);
        importer.SetPropertyBool(AI_CONFIG_IMPORT_FBX_READ_TEXTURES, false);
        const aiScene* scene = importer.ReadFile(file, 0);
        if (!scene || !scene->mRootNode) return pack_error(importer.GetErrorString());
        return pack(scene_of(*scene));
    } catch (const std::bad_alloc&) {
        return pack_error("it needs more memory than a file of its size should");
    } catch (const std::exception& error) {
        return pack_error(error.what());
    }
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 2) {
        std::fputs("mobbscope-fbx reads FBX files for mobbscope; run mobbscope instead\n", stderr);
        return 2;
    }
    std::error_code error;
    const std::uintmax_t size = std::filesystem::file_size(argv[1], error);
    limit_resources(error ? 0 : size);
    // What Assimp may print must not get between the bytes of the packet.
    const int output = ::dup(STDOUT_FILENO);
    ::dup2(STDERR_FILENO, STDOUT_FILENO);
    const std::string packet = read(argv[1]);
    std::FILE* out = ::fdopen(output, "wb");
    const bool is_written =
        out && std::fwrite(packet.data(), 1, packet.size(), out) == packet.size() && std::fclose(out) == 0;
    // Taking Assimp's data apart again would only cost time.
    std::_Exit(is_written ? 0 : 1);
}
