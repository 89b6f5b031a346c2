/// Copies of what is modified, in case that the window does not end as it should: each window keeps its own, and offers
/// those of windows that are gone.
#pragma once

#include <app/document/unsaved_work.h>
#include <app/session/files.h>
#include <base/descriptor.h>

#include <ctime>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace mobbscope::app {

class Recovery {
  public:
    // Seconds.
    static constexpr double kPause = 2;     ///< without a change, after which a copy is written
    static constexpr double kLongest = 10;  ///< of changes without a copy, and between two tries where none can be had

    Recovery(const Workspace& workspace, Files& files, Notifications& notifications, Desktop*& desktop)
        : workspace_(workspace), files_(files), notifications_(notifications), desktop_(desktop) {}
    ~Recovery();
    Recovery(const Recovery&) = delete;
    Recovery& operator=(const Recovery&) = delete;

    /// From now on copies are kept, in a folder of this window in that folder, which all windows share.
    void keep_in(const std::filesystem::path& folder) { folder_ = folder; }
    /// Writes a copy of what is modified, beside the window and once it has not changed for a while, and removes that
    /// of what is not. `now`: seconds. Returns in how many seconds to call it again; infinity: when something changes.
    double poll(double now);
    bool is_writing() const { return writing_.has_value(); }
    /// Writes what poll would write later: the window ends unasked. Whether anything is kept.
    bool keep_now();
    /// Ends work beside the window, which is gone.
    void end_work();
    /// The window ends as it should: nothing is kept.
    void discard_own();

    /// A copy that a window has left which is gone.
    struct Left {
        std::string name;  ///< "crossing.json from 14:31", for commands; each another
        std::filesystem::path copy;
    };
    /// Looks for them, and offers those that are new.
    void look();
    const std::vector<Left>& left() const { return left_; }
    bool has_left() const { return !left_.empty(); }
    // Throw InputError if there is no such copy (any more), or another window has taken it.
    /// Opens it as it was, modified; from then on the copy is this window's.
    void restore(const std::string& name);
    void discard(const std::string& name);

  private:
    /// Of one work, by its name in the window's folder.
    struct Copy {
        UnsavedWork written{};                 ///< or being written; no scene: none yet
        UnsavedWork seen{};                    ///< when it changed last
        double changed = 0;                    ///< then
        std::optional<double> first_change{};  ///< of the scene, since it was written
        double next_try = 0;
    };
    struct Writing {
        std::string name;
        std::unique_ptr<Job> job;
    };

    std::map<std::string, UnsavedWork> works() const;
    std::filesystem::path file_of(const std::string& name) const { return own_ / (name + std::string(kExtension)); }
    void make_own_folder();
    void remove(const std::string& name) const;
    void begin_writing(const std::string& name, const UnsavedWork& work, double now);
    void end_writing(double now);
    /// Said once, until it works again.
    void note_failure(const std::string& name, const std::string& why, double now);
    void look_in(const std::filesystem::path& of_window, std::vector<Left>& found);
    Left offered(const std::filesystem::path& copy, const std::vector<Left>& others);
    const Left& find(const std::string& name) const;
    /// The lock on its folder.
    Descriptor taken(const std::string& name);
    /// Takes it off the list, and its offer.
    void forget(const std::string& name);
    /// The copy that was opened is that of the scene.
    void adopt(const std::filesystem::path& copy);

    static constexpr std::string_view kExtension = ".unsaved";

    const Workspace& workspace_;
    Files& files_;
    Notifications& notifications_;
    Desktop*& desktop_;
    std::filesystem::path folder_;  ///< of all windows; empty: no copies are kept
    std::filesystem::path own_;     ///< of this window; empty: none yet
    Descriptor lock_;               ///< on it, as long as the window lives
    std::map<std::string, Copy> copies_;
    std::optional<Writing> writing_;
    bool failed_ = false;  ///< the last copy could not be written, as was said
    std::vector<Left> left_;
};

}  // namespace mobbscope::app
