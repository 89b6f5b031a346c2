/// Edits that may take long, and undo.
#pragma once

#include <app/document/workspace.h>
#include <app/session/jobs.h>
#include <app/session/playback.h>

#include <cstddef>
#include <functional>
#include <string>

namespace mobbscope::app {

/// An edit that may make fits.
struct FitEdit {
    EditName name;
    std::function<void(Scene&)> change;      ///< holds by value what it needs
    JobPurpose purpose = JobPurpose::other;  ///< of the job
    std::function<void()> then{};            ///< once the document has changed; may be empty
    bool goes_on = false;                    ///< with the last edit, if that has the same group
};

class Edits {
  public:
    Edits(Workspace& workspace, Jobs& jobs, Playback& playback, Counts& counts)
        : workspace_(workspace), jobs_(jobs), playback_(playback), counts_(counts) {}

    /// Does it at once, or, if the fits take long, in a job: `change` may run again then. `fitted_beside`: has trees to
    /// share; null: none. Throws as Workspace::edit does: nothing is changed then.
    void edit(const FitEdit& edit, const FittedScene* fitted_beside = nullptr);
    /// Changes the options of the active view's fit, likewise.
    void refit(const EditName& name, const std::function<void(mobb::FitOptions&)>& change);
    /// Gives an agent another name, in all views and wherever it is remembered. In a scene without agents its clips
    /// become agents. Throws std::invalid_argument for an empty name, or that of another agent.
    void rename_agent(int agent, const std::string& name);

    /// Back through the edits, and on again; what plays stops.
    void undo();
    void redo();
    /// Back through how the scene was seen, and on again; likewise.
    void previous_view();
    void next_view();
    /// To a state of the history, < its count().
    void go_to_state(std::size_t state);

  private:
    void restore(const std::function<void(History&)>& turn);

    Workspace& workspace_;
    Jobs& jobs_;
    Playback& playback_;
    Counts& counts_;
};

}  // namespace mobbscope::app
