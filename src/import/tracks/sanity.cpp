#include <base/median.h>
#include <base/text.h>
#include <import/clip/road_users.h>
#include <import/tracks/sanity.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <initializer_list>
#include <iterator>
#include <limits>
#include <optional>
#include <set>
#include <stdexcept>
#include <tuple>
#include <unordered_map>
#include <utility>

namespace mobbscope {

namespace {

constexpr double kFastestPerson = 8;     // m/s: sprinters are faster, for seconds
constexpr double kFastestOfAll = 75;     // cars on a motorway
constexpr double kFastestMedian = 45;    // no recording of who has no class has more
constexpr double kSlowestMedian = 0.01;  // nor less
constexpr double kSlowMedian = 0.1;      // slower than anybody walks
constexpr double kOfPeople = 4;          // median of who has no class: over it they drive
constexpr double kLeastJump = 2.5;       // metres: less is what a tracker that lost somebody catches up
constexpr double kLeastLost = 0.5;       // metres: likewise to where who is lost is written
constexpr double kLeastTold = 0.5;       // of a step that is too fast and told
constexpr double kTooFast = 1.5;         // times what its class can, likewise
constexpr double kNoise = 7;             // times the median of what rows are off the line of those beside them
constexpr std::size_t kNoiseRows = 12;   // of which that is taken, on either side
constexpr std::size_t kFewestNoise = 6;  // fewer rows do not tell it
constexpr std::size_t kMostOff = 3;      // rows that are left out as points far off
constexpr double kLongestPause = 5;      // seconds
constexpr double kMostStepsOfPause = 20;
constexpr std::size_t kMostSpeeds = 1 << 16;  // points that a median is taken of, about
constexpr std::size_t kFewestSpeeds = 10;     // that prove anything
constexpr std::size_t kStepsTogether = 10;    // of which a speed is taken: noise goes nowhere
constexpr double kSecondsTogether = 5;        // likewise
constexpr double kLeastShare = 0.5;           // of the time in which they move, for their being slow to be told
constexpr double kLeastOfNoise = 0.02;        // likewise, for their being fast
constexpr double kLeastHeadway = 0.3;         // of who moves: the way that is left of the path

struct Velocity {
    double x = 0, y = 0;
    double speed() const { return std::hypot(x, y); }
};

/// Points [first, last) of a track with a break at either end.
struct Run {
    std::size_t first = 0, last = 0;
    bool after_jump = false, before_jump = false;
};

/// The worst of a kind, and how many there are.
struct Worst {
    std::size_t count = 0;
    double by = 0;  ///< how many times what can be
    const Track* track = nullptr;
    TrackPoint from{}, to{};

    void take(double how_bad, const Track& of, const TrackPoint& a, const TrackPoint& b) {
        ++count;
        if (!track || how_bad > by || (how_bad == by && b.line < to.line)) *this = {count, how_bad, &of, a, b};
    }
};

using Place = std::pair<double, double>;

/// Frames.
struct Hole {
    double begin = 0, end = 0;
    std::size_t tracks = 0;  ///< so many pause over it
};

std::string place_words(const TrackPoint& point) { return "(" + brief(point.x) + ", " + brief(point.y) + ")"; }

class Judge {
  public:
    Judge(const TrackFile& file, const TrackScale& scale, const Storeys& storeys)
        : file_(file), scale_(scale), storeys_(storeys), longest_pause_(longest_pause(step_seconds())) {}

    JudgedTracks judged() {
        out_.parts.reserve(file_.tracks.size());
        if (file_.format == "mapf") {
            for (const Track& track : file_.tracks) add(track, track.points, kNoLimit, 0);
            tell();
            return std::move(out_);
        }
        judge_speeds();
        for (const Track& track : file_.tracks) look_at(track);
        find_clock_steps();
        for (std::size_t i = 0; i < file_.tracks.size(); ++i) take_apart(file_.tracks[i], limits_[i]);
        if (out_.parts.empty()) {
            // Nobody is left: then the places are places.
            lost_.clear();
            jumps_ = pauses_ = clock_ = off_ = {};
            left_out_ = moves_ = 0;
            for (std::size_t i = 0; i < file_.tracks.size(); ++i) take_apart(file_.tracks[i], limits_[i]);
        }
        tell();
        return std::move(out_);
    }

  private:
    static constexpr double kNoLimit = std::numeric_limits<double>::infinity();

    double step_seconds() const { return scale_.step * scale_.seconds; }
    double seconds(const TrackPoint& a, const TrackPoint& b) const { return (b.frame - a.frame) * scale_.seconds; }
    double metres(const TrackPoint& a, const TrackPoint& b) const {
        return std::hypot(b.x - a.x, b.y - a.y) * scale_.metres;
    }
    Velocity velocity(const TrackPoint& a, const TrackPoint& b) const {
        const double per = scale_.metres / seconds(a, b);
        return {(b.x - a.x) * per, (b.y - a.y) * per};
    }
    double speed(const TrackPoint& a, const TrackPoint& b) const { return velocity(a, b).speed(); }
    bool is_pause(const TrackPoint& a, const TrackPoint& b) const { return seconds(a, b) > longest_pause_; }
    /// Without a unit of metres nothing is too fast.
    bool has_metres() const { return !file_.in_pixels || scale_.is_said; }

    /// Its class; else a vehicle where it is as long, or what ids are called ("Vehicle_ID"), where that is one.
    std::string_view label(const Track& track) const {
        if (!track.label.empty()) return track.label;
        constexpr double kShortestCar = 2;  // metres
        const PointDetail* const detail = file_.detail_of(track.points.front());
        if (detail && detail->length * scale_.metres > kShortestCar) return "vehicle";
        return road_user(file_.id_column) ? std::string_view(file_.id_column) : std::string_view();
    }

    // ---- speeds of all

    /// The median of the steps in which somebody moves, and one as fast. Noise goes nowhere: it does not move.
    struct Median {
        double speed = 0;
        double together = 0;  ///< over several steps
        const Track* track = nullptr;
        int line = 0;
        std::size_t of = 0;  ///< so many
        double share = 0;    ///< of the time somebody makes headway
    };
    std::optional<Median> median_of_all() const {
        const std::size_t every = file_.point_count() / kMostSpeeds + 1;
        std::vector<Median> speeds;
        std::size_t at = 0, looked_at = 0, moving = 0;
        for (const Track& track : file_.tracks) {
            for (std::size_t first = 0, last = 0; first + 1 < track.points.size(); first = last) {
                last = std::min(first + kStepsTogether, track.points.size() - 1);
                if (at++ % every != 0) continue;
                ++looked_at;
                if (!makes_headway(std::span(track.points).subspan(first, last - first + 1))) continue;
                ++moving;
                add_speeds(track, first, last, speeds);
            }
        }
        if (speeds.empty()) return std::nullopt;
        const auto middle = speeds.begin() + std::ssize(speeds) / 2;
        std::ranges::nth_element(speeds, middle, {}, &Median::together);
        const double together = middle->together;
        std::ranges::nth_element(speeds, middle, {}, &Median::speed);
        middle->together = together;
        middle->of = speeds.size();
        middle->share = static_cast<double>(moving) / static_cast<double>(looked_at);
        return *middle;
    }
    bool makes_headway(std::span<const TrackPoint> points) const {
        double path = 0;
        for (std::size_t i = 1; i < points.size(); ++i) path += metres(points[i - 1], points[i]);
        return path > 0 && metres(points.front(), points.back()) >= kLeastHeadway * path;
    }
    void add_speeds(const Track& track, std::size_t first, std::size_t last, std::vector<Median>& speeds) const {
        const double together = speed(track.points[first], track.points[last]);
        for (std::size_t i = first + 1; i <= last; ++i) {
            const double here = speed(track.points[i - 1], track.points[i]);
            if (here > 0) speeds.push_back({here, together, &track, track.points[i].line});
        }
    }

    void judge_speeds() {
        const std::optional<Median> median = median_of_all();
        if (!median) return;
        median_ = median->speed;
        if (!has_metres()) return;
        double fastest = 0;
        for (const Track& track : file_.tracks) {
            const double of_class = fastest_of(label(track), kOfPeople);
            fastest = std::max(fastest, of_class);
            if (road_user(label(track))) believed_ = std::max(believed_, of_class);
        }
        // Who stands makes some headway by chance, and noise is fast in single steps, or where it goes anywhere.
        const bool is_fast = median_ > fastest && median->together > fastest && median->share >= kLeastOfNoise;
        const bool is_slow = median_ < kSlowMedian && median->share >= kLeastShare;
        const bool is_absurd = median_ > believed_ || median_ < kSlowestMedian;
        const bool is_proven = median->of >= kFewestSpeeds && !file_.alone;
        if ((!is_fast && !is_slow) || (!is_proven && (scale_.is_said || !is_absurd))) return;
        const std::string said = "the median speed of who moves is " + brief(median_) + " m/s (" +
                                 (file_.alone ? "" : "track " + in_quotes(median->track->id) + ", ") +
                                 at_line(median->line) + "), " +
                                 (is_slow                    ? "slower than anybody walks"
                                  : fastest > kFastestPerson ? "faster than its class is"
                                                             : "faster than people are") +
                                 remedies();
        if (is_absurd && is_proven && !scale_.is_said)
            throw std::invalid_argument(said + "; give unit m if it is right");
        out_.doubt = said;
        out_.findings.push_back({said, "unit"});
    }

    /// The units that would make it a walk.
    std::string remedies() const {
        constexpr double kWalkFrom = 0.3, kWalkTo = 3;
        const auto walks = [this](double factor) {
            return median_ * factor >= kWalkFrom && median_ * factor <= kWalkTo;
        };
        std::string out;
        const auto add = [&out](const std::string& text) { out += (out.empty() ? ": if " : ", if ") + text; };
        const std::string time = file_.time_column.empty() ? "t" : file_.time_column;
        const auto when = [&](const char* how) { return file_.timed ? "columns t=" + time + how : std::string("dt"); };
        for (const auto& [factor, unit, remedy] : std::initializer_list<std::tuple<double, const char*, std::string>>{
                 {0.01, "places are in cm", "unit cm"},
                 {0.001, "places are in mm", "unit 0.001"},
                 {0.3048, "places are in feet", "unit 0.3048"},
                 {1000, "places are in km", "unit 1000"},
                 {1e3, "times are in ms", when("/1000")},
                 {1e6, "times are in us", when("/1000000")},
                 {1e9, "times are in ns", when("/1000000000")},
                 {1.0 / 60, "times are in minutes", when("*60")},
                 {1.0 / 3600, "times are in hours", when("*3600")}}) {
            if (walks(factor)) add(unit + (", give " + remedy));
        }
        if (median_ > kFastestPerson) add("places are in pixels, give unit (metres a pixel)");
        constexpr double kDegree = 111'000;  // metres
        if (walks(kDegree) || (is_on_globe() && median_ < kSlowMedian))
            add("places are degrees, project them to metres first");
        const bool counts = file_.timed && median_ < kOfPeople && has_whole_times();
        if (counts) add("times count frames, give columns frame=" + time + " and fps");
        return out;
    }

    bool has_whole_times() const {
        const auto is_whole = [](const TrackPoint& point) { return point.frame == std::floor(point.frame); };
        return std::ranges::all_of(file_.tracks,
                                   [&](const Track& track) { return std::ranges::all_of(track.points, is_whole); });
    }
    bool is_on_globe() const {
        const auto is_degree = [](const TrackPoint& at) { return std::abs(at.x) <= 180 && std::abs(at.y) <= 90; };
        return std::ranges::all_of(file_.tracks,
                                   [&](const Track& of) { return std::ranges::all_of(of.points, is_degree); });
    }

    // ---- each track

    double fastest(const Track& track) {
        if (file_.alone) return kNoLimit;
        double median = 0;
        if (label(track).empty()) {
            median = track.points.size() <= kFewestSpeeds ? median_ : median_over_steps(track.points);
        }
        const double fastest = fastest_of(label(track), median);
        // Where the unit of all is in doubt, jumps are what stands out.
        return has_metres() && median_ > believed_ ? std::max(fastest, 10 * median_) : fastest;
    }
    /// Of several steps together each, but of few of all.
    double median_over_steps(std::span<const TrackPoint> points) {
        const double most = static_cast<double>(points.size()) / 4;
        const double rows = std::max(static_cast<double>(kStepsTogether), kSecondsTogether / step_seconds());
        const auto together = static_cast<std::size_t>(std::min(rows, most));
        speeds_.clear();
        for (std::size_t i = together; i < points.size(); ++i) {
            const double here = speed(points[i - together], points[i]);
            if (here > 0) speeds_.push_back(here);
        }
        return speeds_.empty() ? 0 : median(speeds_);
    }

    static bool is_same_place(const TrackPoint& a, const TrackPoint& b) { return a.x == b.x && a.y == b.y; }
    static bool is_lost_place(const TrackPoint& at) { return (at.x == -1 && at.y == -1) || (at.x == 0 && at.y == 0); }

    /// How far a row is off the line from the one to the other beside it, file units.
    static double off_line(const TrackPoint& a, const TrackPoint& row, const TrackPoint& b) {
        const double s = (row.frame - a.frame) / (b.frame - a.frame);
        return std::hypot(a.x + s * (b.x - a.x) - row.x, a.y + s * (b.y - a.y) - row.y);
    }

    /// The median of all rows, metres.
    double noise_of_file() {
        if (!noise_of_file_) {
            const std::size_t every = file_.point_count() / kMostSpeeds + 1;
            off_line_.clear();
            for (const Track& track : file_.tracks) {
                for (std::size_t i = 1; i + 1 < track.points.size(); i += every)
                    off_line_.push_back(off_line(track.points[i - 1], track.points[i], track.points[i + 1]));
            }
            noise_of_file_ = off_line_.empty() ? 0 : median(off_line_) * scale_.metres;
        }
        return *noise_of_file_;
    }

    /// How far off rows beside points `from` and `at` are, metres: of each row from the line through those beside it,
    /// or one farther where that is less, as of somebody who is in two places by turns. Places that a tracker repeats
    /// count once.
    double noise(std::span<const TrackPoint> points, std::size_t from, std::size_t at) {
        std::vector<const TrackPoint*> rows;
        double least = kNoLimit;
        for (std::size_t stride = 1; stride <= 2; ++stride) {
            off_line_.clear();
            for (const bool behind : {false, true}) {
                rows.clear();
                for (std::size_t i = behind ? at : from; i < points.size() && rows.size() < kNoiseRows;
                     behind ? ++i : --i) {
                    if (!rows.empty() && is_pause(*rows.back(), points[i])) break;
                    if (rows.empty() || !is_same_place(*rows.back(), points[i])) rows.push_back(&points[i]);
                }
                for (std::size_t i = stride; i + stride < rows.size(); ++i)
                    off_line_.push_back(off_line(*rows[i - stride], *rows[i], *rows[i + stride]));
            }
            if (!off_line_.empty()) least = std::min(least, median(off_line_) * scale_.metres);
            if (stride == 1 && off_line_.size() < kFewestNoise)
                return std::max(noise_of_file(), least == kNoLimit ? 0 : least);
        }
        return least;
    }

    /// Longer ways, in metres, from point `from` to `at` are neither its class's, nor what trackers catch up, nor
    /// noise.
    double farthest(std::span<const TrackPoint> points, std::size_t from, std::size_t at, double fastest) {
        const TrackPoint &a = points[from], &b = points[at];
        const double least = is_lost_place(a) || is_lost_place(b) ? kLeastLost : kLeastJump;
        const double can = fastest * seconds(a, b), most = std::max(can, least);
        return metres(a, b) > most ? std::max(most, can + kNoise * noise(points, from, at)) : most;
    }

    /// Whether nobody of the class gets from point `from` to `at`, between which the place is that of `from`, unless it
    /// goes on like that, or came like that. `run`: that of `from`.
    bool is_jump(std::span<const TrackPoint> points, const Run& run, std::size_t from, std::size_t at, double fastest) {
        // Back from where it jumped to.
        if (run.after_jump && from == run.first &&
            metres(points[from - 1], points[at]) < metres(points[from - 1], points[from]) / 2)
            return true;
        const double most = farthest(points, from, at, fastest);
        const auto is_far = [&](std::size_t i, std::size_t j) { return metres(points[i], points[j]) > most; };
        if (!is_far(from, at)) return false;
        // Noise is as far in one row, but not in those beside it; a row that is off by itself is to be found all the
        // same.
        const bool is_last = at + 1 == points.size() || is_pause(points[at], points[at + 1]);
        const bool is_alone = is_last || is_far(at, at + 1);
        if (!is_alone && (!is_far(from, at + 1) || (from > run.first && !is_far(from - 1, at)))) return false;
        const Velocity here = velocity(points[from], points[at]);
        if (here.speed() > std::max(fastest, kFastestOfAll)) return true;
        const auto goes_on = [&](std::size_t other) {
            if (other < 1 || other >= points.size() || is_pause(points[other - 1], points[other])) return false;
            const Velocity there = velocity(points[other - 1], points[other]);
            return std::hypot(there.x - here.x, there.y - here.y) <= here.speed() / 2;
        };
        return !goes_on(from) && !goes_on(at + 1);
    }

    std::vector<Run> runs_of(const Track& track, double fastest) {
        const std::span<const TrackPoint> points = track.points;
        std::vector<Run> out{{0, points.size()}};
        if (file_.alone) return out;
        std::size_t held = 0;  // from here on the place is that of the row before
        for (std::size_t at = 1; at < points.size(); ++at) {
            const TrackPoint& before = points[at - 1];
            if (!is_same_place(points[held], before)) held = at - 1;
            // Who stands for long stands, and who came by a jump is not held there.
            const bool is_held = (held > out.back().first || !out.back().after_jump) && !is_lost_place(before) &&
                                 !is_pause(points[held], points[at]);
            const bool pauses = is_pause(before, points[at]);
            const bool jumps =
                !pauses && has_metres() && is_jump(points, out.back(), is_held ? held : at - 1, at, fastest);
            if (!pauses && !jumps) {
                const double here = speed(before, points[at]);
                if (has_metres() && here > kTooFast * fastest && metres(before, points[at]) >= kLeastTold)
                    fast_.take(here / fastest, track, before, points[at]);
                continue;
            }
            out.back().last = at;
            out.back().before_jump = jumps;
            out.push_back({at, points.size(), jumps, false});
        }
        return out;
    }

    static bool stands(std::span<const TrackPoint> points, const Run& run) {
        const TrackPoint& first = points[run.first];
        return std::ranges::all_of(points.subspan(run.first, run.last - run.first),
                                   [&](const TrackPoint& at) { return at.x == first.x && at.y == first.y; });
    }

    /// Finds breaks, and where somebody jumps to, stands, and jumps away from: (-1, -1), (0, 0), or a place where that
    /// is so twice.
    void look_at(const Track& track) {
        limits_.push_back(fastest(track));
        std::vector<Run> runs = runs_of(track, limits_.back());
        if (runs.size() == 1) return;
        for (const Run& run : runs) {
            const TrackPoint& at = track.points[run.first];
            if ((!run.after_jump && !run.before_jump) || !stands(track.points, run)) continue;
            // Two who swap places came to each once.
            const bool again = run.after_jump && !jumped_to_.insert({at.x, at.y}).second;
            if (again || is_lost_place(at)) lost_.insert({at.x, at.y});
        }
        broken_.emplace(&track, std::move(runs));
    }

    /// When nobody is seen for longer than a pause, between rows of two tracks at least.
    void find_clock_steps() {
        if (broken_.size() < 2) return;
        std::vector<Hole> seen;
        for (const Track& track : file_.tracks) {
            const auto broken = broken_.find(&track);
            std::size_t first = 0;
            const std::size_t runs = broken == broken_.end() ? 1 : broken->second.size();
            for (std::size_t i = 0; i < runs; ++i) {
                const std::size_t last = i + 1 < runs ? broken->second[i].last : track.points.size();
                seen.push_back({track.points[first].frame, track.points[last - 1].frame});
                first = last;
            }
        }
        std::ranges::sort(seen, {}, &Hole::begin);
        double end = seen.front().end;
        for (const Hole& run : seen) {
            if ((run.begin - end) * scale_.seconds > longest_pause_) holes_.push_back({end, run.begin});
            end = std::max(end, run.end);
        }
        for (const auto& [track, runs] : broken_) {
            for (std::size_t i = 1; i < runs.size(); ++i) {
                if (Hole* hole = hole_in(track->points[runs[i].first - 1], track->points[runs[i].first]))
                    ++hole->tracks;
            }
        }
        std::erase_if(holes_, [](const Hole& hole) { return hole.tracks < 2; });
    }
    /// The one that a pause is, but for less than a pause; null: none.
    Hole* hole_in(const TrackPoint& a, const TrackPoint& b) {
        const auto hole = std::ranges::lower_bound(holes_, a.frame, {}, &Hole::begin);
        const bool is_it = hole != holes_.end() && hole->end <= b.frame &&
                           (b.frame - a.frame - (hole->end - hole->begin)) * scale_.seconds <= longest_pause_;
        return is_it ? &*hole : nullptr;
    }

    bool is_lost(std::span<const TrackPoint> points, const Run& run) const {
        const TrackPoint& at = points[run.first];
        return !lost_.empty() && lost_.contains({at.x, at.y}) && stands(points, run);
    }

    /// Whether one can get from point `from` to `to` without what is between.
    bool goes_on(std::span<const TrackPoint> points, std::size_t from, std::size_t to, double fastest) {
        return !is_pause(points[from], points[to]) &&
               metres(points[from], points[to]) <= farthest(points, from, to, fastest);
    }
    /// How many runs from `first` on are off the way from the rows before them to those behind: one place, or few rows;
    /// at either end one row.
    std::size_t runs_off(std::span<const TrackPoint> points, std::span<const Run> runs, std::size_t first,
                         double fastest) {
        const Run& run = runs[first];
        const auto is_row = [&](std::size_t i) { return runs[i].last == runs[i].first + 1; };
        if (first == 0) return run.before_jump && is_row(0) && !is_row(1) ? 1 : 0;
        if (!run.after_jump) return 0;
        if (first + 1 == runs.size()) return is_row(first) && !is_row(first - 1) ? 1 : 0;
        for (std::size_t end = first + 1; end < runs.size() && runs[end].after_jump; ++end) {
            const bool is_place = end == first + 1 && stands(points, run);
            if (!is_place && runs[end].first - run.first > kMostOff) break;
            if (goes_on(points, run.first - 1, runs[end].first, fastest)) return end - first;
        }
        return 0;
    }

    /// Adds parts of a track that has so many, one a floor; gives how many it has then.
    std::size_t add(const Track& track, std::span<const TrackPoint> points, double limit, std::size_t number) {
        for (std::size_t from = 0, to = 0; from < points.size(); from = to) {
            int floor = storeys_.of(points[from]);
            for (to = from + 1; to < points.size(); ++to) {
                const int next = storeys_.of(points[to]);
                if (floor >= 0 && next >= 0 && next != floor) break;
                floor = std::max(floor, next);
            }
            moves_ += from > 0;
            // Between floors it is on both.
            const std::size_t first = from > 0 ? from - 1 : 0, last = std::min(to + 1, points.size());
            out_.parts.push_back({&track, ++number == 1 ? track.id : part_id(track.id, number),
                                  points.subspan(first, last - first), limit,
                                  floor < 0 ? "" : storeys_.names[static_cast<std::size_t>(floor)]});
        }
        return number;
    }

    void take_apart(const Track& track, double limit) {
        const std::span<const TrackPoint> points = track.points;
        const auto broken = broken_.find(&track);
        const std::vector<Run> runs = broken == broken_.end() ? std::vector<Run>{{0, points.size()}} : broken->second;
        const auto count_break = [&](const TrackPoint& a, const TrackPoint& b) {
            if (const Hole* hole = is_pause(a, b) ? hole_in(a, b) : nullptr) {
                clock_.take((hole->end - hole->begin) * scale_.seconds / longest_pause_, track, a, b);
            } else if (is_pause(a, b)) {
                pauses_.take(seconds(a, b) / longest_pause_, track, a, b);
            } else {
                jumps_.take(speed(a, b) / limit, track, a, b);
            }
        };
        if (scale_.keeps_jumps) {
            for (std::size_t i = 1; i < runs.size(); ++i) count_break(points[runs[i].first - 1], points[runs[i].first]);
        }
        if (scale_.keeps_jumps || (runs.size() == 1 && !(points.size() > 1 && is_lost(points, runs.front())))) {
            add(track, points, limit, 0);
            return;
        }
        std::vector<Run> kept;
        for (std::size_t i = 0, off_until = 0; i < runs.size(); ++i) {
            const Run& run = runs[i];
            if (i >= off_until) off_until = i + runs_off(points, runs, i, limit);
            if (i < off_until || is_lost(points, run)) {
                left_out_ += run.last - run.first;
                const std::size_t from = run.first > 0 ? run.first - 1 : std::min(run.last, points.size() - 1);
                off_.take(speed(points[from], points[run.first]) / limit, track, points[from], points[run.first]);
            } else {
                kept.push_back(run);
            }
        }
        std::size_t number = 0;
        for (std::size_t i = 0; i < kept.size();) {
            if (i > 0) count_break(points[kept[i - 1].last - 1], points[kept[i].first]);
            std::size_t end = i + 1;
            // What lies on both sides of rows that are left out is one where it can be.
            while (end < kept.size() && kept[end].first > kept[end - 1].last &&
                   goes_on(points, kept[end - 1].last - 1, kept[end].first, limit))
                ++end;
            if (end == i + 1) {
                number = add(track, points.subspan(kept[i].first, kept[i].last - kept[i].first), limit, number);
            } else {
                std::vector<TrackPoint>& made = out_.made.emplace_back();
                for (std::size_t k = i; k < end; ++k)
                    made.insert(made.end(), points.begin() + std::ptrdiff_t(kept[k].first),
                                points.begin() + std::ptrdiff_t(kept[k].last));
                number = add(track, made, limit, number);
            }
            i = end;
        }
    }

    /// Not that of another track.
    std::string part_id(const std::string& id, std::size_t number) {
        if (ids_.empty()) {
            for (const Track& track : file_.tracks) ids_.insert(track.id);
        }
        std::string out;
        do {
            out = id + '#' + std::to_string(number++);
        } while (ids_.contains(out));
        ids_.insert(out);
        return out;
    }

    // ---- what is said

    void tell() {
        std::vector<std::pair<double, ImportWarning>> found;
        const auto track = [](const Worst& worst) { return "track " + in_quotes(worst.track->id); };
        const auto far = [this](const Worst& worst) { return brief(metres(worst.from, worst.to)) + " m"; };
        const auto step = [&](const Worst& worst) {
            return " faster than its class can be, the worst " + far(worst) + " in " +
                   brief(seconds(worst.from, worst.to)) + " s (" + brief(speed(worst.from, worst.to)) + " m/s), " +
                   track(worst);
        };
        const char* const remedy = "; give keep_jumps if that is right";
        const auto find = [&](const Worst& worst, const std::string& text, const char* kept) {
            const std::string done = scale_.keeps_jumps ? kept : "tracks are split there";
            found.push_back({worst.by, {text + ": " + done + remedy, "keep_jumps", worst.to.line}});
        };
        if (jumps_.count > 0) {
            find(jumps_, counted(jumps_.count, "jump is", "jumps are") + step(jumps_) + " to " + place_words(jumps_.to),
                 "they are kept");
        }
        if (fast_.count > 0) {
            found.push_back({0,
                             {counted(fast_.count, "step is", "steps are") + step(fast_) +
                                  ", but the way goes on from there, as in noise or behind a tracker that catches up: "
                                  "conflicts that rest on " +
                                  (fast_.count == 1 ? "it" : "them") + " are marked",
                              "", fast_.to.line}});
        }
        if (off_.count > 0) {
            found.push_back({off_.by,
                             {counted(left_out_, "row is", "rows are") +
                                  " left out, as nobody is there: who is lost is written so, or a point is off, the "
                                  "farthest " +
                                  far(off_) + ", " + track(off_) + " at " + place_words(off_.to) + remedy,
                              "keep_jumps", off_.to.line}});
        }
        if (pauses_.count > 0) {
            constexpr double kElsewhere = 1;  // metres
            find(pauses_,
                 counted(pauses_.count, "pause is", "pauses are") + " longer than " + brief(longest_pause_) +
                     " s, the longest " + brief(seconds(pauses_.from, pauses_.to)) + " s, " + track(pauses_) +
                     ", which goes on " + far(pauses_) + " off" +
                     (metres(pauses_.from, pauses_.to) > kElsewhere ? " (is the id used again, or does the clock step?)"
                                                                    : ""),
                 "they are filled");
        }
        if (clock_.count > 0) {
            find(clock_,
                 "the clock steps by " + brief(clock_.by * longest_pause_) + " s for all at once" +
                     (holes_.size() > 1 ? ", and " + counted(holes_.size() - 1, "time", "times") + " more" : "") +
                     ", " + track(clock_) + " among them (did the recording stop, or was the clock set?)",
                 "that is filled");
        }
        std::ranges::stable_sort(found, std::greater<>{}, &std::pair<double, ImportWarning>::first);
        for (auto& [by, finding] : found) out_.findings.push_back(std::move(finding));
        if (moves_ > 0)
            out_.findings.push_back(
                {counted(moves_, "change of floors is", "changes of floors are") + " seen: tracks are split there"});
    }

    const TrackFile& file_;
    TrackScale scale_;
    const Storeys& storeys_;
    double longest_pause_;
    double median_ = 0;                 ///< m/s of who moves
    double believed_ = kFastestMedian;  ///< more is no median
    std::vector<double> limits_;        ///< by track, m/s
    std::unordered_map<const Track*, std::vector<Run>> broken_;
    std::set<Place> jumped_to_, lost_;
    std::vector<double> speeds_;  ///< of a track
    std::optional<double> noise_of_file_;
    std::vector<double> off_line_;  ///< metres, of rows
    Worst jumps_, fast_, pauses_, clock_, off_;
    std::vector<Hole> holes_;   ///< clock steps, in order
    std::size_t left_out_ = 0;  ///< rows
    std::size_t moves_ = 0;     ///< between floors
    std::set<std::string> ids_;
    JudgedTracks out_;
};

}  // namespace

double fastest_of(std::string_view label, double median) {
    if (const RoadUser* user = road_user(label)) return user->fastest;
    return median > kOfPeople ? kFastestOfAll : kFastestPerson;
}

double longest_pause(double step) { return std::max(kLongestPause, kMostStepsOfPause * step); }

JudgedTracks judge(const TrackFile& file, const TrackScale& scale, const Storeys& storeys) {
    return Judge(file, scale, storeys).judged();
}

}  // namespace mobbscope
