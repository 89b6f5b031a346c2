/// Enumerators to names and back. Internal to the library's sources.
#pragma once

#include <algorithm>
#include <optional>
#include <span>
#include <string_view>

namespace mobb {

/// `names` lists the names of the enumerators 0, 1, 2, ...
template <class Enum>
std::optional<Enum> from_name(std::span<const std::string_view> names, std::string_view name) {
    const auto found = std::ranges::find(names, name);
    if (found == names.end()) return std::nullopt;
    return static_cast<Enum>(found - names.begin());
}

}  // namespace mobb
