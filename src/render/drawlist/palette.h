/// The colours of pictures: Okabe and Ito's for categories (they stay apart for colour-blind eyes), viridis for
/// quantities, quiet surfaces around.
#pragma once

#include <base/color.h>
#include <scene/view_state.h>

#include <cstddef>

namespace mobbscope {

struct Palette {
    Rgba background;
    Rgba grid;  ///< lines on the floor
    Rgba axis;  ///< the time axis and its ticks
    Rgba text;
    Rgba quiet_text;  ///< what is read second
    Rgba panel;       ///< behind legends and labels
    Rgba panel_border;
    Rgba accent;  ///< the time cursor
    Rgba apart_in_time;
    Rgba separated;
    Rgba overlap;
    Rgba avoidable;
    Rgba hit;
    bool dark = true;
};

const Palette& palette(Theme theme);

/// The colour of a quantity from 0 to 1, which stands out the more from the theme's ground, the larger it is: viridis,
/// brighter and brighter on a dark ground and darker and darker on a light one.
Rgba quantity_color(float quantity, const Palette& palette);

/// The colour of one of several things without an order; after seven they repeat.
Rgba category_color(std::size_t index, const Palette& palette);

/// `color` with another opacity.
Rgba with_alpha(Rgba color, float alpha);

/// From `a` (0) to `b` (1).
Rgba mix_colors(Rgba a, Rgba b, float t);

/// How far apart in lightness two opaque colours are: 1 (not at all) to 21, as WCAG counts it.
float contrast(Rgba a, Rgba b);

/// `color` with an opacity, or with the least at which it is still seen on the theme's ground.
Rgba faded(Rgba color, float strength, const Palette& palette);

/// `color` as a line that stands out from surfaces of that colour.
Rgba outlining(Rgba color, const Palette& palette);

/// `color` made readable as text on the theme's panels.
Rgba readable(Rgba color, const Palette& palette);

}  // namespace mobbscope
