#include <import/clip/sampling.h>
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

constexpr mobb::Motion kMotionOfTracks = mobb::Motion::linear;
// A damaged frame number leaves a gap of any length: what fills gaps may be so many times what the file holds.
constexpr std::size_t kMaxFill = 100;
constexpr std::size_t kAlwaysFilled = 10'000;
// Frames of a plan may be fractions: they are in step to so many of a step.
constexpr double kStepTolerance = 1e-6;

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

/// How many points are so many frames after the one before: nearly always all points of a file are as many.
using StepCounts = std::map<double, std::ptrdiff_t>;

void count_steps(std::span<const TrackPoint> points, StepCounts& counts) {
    auto last = counts.end();
    for (std::size_t i = 1; i < points.size(); ++i) {
        const double step = points[i].frame - points[i - 1].frame;
        if (last == counts.end() || last->first != step) last = counts.try_emplace(step, 0).first;
        ++last->second;
    }
}

/// The most frequent step, the shorter of equals; none for none.
std::optional<double> usual(const StepCounts& counts) {
    const auto most = std::ranges::max_element(counts, {}, &StepCounts::value_type::second);
    return most == counts.end() ? std::nullopt : std::optional(most->first);
}

/// Frame numbers to seconds.
class FrameClock {
  public:
    FrameClock(const TrackFile& file, const ImportOptions& options) : dt_(options.dt) {
        StepCounts steps;
        first_ = file.tracks.front().points.front().frame;
        last_ = first_;
        for (const Track& track : file.tracks) {
            count_steps(track.points, steps);
            first_ = std::min(first_, track.points.front().frame);
            last_ = std::max(last_, track.points.back().frame);
        }
        step_ = usual(steps).value_or(file.least_step);
        rate_ = file.rate_of_steps ? file.rate * step_ : file.rate;
    }

    /// Dividing by the rate gives the nearest double, which multiplying by its inverse does not.
    double seconds(double frames) const { return dt_ ? frames * *dt_ : frames / rate_; }
    /// Since the file's first frame.
    double time(const TrackPoint& point) const { return seconds(point.frame - first_); }
    double duration() const { return seconds(last_ - first_); }
    double usual_step() const { return step_; }  ///< frames

  private:
    std::optional<double> dt_;
    double rate_ = 1;
    double first_ = 0;
    double last_ = 0;
    double step_ = 1;
};

class TrackClipMaker {
  public:
    /// Refers to the options.
    TrackClipMaker(const TrackFile& file, const ImportOptions& options)
        : options_(options), clock_(file, options), common_{file.format, file.unit, 0, std::nullopt, 0, {}} {
        for (const std::string& warning : file.warnings) common_.warnings.push_back({warning});
        std::size_t points = 0;
        for (const Track& track : file.tracks) points += track.points.size();
        most_ = options.fps ? kMaxSamples : std::min(kMaxSamples, kMaxFill * points + kAlwaysFilled);
        if (!(clock_.duration() <= mobb::kMaxTime)) {
            throw std::invalid_argument("its frames last " + brief(clock_.duration()) + " s, over " +
                                        short_double(mobb::kMaxTime) + "; check them");
        }
        if (!options.dt && !file.rate_assumption.empty()) common_.warnings.push_back({file.rate_assumption, "dt"});
        if (options.unit && *options.unit != "auto") {
            common_.unit = *metres_per_unit(*options.unit);
        } else if (!file.unit_assumption.empty()) {
            common_.warnings.push_back({file.unit_assumption, "unit"});
            common_.guessed_from_height = file.guessed_height;
        }
        const std::string remark = options.radius ? unused_radii(file, *options.radius) : assumed_radius(file);
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
        const std::span<const TrackPoint> points = trimmed(track);
        if (points.empty()) return std::nullopt;
        StepCounts steps;
        count_steps(points, steps);
        const double step = usual(steps).value_or(clock_.usual_step());
        const double dt = clock_.seconds(step);
        const bool resampled = !in_step(steps, step);

        SourceFacts facts = common_;
        facts.label = track.label;
        facts.frames = static_cast<int>(track.points.size());
        facts.duration = clock_.seconds(track.points.back().frame - track.points.front().frame);
        if (resampled) {
            const double fps = options_.fps.value_or(kDefaultFps);
            facts.warnings.push_back(
                {"the points are not uniform in time; the path is resampled at " + brief(fps) + " fps", "fps"});
        } else if (uniform(steps, step)) {
            facts.dt = dt;
        } else {
            const double missing =
                (points.back().frame - points.front().frame) / step - static_cast<double>(points.size() - 1);
            facts.warnings.push_back({counted(std::llround(missing), "frame is", "frames are") +
                                      " missing within the track; the path is interpolated there"});
        }
        const double sample_dt = options_.fps || resampled ? 1 / options_.fps.value_or(kDefaultFps) : dt;

        ImportedClip out;
        out.id = track.id;
        out.start = clock_.time(points.front()) - (options_.trim ? options_.trim->first : 0);
        const double radius =
            options_.radius ? metres_of(*options_.radius, track.id, track.label) : default_radius(track);
        out.clip = std::make_shared<mobb::Clip>(sample_dt, samples(points, radius, sample_dt, facts.dt == sample_dt),
                                                options_.motion.value_or(kMotionOfTracks));
        out.facts = std::move(facts);
        return out;
    }

  private:
    /// The points within the time that is taken.
    std::span<const TrackPoint> trimmed(const Track& track) const {
        std::span<const TrackPoint> points = track.points;
        if (!options_.trim) return points;
        const double near = kFrameTolerance * clock_.seconds(clock_.usual_step());
        const auto begin = std::find_if(points.begin(), points.end(), [&](const TrackPoint& point) {
            return clock_.time(point) >= options_.trim->first - near;
        });
        const auto end = std::find_if(begin, points.end(), [&](const TrackPoint& point) {
            return clock_.time(point) > options_.trim->second + near;
        });
        return {begin, end};
    }

    static bool uniform(const StepCounts& steps, double step) {
        return std::ranges::all_of(
            steps, [step](double s) { return std::abs(s - step) <= kStepTolerance * step; },
            &StepCounts::value_type::first);
    }

    /// Whether only whole steps are missing.
    static bool in_step(const StepCounts& steps, double step) {
        return std::ranges::all_of(
            steps,
            [step](double s) { return std::abs(s / step - std::round(s / step)) <= kStepTolerance && s > 0.5 * step; },
            &StepCounts::value_type::first);
    }

    std::vector<mobb::Disk> samples(std::span<const TrackPoint> points, double radius, double dt, bool as_stored) {
        const auto disk = [&](const TrackPoint& point) {
            return mobb::Disk{point.x * common_.unit, point.y * common_.unit, radius};
        };
        std::vector<mobb::Disk> out;
        if (as_stored) {
            out.resize(points.size());
            std::ranges::transform(points, out.begin(), disk);
        } else {
            std::vector<TimedDisk> stored;
            stored.reserve(points.size());
            for (const TrackPoint& point : points)
                stored.push_back({clock_.seconds(point.frame - points.front().frame), disk(point)});
            const std::size_t left = most_ - std::min(count_, most_);
            out = sample(stored, sample_grid(0, stored.back().t, std::nullopt, dt, left));
        }
        count_ += out.size();
        put_at_origin(out, options_.origin.value_or(Origin::keep));
        return out;
    }
    const ImportOptions& options_;
    FrameClock clock_;
    SourceFacts common_;     ///< what holds for every track
    std::size_t most_ = 0;   ///< samples that the file may become
    std::size_t count_ = 0;  ///< made so far
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
        throw InputError(name, "",
                         (options.id ? "track " + in_quotes(*options.id) + " has no point" : "nobody is there") +
                             " between " + brief(options.trim->first) + " and " + brief(options.trim->second) +
                             " s of trim; the file lasts " + brief(maker.duration()) + " s");
    }
    return clips;
}

ImportOffer track_offer(const TrackFile& tracks, const std::filesystem::path& file, const ImportOptions&) {
    const ImportOptions none;
    const TrackClipMaker maker = at_place(file.string(), "", [&] { return TrackClipMaker(tracks, none); });
    const std::string step = maker.usual_step() > 0 ? brief(1 / maker.usual_step()) + " points a second" : "points";
    ImportOffer out{maker.duration(),
                    {{"fps", maker.usual_step() > 0 ? short_double(1 / maker.usual_step()) : "", "as stored: " + step},
                     unit_offer(tracks.unit, tracks.unit_assumption.empty() ? "as the file or its format says"
                                                                            : tracks.unit_assumption),
                     {"trim", "", "all of it, from the file's first frame"},
                     origin_offer()}};
    if (tracks.tracks.size() > 1) out.options.push_back(id_offer(tracks.tracks));
    const auto has_class = [](const Track& track) { return !track.label.empty(); };
    const bool by_class = std::any_of(tracks.tracks.begin(), tracks.tracks.end(), has_class);
    out.options.push_back({"radius", by_class ? "" : short_double(kDefaultTrackRadius), assumed_radius(tracks)});
    out.options.push_back({"dt", short_double(maker.frame_time()),
                           tracks.rate_assumption.empty() ? "as the file or its format says" : tracks.rate_assumption});
    out.options.push_back(motion_option_offer(kMotionOfTracks, "as usual of trajectories: points are far apart"));
    return out;
}

}  // namespace mobbscope
