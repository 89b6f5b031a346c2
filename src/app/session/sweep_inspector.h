/// Which tree to ship: many fits of the scene's clips on the same queries, tried beside the window when asked for.
#pragma once

#include <app/document/job.h>
#include <app/document/workspace.h>
#include <app/session/desktop.h>
#include <app/session/notifications.h>
#include <app/session/session_options.h>
#include <explain/fit_sweep.h>
#include <explain/time_scale_curves.h>

#include <memory>
#include <mutex>
#include <optional>
#include <string_view>
#include <utility>

namespace mobbscope::app {

/// The section of its panel, as settings call it.
inline constexpr std::string_view kSweepSection = "which tree to ship";

class SweepInspector {
  public:
    SweepInspector(Workspace& workspace, Notifications& notifications, const SessionOptions& options, Desktop*& desktop)
        : workspace_(workspace), notifications_(notifications), options_(options), desktop_(desktop) {}
    ~SweepInspector() { cancel(); }
    SweepInspector(const SweepInspector&) = delete;
    SweepInspector& operator=(const SweepInspector&) = delete;

    // What is tried besides all kinds of trees and leaves of 1 to 200 samples.
    bool over_axes = false;
    bool over_time_scale = false;
    bool shows_volume = true;  ///< of the levels over the time scale; else their cost

    FitTimer timer = time_queries;

    /// What a sweep tries now.
    SweepOrder order() const;

    /// Begins one, of a scene with clips, in place of the one that is under way, on the queries that costs are about
    /// (Workspace::workload).
    void start();
    /// Ends the one under way; what it has found so far is dropped.
    void cancel();
    /// Takes in what a sweep has found. Call it before each frame.
    void update();

    /// Whether a sweep has ended since this was asked last.
    bool take_news() { return std::exchange(has_news_, false); }

    bool is_running() const { return job_ != nullptr; }
    const Job* job() const { return job_.get(); }  ///< null: none is under way
    struct Shown {
        std::shared_ptr<const SweepResult> rows;  ///< never null
        QueryWorkload::Kind workload;
        double area, offset;                                    ///< of standard placements, see QueryWorkload
        std::shared_ptr<const std::vector<LevelCurve>> curves;  ///< where time scales were tried; null: not yet
    };
    /// Of the sweep under way what it has so far, else of the last that ended.
    std::optional<Shown> result() const;
    /// Whether result() is of the clips and queries that the scene has now.
    bool is_of_scene() const;

  private:
    /// A sweep: what it is of, and what it has found.
    struct Sweep {
        std::shared_ptr<const Scene> scene;
        QueryWorkload::Kind kind = QueryWorkload::Kind::placements;
        mutable std::mutex mutex;  ///< of what follows
        std::shared_ptr<const SweepResult> result;
        double area = 0, offset = 0;
        std::shared_ptr<const std::vector<LevelCurve>> curves;
    };

    /// The one of result(), or null.
    std::shared_ptr<const Sweep> shown() const;

    Workspace& workspace_;
    Notifications& notifications_;
    const SessionOptions& options_;
    Desktop*& desktop_;
    std::shared_ptr<Sweep> running_, ended_;
    std::unique_ptr<Job> job_;
    /// What was compared last: a sweep with the scene of the document.
    mutable std::pair<std::shared_ptr<const Sweep>, std::shared_ptr<const Scene>> compared_;
    mutable bool is_same_ = false;
    bool has_news_ = false;
};

}  // namespace mobbscope::app
