/// The clock that times are taken with.
#pragma once

#include <chrono>
#include <ctime>

namespace mobbscope {

/// Processor time of the calling thread: what else runs on the machine meanwhile does not count.
struct ThreadClock {
    using duration = std::chrono::nanoseconds;
    using time_point = std::chrono::time_point<ThreadClock, duration>;

    static time_point now() {
        std::timespec time{};
        clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
        return time_point(std::chrono::seconds(time.tv_sec) + std::chrono::nanoseconds(time.tv_nsec));
    }
};

inline double nanoseconds(ThreadClock::duration duration) { return static_cast<double>(duration.count()); }

}  // namespace mobbscope
