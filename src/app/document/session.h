/// The program behind the window: the document, what is selected, what is under way. Panels show it, commands change
/// it; it knows neither.
#pragma once

#include <app/document/history.h>
#include <app/document/job.h>
#include <app/document/review.h>
#include <app/document/selection.h>
#include <app/document/settings.h>
#include <conflicts/conflicts.h>
#include <crowd/simulation/choice.h>
#include <explain/query_findings.h>
#include <mobb/level_figures.h>
#include <render/image/image.h>
#include <scene/answer.h>
#include <scene/crowd_run.h>

#include <deque>
#include <filesystem>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace mobbscope::app {

/// What is asked or shown over the panels, one at a time.
enum class Dialog { none, open, add, save_as, export_picture, unsaved, palette, help, about, review };

/// A line for the person: what went wrong and what to do, or what was done.
struct Message {
    enum class Level { info, warning, error };
    Level level = Level::info;
    std::string text;
    std::optional<double> shown_at{};  ///< when the window showed it first
};

/// How the window's surroundings are reached; all may be empty.
struct Hooks {
    std::function<void()> wake;                             ///< from any thread: there is news, draw a frame
    std::function<void(const std::string&)> set_clipboard;  ///< UTF-8
    std::function<std::string()> clipboard;                 ///< likewise
    std::function<PictureSize()> viewport_size;             ///< of the viewport's picture
    std::function<double()> viewport_scale;                 ///< of its text and lines, as build_draw_list takes it
    std::function<void(const std::filesystem::path&)> export_picture;  ///< the viewport's picture as PNG; throws
    std::function<double()> ui_scale;                                  ///< at which text and panels are drawn now
};

/// What was put into the open dialog so far; the dialog says what it means by it.
struct DialogInput {
    std::string text;
    std::string command{};    ///< the palette asks for the argument of this one; empty: it lists all
    int picked = 0;           ///< of a list
    bool confirming = false;  ///< asks whether to overwrite
    int generation = 0;       ///< the field shows another text from without: see set_text
    int opening = 0;          ///< counts dialogs: the undo of a field must not reach the text of an earlier one
    bool fresh = true;        ///< the field waits for the keyboard

    void set_text(std::string to) {
        text = std::move(to);
        picked = 0;
        confirming = false;
        ++generation;
        fresh = true;
    }
};

class Session {
  public:
    /// `attended`: false for scripts and pictures. Jobs are then waited for, nothing is animated, and no settings of
    /// the person are read or written.
    explicit Session(bool attended, Settings settings = {});

    Hooks hooks;
    Settings settings;
    /// Whether the scene and pictures of it may be written: not where a window is only looked at.
    bool may_write = true;
    /// Throws InputError if they may not.
    void check_may_write(const std::filesystem::path& file) const;

    // The document.
    const Document& document() const { return history_.now(); }
    /// What is edited and saved.
    const Scene& scene() const { return document().fitted->scene(); }
    /// What is drawn and pointed at: the document's scene; of a run what it is at the view's time (fitted_at).
    std::shared_ptr<const FittedScene> shown() const;
    const FittedScene& fitted() const { return *shown(); }
    const ViewState& view() const { return document().view; }
    const History& history() const { return history_; }
    bool attended() const { return attended_; }
    bool empty() const { return scene().clips.empty(); }
    /// Which opening the present scene is of; files and excerpts are counted apart.
    int opening() const { return in_excerpt() ? excerpts_opened_ : files_opened_; }

    /// Changes the scene at once; its `view` is the present one and may be changed along. Throws what `change` throws:
    /// nothing is changed then.
    void edit(const EditName& name, const std::function<void(Scene&)>& change);
    /// Changes the options of the active view's fit. A fit that takes long becomes a job, and the document changes when
    /// it is done: `change` may run again then, so it holds by value what it needs. Throws std::invalid_argument for
    /// options out of range: nothing is changed then.
    void refit(const EditName& name, const std::function<void(mobb::FitOptions&)>& change);
    /// Changes how it is seen; undo takes back looking of one kind (see History::change_view) in one go.
    void change_view(const std::function<void(ViewState&)>& change);
    /// An interaction has ended: what follows is undone apart from it.
    void close_group() { history_.close_group(); }
    // Views: places count from left to right.
    std::size_t view_count() const { return document().beside.size() + 1; }
    std::size_t active_place() const { return document().place; }
    /// What is seen at a place, < view_count(); of a run as shown().
    SceneView view_at(std::size_t place) const;
    /// Shows the scene once more, to the right of all, as the active view does but with the fit of those options; makes
    /// it if there is none, under that name or with a number behind it. Throws std::invalid_argument for options out of
    /// range, or an empty name.
    void split_view(const std::string& name, const mobb::FitOptions& options);
    /// Only the active view is left, and of the fits its own and the scene's first.
    void close_other_views();
    /// Commands and panels are about the view at that place from now on; of a place that there is not nothing changes.
    void activate_view(std::size_t place);
    /// Whether all views have one camera.
    void link_cameras(bool linked);

    /// Back, and on again; what plays stops.
    void undo();
    void redo();

    /// What is asked in the view, recorded; null if no query is in the view.
    const RecordedQuery* recorded() const;
    /// The event of the trace that the view shows; requires recorded().
    int step() const;
    /// What follows from it, likewise; null if no query is in the view.
    std::shared_ptr<const QueryFindings> findings() const;
    /// The first contact of any query, with what it cost; kept until the scene changes.
    const Answer& answer_of(std::size_t query) const;
    /// Figures of a clip's tree; kept until the scene changes.
    const std::vector<mobb::LevelFigures>& figures_of(int clip) const;

    // Crowds.
    /// What the document's agents play, if it is a run; else null.
    const CrowdRun* crowd() const { return scene().crowd.get(); }
    /// Whether there are so many that they are a crowd: a run, or more agents than lists of pairs are made for.
    bool is_crowd() const;
    /// Of a run the last choice of the agent that the view follows; null: there is none.
    const FollowedChoice* choice() const;
    int candidate = -1;  ///< of that choice, the one that is pointed out; -1: none
    /// All that collide, once they were looked for; null: not yet.
    const std::vector<SceneConflict>* conflicts() const;
    void find_conflicts();
    int conflict = -1;  ///< that was gone to last; -1: none

    /// Opens two paths as a scene of their own, with the query between them. Undo leads back, and so does
    /// leave_excerpt.
    void open_excerpt(const PlacedAgent& a, const PlacedAgent& b);
    bool in_excerpt() const { return document().excerpt_of != nullptr; }
    void leave_excerpt();

    // What is pointed at.
    Selection selection;  ///< always of something that exists
    Selection hovered;    ///< under the mouse in any panel
    void select(const Selection& selected) { selection = exists(fitted(), selected) ? selected : Selection{}; }

    // Files.
    /// Where Save writes; none: Save asks.
    const std::optional<std::filesystem::path>& file() const { return file_; }
    /// The scene differs from what is in the file. How it is seen does not count.
    bool modified() const;
    /// The file's name, or what stands for it.
    std::string title() const;
    /// Replaces the document, after asking if there are unsaved changes. Several files become one scene; folders stand
    /// for the clips in them. Errors become messages, and what was open stays.
    void open(const std::vector<std::filesystem::path>& files);
    /// The same with a scene that was read from those files already.
    void open_scene(const Scene& scene, const std::vector<std::filesystem::path>& files);
    /// The scene that comes with the program.
    void open_demo();
    /// What `open` was given; empty for the demo and before anything was opened.
    const std::vector<std::filesystem::path>& opened() const { return opened_; }
    /// Adds clips, or whole scenes, to the document.
    void add(const std::vector<std::filesystem::path>& files);
    /// Throws MachineError if it cannot be written; without a file asks for one. What waits for the answer about
    /// unsaved changes goes on when they are saved.
    void save();
    void save_as(const std::filesystem::path& file);
    /// Ends the program, after asking if there are unsaved changes.
    void request_close();
    bool closed() const { return closed_; }

    /// Does `then`, at once or when the person has said what becomes of unsaved changes.
    void after_asking(const std::function<void()>& then);
    /// The answer to Dialog::unsaved.
    enum class Unsaved { save, discard, cancel };
    void answer_unsaved(Unsaved choice);

    // Picture tests.
    /// Shows the picture tests of a folder in place of the scene, and draws them, unless an `output` of theirs is to be
    /// looked at. Throws InputError as Review does: what is shown stays then.
    void review(const std::filesystem::path& folder, const std::filesystem::path& output = {});
    /// The picture tests that are looked at, shown or not; null if there are none.
    Review* review() { return review_.get(); }
    const Review* review() const { return review_.get(); }
    /// Whether they are shown: commands and panels are about them then, not about the scene.
    bool reviewing() const { return reviewing_; }
    /// Shows what was open before the picture tests, or them again; asks about unsaved changes of a case's scene.
    void leave_review();
    /// Requires review().
    void back_to_review();
    /// Opens what a case draws as a scene; what is open is put aside until the picture tests are left.
    void open_case(std::size_t index);
    /// The name of the case whose scene is open; empty if none is.
    const std::string& open_case_name() const { return open_case_; }
    picture_tests::CaseDrawer case_drawer;  ///< what draws the cases

    // Dialogs and messages.
    Dialog dialog = Dialog::none;  ///< the open one
    DialogInput input;             ///< ... and what was put into it
    void open_dialog(Dialog which, DialogInput with = {});
    /// Nothing comes of it: what waited for its answer is forgotten.
    void close_dialog();
    void tell(Message::Level level, const std::string& text);
    const std::vector<Message>& messages() const { return messages_; }
    void dismiss(std::size_t message);
    void note_shown(std::size_t message, double now) { messages_[message].shown_at = now; }

    // The queue: the document changes between frames only, so panels may keep references into it while they draw.
    /// Does `something` once the frame is drawn. What it throws becomes a message.
    void enqueue(std::function<void()> something) { queue_.push_back(std::move(something)); }
    /// Does what was enqueued, in order, and what that enqueues; whether there was anything. Not while panels are
    /// drawn.
    bool run_queue();

    // Jobs.
    /// The work under way, the oldest first. Edits go on meanwhile: what a job has made is put into the document as
    /// that is when the job ends. Only excerpts are neither opened nor left.
    std::size_t job_count() const { return jobs_.size(); }
    const Job& job(std::size_t index) const { return *jobs_[index].job; }
    /// The oldest; null if none.
    const Job* job() const { return jobs_.empty() ? nullptr : jobs_.front().job.get(); }
    void cancel_job(std::size_t index);
    /// Takes in what jobs have done. Call it before each frame.
    void poll();

    // Time.
    /// Lets the time cursor run; how far it comes is one state, or goes into what is done meanwhile.
    void play();
    void stop() { playing_ = false; }
    bool playing() const { return playing_; }
    double speed = 1;  ///< seconds of the scene per second
    /// First and last moment of the paths in view, global seconds; 0..0 for an empty scene.
    mobb::Interval time_span() const;
    /// Moves the time cursor on if it is playing; at the end it begins again.
    void advance(double seconds);

  private:
    using LoadAll = std::function<Scene(JobControl&)>;

    void ask_anew(DialogInput with);
    void require_no_job() const;
    void start(std::string title, Job::Work work, bool opens = false);
    void finish(Job& job);
    Scene changed_scene(const std::function<void(Scene&)>& change) const;
    /// An edit that may make fits, in a job if they take long. `fitted_beside`: has trees to share; null: none.
    void edit_with_fits(const EditName& name, const std::function<void(Scene&)>& change,
                        const FittedScene* fitted_beside);
    void replace(Document document, const std::vector<std::filesystem::path>& opened);
    /// Replaces the document by what `load_all` gives, after asking if there are unsaved changes.
    void load(const std::string& title, const LoadAll& load_all, const std::vector<std::filesystem::path>& files);
    /// Changes the present state in place: no step of its own for undo.
    void amend(const std::function<void(Document&)>& change);
    /// For another document: stops playing; nothing is selected or hovered.
    void point_at_nothing();
    void change_document(Document next, const EditName& name);
    void share_time_and_camera();
    void step_in_history(void (History::*undo_or_redo)());
    void changed();
    /// The scene of a case goes, after asking if it has unsaved changes, and what was open before it is back.
    void close_case(const std::function<void()>& then);

    bool attended_;
    History history_;
    std::shared_ptr<const FittedScene> pointed_into_;  ///< what selection and hovered are of
    std::shared_ptr<const FittedScene> saved_;
    std::optional<std::filesystem::path> file_;
    std::vector<std::filesystem::path> opened_;
    int files_opened_ = 0;
    int excerpts_opened_ = 0;
    std::vector<Message> messages_;
    std::deque<std::function<void()>> queue_;
    struct Running {
        std::unique_ptr<Job> job;
        bool opens = false;  ///< it replaces the document
    };
    std::vector<Running> jobs_;
    bool playing_ = false;
    bool has_played_ = false;        ///< since play(): the time that passes has a state
    std::function<void()> pending_;  ///< waits for the answer about unsaved changes
    bool closed_ = false;
    std::shared_ptr<Review> review_;
    bool reviewing_ = false;
    std::string open_case_;
    /// What was open before the scene of a case was.
    struct Aside {
        History history;
        std::shared_ptr<const FittedScene> saved;
        std::optional<std::filesystem::path> file;
        std::vector<std::filesystem::path> opened;
    };
    std::optional<Aside> aside_;

    /// What is computed from the present scene when asked for.
    struct Derived {
        std::shared_ptr<const FittedScene> of;
        std::optional<std::pair<int, RecordedQuery>> recorded;
        std::shared_ptr<const QueryFindings> findings;  ///< of `recorded`
        std::map<std::size_t, Answer> answers;
        std::map<int, std::vector<mobb::LevelFigures>> figures;
    };
    Derived& derived() const;
    mutable Derived derived_;

    /// A run at the view's time.
    struct Shown {
        std::shared_ptr<const FittedScene> of;
        double time = 0;
        double window = 0;
        Show show = Show::space_time;
        std::shared_ptr<const FittedScene> fitted;
    };
    std::shared_ptr<const FittedScene> shown_at(const SceneView& seen, Shown& kept) const;
    mutable Shown shown_;                      ///< of the active view
    mutable std::vector<Shown> shown_beside_;  ///< of the others, by place
    struct Choosing {
        std::shared_ptr<const FittedScene> of;
        std::unique_ptr<MoveSet> moves;
        std::pair<int, int> made{-1, -1};  ///< agent and play
        std::optional<FollowedChoice> choice;
    };
    mutable Choosing choosing_;
    struct Found {
        std::shared_ptr<const FittedScene> in;
        std::vector<SceneConflict> conflicts;
    };
    std::optional<Found> found_;
};

}  // namespace mobbscope::app
