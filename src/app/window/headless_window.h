/// A shell without a window, for pictures and scripts. Its clock runs by a sixtieth of a second a frame.
#pragma once

#include <app/window/shell.h>

#include <memory>

namespace mobbscope::app {

class HeadlessWindow final : public ShellHost {
  public:
    /// Throws MachineError if OpenGL fails.
    HeadlessWindow(std::unique_ptr<GlContext> context, Session& session, PictureSize size, double scale);

    Shell& shell() override { return shell_; }
    void frame() override;
    void run_for(double seconds) override;
    void resize(PictureSize size) override { size_ = size; }
    void settle() override;

  private:
    PictureSize size_;
    Shell shell_;
    double now_ = 0;
};

}  // namespace mobbscope::app
