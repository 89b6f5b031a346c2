/// The window without its frame: input events in, pixels out, on any OpenGL context. The real window, scripts and
/// `render --ui` all run this.
#pragma once

#include <app/input/input.h>
#include <app/session/session.h>
#include <app/ui/ui.h>
#include <render/drawlist/draw_list.h>
#include <render/gl/gl_context.h>
#include <render/image/image.h>

#include <functional>
#include <memory>
#include <string>

namespace mobbscope {
struct DrawStatistics;  // render/gl/gl_objects.h
}

namespace mobbscope::app {

class Shell {
  public:
    /// Seconds, never less than before: what painting takes is measured by it.
    using Clock = std::function<double()>;
    static double steady_seconds();

    /// `scale`: of text and panels where the settings say none; either is brought within kLeastUiScale..kMostUiScale.
    /// It is the session's PictureMaker. Throws MachineError if OpenGL fails.
    Shell(std::unique_ptr<GlContext> context, Session& session, double scale, Clock clock = steady_seconds);
    ~Shell();
    Shell(const Shell&) = delete;
    Shell& operator=(const Shell&) = delete;

    void feed(const InputEvent& event);

    /// One frame; it is drawn when it is read back or presented. `size`: at least 1x1. `now`: seconds, never less than
    /// before. Returns in how many seconds the next one is wanted if nothing happens; infinity: never. While a fine
    /// picture is being painted that is at once: each drawing goes on with it for a moment.
    double frame(PictureSize size, double now);

    /// Whether the last frame has taken in all input, and nothing but playback and how fine pictures are still changes.
    bool settled() const;

    /// How many frames were looked at, and so drawn.
    int frames_drawn() const;
    /// How many pictures of viewports were painted whole: those that stay, and those that stood in for one.
    struct Painted {
        int fine = 0, coarse = 0;
    };
    Painted painted() const;

    /// The last frame; there must have been one. Throws MachineError if OpenGL reports an error.
    Image read_back();
    /// Copies the last frame to the context's default framebuffer; likewise.
    void present();

    /// Where widgets stood in the last frame.
    const Marks& marks() const;
    /// What the active viewport shows; null if there is no picture yet.
    const DrawList* shown() const;
    /// What the last picture that was painted of a viewport took.
    const DrawStatistics& statistics() const;
    /// The viewport's picture with what is selected, as `render` draws it, and with what folds its overlays. Throws
    /// std::invalid_argument if there is none yet.
    Image viewport_picture();

    /// Of text and panels where the settings say none: another monitor has another.
    void set_scale(double scale);
    ImGuiMouseCursor cursor() const;

  private:
    struct State;
    std::unique_ptr<State> state_;
};

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
