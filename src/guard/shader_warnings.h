/// What the shader compiler remarks is a fault of the program: no picture of it may pass a test.
#pragma once

#include <import/error.h>

#include <string>
#include <string_view>
#include <vector>

namespace mobbscope::guard {

/// Throws MachineError if there are any.
inline void refuse_warnings(std::string_view backend, const std::vector<std::string>& warnings) {
    if (warnings.empty()) return;
    throw MachineError(std::string(backend) + ", compiling shaders: " + warnings.front());
}

}  // namespace mobbscope::guard
