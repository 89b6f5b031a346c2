// Tables to clips: samples, radii, and what a table offers to each option.
#include <import/tracks/csv.h>
#include <import/tracks/track_steps.h>

#include <algorithm>
#include <stdexcept>

namespace mobbscope {

namespace {

/// Metres per file unit. A CSV has no skeleton whose height would tell, so "auto" says nothing.
double unit_scale(const ImportOptions& options) {
    const std::string unit = options.unit.value_or("m");
    const std::optional<double> scale = metres_per_unit(unit);
    if (!scale)
        throw std::invalid_argument("unit " + in_quotes(unit) +
                                    " does not apply to CSV; give m, cm, in or metres per file unit");
    return *scale;
}

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

/// The rows of a track with radii from the column of CsvTable::others, if one is named, in r.
std::vector<TimedDisk> rows_of(const CsvTable& table, const CsvTrack& track, std::optional<std::size_t> column,
                               const std::string& file) {
    std::vector<TimedDisk> rows = track.rows;
    for (std::size_t i = 0; column && i < rows.size(); ++i) {
        const std::string& field = track.others[i][*column];
        const std::optional<double> value = parse_double(field);
        if (value && *value >= 0 && *value <= mobb::kMaxLength) {
            rows[i].disk.r = *value;
            continue;
        }
        throw InputError(file,
                         at_line(track.lines[i]) + ", column " + std::to_string(table.others[*column].second + 1) +
                             " (" + table.others[*column].first + ")",
                         in_quotes(field) + " is no radius; give a number from 0 to " + short_double(mobb::kMaxLength));
    }
    return rows;
}

/// A table with ids as the crowd that it is. `dt`: seconds between the rows of one without times.
TrackFile tracks_of(const CsvTable& table, std::optional<std::size_t> radius_column, double dt,
                    const std::string& file) {
    TrackFile out;
    out.format = "csv";
    out.timed = true;
    out.has_radius = table.has_radius || radius_column;
    out.least_step.reset();
    for (const CsvTrack& track : table.tracks) {
        const std::vector<TimedDisk> rows = rows_of(table, track, radius_column, file);
        Track& points = out.tracks.emplace_back(Track{track.id, {}});
        points.points.reserve(rows.size());
        for (std::size_t i = 0; i < rows.size(); ++i) {
            const double t = table.has_time ? rows[i].t : static_cast<double>(i) * dt;
            points.points.push_back({t, rows[i].disk.x, rows[i].disk.y, track.lines[i], rows[i].disk.r});
        }
    }
    if (!table.has_time) {
        out.least_step = dt;
        out.warnings.push_back("the rows have no times: all tracks start together, with a row every " + brief(dt) +
                               " s; name a column t if they do not");
    }
    return out;
}

/// What is refused of a table with ids and of one without.
void check_columns(const CsvTable& table, const std::string& file, const ImportOptions& options) {
    if (options.id && !table.has_id) throw InputError(file, "line 1", "the header names no column id; leave id out");
    if (!table.has_radius && !options.radius)
        throw InputError(file, "line 1", "the header names no column r; add one or give radius (metres)");
    if (!table.has_time && !options.dt)
        throw InputError(file, "line 1", "the header names no column t; name one or give dt (seconds between rows)");
}

/// Without ids the rows are one motion.
class MotionMaker {
  public:
    MotionMaker(const CsvTable& table, std::vector<TimedDisk> rows, const ImportOptions& options)
        : table_(table), track_(table.tracks.front()), rows_(std::move(rows)), options_(options) {}

    ImportedClip make() {
        const double scale = unit_scale(options_);
        SourceFacts facts{"csv", scale, static_cast<int>(rows_.size()), std::nullopt, 0, {}};
        const std::optional<double> stored_dt = spacing(facts);
        facts.dt = stored_dt;
        facts.duration = rows_.back().t - rows_.front().t;

        const double fps = options_.fps.value_or(kDefaultFps);
        const double step = stored_dt.value_or(1 / fps);
        if (!stored_dt) facts.warnings.push_back({resampled(fps), "fps"});
        if (rows_.size() == 1) facts.warnings.push_back({"there is one row: it holds for " + brief(step) + " s", "dt"});
        // The last row still holds for a step.
        if (options_.trim && options_.trim->second > facts.duration + step) {
            facts.warnings.push_back({"trim ends at " + brief(options_.trim->second) + " s, but the rows last " +
                                          brief(facts.duration) + " s; all of them to the end are taken",
                                      "trim"});
        }
        std::vector<mobb::Disk> samples;
        if (stored_dt && !options_.trim) {
            for (const TimedDisk& row : rows_) samples.push_back(row.disk);
        } else {
            samples = sample(rows_, sample_grid(rows_.front().t, rows_.back().t, options_.trim, step, kMaxSamples));
        }
        const bool in_column = !options_.radius || std::holds_alternative<RadiusColumn>(*options_.radius);
        const double radius = in_column ? 0 : metres_of(*options_.radius, "", "");
        for (mobb::Disk& disk : samples) {
            disk = {disk.x * scale, disk.y * scale, in_column ? disk.r * scale : radius};
        }
        put_at_origin(samples, options_.origin.value_or(Origin::keep));
        ImportedClip out;
        out.clip = std::make_shared<mobb::Clip>(step, std::move(samples), options_.motion.value_or(mobb::Motion::held));
        out.facts = std::move(facts);
        return out;
    }

  private:
    std::string resampled(double fps) const {
        const std::size_t row = *first_out_of_step(rows_);
        const double dt = (rows_.back().t - rows_.front().t) / static_cast<double>(rows_.size() - 1);
        return "the times are not uniform (line " + std::to_string(track_.lines[row]) + ": " +
               to_thousandth(rows_[row].t) + " s, in step would be " +
               to_thousandth(rows_.front().t + static_cast<double>(row) * dt) + " s); the path is resampled at " +
               brief(fps) + " fps";
    }

    /// The rows' uniform spacing in seconds, or none. Gives rows without a time column their times.
    std::optional<double> spacing(SourceFacts& facts) {
        if (options_.fps && (!table_.has_time || rows_.size() == 1 || is_uniform(rows_))) {
            facts.warnings.push_back({"fps does not apply: the rows are uniform in time and are the samples", "fps"});
        }
        if (!table_.has_time) {
            for (std::size_t i = 0; i < rows_.size(); ++i) rows_[i].t = static_cast<double>(i) * *options_.dt;
            return options_.dt;
        }
        if (rows_.size() == 1) {
            if (!options_.dt) throw std::invalid_argument("one row does not tell how long it lasts; give dt (seconds)");
            return options_.dt;
        }
        if (options_.dt) facts.warnings.push_back({"dt does not apply: the column t gives the times", "dt"});
        if (!is_uniform(rows_)) return std::nullopt;
        return (rows_.back().t - rows_.front().t) / static_cast<double>(rows_.size() - 1);
    }

    const CsvTable& table_;
    const CsvTrack& track_;
    std::vector<TimedDisk> rows_;
    const ImportOptions& options_;
};

}  // namespace

std::vector<ImportedClip> csv_clips(const CsvTable& table, const std::filesystem::path& file,
                                    const ImportOptions& options) {
    refuse_skeleton_options(options, file, "CSV");
    const std::string name = file.string();
    const std::optional<std::size_t> radii = at_place(name, "", [&] {
        unit_scale(options);
        return radius_column(table, options);
    });
    check_columns(table, name, options);
    if (!table.has_id) {
        return clips_by_track(table.tracks, file, options, [&](const CsvTrack& track) {
            return std::optional(MotionMaker(table, rows_of(table, track, radii, name), options).make());
        });
    }
    ImportOptions of_tracks = options;
    // What these say is in the tracks already.
    if (options.radius && std::holds_alternative<RadiusColumn>(*options.radius)) of_tracks.radius.reset();
    if (!table.has_time) of_tracks.dt.reset();
    return track_clips(tracks_of(table, radii, options.dt.value_or(0), name), file, of_tracks);
}

ImportOffer csv_offer(const CsvTable& table, const std::filesystem::path& file, const ImportOptions& options) {
    ImportOffer out;
    double first = table.tracks.front().rows.front().t;
    double last = first;
    bool uniform = true;
    bool alone = true;  // every track has one row
    for (const CsvTrack& track : table.tracks) {
        const std::size_t rows = track.rows.size();
        first = std::min(first, track.rows.front().t);
        last = std::max(last,
                        table.has_time ? track.rows.back().t : static_cast<double>(rows - 1) * options.dt.value_or(0));
        alone = alone && rows == 1;
        if (table.has_time && !table.has_id) uniform = rows == 1 || is_uniform(track.rows);
    }
    out.seconds = last - first;
    if (table.has_time && table.has_id && !alone) {
        const std::vector<Track> tracks = tracks_of(table, std::nullopt, 0, file.string()).tracks;
        const double usual = *most_frequent_step(tracks);
        uniform = std::ranges::all_of(tracks, [&](const Track& t) { return grid_of(t, usual).in_step; });
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
    if (!table.has_time || alone) {
        out.options.push_back(
            {"dt", "", table.has_time ? "one row does not tell how long it lasts" : "the file has no column t", true});
    }
    out.options.push_back(
        motion_option_offer(table.has_id ? kMotionOfTracks : mobb::Motion::held,
                            table.has_id ? "as usual of tables with ids" : "as usual of tables without ids"));
    return out;
}

}  // namespace mobbscope
