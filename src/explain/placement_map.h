/// One query asked at many placements of its B: where could B stand?
#pragma once

#include <scene/fitted_scene.h>

#include <glm/vec2.hpp>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace mobbscope {

/// What is added to B's placement: metres, degrees, seconds.
enum class MapAxis { dx, dy, dheading, dstart };
inline constexpr std::size_t kMapAxes = 4;

/// As in files and on the command line.
std::string_view name(MapAxis axis);
std::optional<MapAxis> map_axis_from_name(std::string_view name);
std::span<const std::string_view> map_axis_names();
/// "m", "°" or "s".
std::string_view axis_unit(MapAxis axis);

/// What a cell says: whether the two collide (1 or 0); the least clearance over time in metres, below 0 exactly where
/// they collide; or the tests of boxes and the measured pairs of samples that the query takes, added up, without those
/// of times.
enum class MapShow { answer, clearance, tests };
std::string_view name(MapShow show);
std::optional<MapShow> map_show_from_name(std::string_view name);
std::span<const std::string_view> map_show_names();

struct MapRange {
    MapAxis axis = MapAxis::dx;
    double from = 0, to = 0;  ///< from < to

    friend bool operator==(const MapRange&, const MapRange&) = default;
};

inline constexpr int kMostMapCells = 2048;  ///< of a side
inline constexpr int kUsualMapCells = 256;

struct MapOrder {
    MapRange across{MapAxis::dx};  ///< from left to right
    MapRange up{MapAxis::dy};      ///< from below to above
    int width = kUsualMapCells, height = kUsualMapCells;
    MapShow show = MapShow::answer;
    Search search = Search::trees;  ///< whose tests are counted

    /// The middle of a cell.
    glm::dvec2 middle(int x, int y) const {
        return {across.from + (x + 0.5) / width * (across.to - across.from),
                up.from + (y + 0.5) / height * (up.to - up.from)};
    }

    friend bool operator==(const MapOrder&, const MapOrder&) = default;
};

/// Throws std::invalid_argument, saying what is allowed, if a range is not finite, empty or reversed, both are of one
/// axis, or a side has no cells or more than kMostMapCells.
void check(const MapOrder& order);
/// Likewise, and if B would stand where its clip may not be placed.
void check(const MapOrder& order, const mobb::Placement& b, const mobb::Clip& clip);

/// `b` with `by` added along the two axes.
mobb::Placement moved(const mobb::Placement& b, const MapOrder& order, glm::dvec2 by);
/// `b` where the map's two axes are at these values; what they do not change stays.
mobb::Placement placed_at(const mobb::Placement& b, const MapOrder& order, glm::dvec2 at);
/// What is added to `from` along the two axes to come to `to`.
glm::dvec2 offset_between(const mobb::Placement& from, const mobb::Placement& to, const MapOrder& order);

/// A piece of a line, offsets along the two axes.
struct MapLine {
    glm::dvec2 from, to;
};

/// Rows from the least of the second axis.
struct PlacementMap {
    MapOrder order;
    mobb::Placement reference;         ///< of B: what is added to
    int step = 0;                      ///< cells at multiples of it along both sides are known; 0: none is
    std::vector<double> values{};      ///< infinity: the two share no time, so there is no clearance
    std::vector<std::uint8_t> hits{};  ///< whether they collide
    /// Between cells that collide and cells that do not; of a whole map to a 64th of a cell.
    std::vector<MapLine> boundary{};

    /// The cell itself, or the known one that stands for it. Requires step > 0.
    std::size_t known(int x, int y) const {
        return static_cast<std::size_t>(y - y % step) * static_cast<std::size_t>(order.width) +
               static_cast<std::size_t>(x - x % step);
    }
    double value(int x, int y) const { return values[known(x, y)]; }
    bool hit(int x, int y) const { return hits[known(x, y)] != 0; }
    std::size_t hit_count() const;  ///< of all cells; of a whole map
    /// The cell of an offset, or none outside.
    std::optional<glm::ivec2> cell_at(glm::dvec2 offset) const;
};

/// What a cell of a map says, asked of one placement.
struct PlacedAnswer {
    bool hit = false;
    double value = 0;  ///< as PlacementMap::values
};
/// Of the query as it is placed. Throws std::invalid_argument where no agent may stand.
PlacedAnswer answer_at(const FittedScene& fitted, const SceneQuery& query, MapShow show, Search search = Search::trees);

/// Is told of the map when cells at multiples of its step are known: of every 8th, 4th, 2nd and all.
using MapPass = std::function<void(const PlacementMap&)>;

/// Each cell is asked once, on all processors. `progress` is told by one thread at a time; it may throw to end the
/// work. Throws as check does.
PlacementMap map_placements(const FittedScene& fitted, const SceneQuery& query, const MapOrder& order,
                            const MapPass& pass = {}, const Progress& progress = {});

/// "B moved along x, m"
std::string axis_words(MapAxis axis, const std::string& b);
/// "B moved, A stays: 23.1 % of 65,536 placements collide"
std::string map_words(const PlacementMap& map, const std::string& a, const std::string& b);
/// "they never collide, at least 0.183 m apart"
std::string placed_words(MapShow show, const PlacedAnswer& answer);
/// "dx +0.25 m, dy -1.50 m"
std::string offset_words(const MapOrder& order, glm::dvec2 offset);

/// The ranges of the two axes in which B, added to its placement, can meet A, and some room around them: of dx and dy
/// equally long.
void choose_ranges(const mobb::PlacedClip& a, const mobb::PlacedClip& b, MapOrder& order);

}  // namespace mobbscope
