// Tables to clips: samples, radii, and what a table offers to each option.
#include <import/tracks/csv.h>
#include <import/tracks/tracks.h>

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

/// Tables with ids are tracks of people, whose rows are far apart; those without are mostly sampled motions.
mobb::Motion usual_motion(const CsvTable& table) { return table.has_id ? mobb::Motion::linear : mobb::Motion::held; }

/// Makes clips of tracks; messages are for import of one file.
class ClipMaker {
  public:
    ClipMaker(const CsvTable& table, const std::string& file, const ImportOptions& options)
        : table_(table),
          file_(file),
          options_(options),
          scale_(unit_scale(options)),
          first_(table.tracks.front().rows.front().t) {
        for (const CsvTrack& track : table.tracks) first_ = std::min(first_, track.rows.front().t);
    }

    ImportedClip make(const CsvTrack& track) {
        std::vector<TimedDisk> rows = track.rows;
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
    double first_;           ///< the earliest time of all tracks, seconds
    std::size_t count_ = 0;  ///< samples made so far, of all tracks
};

}  // namespace

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
    for (const std::string& name : table.others) out.options.back().choices.push_back({name, "the column " + name});
    if (!timed) {
        out.options.push_back(
            {"dt", "", table.has_time ? "one row does not tell how long it lasts" : "the file has no column t", true});
    }
    out.options.push_back(motion_option_offer(
        usual_motion(table), table.has_id ? "as usual of tables with ids" : "as usual of tables without ids"));
    return out;
}

}  // namespace mobbscope
