// Rows of text: which columns a header, a comment or a format names, and the cells of lines.
#include <base/median.h>
#include <import/clip/column_choice.h>
#include <import/clip/sampling.h>
#include <import/tracks/clock_text.h>
#include <import/tracks/remarks.h>
#include <import/tracks/rows.h>
#include <import/tracks/table_columns.h>
#include <import/tracks/text_rows.h>
#include <mobb/clip.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <limits>
#include <span>
#include <stdexcept>
#include <utility>

namespace mobbscope {

namespace {

constexpr std::size_t kMostColumns = 1024;  // a line of a million is refused early
constexpr double kUnread = std::numeric_limits<double>::quiet_NaN();
// Heads are so high, in metres; standing children and adults on stairs included.
constexpr double kLowestHead = 0.8;
constexpr double kHighestHead = 2.5;
constexpr double kHeadHeight = 1.7;  // metres: the contract's, for the unit "auto"

/// The first rows of a text of numbers between blanks.
using FirstRows = std::span<const std::vector<double>>;
constexpr double kOffUnit = 0.02;  // of lengths that are 1

/// Times that rise, and quaternions.
bool is_tum(FirstRows rows) {
    double last = -std::numeric_limits<double>::infinity();
    return std::ranges::all_of(rows, [&last](const std::vector<double>& row) {
        const double length = std::hypot(std::hypot(row[4], row[5]), std::hypot(row[6], row[7]));
        return std::abs(length - 1) <= kOffUnit && std::exchange(last, row[0]) < row[0];
    });
}

/// Rotations, whose rows have length 1.
bool is_kitti(FirstRows rows) {
    return std::ranges::all_of(rows, [](const std::vector<double>& row) {
        return std::ranges::all_of(std::array{0u, 4u, 8u}, [&row](std::size_t i) {
            return std::abs(std::hypot(row[i], row[i + 1], row[i + 2]) - 1) <= kOffUnit;
        });
    });
}

/// Boxes of people in frames of a video.
bool is_mot(FirstRows rows) {
    const auto is_whole = [](double number) { return number == std::floor(number); };
    return std::ranges::all_of(rows, [&is_whole](const std::vector<double>& row) {
        const bool is_box = (row[4] > 0 && row[5] > 0) || (row[4] == -1 && row[5] == -1);
        return is_box && row[0] >= 0 && is_whole(row[0]) && is_whole(row[1]);
    });
}

/// Places alone, where the other columns would be what boxes hold.
bool is_mot_without_boxes(FirstRows rows) {
    return is_mot(rows) && std::ranges::all_of(rows, [](const std::vector<double>& row) { return row[5] == -1; }) &&
           std::ranges::any_of(rows, [](const std::vector<double>& row) { return row[7] != -1 || row[8] != -1; });
}

/// Some of which have a place.
bool is_mot_on_ground(FirstRows rows) {
    return is_mot(rows) &&
           std::ranges::any_of(rows, [](const std::vector<double>& row) { return row[7] != -1 || row[8] != -1; });
}

constexpr std::string_view kMotBoxes =
    "is of the MOT Challenge, with boxes in an image and no places on the ground: project the middle of each box's "
    "lower edge onto it and write id,t,x,y as CSV; or, for the boxes' centres in pixels, name the columns in a first "
    "line: frame,id,bb_left,bb_top,bb_width,bb_height and the others, such as conf";
constexpr std::string_view kMetresAndPoints = "metres, 2.5 points a second";
constexpr RowFormat kRowFormats[] = {
    {"obsmat",
     "frame id x _ y _ _ _",
     2.5,
     true,
     ' ',
     "UCY, ETH and TrajNet recordings",
     "UCY or ETH obsmat (8: frame id x z y vx vz vy)",
     {"UCY, ETH `obsmat` (`.txt`)", "frame id x z y vx vz vy", kMetresAndPoints}},
    {"trajnet",
     "frame id x y",
     2.5,
     true,
     ' ',
     "UCY, ETH and TrajNet recordings",
     "TrajNet (4 columns: frame ped x y)",
     {"TrajNet (`.txt`)", "frame ped x y; or id frame x y, if that is what walks (a warning says so)",
      kMetresAndPoints}},
    {"petrack",
     "id frame x y z",
     16,
     false,
     ' ',
     "the Hermes recordings",
     "PeTrack (5: id frame x y z, or as a comment names them: # id frame x y)",
     {"PeTrack, JuPedSim (`.txt`)",
      "id frame x y z, or as a comment names them; the larger of the semi-axes A, B of an ellipse is the radius",
      "frame rate as a comment says (`# framerate: 25`, \"recorded at 25 fps\"), else 16 a second; unit likewise "
      "(`x/cm`, \"in metres\"), else from the height of the heads"}},
    {"sdd",
     "id xmin ymin xmax ymax frame lost _ _ label",
     30,
     false,
     ' ',
     "the Stanford Drone Dataset",
     "SDD (9 numbers and a label in quotes)",
     {"Stanford Drone (`.txt`)", "id xmin ymin xmax ymax frame lost occluded generated \"label\"",
      "the boxes' centres in pixels, y down, one pixel a metre; 30 frames a second"}},
    {"poses",
     "t x y _ _ _ _ _",
     1,
     false,
     ' ',
     "",
     "",
     {"TUM poses (`.txt`)", "t x y z qx qy qz qw", "metres; one robot"},
     is_tum},
    {"poses",
     "_ _ _ x _ _ _ z _ _ _ y",
     10,
     false,
     ' ',
     "KITTI",
     "",
     {"KITTI poses (`.txt`)", "a matrix of twelve numbers: right, down and forward are the fourth, eighth and twelfth",
      "metres; one robot, 10 poses a second"},
     is_kitti},
    {"mot", "frame id _ _ _ _ _ _ _", 0, false, ',', "", "", {}, is_mot, kMotBoxes},
    {"mot", "frame id _ _ _ _ _ x y", 0, false, ',', "", "", {}, is_mot_without_boxes},
    {"mot", "frame id _ _ _ _ _ _ _ _", 0, false, ',', "", "", {}, is_mot, kMotBoxes},
    {"mot",
     "frame id _ _ _ _ _ x y z",
     0,
     false,
     ',',
     "",
     "",
     {"MOT Challenge (`.txt`)", "frame,id,left,top,width,height,conf,x,y,z, of which x, y and z are the place",
      "metres; give `--fps`"},
     is_mot_on_ground},
};
constexpr const RowFormat& kTrajnet = kRowFormats[1];
constexpr const RowFormat& kPetrack = kRowFormats[2];
constexpr const RowFormat& kSdd = kRowFormats[3];
constexpr const RowFormat& kKitti = kRowFormats[5];
constexpr std::string_view kIdFirst = "id frame x y";

/// Between fields; ' ' stands for any number of blanks.
char separator_of(std::string_view header) {
    std::array<std::pair<char, int>, 4> counts{{{',', 0}, {';', 0}, {'\t', 0}, {'|', 0}}};
    bool quoted = false;
    for (const char c : header) {
        quoted = quoted != (c == '"');
        for (auto& [separator, count] : counts) count += !quoted && c == separator;
    }
    const auto most = std::ranges::max_element(counts, {}, &std::pair<char, int>::second);
    return most->second > 0 ? most->first : ' ';
}

/// Lines ahead of the header in VISSIM's files, and the one that tells Excel what parts fields.
bool is_ahead_of_header(std::string_view line) {
    return line.starts_with('*') || line.starts_with("$VISION") || lower(line.substr(0, 4)) == "sep=";
}

bool is_gap(char c) { return c == ' ' || c == '\t'; }

/// Whether a field in quotes goes on behind a text, `is_open`: and comes from before it.
bool is_in_quotes(std::string_view text, char separator, bool is_open) {
    bool may_begin = true;  // of a closing quote: goes on behind two
    for (const char c : text) {
        const bool is_quote = c == '"';
        if (is_quote && (is_open || may_begin)) {
            is_open = !is_open;
            may_begin = true;
        } else if (!is_open) {
            may_begin = c == separator || (is_gap(c) && (may_begin || separator == ' '));
        }
    }
    return is_open;
}

struct Field {
    std::string_view text;
    double number;  ///< of most numbers; kUnread: it is read when it is asked for
};

/// From the least to the most of some numbers.
struct Extent {
    double least = std::numeric_limits<double>::max(), most = std::numeric_limits<double>::lowest();

    void take(double number) {
        least = std::min(least, number);
        most = std::max(most, number);
    }
    double length() const { return most - least; }
};

std::size_t numbers_in(std::span<const Field> fields) {
    return static_cast<std::size_t>(
        std::ranges::count_if(fields, [](const Field& field) { return parse_double(field.text).has_value(); }));
}

/// What stands in the fields of a line, of which no more are looked at than kMostColumns and one.
struct FieldCounts {
    std::size_t fields = 0;
    std::size_t numbers = 0;
    std::size_t known = 0;  ///< names of columns
};

FieldCounts counts_of(std::string_view line, char separator) {
    FieldCounts out;
    for (; !line.empty() && out.fields <= kMostColumns; ++out.fields) {
        const std::string_view field = take_word(line, separator);
        out.numbers += parse_double(field).has_value();
        out.known += known_column(field).has_value();
    }
    return out;
}

/// Those at the beginning of a text, each with so many numbers: enough to tell poses from other rows.
std::vector<std::vector<double>> first_rows(std::string_view text, char separator, std::size_t count) {
    constexpr std::size_t kLookedAt = 10;
    std::vector<std::vector<double>> out;
    for (std::string_view line = take_row(text); !line.empty() && out.size() < kLookedAt; line = take_row(text)) {
        std::vector<double>& row = out.emplace_back();
        while (!line.empty()) row.push_back(parse_double(take_word(line, separator)).value_or(kUnread));
        row.resize(count, kUnread);
    }
    return out;
}

/// What rows are of, of which one is at hand and the text begins with the first; null: none that is known.
const RowFormat* row_format(std::string_view line, std::string_view text) {
    const char separator = separator_of(line) == ',' ? ',' : ' ';
    const FieldCounts row = counts_of(line, separator);
    const RowFormat* out = nullptr;
    for (const RowFormat& format : kRowFormats) {
        const bool has_label = &format == &kSdd && line.ends_with('"');
        const auto columns = static_cast<std::size_t>(std::ranges::count(format.columns, ' ')) + 1;
        const bool fits =
            format.separator == separator && columns == row.fields && row.numbers + (has_label ? 1 : 0) == row.fields;
        if (fits && (!format.holds || format.holds(first_rows(text, separator, columns)))) out = &format;
    }
    return out;
}

/// Rows between commas without a header, nor a comment that may be one.
bool is_row_format_of_commas(std::string_view text) {
    std::string_view rest = text;
    const std::string_view line = take_row(rest);
    const RowFormat* const format = text.starts_with(line) ? row_format(line, text) : nullptr;
    return format && format->separator == ',';
}

/// One pass over the text of a file, line by line.
class TextRows final : public Cells {
  public:
    /// `scoped`: columns that tell recordings or scenes belong to the ids.
    TextRows(const Input& text, const std::string& file, const ImportOptions& options, bool scoped = false)
        : Cells(file), input_(text), lines_(text.pieces(), file), rows_(file), columns_(file, options, rows_, scoped) {}

    /// Of a table whose header was read: whether it has such columns, and whether one is known to need them.
    bool has_scopes() const { return !columns_.scopes.empty(); }
    bool needs_scopes() const { return needs_scopes_; }

    TrackFile table() {
        const bool at_row = read_header();
        columns_.choose_groups();
        rows_.order_hint = columns_.order_hint();
        if (at_row || next_row()) {
            if (!take_units()) add_row();
            while (next_row()) add_row();
        }
        if (rows_.empty())
            throw InputError(file_, at_line(lines_.number()), "there is no row after the header; add samples");
        TrackFile out = finished();
        out.format = columns_.format;
        if (rows_[Column::label] && out.format == "csv") out.class_size = ClassSize::body;
        if (const auto x = rows_[Column::x]->columns(); x.size() == 1) {
            const std::string word = plain_name(columns_.names[x.front()]).word;
            out.place_is_front = word == "localx" || word == "coordfrontx" || out.format == "sumo";
        }
        if (const std::optional<ColumnFormula>& id = rows_[Column::id])
            out.id_column = columns_.names[*id->only_column()];
        if (const std::size_t time = out.timed ? rows_[Column::t]->first_column() : kNoColumn; time != kNoColumn)
            out.time_column = columns_.names[time];
        out.header_line = columns_.header_line;
        out.fps_is_rate = rows_[Column::frame].has_value();
        if (out.fps_is_rate) out.rate = remarks_.rate();
        if (columns_.frames_are_chosen && !out.rate) out.rate = 1;
        out.unit_assumption = unit_remark();
        out.unit = columns_.unit;
        return out;
    }

    TrackFile numbers() {
        separator_ = ' ';
        bool first = true;
        while (lines_.next()) {
            if (lines_.line()[0] == '#') {
                if (first) read_comment(lines_.line().substr(1));
                continue;
            }
            if (std::exchange(first, false)) choose_format();
            if (!add_row()) continue;
            if (format_ == &kTrajnet) look_at_order();
            if (heads_) heights_.push_back(number(*heads_));
        }
        if (rows_.empty()) lines_.fail("the file has no row; " + known_formats());
        TrackFile out = finished();
        if (format_ == &kTrajnet && is_id_first(out.tracks)) {
            format_ = &kPetrack;
            out.tracks = with_ids_first(out.tracks);
            out.warnings.push_back(
                {"the rows are taken as id frame x y: as frame ped x y, which TrajNet has, people would jump about; a "
                 "comment ahead of them, such as '# frame id x y', says what they are"});
        }
        out.format = format_->name;
        if (format_ == &kKitti) find_ground(out);
        tell_rate(out);
        tell_unit(out);
        if (!rows_.axes.empty()) {
            out.warnings.push_back(
                {"the columns A and B are semi-axes of ellipses: people are disks of the larger one"});
        }
        return out;
    }

    // ---- cells

    double number(std::size_t column) const override {
        if (const std::optional<double> read = value(column)) return *read;
        const std::string_view field = fields_[column].text;
        if (field.empty()) fail(column, "the field is empty; give a number");
        const std::optional<ColumnFormula>& time = rows_[Column::t];
        const bool is_time = time && std::ranges::count(time->columns(), column) > 0;
        if (const std::optional<double> clock = is_time ? seconds_of_clock(field) : std::nullopt) {
            const std::optional<double> day = columns_.date && is_time_of_day(field)
                                                  ? seconds_of_clock(fields_[*columns_.date].text)
                                                  : std::optional(0.0);
            if (!day)
                fail(*columns_.date,
                     in_quotes(fields_[*columns_.date].text) + " is not a date; write it like 2021-06-01");
            return *clock + *day;
        }
        fail(column, in_quotes(field) + " is not a finite number; write it like 0.25" +
                         (is_time ? ", or a time like 2021-06-01T12:00:00" : ""));
    }
    std::optional<double> value(std::size_t column) const override {
        const auto& [field, known] = fields_[column];
        if (!std::isnan(known)) return known;
        if (const std::optional<double> read = parse_double(field)) return read;
        const std::size_t comma = field.find(',');
        if (separator_ == ',' || comma == std::string_view::npos || field.find('.') != std::string_view::npos)
            return std::nullopt;
        std::string with_point(field);
        with_point[comma] = '.';
        const std::optional<double> read = parse_double(with_point);
        decimal_commas_ = decimal_commas_ || read;
        return read;
    }
    std::string_view text(std::size_t column) const override { return fields_[column].text; }
    bool is_empty(std::size_t column) const override {
        const auto& [field, known] = fields_[column];
        if (!std::isnan(known)) return false;
        const auto is = [word = lower(field)](std::string_view none) { return word == none; };
        return std::ranges::any_of(std::array{"", "?", "-", "nan", "na", "n/a", "null", "none"}, is);
    }
    int line() const override { return lines_.number(); }
    std::string place(std::size_t column) const override {
        if (column == kNoColumn) return at_line(lines_.number());
        const bool is_named = column < columns_.names.size() && columns_.names[column] != "_";
        return at_line(lines_.number()) + ", column " + std::to_string(column + 1) +
               (is_named ? " (" + shown(columns_.names[column]) + ")" : "");
    }

  private:
    static std::string values(std::size_t count) { return counted(count, "value", "values"); }
    using Cells::fail;
    [[noreturn]] void fail(const std::string& message) const { lines_.fail(message); }

    // ---- lines

    /// Splits a line at its separators; more fields than `limit` are an error.
    void split(std::string_view rest, std::size_t limit) {
        fields_.clear();
        unquoted_.clear();
        for (bool more = true; more;) {
            if (fields_.size() == limit)
                fail("has more than " + values(limit) + "; the header and every row must have the same columns");
            more = take_field(rest);
        }
    }

    void skip_blanks(std::string_view& rest) const {
        std::size_t at = 0;
        while (at < rest.size() && is_gap(rest[at]) && (separator_ == ' ' || rest[at] != separator_)) ++at;
        rest.remove_prefix(at);
    }

    /// Takes one field off the front of `rest`; true if another one follows it.
    bool take_field(std::string_view& rest) {
        skip_blanks(rest);
        if (!rest.starts_with('"')) {
            const auto parts = [this](char c) { return c == separator_ || (separator_ == ' ' && c == '\t'); };
            const char* const begin = rest.data();
            const char* const end = begin + rest.size();
            double number = kUnread;
            const char* at = read_plain_double(begin, end, number);
            if (at == begin || (at != end && !parts(*at))) number = kUnread;
            at = std::find_if(at, end, parts);
            fields_.push_back({trimmed({begin, at}), number});
            rest.remove_prefix(at == end ? rest.size() : static_cast<std::size_t>(at - begin) + 1);
            if (separator_ == ' ') skip_blanks(rest);
            return at != end;
        }
        std::string& field = unquoted_.emplace_back();
        for (rest.remove_prefix(1);;) {
            const std::size_t quote = rest.find('"');
            if (quote == std::string_view::npos) fail(fields_.size(), "the quote is not closed; add the closing \"");
            field += rest.substr(0, quote);
            rest.remove_prefix(quote + 1);
            if (!rest.starts_with('"')) break;
            field += '"';
            rest.remove_prefix(1);
        }
        fields_.push_back({field, kUnread});
        skip_blanks(rest);
        if (rest.empty()) return false;
        if (separator_ == ' ') return true;
        if (rest[0] != separator_)
            fail(fields_.size() - 1, separator_ == ',' ? "a comma must follow the closing quote"
                                                       : "what parts fields must follow the closing quote");
        rest.remove_prefix(1);
        return true;
    }

    /// Blanks at the ends part nothing, but where tabs part fields these may be empty.
    std::string_view whole_line() const { return separator_ == '\t' ? lines_.whole_line() : lines_.line(); }

    /// With the lines that fields in quotes go over.
    bool next_row() {
        if (!lines_.next()) return false;
        take_open_quotes();
        return true;
    }
    void take_open_quotes() {
        std::size_t from = 0;
        bool is_open = false;
        do {
            const std::string_view added = lines_.whole_line().substr(from);
            if (!is_open && added.find('"') == std::string_view::npos) return;
            is_open = is_in_quotes(added, separator_, is_open);
            from += added.size();
        } while (is_open && lines_.join());
    }

    void split_row() {
        constexpr std::size_t kOfSpot = 2;
        const std::size_t count = columns_.names.size() - (columns_.spot ? kOfSpot : 0);
        split(whole_line(), count);
        if (fields_.size() != count)
            fail("has " + values(fields_.size()) + " but " + named_by_ + ' ' + std::to_string(count) +
                 "; give every row all of them");
        if (!columns_.spot) return;
        std::string_view rest = trimmed(fields_[*columns_.spot].text);
        for (std::size_t i = 0; i < kOfSpot; ++i) fields_.push_back({take_word(rest, ' '), kUnread});
    }

    bool add_row() {
        split_row();
        if (std::exchange(columns_.counts_time, false)) scale_time();
        if (has_scopes() && !columns_.scoped && !needs_scopes_) {
            const std::string_view scope = text(columns_.scopes.front());
            if (rows_.empty()) first_scope_ = scope;
            needs_scopes_ = !columns_.is_weak_scope && scope != first_scope_;
        }
        return rows_.add(*this);
    }

    /// Where y points up places go in x and z, which is said; such heights are no floors.
    void tell_height(TrackFile& file) {
        constexpr std::size_t kFewest = 10;  // places
        constexpr double kFlat = 0.01, kGoes = 0.25;
        Extent x, y, z;
        double highest_climb = 0, last = kUnread;
        std::size_t changes = 0;
        for (const Track& track : file.tracks) {
            Extent climb;
            for (const TrackPoint& point : track.points) {
                const PointDetail* const detail = file.detail_of(point);
                if (!detail || std::isnan(detail->z)) continue;
                changes += std::exchange(last, detail->z) != detail->z;
                x.take(point.x);
                y.take(point.y);
                z.take(detail->z);
                climb.take(detail->z);
            }
            highest_climb = std::max(highest_climb, climb.length());
        }
        // People on different floors each stay on theirs.
        if (changes < kFewest || y.length() > kFlat * z.length() || z.length() < kGoes * x.length() ||
            highest_climb <= kGoes * z.length())
            return;
        const std::string &flat = columns_.names[*rows_[Column::y]->only_column()],
                          &ground = columns_.names[*columns_.height];
        for (PointDetail& detail : file.details) detail.z = PointDetail::kUntold;
        columns_.warnings.push_back({"the column " + in_quotes(flat) + " hardly changes and " + in_quotes(ground) +
                                         " does: if " + flat + " points up, as in Unity, give columns (y=" + ground +
                                         ")",
                                     "columns"});
    }

    /// Times that count from 1970 tell their unit by their size: seconds are below 1e11 until the year 5138.
    void scale_time() {
        const std::size_t column = rows_[Column::t]->first_column();
        if (!parse_double(fields_[column].text)) return;
        constexpr double kOfMilliseconds = 1e11;
        constexpr double kThousand = 1000;
        double factor = 1;
        std::string_view unit = "seconds";
        const double size = std::abs(number(column));
        for (const std::string_view finer : {"milliseconds", "microseconds", "nanoseconds"}) {
            if (size * factor < kOfMilliseconds) break;
            factor /= kThousand;
            unit = finer;
        }
        for (RowGroup& group : rows_.groups()) {
            if (factor < 1) group.formulas[static_cast<std::size_t>(Column::t)].emplace(column, factor);
        }
        if (factor < 1 || columns_.is_weak_time) {
            columns_.warnings.push_back({"the column " + in_quotes(columns_.names[column]) + " is taken for " +
                                             std::string(unit) + "; give columns (t=" + columns_.names[column] +
                                             "/1000) if it counts " + (factor < 1 ? "others" : "milliseconds"),
                                         "columns"});
        }
    }

    // ---- the header of a table

    /// Whether the line in hand is a row, not a header: names are seldom numbers.
    bool is_row() const { return 2 * numbers_in(fields_) >= fields_.size() && !columns_.options.columns; }

    /// True if the header was a comment, and the line in hand is the first row.
    bool read_header() {
        if (lines_.empty())
            throw InputError(file_, at_line(1),
                             "the file is empty; give a header such as t,x,y,r and one sample a row");
        std::string comment;
        int comment_line = 0;
        bool found = false;
        while (!found && lines_.next()) {
            const std::string_view line = lines_.line();
            found = !line.starts_with('#') && !is_ahead_of_header(line);
            if (found || line[0] != '#') continue;
            comment = line.substr(1);
            comment_line = lines_.number();
            remarks_.read(comment);
        }
        if (!found) {
            throw InputError(file_, at_line(1),
                             "holds only blank lines" + std::string(comment_line > 0 ? " and comments" : "") +
                                 "; give a header such as t,x,y,r");
        }
        separator_ = separator_of(whole_line());
        take_open_quotes();
        // The first line may end within the first name.
        separator_ = separator_of(whole_line());
        columns_.header_line = lines_.number();
        split(whole_line(), kMostColumns);
        const bool in_comment = is_row() && comment_line > 0;
        if (in_comment) {
            const std::size_t count = fields_.size();
            split(comment, kMostColumns);
            if (fields_.size() != count) fields_.assign(1, {"0", 0});
            columns_.header_line = comment_line;
        }
        if (is_row()) fail("there is no header; begin the file with a line that names the columns, such as t,x,y,r");
        for (const Field& field : fields_) columns_.names.emplace_back(field.text);
        return in_comment;
    }

    /// A row of units below the header, as Pathfinder writes it: "s,,m,m".
    bool take_units() {
        split_row();
        const std::optional<std::size_t> x = rows_[Column::x]->only_column();
        const std::optional<double> unit = x ? metres_of_unit(lower(fields_[*x].text)) : std::nullopt;
        if (!unit) return false;
        columns_.unit = *unit;
        columns_.unit_why = "the row of units";
        return true;
    }

    std::string unit_remark() {
        if (columns_.unit_why.empty() && remarks_.unit()) {
            columns_.unit = *remarks_.unit();
            columns_.unit_why = "a comment";
        }
        return columns_.unit == 1 ? ""
                                  : "a unit of length is " + format_double(columns_.unit) + " m, as " +
                                        columns_.unit_why + " says; give unit if that is wrong";
    }

    /// The tracks, and what is said of the columns.
    TrackFile finished() {
        TrackFile out = rows_.finish();
        if (columns_.height) tell_height(out);
        // What keeps nobody apart is a column like any other.
        if (!rows_.has_ids() || rows_[Column::floor]) rows_[Column::z].reset();
        out.others = columns_.tell_ignored();
        if (decimal_commas_)
            columns_.warnings.push_back({"commas within numbers are read as decimal points: 0,5 is a half"});
        for (const std::string& warning : remarks_.warnings()) columns_.warnings.push_back({warning});
        out.warnings.insert(out.warnings.begin(), columns_.warnings.begin(), columns_.warnings.end());
        return out;
    }

    // ---- rows of numbers alone

    static std::string known_formats() {
        std::string out = "a .txt can be ";
        for (const RowFormat& format : kRowFormats) {
            if (format.hint.empty()) continue;
            if (&format != kRowFormats) out += &format == &kSdd ? " or " : ", ";
            out += format.hint;
        }
        return out;
    }

    void name_columns(std::string_view columns, std::string named_by) {
        split(columns, kMostColumns);
        columns_.names.clear();
        for (const Field& field : fields_) columns_.names.emplace_back(field.text);
        named_by_ = std::move(named_by);
    }

    /// A comment ahead of the rows may tell the frame rate, the unit, and the columns: "id frame x/m y/m z/m".
    void read_comment(std::string_view comment) {
        remarks_.read(comment);
        std::vector<std::string> words;
        // What stands in brackets is the unit of a name, or a remark.
        bool bracketed = false;
        while (!(comment = trimmed(comment)).empty()) {
            const std::string_view word = comment.substr(0, std::min(comment.find_first_of(" \t"), comment.size()));
            comment.remove_prefix(word.size());
            const bool is_name = !bracketed && word[0] != '[' && word[0] != '(';
            bracketed = !is_name && word.back() != ']' && word.back() != ')';
            if (is_name) words.emplace_back(word);
            if (words.size() > kMostColumns) return;
        }
        std::array<int, std::size(kColumns)> counts{};
        for (const std::string& word : words) {
            if (const std::optional<KnownColumn> known = known_column(word))
                ++counts[static_cast<std::size_t>(known->column)];
        }
        const auto count = [&counts](Column column) { return counts[static_cast<std::size_t>(column)]; };
        const bool has_all = count(Column::id) == 1 && count(Column::x) == 1 && count(Column::y) == 1 &&
                             count(Column::t) + count(Column::frame) > 0;
        if (!has_all || std::ranges::max(counts) > 1) return;
        columns_.names = std::move(words);
        named_by_ = "a comment names";
        // Frames go before times, as they tell no rounded ones.
        if (count(Column::frame) == 0) return;
        for (std::string& name : columns_.names) {
            const std::optional<KnownColumn> known = known_column(name);
            if (known && known->column == Column::t) name = "_";
        }
    }

    /// Of KITTI the ground is right and forward of the camera; where it only goes up and down, those axes were meant
    /// otherwise.
    static void find_ground(TrackFile& out) {
        std::vector<TrackPoint>& points = out.tracks.front().points;
        const auto moves = [&points](const auto& along) {
            const auto [least, most] = std::ranges::minmax_element(points, {}, along);
            return along(*least) != along(*most);
        };
        const auto down = [&out](const TrackPoint& point) { return out.detail_of(point)->z; };
        const bool is_upright = !moves([](const TrackPoint& point) { return point.y; }) && moves(down);
        for (TrackPoint& point : points) {
            if (is_upright) point.y = down(point);
            point.detail = 0;
        }
        out.details.clear();
        out.has_times = true;
        out.warnings.push_back(
            {std::string("the ground is taken to be ") +
             (is_upright ? "x and y, as the third axis never changes" : "x and z of the camera, whose y points down")});
    }

    /// Decides by the first row which format this is.
    void choose_format() {
        format_ = &kPetrack;
        if (columns_.names.empty()) {
            constexpr std::size_t kBytes = 1 << 16;
            format_ = row_format(lines_.line(), input_.beginning(kBytes));
            if (!format_) {
                split(lines_.line(), kMostColumns);
                const std::size_t numbers = numbers_in(fields_), count = fields_.size();
                const std::string columns = counted(count, "column", "columns");
                fail("is not a row of a trajectory file (" +
                     (numbers == count ? "numbers in " + columns : columns + ", not all of them numbers") + "); " +
                     known_formats());
            }
            if (!format_->refusal.empty()) fail(std::string(format_->refusal));
            // Who tells a rate is not TrajNet, where the camera's does not matter.
            const bool is_flat = format_ == &kTrajnet && remarks_.rate();
            if (is_flat) format_ = &kPetrack;
            name_columns(is_flat ? kIdFirst : format_->columns, "the rows before it have");
            separator_ = format_->separator;
        }
        const bool of_robot = format_->name == "poses";
        if (of_robot) {
            rows_.group().id = rows_.group().kind = kRobot;
        } else {
            rows_.whole_in = format_->name;
        }
        columns_.choose_columns();
        if (format_ == &kPetrack) {
            heads_ = columns_.column_with("z");
            for (const char* axis : {"a", "b"}) {
                if (const std::optional<std::size_t> column = columns_.column_with(axis)) rows_.axes.push_back(*column);
            }
        }
    }

    /// Four columns of numbers are frame ped x y, as TrajNet has them, or id frame x y. They are of the first kind
    /// until all rows are read. Rows of one id that follow each other are a walk, which is what tells.
    void look_at_order() {
        const FlatRow here{number(0), number(1), number(2), number(3)};
        if (count_++ > 0 && here.first == last_.first && here.second > last_.second) {
            ++steps_below_;
            length_below_ += std::hypot(here.x - last_.x, here.y - last_.y);
        }
        last_ = here;
    }

    bool is_id_first(const std::vector<Track>& as_trajnet) const {
        // Where nobody has two points in the other order, who walks takes steps of less than so many metres.
        constexpr double kLongestStep = 1;
        constexpr double kClearly = 4;
        if (2 * steps_below_ < count_) return false;
        double length = 0;
        std::size_t steps = 0;
        for (const Track& track : as_trajnet) {
            steps += track.points.size() - 1;
            for (std::size_t i = 1; i < track.points.size(); ++i)
                length +=
                    std::hypot(track.points[i].x - track.points[i - 1].x, track.points[i].y - track.points[i - 1].y);
        }
        const double usual = steps > 0 ? length / static_cast<double>(steps) : kClearly * kLongestStep;
        return kClearly * length_below_ < usual * static_cast<double>(steps_below_);
    }

    std::vector<Track> with_ids_first(const std::vector<Track>& as_trajnet) const {
        std::vector<TrackPoint> points;
        for (const Track& track : as_trajnet) {
            const double frame = *parse_double(track.id);
            for (const TrackPoint& point : track.points)
                points.push_back({frame, point.x, point.y, point.line, point.detail, point.frame});
        }
        std::ranges::sort(points, {}, &TrackPoint::line);
        TrackCollector out(file_);
        for (TrackPoint& point : points) {
            const double id = std::exchange(point.r, 0);
            out.add(std::to_string(static_cast<long long>(id)), point);
        }
        return out.take_sorted();
    }

    void tell_rate(TrackFile& out) const {
        if (out.timed) return;
        out.fps_is_rate = format_->rate == 0 && !remarks_.rate();
        out.rate = out.fps_is_rate ? std::nullopt : std::optional(remarks_.rate().value_or(format_->rate));
        if (out.fps_is_rate || remarks_.rate()) return;
        out.rate_of_steps = format_->rate_of_steps;
        // ETH and UCY: every tenth frame of a camera.
        if (out.rate_of_steps) out.least_step = 10;
        out.rate_assumption = "the file does not say its frame rate: " + brief(format_->rate) +
                              (out.rate_of_steps ? " points" : "") + " a second are assumed, as in " +
                              std::string(format_->as_in) + "; give dt (seconds a frame) if that is wrong";
    }

    /// PeTrack has heads in the third column of space, whose height tells metres from centimetres.
    void tell_unit(TrackFile& out) {
        if (format_ == &kSdd) {
            out.in_pixels = true;
            out.class_size = ClassSize::disk;
            out.unit_assumption =
                "lengths are in pixels of the image, y down: one pixel counts as one metre; give "
                "unit (metres a pixel)";
        }
        if (format_ != &kPetrack) return;
        if (remarks_.unit() || !columns_.unit_why.empty()) {
            out.unit = remarks_.unit().value_or(columns_.unit);
            return;
        }
        const std::string otherwise = " give unit if that is wrong";
        if (!heights_.empty()) {
            const double read = median(heights_);
            const std::array<double, 3> units{1, 0.01, 0.001};
            const double unit = *std::min_element(units.begin(), units.end(), [&](double a, double b) {
                return std::abs(a * read - kHeadHeight) < std::abs(b * read - kHeadHeight);
            });
            const double height = unit * read;
            if (height >= kLowestHead && height <= kHighestHead) {
                out.unit = unit;
                out.guessed_height = height;
                out.unit_assumption = "the file does not say its unit: " +
                                      std::string(unit == 1      ? "metres"
                                                  : unit == 0.01 ? "centimetres"
                                                                 : "millimetres") +
                                      " are assumed, as heads are " + brief(std::round(height * 100) / 100) +
                                      " m high then;" + otherwise;
                return;
            }
        }
        out.unit_assumption =
            "the file does not say its unit, and has no heights of heads that would tell: metres are assumed;" +
            otherwise;
    }

    const Input& input_;
    TextLines lines_;
    RowReader rows_;
    TableColumns columns_;
    char separator_ = ',';
    std::vector<Field> fields_;         ///< of the line in hand
    std::deque<std::string> unquoted_;  ///< those of them that are in quotes
    std::string named_by_ = "the header names";
    Remarks remarks_;
    mutable bool decimal_commas_ = false;
    bool needs_scopes_ = false;
    std::string first_scope_;

    // Of rows of numbers alone:
    const RowFormat* format_ = nullptr;
    std::optional<std::size_t> heads_;  ///< the column of their heights
    std::vector<double> heights_;
    struct FlatRow {
        double first = 0, second = 0, x = 0, y = 0;
    };
    FlatRow last_;
    std::size_t count_ = 0;
    std::size_t steps_below_ = 0;  ///< rows that may be the next point of the one in the row before
    double length_below_ = 0;      ///< of the way from there to here
};

}  // namespace

bool looks_like_table(std::string_view text) {
    text = without_mark(text);
    if (is_row_format_of_commas(text)) return false;
    std::string_view line = take_row(text);
    while (is_ahead_of_header(line)) line = take_row(text);
    const bool is_text = std::ranges::none_of(line, [](char c) { return c >= 0 && c < ' ' && c != '\t'; });
    if (line.empty() || !is_text || std::string_view("{[<").find(line[0]) != std::string_view::npos) return false;
    const char separator = separator_of(line);
    const FieldCounts header = counts_of(line, separator);
    if (line[0] == '%' && header.known == 0) return false;
    if (separator != ' ' && separator != '\t')
        return header.fields >= 2 &&
               (header.numbers == 0 ? header.known > 0 || header.fields > 2 : 2 * header.numbers >= header.fields);
    // Blanks and tabs part trajectories too, and words of sentences: under those there is no row of as many numbers.
    if (header.numbers > 0) return false;
    const FieldCounts row = counts_of(take_row(text), separator);
    return header.known >= 3 || (header.fields >= 3 && row.fields == header.fields && 2 * row.numbers >= row.fields);
}

bool looks_like_text_tracks(std::string_view text) {
    constexpr std::size_t kFewest = 3;  // columns: what lacks one is told so
    if (is_row_format_of_commas(without_mark(text))) return true;
    const FieldCounts row = counts_of(take_row(text), ' ');
    return row.fields >= kFewest && row.numbers + 1 >= row.fields;
}

std::span<const RowFormat> row_formats() { return kRowFormats; }

TrackFile parse_csv(const Input& text, const std::string& file, const ImportOptions& options) {
    std::optional<TrackFile> out;
    TextRows rows(text, file, options);
    try {
        out = rows.table();
        if (rows.needs_scopes()) out.reset();
    } catch (const InputError&) {
        if (!rows.has_scopes()) throw;
    }
    if (!out) out = TextRows(text, file, options, true).table();
    out->is_large = text.is_large();
    return std::move(*out);
}

TrackFile parse_text_tracks(const Input& text, const std::string& file) {
    const ImportOptions none;
    return TextRows(text, file, none).numbers();
}

std::shared_ptr<TrackFile> TableFile::table(const ImportOptions& options, bool takes) const {
    const RadiusColumn* const radius = options.radius ? std::get_if<RadiusColumn>(&*options.radius) : nullptr;
    const std::string choice =
        options.columns.value_or("") + '\n' + (radius ? radius->name : "") + (options.body ? "\nbody" : "");
    const std::lock_guard lock(mutex_);
    if (!last_ || choice != last_choice_) {
        last_ = std::make_shared<TrackFile>(parse_csv(text_, file_, options));
        last_choice_ = choice;
    }
    return takes ? std::exchange(last_, nullptr) : last_;
}

std::string csv_field(std::string_view text) {
    if (text.find_first_of(",\"\r\n") == std::string_view::npos && trimmed(text) == text) return std::string(text);
    std::string out = "\"";
    for (const char c : text) {
        if (c == '"') out += '"';
        out += c;
    }
    return out + '"';
}

}  // namespace mobbscope
