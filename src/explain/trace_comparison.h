/// Two records of one query side by side: event by event, or moment by moment where their trees differ.
#pragma once

#include <explain/certificate.h>
#include <mobb/trace.h>
#include <scene/answer.h>
#include <scene/drawn_agent.h>
#include <scene/fitted_scene.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace mobbscope {

// ---- a stored trace and a fresh one: event by event

/// The first event that differs.
struct TraceDifference {
    int step = 0;
    /// Which of its members differ, as files call them; empty: one of the two has no such event.
    std::vector<std::string_view> members;
};

struct TraceCheck {
    int compared = 0;  ///< events that agree, from the first on
    std::optional<TraceDifference> difference;
    std::int64_t stored_events = 0, present_events = 0;  ///< recorded or not
    double rounding = 0;  ///< metres: the largest difference of gaps and distances that counts as none

    bool agrees() const { return !difference && stored_events == present_events; }
};

/// How far gaps and distances may differ and still agree, times the number if that is over 1: programs of other
/// compilers and machines round otherwise, far below this.
inline constexpr double kTraceAgreement = 1e-9;

TraceCheck check_trace(const mobb::Trace& stored, const mobb::Trace& present);

/// "54 events agree with the stored trace", or the first difference with both traces' events. `sides`: of the query.
std::string check_words(const TraceCheck& check, std::span<const DrawnAgent> sides, const mobb::Trace& stored,
                        const mobb::Trace& present);

/// A step of a stored trace beside the same of the present one, each in words.
struct SteppedTraces {
    std::string stored, present;  ///< see plain_sentence
    bool agree = true;            ///< within kTraceAgreement
};
SteppedTraces traces_at(std::span<const DrawnAgent> sides, const mobb::Trace& stored, const mobb::Trace& present,
                        int step);

/// Of blocks: what is wrong if the queries that crowds ask, which only say yes or no, disagree with the one that finds
/// the contact. Of other trees nothing.
std::optional<std::string> yes_no_disagreement(const FittedScene& fitted, const SceneQuery& query, bool collides);

/// A query whose file knows its answer or its trace, asked again.
struct QueryCheck {
    SceneQuery query;
    Answer answer;                         ///< with a trace where one is stored
    std::array<DrawnAgent, 2> sides;       ///< they refer to the fitted scene
    std::optional<std::string> disagrees;  ///< with the expected answer
    std::optional<TraceCheck> trace;       ///< none: none is stored

    /// What differs; nothing if all agrees. Of a wrong answer also whether the traces agree: if they do, the fault is
    /// not in the query.
    std::optional<std::string> complaint() const;
};

QueryCheck check_query(const FittedScene& fitted, const SceneQuery& query);

// ---- two traversals: by time

/// What a traversal found out at one of its ends (TraversalEnd), and what it had cost so far.
struct Decision : TraversalEnd {
    int depth = 0;
    double gap = 0;          ///< metres, between boxes; 0 of samples
    std::int64_t tests = 0;  ///< of boxes and pairs of samples, up to and with it
};

/// The decisions of a traversal about the time that both are there, up to a contact: each begins where the one before
/// it ends. They end early where recording stopped.
std::vector<Decision> decisions_of(const mobb::PlacedTree& a, const mobb::PlacedTree& b, const RecordedQuery& recorded);

/// A time with one decision on either side.
struct ComparedTime {
    double t0 = 0, t1 = 0;                  ///< global seconds
    std::array<std::size_t, 2> decision{};  ///< of either side
    /// How many tests fewer the first side had made when it decided; below 0: the second was earlier.
    std::int64_t earlier = 0;
};

struct TraversalComparison {
    std::array<std::vector<Decision>, 2> decisions;
    /// In order; like either side's decisions they tile the time that both sides tell of.
    std::vector<ComparedTime> times;

    /// What holds at a time; none: nothing was to be decided about it.
    const ComparedTime* at(double time) const;
    const Decision& decision(const ComparedTime& time, std::size_t side) const {
        return decisions[side][time.decision[side]];
    }
};

/// Of two traversals of the same query.
TraversalComparison compared(std::vector<Decision> first, std::vector<Decision> second);

/// What a traversal was of, and what came of it.
struct RecordedTraversal {
    mobb::PlacedTree a, b;
    const RecordedQuery* recorded = nullptr;  ///< never null
};

/// The step of the second traversal that goes with one of the first. With a step that decided, the one that decided
/// about the same moment: `moment` if the step is about that, else the middle of its time. With one that went on, the
/// last above that which is about all of its time. With the last, the last. Where no test decides about it, one as
/// far on. Requires a step of the first; `both`: of these traversals.
int matching_step(const TraversalComparison& both, const RecordedTraversal& first, const RecordedTraversal& second,
                  int step, std::optional<double> moment = {});

/// A query under two fits: the first is that of a scene, this is the second and what came of both.
struct FitComparison {
    std::array<std::shared_ptr<const mobb::Tree>, 2> trees;  ///< of A and B; none is null
    std::array<mobb::PlacedTree, 2> placed;                  ///< where A and B stand
    RecordedQuery recorded;
    TraversalComparison traversals;
    std::array<std::string, 2> names;  ///< what tells the fits apart: "MOBB", "UMOBB"
};

/// `recorded`: the record of the query of a and b; `trees`: others over the same clips.
FitComparison compare_fits(const mobb::PlacedTree& a, const mobb::PlacedTree& b, const RecordedQuery& recorded,
                           std::array<std::shared_ptr<const mobb::Tree>, 2> trees);

/// "step 14, depth 3: boxes 0.183 m apart, after 23 tests"
std::string decision_words(const Decision& decision);
/// "MOBB was earlier by 12 tests"; `names`: of both sides.
std::string earlier_words(std::int64_t earlier, const std::array<std::string, 2>& names);
/// "UMOBB was the earlier over 2.10 of 4.97 s, MOBB over 1.50 s"
std::string comparison_words(const TraversalComparison& comparison, const std::array<std::string, 2>& names);

}  // namespace mobbscope
