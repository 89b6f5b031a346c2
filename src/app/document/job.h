/// Long work beside the window: cancellable, with progress.
#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>
#include <exception>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <utility>

namespace mobbscope::app {

/// Thrown inside a job that was cancelled.
struct Cancelled : std::exception {
    const char* what() const noexcept override { return "cancelled"; }
};

/// What a job and the window tell each other. Safe from both threads.
class JobControl {
  public:
    /// `wake`: see tell_news; it must not call the job.
    explicit JobControl(std::function<void()> wake) : wake_(std::move(wake)) {}

    /// The job: throws Cancelled if the person had enough.
    void check() const;
    /// The job: so much is done. Throws likewise.
    void step(std::size_t done, std::size_t all);
    /// The job: there is news. Wakes the window, unless the job was cancelled.
    void tell_news();
    /// Once this returns nobody is woken any more.
    void cancel();
    /// 0..1; below 0 while nothing is known.
    double progress() const { return progress_; }

  private:
    std::atomic<bool> cancelled_ = false;
    std::atomic<double> progress_ = -1;
    std::mutex waking_;
    std::function<void()> wake_;  ///< empty when nobody waits any more
};

/// Tells a job how much is done; it ends there if it was cancelled.
std::function<void(std::size_t done, std::size_t all)> progress_of(JobControl& control);

/// One piece of work in a thread of its own, or, where the system starts no more threads, done as it is made. It works
/// on what it was given by value and hands over a closure that the window's thread runs.
class Job {
  public:
    using Finish = std::function<void()>;
    using Work = std::function<Finish(JobControl&)>;

    /// `wake` is called, from the job's thread, when the work is done or has news (JobControl::tell_news), unless the
    /// job is gone by then. It must not call the job.
    Job(std::string title, Work work, std::function<void()> wake);
    /// Cancels. A job in the midst of a long step ends by itself later; its result is dropped.
    ~Job();
    void cancel();
    Job(const Job&) = delete;
    Job& operator=(const Job&) = delete;

    /// Whether there is any job, or a dropped one is still at work: then no static may be destroyed.
    static bool any_left();

    const std::string& title() const { return title_; }
    double progress() const;
    /// Waits so long at most; true if the work is done.
    bool wait(std::chrono::milliseconds longest) const;
    bool done() const { return wait(std::chrono::milliseconds(0)); }
    /// Of a job that is done: runs its closure, or throws what the work threw (Cancelled too). Once.
    void finish();

  private:
    struct Shared;
    std::string title_;
    std::shared_ptr<Shared> shared_;
};

/// What a job is for: `opens` replaces the document; a `film` is of what was seen when it began, and goes on whatever
/// is opened.
enum class JobPurpose { other, opens, imports, film };
struct RunningJob {
    std::unique_ptr<Job> job;
    JobPurpose purpose = JobPurpose::other;
    std::filesystem::path writes{};  ///< of a film: the file, from the root
};

}  // namespace mobbscope::app
