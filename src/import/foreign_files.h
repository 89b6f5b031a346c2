/// Files that no reader takes, by what they begin with.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace mobbscope {

/// What the bytes look like, and what to do: "looks like a ZIP archive (...); export the table as CSV". Nothing where
/// they look like nothing known.
std::optional<std::string> foreign_kind(std::string_view bytes);

}  // namespace mobbscope
