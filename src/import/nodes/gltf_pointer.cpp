#include <import/nodes/gltf_pointer.h>

#include <algorithm>
#include <charconv>

namespace mobbscope {

namespace {

constexpr std::string_view kNodes = "/nodes/";

/// JSON's pointers write an index in digits, without zeros in front.
std::optional<std::size_t> pointer_index(std::string_view text) {
    const bool is_index = !text.empty() && text.find_first_not_of("0123456789") == std::string_view::npos &&
                          (text == "0" || text.front() != '0');
    std::size_t index = 0;
    if (!is_index || std::from_chars(text.data(), text.data() + text.size(), index).ec != std::errc()) return {};
    return index;
}

}  // namespace

std::optional<NodePointer> node_pointer(std::string_view pointer) {
    if (!pointer.starts_with(kNodes)) return std::nullopt;
    pointer.remove_prefix(kNodes.size());
    const std::size_t end = std::min(pointer.find('/'), pointer.size());
    std::string_view property = pointer.substr(std::min(end + 1, pointer.size()));
    constexpr std::string_view kWeights = "weights";
    if (property.starts_with("weights/")) property = kWeights;
    if (property != "translation" && property != "rotation" && property != "scale" && property != kWeights) return {};
    return NodePointer{pointer_index(pointer.substr(0, end)), property};
}

}  // namespace mobbscope
