/// Where radii come from: metres, a column of a CSV, a file of ids or classes.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <variant>

namespace mobbscope {

/// Metres: the radius of people whose file has none, about half a shoulder width.
inline constexpr double kDefaultTrackRadius = 0.2;

/// A file of radii.
struct RadiusTable {
    std::string file;
    bool by_class = false;                  ///< the keys are classes, not ids
    std::map<std::string, double> radii{};  ///< metres, 0 to kMaxLength, by key
    std::optional<double> others{};         ///< of keys without a row: that of the row *

    /// Throws std::invalid_argument if there is none for the key.
    double of(const std::string& key) const;
};

/// Lines of a key and a radius in metres after a header `id,radius` or `class,radius`. Throws InputError.
RadiusTable read_radii(const std::filesystem::path& file);

/// The column of a CSV that holds the radii, in the file's unit.
struct RadiusColumn {
    std::string name;
    friend bool operator==(const RadiusColumn&, const RadiusColumn&) = default;
};

/// Metres of every sample, a column, or a file, which is shared.
using Radius = std::variant<double, RadiusColumn, std::shared_ptr<const RadiusTable>>;

/// "0.3" metres, "radii.csv" a file, which is read, "width" a column. Throws std::invalid_argument for what is none of
/// them, and what read_radii throws.
Radius radius_from_text(std::string_view text);

/// As radius_from_text takes it.
std::string radius_text(const Radius& radius);

/// The metres of a clip whose radius is not in a column: those given, or the file's for an id or a class (empty: it has
/// none). Throws std::invalid_argument if the file has none, or for a column.
double metres_of(const Radius& radius, const std::string& id, const std::string& label);

}  // namespace mobbscope
