/// Bytes as text.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace mobbscope {

/// RFC 4648, with padding.
std::string base64(std::string_view bytes);
/// The bytes again; nothing for what base64 does not write.
std::optional<std::string> from_base64(std::string_view text);

}  // namespace mobbscope
