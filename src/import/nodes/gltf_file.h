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

/// Checks lengths and order of a GLB's chunks. Whatever begins as JSON does is text, and so is all that is no GLB,
/// unless `named_glb`. `file` stands for the file in messages. Throws InputError.
GltfParts split_gltf(std::string_view bytes, bool named_glb, const std::string& file);

/// Whether a file is glTF of version 2 or another, as GLB or as text, by its first bytes: a JSON object with a version
/// in its asset, or, where that lies beyond the bytes, with accessors or bufferViews.
bool looks_like_gltf(std::string_view head);

/// A buffer whose bytes do not stand in the text.
struct GltfOutsideBuffer {
    int buffer = 0;    ///< index in the glTF file
    std::string path;  ///< relative to the glTF file, decoded; never leads out of its folder. "": the GLB's own buffer
    /// How much of it is used. 0: it lies nowhere, which the specification allows; meshes that an extension compresses
    /// come so.
    std::size_t byte_length = 0;
};

/// A channel of KHR_animation_pointer that moves no property of a node, and so is taken out.
struct GltfUnreadPointer {
    std::size_t animation = 0;
    std::string pointer;
};

/// What is left of the text: nodes, skins, animations and what they refer to. A channel of KHR_animation_pointer that
/// moves a property of a node has it in place of its pointer, with kByPointer in front of the path.
struct GltfText {
    std::string json;
    std::vector<GltfOutsideBuffer> outside{};  ///< in the text each has a byte in place of what it holds
    std::vector<GltfUnreadPointer> unread{};   ///< in the order of the file
    /// Where the body begins in a file without skins, as VRM's animations say it: the node of the hips.
    std::optional<int> hips{};
};

inline constexpr std::string_view kByPointer = "pointer/";

/// Every index in the text that remains exists, every integer fits and every value has its type. Throws InputError
/// naming the JSON pointer.
GltfText checked_gltf_text(const GltfParts& parts, const std::string& file);

}  // namespace mobbscope
