/// KHR_animation_pointer: what a channel moves, as a JSON pointer into its own file.
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

namespace mobbscope {

/// A property of a node that an ordinary channel can move too.
struct NodePointer {
    std::optional<std::size_t> node;  ///< none: what stands there is no index
    std::string_view property;        ///< "translation", "rotation", "scale", "weights" (of one morph target too)
};

/// None: it leads elsewhere, such as to a material.
std::optional<NodePointer> node_pointer(std::string_view pointer);

}  // namespace mobbscope
