/// (scene, view state, size) -> draw list: all decisions about a picture, in numbers, without OpenGL.
#pragma once

#include <render/drawlist/draw_list.h>
#include <render/drawlist/picture_options.h>
#include <render/drawlist/shown_points.h>
#include <render/image/rect.h>
#include <render/pictures/played.h>
#include <scene/fitted_scene.h>
#include <scene/view_state.h>

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace mobbscope {

class MoveSet;          // crowd/simulation/reservation_table.h
struct FollowedChoice;  // crowd/simulation/choice.h

/// The most disks of agents that are drawn where they share clips; agents with clips of their own may have any number.
inline constexpr std::size_t kMostDisksOfSharedClips = 2'000'000;

/// `scale`: of text and lines, kLeastScale..kMostScale (1 suits 1280x720); 0: what suits the size. Throws
/// std::invalid_argument, saying what is allowed, if the scale is another, the view names a query or a step that there
/// is not, the scene has nothing to draw,
/// or more than kMostDisksOfSharedClips.
DrawList build_draw_list(const FittedScene& fitted, const ViewState& view, PictureSize size, double scale = 0);

/// The same with a background: an opaque one replaces the palette's. The samples are the renderer's. A run is drawn as
/// fitted_at makes it a scene, with the last choice of the agent that the view follows. For one that is made already
/// `choice` is that; null: none is drawn.
DrawList build_draw_list(const FittedScene& fitted, const ViewState& view, const PictureOptions& options,
                         const FollowedChoice* choice = nullptr);

class KeptPaths;  // render/pictures/kept_paths.h

/// The same of the scene that they are of, with its paths where the last picture had them.
DrawList build_draw_list(KeptPaths& kept, const ViewState& view, const PictureOptions& options,
                         const FollowedChoice* choice = nullptr);

/// The frame of the picture that build_draw_list would make, without making it: for what moves the camera. Throws as it
/// does.
PictureFrame picture_frame(const FittedScene& fitted, const ViewState& view, PictureSize size, double scale = 0);
PictureFrame picture_frame(KeptPaths& kept, const ViewState& view, const PictureOptions& options);

/// What the camera of a picture has to have in it where the view gives it no target.
struct Framed {
    Camera camera;  ///< the view's
    DrawnSpace space;
    ShownPoints points;
    std::vector<Rect> panels;  ///< that cover none of it: caption, legend and map
    double margin = 0;
};
Framed framed_in(KeptPaths& kept, const ViewState& view, const PictureOptions& options,
                 const FollowedChoice* choice = nullptr);

/// The framed_camera that has all of that in the picture, of pictures with the same camera and space.
Camera common_camera(std::span<const Framed> framed, PictureSize size);

struct PictureBeside {
    std::shared_ptr<const FittedScene> fitted;
    ViewState view;
};
/// Pictures of one size side by side: those of the same direction and space are seen from one place, which has in each
/// picture what it frames. Throws as build_draw_list does.
std::vector<DrawList> build_draw_lists(std::span<const PictureBeside> pictures, const PictureOptions& options);

/// The camera of a film that goes on from such a picture: it has in it what the picture frames, of a query's steps the
/// boxes of all of them, beside panels (pixels). Of a turn about its target, from every side.
Camera film_camera(KeptPaths& kept, const ViewState& view, PictureSize size, Played played,
                   std::span<const Rect> panels = {});

/// The last choice that a view of a run shows; none if it shows none. `moves`: of the run.
std::optional<FollowedChoice> choice_in_view(const MoveSet& moves, const ViewState& view);

/// What is said of the first choice shown in one of these views that does not come out as the run says
/// (render/pictures/candidates.h); empty: all do, or the scene is no run.
std::string edited_run_warning(const FittedScene& fitted, std::span<const ViewState> views);

}  // namespace mobbscope
