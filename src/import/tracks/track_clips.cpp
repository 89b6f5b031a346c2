#include <import/clip/sample_times.h>
#include <import/clip/sampling.h>
#include <import/tracks/sanity.h>
#include <import/tracks/storeys.h>
#include <import/tracks/track_bodies.h>
#include <import/tracks/track_steps.h>
#include <import/tracks/tracks.h>
#include <mobb/query.h>

#include <algorithm>
#include <cmath>
#include <limits>
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

mobb::Motion usual_motion(const TrackFile& file) { return file.alone ? mobb::Motion::held : kMotionOfTracks; }

/// Frame numbers to seconds.
class FrameClock {
  public:
    /// Throws std::invalid_argument where the file does not tell its times, nor an option.
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
        const double rate = file.fps_is_rate && options.fps ? *options.fps : file.rate.value_or(1);
        rate_ = file.rate_of_steps ? rate * step_ : rate;
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

/// What a file lacks that an option has to say.
void check_columns(const TrackFile& table, const std::string& file, const ImportOptions& options) {
    const std::string header = table.header_line > 0 ? at_line(table.header_line) : "";
    if (!table.rate && !options.dt && !options.fps) {
        throw InputError(file, header,
                         "the rows have frame numbers in place of times: give fps (frames a second), or dt (seconds "
                         "from one frame to the next)");
    }
    if (table.header_line == 0) return;
    if (options.id && table.alone) throw InputError(file, header, "the header names no column id; leave id out");
    // People have a usual radius.
    if (!table.has_radius && !table.has_sizes && !options.radius && !options.body && table.alone)
        throw InputError(file, header, "the header names no column r; add one or give radius (metres)");
    if (table.alone && table.timed && table.tracks.front().points.size() == 1 && !options.dt) {
        throw InputError(file, at_line(table.tracks.front().first_line()),
                         "one row does not tell how long it lasts; give dt (seconds)");
    }
    if (!table.has_times && !options.dt)
        throw InputError(file, header, "the header names no column t; name one or give dt (seconds between rows)");
    if (options.unit == "auto")
        throw InputError(file, "", "unit 'auto' does not apply to CSV; give m, cm, in or metres per file unit");
}

/// Throws InputError if an option is given that means something for skeletons alone.
void refuse_skeleton_options(const TrackFile& tracks, const ImportOptions& options, const std::string& file) {
    const auto refuse = [&](bool given, const char* option) {
        if (given)
            throw InputError(file, "",
                             std::string(option) + " does not apply to " +
                                 (tracks.header_line > 0 ? "CSV" : "trajectories") + "; leave it out");
    };
    refuse(options.animation.has_value(), "animation");
    refuse(options.root.has_value(), "root");
    refuse(options.up.has_value(), "up");
}

/// The options that are left when those that say what the rows hold are taken.
ImportOptions rest_of(const TrackFile& file, ImportOptions options) {
    if (file.header_line > 0 && options.radius && std::holds_alternative<RadiusColumn>(*options.radius))
        options.radius.reset();
    if (file.fps_is_rate) options.fps.reset();
    return options;
}

class TrackClipMaker {
  public:
    /// Refers to the file.
    TrackClipMaker(const TrackFile& file, const ImportOptions& options)
        : file_(file), options_(rest_of(file, options)), clock_(file, options), common_{file.format,  file.unit, 0,
                                                                                        std::nullopt, 0,         {}} {
        if (!file.alone) common_.t0 = clock_.t0();
        common_.warnings = file.warnings;
        const std::size_t points = file.point_count();
        if (file.is_large) most_stored_ = std::numeric_limits<std::size_t>::max();
        most_made_ = std::min(most_stored_, most_made(points));
        most_filled_ = most_made_;
        if (!options_.fps) most_filled_ = std::min(most_made_, kMaxFill * points + kAlwaysFilled);
        if (!(clock_.duration() <= mobb::kMaxTime)) {
            throw std::invalid_argument("its frames last " + brief(clock_.duration()) + " s, over " +
                                        format_double(mobb::kMaxTime) + "; check them");
        }
        if (file.timed) check_file_times(usual_step(), std::max(std::abs(clock_.t0()), std::abs(clock_.end())));
        if (options.unit && *options.unit != "auto") common_.unit = *metres_per_unit(*options.unit);
        const bool is_said = options.unit || (options.dt && !file.timed);
        const Storeys storeys = storeys_of(file, common_.unit);
        judged_ = judge(file, {common_.unit, frame_time(), clock_.usual_step(), is_said, options.keep_jumps == true},
                        storeys);
        common_.warnings.insert(common_.warnings.end(), judged_.findings.begin(), judged_.findings.end());
        common_.doubt = judged_.doubt;
        if (!options.dt && !file.rate_assumption.empty()) common_.warnings.push_back({file.rate_assumption, "dt"});
        if (!file.has_times && !file.alone) {
            common_.warnings.push_back({"the rows have no times: all tracks start together, with a row every " +
                                        brief(frame_time()) + " s; name a column t if they do not"});
        }
        if ((!options.unit || *options.unit == "auto") && !file.unit_assumption.empty()) {
            common_.warnings.push_back({file.unit_assumption, "unit"});
            common_.guessed_from_height = file.guessed_height;
        }
        const std::string remark = options_.radius                    ? unused_radii(file, *options_.radius)
                                   : file.has_radius || options_.body ? ""
                                                                      : body_remark(file, common_.unit);
        if (!remark.empty()) common_.warnings.push_back({remark, "radius"});
        if (!storeys.remark.empty()) common_.warnings.push_back({storeys.remark});
        if (options.trim && options.trim->second > clock_.duration() + usual_step()) {
            common_.warnings.push_back({"trim ends at " + brief(options.trim->second) + " s, but the file lasts " +
                                            brief(clock_.duration()) + " s; all to the end is taken",
                                        "trim"});
        }
    }

    double duration() const { return clock_.duration(); }
    double frame_time() const { return clock_.seconds(1); }
    double usual_step() const { return clock_.seconds(clock_.usual_step()); }

    const JudgedTracks& judged() const { return judged_; }

    /// Whether the points of every track are whole steps apart.
    bool is_in_step() const {
        return std::ranges::all_of(judged_.parts,
                                   [this](const TrackPart& part) { return grid_of(part.points).in_step; });
    }

    /// Nothing if the track is not there in the time that is taken.
    std::optional<ImportedClip> make(const TrackPart& part) {
        const Track& track = *part.track;
        const std::span<const TrackPoint> points = part.points;
        TrackGrid grid = grid_of(points);
        SourceFacts facts = common_;
        facts.label = track.label;
        facts.frames = static_cast<int>(points.size());
        facts.duration = clock_.seconds(points.back().frame - points.front().frame);
        if (points.size() == 1 && file_.timed && options_.dt) grid.step = *options_.dt;
        if (grid.in_step && !grid.has_gaps) facts.dt = clock_.seconds(grid.step);
        warn_of(points, grid, facts.warnings);

        const bool resampled = !grid.in_step || (options_.fps && !has_samples());
        const double fps = options_.fps.value_or(kDefaultFps);
        const double dt = resampled ? 1 / fps : clock_.seconds(grid.step);
        if (resampled) grid.steps = sample_count(0, facts.duration, dt) - 1;

        // The part that is taken: samples `first` to `last` from `start` on.
        double start = clock_.time(points.front().frame);
        double first = 0;
        double last = grid.steps;
        if (options_.trim) {
            const auto [from, to] = *options_.trim;
            if (file_.alone) {
                if (from > facts.duration) return std::nullopt;
                last = sample_count(from, std::min(to, facts.duration), dt) - 1;
            } else {
                // All that is there in the meantime; one that runs does so to the sample after it.
                const bool runs = grid.steps > 0 && options_.motion.value_or(kMotionOfTracks) == mobb::Motion::linear;
                constexpr double kRounding = 1e-6;
                const double begin = (from - start) / dt + kRounding, end = (to - start) / dt - kRounding;
                if (begin > grid.steps + (runs ? 2 * kRounding : 1) || end < -2 * kRounding) return std::nullopt;
                first = std::clamp(std::floor(begin), 0.0, runs ? grid.steps - 1 : grid.steps);
                last = runs ? std::clamp(std::ceil(end), first + 1, grid.steps)
                            : std::clamp(std::floor(end + 2 * kRounding), first, grid.steps);
            }
        }
        if (first > last) return std::nullopt;
        const std::size_t most = grid.has_gaps ? most_filled_ : resampled ? most_made_ : most_stored_;
        if (last - first >= static_cast<double>(most - std::min(count_, most))) {
            throw std::invalid_argument("its times make more than " + std::to_string(most) +
                                        " samples; check them, or lower fps");
        }
        const WholeTrack& whole = whole_track(part);
        const bool has_body = !whole.body.disks.empty();
        // A motion begins where it is trimmed; tracks keep the moments of their samples.
        const bool is_cut = file_.alone && options_.trim;
        const double begin = is_cut ? options_.trim->first : first * dt;
        const auto samples_of = [&](std::span<const TrackPoint> from) {
            return resampled || is_cut ? sampled(from, {begin, dt, std::size_t(last - first) + 1})
                                       : filled(from, grid.step, first, last);
        };
        std::vector<mobb::Disk> samples = samples_of(points);
        std::vector<double> headings;
        if (has_body) headings = headings_at(file_, points);
        if (has_body && headings.empty()) {
            facts.warnings.insert(facts.warnings.end(), whole.warnings.begin(), whole.warnings.end());
            if (!whole.headings.empty()) headings = headings_in_part(track, whole.headings, points);
        }
        if (!headings.empty()) {
            // They are sampled in place of radii.
            std::vector<TrackPoint> turned(points.begin(), points.end());
            for (std::size_t i = 0; i < turned.size(); ++i) turned[i].r = headings[i];
            headings.clear();
            for (const mobb::Disk& disk : samples_of(turned)) headings.push_back(disk.r);
        }
        for (mobb::Disk& disk : samples) {
            disk = {disk.x * common_.unit, disk.y * common_.unit, has_radii() ? disk.r * common_.unit : whole.body.r};
        }
        count_ += samples.size();
        turn_headings(headings, put_at_origin(samples, options_.origin.value_or(Origin::keep)));

        ImportedClip out;
        out.body = whole.body.disks;
        out.headings = std::move(headings);
        out.id = part.id;
        out.floor = track.scope + (track.scope.empty() || part.floor.empty() ? "" : ", floor ") + part.floor;
        if (!file_.alone)
            out.start = resampled ? start + first * dt : clock_.time(points.front().frame + first * grid.step);
        out.clip = std::make_shared<mobb::Clip>(dt, std::move(samples), options_.motion.value_or(usual_motion(file_)));
        out.facts = std::move(facts);
        out.facts.invented = invented(part, grid, begin, *out.clip);
        return out;
    }

  private:
    /// What the parts of a track have in common.
    struct WholeTrack {
        const Track* track = nullptr;
        TrackBody body{};
        std::vector<double> headings{};         ///< as it moves, degrees, one a point; empty: they are not asked
        std::vector<ImportWarning> warnings{};  ///< of them
    };
    /// Worked out once, however many parts a track has: these come one behind the other.
    const WholeTrack& whole_track(const TrackPart& part) {
        const Track& track = *part.track;
        if (whole_.track == &track) return whole_;
        WholeTrack made{&track};
        if (options_.radius) {
            made.body.r = metres_of(*options_.radius, track.id, track.label);
        } else if (options_.body) {
            made.body = {mobb::body_reach(*options_.body), *options_.body};
        } else if (!file_.has_radius) {
            made.body = body_of(file_, track, common_.unit);
        }
        if (!made.body.disks.empty()) {
            const mobb::Clip path = whole_path(track, common_.unit);
            warn_of_no_heading(path, made.body.disks, made.warnings);
            // Who stands in the part that is taken keeps the direction in which it came, or will go.
            if (options_.trim || part.points.size() < track.points.size())
                made.headings = mobb::headings_of(path, made.body.disks);
        }
        return whole_ = std::move(made);
    }

    /// Rows of times of their own, and rows without any, are the samples.
    bool has_samples() const { return file_.timed || !file_.has_times; }

    TrackGrid grid_of(std::span<const TrackPoint> points) const {
        if (!file_.alone) return mobbscope::grid_of(points, clock_.usual_step(), file_.rounding);
        return grid_of_all(points, clock_.usual_step(), file_.rounding);
    }

    /// SourceFacts::invented of a clip whose first sample is `begin` seconds after the first point. Of uneven tracks
    /// only what lies in pauses was not seen.
    std::vector<std::pair<double, double>> invented(const TrackPart& part, const TrackGrid& grid, double begin,
                                                    const mobb::Clip& clip) const {
        const double duration = clip.duration();
        if (file_.alone) return {};
        std::vector<mobb::Interval> found;
        const auto time = [&](std::size_t i) {
            return clock_.seconds(part.points[i].frame - part.points.front().frame) - begin;
        };
        for (std::size_t i = 1; i < part.points.size(); ++i) {
            const TrackPoint& a = part.points[i - 1];
            const TrackPoint& b = part.points[i];
            const bool filled =
                grid.in_step ? steps_between(a, b, grid.step) > 1 : time(i) - time(i - 1) > longest_pause(usual_step());
            const double length = std::hypot(b.x - a.x, b.y - a.y) * common_.unit;
            if (!filled && !(length > part.fastest * (time(i) - time(i - 1)))) continue;
            const double from = std::max(time(i - 1), 0.0), to = std::min(time(i), duration);
            if (from < to) found.push_back({from, to});
        }
        // What is between samples may begin before a step that is too fast, and end behind it.
        const std::span<const mobb::Disk> samples = clip.samples();
        for (std::size_t i = 1; i < samples.size(); ++i) {
            const double length = std::hypot(samples[i].x - samples[i - 1].x, samples[i].y - samples[i - 1].y);
            const auto at = static_cast<double>(i);
            if (length > part.fastest * clip.dt()) found.push_back({(at - 1) * clip.dt(), at * clip.dt()});
        }
        std::vector<std::pair<double, double>> out;
        for (const mobb::Interval& one : mobb::joined(std::move(found))) out.emplace_back(one.t0, one.t1);
        return out;
    }

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
        } else if (options_.fps && has_samples()) {
            warnings.push_back({"fps does not apply: the rows are uniform in time and are the samples", "fps"});
        }
        if (options_.dt && file_.timed && points.size() > 1)
            warnings.push_back({"dt does not apply: the rows have times", "dt"});
        if (file_.alone && points.size() == 1)
            warnings.push_back({"there is one row: it holds for " + brief(clock_.seconds(grid.step)) + " s", "dt"});
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
    ImportOptions options_;  ///< see rest_of
    FrameClock clock_;
    JudgedTracks judged_;
    SourceFacts common_;                     ///< what holds for every track
    WholeTrack whole_;                       ///< of the part made last
    std::size_t most_stored_ = kMaxSamples;  ///< samples that the file may have
    std::size_t most_made_ = kMaxSamples;    ///< samples that the file may become by resampling
    std::size_t most_filled_ = kMaxSamples;  ///< samples that the file may become by filling gaps
    std::size_t count_ = 0;                  ///< samples made so far
};

/// The unit of files without a body: one that is taken, and the usual ones.
OptionOffer unit_offer(double taken, const std::string& why) {
    return {"unit", unit_word(taken), why, false, {{"m", "m"}, {"cm", "cm"}, {"0.001", "mm"}, {"in", "in"}}};
}

}  // namespace

void give_track_clips(TrackFile& tracks, const std::filesystem::path& file, const ImportOptions& options,
                      const ClipSink& sink, bool spends) {
    const std::string name = file.string();
    refuse_skeleton_options(tracks, options, name);
    check_columns(tracks, name, options);
    TrackClipMaker maker = at_place(name, "", [&] { return TrackClipMaker(tracks, options); });
    bool found = false, given = false;
    const std::vector<TrackPart>& parts = maker.judged().parts;
    auto track = tracks.tracks.begin();
    for (const TrackPart& part : parts) {
        // Parts are in the order of their tracks.
        for (; spends && &*track != part.track; ++track) std::vector<TrackPoint>().swap(track->points);
        if (options.id && part.id != *options.id) continue;
        found = true;
        const std::string place = at_line(part.first_line()) + (tracks.alone ? "" : ", track " + in_quotes(part.id));
        std::optional<ImportedClip> clip = at_place(name, place, [&] { return maker.make(part); });
        if (!clip) continue;
        clip->name = parts.size() > 1 ? part.id : input_stem(file);
        given = true;
        sink(std::move(*clip));
    }
    if (!found) {
        std::vector<std::string> ids;
        for (const TrackPart& part : parts) ids.push_back(part.id);
        throw InputError(name, "",
                         "has no track " + in_quotes(*options.id) + did_you_mean(*options.id, ids) + "; it has " +
                             std::to_string(ids.size()) + ", the first is " + in_quotes(ids.front()));
    }
    if (!given) {
        throw InputError(
            name, "",
            (options.id ? "track " + in_quotes(*options.id) + " has no point" : "nobody is there") + " between " +
                format_double(options.trim->first) + " and " + format_double(options.trim->second) +
                " s of trim, which counts from the earliest row; the file lasts " + brief(maker.duration()) + " s");
    }
}

std::vector<ImportedClip> track_clips(TrackFile tracks, const std::filesystem::path& file,
                                      const ImportOptions& options) {
    std::vector<ImportedClip> out;
    give_track_clips(
        tracks, file, options, [&](ImportedClip&& clip) { out.push_back(std::move(clip)); }, true);
    return out;
}

ImportOffer track_offer(const TrackFile& tracks, const std::filesystem::path& file, const ImportOptions& options) {
    // Where the times are not known yet, any will do.
    ImportOptions clock;
    clock.dt = tracks.has_times ? options.dt : options.dt.value_or(1);
    clock.fps = tracks.fps_is_rate ? options.fps : std::nullopt;
    clock.unit = format_double(tracks.unit);
    const bool alone = std::ranges::all_of(tracks.tracks, [](const Track& of) { return of.points.size() == 1; });
    if (tracks.timed && alone && !clock.dt) clock.dt = 1;
    const TrackClipMaker maker = at_place(file.string(), "", [&] { return TrackClipMaker(tracks, clock); });
    const bool asks_rate = !tracks.rate && !options.dt && !options.fps;
    ImportOffer out{asks_rate || (!tracks.has_times && !options.dt) ? 0 : maker.duration(), {}};
    const double points_a_second = maker.usual_step() > 0 ? 1 / maker.usual_step() : 0;
    const bool is_table = tracks.header_line > 0;
    if (tracks.fps_is_rate && !options.dt) {
        out.options.push_back({"fps", tracks.rate ? format_double(*tracks.rate) : "",
                               tracks.rate ? "as a comment says" : "the file does not say its frames a second",
                               !tracks.rate});
    } else if (!maker.is_in_step()) {
        out.options.push_back({"fps", format_double(kDefaultFps), "as usual; the rows are not uniform in time"});
    } else if (!is_table) {
        out.options.push_back({"fps", points_a_second > 0 ? format_double(points_a_second) : "",
                               "as stored: " + (points_a_second > 0 ? brief(points_a_second) + " points a second"
                                                                    : std::string("points"))});
    }
    out.options.push_back(unit_offer(tracks.unit, !tracks.unit_assumption.empty() ? tracks.unit_assumption
                                                  : is_table                      ? "as usual of CSV files"
                                                                                  : "as the file or its format says"));
    if (out.seconds > 0) out.options.push_back({"trim", "", "all of it, from the file's earliest row"});
    out.options.push_back(origin_offer());
    if (maker.judged().parts.size() > 1) {
        OptionOffer& ids =
            out.options.emplace_back(OptionOffer{"id", "", "the file has several tracks: name one", true});
        for (const TrackPart& part : maker.judged().parts) ids.choices.push_back({part.id, part.id});
    }
    const bool by_class = std::ranges::any_of(tracks.tracks, [](const Track& of) { return !of.label.empty(); });
    const bool has_usual = !tracks.has_radius && (tracks.has_sizes || !tracks.alone);
    OptionOffer& radius = out.options.emplace_back(
        OptionOffer{"radius", has_usual && !by_class && !tracks.has_sizes ? format_double(kDefaultTrackRadius) : "",
                    has_usual           ? body_remark(tracks, tracks.unit)
                    : tracks.has_radius ? "the column r"
                                        : "the file has no column r",
                    !tracks.has_radius && !has_usual});
    for (const std::string& name : tracks.others) radius.choices.push_back({name, "the column " + name});
    if (!tracks.has_times || (tracks.timed && alone)) {
        out.options.push_back(
            {"dt", "", tracks.timed ? "one row does not tell how long it lasts" : "the file has no column t", true});
    } else if (!is_table) {
        out.options.push_back(
            {"dt", format_double(maker.frame_time()),
             tracks.rate_assumption.empty() ? "as the file or its format says" : tracks.rate_assumption});
    }
    if (is_table) out.options.push_back({"columns", "", "by their names"});
    out.options.push_back(motion_option_offer(usual_motion(tracks), tracks.alone
                                                                        ? "as usual of tables without ids"
                                                                        : "as usual of tracks: points are far apart"));
    if (std::ranges::find(maker.judged().findings, "keep_jumps", &ImportWarning::option) !=
        maker.judged().findings.end()) {
        out.options.push_back({"keep_jumps",
                               "no",
                               "tracks are split where they jump or pause",
                               false,
                               {{"no", "tracks are split there"}, {"yes", "tracks stay whole"}}});
    }
    return out;
}

}  // namespace mobbscope
