/// A choice point: all moves that may follow, what becomes of each, and which is taken (paper, Section 5).
#pragma once

#include <crowd/simulation/reservation_table.h>
#include <scene/crowd_run.h>
#include <scene/motion_graph.h>

#include <optional>
#include <vector>

namespace mobbscope {

/// A move that may follow, where it would be played.
struct Candidate {
    int move = 0;         ///< index into MotionGraph::moves
    double turn_deg = 0;  ///< on the spot before it, counter-clockwise
    mobb::Placement placement;
    bool leaves_floor = false;
    std::optional<Blocker> blocker;  ///< who rules it out; of those that leave the floor only a forced choice asks
    bool in_the_way = false;  ///< free, but somebody may be left without a choice, see ReservationTable::in_the_way

    bool is_free() const { return !leaves_floor && !blocker; }
};

struct Choice {
    double time = 0;  ///< global seconds at which it is made
    PlayKind kind = PlayKind::chosen;
    std::vector<Candidate> candidates;  ///< straight on, then those at every turn that was looked at
    std::size_t taken = 0;              ///< index into candidates
    std::int64_t queries = 0;           ///< pairs that the trees were asked to discard candidates
};

/// Who chooses, and after what.
struct ChoicePoint {
    int agent = 0;
    int play = 0;  ///< index among the agent's plays of the one to be chosen, > 0
    Play before;   ///< the play before it
    double time = 0;
};

/// Makes a choice: of the candidates that stay on the floor, collide with nobody and end in nobody's way one is taken
/// at random (chosen). If there is none, the agent turns on the spot, by 15 degrees either way, by 30, and so on, until
/// there is one (pivoted); if there is none at any heading, then with the least turn that leaves one at all, in the way
/// or not. If every candidate at every heading is discarded, one whose first contact is latest is taken, of those with
/// the same one whose contact is shortest, from those that stay on the floor if any does (forced). The random number
/// depends on (seed, agent, play) alone.
Choice choose(const MoveSet& moves, const ReservationTable& committed, const CrowdRun& run, const ChoicePoint& point,
              std::vector<AskedPair>* asked = nullptr);

/// The choice of one play of a run, made again exactly as it was if the run is as it was simulated. Of an agent's first
/// play, which was placed and not chosen, it has that play as its only candidate. Throws std::out_of_range if there is
/// no such agent or play.
Choice choice_of(const MoveSet& moves, const CrowdRun& run, int agent, int play);

/// A choice with whose it was.
struct FollowedChoice {
    int agent = 0;  ///< index into CrowdRun::agents
    int play = 0;   ///< the play that was chosen
    Choice choice;
};

/// Which of an agent's plays was chosen last at a time; none before its first choice.
std::optional<int> last_chosen(const CrowdAgent& agent, double time);

/// The choice of that play, made again. Throws what choice_of throws.
std::optional<FollowedChoice> last_choice(const MoveSet& moves, int agent, double time);

}  // namespace mobbscope
