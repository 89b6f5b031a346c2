/// What a query has found out up to a step of its trace.
#pragma once

#include <explain/avoidable.h>
#include <mobb/trace.h>
#include <mobb/tree.h>
#include <scene/fitted_scene.h>

#include <array>
#include <optional>
#include <vector>

namespace mobbscope {

/// Whether an event is one of those that a step counts, as "leaf:3" does; of Unit::depth one at that depth. No event is
/// of those that count none.
bool is_counted(const Step& step, const mobb::Trace& trace, int event, const mobb::Tree& a, const mobb::Tree& b);

/// The event that a step means in the trace of a query of the scene. Throws std::invalid_argument if it has none.
int event_of(const Step& step, const mobb::Trace& trace, const FittedScene& fitted, int query);

/// What is known of a node that has been tested.
struct NodeProgress {
    int node = 0;
    int event = 0;                                   ///< its latest test
    mobb::Outcome outcome = mobb::Outcome::overlap;  ///< ... and how that ended
    bool open = false;                               ///< the pair under test lies below it
    bool refined = false;                            ///< children of it have been tested since
};

struct QueryProgress {
    int step = 0;
    mobb::Trace::Event event;                        ///< the test under way; refers to the trace
    std::optional<AvoidableOverlap> avoidable;       ///< what that found; left to who has the trees
    std::array<std::vector<NodeProgress>, 2> nodes;  ///< of A and of B, by index, without those of the pair under test
};

/// 0 <= step < trace.size(). `past`: which of the tests before the step are told of.
QueryProgress progress_at(const mobb::Trace& trace, int step, Past past);

}  // namespace mobbscope
