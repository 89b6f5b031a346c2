/// Makes the pictures of shots, one after the other, with what can be shared between them.
#pragma once

#include <base/error.h>
#include <picture_tests/shot.h>
#include <render/drawlist/draw_list.h>
#include <render/gl/renderer.h>
#include <render/image/image.h>

#include <string>
#include <string_view>
#include <vector>

namespace mobbscope::picture_tests {

class PictureMaker {
  public:
    /// Throws MachineError if there is no such context.
    explicit PictureMaker(Backend backend);

    std::string_view backend() const { return renderer_.backend(); }
    Renderer& renderer() { return renderer_; }

    /// Throws InputError if the view cannot be drawn or the window's script fails, MachineError if OpenGL reports an
    /// error or the shader compiler a warning.
    Image make(const Shot& shot);
    /// The picture of a shot without a window, of what its panels draw (panel_lists). Throws as make does.
    Image make(const Shot& shot, const std::vector<DrawList>& lists);

    /// What panels draw, as JSON with the number of pixels of each object (draw_list_json.h): an object, or for several
    /// panels an array of them. Throws as make does.
    std::string draw_lists(const std::vector<DrawList>& lists);

    /// What a window shows: the scene in it without text, and its state as JSON. Throws as make does.
    struct Window {
        Image picture;
        std::string state;
    };
    Window window_without_text(const Shot& shot);

  private:
    Renderer renderer_;
};

/// Throws MachineError if there are any.
inline void refuse_warnings(std::string_view backend, const std::vector<std::string>& warnings) {
    if (warnings.empty()) return;
    throw MachineError(std::string(backend) + ", compiling shaders: " + warnings.front());
}

/// By panel, each at its size in the picture. Panels that are seen in the same way by a camera that frames the scene
/// by itself share one that sees all of them. Throws InputError if a view cannot be drawn. The shot has no window.
std::vector<DrawList> panel_lists(const Shot& shot);

}  // namespace mobbscope::picture_tests
