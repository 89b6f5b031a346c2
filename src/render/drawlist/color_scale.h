/// From figures to colours, as a colour bar shows it. What is worse stands out more from the theme's ground: the most
/// of a figure, or the least of one of which less is worse.
#pragma once

#include <render/drawlist/palette.h>
#include <scene/node_field.h>

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace mobbscope {

/// What a figure is called, and how its values are spread over the colours.
struct ColoredFigure {
    std::string title;           ///< "empty space"
    std::string unit{};          ///< "%": values are parts, 0 to 1, and are shown 100 times as large
    bool spans_decades = false;  ///< a few values are many times as large as most: the scale may be logarithmic
    bool counts = false;         ///< whole numbers from 0 on: on a logarithmic scale one more than the value counts
    bool low_is_worse = false;   ///< the least stands out most
    bool whole_range = false;    ///< no value is left out at the ends, however few have it
    bool from_zero = false;      ///< the colours begin at 0, however large the least value is
    friend bool operator==(const ColoredFigure&, const ColoredFigure&) = default;
};

ColoredFigure colored_figure(const NodeFieldInfo& field);

/// The figure that boxes are coloured by; null: their agents' colours.
const NodeFieldInfo* color_figure(ColorBy color_by);

struct ColorScale {
    ColoredFigure figure;
    double least = 0, most = 0;  ///< at the ends; least <= most
    bool known = false;          ///< there is a value at all
    bool chosen = false;         ///< somebody has chosen the ends: what lies outside them steps back
    bool logarithmic = false;
    bool has_less = false, has_more = false;  ///< values outside have the colour of the next end
    friend bool operator==(const ColorScale&, const ColorScale&) = default;

    /// How far from the end of the least it is, 0 to 1.
    float share(double value) const;
    /// The value there: as `share` has it, backwards.
    double value_at(float share) const;
    bool outside(double value) const { return value < least || value > most; }
    /// Of what has no value (NaN) a neutral one.
    Rgba color(double value, const Palette& palette) const;
    /// At a place of the bar.
    Rgba color_at(float share, const Palette& palette) const;

    /// "empty space, m²·s (log)"; and what stands at the ends: "<0.5", "12 %".
    std::string title() const;
    std::string least_text() const;
    std::string most_text() const;
    /// A value with its unit.
    std::string text(double value) const;
};

/// Spreads the colours over the values; NaN is none. `chosen`: the ends that somebody wants, in the unit that is shown
/// (per cent of parts). Without it they are the least and the largest value, but of many values one in fifty at either
/// end is left out, so that a few that stand alone do not take all colours; and the ends are apart by at least a
/// twentieth of what is there, so that values that are nearly equal look so. A figure's may begin at 0. The scale is
/// logarithmic where the figure's may be, and its ends are a decade apart.
ColorScale color_scale(const ColoredFigure& figure, std::span<const double> values,
                       const std::optional<ValueRange>& chosen = {});

/// How many values there are in each of `bars` equal parts of the scale; those outside are in the outermost.
std::vector<std::size_t> value_counts(const ColorScale& scale, std::span<const double> values, int bars);

}  // namespace mobbscope
