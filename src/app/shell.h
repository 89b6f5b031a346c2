/// The window without its frame: input events in, pixels out, on any OpenGL context. The real window, scripts and
/// `render --ui` all run this.
#pragma once

#include <app/input.h>
#include <app/session.h>
#include <app/ui.h>
#include <render/gl_context.h>
#include <render/image.h>

#include <memory>
#include <string>

namespace mobbscope::app {

class Shell {
  public:
    /// `scale`: of text and panels, 0.5 to 4. Throws MachineError if OpenGL fails.
    Shell(std::unique_ptr<GlContext> context, Session& session, double scale);
    ~Shell();

    void feed(const InputEvent& event);

    /// One frame into the shell's own framebuffer. `now`: seconds, never less than before. Returns in how many seconds
    /// the next one is wanted if nothing happens; infinity: never.
    double frame(PictureSize size, double now);

    /// The last frame.
    Image read_back();
    /// Copies the last frame to the context's default framebuffer.
    void present();

    /// Where widgets stood in the last frame.
    const Marks& marks() const;
    /// The viewport's picture, as `render` draws it.
    Image viewport_picture();

    void set_scale(double scale);
    ImGuiMouseCursor cursor() const;
    bool wants_text() const;

  private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace mobbscope::app
