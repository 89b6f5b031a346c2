/// What is open: the document with its past, its file, what is selected, where its cameras stand, and the work that is
/// under way for it. Moved whole when something else is opened in its place for a while.
#pragma once

#include <app/document/clip_groups.h>
#include <app/document/clip_import.h>
#include <app/document/history.h>
#include <app/document/job.h>
#include <app/document/measuring.h>
#include <app/document/query_look.h>
#include <app/document/selection.h>
#include <app/document/settings.h>
#include <app/document/visited_steps.h>
#include <conflicts/conflicts.h>
#include <crowd/simulation/choice.h>
#include <explain/branch_costs.h>
#include <explain/event_table.h>
#include <explain/focus_window.h>
#include <explain/query_findings.h>
#include <explain/trace_comparison.h>
#include <explain/tree_cost.h>
#include <mobb/level_figures.h>
#include <render/drawlist/camera.h>
#include <render/drawlist/draw_list.h>
#include <scene/answer.h>
#include <scene/crowd_run.h>

#include <cstddef>
#include <deque>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace mobbscope::app {

/// Counted over all that was ever open, so that each value is met once.
struct Counts {
    int openings = 0;  ///< of files and excerpts
    /// How often a view was restored: by undo and redo, by the previous and next view, by a cancelled drag, and on the
    /// way back from an excerpt or the scene of a case. After that the camera stays.
    int restores = 0;
    int arrivals = 0;  ///< documents that were opened, and jobs that were done
};

/// Agents that isolation hides, and those that were hidden before it.
struct Isolation {
    std::vector<std::string> hidden, before;
};

/// The camera to return to when the foreground ends, and the agents in the foreground.
struct Overview {
    std::vector<std::string> foreground;
    Camera camera;
    double time_height = 0;
    std::string follow;
};

/// A run at the time of a view; kept until that changes.
struct ShownRun {
    std::shared_ptr<const FittedScene> of;
    double time = 0;
    double window = 0;
    Show show = Show::space_time;
    std::shared_ptr<const FittedScene> fitted;

    /// What is drawn: `whole`; of a run what it is at the view's time (fitted_at).
    std::shared_ptr<const FittedScene> at(const std::shared_ptr<const FittedScene>& whole, const ViewState& view);
};

/// How the list of a query's events shows them.
struct EventList {
    std::optional<EventFilter> filter{};  ///< none: all
    EventColumn by = event_columns().front();
    bool descending = false;
};

/// Which events of a query pass a filter.
struct PassingEvents {
    std::vector<bool> passes;
    std::optional<std::pair<FocusWindow, int>> count{};  ///< of those in a focus
};

class Workspace {
  public:
    /// An empty scene. `settings` outlive it.
    explicit Workspace(Settings& settings);

    History history;
    std::shared_ptr<const FittedScene> saved;                  ///< as the file has it
    std::optional<std::filesystem::path> file;                 ///< where Save writes; none: Save asks
    std::optional<std::filesystem::file_time_type> file_time;  ///< of it, when it was opened or saved
    std::vector<std::filesystem::path> opened;                 ///< what it is made of; empty for the demo, and at first
    /// When files were written last that it is read from, as was seen last; none: they were not there.
    std::map<std::filesystem::path, std::optional<std::filesystem::file_time_type>> seen_files;

    Selection selection;     ///< always of something that exists
    Selection hovered;       ///< under the mouse in any panel
    int hovered_event = -1;  ///< of the query in view, likewise; -1: none
    QueryLook look;
    Measuring measuring;

    std::optional<Isolation> isolation;   ///< since agents were shown alone
    std::optional<Overview> overview;     ///< since agents came into the foreground
    std::string filter;                   ///< lists show what has this text in its name; empty: all
    std::set<std::string> folded_groups;  ///< of clips, by title
    EventList events;
    /// What queries are compared with: another fit, or where that is none the stored trace.
    struct CompareWith {
        std::optional<mobb::FitOptions> fit;
    };
    std::optional<CompareWith> compare_with;
    VisitedSteps visited;
    std::string named_view;  ///< of the scene's, the one that was gone to or saved last; empty: none was

    /// Of which size the pictures are that cameras stand for; none: nothing was drawn since the scene was opened.
    std::optional<PictureSize> picture_size;
    /// Cameras of the pictures that are not shown now, by what they are of: "space-time", "moment", "disk".
    std::map<std::string_view, Camera> other_cameras;
    double settled_height = 0;  ///< metres a second, of the last framing
    /// The cameras that framed the scene by themselves, the latest first. Views that still stand so frame it again when
    /// pictures become narrower or wider; turning them leaves them so.
    std::vector<Camera> framings;

    /// A candidate of a choice that is pointed out.
    struct PointedOut {
        int agent = -1, play = -1;  ///< of the choice
        int candidate = -1;         ///< -1: none
    } pointed_out;
    struct FoundConflicts {
        std::shared_ptr<const FittedScene> in;
        std::vector<SceneConflict> conflicts;
        double end = 0;  ///< of the last contact, global seconds
    };
    std::optional<FoundConflicts> found;  ///< none: nobody has looked yet
    int conflict = -1;                    ///< that was gone to last; -1: none
    /// What did not agree with the file's answers and traces when it was opened.
    struct StoredDifferences {
        std::shared_ptr<const FittedScene> in;
        std::map<int, std::string> queries;  ///< what differs, by query
    };
    StoredDifferences stored_differences;

    std::vector<RunningJob> jobs;                   ///< the oldest first
    std::deque<ImportChange> import_changes;        ///< not begun yet
    std::shared_ptr<const SourceFile> import_file;  ///< that was read last

    // What it is now.
    const Document& document() const { return history.now(); }
    /// What is edited and saved.
    const Scene& scene() const { return document().fitted->scene(); }
    /// What is drawn and pointed at: the document's scene; of a run what it is at the view's time.
    std::shared_ptr<const FittedScene> shown() const { return shown_.at(document().fitted, view()); }
    const FittedScene& fitted() const { return *shown(); }
    const ViewState& view() const { return document().view; }
    bool empty() const { return scene().clips.empty(); }
    bool in_excerpt() const { return document().excerpt_of != nullptr; }
    /// What the document's agents play, if it is a run; else null.
    const CrowdRun* crowd() const { return scene().crowd.get(); }
    /// The scene differs from what is in the file. How it is seen does not count.
    bool modified() const;
    /// The file's name, or what stands for it.
    std::string title() const;
    /// What is asked in the view, recorded; null if no query is in the view.
    const RecordedQuery* recorded() const;
    /// Which queries costs are about: those that settings choose, where the scene asks any.
    QueryWorkload::Kind workload() const;
    /// What the tree of a clip costs in these, of the fit in use of the document or of one of its views; null: it is
    /// not known yet, or why_no_cost says why.
    std::shared_ptr<const TreeCost> cost_of(int clip) const { return cost_of(*document().fitted, clip); }
    std::shared_ptr<const TreeCost> cost_of(const FittedScene& of, int clip) const;
    /// Whom the queries blame for avoidable overlaps; null if nobody has counted that in this scene and fit.
    const BlameInScene* blame() const { return blame(*document().fitted).get(); }
    /// What of a query did not agree with the file; null: nothing did, or the scene is another one by now.
    const std::string* stored_difference(int query) const;
    /// The event of the trace that the view shows; requires recorded().
    int step() const;
    /// Whether a camera stands as one of the framings, turned or not.
    bool is_framed(const Camera& camera) const;

    // Changes.
    /// Keeps what was counted of a tree under standard placements, in place of an earlier count; of the latest few.
    void keep_standard_cost(std::shared_ptr<const TreeCost> cost);
    /// Likewise what the queries of a scene cost.
    void keep_counted(const std::shared_ptr<const FittedScene>& of, std::shared_ptr<const SceneCosts> costs);
    /// Null: nobody has counted, or it is forgotten.
    std::shared_ptr<const SceneCosts> counted(const FittedScene& of) const;
    /// The same of whom they blame.
    void keep_blame(const std::shared_ptr<const FittedScene>& of, std::shared_ptr<const BlameInScene> blame);
    std::shared_ptr<const BlameInScene> blame(const FittedScene& of) const;
    /// The scene after `change`, which may change `view` and `fit` along. Throws what `change` throws, and
    /// std::invalid_argument for options of the fit that are out of range.
    Scene changed_scene(const std::function<void(Scene&)>& change) const;
    /// Changes the scene at once. Throws as changed_scene does: nothing is changed then.
    void edit(const EditName& name, const std::function<void(Scene&)>& change);
    /// Changes how queries are debugged. What leaves it as it is is no edit.
    void edit_debug(const std::string& title, const std::function<void(DebugState&)>& change);
    /// Changes how it is seen, which undo leaves as it is (see History::look). No name: as what it changes says.
    void change_view(const std::function<void(ViewState&)>& change, const std::optional<EditName>& name = {});
    /// Shows an event of the query in view.
    void go_to_event(int event);
    /// The next document of the history.
    void change_document(Document next, const EditName& name);
    /// Changes the present state in place: no step of its own for undo.
    void amend(const std::function<void(Document&)>& change);
    /// The view at that place, < the number of views, is the active one. What the others show stays.
    void activate(std::size_t place);
    /// After every change of the history: nothing points at what is gone, and the step is one of the trace.
    void changed();
    /// An interaction has ended: what follows is undone apart from it.
    void close_group();
    void select(const Selection& selected);
    /// The step of the query in view; none: none is in view.
    std::optional<VisitedStep> present_step() const;
    /// Back to the step that was visited before, or forward again; whether there was one.
    bool revisit(bool forward);

    /// What is computed from the present scene when asked for.
    struct Derived {
        std::shared_ptr<const FittedScene> of;
        std::optional<std::pair<int, std::shared_ptr<const RecordedQuery>>> recorded{};
        std::shared_ptr<const QueryFindings> findings{};   ///< of `recorded`
        std::shared_ptr<const FittedScene> findings_of{};  ///< refers to it
        std::map<std::string, PassingEvents> passing{};    ///< by filter; of `recorded`, too
        std::optional<std::vector<int>> break_steps{};
        std::shared_ptr<const std::vector<int>> listed_events{};
        struct Focused {
            FocusWindow window;
            InFocus inside;
            std::pair<int, FocusCounts> counts{-1, {}};  ///< up to a step
            std::optional<FocusCounts> in_all{};
            std::optional<std::vector<BranchCost>> branches{};
        };
        std::optional<Focused> focused{};                 ///< of `findings`
        std::shared_ptr<const FitComparison> compared{};  ///< of `recorded` with another fit
        std::optional<TraceCheck> stored_check{};         ///< ... with the stored trace
        /// With all that follows from them.
        void forget_findings() {
            compared.reset();
            stored_check.reset();
            findings.reset();
            passing.clear();
            break_steps.reset();
            listed_events.reset();
            focused.reset();
        }
        std::shared_ptr<const SceneCosts> costs{};  ///< null: not counted
        std::optional<Sandwich> sandwich{};
        std::map<std::size_t, Answer> answers{};
        std::map<int, std::vector<mobb::LevelFigures>> figures{};
        std::optional<std::vector<ClipGroup>> groups{};
        std::unique_ptr<MoveSet> moves{};    ///< of a run
        std::pair<int, int> chosen{-1, -1};  ///< agent and play of `choice`
        std::optional<FollowedChoice> choice{};
    };
    Derived& derived() const;

  private:
    /// `next` follows the present document: it remembers which steps were looked at, and a query that is seen with
    /// another kind of trees goes on where it was left with that.
    void remember_step(Document& next);
    void frame_again();
    void share_linked();
    void settle_step();
    void settle_look();

    /// The traversal of a query in the active view and in another one.
    struct LinkedTraversals {
        std::shared_ptr<const FittedScene> active, other;
        int query = 0;
        std::shared_ptr<const RecordedQuery> recorded;  ///< in the other
        TraversalComparison traversals;
    };
    const LinkedTraversals& linked_traversals(const SceneView& other);
    Step step_in(const SceneView& other);
    /// What the steps of the other views follow.
    struct FollowedStep {
        std::shared_ptr<const FittedScene> fitted;
        std::optional<int> query;
        Step step;
        std::vector<std::shared_ptr<const FittedScene>> others;
        bool linked = true;
        friend bool operator==(const FollowedStep&, const FollowedStep&) = default;
    };
    FollowedStep step_to_follow() const;
    std::optional<DrawnNode> node_in(const SceneView& other, const std::optional<DrawnNode>& node) const;
    void amend_quietly(const std::function<void(Document&)>& change);

    Settings* settings_;
    std::vector<std::shared_ptr<const TreeCost>> standard_costs_;  ///< the latest first
    template <class T>
    using ByScene = std::vector<std::pair<std::shared_ptr<const FittedScene>, std::shared_ptr<const T>>>;
    ByScene<SceneCosts> counted_;   ///< likewise
    ByScene<BlameInScene> blamed_;  ///< likewise
    struct CostInScene {
        std::shared_ptr<const SceneCosts> of;
        int clip = 0;
        std::shared_ptr<const TreeCost> cost;
    };
    mutable std::vector<CostInScene> costs_in_scene_;  ///< likewise
    std::vector<LinkedTraversals> linked_;             ///< likewise
    FollowedStep followed_;
    std::size_t views_framed_ = 1;                     ///< how many there were when cameras framed the scene last
    std::shared_ptr<const FittedScene> pointed_into_;  ///< what selection and hovered are of
    bool stepping_ = false;                            ///< the step was changed in the present interaction
    struct LookedAt {
        std::shared_ptr<const FittedScene> fitted;
        std::optional<int> query;
        std::optional<double> time;
    };
    LookedAt looked_at_;  ///< what `look` is of
    mutable Derived derived_;
    mutable ShownRun shown_;  ///< of the active view
};

/// Whether there are so many that they are a crowd: a run, or more agents than lists of pairs are made for. Clips
/// without agents are none.
bool is_crowd(const Workspace& workspace);
/// First and last moment of the paths in view, global seconds; 0..0 for an empty scene. Of a run what was simulated,
/// and on to the end of the last conflict that was found.
mobb::Interval time_span(const Workspace& workspace);
/// The clip of the document that one plays: of a run that of the play, which is drawn as one that runs on.
int clip_played(const Workspace& workspace, const PlacedAgent& who);
/// The clip whose tree panels are about: of what is selected, else the first that is seen. Requires clips.
int clip_in_focus(const Workspace& workspace);
/// The document's clips by folder and rig; kept until the scene changes.
const std::vector<ClipGroup>& clip_groups(const Workspace& workspace);

}  // namespace mobbscope::app
