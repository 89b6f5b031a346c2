/// Work that another thread does meanwhile, piece after piece.
#pragma once

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>

namespace mobbscope {

/// One thread, started with the first piece; where the system starts none, pieces are done as they are added.
class WorkQueue {
  public:
    /// `most` (>= 1) pieces wait.
    explicit WorkQueue(std::size_t most) : most_(most) {}
    /// What waits is dropped; what is being done is waited for.
    ~WorkQueue();
    WorkQueue(const WorkQueue&) = delete;
    WorkQueue& operator=(const WorkQueue&) = delete;

    /// Waits for room. Throws what an earlier piece threw; no other is done after that.
    void add(std::function<void()> piece);
    /// Waits until all is done. Throws likewise.
    void finish();

  private:
    void work();
    void check() const;

    std::size_t most_;
    std::mutex mutex_;
    std::condition_variable changed_;
    std::deque<std::function<void()>> waiting_;
    bool is_working_ = false;
    bool is_over_ = false;
    std::exception_ptr error_;
    std::thread thread_;
};

}  // namespace mobbscope
