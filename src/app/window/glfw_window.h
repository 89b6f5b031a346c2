/// The real window. All that knows GLFW stands behind this.
#pragma once

#include <app/window/shell.h>
#include <render/image/image.h>

#include <functional>
#include <memory>
#include <optional>

namespace mobbscope::app {

/// Whether there is anything to open a window on: an X or Wayland display is named.
bool has_display();

class GlfwWindow final : public ShellHost {
  public:
    /// Opens the window on the session, whose hooks it takes over. `size` in pixels; none: kDefaultSize, and at most
    /// what the monitor has room for. `display_lost` is called when the display goes away, in the midst of anything; it
    /// ends the program. Throws MachineError if there is no display or no OpenGL 3.3 on it. One at a time.
    GlfwWindow(Session& session, std::optional<PictureSize> size, std::function<void()> display_lost);
    ~GlfwWindow() override;
    GlfwWindow(const GlfwWindow&) = delete;
    GlfwWindow& operator=(const GlfwWindow&) = delete;

    /// Until the session is closed, or `interrupted`, which is asked after each event. Sleeps while nothing happens.
    void run(const std::function<bool()>& interrupted);

    Shell& shell() override;
    void frame() override;
    void run_for(double seconds) override;
    void resize(PictureSize size) override;
    void settle() override;

  private:
    struct State;
    std::unique_ptr<State> state_;
};

Image window_icon(int side);

}  // namespace mobbscope::app
