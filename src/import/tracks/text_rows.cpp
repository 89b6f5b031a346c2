// Rows of text: which columns a header, a comment or a format names, and the cells of lines.
#include <base/median.h>
#include <import/clip/column_choice.h>
#include <import/clip/sampling.h>
#include <import/tracks/clock_text.h>
#include <import/tracks/remarks.h>
#include <import/tracks/rows.h>
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

constexpr std::size_t kRowsOfHeight = 10'000;  // that tell which way is up
constexpr std::size_t kMostColumns = 1024;     // a line of a million is refused early
constexpr double kUnread = std::numeric_limits<double>::quiet_NaN();
// Heads are so high, in metres; standing children and adults on stairs included.
constexpr double kLowestHead = 0.8;
constexpr double kHighestHead = 2.5;
constexpr double kHeadHeight = 1.7;  // metres: the contract's, for the unit "auto"

constexpr std::string_view kMetresAndPoints = "metres, 2.5 points a second";
constexpr RowFormat kRowFormats[] = {
    {"obsmat",
     "frame id x _ y _ _ _",
     2.5,
     true,
     "UCY, ETH and TrajNet recordings",
     "UCY or ETH obsmat (8: frame id x z y vx vz vy)",
     {"UCY, ETH `obsmat` (`.txt`)", "frame id x z y vx vz vy", kMetresAndPoints}},
    {"trajnet",
     "frame id x y",
     2.5,
     true,
     "UCY, ETH and TrajNet recordings",
     "TrajNet (4 columns: frame ped x y)",
     {"TrajNet (`.txt`)", "frame ped x y; or id frame x y, if that is what walks (a warning says so)",
      kMetresAndPoints}},
    {"petrack",
     "id frame x y z",
     16,
     false,
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
     "the Stanford Drone Dataset",
     "SDD (9 numbers and a label in quotes)",
     {"Stanford Drone (`.txt`)", "id xmin ymin xmax ymax frame lost occluded generated \"label\"",
      "the boxes' centres in pixels, y down, one pixel a metre; 30 frames a second"}},
};
constexpr const RowFormat& kTrajnet = kRowFormats[1];
constexpr const RowFormat& kPetrack = kRowFormats[2];
constexpr const RowFormat& kSdd = kRowFormats[3];
constexpr std::string_view kIdFirst = "id frame x y";

/// Boxes, of which people want the centres: by their words, with what x and y are made of.
struct BoxColumns {
    std::array<std::string_view, 4> words;
    bool has_middles;             ///< the last two are the other ends, else lengths
    std::string_view not_with{};  ///< a word that makes it something else
};
constexpr BoxColumns kBoxes[] = {
    {{"x", "y", "width", "height"}, false, "length"},  // highD; with a length they are those of a body around x and y
    {{"xmin", "ymin", "xmax", "ymax"}, true},
    {{"x1", "y1", "x2", "y2"}, true},
    {{"left", "top", "width", "height"}, false},
    {{"bbleft", "bbtop", "bbwidth", "bbheight"}, false},  // MOT Challenge
};

/// Between fields; ' ' stands for any number of blanks.
char separator_of(std::string_view header) {
    std::array<std::pair<char, int>, 3> counts{{{',', 0}, {';', 0}, {'\t', 0}}};
    bool quoted = false;
    for (const char c : header) {
        quoted = quoted != (c == '"');
        for (auto& [separator, count] : counts) count += !quoted && c == separator;
    }
    const auto most = std::ranges::max_element(counts, {}, &std::pair<char, int>::second);
    return most->second > 0 ? most->first : ' ';
}

bool is_gap(char c) { return c == ' ' || c == '\t'; }

/// A name within a hint.
std::string shown(const std::string& name) {
    constexpr std::size_t kLongest = 40;
    return shortened(cleaned(name), kLongest);
}

std::string quoted_list(const std::vector<std::string>& names) {
    constexpr std::size_t kMostNamed = 8;
    std::string out;
    for (std::size_t i = 0; i < std::min(names.size(), kMostNamed); ++i) {
        const bool last = i > 0 && i + 1 == names.size();
        out += (i == 0 ? "" : last ? " and " : ", ") + in_quotes(names[i]);
    }
    if (names.size() > kMostNamed) out += " and " + std::to_string(names.size() - kMostNamed) + " more";
    return out;
}

struct Field {
    std::string_view text;
    double number;  ///< of most numbers; kUnread: it is read when it is asked for
};

std::size_t numbers_in(std::span<const Field> fields) {
    return static_cast<std::size_t>(
        std::ranges::count_if(fields, [](const Field& field) { return parse_double(field.text).has_value(); }));
}

/// One pass over the text of a file, line by line.
class TextRows final : public Cells {
  public:
    /// `scoped`: columns that tell recordings or scenes belong to the ids.
    TextRows(const Input& text, const std::string& file, const ImportOptions& options, bool scoped = false)
        : Cells(file), lines_(text.pieces(), file), options_(options), rows_(file), scoped_(scoped) {}

    /// Of a table whose header was read: whether it has such columns, and whether one is known to need them.
    bool has_scopes() const { return !scopes_.empty(); }
    bool needs_scopes() const { return needs_scopes_; }

    TrackFile table() {
        const bool at_row = read_header();
        choose_columns();
        rows_.order_hint = order_hint();
        if (at_row || lines_.next()) {
            if (!take_units()) add_row();
            while (lines_.next()) add_row();
        }
        if (rows_.empty())
            throw InputError(file_, at_line(lines_.number()), "there is no row after the header; add samples");
        TrackFile out = finished();
        out.format = "csv";
        if (rows_[Column::label]) out.class_size = ClassSize::body;
        if (const auto x = rows_[Column::x]->columns(); x.size() == 1)
            out.place_is_front = plain_name(names_[x.front()]).word == "localx";  // of NGSIM
        if (const std::optional<ColumnFormula>& id = rows_[Column::id]) out.id_column = names_[*id->only_column()];
        if (const auto time = out.timed ? rows_[Column::t]->columns() : std::vector<std::size_t>(); !time.empty())
            out.time_column = names_[time.front()];
        out.header_line = header_line_;
        out.fps_is_rate = rows_[Column::frame].has_value();
        if (out.fps_is_rate) out.rate = remarks_.rate();
        if (frames_are_chosen_ && !out.rate) out.rate = 1;
        out.unit_assumption = unit_remark();
        out.unit = unit_;
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
            const std::optional<double> day =
                date_ && is_time_of_day(field) ? seconds_of_clock(fields_[*date_].text) : std::optional(0.0);
            if (!day) fail(*date_, in_quotes(fields_[*date_].text) + " is not a date; write it like 2021-06-01");
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
        const bool is_named = column < names_.size() && names_[column] != "_";
        return at_line(lines_.number()) + ", column " + std::to_string(column + 1) +
               (is_named ? " (" + shown(names_[column]) + ")" : "");
    }

  private:
    static std::string values(std::size_t count) { return counted(count, "value", "values"); }
    using Cells::fail;
    [[noreturn]] void fail(const std::string& message) const { lines_.fail(message); }
    [[noreturn]] void fail_in_header(const std::string& message) const {
        throw InputError(file_, at_line(header_line_), message);
    }

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

    void split_row() {
        split(whole_line(), names_.size());
        if (fields_.size() != names_.size())
            fail("has " + values(fields_.size()) + " but " + named_by_ + ' ' + std::to_string(names_.size()) +
                 "; give every row all of them");
    }

    bool add_row() {
        split_row();
        if (std::exchange(counts_time_, false)) scale_time();
        if (has_scopes() && !scoped_ && !needs_scopes_) {
            const std::string_view scope = text(scopes_.front());
            if (rows_.empty()) first_scope_ = scope;
            needs_scopes_ = !is_weak_scope_ && scope != first_scope_;
        }
        if (!rows_.add(*this)) return false;
        if (height_ && looked_at_ < kRowsOfHeight) look_at_height();
        return true;
    }

    /// How far places go in x, y and z: where y points up they go in x and z.
    void look_at_height() {
        ++looked_at_;
        for (std::size_t i = 0; i < spread_.size(); ++i) {
            const std::size_t column = i == 2 ? *height_ : *rows_[i == 0 ? Column::x : Column::y]->only_column();
            std::string text(fields_[column].text);
            if (separator_ != ',') std::ranges::replace(text, ',', '.');
            const std::optional<double> at = parse_double(text);
            if (!at) continue;
            Spread& of = spread_[i];
            of.changes += *at != of.last;
            of = {std::min(of.least, *at), std::max(of.most, *at), *at, of.changes};
        }
    }
    /// What is said then.
    void tell_height() {
        constexpr std::size_t kFewest = 10;  // places
        constexpr double kFlat = 0.01, kGoes = 0.25;
        const auto length = [](const Spread& of) { return of.most - of.least; };
        const auto& [x, y, z] = spread_;
        if (z.changes < kFewest || length(y) > kFlat * length(z) || length(z) < kGoes * length(x)) return;
        const std::string &flat = names_[*rows_[Column::y]->only_column()], &ground = names_[*height_];
        warnings_.push_back({"the column " + in_quotes(flat) + " hardly changes and " + in_quotes(ground) +
                                 " does: if " + flat + " points up, as in Unity, give columns (y=" + ground + ")",
                             "columns"});
    }

    /// Times that count from 1970 tell their unit by their size: seconds are below 1e11 until the year 5138.
    void scale_time() {
        const std::size_t column = rows_[Column::t]->columns().front();
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
        if (factor < 1) rows_[Column::t].emplace(column, factor);
        if (factor < 1 || is_weak_time_) {
            warnings_.push_back({"the column " + in_quotes(names_[column]) + " is taken for " + std::string(unit) +
                                     "; give columns (t=" + names_[column] + "/1000) if it counts " +
                                     (factor < 1 ? "others" : "milliseconds"),
                                 "columns"});
        }
    }

    // ---- the header of a table

    /// Whether the line in hand is a row, not a header: names are seldom numbers.
    bool is_row() const { return 2 * numbers_in(fields_) >= fields_.size() && !options_.columns; }

    /// True if the header was a comment, and the line in hand is the first row.
    bool read_header() {
        if (lines_.empty())
            throw InputError(file_, at_line(1),
                             "the file is empty; give a header such as t,x,y,r and one sample a row");
        std::string comment;
        int comment_line = 0;
        bool found = false;
        while (!found && lines_.next()) {
            found = !lines_.line().starts_with('#');
            if (found) break;
            comment = lines_.line().substr(1);
            comment_line = lines_.number();
            remarks_.read(comment);
        }
        if (!found) {
            throw InputError(file_, at_line(1),
                             "holds only blank lines" + std::string(comment_line > 0 ? " and comments" : "") +
                                 "; give a header such as t,x,y,r");
        }
        separator_ = separator_of(whole_line());
        header_line_ = lines_.number();
        split(whole_line(), kMostColumns);
        const bool in_comment = is_row() && comment_line > 0;
        if (in_comment) {
            const std::size_t count = fields_.size();
            split(comment, kMostColumns);
            if (fields_.size() != count) fields_.assign(1, {"0", 0});
            header_line_ = comment_line;
        }
        if (is_row()) fail("there is no header; begin the file with a line that names the columns, such as t,x,y,r");
        for (const Field& field : fields_) names_.emplace_back(field.text);
        return in_comment;
    }

    /// The column that is most likely meant where none is known by its name: one whose unit alone is strange, else the
    /// first of which nothing is known.
    std::string likely_column(Column needed) const {
        const auto is_meant = [&](const std::string& name) {
            const std::optional<KnownColumn> known = known_column(plain_name(name).word);
            return known && known->column == needed && !known_column(name);
        };
        const auto is_strange = [](const std::string& name) { return !name.empty() && !known_column(name); };
        auto at = std::ranges::find_if(names_, is_meant);
        if (at == names_.end()) at = std::ranges::find_if(names_, is_strange);
        return at == names_.end() ? "" : *at;
    }

    /// "; or say what it is by the option columns, such as x=px".
    std::string also_by_option(Column needed) const {
        const std::string likely = likely_column(needed);
        return "; or say what it is by the option columns, such as " + std::string(name(needed)) + '=' +
               (likely.empty() ? "east" : shown(likely));
    }

    std::string order_hint() const {
        const std::string likely = likely_column(Column::id);
        return likely.empty() || options_.columns
                   ? ""
                   : ", or, if these are several tracks, say which column names them, such as columns id=" +
                         shown(likely);
    }

    // ---- which column is which

    void choose_columns() {
        try {
            if (options_.columns) {
                for (const auto& [column, text] : chosen_columns(*options_.columns))
                    rows_[column].emplace(text, std::span<const std::string>(names_));
            }
            take_boxes();
        } catch (const std::invalid_argument& error) {
            fail_in_header(error.what());
        }
        for (const Column column : {Column::id, Column::label, Column::lost, Column::active, Column::floor}) {
            if (rows_[column] && !rows_[column]->only_column())
                fail_in_header("columns: " + std::string(name(column)) + " is one column, and nothing to work out");
        }
        for (const Column column : kColumns) take_by_name(column);
        name_radius_column();
        settle_bodies();
        for (const Column needed : {Column::x, Column::y}) {
            if (rows_[needed]) continue;
            fail_in_header("the header names no column " + std::string(name(needed)) + "; it needs t,x,y,r or x,y,r" +
                           (has_word("lat") || has_word("latitude")
                                ? ". Latitudes and longitudes are degrees: turn them into metres first"
                                : also_by_option(needed)));
        }
        const std::optional<std::size_t> time = rows_[Column::t] ? rows_[Column::t]->only_column() : std::nullopt;
        const std::optional<KnownColumn> named = time ? known_column(names_[*time]) : std::nullopt;
        if (options_.columns && named && named->column == Column::frame) {
            // Frame numbers, if fps says how many are a second.
            rows_[Column::frame] = std::exchange(rows_[Column::t], std::nullopt);
            frames_are_chosen_ = true;
        }
        if (rows_[Column::t]) rows_[Column::frame].reset();
        date_ = rows_[Column::t] ? column_with("date") : std::nullopt;
        for (const char* name : {"z", "posz", "zpos", "positionz", "zposition", "coordz", "zcoord"}) {
            const bool has_places = rows_[Column::x]->only_column() && rows_[Column::y]->only_column();
            if (!height_ && has_places && header_line_ > 0 && !options_.columns) height_ = column_with(name);
        }
        find_scopes();
    }

    /// What makes no body, and keeps nobody apart, is a column like any other.
    void settle_bodies() {
        const auto column_words = [this](Column column) {
            const std::vector<std::size_t> from = rows_[column]->columns();
            return from.empty() ? "the option columns" : in_quotes(names_[from.front()]);
        };
        const bool has_sizes = rows_[Column::length] && rows_[Column::width] && !rows_[Column::r];
        if (has_sizes) {
            rows_.body_columns = "the columns " + column_words(Column::length) + " and " + column_words(Column::width);
        }
        const auto leave = [this](Column column, bool is_left) {
            if (is_left) rows_[column].reset();
        };
        leave(Column::length, !has_sizes);
        leave(Column::width, !has_sizes);
        leave(Column::heading, !has_sizes && !rows_[Column::label]);
        if (rows_[Column::heading]) rows_.heading_column = "the column " + column_words(Column::heading);
        rows_.guesses_angles = rows_.guesses_angles && rows_[Column::heading];
        leave(Column::floor, !rows_[Column::id]);
        leave(Column::z, !rows_[Column::id] || rows_[Column::floor]);
    }

    void find_scopes() {
        if (header_line_ == 0 || !rows_[Column::id] || options_.columns) return;
        constexpr std::array<std::string_view, 23> kScopes{
            "recordingid", "recording", "sceneid",   "scene",   "caseid", "case",   "sequenceid", "sequence",
            "sessionid",   "session",   "videoid",   "video",   "runid",  "run",    "trialid",    "trial",
            "experiment",  "episode",   "episodeid", "dataset", "take",   "takeid", "location"};
        for (std::size_t i = 0; i < names_.size(); ++i) {
            const std::string word = plain_name(names_[i]).word;
            if (std::ranges::find(kScopes, word) == kScopes.end()) continue;
            // A room is no recording, unless the ids say so.
            is_weak_scope_ = (scopes_.empty() || is_weak_scope_) && word == "location";
            scopes_.push_back(i);
        }
        if (!scoped_ || scopes_.empty()) return;
        rows_.scopes = scopes_;
        std::vector<std::string> said;
        for (const std::size_t scope : scopes_) said.push_back(names_[scope]);
        warnings_.push_back({"ids are one's within " + quoted_list(said) +
                                 " alone and are told with it, as '0/17': who is in different ones was never there "
                                 "together and does not meet; give columns (id=...) if that is wrong",
                             "columns"});
    }

    bool has_word(std::string_view word) const { return column_with(word).has_value(); }
    std::optional<std::size_t> column_with(std::string_view word) const {
        const auto at = std::ranges::find(names_, word, [](const std::string& name) { return plain_name(name).word; });
        return at == names_.end() ? std::nullopt : std::optional(static_cast<std::size_t>(at - names_.begin()));
    }

    /// Centres of boxes, where the columns are corners.
    void take_boxes() {
        if (rows_[Column::x] || rows_[Column::y]) return;
        for (const BoxColumns& box : kBoxes) {
            std::array<std::string, 4> names;
            bool all = box.not_with.empty() || !has_word(box.not_with);
            for (std::size_t i = 0; all && i < names.size(); ++i) {
                const std::optional<std::size_t> column = column_with(box.words[i]);
                all = column && names_[*column].find('"') == std::string::npos;
                if (all) names[i] = names_[*column];
            }
            // A table with centres of its own needs none of this.
            if (!all || (box.words[0] != "x" && has_word("x"))) continue;
            const auto centre = [&](std::size_t i, const std::string& quote = "") {
                std::string sum = quote;
                sum.append(names[i]).append(quote).append("+").append(quote).append(names[i + 2]).append(quote);
                return box.has_middles ? "(" + sum + ")/2" : sum + "/2";
            };
            rows_[Column::x].emplace(centre(0, "\""), std::span<const std::string>(names_));
            rows_[Column::y].emplace(centre(1, "\""), std::span<const std::string>(names_));
            if (header_line_ == 0) return;
            warnings_.push_back({"the columns " + quoted_list({names.begin(), names.end()}) +
                                     " are taken for boxes: their centres are " + centre(0) + ", " + centre(1) +
                                     "; give columns (x=" + names[0] + ",y=" + names[1] + ") if that is wrong" +
                                     (box.has_middles ? ""
                                                      : ", (length=" + names[2] + ",width=" + names[3] +
                                                            ") for bodies that are as large along their way"),
                                 "columns"});
            return;
        }
    }

    void take_by_name(Column column) {
        std::vector<std::size_t> found;
        std::vector<KnownColumn> known;
        bool strong = false;
        if (const std::optional<ColumnFormula>& chosen = rows_[column]) {
            // A column that was chosen as it is keeps the unit that its name says.
            const std::optional<std::size_t> only = chosen->only_column();
            const std::optional<KnownColumn> here = only ? known_column(names_[*only]) : std::nullopt;
            if (!here || !here->says_unit || (here->column == Column::t) != (column == Column::t)) return;
            found.push_back(*only);
            known.push_back(*here);
        }
        const bool is_chosen = !found.empty();
        for (std::size_t i = 0; i < names_.size() && !is_chosen; ++i) {
            const std::optional<KnownColumn> here = known_column(names_[i]);
            if (!here || here->column != column || (strong && here->is_weak)) continue;
            if (!here->is_weak && !strong) {
                found.clear();
                known.clear();
                strong = true;
            }
            found.push_back(i);
            known.push_back(*here);
        }
        if (found.empty() || (column == Column::frame && rows_[Column::t])) return;
        // Of others the first counts.
        const bool must_be_one = column <= Column::r;
        if (found.size() > 1 && must_be_one) {
            const std::string& first = names_[found[0]];
            const std::string& second = names_[found[1]];
            if (first == second) fail_at_name(found[1], "the column stands twice; remove one");
            fail_at_name(found[1], in_quotes(first) + " and " + in_quotes(second) + " may both be " +
                                       std::string(name(column)) + "; say which by the option columns, such as " +
                                       std::string(name(column)) + "=" + shown(second));
        }
        const KnownColumn& is = known.front();
        if (column == Column::t) {
            rows_[column].emplace(found.front(), is.scale);
            counts_time_ = !is.says_unit && !is_chosen;
            is_weak_time_ = is.is_weak;
            return;
        }
        if (column == Column::heading) {
            rows_[column].emplace(found.front(), is.scale);
            rows_.guesses_angles = !is.says_unit;
            return;
        }
        // All lengths are in the unit of the first column that says one.
        double factor = 1;
        if (is.says_unit && column != Column::x && column != Column::y && unit_why_.empty()) {
            // Places without a unit are in metres all the same.
            factor = options_.unit ? 1 : is.scale;
        } else if (is.says_unit) {
            if (unit_why_.empty()) {
                unit_ = is.scale;
                unit_why_ = "the column " + in_quotes(names_[found.front()]);
            }
            factor = is.scale / unit_;
        }
        rows_[column].emplace(found.front(), factor * is.share);
    }

    [[noreturn]] void fail_at_name(std::size_t column, const std::string& message) const {
        throw InputError(file_, at_line(header_line_) + ", column " + std::to_string(column + 1), message);
    }

    /// The column that the option radius names.
    void name_radius_column() {
        const RadiusColumn* const wanted = options_.radius ? std::get_if<RadiusColumn>(&*options_.radius) : nullptr;
        if (!wanted) return;
        const auto at = std::ranges::find(names_, wanted->name);
        // "r" may be made of others.
        if (at == names_.end() && wanted->name == "r" && rows_[Column::r]) return;
        if (at == names_.end()) {
            fail_in_header("the header names no column " + in_quotes(wanted->name) + " of radii" +
                           did_you_mean(wanted->name, names_) + "; give metres, or a column that it names");
        }
        const auto column = static_cast<std::size_t>(at - names_.begin());
        const auto twice = std::find(at + 1, names_.end(), wanted->name);
        if (twice != names_.end())
            fail_at_name(static_cast<std::size_t>(twice - names_.begin()), "the column stands twice; remove one");
        rows_[Column::r].emplace(column);
    }

    /// A row of units below the header, as Pathfinder writes it: "s,,m,m".
    bool take_units() {
        split_row();
        const std::optional<std::size_t> x = rows_[Column::x]->only_column();
        const std::optional<double> unit = x ? metres_of_unit(lower(fields_[*x].text)) : std::nullopt;
        if (!unit) return false;
        unit_ = *unit;
        unit_why_ = "the row of units";
        return true;
    }

    std::string unit_remark() {
        if (unit_why_.empty() && remarks_.unit()) {
            unit_ = *remarks_.unit();
            unit_why_ = "a comment";
        }
        return unit_ == 1 ? ""
                          : "a unit of length is " + format_double(unit_) + " m, as " + unit_why_ +
                                " says; give unit if that is wrong";
    }

    /// The tracks, and what is said of the columns.
    TrackFile finished() {
        TrackFile out = rows_.finish();
        if (height_) tell_height();
        std::vector<bool> used(names_.size(), header_line_ == 0);
        for (const Column column : kColumns) {
            const std::optional<ColumnFormula>& made = rows_[column];
            for (const std::size_t at : made ? made->columns() : std::vector<std::size_t>()) used[at] = true;
        }
        for (const std::size_t scope : rows_.scopes) used[scope] = true;
        if (date_) used[*date_] = true;
        std::size_t unnamed = 0;
        for (std::size_t i = 0; i < names_.size(); ++i) {
            if (used[i]) continue;
            if (names_[i].empty()) {
                ++unnamed;
            } else if (std::ranges::find(out.others, names_[i]) == out.others.end()) {
                out.others.push_back(names_[i]);
            }
        }
        std::string over;
        if (!out.others.empty())
            over = (out.others.size() == 1 ? "the column " : "the columns ") + quoted_list(out.others);
        if (unnamed > 0) {
            over += (over.empty() ? "" : " and ") +
                    (unnamed == 1 ? std::string("a column") : counted(unnamed, "", "columns")) + " without a name";
        }
        if (!over.empty())
            warnings_.push_back({over + (out.others.size() + unnamed == 1 ? " is" : " are") + " ignored", "columns"});
        if (decimal_commas_) warnings_.push_back({"commas within numbers are read as decimal points: 0,5 is a half"});
        for (const std::string& warning : remarks_.warnings()) warnings_.push_back({warning});
        out.warnings.insert(out.warnings.begin(), warnings_.begin(), warnings_.end());
        return out;
    }

    // ---- rows of numbers alone

    static std::string known_formats() {
        std::string out = "a .txt can be ";
        for (const RowFormat& format : kRowFormats) {
            if (&format != kRowFormats) out += &format == &kSdd ? " or " : ", ";
            out += format.hint;
        }
        return out;
    }

    void name_columns(std::string_view columns, std::string named_by) {
        split(columns, kMostColumns);
        names_.clear();
        for (const Field& field : fields_) names_.emplace_back(field.text);
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
        names_ = std::move(words);
        named_by_ = "a comment names";
        // Frames go before times, as they tell no rounded ones.
        if (count(Column::frame) == 0) return;
        for (std::string& name : names_) {
            const std::optional<KnownColumn> known = known_column(name);
            if (known && known->column == Column::t) name = "_";
        }
    }

    /// Decides by the first row which format this is.
    void choose_format() {
        format_ = &kPetrack;
        if (names_.empty()) {
            split(lines_.line(), kMostColumns);
            const std::size_t numbers = numbers_in(fields_);
            const std::size_t count = fields_.size();
            const bool labelled = lines_.line().ends_with('"');
            format_ = nullptr;
            for (const RowFormat& format : kRowFormats) {
                const auto columns = static_cast<std::size_t>(std::ranges::count(format.columns, ' ')) + 1;
                if (columns == count && numbers + (&format == &kSdd && labelled ? 1 : 0) == count) format_ = &format;
            }
            if (!format_) {
                const std::string columns = counted(count, "column", "columns");
                fail("is not a row of a trajectory file (" +
                     (numbers == count ? "numbers in " + columns : columns + ", not all of them numbers") + "); " +
                     known_formats());
            }
            // Who tells a rate is not TrajNet, where the camera's does not matter.
            const bool is_flat = format_ == &kTrajnet && remarks_.rate();
            if (is_flat) format_ = &kPetrack;
            name_columns(is_flat ? kIdFirst : format_->columns, "the rows before it have");
        }
        rows_.whole_in = format_->name;
        choose_columns();
        if (format_ == &kPetrack) {
            heads_ = column_with("z");
            for (const char* axis : {"a", "b"}) {
                if (const std::optional<std::size_t> column = column_with(axis)) rows_.axes.push_back(*column);
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
        out.rate = remarks_.rate().value_or(format_->rate);
        if (remarks_.rate()) return;
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
        if (remarks_.unit() || !unit_why_.empty()) {
            out.unit = remarks_.unit().value_or(unit_);
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

    TextLines lines_;
    const ImportOptions& options_;
    RowReader rows_;
    char separator_ = ',';
    int header_line_ = 0;               ///< 0: there is no header
    std::vector<Field> fields_;         ///< of the line in hand
    std::deque<std::string> unquoted_;  ///< those of them that are in quotes
    std::vector<std::string> names_;    ///< of columns
    std::string named_by_ = "the header names";
    double unit_ = 1;         ///< metres per unit of x, y and r
    std::string unit_why_{};  ///< who says so: "the column x/cm"; empty: nobody
    std::vector<ImportWarning> warnings_;
    Remarks remarks_;
    mutable bool decimal_commas_ = false;
    bool counts_time_ = false, is_weak_time_ = false;  ///< t has no unit; its name may mean something else
    bool frames_are_chosen_ = false;                   ///< the option columns says that t is a column of frames
    std::optional<std::size_t> date_;                  ///< the column of dates beside times of day
    std::vector<std::size_t> scopes_;                  ///< columns within which ids are one's
    bool scoped_, is_weak_scope_ = false, needs_scopes_ = false;
    std::string first_scope_;

    // Of rows of numbers alone:
    struct Spread {
        double least = std::numeric_limits<double>::max(), most = std::numeric_limits<double>::lowest(), last = kUnread;
        std::size_t changes = 0;  ///< rows whose place is another than that of the row before
    };
    std::optional<std::size_t> height_;  ///< the column z of a table with x and y
    std::array<Spread, 3> spread_;       ///< of x, y and z
    std::size_t looked_at_ = 0;          ///< rows, for that
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

/// What stands in the fields of a line.
struct FieldCounts {
    std::size_t fields = 0;
    std::size_t numbers = 0;
    std::size_t known = 0;  ///< names of columns
};

FieldCounts counts_of(std::string_view line, char separator) {
    FieldCounts out;
    for (std::string_view rest = line; !rest.empty(); ++out.fields) {
        // Words in quotes may hold what parts others.
        const std::size_t from = rest.starts_with('"') ? std::min(rest.find('"', 1), rest.size()) : 0;
        const std::size_t at =
            std::min(separator == ' ' ? rest.find_first_of(" \t", from) : rest.find(separator, from), rest.size());
        std::string_view field = trimmed(rest.substr(0, at));
        if (field.size() > 1 && field.front() == '"' && field.back() == '"') field = field.substr(1, field.size() - 2);
        out.numbers += parse_double(field).has_value();
        out.known += known_column(field).has_value();
        rest.remove_prefix(std::min(at + 1, rest.size()));
        if (separator == ' ') rest = trimmed(rest);
    }
    return out;
}

}  // namespace

bool looks_like_table(std::string_view text) {
    text = without_mark(text);
    const std::string_view line = take_row(text);
    const bool is_text = std::ranges::none_of(line, [](char c) { return c >= 0 && c < ' ' && c != '\t'; });
    if (line.empty() || !is_text || std::string_view("{[<%").find(line[0]) != std::string_view::npos) return false;
    const char separator = separator_of(line);
    const FieldCounts header = counts_of(line, separator);
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
    const std::string choice = options.columns.value_or("") + '\n' + (radius ? radius->name : "");
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
