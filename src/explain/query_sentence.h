/// Queries in words.
#pragma once

#include <base/text.h>
#include <explain/avoidable.h>
#include <mobb/trace.h>
#include <scene/drawn_agent.h>

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace mobbscope {

/// The two of a query, as sentences call them. They refer to the fitted scene.
std::array<DrawnAgent, 2> named_sides(const FittedScene& fitted, const SceneQuery& query);

/// A node as "<name> <level>.<place in the level>", counted from 0: "A 2.1".
std::string node_name(const DrawnAgent& agent, int node);

/// What a test found: "separated along B's long axis by 0.183 m".
std::string outcome_text(std::span<const DrawnAgent> sides, const mobb::Trace::Event& event);

/// The same in few words, for lists: "along B's long axis 0.183 m", "overlap", "apart in time".
std::string short_outcome(std::span<const DrawnAgent> sides, const mobb::Trace::Event& event);

/// A test with all digits, for comparing traces: "A 2.1 against B 2.3, obb2d: separated along B's long axis by 0.1834
/// m", "..., samples: hit (3 pairs measured, samples 4 and 5 at 0.3 m)". The event may be of another tree: a node that
/// the side's tree lacks is "A node 57".
std::string plain_sentence(std::span<const DrawnAgent> sides, const mobb::Trace::Event& event);

/// "a line keeps the disks 0.310 m apart; the box of A 2.1 is to blame"
/// `a`, `b`: what the nodes are called.
std::string avoidable_words(const AvoidableOverlap& overlap, const std::string& a, const std::string& b);

/// "The first 1200 of 4000 overlaps were judged." Of a query with more than the window can judge at once.
std::string judged_words(const AvoidableOverlaps& avoidable);

/// "12 avoidable overlaps in 40 queries; of 3 of them no box is to blame"
std::string blame_words(const BlameInScene& blame, std::size_t queries);

/// "step 14 of 0..61": where a step stands in a trace, in the same words everywhere.
std::string step_of(int step, const mobb::Trace& trace);

/// "recording stopped at event 2000000 of 5321004"; empty where all of a query was recorded.
std::string recording_words(const mobb::Trace& trace);

inline constexpr std::size_t kShortName = 10, kShortestName = 5;  // characters

/// The two with names of at most so many (>= 5) characters, or as many more as tell them apart.
std::vector<DrawnAgent> with_short_names(std::span<const DrawnAgent> sides, std::size_t most);

/// What a step shows: "step 14 of 0..61: A 2.1 against B 2.3: separated along B's long axis by 0.183 m".
std::string step_sentence(std::span<const DrawnAgent> sides, const mobb::Trace& trace, int step);

/// The same, and with short names, for pictures with less room.
std::vector<std::string> step_sentences(std::span<const DrawnAgent> sides, const mobb::Trace& trace, int step);

/// Only which step it is and what it found: "step 14: separated along B's long axis by 0.183 m"; with short names, and
/// with shorter ones.
std::vector<std::string> outcome_sentences(std::span<const DrawnAgent> sides, const mobb::Trace& trace, int step);

/// The query's answer and what it cost.
std::string answer_sentence(std::span<const DrawnAgent> sides, const RecordedQuery& recorded);

/// "12 time tests, 7 2D box tests, 5 pairs of samples".
std::string cost_words(const mobb::TestCounts& tests);

/// How deep two samples that collide overlap: "0.120 m", or "up to 0.120 m" where one of them moves, as they only touch
/// at first.
std::string overlap_words(const mobb::PlacedClip& a, const mobb::PlacedClip& b, int i, int j);

}  // namespace mobbscope
