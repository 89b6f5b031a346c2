/// What a session asks of the window around it. The defaults are those of no window.
#pragma once

#include <render/drawlist/draw_list.h>
#include <render/image/image.h>

#include <stdexcept>
#include <string>
#include <string_view>

namespace mobbscope::app {

/// The desktop that the window stands on.
class Desktop {
  public:
    virtual ~Desktop() = default;
    /// There is news: draw a frame. Called from any thread.
    virtual void wake() {}
    // Texts are UTF-8.
    virtual void set_clipboard(const std::string&) {}
    virtual std::string clipboard() { return ""; }
    /// Throws MachineError, or std::invalid_argument where there is none.
    virtual void set_clipboard_picture(std::string_view /*png*/) { throw std::invalid_argument(std::string(why_no_clipboard_picture())); }
    /// Empty: pictures can be copied.
    virtual std::string_view why_no_clipboard_picture() { return "there is no clipboard for pictures"; }
};

/// Draws pictures that are to be kept.
class PictureMaker {
  public:
    virtual ~PictureMaker() = default;
    /// As Renderer::draw.
    virtual Image draw_picture(const DrawList& list, int samples) = 0;
    /// As Renderer::draw_coarse.
    virtual Image draw_coarse_picture(const DrawList& list, int divisor) = 0;
    /// Why there cannot be so many samples a pixel; empty: there can.
    virtual std::string why_no_samples(int samples) = 0;
};

}  // namespace mobbscope::app
