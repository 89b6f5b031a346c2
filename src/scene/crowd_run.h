/// What a crowd did: every agent's clips, back to back (paper, Section 5). It is the key `crowd` of a scene file,
/// beside the `graph` whose moves its agents play.
#pragma once

#include <base/json.h>
#include <base/json_writer.h>
#include <mobb/clip.h>
#include <scene/scene.h>

#include <glm/vec2.hpp>

#include <cstdint>
#include <limits>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace mobbscope {

/// Why an agent plays a move.
enum class PlayKind : std::uint8_t {
    chosen,   ///< taken at random from the candidates that collide with nobody, stay on the floor, end in nobody's way
              ///< and have a way on; or straight on, of those that are best
    pivoted,  ///< none was left: the agent turns on the way of one that was
    forced,   ///< none was free however far it turns: the one that harms least. It may collide
};

/// As files name it: "chosen", "pivoted", "forced".
std::string_view name(PlayKind kind);

/// Degrees: agents turn by multiples of it.
inline constexpr double kTurnStep = 15;
/// Degrees per second: the largest CrowdRun::turn_rate that files and options have.
inline constexpr double kMaxTurnRate = 3600;
/// The turn_rate of agents that turn on the spot before a move, in no time, as they did in earlier versions.
inline constexpr double kTurnsAtOnce = std::numeric_limits<double>::infinity();

/// A move that may follow another, and how far the agent turns on its way.
struct PlannedMove {
    int move = 0;         ///< index into MotionGraph::moves, of one that is not turned itself
    double turn_deg = 0;  ///< counter-clockwise; a multiple of kTurnStep
    friend bool operator==(const PlannedMove&, const PlannedMove&) = default;
};

/// A move as an agent plays it.
struct Play {
    int move = 0;  ///< index into MotionGraph::moves
    mobb::Placement placement;
    /// Global seconds of the choice point, at most placement.start. Every agent's first play comes before all choices;
    /// choices of one time are made in the order of agents, and of one agent in the order of plays.
    double chosen_at = 0;
    PlayKind kind = PlayKind::chosen;
    /// Moves that can follow, back to back: their room is the agent's until it chooses again.
    std::vector<PlannedMove> plan{};
    friend bool operator==(const Play&, const Play&) = default;
};

struct CrowdAgent {
    std::string name;
    std::vector<Play> plays;  ///< each begins when the one before ends, dt after its last sample
    friend bool operator==(const CrowdAgent&, const CrowdAgent&) = default;
};

/// The largest seed that is the same number in every reader of JSON.
inline constexpr std::uint64_t kMaxSeed = std::uint64_t{1} << 53;

struct CrowdRun {
    glm::dvec2 area{30, 40};  ///< metres: the floor reaches from -area/2 to area/2; disks stay on it
    double seconds = 120;     ///< simulated
    std::uint64_t seed = 1;   ///< at most kMaxSeed
    double ahead = 0;         ///< seconds before its begin at which a move is chosen; 0: at the end of the one before
    double grace = 1;         ///< seconds for which agents keep out of each other's way where moves end; 0: not at all
    double plan = 0;          ///< seconds for which each choice plans how to go on; 0: not at all, as earlier versions
    /// Degrees per second: the largest angular speed that a turn on the way adds to that of the recording; 0: nobody
    /// turns. At most kMaxTurnRate, or kTurnsAtOnce.
    double turn_rate = kTurnsAtOnce;
    std::vector<CrowdAgent> agents;
    friend bool operator==(const CrowdRun&, const CrowdRun&) = default;
};

/// The crowd that plays the moves of the scene's graph. Throws InputError, at its place, if the scene has no graph, has
/// agents or queries of its own, or if a play does not begin in the hub where the one before ends, at its end and where
/// it comes to stand and the way it faces, to a millionth of a metre, second and degree. Where agents turn at once a
/// pivoted or forced play may face another way.
std::shared_ptr<const CrowdRun> read_crowd(const JsonPlace& place, const Scene& scene);

void write_crowd(JsonWriter& out, const CrowdRun& crowd);

}  // namespace mobbscope
