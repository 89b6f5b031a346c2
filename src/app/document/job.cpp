#include <app/document/job.h>

#include <condition_variable>
#include <memory>
#include <system_error>
#include <thread>
#include <utility>

namespace mobbscope::app {

namespace {

std::atomic<int> running_jobs = 0;

/// Counts itself.
struct Counted {
    Counted() { ++running_jobs; }
    ~Counted() { --running_jobs; }
    Counted(const Counted&) = delete;
    Counted& operator=(const Counted&) = delete;
};

}  // namespace

void JobControl::check() const {
    if (cancelled_) throw Cancelled();
}

void JobControl::step(std::size_t done, std::size_t all) {
    check();
    progress_ = all == 0 ? 1.0 : static_cast<double>(done) / static_cast<double>(all);
}

void JobControl::tell_news() {
    const std::scoped_lock lock(waking_);
    if (wake_) wake_();
}

void JobControl::cancel() {
    cancelled_ = true;
    const std::scoped_lock lock(waking_);
    wake_ = nullptr;
}

std::function<void(std::size_t done, std::size_t all)> progress_of(JobControl& control) {
    return [&control](std::size_t done, std::size_t all) { control.step(done, all); };
}

/// Kept alive by whoever needs it longer, the window or the job's thread.
struct Job::Shared {
    explicit Shared(std::function<void()> wake) : control(std::move(wake)) {}

    Counted counted;  // first, so that it goes last
    JobControl control;
    std::mutex mutex;
    std::condition_variable changed;
    bool done = false;
    Finish finish;
    std::exception_ptr error;
};

Job::Job(std::string title, Work work, std::function<void()> wake)
    : title_(std::move(title)), shared_(std::make_shared<Shared>(std::move(wake))) {
    auto to_the_end = [shared = shared_, work = std::move(work)]() mutable {
        Finish finish;
        std::exception_ptr error;
        try {
            finish = work(shared->control);
        } catch (...) {
            error = std::current_exception();
        }
        // What the work holds goes before the window hears of its end.
        work = nullptr;
        {
            const std::scoped_lock lock(shared->mutex);
            shared->finish = std::move(finish);
            shared->error = error;
            shared->done = true;
        }
        shared->changed.notify_all();
        shared->control.tell_news();
    };
    // Shared: a thread that cannot be started takes with it what it was given.
    const auto all = std::make_shared<decltype(to_the_end)>(std::move(to_the_end));
    try {
        std::thread([all] { (*all)(); }).detach();
    } catch (const std::system_error&) {
        // Slower, and the window stands still meanwhile.
        (*all)();
    }
}

Job::~Job() { cancel(); }

void Job::cancel() { shared_->control.cancel(); }

bool Job::any_left() { return running_jobs > 0; }

double Job::progress() const { return shared_->control.progress(); }

bool Job::wait(std::chrono::milliseconds longest) const {
    std::unique_lock lock(shared_->mutex);
    return shared_->changed.wait_for(lock, longest, [&] { return shared_->done; });
}

void Job::finish() {
    if (shared_->error) std::rethrow_exception(shared_->error);
    if (const Finish finish = std::exchange(shared_->finish, nullptr)) finish();
}

}  // namespace mobbscope::app
