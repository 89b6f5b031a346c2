#include <import/clip/column_choice.h>
#include <import/clip/sample_times.h>
#include <import/clip/sampling.h>
#include <import/tracks/csv.h>
#include <import/tracks/remarks.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <stdexcept>
#include <utility>

namespace mobbscope {

namespace {

constexpr std::size_t kMostColumns = 1024;  // a line of a million is refused early

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

/// One pass over the text of a file, line by line.
class CsvParser {
  public:
    CsvParser(std::string_view text, const std::string& file, const ImportOptions& options)
        : empty_(text.empty()), lines_(text, file), file_(file), options_(options) {}

    CsvTable parse() {
        const bool at_row = read_header();
        choose_columns();
        if (at_row || next_row()) {
            if (!take_units()) add_row();
            while (next_row()) add_row();
        }
        if (tracks_.empty())
            throw InputError(file_, at_line(lines_.number()), "there is no row after the header; add samples");
        const auto twice = [this](const Track& track, const TrackPoint& row) {
            return time_word() + ' ' + format_double(row.frame) +
                   (table_.has_time ? rounded_time_hint(row.frame) : "") + " of track " + in_quotes(track.id) +
                   " stands already in line ";
        };
        const bool sorts = table_.has_id && (table_.has_time || table_.has_frame);
        table_.tracks = sorts ? tracks_.take_sorted(twice) : tracks_.take();
        table_.spent = tracks_.take_spent();
        if (table_.has_time && in_milliseconds_) table_.rounding = kMillisecond;
        tell();
        return std::move(table_);
    }

  private:
    static std::string values(std::size_t count) { return counted(count, "value", "values"); }
    [[noreturn]] void fail(const std::string& message) const { lines_.fail(message); }
    [[noreturn]] void fail_in_header(const std::string& message) const {
        throw InputError(file_, at_line(header_line_), message);
    }
    [[noreturn]] void fail(std::size_t column, const std::string& message) const {
        const std::string name = column < names_.size() ? " (" + shown(names_[column]) + ")" : "";
        throw InputError(file_, at_line(lines_.number()) + ", column " + std::to_string(column + 1) + name, message);
    }

    /// Splits a line at its separators; more fields than `limit` are an error.
    void split(std::string_view rest, std::size_t limit) {
        fields_.clear();
        unquoted_.clear();
        for (bool more = true; more;) {
            if (fields_.size() == limit) {
                fail("has more than " + values(limit) + "; the header and every row must have the same columns");
            }
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
            const std::size_t end = separator_ == ' ' ? rest.find_first_of(" \t") : rest.find(separator_);
            fields_.push_back(trimmed(rest.substr(0, end)));
            rest.remove_prefix(end == std::string_view::npos ? rest.size() : end + 1);
            if (separator_ == ' ') skip_blanks(rest);
            return end != std::string_view::npos;
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
        fields_.push_back(field);
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
    std::string_view line() const { return separator_ == '\t' ? lines_.whole_line() : lines_.line(); }

    /// Whether the line in hand is a row, not a header: names are seldom numbers.
    bool is_row() const {
        const auto numbers =
            std::ranges::count_if(fields_, [](std::string_view field) { return parse_double(field).has_value(); });
        return 2 * static_cast<std::size_t>(numbers) >= fields_.size() && !options_.columns;
    }

    /// True if the header was a comment, and the line in hand is the first row.
    bool read_header() {
        if (empty_)
            throw InputError(file_, at_line(1),
                             "the file is empty; give a header such as t,x,y,r and one sample a row");
        std::string_view comment;
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
        separator_ = separator_of(line());
        header_line_ = lines_.number();
        split(line(), kMostColumns);
        const bool in_comment = is_row() && comment_line > 0;
        if (in_comment) {
            const std::size_t count = fields_.size();
            split(comment, kMostColumns);
            if (fields_.size() != count) fields_.assign(1, "0");
            header_line_ = comment_line;
        }
        if (is_row()) fail("there is no header; begin the file with a line that names the columns, such as t,x,y,r");
        names_.assign(fields_.begin(), fields_.end());
        return in_comment;
    }

    bool next_row() { return lines_.next(); }

    // ---- columns

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

    void choose_columns() {
        try {
            if (options_.columns) {
                for (const auto& [column, text] : chosen_columns(*options_.columns))
                    formula(column).emplace(text, std::span<const std::string>(names_));
            }
            take_boxes();
        } catch (const std::invalid_argument& error) {
            fail_in_header(error.what());
        }
        const std::optional<ColumnFormula>& id = formula(Column::id);
        if (id && !id->only_column()) fail_in_header("columns: id is one column, and nothing to work out");
        std::array<double, std::size(kColumns)> scales{};
        for (const Column column : kColumns) take_by_name(column, scales);
        name_radius_column();
        for (const Column needed : {Column::x, Column::y}) {
            if (formula(needed)) continue;
            fail_in_header("the header names no column " + std::string(name(needed)) + "; it needs t,x,y,r or x,y,r" +
                           (has_word("lat") || has_word("latitude")
                                ? ". Latitudes and longitudes are degrees: turn them into metres first"
                                : also_by_option(needed)));
        }
        if (formula(Column::t)) formula(Column::frame).reset();
        table_.header_line = header_line_;
        table_.has_id = id.has_value();
        table_.has_time = formula(Column::t).has_value();
        table_.has_frame = formula(Column::frame).has_value();
        table_.has_radius = formula(Column::r).has_value();
    }

    std::optional<ColumnFormula>& formula(Column column) { return formulas_[static_cast<std::size_t>(column)]; }
    const std::optional<ColumnFormula>& formula(Column column) const {
        return formulas_[static_cast<std::size_t>(column)];
    }

    bool has_word(std::string_view word) const { return column_with(word).has_value(); }
    std::optional<std::size_t> column_with(std::string_view word) const {
        const auto at = std::ranges::find(names_, word, [](const std::string& name) { return plain_name(name).word; });
        return at == names_.end() ? std::nullopt : std::optional(static_cast<std::size_t>(at - names_.begin()));
    }

    /// Centres of boxes, where the columns are corners.
    void take_boxes() {
        if (formula(Column::x) || formula(Column::y)) return;
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
            formula(Column::x).emplace(centre(0, "\""), std::span<const std::string>(names_));
            formula(Column::y).emplace(centre(1, "\""), std::span<const std::string>(names_));
            table_.warnings.push_back({"the columns " + quoted_list({names.begin(), names.end()}) +
                                           " are taken for boxes: their centres are " + centre(0) + ", " + centre(1) +
                                           "; give columns (x=" + names[0] + ",y=" + names[1] + ") if that is wrong",
                                       "columns"});
            return;
        }
    }

    void take_by_name(Column column, std::array<double, std::size(kColumns)>& scales) {
        double& scale = scales[static_cast<std::size_t>(column)];
        std::vector<std::size_t> found;
        std::vector<KnownColumn> known;
        bool strong = false;
        if (const std::optional<ColumnFormula>& chosen = formula(column)) {
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
        if (found.empty() || (column == Column::frame && formula(Column::t))) return;
        if (found.size() > 1) {
            const std::string& first = names_[found[0]];
            const std::string& second = names_[found[1]];
            if (first == second) fail_at_name(found[1], "the column stands twice; remove one");
            fail_at_name(found[1], in_quotes(first) + " and " + in_quotes(second) + " may both be " +
                                       std::string(name(column)) + "; say which by the option columns, such as " +
                                       std::string(name(column)) + "=" + shown(second));
        }
        const KnownColumn& is = known.front();
        scale = is.says_unit ? is.scale : 0;
        if (column == Column::t) {
            formula(column).emplace(found.front(), is.scale);
            if (is.is_weak && !is.says_unit) {
                table_.warnings.push_back({"the column " + in_quotes(names_[found.front()]) +
                                               " is taken for seconds; give columns (t=" + names_[found.front()] +
                                               "/1000) if it counts milliseconds",
                                           "columns"});
            }
            return;
        }
        // All lengths are in the unit of the first column that says one.
        double factor = 1;
        if (scale > 0) {
            if (table_.unit_why.empty()) {
                table_.unit = scale;
                table_.unit_why = "the column " + in_quotes(names_[found.front()]);
            }
            factor = scale / table_.unit;
        }
        formula(column).emplace(found.front(), factor);
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
        if (at == names_.end() && wanted->name == "r" && formula(Column::r)) return;
        if (at == names_.end()) {
            fail_in_header("the header names no column " + in_quotes(wanted->name) + " of radii" +
                           did_you_mean(wanted->name, names_) + "; give metres, or a column that it names");
        }
        const auto column = static_cast<std::size_t>(at - names_.begin());
        const auto twice = std::find(at + 1, names_.end(), wanted->name);
        if (twice != names_.end())
            fail_at_name(static_cast<std::size_t>(twice - names_.begin()), "the column stands twice; remove one");
        formula(Column::r).emplace(column);
    }

    // ---- rows

    /// A row of units below the header, as Pathfinder writes it: "s,,m,m".
    bool take_units() {
        split_row();
        const std::optional<std::size_t> x = formula(Column::x)->only_column();
        if (!x || fields_[*x].empty()) return false;
        const std::optional<double> unit = metres_of_unit(lower(fields_[*x]));
        if (!unit) return false;
        table_.unit = *unit;
        table_.unit_why = "the row of units";
        return true;
    }

    void split_row() {
        split(line(), names_.size());
        if (fields_.size() == names_.size()) return;
        fail("has " + values(fields_.size()) + " but the header names " + values(names_.size()) +
             "; give every row all of them");
    }

    void add_row() {
        split_row();
        const std::string_view id = table_.has_id ? identifier() : std::string_view();
        const TrackPoint here = row();
        in_milliseconds_ = in_milliseconds_ && is_in_milliseconds(here.frame);
        // Tracks may lie across each other in any order, the rows of one motion may not.
        if (!table_.has_id && (table_.has_time || table_.has_frame) && !tracks_.empty()) check_order(here.frame);
        last_ = here.frame;
        tracks_.add(id, here);
    }

    std::string_view identifier() const {
        const std::size_t column = *formula(Column::id)->only_column();
        if (fields_[column].empty()) fail(column, "the field is empty; name the track");
        if (!is_utf8(fields_[column])) fail(column, "the name is not UTF-8 text; save the file as UTF-8");
        return fields_[column];
    }

    /// The number that stands in a column.
    double number(std::size_t column) const {
        const std::string_view field = fields_[column];
        double value = 0;
        const char* const end = field.data() + field.size();
        if (!field.empty() && read_plain_double(field.data(), end, value) == end) return value;
        if (field.empty()) fail(column, "the field is empty; give a number");
        if (const std::optional<double> read = parse_double(field)) return *read;
        const std::size_t comma = field.find(',');
        if (separator_ != ',' && comma != std::string_view::npos && field.find('.') == std::string_view::npos) {
            std::string with_point(field);
            with_point[comma] = '.';
            decimal_commas_ = true;
            if (const std::optional<double> read = parse_double(with_point)) return *read;
        }
        const bool is_clock = field.find(':') != std::string_view::npos;
        fail(column, in_quotes(field) + (is_clock ? " is a time of day; give seconds, such as 0.25"
                                                  : " is not a finite number; write it like 0.25"));
    }

    /// What a formula makes of the row; 0 where there is none.
    double value_of(Column column, double largest) const {
        const std::optional<ColumnFormula>& made = formula(column);
        if (!made) return 0;
        const double value = made->of([this](std::size_t at) { return number(at); });
        if (std::abs(value) <= largest) return value;
        const std::vector<std::size_t> from = made->columns();
        if (made->only_column())
            fail(from.front(),
                 in_quotes(fields_[from.front()]) + " is beyond " + format_double(largest) + "; check the units");
        const std::string message = std::string(name(column)) + " becomes " + brief(value) +
                                    ", which is not a number up to " + format_double(largest) + "; check the ";
        from.empty() ? fail(message + "option columns") : fail(from.front(), message + "units");
    }

    TrackPoint row() const {
        const TrackPoint row{
            table_.has_frame ? value_of(Column::frame, kMaxFrame) : value_of(Column::t, mobb::kMaxTime),
            value_of(Column::x, mobb::kMaxLength), value_of(Column::y, mobb::kMaxLength), lines_.number(),
            value_of(Column::r, mobb::kMaxLength)};
        if (row.r < 0) {
            const std::vector<std::size_t> from = formula(Column::r)->columns();
            const std::string message = "the radius is negative; give 0 or more";
            from.empty() ? fail(message) : fail(from.front(), message);
        }
        return row;
    }

    void check_order(double time) const {
        if (time > last_) return;
        const std::string likely = likely_column(Column::id);
        fail(column_of_time(),
             time_word() + " does not come after " + format_double(last_) +
                 " of the row before; sort the rows and remove doubles" +
                 (time == last_ && table_.has_time ? rounded_time_hint(time) : "") +
                 (likely.empty() || options_.columns
                      ? ""
                      : ", or, if these are several tracks, say which column names them, such as columns id=" +
                            shown(likely)));
    }

    std::string time_word() const { return table_.has_frame ? "the frame" : "the time"; }
    std::size_t column_of_time() const {
        const std::vector<std::size_t> columns = formula(table_.has_frame ? Column::frame : Column::t)->columns();
        return columns.empty() ? 0 : columns.front();
    }

    // ---- what is said of it

    void tell() {
        table_.rate = remarks_.rate();
        if (table_.unit_why.empty() && remarks_.unit()) {
            table_.unit = *remarks_.unit();
            table_.unit_why = "a comment";
        }
        std::vector<bool> used(names_.size(), false);
        for (const std::optional<ColumnFormula>& made : formulas_) {
            for (const std::size_t column : made ? made->columns() : std::vector<std::size_t>()) used[column] = true;
        }
        std::size_t unnamed = 0;
        for (std::size_t i = 0; i < names_.size(); ++i) {
            if (used[i]) continue;
            if (names_[i].empty()) {
                ++unnamed;
            } else if (std::ranges::find(table_.others, names_[i]) == table_.others.end()) {
                table_.others.push_back(names_[i]);
            }
        }
        std::string over;
        if (!table_.others.empty()) {
            over = (table_.others.size() == 1 ? "the column " : "the columns ") + quoted_list(table_.others);
        }
        if (unnamed > 0) {
            over += (over.empty() ? "" : " and ") +
                    (unnamed == 1 ? std::string("a column") : counted(unnamed, "", "columns")) + " without a name";
        }
        if (!over.empty()) {
            const bool one = table_.others.size() + unnamed == 1;
            table_.warnings.push_back({over + (one ? " is" : " are") + " ignored", "columns"});
        }
        if (decimal_commas_)
            table_.warnings.push_back({"commas within numbers are read as decimal points: 0,5 is a half"});
        for (const std::string& warning : remarks_.warnings()) table_.warnings.push_back({warning});
    }

    bool empty_;
    TextLines lines_;
    const std::string& file_;
    const ImportOptions& options_;
    char separator_ = ',';
    int header_line_ = 0;
    std::vector<std::string_view> fields_;  ///< of the line in hand
    std::deque<std::string> unquoted_;      ///< those of them that are in quotes
    std::vector<std::string> names_;
    std::array<std::optional<ColumnFormula>, std::size(kColumns)> formulas_{};  ///< in order of kColumns
    Remarks remarks_;
    TrackCollector tracks_{file_};
    double last_ = 0;              ///< the time or frame of the last row
    bool in_milliseconds_ = true;  ///< all values of t
    mutable bool decimal_commas_ = false;
    CsvTable table_;
};

}  // namespace

CsvTable parse_csv(std::string_view text, const std::string& file, const ImportOptions& options) {
    return CsvParser(text, file, options).parse();
}

CsvFile::CsvFile(std::string text, const std::string& file) : text_(std::move(text)), file_(file) {}

std::shared_ptr<const CsvTable> CsvFile::table(const ImportOptions& options) const {
    const RadiusColumn* const radius = options.radius ? std::get_if<RadiusColumn>(&*options.radius) : nullptr;
    const std::string choice = options.columns.value_or("") + '\n' + (radius ? radius->name : "");
    const std::lock_guard lock(mutex_);
    if (!last_ || choice != last_choice_) {
        last_ = std::make_shared<const CsvTable>(parse_csv(text_, file_, options));
        last_choice_ = choice;
    }
    return last_;
}

namespace {

/// What stands in the fields of a line.
struct FieldCounts {
    std::size_t fields = 0;
    std::size_t numbers = 0;
    std::size_t known = 0;  ///< names of columns
};

FieldCounts counts_of(std::string_view line, char separator) {
    FieldCounts out;
    for (std::string_view rest = line; !rest.empty(); ++out.fields) {
        const std::size_t at =
            std::min(separator == ' ' ? rest.find_first_of(" \t") : rest.find(separator), rest.size());
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
    if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);
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
