/// (scene, view state, size) -> pixels, in one call.
#pragma once

#include <render/gl/renderer.h>
#include <render/image/image.h>
#include <scene/fitted_scene.h>
#include <scene/view_state.h>

#include <string>

namespace mobbscope {

/// The picture of a scene; `scale` as in build_draw_list. The same arguments give the same picture on the same backend
/// and machine. Throws std::invalid_argument (see build_draw_list) and MachineError (see Renderer::draw).
Image render(const FittedScene& fitted, const ViewState& view, PictureSize size, Renderer& renderer, double scale = 0);

/// What is in each pixel of that picture.
IdImage render_ids(const FittedScene& fitted, const ViewState& view, PictureSize size, Renderer& renderer,
                   double scale = 0);

/// Throws std::invalid_argument, saying what is allowed, unless a picture of this size can be made.
void check(PictureSize size);

/// "1280x720". Throws std::invalid_argument if it is no such text or check refuses it.
PictureSize parse_size(const std::string& text);

}  // namespace mobbscope
