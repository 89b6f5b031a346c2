/// Opening and saving, what is asked about unsaved changes, and the workspace that a visit suspends.
#pragma once

#include <app/session/imports.h>
#include <app/session/screen.h>

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace mobbscope::app {

/// A scene that was made in a job, and what is said once it is open.
struct MadeScene {
    Scene scene;
    std::function<void()> then;
};

/// Whether what is opened holds all that it replaces: then nobody is asked about unsaved changes.
enum class Replaces { another, what_it_holds };

class Files {
  public:
    struct Parts {
        Workspace& workspace;
        Jobs& jobs;
        Edits& edits;
        Imports& imports;
        Dialogs& dialogs;
        Notifications& notifications;
        Playback& playback;
        Settings& settings;
        SettingsFile& settings_file;
        Counts& counts;
        const SessionOptions& options;
        Screen*& screen;
    };
    explicit Files(const Parts& parts) : parts_(parts) {}

    // What they cannot open becomes a message, and what was open stays. All ask first if there are unsaved changes.
    /// Several files become one scene; folders stand for the clips in them.
    void open(const std::vector<std::filesystem::path>& files);
    /// A scene that was read from those files already.
    void open_scene(const Scene& scene, const std::vector<std::filesystem::path>& files);
    /// What `make` gives, as a scene that is not saved.
    void open_made(const std::string& title, const std::function<MadeScene(JobControl&)>& make, Replaces replaces);
    /// The scene that comes with the program.
    void open_demo();
    /// Opens settings.last, seen as it was.
    void reopen_last();
    /// Whether there is anything to reopen that is still there.
    bool has_last() const;
    /// "crossing.json", or "3 files"; requires has_last().
    std::string last_title() const;
    /// Opens a copy of work that was not saved, as changed as it is; then does `then`.
    void open_unsaved(const std::filesystem::path& copy, const std::string& title, const std::function<void()>& then);
    /// What is open is that of the next time's settings.last.
    void note_session();

    /// Whether files can be added: not to a run, which stands alone, nor where another screen is shown.
    bool may_add() const { return !parts_.workspace.crowd() && !parts_.screen; }
    /// Adds clips, or whole scenes, to the document, and says what is wrong with them once they are in it. Throws
    /// InputError if nothing can be added.
    void add(const std::vector<std::filesystem::path>& files);
    /// Opens what was dropped on the window; asks where the person has something open, which it may be added to.
    void drop(const std::vector<std::filesystem::path>& files);

    /// Throws MachineError if it cannot be written; without a file asks for one. What waits for the answer about
    /// unsaved changes goes on when they are saved.
    void save();
    void save_as(const std::filesystem::path& file);
    /// Says what other programs have done to the files of what is open, each time once.
    void tell_of_changed_files();
    /// Throws InputError if nothing may be written (SessionOptions::may_write).
    void check_may_write(const std::filesystem::path& file) const;

    /// Does `then`, at once or when the person has said what becomes of unsaved changes.
    void after_asking(const std::function<void()>& then);
    enum class Unsaved { save, discard, cancel };
    /// The answer.
    void answer_unsaved(Unsaved choice);

    /// Opens a document in place of what is open, which is suspended with its jobs until `come_back`.
    void visit(Document document, const std::string& name);
    /// The name of what is visited; empty if nothing is.
    const std::string& visited() const { return visited_; }
    /// The workspace that it suspends; null if nothing is visited.
    const Workspace* suspended() const { return suspended_ ? &*suspended_ : nullptr; }
    /// The suspended workspace is back, after asking if there are unsaved changes; then, or if nothing is visited, does
    /// `then`.
    void come_back(const std::function<void()>& then);

    /// Ends the program, after asking if there are unsaved changes; while a film is made only if it is asked twice.
    void request_close();
    bool closed() const { return closed_; }
    /// Ends all work for the workspace and the suspended one.
    void end_work();

  private:
    /// In a job: reads something, and gives what puts it in the place of what is open.
    using Opening = std::function<std::function<void()>(JobControl&)>;
    /// Does so after asking if there are unsaved changes. What cannot be loaded leaves all as it was: what `opening`
    /// throws (InputError, MachineError, std::invalid_argument, Cancelled) becomes a message.
    void load(const std::string& title, const Opening& opening, Replaces replaces = Replaces::another);
    using LoadAll = std::function<Scene(JobControl&)>;
    /// Loads what `load_all` gives, seen as that says or as `view`.
    void load_scene(const std::string& title, const LoadAll& load_all, const std::vector<std::filesystem::path>& files,
                    const std::optional<ViewState>& view = std::nullopt);
    void replace(Document document, const std::vector<std::filesystem::path>& opened);
    /// Compares the answers and traces that the file has with new ones, beside the window; says what differs.
    void check_stored();
    /// For another scene than that of the present opening: what was said and asked about that one is over.
    void turn_away();
    /// Says so if one of them is not there; whether it did.
    bool complain_of_missing(const std::vector<std::filesystem::path>& files);
    /// They are the latest of the recent ones.
    void remember(const std::vector<std::filesystem::path>& files);
    /// Whether something is open that is not the demo as it comes.
    bool opened_by_person() const;
    /// Those of the document and of its clips' sources that were not as they are when they were seen last.
    std::vector<std::filesystem::path> look_at_files();
    void tell_of(const std::vector<std::filesystem::path>& changed);
    /// Of a saved scene: whether a clip's file is gone.
    void tell_of_lost_sources();

    Parts parts_;
    std::optional<Workspace> suspended_;
    std::string visited_;
    bool asked_about_films_ = false;
    bool closed_ = false;
};

}  // namespace mobbscope::app
