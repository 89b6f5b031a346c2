/// The program behind the window: the document, what is selected, what is under way. Panels show it, commands change
/// it; it knows neither.
#pragma once

#include <app/document/clip_groups.h>
#include <app/document/clip_import.h>
#include <app/document/file_browser.h>
#include <app/document/file_preview.h>
#include <app/document/history.h>
#include <app/document/job.h>
#include <app/document/message_level.h>
#include <app/document/picture_export.h>
#include <app/document/review.h>
#include <app/document/selection.h>
#include <app/document/settings.h>
#include <conflicts/conflicts.h>
#include <crowd/simulation/choice.h>
#include <explain/query_findings.h>
#include <mobb/level_figures.h>
#include <render/drawlist/draw_list.h>
#include <render/image/image.h>
#include <scene/answer.h>
#include <scene/crowd_run.h>

#include <chrono>
#include <deque>
#include <filesystem>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace mobbscope::app {

/// What is asked or shown over the panels, one at a time.
enum class Dialog {
    none,
    open,
    add,
    save_as,
    export_picture,
    unsaved,
    palette,
    help,
    about,
    messages,
    dropped,
    import_clip,
    history,
    review,
    export_file  ///< where Dialog::export_picture writes to
};

/// A command that a message offers; it is drawn as a button.
struct MessageOffer {
    std::string command;   ///< its id
    std::string argument;  ///< empty: none
    std::string label;     ///< "Mend unit..."
};

/// A line for the person: what went wrong and what to do, or what was done. It lies over the picture for some seconds,
/// then it is kept in a list behind a bell.
struct Message {
    MessageLevel level = MessageLevel::info;
    std::string text;
    std::optional<MessageOffer> offer{};  ///< none once another document is open: it was about the last one
    std::optional<double> shown_at{};     ///< seconds of the window's clock, when it was shown first
    double goes_at = 0;                   ///< ... when it goes behind the bell; only once it was shown
    bool up = true;                       ///< it lies over the picture
    bool read = false;                    ///< the list was opened since, or it was only what was done (info)
    bool of_window = false;               ///< about no scene: it stays when another one is opened
};

/// Where a command sends the keys.
/// `menu_of_this`: what has the focus, or else what is selected in the picture, opens its menu; `picture`: they go back
/// to the picture, where arrows step.
enum class FocusMove { none, next_panel, previous_panel, menu_bar, menu_of_this, picture };
/// In which order candidates are listed, and which of them.
struct CandidateList {
    enum class Column { outcome, clip, reason, contact };
    enum class Which { all, free, rejected };
    Column by = Column::outcome;
    bool descending = false;
    Which which = Which::all;
    std::string text{};  ///< those with it in what their row says; empty: all
};

/// How the window's surroundings are reached; all may be empty.
struct Hooks {
    std::function<void()> wake;                             ///< from any thread: there is news, draw a frame
    std::function<void(const std::string&)> set_clipboard;  ///< UTF-8
    std::function<std::string()> clipboard;                 ///< likewise
    std::function<PictureSize()> viewport_size;             ///< of the viewport's picture
    std::function<double()> viewport_scale;                 ///< of its text and lines, as build_draw_list takes it
    std::function<Image(const DrawList&, int samples)> draw_picture;         ///< as Renderer::draw
    std::function<Image(const DrawList&, int divisor)> draw_coarse_picture;  ///< as Renderer::draw_coarse
    std::function<std::string(int samples)> why_no_samples;                  ///< a pixel; empty: they can be drawn
    std::function<void(std::string_view png)> set_clipboard_picture;         ///< throws MachineError
    std::function<std::string_view()> why_no_clipboard_picture;              ///< empty: pictures can be copied
    std::function<double()> ui_scale;                                        ///< at which text and panels are drawn now
};

/// What was put into the open dialog so far; the dialog says what it means by it.
struct DialogInput {
    std::string text;
    std::string command{};                       ///< the palette asks for the argument of this one; empty: it lists all
    std::vector<std::filesystem::path> files{};  ///< that were dropped
    int picked = 0;                              ///< of a list
    bool confirming = false;                     ///< asks whether to overwrite
    int generation = 0;                          ///< the field shows another text from without: see set_text
    int opening = 0;        ///< counts dialogs: the undo of a field must not reach the text of an earlier one
    bool fresh = true;      ///< the field waits for the keyboard
    bool selected = false;  ///< its text is selected then, so that typing replaces it

    void set_text(std::string to) {
        text = std::move(to);
        picked = 0;
        confirming = false;
        ++generation;
        fresh = true;
    }
};

/// What showing some agents alone has hidden, and what was hidden before.
struct Alone {
    std::vector<std::string> hidden, before;
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
    /// Shorter work of an attended window is waited for: one that flickers is worse than one that is late by this. With
    /// 0 no work is, however short.
    std::chrono::milliseconds patience{80};
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
    /// Which opening of files or of an excerpt the present scene is of; each has a number of its own, and coming back
    /// to one finds its number again.
    int opening() const { return document().opening; }

    /// Changes the scene at once; its `view` is the present one and may be changed along. Throws what `change` throws:
    /// nothing is changed then.
    void edit(const EditName& name, const std::function<void(Scene&)>& change);
    /// Changes the options of the active view's fit. A fit that takes long becomes a job, and the document changes when
    /// it is done: `change` may run again then, so it holds by value what it needs. Throws std::invalid_argument for
    /// options out of range: nothing is changed then.
    void refit(const EditName& name, const std::function<void(mobb::FitOptions&)>& change);
    /// Gives an agent another name, in all views and wherever it is remembered. In a scene without agents its clips
    /// become agents. Throws std::invalid_argument for an empty name, or that of another agent.
    void rename_agent(int agent, const std::string& name);
    /// Changes how it is seen; undo takes back looking of one kind (see History::change_view) in one go.
    void change_view(const std::function<void(ViewState&)>& change);
    /// An interaction has ended: what follows is undone apart from it.
    void close_group() {
        history_.close_group();
        stepping_ = false;
    }
    /// The next edit goes on with the last one if it changes the same number: keys change a number one by one.
    void reopen_group() { history_.reopen_group(); }
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
    /// Says where the camera of the view at a place stands, which framed the scene by itself so far, and how high a
    /// second is drawn (metres; 0: as before). No step of its own for undo.
    void settle_camera(std::size_t place, const Camera& camera, double time_height);
    /// Whether the height of a second is one that somebody has chosen, not that of the last framing.
    bool has_chosen_height() const { return view().time_height != settled_height_; }
    /// Of which size the pictures are that cameras stand for; none: nothing was drawn since the scene was opened.
    const std::optional<PictureSize>& picture_size() const { return picture_size_; }
    /// The pictures are of this size now: cameras that stand keep their scale, also those that undo and the way back
    /// from an excerpt lead to. What is put aside for the scene of a picture test follows when it is back.
    void resize_pictures(PictureSize to);
    /// Whether all views have one camera.
    void link_cameras(bool linked);

    /// Back, and on again; what plays stops.
    void undo();
    void redo();
    /// To a state of the history, < history().count().
    void go_to_state(std::size_t state);
    /// How often what is seen was put back as it had been: by undo and redo, when a drag is given up, and on the way
    /// back from an excerpt or the scene of a case. Nothing follows it.
    int times_put_back() const { return times_put_back_; }

    /// Shows a query, at that step; none: at the one where it was left with this kind of trees, or its end.
    void show_query(int query, std::optional<Step> step = {});
    /// The step of the query in view where the last jump or run of single steps began; none: there was none.
    std::optional<Step> step_before() const;

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

    /// The document's clips by folder and rig; kept until the scene changes.
    const std::vector<ClipGroup>& clip_groups() const;
    std::optional<Alone> alone;  ///< since agents were shown alone
    std::string filter;          ///< the lists of the scene panel show what has this text in its name; empty: all
    std::set<std::string> folded_groups;  ///< of clips, by title

    // Crowds.
    /// What the document's agents play, if it is a run; else null.
    const CrowdRun* crowd() const { return scene().crowd.get(); }
    /// Whether there are so many that they are a crowd: a run, or more agents than lists of pairs are made for. Clips
    /// without agents are none.
    bool is_crowd() const;
    /// Of a run the last choice of the agent that the view follows; null: there is none.
    const FollowedChoice* choice() const;
    /// Of that choice, the candidate that is pointed out; -1: none. Another choice's stays that one's.
    int candidate() const;
    /// Requires choice() and a candidate of it; -1: none.
    void point_out(int candidate);
    CandidateList candidates;  ///< how they are listed
    /// All that collide, once they were looked for; null: not yet.
    const std::vector<SceneConflict>* conflicts() const;
    void find_conflicts();
    int conflict = -1;  ///< that was gone to last; -1: none

    /// Opens two paths of what is drawn as a scene of their own, with the query between them. Undo leads back, and so
    /// does leave_excerpt.
    void open_excerpt(const PlacedAgent& a, const PlacedAgent& b);
    /// The same with the two of a conflict.
    void open_conflict(const SceneConflict& of);
    /// The same with a candidate of `choice` and who rules it out. Throws std::invalid_argument if nobody does.
    void open_candidate(int candidate);
    bool in_excerpt() const { return document().excerpt_of != nullptr; }
    void leave_excerpt();

    // Imports.
    ClipImport importing;  ///< in the dialog Dialog::import_clip
    /// Opens the dialog for a clip with a source; `field`: the option that it is about, empty: none.
    void open_import(int clip, const std::string& field = "");
    /// Gives an import option of a clip, or of all clips of its file, another value; an empty text leaves it to the
    /// file. The clip is made anew, in a job if that takes long; the document changes when that is done, and changes
    /// asked for meanwhile follow. What cannot be imported leaves the document as it was: it is said at the field if
    /// the dialog is open, else in a message. Throws std::invalid_argument for a value out of range where there is no
    /// dialog.
    void set_import(int clip, bool whole_file, const std::string& option, const std::string& text);
    /// How a clip moves between its samples, from a file (set_import) or in the scene.
    void set_motion(int clip, bool whole_file, mobb::Motion motion);

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
    /// Whether files can be added: not to a run, which stands alone, nor where picture tests are shown instead.
    bool may_add() const { return !crowd() && !reviewing(); }
    /// Adds clips, or whole scenes, to the document, and says what is wrong with them once they are in it. Throws
    /// InputError if nothing can be added.
    void add(const std::vector<std::filesystem::path>& files);
    /// Opens what was dropped on the window; asks where the person has something open, which it may be added to.
    void drop(const std::vector<std::filesystem::path>& files);
    /// What is open is that of the next time's settings.last.
    void note_session();
    /// Opens settings.last, seen as it was.
    void reopen_last();
    /// Whether there is anything to reopen that is still there.
    bool has_last() const;
    /// "crossing.json", or "3 files"; requires has_last().
    std::string last_title() const;
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

    // The keys.
    std::string focus;                       ///< the widget that has them, by its mark; empty: the viewport
    FocusMove focus_move = FocusMove::none;  ///< asked for, and done in the next frame

    // A drag that is broken off.
    /// What a drag may change, as it is now.
    struct BeforeDrag {
        History history;
        Settings settings;
        int handed_over = 0;  ///< documents and edits that did not come from the hand
        std::optional<PictureSize> picture_size;
        std::map<std::string_view, Camera> cameras_aside;
        std::optional<ReviewLook> look;  ///< of picture tests, while they are shown
    };
    BeforeDrag before_drag() const;
    /// Brings it back, as if nothing had been dragged; not where a job or another document has come meanwhile.
    void restore(BeforeDrag before);

    // Picture tests.
    /// Shows picture tests in place of the scene, and draws them, unless an `output` of theirs is to be looked at.
    /// Those of a folder that was looked at before begin at the case that was chosen then, if one was.
    void review(const ReviewFolder& found);
    /// Throws InputError as find_review does.
    void review(const std::filesystem::path& folder, const std::filesystem::path& output = {}) {
        review(find_review(folder, output));
    }
    /// The picture tests that are looked at, shown or not; null if there are none.
    Review* review() { return review_.get(); }
    const Review* review() const { return review_.get(); }
    /// Whether they are shown: commands and panels are about them then, not about the scene.
    bool reviewing() const { return reviewing_; }
    /// What the window shows, for its title: the scene, or the folder of the picture tests.
    std::string shown_title() const { return reviewing_ ? review_->title() : title(); }
    /// Whether it has changes that are not saved.
    bool shows_unsaved() const { return !reviewing_ && modified(); }
    /// Shows what was open before the picture tests, or them again; asks about unsaved changes of a case's scene.
    void leave_review();
    /// Requires review().
    void back_to_review();
    /// Ends their run, if there is one, and says so.
    void cancel_review_run();
    /// Opens what a case draws as a scene; what is open is put aside, with its jobs, until that scene is left.
    void open_case(std::size_t index);
    /// The name of the case whose scene is open; empty if none is.
    const std::string& open_case_name() const { return open_case_; }
    picture_tests::CaseDrawer case_drawer;  ///< what draws the cases

    // Dialogs and messages.
    Dialog dialog = Dialog::none;  ///< the open one
    DialogInput input;             ///< ... and what was put into it
    ExportDialog exporting;        ///< what the dialog Dialog::export_picture holds
    FileBrowser browser;           ///< what a dialog for files looks at
    FilePreview preview;           ///< ... and into
    void open_dialog(Dialog which, DialogInput with = {});
    /// Shows the help, over the open dialog if there is one: closing it leads back there.
    void open_help();
    /// What the help lies over.
    Dialog behind_help() const { return behind_help_.first; }
    /// Nothing comes of it: what waited for its answer is forgotten.
    void close_dialog();
    /// That message goes behind the bell, if it lies over the picture.
    void take_down(const std::string& text);
    void tell(MessageLevel level, const std::string& text, std::optional<MessageOffer> offer = std::nullopt);
    /// About no scene: see Message::of_window.
    void tell_of_window(MessageLevel level, const std::string& text);
    /// The oldest first, at most 50; the list behind the bell.
    const std::vector<Message>& messages() const { return messages_; }
    /// Whether a warning or an error lies over the picture: what was only done goes by itself.
    bool has_message_up() const;
    /// How many warnings and errors nobody has looked at in the list.
    std::size_t unread() const;
    /// Takes one out of the list.
    void dismiss(std::size_t message);
    void clear_messages() { messages_.clear(); }
    /// Opens the list; all that is in it counts as read.
    void open_messages();
    /// The messages over the picture go behind the bell.
    void put_messages_away();
    /// The window shows its messages at this time of its clock: those whose time is over go behind the bell. `held`:
    /// the mouse is on them, so none goes. Returns in how many seconds the next one goes; infinity: none is up.
    double age_messages(double now, bool held);

    bool follow_test = false;  ///< the camera goes to the pair under test where that is not well in the picture
    /// Cameras of the pictures that are not shown now, by what they are of: "space-time", "moment", "disk".
    std::map<std::string_view, Camera> cameras_aside;

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
    /// Ends all work beside the window: nothing calls Hooks::wake any more, unless other work is begun.
    void end_work();
    /// Takes in what jobs have done. Call it before each frame.
    void poll();

    // Time.
    /// Lets the time cursor run, from the first moment where there is none; how far it comes is one state, or goes into
    /// what is done meanwhile.
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
    /// What a job is for: `opens` replaces the document.
    enum class Purpose { other, opens, imports };

    void ask_anew(DialogInput with);
    void require_no_job() const;
    void start(std::string title, Job::Work work, Purpose purpose = Purpose::other);
    void finish(Job& job);
    Scene changed_scene(const std::function<void(Scene&)>& change) const;
    /// An edit that may make fits.
    struct FitEdit {
        EditName name;
        std::function<void(Scene&)> change;  ///< holds by value what it needs
        Purpose purpose = Purpose::other;    ///< of the job
        std::function<void()> then{};        ///< once the document has changed; may be empty
        bool goes_on = false;                ///< with the last edit, if that has the same group
    };
    /// Does it, in a job if the fits take long. `fitted_beside`: has trees to share; null: none.
    void edit_with_fits(const FitEdit& edit, const FittedScene* fitted_beside = nullptr);
    void replace(Document document, const std::vector<std::filesystem::path>& opened);
    /// Warnings and errors so far were about what was shown before.
    void retire_messages();
    /// Replaces the document by what `load_all` gives, seen as that says or as `view`, after asking if there are
    /// unsaved changes. What cannot be loaded leaves all as it was: what `load_all` and document_of throw in the job
    /// (InputError, MachineError, std::invalid_argument, Cancelled) becomes a message.
    void load(const std::string& title, const LoadAll& load_all, const std::vector<std::filesystem::path>& files,
              const std::optional<ViewState>& view = std::nullopt);
    /// Says so if one of them is not there; whether it did.
    bool complain_of_missing(const std::vector<std::filesystem::path>& files);
    /// They are the latest of the recent ones.
    void remember(const std::vector<std::filesystem::path>& files);
    /// Whether something is open that is not the demo as it comes.
    bool opened_by_person() const;
    /// Changes the present state in place: no step of its own for undo.
    void amend(const std::function<void(Document&)>& change);
    /// For another document: stops playing; nothing is selected or hovered.
    void point_at_nothing();
    /// For another scene than that of the present opening: what was said and asked about that one is over.
    void turn_away();
    /// `next` follows the present document: it remembers which steps were looked at, and a query that is seen with
    /// another kind of trees goes on where it was left with that.
    void remember_step(Document& next);
    /// change_view as `name`; none: as what it changes says.
    void look(const std::function<void(ViewState&)>& change, const std::optional<EditName>& name);
    void change_document(Document next, const EditName& name);
    void share_time_and_camera();
    void changed();
    /// The scene of a case goes, after asking if it has unsaved changes, and what was open before it is back.
    void close_case(const std::function<void()>& then);

    bool attended_;
    History history_;
    std::shared_ptr<const FittedScene> pointed_into_;  ///< what selection and hovered are of
    std::shared_ptr<const FittedScene> saved_;
    std::optional<std::filesystem::path> file_;
    std::optional<std::filesystem::file_time_type> file_time_;  ///< of file_, when it was opened or saved
    std::vector<std::filesystem::path> opened_;
    int openings_ = 0;  ///< of files and excerpts so far
    std::optional<PictureSize> picture_size_;
    int times_put_back_ = 0;
    bool stepping_ = false;  ///< the step was changed in the present interaction
    std::vector<Message> messages_;
    std::deque<std::function<void()>> queue_;
    struct Running {
        std::unique_ptr<Job> job;
        Purpose purpose = Purpose::other;
    };
    std::vector<Running> jobs_;
    int handed_over_ = 0;        ///< documents that were opened, and jobs that were done
    double settled_height_ = 0;  ///< metres a second, of the last framing
    bool playing_ = false;
    bool has_played_ = false;  ///< since play(): the time that passes has a state
    std::pair<Dialog, DialogInput> behind_help_{Dialog::none, {}};
    std::function<void()> pending_;  ///< waits for the answer about unsaved changes
    bool closed_ = false;
    std::shared_ptr<Review> review_;
    bool reviewing_ = false;
    std::string open_case_;
    // Imports: one change after the other.
    struct ImportChange {
        int clip = 0;
        bool whole_file = false;
        std::string option;
        std::string text;
        bool goes_on = false;  ///< with the last edit, as FitEdit has it
    };
    bool imports() const;
    /// The clips that a change is of, with their options then; those that have them already are left out. Throws
    /// std::invalid_argument for a value out of range.
    std::vector<std::pair<int, ImportOptions>> options_wanted(const ImportChange& change) const;
    void start_import(const ImportChange& change);
    void import_next();
    void refuse_import(const ImportChange& change, const std::string& why);
    /// What the file of the clip in the dialog has to offer, for the options that it has now.
    void ask_for_offer();
    /// Points to the first warning that an option mends, of the clips from that index on.
    /// Of a saved scene: whether a clip's file is gone.
    void tell_of_lost_sources();
    void tell_of_warnings(std::size_t from);
    std::deque<ImportChange> import_changes_;        ///< not begun yet
    std::shared_ptr<const SourceFile> import_file_;  ///< that was read last

    /// What is computed from the present scene when asked for.
    struct Derived {
        std::shared_ptr<const FittedScene> of;
        std::optional<std::pair<int, RecordedQuery>> recorded;
        std::shared_ptr<const QueryFindings> findings;  ///< of `recorded`
        std::map<std::size_t, Answer> answers;
        std::map<int, std::vector<mobb::LevelFigures>> figures;
        std::optional<std::vector<ClipGroup>> groups;
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
    struct ExcerptSide {
        std::string name;
        SceneClip clip;
        mobb::Placement placement;
    };
    /// What open_excerpt does.
    void open_excerpt_of(ExcerptSide a, ExcerptSide b);
    mutable Shown shown_;  ///< of the active view
    struct PointedOut {
        int agent = -1, play = -1;  ///< of the choice
        int candidate = -1;
    };
    PointedOut pointed_out_;
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

    /// What was open before the scene of a case was, with all that goes with it. Its jobs run on, and are taken in once
    /// it is back.
    struct Aside {
        History history;
        std::shared_ptr<const FittedScene> saved;
        std::optional<std::filesystem::path> file;
        std::optional<std::filesystem::file_time_type> file_time;
        std::vector<std::filesystem::path> opened;
        std::vector<Running> jobs;
        std::deque<ImportChange> import_changes;
        std::shared_ptr<const SourceFile> import_file;
        std::optional<PictureSize> picture_size;
        std::map<std::string_view, Camera> cameras_aside;
        double settled_height = 0;
        std::optional<Alone> alone;
        std::string filter;
        Selection selection;
        PointedOut pointed_out;
        std::optional<Found> found;
        int conflict = -1;
    };
    Aside put_aside();
    void bring_back(Aside before);
    std::optional<Aside> aside_;
};

}  // namespace mobbscope::app
