/// Whether the numbers of tracks can be people, bikes, cars or robots. Tracks are taken apart where they cannot be
/// one's.
#pragma once

#include <import/tracks/storeys.h>
#include <import/tracks/tracks.h>

#include <deque>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace mobbscope {

/// Metres a second that nobody of a class exceeds: 8 of people. `median`: of who has no class, what they do when they
/// move.
double fastest_of(std::string_view label, double median);

/// Seconds: after longer ones a track is another one. `step`: usual, in seconds.
double longest_pause(double step);

/// How file units become metres and seconds, and how far the user is believed.
struct TrackScale {
    double metres = 1;         ///< per unit of length
    double seconds = 1;        ///< per frame
    double step = 1;           ///< usual, in frames
    bool is_said = false;      ///< an option says the unit of lengths or times: nothing is refused
    bool keeps_jumps = false;  ///< tracks stay whole
};

/// What is taken for one agent.
struct TrackPart {
    const Track* track = nullptr;
    std::string id{};                      ///< "17"; of further parts "17#2"
    std::span<const TrackPoint> points{};  ///< at least one
    double fastest = 0;                    ///< metres a second: what is faster is no motion of its class
    std::string floor{};                   ///< see ImportedClip

    int first_line() const { return points.front().line; }
};

/// A file that was judged.
struct JudgedTracks {
    std::vector<TrackPart> parts{};
    std::vector<ImportWarning> findings{};       ///< worst first, one a kind
    std::string doubt{};                         ///< of the speeds of all; empty: somebody moves like that
    std::deque<std::vector<TrackPoint>> made{};  ///< points of parts that lack some of their tracks'
};

/// Who changes floors is two, both there from the last point on the one to the first on the other. Throws
/// std::invalid_argument where who moves has a median speed over 45 or under 0.01 m/s, unless the scale is said
/// or few rows tell it.
JudgedTracks judge(const TrackFile& file, const TrackScale& scale, const Storeys& storeys);

}  // namespace mobbscope
