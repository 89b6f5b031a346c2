/// What stands out in the fits that are looked at: found beside the window, and kept for the last few trees.
#pragma once

#include <app/document/workspace.h>
#include <app/session/desktop.h>
#include <app/session/notifications.h>
#include <app/session/session_options.h>
#include <explain/fit_findings.h>

#include <deque>
#include <functional>
#include <memory>
#include <vector>

namespace mobbscope::app {

class FitNotices {
  public:
    FitNotices(Workspace& workspace, Notifications& notifications, const SessionOptions& options, Desktop*& desktop)
        : workspace_(workspace), notifications_(notifications), options_(options), desktop_(desktop) {}
    ~FitNotices() { end_work(); }
    FitNotices(const FitNotices&) = delete;
    FitNotices& operator=(const FitNotices&) = delete;

    struct Noticed {
        std::shared_ptr<const mobb::Tree> tree;
        std::vector<FitFinding> findings;
        int seen = -1;  ///< that was gone to last; -1: none
    };
    /// Of the tree of a clip of the document; null: not known yet.
    Noticed* of(int clip);
    /// Begins to find it out, one tree after the other, and calls `then` once it is known; at once if it is.
    void look(int clip, const std::function<void()>& then = {});
    /// Takes in what was found.
    void poll();
    void end_work();

  private:
    Workspace& workspace_;
    Notifications& notifications_;
    const SessionOptions& options_;
    Desktop*& desktop_;
    std::deque<Noticed> known_;                 ///< the latest last
    std::shared_ptr<const mobb::Tree> of_;      ///< the job's
    std::shared_ptr<const mobb::Tree> failed_;  ///< is looked at again only for a command
    std::function<void()> then_;
    int then_for_ = -1;  ///< the clip that it waits for
    std::unique_ptr<Job> job_;
};

}  // namespace mobbscope::app
