/// A choice point: all moves that may follow, why each is discarded, and which is taken (paper, Section 5).
#pragma once

#include <crowd/simulation/plan_search.h>
#include <crowd/simulation/reservation_table.h>
#include <scene/crowd_run.h>
#include <scene/crowd_scene.h>
#include <scene/motion_graph.h>

#include <optional>
#include <vector>

namespace mobbscope {

/// Whom a candidate collides with.
enum class Met {
    nobody,
    plan,  ///< what another plans to play, and nothing that another plays
    play,
};

/// A move that may follow, where it would be played.
struct Candidate {
    int move = 0;         ///< index into MotionGraph::moves, of one that is not turned itself
    double turn_deg = 0;  ///< on the way of it, counter-clockwise
    int played = 0;       ///< the move turned so: index among those of the MoveSet
    mobb::Placement placement;
    bool leaves_floor = false;
    Met met = Met::nobody;             ///< candidates that leave the floor are checked only by a forced choice
    bool in_the_way = false;           ///< free, but see ReservationTable::in_the_way
    bool no_way_on = false;            ///< free and drawn, but no plan was found that could follow it
    mobb::ClipPtr clip{};              ///< of what is played; only where a choice is repeated
    std::optional<PlayJoint> joint{};  ///< that leads to it from a move before that is linear; likewise
    std::optional<Blocker> blocker{};  ///< who it collides with; likewise

    bool is_free() const { return !leaves_floor && met == Met::nobody; }
};

struct Choice {
    double time = 0;  ///< global seconds at which it is made
    PlayKind kind = PlayKind::chosen;
    std::vector<Candidate> candidates;  ///< straight on first, then by turn
    std::size_t taken = 0;              ///< index into candidates
    std::vector<PlannedMove> plan;      ///< to follow what is taken
    std::int64_t queries = 0;           ///< tree queries made to check the candidates
};

/// Which agent chooses, and after which play.
struct ChoicePoint {
    int agent = 0;
    int play = 0;  ///< index of the play to be chosen among the agent's plays, > 0
    Play before;   ///< the play before it
    double time = 0;
};

/// An answer about a candidate, taken to be the other one: to see what would have been chosen.
struct OtherAnswer {
    std::size_t candidate = 0;  ///< index into Choice::candidates
    bool about_way = false;     ///< whether it is in the way; else whether it collides
};

/// Where an agent begins: a first move, begun some time ago, somewhere on the floor where it collides with nobody and,
/// if there is room, ends in nobody's way. None: no room was found. The random numbers depend on (seed, agent) alone.
/// `search` as in choose.
std::optional<Play> first_play(const MoveSet& moves, const ReservationTable& reservations, const CrowdRun& run,
                               int agent, PlanSearch& search);

/// Makes a choice. The candidates are the moves that may follow, straight on. A joint that leads to a candidate is part
/// of it: it is tested before it. One is drawn that stays on the floor, has
/// no blocker and is not in the way, until one has a way on: a plan that lasts CrowdRun::plan seconds and collides with
/// nothing that others play or plan. It is taken (`chosen`). If there is none, the moves that turn by 15 degrees on the
/// way are the candidates too, either way, then those by 30, and so on, until there is one (`pivoted`). An agent whose
/// move before stood, ending within 0.3 m of its begin, takes one that stands again only if no turn has another (not if
/// CrowdRun::plan is 0). If no turn has one, of the candidates that are in the way one of the least turn that has a way
/// on; of those without the one whose plan is longest; of those that collide only with what others plan one of the
/// least turn. If there is none of these either (`forced`), the candidate is taken that harms least: that is for the
/// fewest seconds in contact with what others play, summed over all of them, and of several the one whose first contact
/// is latest. Candidates that stay on the floor go first; if none does, of those with as few seconds that which ends
/// least far beyond the wall. The random number depends on (seed, agent, play) alone. `search` is
/// started anew; it has the same moves, reservations and run.
Choice choose(const MoveSet& moves, const ReservationTable& reservations, const CrowdRun& run, const ChoicePoint& point,
              PlanSearch& search, std::vector<AskedPair>* asked = nullptr,
              const std::optional<OtherAnswer>& other = {});

/// Repeats the choice of one play of a run, with clips and blockers; it is exactly as it was if the run has not been
/// changed since it was simulated. An agent's first play was placed, not chosen: its choice has that play as the only
/// candidate. Throws std::out_of_range if there is no such agent or play.
Choice choice_of(const MoveSet& moves, const CrowdRun& run, int agent, int play);

/// The candidate of a choice made again that a play of the run is; none: it is none of them.
std::optional<std::size_t> candidate_played(const Play& play, const Choice& choice);

/// A choice, and the agent and play that it belongs to.
struct FollowedChoice {
    int agent = 0;  ///< index into CrowdRun::agents
    int play = 0;   ///< the play that was chosen
    Choice choice;
    bool comes_out = true;  ///< as the run says, see comes_out_as
};

/// Whether a choice made again takes what the run plays: the same move turned as far, as chosen, pivoted or forced, at
/// the same place and time to a millionth of a metre, degree and second, with the same plan. It does not where the run
/// or its clips were edited after it was simulated.
bool comes_out_as(const Play& play, const Choice& choice);

/// The agent's play that was chosen last before or at a time; none before its first choice.
std::optional<int> last_chosen(const CrowdAgent& agent, double time);

/// The choice of last_chosen's play, repeated. Throws what choice_of throws.
std::optional<FollowedChoice> last_choice(const MoveSet& moves, int agent, double time);

}  // namespace mobbscope
