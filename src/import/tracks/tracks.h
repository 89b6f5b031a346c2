/// Crowds as files hold them: many tracks by one clock of frame numbers or seconds; and the clips of tracks.
#pragma once

#include <base/budget.h>
#include <base/error.h>
#include <base/file.h>
#include <base/text.h>
#include <import/clip/import_options.h>
#include <import/clip/imported_clip.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

namespace mobbscope {

/// What tracks do between their points unless an option says otherwise: these are far apart.
inline constexpr mobb::Motion kMotionOfTracks = mobb::Motion::linear;

/// Frames per second; a file that says more is damaged.
inline constexpr double kMaxFrameRate = 1e6;

/// Where somebody was at a frame, in file units.
struct TrackPoint {
    double frame = 0;  ///< or seconds, see TrackFile::timed
    double x = 0;
    double y = 0;
    int line = 0;    ///< in the file, from 1
    int detail = 0;  ///< of TrackFile::details, from 1; 0: none
    double r = 0;    ///< see TrackFile::has_radius
};

/// What rows may say beside the place.
struct PointDetail {
    double length = 0, width = 0;  ///< of a body, in file units; 0: it is not told
    double heading = kUntold;      ///< degrees, counter-clockwise from x
    double z = kUntold;            ///< file units
    int floor = -1;                ///< of TrackFile::floors; -1: it is not told

    static constexpr double kUntold = std::numeric_limits<double>::quiet_NaN();
};

/// What the class of a track tells of its size.
enum class ClassSize : std::uint8_t { none, disk, body };

/// One agent's points; frames increase.
struct Track {
    std::string id;
    std::vector<TrackPoint> points;  ///< at least one
    std::string label{};             ///< its class, as the file names it; empty where it does not
    std::string scope{};             ///< of a file of several recordings: which one, "rec1"; empty: there is one

    int first_line() const { return points.front().line; }
};

/// A file as it stands, with what it or its format says of units and time. An assumption is a sentence that tells the
/// user what was taken in the file's stead and which option overrules it; empty where the file says it.
struct TrackFile {
    std::string format;         ///< "obsmat", "trajnet", "trajnetpp", "petrack", "jupedsim", "sdd", "mapf", "csv"
    std::vector<Track> tracks;  ///< at least one; ids differ; in order of first appearance

    bool alone = false;           ///< the file has no ids: its one track is a motion that is held, and nobody's
    bool timed = false;           ///< the points have times in seconds in place of frame numbers; rate is 1
    bool has_times = true;        ///< else they are numbered, and dt must say how far they are apart
    bool rate_of_steps = false;   ///< the rate counts usual steps from point to point, not frame numbers
    bool fps_is_rate = false;     ///< the option fps says the rate, and resamples nothing
    bool has_radius = false;      ///< the points have radii, in file units
    bool has_sizes = false;       ///< some points have a length and a width
    bool place_is_front = false;  ///< x and y are in the middle of a body's front, else of the body
    bool in_pixels = false;       ///< lengths are of an image, which tell no metres
    bool is_large = false;        ///< Input::is_large: the budget alone bounds its samples
    ClassSize class_size = ClassSize::none;

    int header_line = 0;             ///< of a table, from 1; 0: there is no header
    double rounding = 0;             ///< seconds: what all times are rounded to; 0: that is not known
    std::optional<double> rate = 1;  ///< frames per second, see rate_of_steps; none: fps or dt must say it
    /// Frames between points, where no track has two; none: then dt must say it.
    std::optional<double> least_step = 1;
    std::string rate_assumption{};

    double unit = 1;                         ///< metres per file unit
    std::optional<double> guessed_height{};  ///< metres: how high the heads are, where that decided the unit
    std::string unit_assumption{};

    std::vector<PointDetail> details{};
    /// Null: a point has none.
    const PointDetail* detail_of(const TrackPoint& point) const {
        return point.detail > 0 ? &details[static_cast<std::size_t>(point.detail) - 1] : nullptr;
    }
    std::vector<std::string> floors{};  ///< names, see PointDetail::floor
    std::string body_columns{};         ///< who says sizes, for a message: "the columns 'length' and 'width'"
    std::string heading_column{};       ///< empty: there are no headings

    // Of tables:
    std::string id_column{};            ///< its name, "Vehicle_ID"
    std::string time_column{};          ///< its name, where it is one
    std::vector<std::string> others{};  ///< names of columns that were ignored, each once

    std::vector<ImportWarning> warnings{};  ///< what was ignored
    Spent spent{};                          ///< of the budget

    std::size_t point_count() const {
        std::size_t out = 0;
        for (const Track& track : tracks) out += track.points.size();
        return out;
    }
};

/// What the documents say of a format of tracks.
struct FormatNote {
    std::string_view who;      ///< "TrajNet (`.txt`)"
    std::string_view columns;  ///< or keys
    std::string_view assumed;  ///< where neither the file nor an option says it
};

/// Largest frame number taken; beyond it doubles no longer tell whole numbers apart.
inline constexpr double kMaxFrame = 9007199254740992.0;

/// Bytes of memory with what becomes of them: a point in the file's tracks, in those that are made of it and in clips;
/// a track's clip, and what is said of it.
inline constexpr std::size_t kBytesOfPoint = 128;
inline constexpr std::size_t kBytesOfTrack = 2048;

/// Puts points into tracks, in any order.
class TrackCollector {
  public:
    /// `file` stands for the file in messages, and must outlive this.
    explicit TrackCollector(const std::string& file) : file_(file) {}

    /// `label`: the track's class; of several the first one stays. `detail`: null: there is none. Throws InputError if
    /// all of them take more than the budget.
    void add(std::string_view id, TrackPoint point, std::string_view label = {}, const PointDetail* detail = nullptr);
    bool empty() const { return tracks_.empty(); }
    /// The track that had a point last; there must be one.
    Track& last() { return tracks_[last_]; }
    /// Adds so much to all frames before one.
    void add_to_early(double before, double more);

    /// The tracks, each in order of its frames; `once`: without rows that say the same again. Throws InputError, naming
    /// the line, if a track is at two places in one frame; `twice` says so of the first one, up to the line of it.
    std::vector<Track> take_sorted(const std::function<std::string(const Track&, const TrackPoint&)>& twice = is_twice,
                                   bool once = false);
    std::size_t repeated() const { return repeated_; }      ///< rows that were left out
    int first_repeated() const { return first_repeated_; }  ///< line
    /// "times go back in line 42 ...", of rows that are in order else; "" if they do not.
    std::string step_back() const;
    /// As they came.
    std::vector<Track> take() { return std::move(tracks_); }
    std::vector<PointDetail> take_details() { return std::move(details_); }
    /// What they take of the budget.
    Spent take_spent() { return std::move(spent_); }

  private:
    static std::string is_twice(const Track& track, const TrackPoint& point);

    const std::string& file_;
    std::vector<Track> tracks_;
    std::vector<PointDetail> details_;
    Spent spent_;
    std::size_t used_ = 0;  ///< bytes
    std::size_t repeated_ = 0;
    int first_repeated_ = 0;
    std::size_t rows_ = 0, steps_back_ = 0;  ///< rows; those with a lower frame than the track's row before
    int back_line_ = 0;                      ///< of the first
    std::unordered_map<std::string, std::size_t> index_;
    std::size_t last_ = 0;  ///< the track that had a point last
};

/// A text without the byte order mark that it may begin with.
std::string_view without_mark(std::string_view text);

/// Takes the next line off a text that is neither blank nor a comment, without the blanks at its ends; "" at the end.
std::string_view take_row(std::string_view& text);

/// Takes a field off the front of a line, up to a sign or, for ' ', any number of blanks. What is in quotes may hold
/// what parts others.
std::string_view take_word(std::string_view& rest, char separator);

/// Whether a text begins like TrajNet++.
bool looks_like_trajnetpp(std::string_view text);

/// TrajNet++: a JSON object a line, {"scene": {...}} or {"track": {"f", "p", "x", "y"}}. Throws InputError.
TrackFile parse_trajnetpp(std::string_view text, const std::string& file);

/// Whether the bytes are an SQLite database.
bool is_sqlite(std::string_view bytes);

/// JuPedSim's: an SQLite database with the tables trajectory_data (frame, id, pos_x, pos_y) and metadata (version,
/// fps). Throws InputError naming the row.
TrackFile parse_jupedsim(std::string_view bytes, const std::string& file);

/// Whether a text begins like a plan in YAML: with `schedule:`, or with other keys before it.
bool looks_like_mapf_plan(std::string_view text);

/// A plan of multi-agent path finding in YAML: `schedule:` with a list of t, x, y for each agent. Throws InputError.
TrackFile parse_mapf_plan(std::string_view text, const std::string& file);

/// The clips of a file's tracks, or of the one that options.id names, each with the time at which it starts on the
/// crowd's common clock, which begins with the file's earliest point. Stored points are the samples; options.fps
/// resamples them (of timed tracks those out of step alone). Gaps of a track are filled linearly at the file's most
/// frequent step, which is also how long a track of one point lasts; tracks out of step are resampled (30 fps), both
/// with a warning. options.dt is the time from one frame number to the next (timed
/// tracks: how long one of one point lasts); options.trim is of the common clock, and who is not there then is left
/// out. Tracks are taken apart where they cannot be one's (sanity.h), unless options.keep_jumps says no. `spends`: the
/// points of a track are gone once its clips are made. Throws InputError.
void give_track_clips(TrackFile& tracks, const std::filesystem::path& file, const ImportOptions& options,
                      const ClipSink& sink, bool spends);
/// The same, all at once.
std::vector<ImportedClip> track_clips(TrackFile tracks, const std::filesystem::path& file,
                                      const ImportOptions& options);

/// Without ids the one track is a motion: held, uniform in time or resampled as a whole (trim takes a part before
/// that), and of no common clock. What a file has for each option; see ParsedFile::offer (import/import.h).
ImportOffer track_offer(const TrackFile& tracks, const std::filesystem::path& file, const ImportOptions& options);

}  // namespace mobbscope
