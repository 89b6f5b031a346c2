/// A glTF file before tinygltf sees it. It comes as JSON text, or as a GLB that holds the text and one buffer. The JSON
/// is checked value by value: that library wraps integers, drops what it cannot read and follows extras as deep as
/// they go.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

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

/// A buffer whose bytes do not stand in the text.
struct GltfOutsideBuffer {
    int buffer = 0;    ///< index in the glTF file
    std::string path;  ///< relative to the glTF file, decoded; never leads out of its folder. "": the GLB's own buffer
    /// How much of it is used. 0: it lies nowhere, which the specification allows; meshes that an extension compresses
    /// come so.
    std::size_t byte_length = 0;
};

/// What is left of the text: nodes, skins, animations and what they refer to.
struct GltfText {
    std::string json;
    std::vector<GltfOutsideBuffer> outside;  ///< in the text each has a byte in place of what it holds
};

/// Every index in the text that remains exists, every integer fits and every value has its type. Throws InputError
/// naming the JSON pointer.
GltfText checked_gltf_text(const GltfParts& parts, const std::string& file);

}  // namespace mobbscope
