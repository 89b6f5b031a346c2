/// `mobbscope [FILE...]`: the window.
#pragma once

#include <app/glfw_window.h>

#include <CLI/CLI.hpp>

#include <filesystem>
#include <vector>

namespace mobbscope::cli {

struct WindowArguments {
    std::vector<std::filesystem::path> files;
    app::WindowOptions window;
};

/// Adds FILE... and the window's options. `arguments` must live until the program has run.
void add_window_options(CLI::App& program, WindowArguments& arguments);

/// Throws InputError if an argument of the window stands before a command.
void check_not_before_command(const CLI::App& program);

/// Returns the exit status when the window is closed. Throws InputError if a file cannot be used, MachineError where
/// there is no display.
int open_window(const CLI::App& program, const WindowArguments& arguments);

}  // namespace mobbscope::cli
