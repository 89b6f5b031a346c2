/// What an import takes and gives: options, facts about the source, clips.
#pragma once

#include <import/clip/radii.h>
#include <mobb/body.h>
#include <mobb/clip.h>

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace mobbscope {

enum class Origin { keep, start, start_heading };

/// Samples per second where neither the file nor an option says how many.
inline constexpr double kDefaultFps = 30;

/// How a file becomes clips: the import keys of a scene's clip and the import options of the command line.
/// An empty option takes the default of the contract, section 2. import_options.h lists them.
struct ImportOptions {
    std::optional<std::string> animation;           ///< index (from 0) or name; a number counts as an index
    std::optional<std::string> root;                ///< joint name
    std::optional<double> fps;                      ///< samples per second, over 0 to 1e6; default 30, or as stored
    std::optional<std::string> unit;                ///< "m", "cm", "in", "auto" or metres per file unit, over 0 to 1e6
    std::optional<std::string> up;                  ///< "y", "z" or "auto"
    std::optional<std::pair<double, double>> trim;  ///< 0 <= A < B <= kMaxTime: file seconds from the first key or row
    std::optional<Origin> origin;                   ///< default keep
    std::optional<std::string> id;                  ///< of a file of tracks: the one to take
    std::optional<Radius> radius;                   ///< metres from 0 to kMaxLength; overrides r of every sample
    /// Seconds, over 0 to kMaxTime, between rows of a CSV without a time column, or frame numbers of a file.
    std::optional<double> dt;
    /// Which columns of a table are id, t, frame, x, y and r, or how they are worked out: "id=trackId,t=frame/25".
    std::optional<std::string> columns{};
    /// What a disk does until the next sample; default linear for trajectories, plans and CSV with ids, else held.
    std::optional<mobb::Motion> motion{};
    /// Whether tracks stay whole that jump, or pause, as nobody does; default no.
    std::optional<bool> keep_jumps{};
    /// The disks of whoever walks, in place of what the file says of sizes, unless there is a radius. A scene's clip
    /// alone has them (its key `body`), so they stand in no list of options.
    std::optional<std::vector<mobb::BodyDisk>> body{};

    friend bool operator==(const ImportOptions&, const ImportOptions&) = default;
};

/// Throws std::invalid_argument, naming the option, if one is out of range whatever the file.
void check(const ImportOptions& options);

/// Metres per file unit of a checked ImportOptions::unit; nothing for "auto".
std::optional<double> metres_per_unit(const std::string& unit);

/// Names as they stand in files: "keep", "start", "start_heading".
std::string_view name(Origin origin);
std::optional<Origin> origin_from_name(std::string_view name);

/// What was ignored or looks wrong, in one sentence.
struct ImportWarning {
    std::string text;         ///< the same for all clips that it is about in the same way
    std::string option{};     ///< the key of the option that mends it; empty: none does
    int line = 0;             ///< in the file, from 1: where it shows first; 0: nowhere
    std::size_t samples = 0;  ///< of the clip: how many it is about; 0: that is not counted

    friend bool operator==(const ImportWarning&, const ImportWarning&) = default;
};

/// The whole warning: "there are gaps, which are filled linearly (3 samples, line 12)".
std::string said(const ImportWarning& warning);

/// Adds a warning where a body is not the same from all sides, and never moves: then no motion tells where it looks.
/// `whole`: all of its path.
void warn_of_no_heading(const mobb::Clip& whole, std::span<const mobb::BodyDisk> body,
                        std::vector<ImportWarning>& warnings);

/// What the file said, before sampling.
struct SourceFacts {
    std::string format;  ///< "csv", "bvh", "gltf", "fbx", or of trajectories as in import/tracks/tracks.h
    double unit = 1;     ///< metres per file unit
    int frames = 0;
    std::optional<double> dt;  ///< seconds between frames, where they are uniform
    double duration = 0;       ///< last key - first key, seconds
    std::vector<ImportWarning> warnings;

    // Of files with skeletons:
    std::string animation{};  ///< its name; "#<index>" if it has none
    std::string root{};       ///< the joint in the centre of the disks, as MotionFile::joints has it
    std::string root_why{};   ///< why it was taken, where no option names it: "the topmost joint"
    int joints = 0;           ///< in the root's subtree, itself included, End Sites not
    std::size_t rig = 0;      ///< the same for the same names of root and joints; 0: no skeleton
    std::optional<double> guessed_from_height{};  ///< metres: the body's height, where it decided the unit
    std::string up{};                             ///< the axis of the file that points up: "y", "z", "-y", ...
    std::string up_why{};                         ///< why it is, where no option names it: "as the file says"

    std::optional<double> first_key{};  ///< seconds in the file: when the animation's earliest key is

    // Of tracks:
    std::string label{};  ///< its class, "Biker"; empty where the file has none
    /// Seconds on the file's own clock: its earliest point, which is time 0 of the clock of all its tracks. None: the
    /// clip is no track.
    std::optional<double> t0{};
    /// Seconds of the clip, in order: where nobody was seen to move like that, as a gap was filled or it is too fast.
    std::vector<std::pair<double, double>> invented{};
    std::string doubt{};  ///< why the speeds of the whole file are nobody's; empty: they are somebody's

    friend bool operator==(const SourceFacts&, const SourceFacts&) = default;
};

struct Skeleton;

/// A clip and where it came from.
struct ImportedClip {
    std::string name;  ///< the file's stem; of one clip of several, the track's id or the animation's name and the root
    std::string id;    ///< of a file of tracks: the track; else empty
    mobb::ClipPtr clip;
    SourceFacts facts;
    std::string animation{};                     ///< of a file with several: ImportOptions::animation for this one
    std::string root{};                          ///< of a file with several characters: ImportOptions::root likewise
    std::shared_ptr<const Skeleton> skeleton{};  ///< null without joints, and for very long clips
    /// Seconds: when it starts on the clock of its file's tracks (SourceFacts::t0), or after the first of its takes.
    double start = 0;
    /// Of who is more than one disk: these, in place of the disks of the samples, which are around all of them.
    std::vector<mobb::BodyDisk> body{};
    std::vector<double> headings{};  ///< degrees, of a body whose file has them: one a sample; empty: as it moves
    /// Of a building, or the recording of a file of several: those of different ones never meet; empty: nobody says.
    std::string floor{};
};

/// Is given the clips of a file one by one.
using ClipSink = std::function<void(ImportedClip&& clip)>;

}  // namespace mobbscope
