/// One view as the pictures that are asked for: itself, or a numbered sequence.
#pragma once

#include <cli/render/render_options.h>
#include <render/drawlist/draw_list.h>
#include <scene/fitted_scene.h>

#include <vector>

namespace mobbscope::cli {

struct RenderPicture {
    ViewState view;
    RenderOutputs outputs;
    std::optional<DrawList> list{};  ///< once it is made: of this view
};

/// The most pictures of one sequence.
inline constexpr int kMostPictures = 100'000;

/// All pictures, not yet framed in common. Throws InputError if there are none such, or too many;
/// std::invalid_argument if the scene lacks what the view names.
std::vector<RenderPicture> pictures_of(const FittedScene& fitted, const ViewState& view,
                                       const RenderArguments& arguments);

}  // namespace mobbscope::cli
