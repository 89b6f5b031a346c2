#include <base/text.h>
#include <explain/level_columns.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

namespace mobbscope {

namespace {

struct LevelUnit {
    std::string_view column;
    const char* behind = "";   ///< on a terminal
    const char* written = "";  ///< ... and in words
    double in_unit = 1;        ///< the figure times this is what is shown
};

constexpr std::array kLevelUnits{LevelUnit{"volume", " m^2*s", " m\u00B2\u00B7s"},
                                 LevelUnit{"tightness", " %", " %", 100}};

LevelUnit unit_of_column(const mobb::LevelColumn& column) {
    const auto* const at = std::ranges::find(kLevelUnits, column.name, &LevelUnit::column);
    return at == kLevelUnits.end() ? LevelUnit{column.name} : *at;
}

}  // namespace

std::string level_unit(const mobb::LevelColumn& column) { return unit_of_column(column).behind; }

std::string level_text(const mobb::LevelColumn& column, const mobb::LevelFigures& figures) {
    const std::optional<double> value = column.of(figures);
    if (!value) return "-";
    return column.whole ? std::to_string(static_cast<std::int64_t>(*value))
                        : brief(*value * unit_of_column(column).in_unit);
}

std::string level_words(const mobb::LevelColumn& column, const mobb::LevelFigures& figures) {
    const std::string name = std::string(column.name) + ' ';
    const std::optional<double> value = column.of(figures);
    if (!value) return name + '-';
    const LevelUnit unit = unit_of_column(column);
    return name + (column.whole ? level_text(column, figures) : figure(*value * unit.in_unit)) + unit.written;
}

}  // namespace mobbscope
