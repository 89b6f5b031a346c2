#include <base/work_queue.h>

#include <system_error>
#include <utility>

namespace mobbscope {

WorkQueue::~WorkQueue() {
    {
        const std::scoped_lock lock(mutex_);
        waiting_.clear();
        is_over_ = true;
    }
    changed_.notify_all();
    if (thread_.joinable()) thread_.join();
}

void WorkQueue::add(std::function<void()> piece) {
    if (!thread_.joinable()) {
        try {
            thread_ = std::thread([this] { work(); });
        } catch (const std::system_error&) {
            return piece();
        }
    }
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return error_ || waiting_.size() < most_; });
    check();
    waiting_.push_back(std::move(piece));
    changed_.notify_all();
}

void WorkQueue::finish() {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return error_ || (waiting_.empty() && !is_working_); });
    check();
}

void WorkQueue::check() const {
    if (error_) std::rethrow_exception(error_);
}

void WorkQueue::work() {
    std::unique_lock lock(mutex_);
    for (;;) {
        changed_.wait(lock, [this] { return is_over_ || !waiting_.empty(); });
        if (is_over_) return;
        std::function<void()> piece = std::move(waiting_.front());
        waiting_.pop_front();
        is_working_ = true;
        lock.unlock();
        std::exception_ptr error;
        try {
            piece();
        } catch (...) {
            error = std::current_exception();
        }
        // What it holds goes before anybody hears of its end.
        piece = nullptr;
        lock.lock();
        is_working_ = false;
        if (error) {
            error_ = error;
            waiting_.clear();
        }
        changed_.notify_all();
    }
}

}  // namespace mobbscope
