/// What films, and numbered pictures, go through, and how long a film is.
#pragma once

#include <render/drawlist/picture_options.h>
#include <scene/fitted_scene.h>
#include <scene/view_state.h>

#include <cstddef>
#include <string>

namespace mobbscope {

/// Whether --play goes through the steps of the view's query; else through the motion.
inline bool plays_steps(const ViewState& view) { return view.query && view.show == Show::space_time; }

enum class Played {
    motion,
    steps,  ///< of the view's query
    turn,   ///< once around the scene
};
/// `turns`: once around the scene; else what --play goes through.
Played played_of(const ViewState& view, bool turns);

/// The most pictures that are made at once.
inline constexpr int kMostPictures = 100'000;

/// The pictures of the motion of who is in a view.
struct MotionPictures {
    double begin = 0;     ///< global seconds, of the first
    double pictures = 0;  ///< a whole number, maybe beyond any int
};
/// `rate`: pictures a second. Throws std::invalid_argument if the scene has no such query.
MotionPictures motion_pictures(const FittedScene& fitted, const ViewState& view, double rate);

/// How a film shows its pictures.
struct FilmPace {
    double rate = 0;       ///< pictures a second
    std::size_t held = 0;  ///< how many more times the last is shown: of a query's steps that is the answer, to be read
};
/// `rate`: pictures a second; 0: the usual, which is lower for steps so that the sentence of each can be read.
FilmPace film_pace(Played played, double rate);

/// Films have even sides: the next larger, or smaller where that is too large. `asked`: as `check` allows it.
PictureSize film_size(const PictureOptions& asked);

/// What a film of so many pictures is, with the last one held: "8.4 s: 210 pictures of 1280x720 at 25 a second".
std::string film_text(std::size_t pictures, const FilmPace& pace, PictureSize size);

}  // namespace mobbscope
