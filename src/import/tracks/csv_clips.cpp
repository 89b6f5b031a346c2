// Tables to clips: samples, radii, and what a table offers to each option.
#include <import/clip/sample_times.h>
#include <import/clip/sampling.h>
#include <import/tracks/csv.h>
#include <import/tracks/track_steps.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace mobbscope {

namespace {

/// Metres per unit of x, y and r. A table has no skeleton whose height would tell, so "auto" says nothing.
double unit_scale(const CsvTable& table, const ImportOptions& options) {
    if (!options.unit) return table.unit;
    const std::optional<double> scale = metres_per_unit(*options.unit);
    if (!scale)
        throw std::invalid_argument("unit " + in_quotes(*options.unit) +
                                    " does not apply to CSV; give m, cm, in or metres per file unit");
    return *scale;
}

/// What is said where the table tells another unit than metres.
std::string unit_remark(const CsvTable& table) {
    if (table.unit == 1) return "";
    return "a unit of length is " + format_double(table.unit) + " m, as " + table.unit_why +
           " says; give unit if that is wrong";
}

/// Frames per second of a table with frame numbers where no dt is given; fps counts them then.
std::optional<double> frame_rate(const CsvTable& table, const ImportOptions& options) {
    return options.fps ? options.fps : table.rate;
}

/// A table with ids as the crowd that it is. `dt`: seconds between the rows of one without times; `rate`: frames per
/// second of one with frame numbers.
TrackFile tracks_of(const CsvTable& table, double dt, double rate) {
    TrackFile out;
    out.format = "csv";
    out.timed = !table.has_frame;
    if (table.has_frame) out.rate = rate;
    out.has_radius = table.has_radius;
    out.unit = table.unit;
    out.unit_assumption = unit_remark(table);
    if (!table.has_frame) out.least_step.reset();
    out.rounding = table.rounding;
    const bool has_when = table.has_time || table.has_frame;
    out.tracks = table.tracks;
    if (!has_when) {
        for (Track& track : out.tracks) {
            for (std::size_t i = 0; i < track.points.size(); ++i) track.points[i].frame = static_cast<double>(i) * dt;
        }
        out.least_step = dt;
        out.warnings.push_back("the rows have no times: all tracks start together, with a row every " + brief(dt) +
                               " s; name a column t if they do not");
    }
    return out;
}

/// What is refused of a table with ids and of one without.
void check_columns(const CsvTable& table, const std::string& file, const ImportOptions& options) {
    const std::string header = at_line(table.header_line);
    if (options.id && !table.has_id) throw InputError(file, header, "the header names no column id; leave id out");
    // People have a usual radius.
    if (!table.has_radius && !options.radius && !table.has_id)
        throw InputError(file, header, "the header names no column r; add one or give radius (metres)");
    if (table.has_frame && !options.dt && !frame_rate(table, options)) {
        throw InputError(file, header,
                         "the rows have frame numbers in place of times: give fps (frames a second), or dt (seconds "
                         "from one frame to the next)");
    }
    if (!table.has_time && !table.has_frame && !options.dt)
        throw InputError(file, header, "the header names no column t; name one or give dt (seconds between rows)");
}

std::vector<TimedDisk> timed(const Track& track) {
    std::vector<TimedDisk> out;
    out.reserve(track.points.size());
    for (const TrackPoint& row : track.points) out.push_back({row.frame, {row.x, row.y, row.r}});
    return out;
}

/// Without ids the rows are one motion.
class MotionMaker {
  public:
    MotionMaker(const CsvTable& table, const ImportOptions& options)
        : table_(table),
          track_(table.tracks.front()),
          rows_(timed(track_)),
          options_(options),
          has_time_(table.has_time || table.has_frame),
          scale_(unit_scale(table, options)) {
        if (!options.unit && table.unit != 1) warnings_.push_back({unit_remark(table), "unit"});
        if (!table.has_frame) return;
        // What makes seconds of frames is no rate of samples, and no time between rows.
        for (TimedDisk& row : rows_) row.t = options.dt ? row.t * *options.dt : row.t / *frame_rate(table, options);
        if (options.dt) {
            if (rows_.size() > 1) options_.dt.reset();
        } else {
            if (rows_.size() == 1) options_.dt = 1 / *frame_rate(table, options);
            options_.fps.reset();
        }
    }

    ImportedClip make() {
        SourceFacts facts{"csv", scale_, static_cast<int>(rows_.size()), std::nullopt, 0, warnings_};
        const std::optional<double> stored_dt = spacing(facts);
        facts.dt = stored_dt;
        facts.duration = rows_.back().t - rows_.front().t;

        const double fps = options_.fps.value_or(kDefaultFps);
        const double step = stored_dt.value_or(1 / fps);
        if (has_time_ && rows_.size() > 1) {
            const double between = (rows_.back().t - rows_.front().t) / static_cast<double>(rows_.size() - 1);
            check_file_times(between, std::max(std::abs(rows_.front().t), std::abs(rows_.back().t)));
        }
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
            if (rows_.size() > kMaxSamples)
                throw std::invalid_argument("there are more than " + std::to_string(kMaxSamples) +
                                            " rows; give trim, or split the file");
            samples.reserve(rows_.size());
            for (const TimedDisk& row : rows_) samples.push_back(row.disk);
        } else {
            samples = sample(rows_, sample_grid(rows_.front().t, rows_.back().t, options_.trim, step,
                                                std::min(kMaxSamples, most_made(rows_.size()))));
        }
        const bool in_column = !options_.radius || std::holds_alternative<RadiusColumn>(*options_.radius);
        const double radius = in_column ? 0 : metres_of(*options_.radius, "", "");
        for (mobb::Disk& disk : samples) {
            disk = {disk.x * scale_, disk.y * scale_, in_column ? disk.r * scale_ : radius};
        }
        put_at_origin(samples, options_.origin.value_or(Origin::keep));
        ImportedClip out;
        out.clip = std::make_shared<mobb::Clip>(step, std::move(samples), options_.motion.value_or(mobb::Motion::held));
        out.facts = std::move(facts);
        return out;
    }

  private:
    std::string resampled(double fps) const {
        const std::size_t row = *first_out_of_step(rows_, table_.rounding);
        const double dt = (rows_.back().t - rows_.front().t) / static_cast<double>(rows_.size() - 1);
        return "the times are not uniform (line " + std::to_string(track_.points[row].line) + ": " +
               to_thousandth(rows_[row].t) + " s, in step would be " +
               to_thousandth(rows_.front().t + static_cast<double>(row) * dt) + " s); the path is resampled at " +
               brief(fps) + " fps";
    }

    /// The rows' uniform spacing in seconds, or none. Gives rows without a time column their times.
    std::optional<double> spacing(SourceFacts& facts) {
        if (options_.fps && (!has_time_ || rows_.size() == 1 || is_uniform(rows_, table_.rounding))) {
            facts.warnings.push_back({"fps does not apply: the rows are uniform in time and are the samples", "fps"});
        }
        if (!has_time_) {
            for (std::size_t i = 0; i < rows_.size(); ++i) rows_[i].t = static_cast<double>(i) * *options_.dt;
            return options_.dt;
        }
        if (rows_.size() == 1) {
            if (!options_.dt) throw std::invalid_argument("one row does not tell how long it lasts; give dt (seconds)");
            return options_.dt;
        }
        if (options_.dt) facts.warnings.push_back({"dt does not apply: the column t gives the times", "dt"});
        if (!is_uniform(rows_, table_.rounding)) return std::nullopt;
        return (rows_.back().t - rows_.front().t) / static_cast<double>(rows_.size() - 1);
    }

    const CsvTable& table_;
    const Track& track_;
    std::vector<TimedDisk> rows_;
    ImportOptions options_;
    bool has_time_;
    double scale_;
    std::vector<ImportWarning> warnings_;
};

}  // namespace

std::vector<ImportedClip> csv_clips(const CsvTable& table, const std::filesystem::path& file,
                                    const ImportOptions& options) {
    refuse_skeleton_options(options, file, "CSV");
    const std::string name = file.string();
    at_place(name, "", [&] { unit_scale(table, options); });
    check_columns(table, name, options);
    std::vector<ImportedClip> clips;
    if (table.has_id) {
        ImportOptions of_tracks = options;
        // What these say is in the tracks already.
        if (options.radius && std::holds_alternative<RadiusColumn>(*options.radius)) of_tracks.radius.reset();
        if (!table.has_time && !table.has_frame) of_tracks.dt.reset();
        if (table.has_frame && !options.dt) of_tracks.fps.reset();
        clips = track_clips(tracks_of(table, options.dt.value_or(0), frame_rate(table, options).value_or(1)), file,
                            of_tracks);
    } else {
        clips = clips_by_track(table.tracks, file, options,
                               [&](const Track&) { return std::optional(MotionMaker(table, options).make()); });
    }
    for (ImportedClip& clip : clips) {
        clip.facts.warnings.insert(clip.facts.warnings.begin(), table.warnings.begin(), table.warnings.end());
    }
    return clips;
}

ImportOffer csv_offer(const CsvTable& table, const std::filesystem::path&, const ImportOptions& options) {
    ImportOffer out;
    const std::optional<double> rate = options.dt ? std::optional(1 / *options.dt) : frame_rate(table, options);
    const bool has_when = table.has_time || table.has_frame;
    double first = table.tracks.front().points.front().frame;
    double last = first;
    bool uniform = true;
    bool alone = true;  // every track has one row
    for (const Track& track : table.tracks) {
        const std::size_t rows = track.points.size();
        first = std::min(first, track.points.front().frame);
        last = std::max(last,
                        has_when ? track.points.back().frame : static_cast<double>(rows - 1) * options.dt.value_or(0));
        alone = alone && rows == 1;
        if (has_when && !table.has_id) uniform = rows == 1 || is_uniform(timed(track), table.rounding);
    }
    out.seconds =
        table.has_frame ? (last - first) / rate.value_or(std::numeric_limits<double>::infinity()) : last - first;
    if (has_when && table.has_id && !alone) {
        const double usual = *most_frequent_step(table.tracks, table.rounding);
        uniform = std::ranges::all_of(table.tracks,
                                      [&](const Track& t) { return grid_of(t, usual, table.rounding).in_step; });
    }
    // Rows in step are the samples.
    if (table.has_frame && !options.dt) {
        out.options.push_back({"fps", table.rate ? format_double(*table.rate) : "",
                               table.rate ? "as a comment says" : "the file does not say its frames a second",
                               !table.rate});
    } else if (!uniform) {
        out.options.push_back({"fps", format_double(kDefaultFps), "as usual; the rows are not uniform in time"});
    }
    out.options.push_back(unit_offer(table.unit, table.unit == 1 ? "as usual of CSV files" : unit_remark(table)));
    if (out.seconds > 0) out.options.push_back({"trim", "", "all of it"});
    out.options.push_back(origin_offer());
    if (table.tracks.size() > 1) out.options.push_back(id_offer(table.tracks));
    const bool is_usual = table.has_id && !table.has_radius;
    out.options.push_back({"radius", is_usual ? format_double(kDefaultTrackRadius) : "",
                           table.has_radius ? "the column r" : "the file has no column r",
                           !table.has_radius && !table.has_id});
    for (const std::string& name : table.others) out.options.back().choices.push_back({name, "the column " + name});
    if (!has_when || (alone && !table.has_frame)) {
        out.options.push_back(
            {"dt", "", has_when ? "one row does not tell how long it lasts" : "the file has no column t", true});
    }
    out.options.push_back({"columns", "", "by their names"});
    out.options.push_back(
        motion_option_offer(table.has_id ? kMotionOfTracks : mobb::Motion::held,
                            table.has_id ? "as usual of tables with ids" : "as usual of tables without ids"));
    return out;
}

}  // namespace mobbscope
