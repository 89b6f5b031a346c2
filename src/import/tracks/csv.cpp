#include <import/tracks/csv.h>
#include <import/tracks/tracks.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
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

/// Metres per file unit. A CSV has no skeleton whose height would tell, so "auto" says nothing.
double unit_scale(const ImportOptions& options) {
    const std::string unit = options.unit.value_or("m");
    const std::optional<double> scale = metres_per_unit(unit);
    if (!scale)
        throw std::invalid_argument("unit " + in_quotes(unit) +
                                    " does not apply to CSV; give m, cm, in or metres per file unit");
    return *scale;
}

/// Tables with ids are tracks of people, whose rows are far apart; those without are mostly sampled motions.
mobb::Motion usual_motion(const CsvTable& table) { return table.has_id ? mobb::Motion::linear : mobb::Motion::held; }

/// Which of CsvTable::others has the radii; none: r, or metres. Every other such column is an error.
std::optional<std::size_t> radius_column(const CsvTable& table, const ImportOptions& options) {
    const RadiusColumn* const wanted = options.radius ? std::get_if<RadiusColumn>(&*options.radius) : nullptr;
    std::optional<std::size_t> found;
    std::vector<std::string> names;
    for (std::size_t i = 0; i < table.others.size(); ++i) {
        names.push_back(table.others[i].first);
        if (wanted && names.back() == wanted->name) found = i;
    }
    if (table.has_radius) names.emplace_back("r");
    if (wanted && !found && !(table.has_radius && wanted->name == "r")) {
        throw std::invalid_argument("line 1: the header names no column " + in_quotes(wanted->name) + " of radii" +
                                    did_you_mean(wanted->name, names) + "; give metres, or a column that it names");
    }
    for (std::size_t i = 0; i < table.others.size(); ++i) {
        if (i == found) continue;
        throw std::invalid_argument("line 1, column " + std::to_string(table.others[i].second + 1) + ": the column " +
                                    in_quotes(names[i]) + " is unknown; the header may name id, t, x, y and r");
    }
    return found;
}

/// Makes clips of tracks; messages are for import of one file.
class ClipMaker {
  public:
    ClipMaker(const CsvTable& table, const std::string& file, const ImportOptions& options)
        : table_(table),
          file_(file),
          options_(options),
          scale_(unit_scale(options)),
          radius_column_(radius_column(table, options)),
          first_(table.tracks.front().rows.front().t) {
        for (const CsvTrack& track : table.tracks) first_ = std::min(first_, track.rows.front().t);
    }

    ImportedClip make(const CsvTrack& track) {
        std::vector<TimedDisk> rows = track.rows;
        if (radius_column_) take_radii(track, rows);
        SourceFacts facts{"csv", scale_, static_cast<int>(rows.size()), std::nullopt, 0, {}};
        const std::optional<double> stored_dt = spacing(rows, facts);
        facts.dt = stored_dt;
        facts.duration = rows.back().t - rows.front().t;

        const double fps = options_.fps.value_or(kDefaultFps);
        const double step = stored_dt.value_or(1 / fps);
        if (!stored_dt) facts.warnings.push_back({resampled(track, fps), "fps"});
        if (rows.size() == 1) facts.warnings.push_back({"there is one row: it holds for " + brief(step) + " s", "dt"});
        // The last row still holds for a step.
        if (options_.trim && options_.trim->second > facts.duration + step) {
            facts.warnings.push_back({"trim ends at " + brief(options_.trim->second) + " s, but the rows last " +
                                          brief(facts.duration) + " s; all of them to the end are taken",
                                      "trim"});
        }
        std::vector<mobb::Disk> samples;
        if (stored_dt && !options_.trim) {
            for (const TimedDisk& row : rows) samples.push_back(row.disk);
        } else {
            samples = sampled(rows, step);
        }
        count_ += samples.size();
        const bool in_column = !options_.radius || std::holds_alternative<RadiusColumn>(*options_.radius);
        const double radius = in_column ? 0 : metres_of(*options_.radius, track.id, "");
        for (mobb::Disk& disk : samples) {
            disk = {disk.x * scale_, disk.y * scale_, in_column ? disk.r * scale_ : radius};
        }
        put_at_origin(samples, options_.origin.value_or(Origin::keep));
        const mobb::Motion motion = options_.motion.value_or(usual_motion(table_));
        ImportedClip out{"", track.id, std::make_shared<mobb::Clip>(step, std::move(samples), motion),
                         std::move(facts)};
        out.start = track.rows.front().t - first_;
        return out;
    }

  private:
    /// Into r, from the column that the options name.
    void take_radii(const CsvTrack& track, std::vector<TimedDisk>& rows) const {
        for (std::size_t i = 0; i < rows.size(); ++i) {
            const std::string& field = track.others[i][*radius_column_];
            const std::optional<double> value = parse_double(field);
            if (value && *value >= 0 && *value <= mobb::kMaxLength) {
                rows[i].disk.r = *value;
                continue;
            }
            throw InputError(
                file_,
                at_line(track.lines[i]) + ", column " + std::to_string(table_.others[*radius_column_].second + 1) +
                    " (" + table_.others[*radius_column_].first + ")",
                in_quotes(field) + " is no radius; give a number from 0 to " + short_double(mobb::kMaxLength));
        }
    }

    static std::string resampled(const CsvTrack& track, double fps) {
        const std::vector<TimedDisk>& rows = track.rows;
        const std::size_t row = *first_out_of_step(rows);
        const double dt = (rows.back().t - rows.front().t) / static_cast<double>(rows.size() - 1);
        return "the times are not uniform (line " + std::to_string(track.lines[row]) + ": " + brief(rows[row].t) +
               " s, in step would be " + brief(rows.front().t + static_cast<double>(row) * dt) +
               " s); the path is resampled at " + brief(fps) + " fps";
    }

    /// The rows' uniform spacing in seconds, or none. Gives rows without a time column their times.
    std::optional<double> spacing(std::vector<TimedDisk>& rows, SourceFacts& facts) const {
        if (options_.fps && (!table_.has_time || rows.size() == 1 || is_uniform(rows))) {
            facts.warnings.push_back({"fps does not apply: the rows are uniform in time and are the samples", "fps"});
        }
        if (!table_.has_time || rows.size() == 1) {
            if (!options_.dt) {
                throw std::invalid_argument(table_.has_time
                                                ? "one row does not tell how long it lasts; give dt (seconds)"
                                                : "there is no column t; name one or give dt (seconds between rows)");
            }
            for (std::size_t i = 0; i < rows.size(); ++i) {
                rows[i].t = table_.has_time ? rows[i].t : static_cast<double>(i) * *options_.dt;
            }
            return options_.dt;
        }
        if (options_.dt) facts.warnings.push_back({"dt does not apply: the column t gives the times", "dt"});
        if (!is_uniform(rows)) return std::nullopt;
        return (rows.back().t - rows.front().t) / static_cast<double>(rows.size() - 1);
    }

    std::vector<mobb::Disk> sampled(const std::vector<TimedDisk>& rows, double step) const {
        const std::size_t most = kMaxSamples - std::min(count_, kMaxSamples);
        return sample(rows, sample_grid(rows.front().t, rows.back().t, options_.trim, step, most));
    }

    const CsvTable& table_;
    const std::string& file_;
    const ImportOptions& options_;
    double scale_;
    std::optional<std::size_t> radius_column_;  ///< index into CsvTable::others
    double first_;                              ///< the earliest time of all tracks, seconds
    std::size_t count_ = 0;                     ///< samples made so far, of all tracks
};

}  // namespace

CsvTable parse_csv(std::string_view text, const std::string& file) { return CsvParser(text, file).parse(); }

std::vector<ImportedClip> csv_clips(const CsvTable& table, const std::filesystem::path& file,
                                    const ImportOptions& options) {
    refuse_skeleton_options(options, file, "CSV");
    const std::string name = file.string();
    if (options.id && !table.has_id) throw InputError(name, "line 1", "the header names no column id; leave id out");

    ClipMaker maker = at_place(name, "", [&] { return ClipMaker(table, name, options); });
    if (!table.has_radius && !options.radius) {
        throw InputError(name, "line 1", "the header names no column r; add one or give radius (metres)");
    }
    return clips_by_track(table.tracks, file, options,
                          [&](const CsvTrack& track) { return std::optional(maker.make(track)); });
}

ImportOffer csv_offer(const CsvTable& table, const std::filesystem::path&, const ImportOptions& options) {
    ImportOffer out;
    bool uniform = true;
    bool timed = table.has_time;
    for (const CsvTrack& track : table.tracks) {
        const std::size_t rows = track.rows.size();
        const double last = table.has_time ? track.rows.back().t - track.rows.front().t
                                           : static_cast<double>(rows - 1) * options.dt.value_or(0);
        out.seconds = std::max(out.seconds, last);
        uniform = uniform && (!table.has_time || rows == 1 || is_uniform(track.rows));
        timed = timed && rows > 1;
    }
    // Rows in step are the samples.
    if (!uniform)
        out.options.push_back({"fps", short_double(kDefaultFps), "as usual; the rows are not uniform in time"});
    out.options.push_back(unit_offer(1, "as usual of CSV files"));
    if (out.seconds > 0) out.options.push_back({"trim", "", "all of it"});
    out.options.push_back(origin_offer());
    if (table.tracks.size() > 1) out.options.push_back(id_offer(table.tracks));
    out.options.push_back(
        {"radius", "", table.has_radius ? "the column r" : "the file has no column r", !table.has_radius});
    for (const auto& [name, column] : table.others) out.options.back().choices.push_back({name, "the column " + name});
    if (!timed) {
        out.options.push_back(
            {"dt", "", table.has_time ? "one row does not tell how long it lasts" : "the file has no column t", true});
    }
    out.options.push_back(motion_option_offer(
        usual_motion(table), table.has_id ? "as usual of tables with ids" : "as usual of tables without ids"));
    return out;
}

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
