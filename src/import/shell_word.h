/// Words of command lines that are shown to be copied.
#pragma once

#include <string>

namespace mobbscope {

/// A word as a POSIX shell takes it literally: in single quotes where it needs them.
std::string shell_word(const std::string& word);

}  // namespace mobbscope
