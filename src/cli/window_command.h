/// `mobbscope [FILE...]`: the window.
#pragma once

#include <render/image/image.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace mobbscope::cli {

class Command;

struct WindowArguments {
    std::vector<std::filesystem::path> files;
    std::optional<PictureSize> size;
    std::optional<double> ui_scale;
    std::filesystem::path script;  ///< empty: none
    bool headless = false;         ///< the script runs without a window
    std::filesystem::path cases;   ///< the folder of picture tests to review; empty: none
    std::filesystem::path output;  ///< ... and where an earlier run left pictures; empty: nowhere
    std::string backend = "auto";  ///< ... and what draws them
};

/// Adds FILE... and the window's options. `arguments` must live until the program has run.
void add_window_options(Command& program, WindowArguments& arguments);

/// `mobbscope review DIR`: the window on picture tests.
void add_review_command(Command& program);

/// Throws InputError if an argument of the window stands before a command.
void check_not_before_command(const Command& program);

/// Returns the exit status when the window is closed or the script has ended. Throws InputError if a file cannot be
/// used, MachineError where there is no display for a window.
int open_window(const Command& program, const WindowArguments& arguments);

}  // namespace mobbscope::cli
