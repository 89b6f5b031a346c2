/// A driver of OpenGL may crash while it is opened, while it compiles its first shaders, or later. A program that asks
/// for it goes on in a child process from where it opens its first context without a display; its parent waits, and
/// ends as the child does. If a driver crashes before it has drawn anything, the parent goes on in a new child with the
/// next.
#pragma once

#include <chrono>
#include <functional>
#include <optional>
#include <string>

namespace mobbscope {

struct DriverWatch {
    std::function<void(const std::string&)> say;  ///< a line for the user
    std::function<void()> end_threads;            ///< of those that only wait for work: a process forks with one thread
    int status_of_crash;                          ///< exit status after a driver's crash that nothing can be made of
};

/// For a program, once, before any driver is loaded. Where there is more than one thread, no process to be had, or the
/// environment says MOBBSCOPE_NO_WATCH, the program goes on unwatched.
void watch_drivers(DriverWatch watch);

/// A driver that crashed before it had drawn.
struct DriverCrash {
    int backend;          ///< as told to go_on_watched
    std::string reasons;  ///< why each that was tried until then cannot draw: "osmesa: crashed (...); egl: ..."
};

/// To call before each backend is opened: goes on in a child, once. `reasons`: why those before cannot draw.
/// Comes back with a crash, in the parent, if there was one.
std::optional<DriverCrash> go_on_watched(int backend, const std::string& name, const std::string& reasons);

/// To call with a context current when something was drawn: from then on it is too late for another driver.
void note_drawn();

/// What `work` returns or throws (std::runtime_error), done in a child process. Throws std::runtime_error if a driver
/// crashes in it, or it takes longer than that. In this process where there can be no child.
std::string done_in_child(const std::function<std::string()>& work, std::chrono::milliseconds longest);

/// What may keep a driver from drawing, to end a message with: what Mesa reads from the environment, and a limit of
/// memory. "" if there is neither.
std::string driver_advice();

}  // namespace mobbscope
