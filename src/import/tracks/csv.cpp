#include <import/tracks/csv.h>
#include <import/tracks/tracks.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <unordered_map>

namespace mobbscope {

namespace {

constexpr std::array<std::string_view, 5> kColumns{"id", "t", "x", "y", "r"};
enum Column { kId, kT, kX, kY, kR };

/// One pass over the text of a file, line by line.
class CsvParser {
  public:
    CsvParser(std::string_view text, const std::string& file) : empty_(text.empty()), lines_(text, file), file_(file) {}

    CsvTable parse() {
        read_header();
        CsvTable table;
        table.has_id = position_[kId] >= 0;
        table.has_time = position_[kT] >= 0;
        table.has_radius = position_[kR] >= 0;
        std::unordered_map<std::string, std::size_t> track_of;
        while (lines_.next()) {
            split(names_.size());
            if (fields_.size() < names_.size()) {
                fail("has " + values(fields_.size()) + " but the header names " + values(names_.size()) +
                     "; give every row all of them");
            }
            const std::string id = table.has_id ? identifier() : "";
            const auto [track, is_new] = track_of.try_emplace(id, table.tracks.size());
            if (is_new) table.tracks.push_back({id, {}, {}, {}});
            std::vector<TimedDisk>& rows = table.tracks[track->second].rows;
            rows.push_back(row());
            table.tracks[track->second].lines.push_back(lines_.number());
            if (!others_.empty()) {
                std::vector<std::string>& others = table.tracks[track->second].others.emplace_back();
                for (const auto& [name, column] : others_) others.push_back(fields_[column]);
            }
            if (table.has_time && rows.size() > 1) check_order(rows, id);
        }
        if (table.tracks.empty())
            throw InputError(file_, at_line(lines_.number()), "there is no row after the header; add samples");
        table.others = std::move(others_);
        return table;
    }

  private:
    static std::string values(std::size_t count) { return counted(count, "value", "values"); }
    [[noreturn]] void fail(const std::string& message) const { lines_.fail(message); }
    [[noreturn]] void fail(std::size_t column, const std::string& message) const {
        const std::string name = column < names_.size() ? " (" + names_[column] + ")" : "";
        throw InputError(file_, at_line(lines_.number()) + ", column " + std::to_string(column + 1) + name, message);
    }

    /// Splits the current line at its commas; more fields than `limit` are an error.
    void split(std::size_t limit) {
        fields_.clear();
        std::string_view rest = lines_.line();
        for (bool more = true; more;) {
            if (fields_.size() == limit) {
                fail("has more than " + values(limit) + "; the header and every row must have the same columns");
            }
            std::string field;
            more = take_field(rest, field);
            fields_.push_back(std::move(field));
        }
    }

    /// Takes one field off the front of `rest`; true if a comma follows it.
    bool take_field(std::string_view& rest, std::string& field) {
        rest = rest.substr(std::min(rest.find_first_not_of(" \t"), rest.size()));
        if (!rest.starts_with('"')) {
            const std::size_t comma = rest.find(',');
            field = trimmed(rest.substr(0, comma));
            rest.remove_prefix(comma == std::string_view::npos ? rest.size() : comma + 1);
            return comma != std::string_view::npos;
        }
        for (rest.remove_prefix(1);;) {
            const std::size_t quote = rest.find('"');
            if (quote == std::string_view::npos) fail(fields_.size(), "the quote is not closed; add the closing \"");
            field += rest.substr(0, quote);
            rest.remove_prefix(quote + 1);
            if (!rest.starts_with('"')) break;
            field += '"';
            rest.remove_prefix(1);
        }
        rest = trimmed(rest);
        if (rest.empty()) return false;
        if (rest[0] != ',') fail(fields_.size(), "a comma must follow the closing quote");
        rest.remove_prefix(1);
        return true;
    }

    void read_header() {
        if (empty_)
            throw InputError(file_, at_line(1),
                             "the file is empty; give a header such as t,x,y,r and one sample a row");
        if (!lines_.next())
            throw InputError(file_, at_line(1), "holds only blank lines; give a header such as t,x,y,r");
        if (lines_.line().find(',') == std::string_view::npos) {
            if (lines_.line().find(';') != std::string_view::npos)
                fail("separate fields with commas, not semicolons (and write 0.5, not 0,5)");
            if (lines_.line().find('\t') != std::string_view::npos) fail("separate fields with commas, not tabs");
        }
        split(kMaxColumns);
        if (std::all_of(fields_.begin(), fields_.end(),
                        [](const std::string& f) { return parse_double(f).has_value(); })) {
            fail("there is no header; begin the file with a line that names the columns, such as t,x,y,r");
        }
        names_ = fields_;
        position_.fill(-1);
        for (std::size_t i = 0; i < names_.size(); ++i) {
            const auto known = std::find(kColumns.begin(), kColumns.end(), names_[i]);
            if (known == kColumns.end()) {
                const bool twice = std::find(names_.begin(), names_.begin() + static_cast<std::ptrdiff_t>(i),
                                             names_[i]) != names_.begin() + static_cast<std::ptrdiff_t>(i);
                if (twice) fail(i, "the column stands twice; remove one");
                others_.emplace_back(names_[i], i);
                continue;
            }
            int& position = position_[static_cast<std::size_t>(known - kColumns.begin())];
            if (position >= 0) fail(i, "the column stands twice; remove one");
            position = static_cast<int>(i);
        }
        for (const Column needed : {kX, kY}) {
            if (position_[needed] < 0) {
                fail("the header names no column " + std::string(kColumns[needed]) + "; it needs t,x,y,r or x,y,r");
            }
        }
    }

    std::string identifier() const {
        const auto column = static_cast<std::size_t>(position_[kId]);
        if (fields_[column].empty()) fail(column, "the field is empty; name the track");
        if (!is_utf8(fields_[column])) fail(column, "the name is no UTF-8 text; save the file as UTF-8");
        return fields_[column];
    }

    /// The number in a column, or 0 where the file has no such column.
    double number(Column which, double largest) const {
        if (position_[which] < 0) return 0;
        const auto column = static_cast<std::size_t>(position_[which]);
        const std::string& field = fields_[column];
        if (field.empty()) fail(column, "the field is empty; give a number");
        const std::optional<double> value = parse_double(field);
        if (!value) fail(column, in_quotes(field) + " is no finite number; write it like 0.25");
        if (std::abs(*value) > largest)
            fail(column, in_quotes(field) + " is beyond " + short_double(largest) + "; check the units");
        return *value;
    }

    TimedDisk row() const {
        const TimedDisk row{number(kT, mobb::kMaxTime),
                            {number(kX, mobb::kMaxLength), number(kY, mobb::kMaxLength), number(kR, mobb::kMaxLength)}};
        if (row.disk.r < 0) fail(static_cast<std::size_t>(position_[kR]), "the radius is negative; give 0 or more");
        return row;
    }

    void check_order(const std::vector<TimedDisk>& rows, const std::string& id) const {
        const double before = rows[rows.size() - 2].t;
        if (rows.back().t > before) return;
        fail(static_cast<std::size_t>(position_[kT]),
             "the time does not come after " + short_double(before) + " of the row before" +
                 (id.empty() ? "" : " of track " + in_quotes(id)) + "; sort the rows and remove doubles");
    }

    bool empty_;
    TextLines lines_;
    const std::string& file_;
    std::vector<std::string> fields_;
    std::vector<std::string> names_;
    std::array<int, kColumns.size()> position_{};              ///< of each known column in a row, or -1
    std::vector<std::pair<std::string, std::size_t>> others_;  ///< see CsvTable::others
};

}  // namespace

CsvTable parse_csv(std::string_view text, const std::string& file) { return CsvParser(text, file).parse(); }

std::string csv_field(std::string_view text) {
    if (text.find_first_of(",\"") == std::string_view::npos && trimmed(text) == text) return std::string(text);
    std::string out = "\"";
    for (const char c : text) {
        if (c == '"') out += '"';
        out += c;
    }
    return out + '"';
}

}  // namespace mobbscope
