/// Crowds as files hold them: many tracks by one clock of frame numbers. Where the readers of text, ndjson and YAML
/// meet track_clips.h.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace mobbscope {

/// Frames per second; a file that says more is damaged.
inline constexpr double kMaxFrameRate = 1e6;

/// Where somebody was at a frame, in file units.
struct TrackPoint {
    double frame = 0;
    double x = 0;
    double y = 0;
    int line = 0;  ///< in the file, from 1
};

/// One agent's points; frames increase.
struct Track {
    std::string id;
    std::vector<TrackPoint> points;  ///< at least one
};

/// A file as it stands, with what it or its format says of units and time. An assumption is a sentence that tells the
/// user what was taken in the file's stead and which option overrules it; empty where the file says it.
struct TrackFile {
    std::string format;         ///< "obsmat", "trajnet", "trajnetpp", "petrack", "sdd", "mapf"
    std::vector<Track> tracks;  ///< at least one; ids differ; in order of first appearance

    double rate = 1;             ///< frames per second, see rate_of_steps
    bool rate_of_steps = false;  ///< the rate counts usual steps from point to point, not frame numbers
    double least_step = 1;       ///< frames between points, where no track has two
    std::string rate_assumption{};

    double unit = 1;                         ///< metres per file unit
    std::optional<double> guessed_height{};  ///< metres: how high the heads are, where that decided the unit
    std::string unit_assumption{};

    std::vector<std::string> warnings{};  ///< what was passed over, one sentence each
};

/// Largest frame number taken; beyond it doubles no longer tell whole numbers apart.
inline constexpr double kMaxFrame = 9007199254740992.0;

/// Puts points into tracks, in any order.
class TrackCollector {
  public:
    void add(const std::string& id, const TrackPoint& point);
    bool empty() const { return tracks_.empty(); }

    /// The tracks, each in order of its frames. Throws InputError, naming `file` and the line, if a track is at two
    /// places in one frame.
    std::vector<Track> take(const std::string& file);

  private:
    std::vector<Track> tracks_;
    std::unordered_map<std::string, std::size_t> index_;
};

/// Text, told apart by its content: UCY and ETH `obsmat` (frame id x z y vx vz vy), TrajNet (frame ped x y), PeTrack
/// and JuPedSim (id frame x y z, or as a comment names the columns), SDD (id xmin ymin xmax ymax frame lost occluded
/// generated "label"). `file` stands for the file in messages. Throws InputError naming the line.
TrackFile parse_text_tracks(std::string_view text, const std::string& file);

/// TrajNet++: a JSON object a line, {"scene": {...}} or {"track": {"f", "p", "x", "y"}}. Throws InputError.
TrackFile parse_trajnetpp(std::string_view text, const std::string& file);

/// A plan of multi-agent path finding in YAML: `schedule:` with a list of t, x, y for each agent. Throws InputError.
TrackFile parse_mapf_plan(std::string_view text, const std::string& file);

}  // namespace mobbscope
