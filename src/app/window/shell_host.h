/// Where a shell is shown: in a real window, or nowhere.
#pragma once

#include <app/window/shell.h>
#include <render/image/image.h>

namespace mobbscope::app {

/// The size of a window where none is asked for, pixels at scale 1.
inline constexpr PictureSize kDefaultSize{1280, 800};
inline constexpr PictureSize kLeastSize{640, 400};

class ShellHost {
  public:
    virtual ~ShellHost() = default;

    virtual Shell& shell() = 0;
    /// Takes in what has happened and draws one frame.
    virtual void frame() = 0;
    /// Lets it run for so long.
    virtual void run_for(double seconds) = 0;
    /// Both sides at least 64 pixels.
    virtual void resize(PictureSize size) = 0;

    /// Frames until everything stands where it will stay, and all input is taken in.
    virtual void settle() = 0;
};

}  // namespace mobbscope::app
