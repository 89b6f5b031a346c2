/// What the window remembers from one time to the next; nothing that a picture depends on.
#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <vector>

namespace mobbscope::app {

struct Settings {
    std::vector<std::filesystem::path> recent;  ///< scenes and clips that were opened, latest first, at most 12
    double ui_scale = 0;                        ///< of text and panels; 0: the monitor's
    double left_width = 256;                    ///< of the panels, pixels at scale 1
    double right_width = 320;
    double bottom_height = 150;
    std::set<std::string> folded;  ///< sections of panels, by their titles in small letters

    /// Puts a file first.
    void remember(const std::filesystem::path& file);
    friend bool operator==(const Settings&, const Settings&) = default;
};

/// The person's settings file: in $XDG_CONFIG_HOME, else ~/.config; empty where there is neither.
std::filesystem::path settings_file();
/// What the file says; the defaults for what it lacks or says wrong. Never throws.
Settings load_settings(const std::filesystem::path& file);
/// Silently does nothing where it cannot write: no work is lost by it.
void save_settings(const std::filesystem::path& file, const Settings& settings);

}  // namespace mobbscope::app
