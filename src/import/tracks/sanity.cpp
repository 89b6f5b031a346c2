#include <base/text.h>
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
constexpr double kFastestOfAll = 70;     // cars
constexpr double kFastestMedian = 45;    // no recording has more
constexpr double kSlowestMedian = 0.01;  // nor less
constexpr double kSlowMedian = 0.1;      // slower than anybody walks
constexpr double kOfPeople = 4;          // median of who has no class: over it they drive
constexpr double kLeastJump = 0.5;       // metres: less is noise
constexpr double kLongestPause = 5;      // seconds
constexpr double kMostStepsOfPause = 20;
constexpr std::size_t kMostSpeeds = 1 << 16;  // points that a median is taken of, about
constexpr std::size_t kFewestSpeeds = 10;     // that prove anything
constexpr std::size_t kStepsTogether = 10;    // of which a speed is taken: noise goes nowhere
constexpr double kLeastShare = 0.5;           // of the time in which they move, for their being slow to be told
constexpr double kLeastHeadway = 0.3;         // of who moves: the way that is left of the path

/// By a part of the class's name in small letters; the first that fits.
struct Mover {
    std::string_view word;
    double fastest;         ///< m/s
    bool is_whole = false;  ///< the word stands alone, or with an s: a businessman is no bus
};
constexpr Mover kMovers[] = {
    {"motor", kFastestOfAll},
    {"ped", kFastestPerson},
    {"person", kFastestPerson},
    {"people", kFastestPerson},
    {"human", kFastestPerson},
    {"child", kFastestPerson},
    {"adult", kFastestPerson},
    {"walk", kFastestPerson},
    {"skat", 20},
    {"scoot", 20},
    {"bik", 20},
    {"cycl", 20},
    {"robot", 20},
    {"agv", 20, true},
    {"drone", 40},
    {"uav", 40, true},
    {"car", kFastestOfAll, true},
    {"bus", kFastestOfAll, true},
    {"truck", kFastestOfAll},
    {"van", kFastestOfAll, true},
    {"taxi", kFastestOfAll},
    {"tram", kFastestOfAll},
    {"vehicle", kFastestOfAll},
    {"trailer", kFastestOfAll},
};

/// In small letters.
bool is_of(std::string_view label, const Mover& mover) {
    const auto is_letter = [&](std::size_t at) { return at < label.size() && label[at] >= 'a' && label[at] <= 'z'; };
    const std::string_view word = mover.word;
    for (std::size_t at = label.find(word); at != std::string_view::npos; at = label.find(word, at + 1)) {
        std::size_t end = at + word.size();
        if (end < label.size() && label[end] == 's') ++end;
        if (!mover.is_whole || ((at == 0 || !is_letter(at - 1)) && !is_letter(end))) return true;
    }
    return false;
}

/// Null for a class that none fits.
const Mover* mover_of(std::string_view label) {
    const std::string small = lower(label);
    const auto* const at = std::ranges::find_if(kMovers, [&](const Mover& mover) { return is_of(small, mover); });
    return at == std::end(kMovers) ? nullptr : at;
}

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
        if (!track || how_bad > by) *this = {count, how_bad, &of, a, b};
    }
};

using Place = std::pair<double, double>;

std::string place_words(const TrackPoint& point) { return "(" + brief(point.x) + ", " + brief(point.y) + ")"; }

class Judge {
  public:
    Judge(const TrackFile& file, const TrackScale& scale)
        : file_(file), scale_(scale), longest_pause_(longest_pause(step_seconds())) {}

    JudgedTracks judged() {
        out_.parts.reserve(file_.tracks.size());
        if (file_.format == "mapf") {
            for (const Track& track : file_.tracks) out_.parts.push_back({&track, track.id, track.points, kNoLimit});
            return std::move(out_);
        }
        judge_speeds();
        for (const Track& track : file_.tracks) look_at(track);
        for (std::size_t i = 0; i < file_.tracks.size(); ++i) take_apart(file_.tracks[i], limits_[i]);
        if (out_.parts.empty()) {
            // Nobody is left: then the places are places.
            lost_.clear();
            jumps_ = pauses_ = off_ = {};
            left_out_ = 0;
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

    /// Its class; else what ids are called ("Vehicle_ID"), where that is one.
    std::string_view label(const Track& track) const {
        return !track.label.empty()        ? std::string_view(track.label)
               : mover_of(file_.id_column) ? file_.id_column
                                           : std::string_view();
    }

    // ---- speeds of all

    /// The median of the steps in which somebody moves, and one as fast. Noise goes nowhere: it does not move.
    struct Median {
        double speed = 0;
        const Track* track = nullptr;
        int line = 0;
        std::size_t of = 0;  ///< so many
        double share = 0;    ///< of the time somebody makes headway
    };
    std::optional<Median> median_of_all() const {
        std::size_t points = 0;
        for (const Track& track : file_.tracks) points += track.points.size();
        const std::size_t every = points / kMostSpeeds + 1;
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
        std::ranges::nth_element(speeds, middle, {}, &Median::speed);
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
        for (std::size_t i = first + 1; i <= last; ++i) {
            const double here = speed(track.points[i - 1], track.points[i]);
            if (here > 0) speeds.push_back({here, &track, track.points[i].line});
        }
    }

    void judge_speeds() {
        const std::optional<Median> median = median_of_all();
        if (!median) return;
        median_ = median->speed;
        if (!has_metres()) return;
        double fastest = 0;
        for (const Track& track : file_.tracks)
            fastest = std::max(fastest, std::min(fastest_of(label(track), kOfPeople), kFastestMedian));
        // Who stands makes some headway by chance.
        const bool is_fast = median_ > fastest, is_slow = median_ < kSlowMedian && median->share >= kLeastShare;
        const bool is_absurd = median_ > kFastestMedian || median_ < kSlowestMedian;
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
        for (const auto& [factor, text] :
             std::initializer_list<std::pair<double, const char*>>{{0.01, "places are in cm, give unit cm"},
                                                                   {0.001, "places are in mm, give unit 0.001"},
                                                                   {0.3048, "places are in feet, give unit 0.3048"},
                                                                   {1000, "places are in km, give unit 1000"}}) {
            if (walks(factor)) add(text);
        }
        if (median_ > kFastestPerson) add("places are in pixels, give unit (metres a pixel)");
        constexpr double kDegree = 111'000;  // metres
        if (walks(kDegree) || (is_on_globe() && median_ < kSlowMedian))
            add("places are degrees, project them to metres first");
        const std::string time = file_.time_column.empty() ? "t" : file_.time_column;
        const char* const columns = "columns t=";
        for (const auto& [factor, text, how] : std::initializer_list<std::tuple<double, const char*, const char*>>{
                 {1e3, "times are in ms", "/1000"},
                 {1e6, "times are in us", "/1000000"},
                 {1e9, "times are in ns", "/1000000000"},
                 {1.0 / 60, "times are in minutes", "*60"},
                 {1.0 / 3600, "times are in hours", "*3600"}}) {
            if (!walks(factor)) continue;
            add(std::string(text) + ", give " + (file_.timed ? columns + time + how : std::string("dt")));
        }
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
            speeds_.clear();
            for (std::size_t i = 1; i < track.points.size(); ++i) {
                const double here = speed(track.points[i - 1], track.points[i]);
                if (here > 0) speeds_.push_back(here);
            }
            const auto middle = speeds_.begin() + std::ssize(speeds_) / 2;
            std::ranges::nth_element(speeds_, middle);
            median = speeds_.size() < kFewestSpeeds ? median_ : *middle;
        }
        const double fastest = fastest_of(label(track), median);
        // Where the unit of all is in doubt, jumps are what stands out.
        return has_metres() && median_ > kFastestMedian ? std::max(fastest, 10 * median_) : fastest;
    }

    /// Whether nobody of the class gets from point `at` - 1 to `at`, unless it goes on like that, or came like that.
    bool is_jump(std::span<const TrackPoint> points, std::size_t at, double fastest) const {
        const Velocity here = velocity(points[at - 1], points[at]);
        const double speed = here.speed();
        if (!(speed > fastest) || metres(points[at - 1], points[at]) < kLeastJump) return false;
        if (speed > std::max(fastest, kFastestOfAll)) return true;
        const auto goes_on = [&](std::size_t other) {
            if (other < 1 || other >= points.size() || is_pause(points[other - 1], points[other])) return false;
            const Velocity there = velocity(points[other - 1], points[other]);
            return std::hypot(there.x - here.x, there.y - here.y) <= speed / 2;
        };
        return !goes_on(at - 1) && !goes_on(at + 1);
    }

    std::vector<Run> runs_of(const Track& track, double fastest) const {
        const std::span<const TrackPoint> points = track.points;
        std::vector<Run> out{{0, points.size()}};
        if (file_.alone) return out;
        for (std::size_t at = 1; at < points.size(); ++at) {
            const bool pauses = is_pause(points[at - 1], points[at]);
            const bool jumps = !pauses && has_metres() && is_jump(points, at, fastest);
            if (!pauses && !jumps) continue;
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
    static bool is_lost_place(const TrackPoint& at) { return (at.x == -1 && at.y == -1) || (at.x == 0 && at.y == 0); }

    /// Finds breaks, and where somebody jumps to, stands, and jumps away from: (-1, -1), (0, 0), or a place where that
    /// is so twice.
    void look_at(const Track& track) {
        limits_.push_back(fastest(track));
        std::vector<Run> runs = runs_of(track, limits_.back());
        if (runs.size() == 1) return;
        for (const Run& run : runs) {
            const TrackPoint& at = track.points[run.first];
            if ((!run.after_jump && !run.before_jump) || !stands(track.points, run)) continue;
            if (is_lost_place(at) || !jumped_to_.insert({at.x, at.y}).second) lost_.insert({at.x, at.y});
        }
        broken_.emplace(&track, std::move(runs));
    }

    bool is_lost(std::span<const TrackPoint> points, const Run& run) const {
        const TrackPoint& at = points[run.first];
        return !lost_.empty() && lost_.contains({at.x, at.y}) && stands(points, run);
    }

    /// Whether one can get from `a` to `b` without what is between.
    bool goes_on(const TrackPoint& a, const TrackPoint& b, double fastest) const {
        return !is_pause(a, b) && speed(a, b) <= fastest;
    }

    void take_apart(const Track& track, double limit) {
        const std::span<const TrackPoint> points = track.points;
        const auto broken = broken_.find(&track);
        const std::vector<Run> runs = broken == broken_.end() ? std::vector<Run>{{0, points.size()}} : broken->second;
        const auto add = [&](std::span<const TrackPoint> part, std::size_t number) {
            out_.parts.push_back({&track, number == 1 ? track.id : part_id(track.id, number), part, limit});
        };
        const auto count_break = [&](const TrackPoint& a, const TrackPoint& b) {
            if (is_pause(a, b)) {
                pauses_.take(seconds(a, b) / longest_pause_, track, a, b);
            } else {
                jumps_.take(speed(a, b) / limit, track, a, b);
            }
        };
        if (scale_.keeps_jumps) {
            for (std::size_t i = 1; i < runs.size(); ++i) count_break(points[runs[i].first - 1], points[runs[i].first]);
        }
        if (scale_.keeps_jumps || (runs.size() == 1 && !(points.size() > 1 && is_lost(points, runs.front())))) {
            add(points, 1);
            return;
        }
        std::vector<Run> kept;
        for (std::size_t i = 0; i < runs.size(); ++i) {
            const Run& run = runs[i];
            const bool is_between = run.after_jump && run.before_jump && i > 0 && i + 1 < runs.size();
            const bool is_off =
                is_between && stands(points, run) && goes_on(points[run.first - 1], points[run.last], limit);
            if (is_off || is_lost(points, run)) {
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
                   goes_on(points[kept[end - 1].last - 1], points[kept[end].first], limit))
                ++end;
            if (end == i + 1) {
                add(points.subspan(kept[i].first, kept[i].last - kept[i].first), ++number);
            } else {
                std::vector<TrackPoint>& made = out_.made.emplace_back();
                for (std::size_t k = i; k < end; ++k)
                    made.insert(made.end(), points.begin() + std::ptrdiff_t(kept[k].first),
                                points.begin() + std::ptrdiff_t(kept[k].last));
                add(made, ++number);
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
        const char* const remedy = "; give keep_jumps if that is right";
        const auto track = [](const Worst& worst) { return "track " + in_quotes(worst.track->id); };
        if (jumps_.count > 0) {
            const double length = metres(jumps_.from, jumps_.to), time = seconds(jumps_.from, jumps_.to);
            found.push_back(
                {jumps_.by,
                 {counted(jumps_.count, "jump is", "jumps are") + " faster than its class can be, the worst " +
                      brief(length) + " m in " + brief(time) + " s (" + brief(length / time) + " m/s), " +
                      track(jumps_) + " to " + place_words(jumps_.to) + ": " +
                      (scale_.keeps_jumps ? "they are kept" : "tracks are split there") + remedy,
                  "keep_jumps", jumps_.to.line}});
        }
        if (off_.count > 0) {
            found.push_back(
                {off_.by,
                 {counted(left_out_, "row is", "rows are") +
                      " left out, as nobody is there: who is lost is "
                      "written so, or a point is off, the farthest " +
                      brief(metres(off_.from, off_.to)) + " m, " + track(off_) + " at " + place_words(off_.to) + remedy,
                  "keep_jumps", off_.to.line}});
        }
        if (pauses_.count > 0) {
            constexpr double kElsewhere = 1;  // metres
            const bool far = metres(pauses_.from, pauses_.to) > kElsewhere;
            found.push_back(
                {pauses_.by,
                 {counted(pauses_.count, "pause is", "pauses are") + " longer than " + brief(longest_pause_) +
                      " s, the longest " + brief(seconds(pauses_.from, pauses_.to)) + " s, " + track(pauses_) +
                      ", which goes on " + brief(metres(pauses_.from, pauses_.to)) + " m off" +
                      (far ? " (is the id used again, or does the clock step?): " : ": ") +
                      (scale_.keeps_jumps ? "they are filled" : "tracks are split there") + remedy,
                  "keep_jumps", pauses_.to.line}});
        }
        std::ranges::stable_sort(found, std::greater<>{}, &std::pair<double, ImportWarning>::first);
        for (auto& [by, finding] : found) out_.findings.push_back(std::move(finding));
    }

    const TrackFile& file_;
    TrackScale scale_;
    double longest_pause_;
    double median_ = 0;           ///< m/s of who moves
    std::vector<double> limits_;  ///< by track, m/s
    std::unordered_map<const Track*, std::vector<Run>> broken_;
    std::set<Place> jumped_to_, lost_;
    std::vector<double> speeds_;  ///< of a track
    Worst jumps_, pauses_, off_;
    std::size_t left_out_ = 0;  ///< rows
    std::set<std::string> ids_;
    JudgedTracks out_;
};

}  // namespace

bool is_known_class(std::string_view label) { return mover_of(label) != nullptr; }

double fastest_of(std::string_view label, double median) {
    if (const Mover* mover = mover_of(label)) return mover->fastest;
    return median > kOfPeople ? kFastestOfAll : kFastestPerson;
}

double longest_pause(double step) { return std::max(kLongestPause, kMostStepsOfPause * step); }

JudgedTracks judge(const TrackFile& file, const TrackScale& scale) { return Judge(file, scale).judged(); }

}  // namespace mobbscope
