/// What the trees in focus cost, one for each view: counted beside the window, on and on, and kept by tree.
#pragma once

#include <app/document/workspace.h>
#include <app/session/desktop.h>
#include <app/session/notifications.h>
#include <app/session/session_options.h>
#include <explain/compared_fits.h>

#include <chrono>
#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

namespace mobbscope::app {

class FitCosts {
  public:
    FitCosts(Workspace& workspace, Notifications& notifications, const SessionOptions& options, Desktop*& desktop)
        : workspace_(workspace), notifications_(notifications), options_(options), desktop_(desktop) {}
    ~FitCosts() { end_work(); }
    FitCosts(const FitCosts&) = delete;
    FitCosts& operator=(const FitCosts&) = delete;

    /// Whoever shows the cost of the clip in focus calls this before each frame: standard placements are counted of all
    /// views, a few at first and then until it is enough, and the scene's queries for the views beside the active one,
    /// once they are for that, unless these are many.
    void update(int clip);
    /// How many standard placements of a clip are counted at most.
    std::size_t most_counted() const;
    /// For other clips: the first standard placements in the active view, where nothing else is under way.
    void find_when_idle(int clip);
    /// The fits of all views over a clip, as far as their costs are known.
    const ComparedFits& compared(int clip);
    /// Whether the tests of the scene's queries are to be counted now for that: once for a scene, of few queries.
    bool wants_count();
    /// Whether the queries are so few that their tests are counted by themselves.
    bool counts_unasked() const;
    void end_work();

  private:
    Workspace& workspace_;
    Notifications& notifications_;
    const SessionOptions& options_;
    Desktop*& desktop_;

    /// What a job finds out: the cost of a clip's tree, or the counts of a whole scene.
    struct Task {
        std::shared_ptr<const FittedScene> in;
        int clip = 0;
        bool counts = false;
        bool operator==(const Task& other) const;  ///< the same comes out
    };
    /// Whether it was begun and came to nothing.
    bool has_failed(const Task& task) const;
    /// Whether something was found out; of placements more may be wanted.
    bool is_known(const Task& task) const;
    /// Whether a view still has what the task is about.
    bool is_shown(const Task& task) const;
    std::optional<Task> next_wanted(int clip) const;
    /// Of placements: the first ones, or more than are known. An attended window waits for it so long at most.
    void begin(const Task& task, std::chrono::milliseconds patience);
    void take_result();

    Task task_;  ///< the job's
    std::unique_ptr<Job> job_;
    std::vector<Task> failed_;  ///< of what views show, not begun again: what has no cost, too
    struct Compared {
        std::vector<std::shared_ptr<const mobb::Tree>> trees;
        std::vector<std::shared_ptr<const TreeCost>> costs;
        ComparedFits fits;
    };
    Compared compared_;                              ///< what it was last
    std::shared_ptr<const FittedScene> counted_in_;  ///< for which a count was asked last
};

}  // namespace mobbscope::app
