/// A glTF file's JSON as tinygltf's model. That library's own reader wraps integers, drops what it cannot read and
/// follows extras as deep as they go, so the text is parsed and checked here, value by value.
#pragma once

#include <base/budget.h>
#include <import/nodes/gltf_file.h>
#include <tiny_gltf.h>

#include <cstddef>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace mobbscope {

/// Nodes, skins, animations and what they refer to: every index exists, and every value has its type. A buffer that
/// lies nowhere has no bytes, any other as many as the file announces. A channel has a node; one of
/// KHR_animation_pointer has the property in place of its pointer, with kByPointer in front of the path.
struct GltfModel {
    tinygltf::Model model{};
    /// By animation: the pointers of the channels of KHR_animation_pointer that lead to no property of a node, and so
    /// are taken out.
    std::map<std::size_t, std::vector<std::string>> unread{};
    /// Where the body begins in a file without skins, as VRM's animations say it: the node of the hips.
    std::optional<int> hips{};
    Spent spent{};  ///< of the budget
};

inline constexpr std::string_view kByPointer = "pointer/";

/// Reads buffers beside `file` or in folders below it. Throws InputError naming the JSON pointer or the buffer.
GltfModel read_gltf_model(const GltfParts& parts, const std::filesystem::path& file);

}  // namespace mobbscope
