/// The paths that a picture is about.
#pragma once

#include <render/palette.h>
#include <scene/fitted_scene.h>

#include <string>
#include <vector>

namespace mobbscope {

/// A path that is drawn: who, with which tree, in which colour. Refers to the fitted scene.
struct Subject {
    mobb::PlacedTree placed;
    std::string name;
    std::string label;  ///< the name as pictures say it: short enough to leave room for what is said of it
    Rgba color;
    int index = 0;                       ///< in DrawList::participants
    const Skeleton* skeleton = nullptr;  ///< of the clip; null: none

    const mobb::PlacedClip& clip() const { return placed.placed_clip(); }
    double begin() const { return clip().time(0); }
    double end() const { return clip().time(clip().count()); }
};

/// A name of at most `most` characters (>= 5): its beginning, an ellipsis and its end.
std::string shortened(const std::string& name, int most);

/// The scene's participants; with a query in the view, its two sides. Throws std::invalid_argument if the scene has no
/// such query.
std::vector<Subject> subjects(const FittedScene& fitted, const ViewState& view);

}  // namespace mobbscope
