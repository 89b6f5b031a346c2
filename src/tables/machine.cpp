#include <import/text.h>
#include <tables/machine.h>

#include <fstream>
#include <thread>

namespace mobbscope {

namespace {

/// Linux says it in /proc/cpuinfo; elsewhere it stays unknown.
std::string processor() {
    std::ifstream file("/proc/cpuinfo");
    for (std::string line; std::getline(file, line);) {
        const std::size_t colon = line.find(':');
        if (line.starts_with("model name") && colon != std::string::npos) {
            return cleaned(trimmed(std::string_view(line).substr(colon + 1)));
        }
    }
    return "unknown processor";
}

}  // namespace

std::string machine_words() {
#ifdef NDEBUG
    const char* const build = "optimised";
#else
    const char* const build = "with assertions: times are no measure";
#endif
    return processor() + ", " + counted(static_cast<long long>(std::thread::hardware_concurrency()), "core", "cores") +
           ", " + (__VERSION__[0] >= '0' && __VERSION__[0] <= '9' ? "GCC " : "") + __VERSION__ + ", " + build;
}

}  // namespace mobbscope
