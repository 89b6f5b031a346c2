#include <base/text.h>
#include <import/clip/column_names.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <iterator>
#include <span>

namespace mobbscope {

namespace {

constexpr std::array<std::string_view, std::size(kColumns)> kColumnNames{"id", "t", "frame", "x", "y", "r"};

constexpr double kFoot = 0.3048;  // metres

struct Unit {
    std::string_view word;
    double size;
};
constexpr Unit kLengths[] = {
    {"m", 1},      {"meter", 1},          {"metre", 1},          {"meters", 1},          {"metres", 1},
    {"cm", 0.01},  {"centimeter", 0.01},  {"centimetre", 0.01},  {"centimeters", 0.01},  {"centimetres", 0.01},
    {"mm", 0.001}, {"millimeter", 0.001}, {"millimetre", 0.001}, {"millimeters", 0.001}, {"millimetres", 0.001},
    {"ft", kFoot}, {"foot", kFoot},       {"feet", kFoot}};
constexpr Unit kTimes[] = {{"s", 1},      {"sec", 1},      {"second", 1},          {"seconds", 1},
                           {"ms", 0.001}, {"msec", 0.001}, {"millisecond", 0.001}, {"milliseconds", 0.001}};

std::optional<double> size_of(std::span<const Unit> units, std::string_view word) {
    const auto at = std::ranges::find(units, word, &Unit::word);
    return at == units.end() ? std::nullopt : std::optional(at->size);
}

struct Alias {
    constexpr Alias(std::string_view word_, Column column_, std::string_view unit_ = {}, bool is_weak_ = false)
        : word(word_), unit(unit_), column(column_), is_weak(is_weak_) {}

    std::string_view word;
    std::string_view unit;  ///< of its values, where the word implies one
    Column column;
    bool is_weak;
};

/// As PlainName::word.
constexpr Alias kAliases[] = {
    {"id", Column::id},
    {"track", Column::id, "", true},
    {"trackid", Column::id},
    {"trackno", Column::id},
    {"tracknumber", Column::id},
    {"trackingid", Column::id},
    {"trajid", Column::id, "", true},
    {"trajectoryid", Column::id, "", true},
    {"agent", Column::id, "", true},
    {"agentid", Column::id},
    {"ped", Column::id, "", true},
    {"pedid", Column::id},
    {"pedestrian", Column::id, "", true},
    {"pedestrianid", Column::id},
    {"person", Column::id, "", true},
    {"personid", Column::id},
    {"persid", Column::id},
    {"vehicleid", Column::id},
    {"vehid", Column::id},
    {"objectid", Column::id},
    {"objid", Column::id},
    {"entityid", Column::id, "", true},
    {"humanid", Column::id, "", true},
    {"bodyid", Column::id, "", true},
    {"playerid", Column::id, "", true},
    {"userid", Column::id, "", true},
    {"occupant", Column::id, "", true},
    {"occupantid", Column::id, "", true},
    {"uid", Column::id, "", true},
    {"pid", Column::id, "", true},
    {"particle", Column::id},  // trackpy
    {"t", Column::t},
    {"time", Column::t},
    {"seconds", Column::t},
    {"secs", Column::t},
    {"sec", Column::t},
    {"milliseconds", Column::t, "ms", true},
    {"simtime", Column::t},
    {"elapsedtime", Column::t, "", true},
    {"timesteptime", Column::t},  // SUMO
    {"timestamp", Column::t, "", true},
    {"globaltime", Column::t, "ms"},  // NGSIM
    {"frame", Column::frame},
    {"fr", Column::frame},
    {"frameid", Column::frame},
    {"frameno", Column::frame},
    {"framenr", Column::frame},
    {"framenum", Column::frame},
    {"framenumber", Column::frame},
    {"frameindex", Column::frame},
    {"frameidx", Column::frame},
    {"timestep", Column::frame, "", true},
    {"step", Column::frame, "", true},
    {"tick", Column::frame, "", true},
    {"x", Column::x},
    {"y", Column::y},
    {"cx", Column::x},
    {"cy", Column::y},
    {"xcenter", Column::x},
    {"ycenter", Column::y},
    {"xcentre", Column::x},
    {"ycentre", Column::y},
    {"centerx", Column::x},
    {"centery", Column::y},
    {"centrex", Column::x},
    {"centrey", Column::y},
    {"posx", Column::x},
    {"posy", Column::y},
    {"xpos", Column::x},
    {"ypos", Column::y},
    {"positionx", Column::x},
    {"positiony", Column::y},
    {"xposition", Column::x},
    {"yposition", Column::y},
    {"coordx", Column::x},
    {"coordy", Column::y},
    {"xcoord", Column::x},
    {"ycoord", Column::y},
    {"xcoordinate", Column::x},
    {"ycoordinate", Column::y},
    {"easting", Column::x, "", true},
    {"northing", Column::y, "", true},
    {"worldx", Column::x, "", true},
    {"worldy", Column::y, "", true},
    {"xworld", Column::x, "", true},
    {"yworld", Column::y, "", true},
    {"personx", Column::x, "", true},  // SUMO, as are those of vehicles
    {"persony", Column::y, "", true},
    {"vehiclex", Column::x, "", true},
    {"vehicley", Column::y, "", true},
    {"localx", Column::x, "ft"},  // NGSIM
    {"localy", Column::y, "ft"},
    {"r", Column::r},
    {"radius", Column::r},
};

}  // namespace

std::string_view name(Column column) { return kColumnNames[static_cast<std::size_t>(column)]; }

std::optional<Column> column_from_name(std::string_view name) { return enumerator_named<Column>(kColumnNames, name); }

std::optional<double> metres_of_unit(std::string_view word) { return size_of(kLengths, word); }

PlainName plain_name(std::string_view name) {
    std::string text = lower(trimmed(name));
    PlainName out;
    // "x/m", "x [m]", "x (m)" and "x_m"; but "x_max", and "_m" alone, are names.
    const std::size_t mark = text.find_first_of("/[(");
    std::size_t unit = mark;
    if (unit == std::string::npos) unit = text.rfind('_');
    if (unit != std::string::npos && unit > 0) {
        std::string word = text.substr(unit + 1);
        if (!word.empty() && (word.back() == ']' || word.back() == ')')) word.pop_back();
        if (mark != std::string::npos || metres_of_unit(word) || size_of(kTimes, word)) {
            out.unit = trimmed(word);
            text.resize(unit);
        }
    }
    std::ranges::copy_if(text, std::back_inserter(out.word),
                         [](char c) { return c != '_' && c != '-' && c != '.' && c != ' '; });
    return out;
}

std::optional<KnownColumn> known_column(std::string_view name) {
    const PlainName plain = plain_name(name);
    const auto alias = std::ranges::find(kAliases, plain.word, &Alias::word);
    if (alias == std::end(kAliases)) return std::nullopt;
    KnownColumn out{alias->column};
    const std::string_view unit = plain.unit.empty() ? alias->unit : std::string_view(plain.unit);
    out.is_weak = alias->is_weak;
    if (unit.empty()) return out;
    const bool counts = out.column == Column::id || out.column == Column::frame;
    const std::optional<double> scale = counts                    ? std::nullopt
                                        : out.column == Column::t ? size_of(kTimes, unit)
                                                                  : metres_of_unit(unit);
    // A length in seconds is something else.
    if (!scale) return std::nullopt;
    out.scale = *scale;
    out.says_unit = true;
    return out;
}

}  // namespace mobbscope
