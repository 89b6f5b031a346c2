/// How much is read from files, for tests that hold work against data.
#pragma once

#include <cstdint>
#include <fstream>
#include <string>

namespace mobbscope {
inline namespace testing {

/// Bytes that this process has read so far, as the kernel counts them; 0 always where it does not.
inline std::uint64_t bytes_read() {
    std::ifstream counts("/proc/self/io");
    std::string name;
    std::uint64_t bytes = 0;
    counts >> name >> bytes;
    return name == "rchar:" ? bytes : 0;
}

}  // namespace testing
}  // namespace mobbscope
