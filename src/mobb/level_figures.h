/// How tight the levels of a tree are.
#pragma once

#include <mobb/tree.h>

#include <optional>
#include <vector>

namespace mobb {

/// How well one level bounds its clip. The figures cover the level's nodes and the leaves above it: always the whole
/// clip.
struct LevelFigures {
    int level = 0;
    int nodes = 0;
    double volume = 0;  ///< of the boxes, m^2*s
    std::optional<double>
        tightness;  ///< volume of the cylinders / volume of the boxes; none where the boxes have no volume
};
std::vector<LevelFigures> level_figures(const Tree& tree);

/// Sum over the samples of pi*r^2*dt, m^2*s.
double cylinder_volume(const Clip& clip);

}  // namespace mobb
