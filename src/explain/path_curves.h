/// What a path does over time, as curves: radius, speed, turning, and what its samples cost.
#pragma once

#include <explain/value_columns.h>
#include <mobb/tree.h>
#include <scene/view_state.h>

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

namespace mobbscope {

enum class CurveKind { radius, speed, turning, cost };

struct CurveInfo {
    CurveKind kind;
    std::string_view name;   ///< for scripts
    std::string_view title;  ///< "Turning"
    std::string_view unit;
    std::string_view doc;    ///< one sentence
    bool from_zero = false;  ///< a chart of it begins at 0
    int decimals = 3;        ///< that people read
};

inline constexpr std::size_t kCurveCount = 4;
/// In the order of the enumeration.
const std::array<CurveInfo, kCurveCount>& curve_infos();

/// Turning is measured from the way of so many seconds before a sample to that of as many after it: between single
/// samples it would be that of their noise.
inline constexpr double kTurnWindow = 0.25;
/// m/s: whoever is slower has no direction to turn from.
inline constexpr double kLeastTurnSpeed = 0.1;

/// A value for each sample; NaN: it has none.
struct PathCurve {
    std::vector<double> values;
    bool runs = false;  ///< to the next sample's; else each holds until that

    bool has(int sample) const;
    /// From a sample (at time 0) to the next (at 1). Requires has(sample).
    double at(int sample, double s) const;
};

PathCurve radius_curve(const mobb::Clip& clip);
/// m/s from a sample to the next. The last sample has none.
PathCurve speed_curve(const mobb::Clip& clip);
/// Degrees a second, to the left above 0. The first and the last sample have none, nor has any at less than
/// kLeastTurnSpeed.
PathCurve turn_curve(const mobb::Clip& clip);
/// Per cent of all box tests of a query for each second of the node that holds a sample: of the node on the last of the
/// levels, or the leaf above it. `shares`: by node, as TreeCost has them; empty: no sample has any.
PathCurve cost_curve(const mobb::Tree& tree, std::span<const double> shares, const LevelRange& levels);

/// [t0, t1) of a curve in so many columns. t1 > t0, columns >= 1.
std::vector<ValueColumn> columns_of(const PathCurve& curve, const mobb::PlacedClip& clip, double t0, double t1,
                                    int columns);

/// The sample that holds at a global time, and the value then; none: the path is not there, or has none.
std::optional<std::pair<int, double>> value_at(const PathCurve& curve, const mobb::PlacedClip& clip, double time);

}  // namespace mobbscope
