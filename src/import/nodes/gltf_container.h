/// The two files that glTF comes as: JSON text, or a GLB that holds the text and one buffer.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace mobbscope {

/// Refers to the bytes it was split from.
struct GltfParts {
    std::string_view json;
    std::optional<std::string_view> binary;  ///< the GLB's own buffer, if it has one
    bool is_glb = false;
};

/// Checks lengths and order of a GLB's chunks; anything without its magic number is taken for text, unless
/// `must_be_glb`. `file` stands for the file in messages. Throws InputError.
GltfParts split_gltf(std::string_view bytes, bool must_be_glb, const std::string& file);

/// A GLB of these parts; `binary` is left out when empty.
std::string join_glb(std::string_view json, std::string_view binary);

}  // namespace mobbscope
