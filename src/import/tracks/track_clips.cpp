#include <import/clip/sample_times.h>
#include <import/clip/sampling.h>
#include <import/tracks/track_steps.h>
#include <import/tracks/tracks.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <stdexcept>
#include <utility>

namespace mobbscope {

namespace {

// A damaged frame number leaves a gap of any length: what fills gaps may be so many times what the file holds.
constexpr std::size_t kMaxFill = 100;
constexpr std::size_t kAlwaysFilled = 10'000;
/// The radius where no option says one.
double default_radius(const Track& track) { return class_radius(track.label).value_or(kDefaultTrackRadius); }

/// What default_radius takes: by class where the file has classes.
std::string assumed_radius(const TrackFile& file) {
    std::map<std::string, int> tracks;  // by class
    for (const Track& track : file.tracks) ++tracks[track.label];
    std::string taken = brief(kDefaultTrackRadius) + " m";
    if (tracks.size() > 1 || !tracks.contains("")) {
        taken = "by class";
        const char* separator = " ";
        for (const auto& [label, count] : tracks) {
            const std::optional<double> known = class_radius(label);
            taken += separator + (label.empty() ? "none" : in_quotes(label)) + ' ' +
                     brief(known.value_or(kDefaultTrackRadius)) + " m (" + counted(count, "track", "tracks") +
                     (known || label.empty() ? ")" : ", a class without a usual radius)");
            separator = ", ";
        }
    }
    return "the file has no radii: " + taken + " are taken; give radius if that is wrong";
}

/// Of a file of radii, which of its keys the tracks lack; empty: none, or another kind of radius.
std::string unused_radii(const TrackFile& file, const Radius& radius) {
    const auto* const table = std::get_if<std::shared_ptr<const RadiusTable>>(&radius);
    if (!table) return "";
    std::set<std::string> keys;
    for (const Track& track : file.tracks) keys.insert((*table)->by_class ? track.label : track.id);
    std::vector<std::string> unused;
    for (const auto& [key, metres] : (*table)->radii) {
        if (!keys.contains(key)) unused.push_back(key);
    }
    if (unused.empty()) return "";
    return (*table)->file + " has radii of " +
           (unused.size() == 1 ? in_quotes(unused.front()) + ", which is"
                               : std::to_string(unused.size()) + " that are") +
           " not in the file" + (unused.size() == 1 ? "" : ", such as " + in_quotes(unused.front()));
}

/// Frame numbers to seconds.
class FrameClock {
  public:
    FrameClock(const TrackFile& file, const ImportOptions& options) {
        first_ = file.tracks.front().points.front().frame;
        last_ = first_;
        for (const Track& track : file.tracks) {
            first_ = std::min(first_, track.points.front().frame);
            last_ = std::max(last_, track.points.back().frame);
        }
        const std::optional<double> step = most_frequent_step(file.tracks, file.rounding);
        if (!step && !file.least_step && !options.dt) {
            throw std::invalid_argument(
                "every track has one row, which does not tell how long it lasts; give dt (seconds)");
        }
        step_ = step ? *step : file.least_step ? *file.least_step : *options.dt;
        if (!file.timed) frame_time_ = options.dt;
        rate_ = file.rate_of_steps ? file.rate * step_ : file.rate;
    }

    /// Dividing by the rate gives the nearest double, which multiplying by its inverse does not.
    double seconds(double frames) const { return frame_time_ ? frames * *frame_time_ : frames / rate_; }
    /// Since the file's first frame.
    double time(double frame) const { return seconds(frame - first_); }
    double t0() const { return seconds(first_); }
    double end() const { return seconds(last_); }
    double duration() const { return seconds(last_ - first_); }
    double usual_step() const { return step_; }  ///< frames

  private:
    std::optional<double> frame_time_;
    double rate_ = 1;
    double first_ = 0;
    double last_ = 0;
    double step_ = 1;
};

/// The line of the first point that does not come one step after the one before, or of the only one.
int line_out_of_step(std::span<const TrackPoint> points, double step, double rounding) {
    for (std::size_t i = 1; i < points.size(); ++i) {
        const double between = points[i].frame - points[i - 1].frame;
        if (std::abs(between - step) > 2 * time_tolerance(step, rounding)) return points[i].line;
    }
    return points.back().line;
}

class TrackClipMaker {
  public:
    /// Refers to the file and the options.
    TrackClipMaker(const TrackFile& file, const ImportOptions& options)
        : file_(file), options_(options), clock_(file, options), common_{file.format,  file.unit, 0,
                                                                         std::nullopt, 0,         {}} {
        common_.t0 = clock_.t0();
        for (const std::string& warning : file.warnings) common_.warnings.push_back({warning});
        std::size_t points = 0;
        for (const Track& track : file.tracks) points += track.points.size();
        most_made_ = std::min(kMaxSamples, most_made(points));
        most_filled_ = most_made_;
        if (!options.fps) most_filled_ = std::min(most_made_, kMaxFill * points + kAlwaysFilled);
        if (!(clock_.duration() <= mobb::kMaxTime)) {
            throw std::invalid_argument("its frames last " + brief(clock_.duration()) + " s, over " +
                                        format_double(mobb::kMaxTime) + "; check them");
        }
        if (file.timed) check_file_times(usual_step(), std::max(std::abs(clock_.t0()), std::abs(clock_.end())));
        if (!options.dt && !file.rate_assumption.empty()) common_.warnings.push_back({file.rate_assumption, "dt"});
        if (options.unit && *options.unit != "auto") {
            common_.unit = *metres_per_unit(*options.unit);
        } else if (!file.unit_assumption.empty()) {
            common_.warnings.push_back({file.unit_assumption, "unit"});
            common_.guessed_from_height = file.guessed_height;
        }
        const std::string remark = options.radius    ? unused_radii(file, *options.radius)
                                   : file.has_radius ? ""
                                                     : assumed_radius(file);
        if (!remark.empty()) common_.warnings.push_back({remark, "radius"});
        if (options.trim && options.trim->second > clock_.duration() + clock_.seconds(clock_.usual_step())) {
            common_.warnings.push_back({"trim ends at " + brief(options.trim->second) + " s, but the file lasts " +
                                            brief(clock_.duration()) + " s; all to the end is taken",
                                        "trim"});
        }
    }

    double duration() const { return clock_.duration(); }
    double frame_time() const { return clock_.seconds(1); }
    double usual_step() const { return clock_.seconds(clock_.usual_step()); }

    /// Nothing if the track is not there in the time that is taken.
    std::optional<ImportedClip> make(const Track& track) {
        const std::span<const TrackPoint> points = track.points;
        TrackGrid grid = grid_of(track, clock_.usual_step(), file_.rounding);
        SourceFacts facts = common_;
        facts.label = track.label;
        facts.frames = static_cast<int>(points.size());
        facts.duration = clock_.seconds(points.back().frame - points.front().frame);
        if (points.size() == 1 && file_.timed && options_.dt) grid.step = *options_.dt;
        if (grid.in_step && !grid.has_gaps) facts.dt = clock_.seconds(grid.step);
        warn_of(points, grid, facts.warnings);

        const bool resampled = !grid.in_step || (options_.fps && !file_.timed);
        const double fps = options_.fps.value_or(kDefaultFps);
        const double dt = resampled ? 1 / fps : clock_.seconds(grid.step);
        if (resampled) grid.steps = sample_count(0, facts.duration, dt) - 1;

        // The part that is taken.
        const double start = clock_.time(points.front().frame);
        double first = 0;
        double last = grid.steps;
        if (options_.trim) {
            first = std::max(first, std::ceil((options_.trim->first - start) / dt - kFrameTolerance));
            last = std::min(last, std::floor((options_.trim->second - start) / dt + kFrameTolerance));
        }
        if (first > last) return std::nullopt;
        const std::size_t most = grid.has_gaps ? most_filled_ : resampled ? most_made_ : kMaxSamples;
        if (last - first >= static_cast<double>(most - std::min(count_, most))) {
            throw std::invalid_argument("its times make more than " + std::to_string(most) +
                                        " samples; check them, or lower fps");
        }
        const double radius = options_.radius    ? metres_of(*options_.radius, track.id, track.label)
                              : file_.has_radius ? 0
                                                 : default_radius(track);
        std::vector<mobb::Disk> samples = resampled ? sampled(points, {first * dt, dt, std::size_t(last - first) + 1})
                                                    : filled(points, grid.step, first, last);
        for (mobb::Disk& disk : samples) {
            disk = {disk.x * common_.unit, disk.y * common_.unit, has_radii() ? disk.r * common_.unit : radius};
        }
        count_ += samples.size();
        put_at_origin(samples, options_.origin.value_or(Origin::keep));

        ImportedClip out;
        out.id = track.id;
        out.start = resampled ? start + first * dt : clock_.time(points.front().frame + first * grid.step);
        out.clip = std::make_shared<mobb::Clip>(dt, std::move(samples), options_.motion.value_or(kMotionOfTracks));
        out.facts = std::move(facts);
        return out;
    }

  private:
    /// What is done to a track, or is not.
    void warn_of(std::span<const TrackPoint> points, const TrackGrid& grid,
                 std::vector<ImportWarning>& warnings) const {
        const int line = line_out_of_step(points, clock_.usual_step(), file_.rounding);
        if (grid.has_gaps) {
            const double filled = grid.steps - static_cast<double>(points.size() - 1);
            warnings.push_back({"there are gaps, which are filled linearly", "", line, std::size_t(filled)});
        }
        if (!grid.in_step) {
            warnings.push_back({"the times are not uniform; the path is resampled at " +
                                    brief(options_.fps.value_or(kDefaultFps)) + " fps",
                                "fps", line});
        } else if (options_.fps && file_.timed) {
            warnings.push_back({"fps does not apply: the rows are uniform in time and are the samples", "fps"});
        }
        if (options_.dt && file_.timed && points.size() > 1)
            warnings.push_back({"dt does not apply: the rows have times", "dt"});
    }

    bool has_radii() const { return file_.has_radius && !options_.radius; }

    static mobb::Disk disk(const TrackPoint& point) { return {point.x, point.y, point.r}; }

    /// The points as they are stored, and what lies in gaps between them: of samples counted from the first point those
    /// from `first` to `last`.
    static std::vector<mobb::Disk> filled(std::span<const TrackPoint> points, double step, double first, double last) {
        std::vector<mobb::Disk> out;
        out.reserve(static_cast<std::size_t>(last - first) + 1);
        double at = 0;  // the sample of points[i]
        for (std::size_t i = 0; i < points.size() && at <= last; ++i) {
            if (at >= first) out.push_back(disk(points[i]));
            if (i + 1 == points.size()) break;
            const double next = steps_between(points[i], points[i + 1], step);
            const double from = std::max(first - at, 1.0), to = std::min(next, last - at + 1);
            const auto count = static_cast<std::size_t>(std::max(to - from, 0.0));
            for (std::size_t k = 0; k < count; ++k)
                out.push_back(mix(disk(points[i]), disk(points[i + 1]), (from + static_cast<double>(k)) / next));
            at += next;
        }
        return out;
    }

    /// In the time from the first point.
    std::vector<mobb::Disk> sampled(std::span<const TrackPoint> points, const SampleGrid& grid) const {
        std::vector<TimedDisk> stored;
        stored.reserve(points.size());
        for (const TrackPoint& point : points)
            stored.push_back({clock_.seconds(point.frame - points.front().frame), disk(point)});
        return sample(stored, grid);
    }

    const TrackFile& file_;
    const ImportOptions& options_;
    FrameClock clock_;
    SourceFacts common_;                     ///< what holds for every track
    std::size_t most_made_ = kMaxSamples;    ///< samples that the file may become by resampling
    std::size_t most_filled_ = kMaxSamples;  ///< samples that the file may become by filling gaps
    std::size_t count_ = 0;                  ///< samples made so far
};

}  // namespace

std::vector<ImportedClip> track_clips(const TrackFile& tracks, const std::filesystem::path& file,
                                      const ImportOptions& options) {
    refuse_skeleton_options(options, file, "trajectories");
    const std::string name = file.string();
    TrackClipMaker maker = at_place(name, "", [&] { return TrackClipMaker(tracks, options); });
    std::vector<ImportedClip> clips =
        clips_by_track(tracks.tracks, file, options, [&](const Track& track) { return maker.make(track); });
    if (clips.empty()) {
        throw InputError(
            name, "",
            (options.id ? "track " + in_quotes(*options.id) + " has no point" : "nobody is there") + " between " +
                format_double(options.trim->first) + " and " + format_double(options.trim->second) +
                " s of trim, which counts from the earliest row; the file lasts " + brief(maker.duration()) + " s");
    }
    return clips;
}

ImportOffer track_offer(const TrackFile& tracks, const std::filesystem::path& file, const ImportOptions&) {
    const ImportOptions none;
    const TrackClipMaker maker = at_place(file.string(), "", [&] { return TrackClipMaker(tracks, none); });
    const std::string step = maker.usual_step() > 0 ? brief(1 / maker.usual_step()) + " points a second" : "points";
    ImportOffer out{maker.duration(),
                    {{"fps", maker.usual_step() > 0 ? format_double(1 / maker.usual_step()) : "", "as stored: " + step},
                     unit_offer(tracks.unit, tracks.unit_assumption.empty() ? "as the file or its format says"
                                                                            : tracks.unit_assumption),
                     {"trim", "", "all of it, from the file's earliest row"},
                     origin_offer()}};
    if (tracks.tracks.size() > 1) out.options.push_back(id_offer(tracks.tracks));
    const auto has_class = [](const Track& track) { return !track.label.empty(); };
    const bool by_class = std::any_of(tracks.tracks.begin(), tracks.tracks.end(), has_class);
    out.options.push_back({"radius", by_class ? "" : format_double(kDefaultTrackRadius), assumed_radius(tracks)});
    out.options.push_back({"dt", format_double(maker.frame_time()),
                           tracks.rate_assumption.empty() ? "as the file or its format says" : tracks.rate_assumption});
    out.options.push_back(motion_option_offer(kMotionOfTracks, "as usual of trajectories: points are far apart"));
    return out;
}

}  // namespace mobbscope
