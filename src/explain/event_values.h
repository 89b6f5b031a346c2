/// The values of a trace's events: what filters compare, and what the list of events shows and sorts by.
#pragma once

#include <explain/recursion.h>
#include <mobb/placed_tree.h>
#include <mobb/trace.h>
#include <scene/event_filter.h>

#include <array>
#include <string>
#include <vector>

namespace mobbscope {

/// Refers to the trace, its recursion and both trees.
class EventValues {
  public:
    EventValues(const mobb::Trace& trace, const Recursion& recursion, const mobb::PlacedTree& a,
                const mobb::PlacedTree& b)
        : trace_(&trace), recursion_(&recursion), sides_{&a, &b} {}

    int size() const { return trace_->size(); }

    /// `side`: 0 or 1.
    FieldRange value(EventField field, int side, int step) const;

    /// As the list shows it: "0.183", "2.3", "overlap", "yes"; empty: none. `exact`: with all digits of a number.
    std::string text(EventField field, int side, int step, bool exact = false) const;

    bool passes(const EventFilter& filter, int step) const;

  private:
    const RecursionPair& pair(int step) const { return recursion_->pair_at(step); }
    int node(int side, int step) const {
        const mobb::Trace::Event event = (*trace_)[step];
        return side == 0 ? event.a : event.b;
    }
    const mobb::Tree& tree(int side) const { return sides_[static_cast<std::size_t>(side)]->tree(); }
    bool holds(const EventFilter::Term& term, int step) const;
    double clearance(int step) const;

    const mobb::Trace* trace_;
    const Recursion* recursion_;
    std::array<const mobb::PlacedTree*, 2> sides_;
};

/// Of each step whether it passes.
std::vector<bool> passing_steps(const EventValues& values, const EventFilter& filter);
/// The steps that pass, in order.
std::vector<int> steps_of(const std::vector<bool>& passing);
std::vector<int> steps_that_pass(const EventValues& values, const EventFilter& filter);

/// Steps in order of a field (of ranges by their beginning), equal ones as they stand; those without a value come last.
void sort_steps(std::vector<int>& steps, const EventValues& values, EventField field, int side, bool descending);

}  // namespace mobbscope
