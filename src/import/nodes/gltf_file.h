/// What a glTF file is made of: JSON text, or a GLB that holds the text and one buffer.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace mobbscope {

/// Refers to the bytes it was split from.
struct GltfParts {
    std::string_view json;
    std::optional<std::string_view> binary{};  ///< the GLB's own buffer, if it has one
    bool is_glb = false;
};

/// Checks lengths and order of a GLB's chunks. Whatever begins as JSON does is text, and so is all that is no GLB,
/// unless `named_glb`. `file` stands for the file in messages. Throws InputError.
GltfParts split_gltf(std::string_view bytes, bool named_glb, const std::string& file);

/// Whether a file is glTF of version 2 or another, as GLB or as text, by its first bytes: a JSON object with a version
/// in its asset, or, where that lies beyond the bytes, with accessors or bufferViews.
bool looks_like_gltf(std::string_view head);

}  // namespace mobbscope
