/// Text and pictures inside HTML and XML.
#pragma once

#include <string>
#include <string_view>

namespace mobbscope::picture_tests {

/// Text fit for content and for attributes in either kind of quotes, in HTML and XML 1.0. Characters that XML does not
/// allow, or that steer terminals, and bytes that are not UTF-8 become '?'.
std::string escaped(std::string_view text);

/// RFC 4648, with padding.
std::string base64(std::string_view bytes);

}  // namespace mobbscope::picture_tests
