/// Small glTF files for tests: floats and bytes in one buffer, the rest as JSON.
#pragma once

#include <import/nodes/gltf.h>

#include <cstdint>
#include <cstring>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

namespace mobbscope {
inline namespace testing {

/// A GLB of these parts; `binary` is left out when empty.
inline std::string join_glb(std::string_view text, std::string_view binary) {
    const auto number = [](std::size_t value) {
        std::string bytes;
        for (int i = 0; i < 4; ++i) bytes += static_cast<char>((value >> (8 * i)) & 0xff);
        return bytes;
    };
    const auto chunk = [&](const char* type, std::string_view content, char padding) {
        std::string padded(content);
        padded.append((4 - content.size() % 4) % 4, padding);
        return number(padded.size()) + std::string(type, 4) + padded;
    };
    const std::string chunks = chunk("JSON", text, ' ') + (binary.empty() ? "" : chunk("BIN\0", binary, '\0'));
    return "glTF" + number(2) + number(12 + chunks.size()) + chunks;
}

/// Collects accessors, then nodes and channels, and makes a GLB of them.
class GltfBytes {
  public:
    /// Appends numbers of one type to the buffer; the index of an accessor over them.
    template <typename T>
    int add(const std::string& type, int component, const std::vector<T>& values, const std::string& more = "") {
        const int view = add_view(values);
        const std::size_t width = type == "SCALAR" ? 1 : type == "VEC3" ? 3 : 4;
        return add_accessor(
            "\"bufferView\":" + std::to_string(view) + ",\"componentType\":" + std::to_string(component) +
            ",\"count\":" + std::to_string(values.size() / width) + ",\"type\":\"" + type + "\"" + more);
    }
    int add_floats(const std::string& type, const std::vector<float>& values) { return add(type, 5126, values); }

    /// The index of a bufferView over the values, `more` as further members of it.
    template <typename T>
    int add_view(const std::vector<T>& values, const std::string& more = "") {
        binary_.append((4 - binary_.size() % 4) % 4, '\0');
        views_ +=
            (views_.empty() ? "" : ",") + ("{\"buffer\":0,\"byteOffset\":" + std::to_string(binary_.size()) +
                                           ",\"byteLength\":" + std::to_string(values.size() * sizeof(T)) + more + "}");
        binary_.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
        return view_count_++;
    }
    int add_accessor(const std::string& members) {
        accessors_ += (accessors_.empty() ? "{" : ",{") + members + "}";
        return accessor_count_++;
    }

    /// A channel of the animation that is begun last; `node` "" leaves the target without one.
    GltfBytes& channel(const std::string& node, const std::string& path, int input, int output,
                       const std::string& interpolation = "LINEAR") {
        return channel_to((node.empty() ? "" : "\"node\":" + node + ",") + "\"path\":\"" + path + "\"", input, output,
                          interpolation);
    }
    /// The same by KHR_animation_pointer.
    GltfBytes& pointer_channel(const std::string& pointer, int input, int output,
                               const std::string& interpolation = "LINEAR") {
        return channel_to(R"("path":"pointer","extensions":{"KHR_animation_pointer":{"pointer":")" + pointer + "\"}}",
                          input, output, interpolation);
    }
    /// The same with the members of its target.
    GltfBytes& channel_to(const std::string& target, int input, int output,
                          const std::string& interpolation = "LINEAR") {
        channels_ += (channels_.empty() ? "" : ",") +
                     ("{\"sampler\":" + std::to_string(channel_count_++) + ",\"target\":{" + target + "}}");
        samplers_ += (samplers_.empty() ? "" : ",") +
                     ("{\"input\":" + std::to_string(input) + ",\"output\":" + std::to_string(output) +
                      ",\"interpolation\":\"" + interpolation + "\"}");
        return *this;
    }
    /// Ends the animation that the channels so far belong to.
    GltfBytes& animation(const std::string& name = "") {
        animations_ +=
            (animations_.empty() ? "" : ",") + ("{" + (name.empty() ? "" : "\"name\":\"" + name + "\",") +
                                                "\"channels\":[" + channels_ + "],\"samplers\":[" + samplers_ + "]}");
        channels_.clear();
        samplers_.clear();
        channel_count_ = 0;
        return *this;
    }

    /// `rest` are further members of the root, each with a comma in front.
    std::string text(const std::string& nodes, const std::string& rest = "", const std::string& uri = "") const {
        return R"({"asset":{"version":"2.0"},"nodes":)" + nodes + ",\"accessors\":[" + accessors_ +
               "],\"bufferViews\":[" + views_ + "],\"buffers\":[{\"byteLength\":" + std::to_string(binary_.size()) +
               (uri.empty() ? "" : ",\"uri\":\"" + uri + "\"") + "}]" +
               (animations_.empty() ? "" : ",\"animations\":[" + animations_ + "]") + rest + "}";
    }
    std::string glb(const std::string& nodes, const std::string& rest = "") const {
        return join_glb(text(nodes, rest), binary_);
    }
    const std::string& binary() const { return binary_; }

  private:
    std::string binary_;
    std::string views_;
    std::string accessors_;
    std::string channels_;
    std::string samplers_;
    std::string animations_;
    int view_count_ = 0;
    int accessor_count_ = 0;
    int channel_count_ = 0;
};

/// A bit of everything: all interpolations, integers, sparse and interleaved elements, skins, morph targets, pointers.
inline GltfBytes everything_in_gltf() {
    GltfBytes bytes;
    const int times = bytes.add_floats("SCALAR", {0, 0.5F, 1});
    const int places = bytes.add_floats("VEC3", {0, 1, 0, 1, 1, 0, 2, 1, 0});
    const std::vector<std::int16_t> turns{0, 0, 0, 32767, 0, 23170, 0, 23170, 0, 32767, 0, 0};
    const int rotations = bytes.add("VEC4", 5122, turns, ",\"normalized\":true");
    const int splines = bytes.add_floats("VEC3", std::vector<float>(27, 0.5F));
    const int indices = bytes.add_view(std::vector<std::uint8_t>{0, 2});
    const int values = bytes.add_view(std::vector<float>{0, 1, 0, 0, 2, 0}, ",\"byteStride\":12");
    const int sparse = bytes.add_accessor(
        R"("componentType":5126,"count":3,"type":"VEC3","sparse":{"count":2,"indices":{"bufferView":)" +
        std::to_string(indices) + R"(,"componentType":5121},"values":{"bufferView":)" + std::to_string(values) + "}}");
    bytes.channel("1", "translation", times, places).channel("1", "rotation", times, rotations);
    bytes.channel("2", "translation", times, splines, "CUBICSPLINE").channel("2", "scale", times, sparse, "STEP");
    bytes.channel("0", "weights", times, times).pointer_channel("/nodes/0/translation", times, places);
    bytes.pointer_channel("/nodes/2/weights/0", times, times).pointer_channel("/materials/0/alphaCutoff", times, times);
    bytes.animation("walk");
    return bytes;
}

/// Of it.
inline const std::string kEverythingNodes =
    R"([{"children":[1],"scale":[1,1,1],"rotation":[0,0,0,1]},{"name":"hips","children":[2,3]},)"
    R"({"name":"hand","translation":[0.3,0,0]},{"matrix":[1,0,0,0,0,1,0,0,0,0,1,0,0.1,0.2,0.3,1]}])";

inline const std::string kEverythingSkins = R"(,"skins":[{"joints":[2]},{"joints":[1,2],"skeleton":0},{"joints":[3]}])";

}  // namespace testing
}  // namespace mobbscope
