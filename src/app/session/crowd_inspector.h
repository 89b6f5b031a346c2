/// Crowds: the last choice of who is followed, and who collides with whom.
#pragma once

#include <app/document/workspace.h>
#include <app/session/jobs.h>
#include <crowd/simulation/run_check.h>

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <utility>
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

/// The choice that made a conflict, as it is looked at.
struct ConflictPlace {
    PlacedAgent followed, other;
    double time = 0;  ///< global seconds
};

/// A play of a run that was forced, or that turns.
struct SpecialPlay {
    int agent = 0, play = 0;
    double time = 0;  ///< when it begins
    PlayKind kind = PlayKind::chosen;
};

/// In which order they are listed.
struct SpecialPlayList {
    enum class Column { time, agent, kind };
    Column by = Column::time;
    bool descending = false;
};

class CrowdInspector {
  public:
    CrowdInspector(Workspace& workspace, Jobs& jobs, Notifications& notifications)
        : workspace_(workspace), jobs_(jobs), notifications_(notifications) {}

    CandidateList list;          ///< how candidates are listed
    SpecialPlayList play_order;  ///< how special plays are listed
    /// Of a run the last choice of the agent that the view follows; null: there is none.
    const FollowedChoice* choice() const;
    /// Of that choice, the candidate that is pointed out; -1: none. Another choice's stays that one's.
    int candidate() const;
    /// Requires choice() and a candidate of it; -1: none.
    void point_out(int candidate);

    /// Of a run all that were forced or turn, in the order of their list.
    const std::vector<SpecialPlay>& special_plays() const;
    using WordsOfChoice = std::function<std::string(const Scene& run, const Choice& choice)>;
    /// What `words` say of the choice of such a play, which is made again the first time that it is asked for.
    const std::string& why(const SpecialPlay& play, const WordsOfChoice& words) const;

    /// All that collide, once they were looked for; null: not yet.
    const std::vector<SceneConflict>* conflicts() const;
    void find_conflicts();
    /// Makes every choice of the run again, beside the window, and hands over what came of it.
    void check_run(const std::function<void(const MoveSet& moves, const RunCheck& found)>& then);
    /// "2 conflicts among 22 agents, 1.3 s in all", as `mobbscope conflicts` says it. Requires conflicts().
    std::string conflict_summary() const;

  private:
    Workspace& workspace_;
    Jobs& jobs_;
    Notifications& notifications_;
    struct Listed {
        std::shared_ptr<const FittedScene> of;
        SpecialPlayList::Column by{};
        bool descending = false;
        std::vector<SpecialPlay> plays{};
        std::map<std::pair<int, int>, std::string> reasons{};  ///< by agent and play
    };
    mutable Listed listed_;
};

/// Half a second before the two touch, global seconds.
double time_before(const Workspace& workspace, const SceneConflict& conflict);

/// Half a second before the two touch, along with one of them. Of a run it is who made the conflict: whose play the
/// simulator would not have chosen, of two such plays the first; else whose was forced, or chosen last. Where that play
/// is not yet chosen then, or the next one is already, the time is that of its choice, so that it is the last choice.
ConflictPlace conflict_place(const Workspace& workspace, const SceneConflict& conflict);

}  // namespace mobbscope::app
