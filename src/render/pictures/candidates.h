/// The moves that an agent could choose, as ways, and what became of each.
#pragma once

#include <crowd/simulation/run_check.h>
#include <render/drawlist/draw_list.h>
#include <render/drawlist/picture_options.h>
#include <render/text/labels.h>
#include <scene/drawn_agent.h>
#include <scene/fitted_scene.h>

#include <array>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace mobbscope {

/// What became of a candidate.
enum class CandidateOutcome { taken, free, in_the_way, no_way_on, leaves_floor, ruled_out };
CandidateOutcome outcome_of(const Choice& choice, std::size_t candidate);

/// How its way is drawn, at scale 1: each outcome has a colour and a line of its own.
LineStyle outcome_style_of(CandidateOutcome outcome, const Palette& palette);

/// "taken", "free", "in the way", "no way on", "leaves the floor", "ruled out".
std::string_view outcome_words(CandidateOutcome outcome);

/// Those that are drawn: straight on, and turned as the one that was taken.
std::vector<std::size_t> shown_candidates(const Choice& choice);

/// "turn_left: meets 42 at 13.42 s", and why others are not taken.
std::string candidate_sentence(const Scene& run, const Choice& choice, std::size_t candidate);

/// "6 free; 15 ruled out by 42, 77; 3 leave the floor"; of a forced play none was free.
std::string outcome_counts(const Scene& run, const Choice& choice);

/// "17 chose among 24 moves at 12.87 s: 6 free; 15 ruled out by 42, 77; 3 leave the floor". Of a forced play "17 was
/// forced at 12.87 s, as none of its 24 moves was free: 21 ruled out by 42; 3 leave the floor".
std::string choice_sentence(const Scene& run, const FollowedChoice& followed);

/// Of a choice that does not come out as the run says "17 plays walk (forced) at 12.87 s, but made again the choice is
/// run: seed, grace, plays or clips were edited since, another version simulated it, or an answer was wrong"; of others
/// nothing.
std::string edited_run_warning(const Scene& run, const FollowedChoice& followed);

/// The query that decides a choice, asked through trees of that fit.
struct DecidingTrace {
    std::array<std::shared_ptr<const mobb::Tree>, 2> trees;  ///< of the candidate and of the other; none is null
    RecordedQuery recorded;
    int step = 0;  ///< that finds the contact, or that decided about when the two are nearest; -1: none was needed
};
DecidingTrace trace_of(const DecidingQuery& query, const mobb::FitOptions& fit);

/// A move of the set, or a joint: "walk, turned by 30\u00B0", "joint to walk".
std::string name_of(const MoveSet& moves, const AskedSide& side);

/// A play that the simulator would not choose: what it is and what would be, what became of either candidate, and the
/// query that decides with its step; a line each, without a stop.
std::vector<std::string> difference_lines(const MoveSet& moves, const RunDifference& difference);

/// Adds the ways: at a moment on the floor, in space-time upwards. Where one is ruled out, the two disks that meet are
/// outlined, with a cross between them; the returned labels name the agents that rule out, each once.
std::vector<LabelRequest> add_candidates(DrawList& list, const FittedScene& fitted, const FollowedChoice& followed,
                                         const Metrics& metrics);

/// Two rings around an agent's disk at a time, on the floor or in space-time; the returned label has the name, above a
/// body that is so high. Adds nothing if it is not there then.
std::vector<LabelRequest> add_followed(DrawList& list, const DrawnAgent& followed, double time, double height,
                                       const Metrics& metrics);
/// ... of a run around who plays one of the paths then.
std::vector<LabelRequest> add_followed(DrawList& list, std::span<const DrawnAgent> paths, int run_agent, double time,
                                       double height, const Metrics& metrics);

/// A line for each outcome among them.
std::vector<LegendEntry> candidate_legend(const Palette& palette, const Choice& choice);

}  // namespace mobbscope
