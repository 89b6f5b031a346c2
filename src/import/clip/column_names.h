/// What columns of tables are called: by the many names that they go by, with units in them.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace mobbscope {

/// `label`: the class of who is tracked; `lost` and `active`: whether a row does not count, or does; `length`, `width`
/// and `heading`: of a body; `z` and `floor`: what keeps people apart.
enum class Column : std::uint8_t { id, t, frame, x, y, r, label, lost, active, length, width, heading, z, floor };
inline constexpr Column kColumns[] = {Column::id,    Column::t,       Column::frame, Column::x,      Column::y,
                                      Column::r,     Column::label,   Column::lost,  Column::active, Column::length,
                                      Column::width, Column::heading, Column::z,     Column::floor};

/// "id", "t", ...; of `label` "class".
std::string_view name(Column column);
std::optional<Column> column_from_name(std::string_view name);

/// A name in small letters without what joins words ("trackid" of "Track_ID"), and the unit in it ("cm" of "x/cm",
/// "x [cm]" and "x_cm"; empty: none).
struct PlainName {
    std::string word;
    std::string unit{};
};
PlainName plain_name(std::string_view name);

/// What a column stands for by its name alone.
struct KnownColumn {
    Column column;
    double scale = 1;        ///< seconds, metres or degrees for each of its units; 1 of frames and ids
    double share = 1;        ///< of its numbers what counts: half of a diameter
    bool says_unit = false;  ///< the name tells the unit
    bool is_weak = false;    ///< the name may mean something else: where another one stands for the same, that is meant
};

/// 'x' of "pose.position.x" and of "p_RS_R_x [m]", where robots log their places; 0 of other names.
char pose_axis(std::string_view name);

/// Nothing for a name that stands for none of them.
std::optional<KnownColumn> known_column(std::string_view name);

/// Metres of a unit of length in a table or a remark: "m", "centimetres", "ft"; nothing for other words.
std::optional<double> metres_of_unit(std::string_view word);
/// "deg", "rad", ...
bool is_unit_of_angles(std::string_view word);

}  // namespace mobbscope
