/// SIGINT, SIGTERM and SIGHUP while a window is open: it keeps what is not saved before it ends by them.
#pragma once

#include <base/descriptor.h>

#include <functional>
#include <thread>

namespace mobbscope::app {

/// The first of them is noted, and wakes the window. A second one ends the program as they did before, and so does the
/// first if the window has not ended soon, or the system has no thread to give. One at a time. Who ignores one, as
/// nohup does, goes on.
class EndSignals {
  public:
    /// `wake` is called from another thread.
    explicit EndSignals(std::function<void()> wake);
    ~EndSignals();
    EndSignals(const EndSignals&) = delete;
    EndSignals& operator=(const EndSignals&) = delete;

    /// Whether one has come.
    static bool any();
    /// Ends the program by the one that has come, as it did before.
    [[noreturn]] static void end();

  private:
    void wait_for_one() const;

    std::function<void()> wake_;
    Descriptor told_;  ///< the end of a pipe from the handler
    Descriptor tells_;
    std::thread thread_;
};

}  // namespace mobbscope::app
