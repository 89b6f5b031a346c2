/// What the tree in focus costs, found out beside the window and kept by tree.
#pragma once

#include <app/document/workspace.h>
#include <app/session/desktop.h>
#include <app/session/notifications.h>
#include <app/session/session_options.h>

#include <memory>

namespace mobbscope::app {

class FitCosts {
  public:
    FitCosts(Workspace& workspace, Notifications& notifications, const SessionOptions& options, Desktop*& desktop)
        : workspace_(workspace), notifications_(notifications), options_(options), desktop_(desktop) {}
    ~FitCosts() { end_work(); }
    FitCosts(const FitCosts&) = delete;
    FitCosts& operator=(const FitCosts&) = delete;

    /// Whoever shows a clip's cost calls this before each frame: under standard placements it is worked out.
    void update(int clip);
    /// Whether the tests of the scene's queries are to be counted now for that: once for a scene, of few queries.
    bool wants_count();
    void end_work();

  private:
    Workspace& workspace_;
    Notifications& notifications_;
    const SessionOptions& options_;
    Desktop*& desktop_;
    std::shared_ptr<const mobb::Tree> of_;  ///< the job's
    std::unique_ptr<Job> job_;
    std::shared_ptr<const FittedScene> counted_in_;  ///< for which a count was asked last
};

}  // namespace mobbscope::app
