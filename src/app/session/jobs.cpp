#include <app/session/jobs.h>
#include <base/error.h>
#include <base/file.h>

#include <algorithm>
#include <memory>
#include <new>
#include <stdexcept>
#include <utility>

namespace mobbscope::app {

void Jobs::require_none() const {
    for (const RunningJob& running : workspace_.jobs) {
        if (running.purpose == JobPurpose::film) continue;
        throw std::invalid_argument("wait for \"" + running.job->title() + "\", or cancel it");
    }
}

void Jobs::start(std::string title, Job::Work work, JobPurpose purpose) {
    begin({std::make_unique<Job>(std::move(title), std::move(work), [&at = *desktop_] { at.wake(); }), purpose});
}

void Jobs::start_film(const std::filesystem::path& file, Job::Work work) {
    const std::filesystem::path whole = whole_path(file);
    if (std::ranges::count(workspace_.jobs, whole, &RunningJob::writes) > 0)
        throw InputError(file.string(), "", "a film is being written to it: wait for it, or cancel it");
    begin({std::make_unique<Job>("Drawing " + file.filename().string(), std::move(work),
                                 [&at = *desktop_] { at.wake(); }),
           JobPurpose::film, whole});
}

void Jobs::begin(RunningJob running) {
    workspace_.jobs.push_back(std::move(running));
    if (options_.attended && options_.patience.count() == 0) return;
    workspace_.jobs.back().job->wait(options_.attended ? options_.patience : std::chrono::hours(24));
    poll();
}

void Jobs::cancel(std::size_t index) {
    if (index >= workspace_.jobs.size()) return;
    if (workspace_.jobs[index].purpose == JobPurpose::imports) workspace_.import_changes.clear();
    workspace_.jobs.erase(workspace_.jobs.begin() + static_cast<std::ptrdiff_t>(index));
    notifications_.tell(MessageLevel::info, "Cancelled");
}

void Jobs::poll() {
    for (;;) {
        const auto done = std::find_if(workspace_.jobs.begin(), workspace_.jobs.end(),
                                       [](const RunningJob& r) { return r.job->done(); });
        if (done == workspace_.jobs.end()) return;
        // What it hands over may start the next one.
        const std::unique_ptr<Job> job = std::move(done->job);
        ++counts_.arrivals;
        workspace_.jobs.erase(done);
        finish(*job);
        after_each();
    }
}

bool Jobs::any(JobPurpose purpose) const {
    return std::ranges::count(workspace_.jobs, purpose, &RunningJob::purpose) > 0;
}

void Jobs::drop(JobPurpose purpose) {
    std::erase_if(workspace_.jobs, [&](const RunningJob& running) { return running.purpose == purpose; });
}

void Jobs::finish(Job& job) {
    try {
        job.finish();
    } catch (const Cancelled&) {
        notifications_.tell(MessageLevel::info, "Cancelled");
    } catch (const std::bad_alloc&) {
        notifications_.tell(MessageLevel::error, "there is not enough memory for this");
    } catch (const std::exception& error) {
        notifications_.tell(MessageLevel::error, error.what());
    }
}

}  // namespace mobbscope::app
