#include <base/lock.h>

#include <fcntl.h>
#include <sys/file.h>

#include <cerrno>
#include <thread>

namespace mobbscope {

Descriptor lock_folder(const std::filesystem::path& folder, std::chrono::milliseconds longest) {
    constexpr std::chrono::milliseconds kAskEvery{5};
    const auto end = std::chrono::steady_clock::now() + longest;
    Descriptor out(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
    while (out.is_open() && ::flock(out.get(), LOCK_EX | LOCK_NB) != 0) {
        if (errno != EWOULDBLOCK || std::chrono::steady_clock::now() >= end) return Descriptor();
        std::this_thread::sleep_for(kAskEvery);
    }
    return out;
}

}  // namespace mobbscope
