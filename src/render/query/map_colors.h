/// What the cells of a placement map look like.
#pragma once

#include <explain/placement_map.h>
#include <render/drawlist/palette.h>
#include <render/image/image.h>
#include <render/image/rect.h>

#include <glm/vec2.hpp>

#include <vector>

namespace mobbscope {

/// The values that the ends of the colours stand for; from < to.
struct MapColors {
    double from = 0, to = 1;
    friend bool operator==(const MapColors&, const MapColors&) = default;
};

/// From the least to the largest value that has a colour of its own: of the clearance from 0 on.
MapColors usual_colors(const PlacementMap& map);

/// What is near stands out most, and so do many tests.
Rgba value_color(MapShow show, double value, const MapColors& colors, const Palette& palette);
/// Cells that collide have the hit's colour, but for those of a map of tests.
Rgba cell_color(const PlacementMap& map, int x, int y, const MapColors& colors, const Palette& palette);

/// A pixel for each cell, the upper row first.
Image map_image(const PlacementMap& map, const MapColors& colors, const Palette& palette);

/// A line in pixels.
struct PixelLine {
    glm::vec2 from, to;
};
/// Where an offset is in a map that fills `area`.
glm::vec2 map_pixel(const MapOrder& order, const Rect& area, glm::dvec2 offset);
/// Lines upwards to the right over the cells that collide, so many pixels apart: they are told apart without colour.
std::vector<PixelLine> hit_hatch(const PlacementMap& map, const Rect& area, float apart);
/// Of the line between cells that collide and others, which is seen on all colours.
Rgba boundary_color(const Palette& palette);
Rgba hatch_color(MapShow show, const Palette& palette);

/// How many cells that do not collide have values in each of `bars` equal parts of the range.
std::vector<std::size_t> value_counts(const PlacementMap& map, const MapColors& range, int bars);

}  // namespace mobbscope
