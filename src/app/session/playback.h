/// Lets the time cursor run.
#pragma once

#include <app/document/workspace.h>

namespace mobbscope::app {

class Playback {
  public:
    explicit Playback(Workspace& workspace) : workspace_(workspace) {}

    double speed = 1;  ///< seconds of the scene per second
    /// From the first moment where there is no cursor; how far it comes is one state, or goes into what is done
    /// meanwhile.
    void play();
    void stop() { playing_ = false; }
    bool playing() const { return playing_; }
    /// Moves the cursor on if it is playing; at the end it begins again.
    void advance(double seconds);

  private:
    Workspace& workspace_;
    bool playing_ = false;
    bool has_played_ = false;  ///< since play(): the time that passes has a state
};

}  // namespace mobbscope::app
