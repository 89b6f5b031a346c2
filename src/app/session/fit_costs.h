/// What the trees in focus cost, one for each view: found out beside the window and kept by tree.
#pragma once

#include <app/document/workspace.h>
#include <app/session/desktop.h>
#include <app/session/notifications.h>
#include <app/session/session_options.h>
#include <explain/compared_fits.h>

#include <memory>
#include <vector>

namespace mobbscope::app {

class FitCosts {
  public:
    FitCosts(Workspace& workspace, Notifications& notifications, const SessionOptions& options, Desktop*& desktop)
        : workspace_(workspace), notifications_(notifications), options_(options), desktop_(desktop) {}
    ~FitCosts() { end_work(); }
    FitCosts(const FitCosts&) = delete;
    FitCosts& operator=(const FitCosts&) = delete;

    /// Whoever shows a clip's cost calls this before each frame: under standard placements it is worked out, and in the
    /// scene's queries counted for the views beside the active one, once it is for that.
    void update(int clip);
    /// The fits of all views over a clip, as far as their costs are known.
    const ComparedFits& compared(int clip);
    /// Whether the tests of the scene's queries are to be counted now for that: once for a scene, of few queries.
    bool wants_count();
    void end_work();

  private:
    Workspace& workspace_;
    Notifications& notifications_;
    const SessionOptions& options_;
    Desktop*& desktop_;
    /// What is to be found out next; null: nothing, or it is under way.
    std::shared_ptr<const FittedScene> next_unknown(int clip) const;

    std::shared_ptr<const mobb::Tree> of_;  ///< the job's, or one of which it failed
    std::unique_ptr<Job> job_;
    struct Compared {
        std::vector<std::shared_ptr<const mobb::Tree>> trees;
        std::vector<std::shared_ptr<const TreeCost>> costs;
        ComparedFits fits;
    };
    Compared compared_;                              ///< what it was last
    std::shared_ptr<const FittedScene> counted_in_;  ///< for which a count was asked last
};

}  // namespace mobbscope::app
