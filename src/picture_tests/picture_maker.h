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

    struct Made {
        Image picture;
        std::string state;  ///< what it shows (picture_state.h)
    };
    /// Throws InputError if the view cannot be drawn or the window's script fails, MachineError if OpenGL reports an
    /// error or the shader compiler a warning.
    Made make(const Shot& shot);
    /// The picture of a shot without a window, of what its panels draw (panel_lists). Throws as make does.
    Image draw(const Shot& shot, const std::vector<DrawList>& lists);

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
