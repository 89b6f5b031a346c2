/// The keys of a JSON object.
#pragma once

#include <nlohmann/json.hpp>

#include <set>
#include <string>

namespace mobbscope {
inline namespace testing {

inline std::set<std::string> keys(const nlohmann::json& object) {
    std::set<std::string> out;
    for (const auto& [key, value] : object.items()) out.insert(key);
    return out;
}

}  // namespace testing
}  // namespace mobbscope
