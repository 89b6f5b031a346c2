/// The real window. All that knows GLFW stands behind this.
#pragma once

#include <app/window/shell.h>
#include <render/image/image.h>

#include <memory>
#include <optional>

namespace mobbscope::app {

/// Whether there is anything to open a window on: an X or Wayland display is named.
bool has_display();

class GlfwWindow final : public ShellHost {
  public:
    /// Opens the window on the session, whose hooks it takes over. `size` in pixels; none: kDefaultSize, and at most
    /// what the monitor has room for. Throws MachineError if there is no display or no OpenGL 3.3 on it. One at a time.
    GlfwWindow(Session& session, std::optional<PictureSize> size);
    ~GlfwWindow() override;
    GlfwWindow(const GlfwWindow&) = delete;
    GlfwWindow& operator=(const GlfwWindow&) = delete;

    /// Until the session is closed. Sleeps while nothing happens.
    void run();

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
