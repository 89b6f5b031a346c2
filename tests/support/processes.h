/// What becomes of other processes.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <fstream>
#include <functional>
#include <string>
#include <thread>

namespace mobbscope {
inline namespace testing {

/// Whether it holds within a few seconds.
inline bool comes(const std::function<bool()>& holds) {
    for (int i = 0; i < 1000 && !holds(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(5));
    return holds();
}

inline bool is_alive(pid_t process) {
    // A zombie is none.
    const std::string status = "/proc/" + std::to_string(process) + "/stat";
    std::ifstream in(status);
    std::string all;
    return std::getline(in, all) && all.find(") Z ") == std::string::npos;
}

}  // namespace testing
}  // namespace mobbscope
