/// The whole window as a picture, without a display.
#pragma once

#include <app/script/script.h>
#include <render/gl/gl_context.h>
#include <render/image/image.h>
#include <scene/fitted_scene.h>

#include <filesystem>
#include <string>

namespace mobbscope::picture_tests {

/// A picture of a window, and what its panels show as JSON (app/script/state_json.h).
struct WindowPicture {
    Image picture;
    std::string state;
};

/// One frame of the real thing with the scene open in it, after a script (or none) has worked it. It knows no settings
/// of a person, and its working folder is the scene's. `file`: where the scene is from. `scale`: of text and panels,
/// app::kLeastUiScale..kMostScale. Throws MachineError if there is no such context, OpenGL reports an error or the
/// shader compiler a warning; what Script::run throws.
WindowPicture window_picture(const FittedScene& fitted, const ViewState& view, const std::filesystem::path& file,
                             Backend backend, PictureSize size, double scale, const app::Script* script = nullptr);

}  // namespace mobbscope::picture_tests
