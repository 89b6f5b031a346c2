/// For whom a session works.
#pragma once

#include <chrono>
#include <filesystem>

namespace mobbscope::app {

struct SessionOptions {
    /// False for scripts and pictures. Jobs are then waited for, nothing is animated, and no settings of the person are
    /// read or written.
    bool attended = false;
    /// Whether a sweep measures: not where a picture of the window is to be the same each time.
    bool may_measure = true;
    /// Whether the scene and pictures of it may be written: not where a window is only looked at.
    bool may_write = true;
    /// Shorter work of an attended window is waited for: one that flickers is worse than one that is late by this. With
    /// 0 no work is, however short.
    std::chrono::milliseconds patience{80};
    /// `mobbscope`, which draws films.
    std::filesystem::path program = "/proc/self/exe";
};

}  // namespace mobbscope::app
