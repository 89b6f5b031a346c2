/// What a session asks of the window around it. The defaults are those of no window.
#pragma once

#include <render/drawlist/draw_list.h>
#include <render/image/image.h>

#include <filesystem>
#include <optional>
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
    /// None where there is no clipboard.
    virtual std::optional<std::string> clipboard() { return std::nullopt; }
    /// Throws MachineError, or std::invalid_argument where there is none.
    virtual void set_clipboard_picture(std::string_view /*png*/) {
        throw std::invalid_argument(std::string(why_no_clipboard_picture()));
    }
    /// Empty: pictures can be copied.
    virtual std::string_view why_no_clipboard_picture() { return "there is no clipboard without a display"; }
};

/// Draws pictures that are to be kept. Throws std::invalid_argument where there is no window.
class PictureMaker {
  public:
    virtual ~PictureMaker() = default;
    /// As Renderer::draw.
    virtual Image draw(const DrawList&, int /*samples*/) {
        throw std::invalid_argument("there is no window to take a picture of");
    }
    /// As Renderer::draw_coarse.
    virtual Image draw_coarse(const DrawList& list, int /*divisor*/) { return draw(list, 1); }
    /// Why there cannot be so many samples a pixel; empty: there can.
    virtual std::string why_no_samples(int /*samples*/) { return ""; }
    /// As picture_bytes (render/vector/vector_picture.h).
    virtual std::string file_bytes(const std::filesystem::path& /*file*/, const DrawList&, int /*samples*/) {
        throw std::invalid_argument("there is no window to take a picture of");
    }
};

}  // namespace mobbscope::app
