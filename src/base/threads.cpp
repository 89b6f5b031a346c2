#include <base/threads.h>

#include <tbb/global_control.h>
#include <tbb/info.h>

#include <chrono>
#include <cstddef>
#include <filesystem>
#include <mutex>
#include <new>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

namespace mobbscope {

namespace {

struct Workers {
    std::mutex mutex;
    bool are_limited = false;
    tbb::global_control* control = nullptr;  ///< never ended: as it ended, TBB would start what it held back
};
Workers workers;

/// A thread that was joined still counts for a moment, and would keep the next from starting.
void wait_until_gone(int left) {
    using namespace std::chrono;
    for (const auto end = steady_clock::now() + milliseconds(200); thread_count() > left;) {
        if (steady_clock::now() > end) return;
        std::this_thread::sleep_for(microseconds(50));
    }
}

}  // namespace

int thread_count() {
    std::error_code error;
    int count = 0;
    for (std::filesystem::directory_iterator task("/proc/self/task", error), end; !error && task != end;
         task.increment(error)) {
        ++count;
    }
    return error ? 0 : count;
}

int startable_threads(int wanted) {
    const int before = thread_count();
    std::mutex all_stand;
    std::vector<std::thread> started;
    started.reserve(static_cast<std::size_t>(wanted));
    {
        const std::scoped_lock lock(all_stand);
        try {
            while (static_cast<int>(started.size()) < wanted) {
                started.emplace_back([&all_stand] { const std::scoped_lock wait(all_stand); });
            }
        } catch (const std::system_error&) {
            // So many it is.
        } catch (const std::bad_alloc&) {
            // Likewise.
        }
    }
    for (std::thread& thread : started) thread.join();
    wait_until_gone(before);
    return static_cast<int>(started.size());
}

void limit_worker_threads() {
    const std::scoped_lock lock(workers.mutex);
    if (std::exchange(workers.are_limited, true)) return;
    const int wanted = tbb::info::default_concurrency() - 1;
    const int startable = startable_threads(wanted);
    if (startable == wanted) return;
    workers.control =
        new tbb::global_control(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(startable) + 1);
}

void end_worker_threads() {
    const std::scoped_lock lock(workers.mutex);
    if (!std::exchange(workers.are_limited, false)) return;
    tbb::task_scheduler_handle all{tbb::attach{}};
    if (tbb::finalize(all, std::nothrow)) wait_until_gone(1);
}

}  // namespace mobbscope
