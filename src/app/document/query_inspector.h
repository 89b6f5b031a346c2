/// Queries of the scene, and the trees behind them: answers, findings, figures. Kept until the scene changes.
#pragma once

#include <app/document/workspace.h>
#include <explain/event_values.h>

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace mobbscope::app {

/// The pairs that decided about a place.
struct PlaceReasons {
    std::string of;          ///< "3.77 s", "sample 31 of A"
    std::vector<int> pairs;  ///< of the recursion, in order
};

class QueryInspector {
  public:
    explicit QueryInspector(Workspace& workspace) : workspace_(workspace) {}

    /// Shows a query, at that step; none: at the one where it was left with this kind of trees, or its end.
    void show(int query, std::optional<Step> step = {});
    /// The step of the query in view where the last jump or run of single steps began; none: there was none.
    std::optional<Step> step_before() const;
    /// What follows from Workspace::recorded; null if no query is in the view.
    std::shared_ptr<const QueryFindings> findings() const;
    /// By event of the query in view, whether lists show it; empty where they show all. Requires findings().
    const InFocus& in_focus() const;
    /// What had been counted in the focus after the present step, and in all of it. Requires findings() with events.
    FocusCounts counts_so_far() const;
    FocusCounts counts_in_all() const;
    /// The costliest of the focus (costliest_branches), some hundred. Requires findings() with events.
    const std::vector<BranchCost>& branches() const;
    /// Of what is asked about (QueryLook), else of the time cursor's moment; none: nothing is, or no query is in view.
    std::optional<PlaceReasons> reasons() const;
    /// The same findings with another recursion, if these are still those of the query in view.
    void replace_recursion(const std::shared_ptr<const QueryFindings>& of, Recursion recursion);
    /// Of the query in view, which has made tests, until findings() are others.
    EventValues events() const;
    PassingEvents& passing(const EventFilter& filter) const;
    /// How many events in the focus pass, and how many there are.
    int hits(const EventFilter& filter) const;
    int events_in_focus() const;
    /// In which events breakpoints hold that are on, in order.
    const std::vector<int>& break_steps() const;
    /// The rows of the list of events: those in the focus that pass its filter.
    std::shared_ptr<const std::vector<int>> listed_events() const;
    /// The event `by` rows further on in that list, of which the present step need not be; none: it ends there.
    std::optional<int> listed_event_beside(int by) const;
    /// The first contact of any query, with what it cost.
    const Answer& answer_of(std::size_t query) const;
    /// Figures of a clip's tree.
    const std::vector<mobb::LevelFigures>& figures_of(int clip) const;

  private:
    Workspace::Derived::Focused& focused() const;

    Workspace& workspace_;
};

}  // namespace mobbscope::app
