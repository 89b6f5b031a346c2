/// Text in HTML and XML.
#pragma once

#include <string>
#include <string_view>

namespace mobbscope {

/// Text fit for content and for attributes in either kind of quotes, in HTML and XML 1.0. Characters that XML does not
/// allow, or that steer terminals, and bytes that are not UTF-8 become '?'.
std::string escaped(std::string_view text);

}  // namespace mobbscope
