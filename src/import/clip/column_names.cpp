#include <base/text.h>
#include <import/clip/column_names.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <iterator>
#include <numbers>
#include <span>
#include <vector>

namespace mobbscope {

namespace {

constexpr std::array<std::string_view, std::size(kColumns)> kColumnNames{
    "id", "t", "frame", "x", "y", "r", "class", "lost", "active", "length", "width", "heading", "z", "floor"};

constexpr double kFoot = 0.3048, kInch = 0.0254;  // metres

struct Unit {
    std::string_view word;
    double size;
};
constexpr Unit kLengths[] = {
    {"m", 1},      {"meter", 1},          {"metre", 1},          {"meters", 1},          {"metres", 1},
    {"km", 1000},  {"kilometer", 1000},   {"kilometre", 1000},   {"kilometers", 1000},   {"kilometres", 1000},
    {"cm", 0.01},  {"centimeter", 0.01},  {"centimetre", 0.01},  {"centimeters", 0.01},  {"centimetres", 0.01},
    {"mm", 0.001}, {"millimeter", 0.001}, {"millimetre", 0.001}, {"millimeters", 0.001}, {"millimetres", 0.001},
    {"ft", kFoot}, {"foot", kFoot},       {"feet", kFoot},       {"inch", kInch},        {"inches", kInch},
    {"in", kInch}};
constexpr Unit kTimes[] = {{"s", 1},       {"sec", 1},      {"second", 1},          {"seconds", 1},
                           {"ms", 0.001},  {"msec", 0.001}, {"millisecond", 0.001}, {"milliseconds", 0.001},
                           {"us", 1e-6},   {"usec", 1e-6},  {"microsecond", 1e-6},  {"microseconds", 1e-6},
                           {"ns", 1e-9},   {"nsec", 1e-9},  {"nanosecond", 1e-9},   {"nanoseconds", 1e-9},
                           {"min", 60},    {"minute", 60},  {"minutes", 60},        {"h", 3600},
                           {"hour", 3600}, {"hours", 3600}};
constexpr double kRadian = 180 / std::numbers::pi;  // degrees
constexpr Unit kAngles[] = {{"deg", 1},       {"degree", 1},       {"degrees", 1},      {"\u00b0", 1},
                            {"rad", kRadian}, {"radian", kRadian}, {"radians", kRadian}};

std::span<const Unit> units_of(Column column) {
    switch (column) {
        case Column::t:
            return kTimes;
        case Column::x:
        case Column::y:
        case Column::r:
        case Column::length:
        case Column::width:
        case Column::z:
            return kLengths;
        case Column::heading:
            return kAngles;
        default:
            return {};
    }
}

std::optional<double> size_of(std::span<const Unit> units, std::string_view word) {
    const auto at = std::ranges::find(units, word, &Unit::word);
    return at == units.end() ? std::nullopt : std::optional(at->size);
}

/// Names of one column, as PlainName::word. "timesteptime", "personx" and "vehiclex" are SUMO's, "globaltime" and
/// "localx" NGSIM's, "particle" trackpy's, "simsec" and "coordcentx" VISSIM's, "rosbagtimestamp" of ROS, "prsrx"
/// EuRoC's.
struct Aliases {
    Column column;
    std::vector<std::string_view> words;
    bool is_weak = false;
    std::string_view unit{};  ///< of its values, where the words imply one
    double share = 1;         ///< see KnownColumn
};

const std::vector<Aliases>& aliases() {
    static const std::vector<Aliases> table{
        {Column::id,
         {"id", "trackid", "trackno", "tracknumber", "trackingid", "agentid", "pedid", "pedestrianid", "personid",
          "persid", "vehicleid", "vehid", "objectid", "objid", "particle"}},
        {Column::id,
         {"track", "trajid", "trajectoryid", "agent", "ped", "pedestrian", "person", "entityid", "humanid", "bodyid",
          "playerid", "userid", "occupant", "occupantid", "uid", "pid"},
         true},
        {Column::t, {"t", "time", "seconds", "secs", "sec", "simtime", "timesteptime", "simsec"}},
        {Column::t, {"globaltime"}, false, "ms"},
        {Column::t, {"elapsedtime", "timestamp", "datetime", "rosbagtimestamp"}, true},
        {Column::t, {"milliseconds"}, true, "ms"},
        {Column::frame,
         {"frame", "fr", "frameid", "frameno", "framenr", "framenum", "framenumber", "frameindex", "frameidx"}},
        {Column::frame, {"timestep", "step", "tick"}, true},
        {Column::x,
         {"x", "cx", "xcenter", "xcentre", "centerx", "centrex", "posx", "xpos", "positionx", "xposition", "coordx",
          "xcoord", "xcoordinate"}},
        {Column::x, {"localx"}, false, "ft"},
        {Column::x,
         {"easting", "utmx", "xutm", "worldx", "xworld", "personx", "vehiclex", "coordcentx", "coordfrontx", "prsrx"},
         true},
        {Column::y,
         {"y", "cy", "ycenter", "ycentre", "centery", "centrey", "posy", "ypos", "positiony", "yposition", "coordy",
          "ycoord", "ycoordinate"}},
        {Column::y, {"localy"}, false, "ft"},
        {Column::y,
         {"northing", "utmy", "yutm", "worldy", "yworld", "persony", "vehicley", "coordcenty", "coordfronty", "prsry"},
         true},
        {Column::r, {"r", "radius"}},
        {Column::r, {"diameter"}, true, "", 0.5},
        {Column::label, {"class", "label", "type", "agenttype", "objecttype", "vehicletype", "persontype", "category"}},
        {Column::length, {"length", "vehiclelength", "objectlength", "bboxlength", "boxlength"}},
        {Column::length, {"vlength"}, false, "ft"},
        {Column::length, {"l"}, true},
        {Column::width, {"width", "vehiclewidth", "objectwidth", "bboxwidth", "boxwidth"}},
        {Column::width, {"vwidth"}, false, "ft"},
        {Column::width, {"w"}, true},
        {Column::heading, {"heading", "psi", "yaw", "theta", "orientation", "headingangle", "yawangle", "facingangle"}},
        {Column::heading, {"angle", "anglemotion", "direction"}, true},
        {Column::z,
         {"z", "posz", "zpos", "positionz", "zposition", "zcenter", "zcentre", "worldz", "coordz", "zcoord"}},
        {Column::z, {"altitude", "elevation"}, true},
        {Column::floor, {"floor", "storey", "story", "level", "floorid", "floornumber", "levelid", "storeyid"}},
        {Column::lost, {"lost"}},
        {Column::active, {"active"}}};
    return table;
}

/// Where what stands in brackets at the end begins, which a sentence may have lost; npos: there is nothing.
std::size_t bracket_of(std::string_view text) {
    const std::size_t closed = text.find_first_of("])");
    return closed == std::string_view::npos || closed + 1 == text.size() ? text.find_first_of("[(")
                                                                         : std::string_view::npos;
}

}  // namespace

std::string_view name(Column column) { return kColumnNames[static_cast<std::size_t>(column)]; }

std::optional<Column> column_from_name(std::string_view name) { return enumerator_named<Column>(kColumnNames, name); }

std::optional<double> metres_of_unit(std::string_view word) {
    return word == "in" ? std::nullopt : size_of(kLengths, word);  // it is said of other things
}

bool is_unit_of_angles(std::string_view word) { return size_of(kAngles, word).has_value(); }

PlainName plain_name(std::string_view name) {
    std::string text = lower(trimmed(name));
    PlainName out;
    // "%time", "#timestamp" and "$VEHICLE:SIMSEC" begin a header.
    if (text.starts_with('$')) text.erase(0, text.find(':') + 1);
    text.erase(0, std::min(text.find_first_not_of("%#"), text.size()));
    // "x/m", "x [m]", "x (m)" and "x_m"; but "x_max", "_m" alone and "/odom/x" are names.
    std::size_t mark = bracket_of(text);
    if (mark == std::string::npos && std::ranges::count(text, '/') == 1) mark = text.find('/');
    std::size_t unit = mark;
    if (unit == std::string::npos) unit = text.rfind('_');
    if (unit != std::string::npos && unit > 0) {
        std::string word = text.substr(unit + 1);
        if (!word.empty() && (word.back() == ']' || word.back() == ')')) word.pop_back();
        // "x_min" is the least x.
        const bool is_time = word != "min" && word != "h" && size_of(kTimes, word);
        if (mark != std::string::npos || metres_of_unit(word) || is_time || is_unit_of_angles(word)) {
            out.unit = trimmed(word);
            text.resize(unit);
        }
    }
    // A name in quotes may go over lines.
    std::ranges::copy_if(text, std::back_inserter(out.word),
                         [](char c) { return std::string_view("_-./ \t\r\n").find(c) == std::string_view::npos; });
    return out;
}

char pose_axis(std::string_view name) {
    std::string text = lower(trimmed(name.substr(0, bracket_of(trimmed(name)))));
    std::ranges::replace_if(
        text, [](char c) { return c == '_' || c == '/'; }, '.');
    const bool is_place = text.ends_with("position.x") || text.ends_with("position.y") || text.ends_with("position.z");
    return is_place || (text.size() == 8 && text.starts_with("p.rs.r.")) ? text.back() : '\0';
}

std::optional<KnownColumn> known_column(std::string_view name) {
    const PlainName plain = plain_name(name);
    const auto find = [](std::string_view word) {
        return std::ranges::find_if(
            aliases(), [&](const Aliases& of) { return std::ranges::find(of.words, word) != of.words.end(); });
    };
    auto alias = find(plain.word);
    // "pose.pose.position.x", of ROS.
    const bool is_pose = alias == aliases().end() && pose_axis(name) != 0;
    if (is_pose) alias = find(std::string_view(&plain.word.back(), 1));
    if (alias == aliases().end()) return std::nullopt;
    KnownColumn out{alias->column};
    const std::string_view unit = plain.unit.empty() ? alias->unit : std::string_view(plain.unit);
    out.is_weak = alias->is_weak || is_pose;
    out.share = alias->share;
    if (unit.empty()) return out;
    const std::optional<double> scale = size_of(units_of(out.column), unit);
    // A length in seconds is something else.
    if (!scale) return std::nullopt;
    out.scale = *scale;
    out.says_unit = true;
    return out;
}

}  // namespace mobbscope
