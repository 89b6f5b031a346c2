/// The whole window as a picture, without a display.
#pragma once

#include <app/script/script.h>
#include <render/drawlist/draw_list.h>
#include <render/gl/gl_context.h>
#include <render/image/image.h>
#include <scene/fitted_scene.h>

#include <filesystem>
#include <string>

namespace mobbscope::picture_tests {

/// One frame of the real thing with the scene open in it, after a script (or none) has worked it. It knows no settings
/// of a person, and its working folder is the scene's. `file`: where the scene is from. `scale`: of text and panels,
/// app::kLeastUiScale..kMostScale. Throws MachineError if there is no such context, OpenGL reports an error or the
/// shader compiler a warning; what Script::run throws.
Image window_picture(const FittedScene& fitted, const ViewState& view, const std::filesystem::path& file,
                     Backend backend, PictureSize size, double scale, const app::Script* script = nullptr);

/// What the same window shows when the script is done, but for its words.
struct WindowContents {
    DrawList scene;     ///< as in the middle of the window, without text
    std::string state;  ///< what the panels are made from (app/script/state_json.h)
};
/// `picture`: the size that the scene is drawn at; the window's panels, and so its viewport, are as wide as their
/// words. Throws as window_picture does, and what build_draw_list throws.
WindowContents window_contents(const FittedScene& fitted, const ViewState& view, const std::filesystem::path& file,
                               Backend backend, PictureSize size, double scale, PictureSize picture,
                               const app::Script* script = nullptr);

}  // namespace mobbscope::picture_tests
