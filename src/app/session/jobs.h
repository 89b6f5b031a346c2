/// The work that is under way for the workspace. Edits go on meanwhile: what a job has made is put into the document as
/// that is when the job ends. Only excerpts are neither opened nor left.
#pragma once

#include <app/document/workspace.h>
#include <app/session/desktop.h>
#include <app/session/notifications.h>
#include <app/session/session_options.h>

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>

namespace mobbscope::app {

class Jobs {
  public:
    Jobs(Workspace& workspace, Notifications& notifications, Counts& counts, const SessionOptions& options,
         Desktop*& desktop)
        : workspace_(workspace), notifications_(notifications), counts_(counts), options_(options), desktop_(desktop) {}

    /// Short work is waited for (SessionOptions::patience).
    void start(std::string title, Job::Work work, JobPurpose purpose = JobPurpose::other);
    /// Likewise a film into that file. Throws InputError while another one is made into it.
    void start_film(const std::filesystem::path& file, Job::Work work);
    std::size_t count() const { return workspace_.jobs.size(); }
    /// The oldest; null if none.
    const Job* job() const { return workspace_.jobs.empty() ? nullptr : workspace_.jobs.front().job.get(); }
    const Job& job(std::size_t index) const { return *workspace_.jobs[index].job; }
    /// Whether there is one of that purpose.
    bool any(JobPurpose purpose) const;
    JobPurpose purpose(std::size_t index) const { return workspace_.jobs[index].purpose; }
    /// Throws std::invalid_argument if there is one, other than of films.
    void require_none() const;
    void cancel(std::size_t index);
    /// Ends those of that purpose; nothing is said.
    void drop(JobPurpose purpose);
    /// Takes in what jobs have done.
    void poll();

    std::function<void()> after_each;  ///< once a job is done and taken in

  private:
    void begin(RunningJob running);
    void finish(Job& job);

    Workspace& workspace_;
    Notifications& notifications_;
    Counts& counts_;
    const SessionOptions& options_;
    Desktop*& desktop_;
};

}  // namespace mobbscope::app
