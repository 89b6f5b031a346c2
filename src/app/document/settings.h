/// What the window remembers from one time to the next; nothing that a picture without a window depends on.
#pragma once

#include <app/document/picture_export.h>
#include <explain/query_workload.h>
#include <scene/view_state.h>

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace mobbscope::app {

/// Where the window stood: in the display's coordinates, as it is when it is not maximised.
struct WindowPlace {
    int x = 0, y = 0;
    int width = 0, height = 0;
    bool maximized = false;
    friend bool operator==(const WindowPlace&, const WindowPlace&) = default;
};

/// What was open at the end, and how it was seen.
struct LastSession {
    std::vector<std::filesystem::path> files;  ///< absolute; empty: there is none
    ViewState view;
    friend bool operator==(const LastSession&, const LastSession&) = default;
};

/// What the panel below the picture shows, beside the clocks.
enum class BottomTab : std::uint8_t {
    recursion,  ///< of the query in view; without one, the paths over time
    events,     ///< of the query in view; without one, the paths over time
    nodes,
    curves,
};
std::span<const std::string_view> bottom_tab_names();

struct Settings {
    std::vector<std::filesystem::path>
        recent;                    ///< scenes, clips and folders that were opened, latest first, at most 20
    std::filesystem::path folder;  ///< where a file was opened or written last; empty: nowhere yet
    double ui_scale = 0;           ///< of text and panels; 0: the monitor's
    double left_width = 256;       ///< of the panels, pixels at scale 1
    double right_width = 320;
    double bottom_height = 150;
    double events_height = 300;  ///< of the panel below with a list or with curves
    BottomTab bottom_tab = BottomTab::recursion;
    QueryWorkload::Kind cost_of = QueryWorkload::Kind::placements;  ///< what costs of trees are about
    std::optional<Theme> theme;                                     ///< that was chosen last; none: never
    std::optional<WindowPlace> window;                              ///< none: it was never open
    std::map<std::string, bool>
        folded;  ///< sections of panels, by their titles in small letters: whether each is folded
    std::string file_order =
        "name";  ///< of the file dialog: "name", "size" or "date", with "-" from the last to the first
    LastSession last;
    PictureExport picture_export;  ///< what the export dialog was last asked for

    /// Puts a file first.
    void remember(const std::filesystem::path& file);
    friend bool operator==(const Settings&, const Settings&) = default;
};

/// The person's settings file: in $XDG_CONFIG_HOME, else ~/.config; empty where there is neither.
std::filesystem::path settings_file();
/// Where windows keep copies of what is not saved: in $XDG_STATE_HOME, else ~/.local/state; likewise.
std::filesystem::path unsaved_folder();
/// What the file says; the defaults for what it lacks or says wrong. Never throws.
Settings load_settings(const std::filesystem::path& file);
/// Keeps what this version cannot read and would overwrite. A file that is no settings is renamed to
/// "settings.json.unreadable", or with a number behind it; one of a newer version, or one that cannot be opened or
/// renamed, stays, and nothing is saved. What the person is told of that; empty if the file is fine, or there is none.
std::string keep_unreadable_settings(const std::filesystem::path& file);

/// The settings in their file, which several windows share: each writes what it has changed, and the rest stays as
/// another one wrote it.
class SettingsFile {
  public:
    /// More is set aside as unreadable, and no more is written.
    static constexpr std::uintmax_t kMostBytes = std::uintmax_t{1} << 20;
    static constexpr int kDeepest = 64;  ///< nested values

    /// Empty: there is none, and nothing is saved.
    explicit SettingsFile(std::filesystem::path file = {}) : file_(std::move(file)) {}

    /// As load_settings.
    Settings load();
    /// What holds this once counts as read: it is written only when it changes.
    void note(const Settings& settings) { known_ = settings; }
    /// Writes what was changed since they were loaded or saved last. Files that were opened since come first of the
    /// recent ones, and `settings` gets those of other windows too. Silently does nothing where it cannot write, or
    /// would overwrite what it cannot read: no work is lost by it. Keys that are unknown here stay: they are another
    /// version's.
    void save(Settings& settings);

  private:
    std::filesystem::path file_;
    Settings known_;  ///< as they were loaded or saved last
};

}  // namespace mobbscope::app
