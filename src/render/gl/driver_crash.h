/// Whose crash it is: OpenGL's driver's, or the program's own.
#pragma once

#include <array>
#include <atomic>
#include <string>

namespace mobbscope {

/// What a process that crashes in a driver leaves, in memory that another process sees.
struct CrashNote {
    std::atomic<int> signal = 0;  ///< 0: it did not crash, or not in a driver
    std::array<char, 128> library{};
};

/// Takes what is loaded now for the program itself: to call before any driver is.
void note_program();

/// From now on a crash of this process is noted if code that was loaded or made since note_program stands between it
/// and the program's own, and ends the process by its signal. Any other goes to who handled it before.
void note_crashes(CrashNote& note);

/// "crashed (Segmentation fault in libOSMesa.so.8)".
std::string described(const CrashNote& note);

}  // namespace mobbscope
