#include <import/clip/column_names.h>
#include <import/clip/sampling.h>
#include <import/tracks/logs.h>
#include <mobb/clip.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

namespace mobbscope {

namespace {

constexpr const char* kRobot = "robot";  // the id of the only one
constexpr double kKittiRate = 10;        // poses a second, which the files do not say
constexpr std::size_t kTumColumns = 8, kKittiColumns = 12;
constexpr std::size_t kLookedAt = 10;  // rows that tell poses from other rows of numbers
// Of KITTI's matrix the fourth column is the place: right, down, forward.
constexpr std::size_t kRight = 3, kDown = 7, kForward = 11;

char separator_in(std::string_view line) {
    for (const char c : {';', ',', '\t'}) {
        if (line.find(c) != std::string_view::npos) return c;
    }
    return ' ';
}

/// The fields of a line; those in quotes may hold separators.
std::vector<std::string_view> fields_of(std::string_view line, char separator) {
    std::vector<std::string_view> out;
    for (bool more = true; more;) {
        const std::size_t quoted = line.starts_with('"') ? std::min(line.find('"', 1), line.size()) : 0;
        const std::size_t end = separator == ' ' ? line.find_first_of(" \t", quoted) : line.find(separator, quoted);
        std::string_view field = trimmed(line.substr(0, end));
        if (field.size() > 1 && field.front() == '"' && field.back() == '"') field = field.substr(1, field.size() - 2);
        out.push_back(field);
        more = end != std::string_view::npos;
        if (more) line.remove_prefix(end + 1);
        if (separator == ' ') line = trimmed(line);
    }
    return out;
}

/// "p_RS_R_x [m]" as "p.rs.r.x", "$VEHICLE:SIMSEC" as "simsec", "/odom/pose/pose/position/x" as
/// "odom.pose.pose.position.x".
std::string plain_header(std::string_view name) {
    std::string out = lower(name.substr(0, name.find_first_of("[(")));
    if (out.starts_with('$')) out.erase(0, out.find(':') + 1);
    std::ranges::replace(out, '_', '.');
    std::ranges::replace(out, '/', '.');
    const auto is_mark = [](char c) { return c == '#' || c == '%' || c == '.' || c == ' '; };
    out.erase(out.begin(), std::ranges::find_if_not(out, is_mark));
    return std::string(trimmed(out));
}

/// Whether a plain name is that of a place along an axis.
bool is_place(std::string_view name, char axis) {
    if (!name.ends_with(axis)) return false;
    name.remove_suffix(1);
    return name.ends_with("position.") || (name.starts_with("p.") && name.ends_with('.')) || name == "coordcent" ||
           name == "coordfront";
}

/// Which column is which, none where there is none.
struct LogColumns {
    std::optional<std::size_t> t, seconds, nanoseconds, id, x, y, both;
    double unit_of_t = 0;  ///< seconds; 0: as large as the times are

    bool has_places() const { return (x && y) || both; }
    bool has_times() const { return t || seconds; }
};

LogColumns columns_named(std::string_view header) {
    LogColumns out;
    const bool of_vissim = header.starts_with('$');
    const std::vector<std::string_view> names = fields_of(header, separator_in(header));
    for (std::size_t i = 0; i < names.size(); ++i) {
        const std::string name = plain_header(names[i]);
        // Of several places the first counts, as of a path's.
        const auto take = [i](std::optional<std::size_t>& column, bool is) {
            if (is && !column) column = i;
        };
        take(out.x, is_place(name, 'x'));
        take(out.y, is_place(name, 'y'));
        take(out.both, name == "coordfront" || name == "coordcent");
        const std::optional<KnownColumn> known = known_column(names[i]);
        take(out.id, of_vissim ? name == "no" : known && known->column == Column::id && !known->is_weak);
        take(out.seconds, name.ends_with("stamp.secs") || name.ends_with("stamp.sec"));
        take(out.nanoseconds, name.ends_with("stamp.nsecs") || name.ends_with("stamp.nanosec"));
        const bool is_time =
            name == "time" || name == "timestamp" || name == "t" || name == "rosbagtimestamp" || name == "simsec";
        if (is_time && names[i].find("[ns]") != std::string_view::npos) out.unit_of_t = 1e-9;
        take(out.t, is_time);
    }
    if (out.x && out.y) out.both.reset();
    return out;
}

/// Unix times tell by their size what they count.
double unit_of_time(double value) { return value > 1e17 ? 1e-9 : value > 1e14 ? 1e-6 : value > 1e11 ? 1e-3 : 1; }

/// Rows of numbers between blanks, as many as are looked at.
std::vector<std::vector<double>> first_rows(std::string_view text) {
    std::vector<std::vector<double>> out;
    for (std::string_view line = take_row(text); !line.empty() && out.size() < kLookedAt; line = take_row(text)) {
        out.emplace_back();
        for (const std::string_view field : fields_of(line, ' ')) {
            const std::optional<double> value = parse_double(field);
            if (!value || out.back().size() > kKittiColumns) return {};
            out.back().push_back(*value);
        }
        // The last one may be cut off.
        if (out.size() > 1 && out.back().size() != out.front().size()) {
            if (!text.empty()) return {};
            out.pop_back();
        }
    }
    return out;
}

/// Times that rise, and quaternions.
bool is_tum(const std::vector<std::vector<double>>& rows) {
    constexpr double kOffUnit = 0.02;
    double last = -INFINITY;
    for (const std::vector<double>& row : rows) {
        if (row.size() != kTumColumns) return false;
        const double length = std::hypot(std::hypot(row[4], row[5]), std::hypot(row[6], row[7]));
        if (std::abs(length - 1) > kOffUnit || row[0] <= last) return false;
        last = row[0];
    }
    return !rows.empty();
}

/// Rotations, whose rows have length 1.
bool is_kitti(const std::vector<std::vector<double>>& rows) {
    constexpr double kOffUnit = 0.02;
    return !rows.empty() && std::ranges::all_of(rows, [](const std::vector<double>& row) {
        if (row.size() != kKittiColumns) return false;
        for (const std::size_t i : {0u, 4u, 8u}) {
            if (std::abs(std::hypot(row[i], row[i + 1], row[i + 2]) - 1) > kOffUnit) return false;
        }
        return true;
    });
}

/// The line that names the columns: of VISSIM the one that begins with "$VEHICLE:" or "$PEDESTRIAN:".
bool is_header(std::string_view line) {
    if (line.starts_with('$')) return line.find(':') != std::string_view::npos;
    const LogColumns columns = columns_named(line);
    return columns.has_places() && columns.has_times();
}

bool is_vissim(std::string_view text) {
    text = without_mark(text);
    return text.starts_with("$VISION") || text.starts_with("$VEHICLE:") || text.starts_with("$PEDESTRIAN:");
}

class LogParser {
  public:
    LogParser(std::string_view text, const std::string& file) : text_(text), lines_(text, file), tracks_(file) {}

    TrackFile parse() {
        const std::vector<std::vector<double>> rows = first_rows(without_mark(text_));
        if (is_tum(rows)) {
            columns_.t = 0;
            columns_.x = 1;
            columns_.y = 2;
            separator_ = ' ';
            count_ = kTumColumns;
        } else if (is_kitti(rows)) {
            return kitti();
        } else {
            find_header();
        }
        while (lines_.next()) {
            if (!is_comment()) read_row();
        }
        if (tracks_.empty()) lines_.fail("there is no row with a place after the header; check the columns");
        TrackFile out = tracks_.take_timed(in_milliseconds_);
        out.format = format_;
        if (without_place_ > 0)
            out.warnings.push_back(
                {counted(without_place_, "row without a place is", "rows without a place are") + " left out"});
        return out;
    }

  private:
    bool is_comment() const { return lines_.line()[0] == '#' || lines_.line()[0] == '*'; }

    void find_header() {
        while (lines_.next() && !is_header(without_mark(lines_.line()))) {
        }
        const std::string_view header = without_mark(lines_.line());
        columns_ = columns_named(header);
        separator_ = separator_in(header);
        count_ = fields_of(header, separator_).size();
        if (header.starts_with('$') && !(columns_.has_places() && columns_.has_times() && columns_.id))
            lines_.fail(
                "lacks one of SIMSEC, NO and coordinates; let VISSIM write them: CoordFront of vehicles, CoordCentX "
                "and CoordCentY of pedestrians");
        if (header.starts_with('$')) {
            format_ = "vissim";
            label_ = header.starts_with("$PEDESTRIAN") ? "pedestrian" : "vehicle";
        }
    }

    std::vector<std::string_view> row() const {
        std::vector<std::string_view> out = fields_of(lines_.line(), separator_);
        if (out.size() != count_)
            lines_.fail("has " + counted(out.size(), "value", "values") + " but there are " +
                        counted(count_, "column", "columns") + "; give every row all of them");
        return out;
    }

    double number(std::string_view field, std::size_t column, double largest) const {
        const std::optional<double> value = parse_double(field);
        if (!value)
            lines_.fail("column " + std::to_string(column + 1) + ": " + in_quotes(field) +
                        " is not a finite number; write it like 0.25");
        if (std::abs(*value) > largest)
            lines_.fail("column " + std::to_string(column + 1) + ": " + in_quotes(field) + " is beyond " +
                        format_double(largest) + "; check the row");
        return *value;
    }

    double time_of(const std::vector<std::string_view>& fields) {
        constexpr double kMostTicks = 1e19, kNanosecond = 1e-9;
        if (!columns_.t) {
            const double seconds = number(fields[*columns_.seconds], *columns_.seconds, mobb::kMaxTime);
            return seconds + (columns_.nanoseconds ? kNanosecond * number(fields[*columns_.nanoseconds],
                                                                          *columns_.nanoseconds, kMostTicks)
                                                   : 0);
        }
        const double value = number(fields[*columns_.t], *columns_.t, kMostTicks);
        if (columns_.unit_of_t == 0) columns_.unit_of_t = unit_of_time(value);
        // Dividing gives the nearest double.
        return value / std::round(1 / columns_.unit_of_t);
    }

    void read_row() {
        const std::vector<std::string_view> fields = row();
        std::string_view x, y;
        if (columns_.both) {
            const std::vector<std::string_view> place = fields_of(fields[*columns_.both], ' ');
            x = place[0];
            if (place.size() > 1) y = place[1];
        } else {
            x = fields[*columns_.x];
            y = fields[*columns_.y];
        }
        const auto is_none = [](std::string_view field) { return field.empty() || lower(field) == "nan"; };
        if (is_none(x) || is_none(y)) {
            ++without_place_;
            return;
        }
        const std::string_view id = columns_.id ? fields[*columns_.id] : std::string_view(kRobot);
        if (id.empty() || !is_utf8(id)) lines_.fail("the id is empty, or no UTF-8 text; give it a name");
        const std::size_t at_x = columns_.both ? *columns_.both : *columns_.x;
        const TrackPoint point{time_of(fields), number(x, at_x, mobb::kMaxLength),
                               number(y, columns_.both ? at_x : *columns_.y, mobb::kMaxLength), lines_.number()};
        in_milliseconds_ = in_milliseconds_ && is_in_milliseconds(point.frame);
        tracks_.add(id, point, label_);
    }

    /// The ground is right and forward of the camera; where it only goes up and down, those axes were meant otherwise.
    TrackFile kitti() {
        std::vector<std::array<double, 3>> places;
        std::vector<int> at;
        separator_ = ' ';
        count_ = kKittiColumns;
        while (lines_.next()) {
            if (is_comment()) continue;
            const std::vector<std::string_view> fields = row();
            const auto place = [&](std::size_t column) { return number(fields[column], column, mobb::kMaxLength); };
            places.push_back({place(kRight), place(kDown), place(kForward)});
            at.push_back(lines_.number());
        }
        const auto extent = [&](std::size_t axis) {
            const auto [least, most] =
                std::ranges::minmax(places, {}, [axis](const auto& place) { return place[axis]; });
            return most[axis] - least[axis];
        };
        const std::size_t up = extent(2) == 0 && extent(1) > 0 ? 2 : 1;
        for (std::size_t i = 0; i < places.size(); ++i)
            tracks_.add(kRobot, {static_cast<double>(i), places[i][0], places[i][up == 2 ? 1 : 2], at[i]}, label_);
        TrackFile out;
        out.format = format_;
        out.tracks = tracks_.take_sorted();
        out.spent = tracks_.take_spent();
        out.rate = kKittiRate;
        out.rate_assumption =
            "the poses have no times: 10 a second are assumed, as in KITTI; give dt (seconds from one to the next) if "
            "that is wrong";
        out.warnings.push_back(
            {std::string("the ground is taken to be ") +
             (up == 2 ? "x and y, as the third axis never changes" : "x and z of the camera, whose y points down")});
        return out;
    }

    std::string_view text_;
    TextLines lines_;
    TrackCollector tracks_;
    LogColumns columns_;
    char separator_ = ' ';
    std::size_t count_ = 0;  ///< fields of a row
    std::string format_ = "poses";
    std::string_view label_ = kRobot;
    bool in_milliseconds_ = true;  ///< all times
    int without_place_ = 0;        ///< rows
};

}  // namespace

bool looks_like_log(std::string_view text) {
    if (is_vissim(text)) return true;
    text = without_mark(text);
    const std::string_view first = trimmed(text.substr(0, text.find('\n')));
    if (is_header(first)) return true;
    const std::vector<std::vector<double>> rows = first_rows(text);
    return is_tum(rows) || is_kitti(rows);
}

TrackFile parse_log(std::string_view text, const std::string& file) { return LogParser(text, file).parse(); }

}  // namespace mobbscope
