/// Crowds: the last choice of who is followed, and who collides with whom.
#pragma once

#include <app/document/workspace.h>
#include <app/session/jobs.h>

#include <string>
#include <vector>

namespace mobbscope::app {

/// In which order candidates are listed, and which of them.
struct CandidateList {
    enum class Column { outcome, clip, reason, contact };
    enum class Which { all, free, rejected };
    Column by = Column::outcome;
    bool descending = false;
    Which which = Which::all;
    std::string text{};  ///< those with it in what their row says; empty: all
};

/// How a conflict is looked at.
struct ConflictPlace {
    PlacedAgent followed, other;
    double time = 0;  ///< global seconds
};

class CrowdInspector {
  public:
    CrowdInspector(Workspace& workspace, Jobs& jobs, Notifications& notifications)
        : workspace_(workspace), jobs_(jobs), notifications_(notifications) {}

    CandidateList list;  ///< how candidates are listed
    /// Of a run the last choice of the agent that the view follows; null: there is none.
    const FollowedChoice* choice() const;
    /// Of that choice, the candidate that is pointed out; -1: none. Another choice's stays that one's.
    int candidate() const;
    /// Requires choice() and a candidate of it; -1: none.
    void point_out(int candidate);

    /// All that collide, once they were looked for; null: not yet.
    const std::vector<SceneConflict>* conflicts() const;
    void find_conflicts();
    /// "2 conflicts among 22 agents, 1.3 s in all", as `mobbscope conflicts` says it. Requires conflicts().
    std::string conflict_summary() const;

  private:
    Workspace& workspace_;
    Jobs& jobs_;
    Notifications& notifications_;
};

/// Half a second before the two touch, along with one of them. Of a run it is who made the conflict; where that play is
/// not yet chosen then, or the next one is already, the time is that of its choice, so that it is the last choice.
ConflictPlace conflict_place(const Workspace& workspace, const SceneConflict& conflict);

}  // namespace mobbscope::app
