/// How tight the levels of a tree are.
#pragma once

#include <mobb/tree.h>

#include <array>
#include <optional>
#include <string_view>
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

/// One of the figures by its name, for whoever writes all of them.
struct LevelColumn {
    std::string_view name;
    bool whole;  ///< counts something
    std::optional<double> (*of)(const LevelFigures&);
};
inline constexpr std::array kLevelColumns{
    LevelColumn{"level", true, [](const LevelFigures& f) -> std::optional<double> { return f.level; }},
    LevelColumn{"nodes", true, [](const LevelFigures& f) -> std::optional<double> { return f.nodes; }},
    LevelColumn{"volume", false, [](const LevelFigures& f) -> std::optional<double> { return f.volume; }},
    LevelColumn{"tightness", false, [](const LevelFigures& f) { return f.tightness; }},
};

/// Sum over samples of the volume that they sweep, m^2*s: pi*r^2*dt where they stay, pi*(r0^2 + r0*r1 + r1^2)/3*dt
/// where they run from a radius to another.
double cylinder_volume(const Clip& clip, SampleRange range);

}  // namespace mobb
