/// The machine that a figure was measured on, in words.
#pragma once

#include <string>

namespace mobbscope {

/// Processor, cores, compiler and whether this program was built to be fast.
std::string machine_words();

}  // namespace mobbscope
