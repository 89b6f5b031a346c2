#include <app/document/query_inspector.h>
#include <base/text.h>
#include <explain/query_sentence.h>
#include <explain/reasons.h>

#include <algorithm>
#include <iterator>
#include <numeric>
#include <string>
#include <utility>

namespace mobbscope::app {

namespace {

constexpr std::size_t kMostBranches = 100;

}  // namespace

void QueryInspector::show(int query, std::optional<Step> step) {
    const auto looked_at = workspace_.document().steps.find(step_key(*workspace_.document().fitted, query));
    if (!step && query == workspace_.view().query) step = workspace_.view().step;
    if (!step && looked_at != workspace_.document().steps.end()) step = looked_at->second.left;
    workspace_.change_view([&](ViewState& view) {
        view.query = query;
        view.step = step.value_or(Step{});
    });
}

std::optional<Step> QueryInspector::step_before() const {
    if (!workspace_.view().query) return std::nullopt;
    const auto looked_at =
        workspace_.document().steps.find(step_key(*workspace_.document().fitted, *workspace_.view().query));
    return looked_at == workspace_.document().steps.end() ? std::nullopt : looked_at->second.before;
}

std::shared_ptr<const QueryFindings> QueryInspector::findings() const {
    const RecordedQuery* query = workspace_.recorded();
    if (!query) return nullptr;
    Workspace::Derived& d = workspace_.derived();
    if (!d.findings) {
        d.findings_of = workspace_.shown();
        d.findings = std::make_shared<const QueryFindings>(find_out(*d.findings_of, workspace_.view(), *query));
    }
    return d.findings;
}

Workspace::Derived::Focused& QueryInspector::focused() const {
    const std::shared_ptr<const QueryFindings> found = findings();
    std::optional<Workspace::Derived::Focused>& kept = workspace_.derived().focused;
    const FocusWindow& window = workspace_.look.focus;
    if (!kept || kept->window != window) {
        kept = {window, events_in(found->recursion, window)};
        workspace_.derived().listed_events.reset();
    }
    return *kept;
}

const InFocus& QueryInspector::in_focus() const { return focused().inside; }

FocusCounts QueryInspector::counts_so_far() const {
    auto& [at, counts] = focused().counts;
    const int step = workspace_.step();
    if (at == step) return counts;
    counts = counts_in(in_focus(), workspace_.recorded()->trace, findings()->recursion, step);
    at = step;
    return counts;
}

FocusCounts QueryInspector::counts_in_all() const {
    Workspace::Derived::Focused& now = focused();
    const Recursion& recursion = findings()->recursion;
    if (!now.in_all) {
        const int last = static_cast<int>(recursion.pair_of.size()) - 1;
        now.in_all = counts_in(now.inside, workspace_.recorded()->trace, recursion, last);
    }
    return *now.in_all;
}

const std::vector<BranchCost>& QueryInspector::branches() const {
    Workspace::Derived::Focused& now = focused();
    if (!now.branches) {
        now.branches = costliest_branches(findings()->recursion, now.window, now.inside, kMostBranches);
    }
    return *now.branches;
}

std::shared_ptr<const FitComparison> QueryInspector::comparison() const {
    const std::shared_ptr<const QueryFindings> found = findings();
    const auto& with = workspace_.compare_with;
    if (!found || !with || !with->fit) return nullptr;
    std::shared_ptr<const FitComparison>& kept = workspace_.derived().compared;
    if (kept && kept->trees[0]->options() == *with->fit) return kept;
    const mobb::PlacedTree &a = found->sides[0].placed, &b = found->sides[1].placed;
    const auto fit = [&](const mobb::PlacedTree& side) {
        return std::make_shared<const mobb::Tree>(side.tree().shared_clip(), *with->fit);
    };
    const auto of_a = fit(a);
    const auto of_b = &a.tree().clip() == &b.tree().clip() ? of_a : fit(b);
    kept = std::make_shared<const FitComparison>(compare_fits(a, b, *workspace_.recorded(), {of_a, of_b}));
    return kept;
}

std::shared_ptr<const mobb::Trace> QueryInspector::stored_trace() const {
    const std::optional<int>& query = workspace_.view().query;
    return query ? workspace_.fitted().queries()[static_cast<std::size_t>(*query)].trace : nullptr;
}

const TraceCheck& QueryInspector::stored_check() const {
    std::optional<TraceCheck>& kept = workspace_.derived().stored_check;
    if (!kept) kept = check_trace(*stored_trace(), workspace_.recorded()->trace);
    return *kept;
}

std::optional<double> QueryInspector::compared_moment() const {
    if (const auto& time = workspace_.view().time) return time;
    const Recursion& recursion = findings()->recursion;
    if (recursion.pairs.empty()) return std::nullopt;
    const RecursionPair& pair = recursion.pair_at(workspace_.step());
    const double middle = 0.5 * (std::max(pair.time_a.t0, pair.time_b.t0) + std::min(pair.time_a.t1, pair.time_b.t1));
    // Behind a contact nothing was to be decided.
    const auto& contact = workspace_.recorded()->contact;
    return contact ? std::min(middle, contact->time) : middle;
}

std::optional<PlaceReasons> QueryInspector::reasons() const {
    const std::shared_ptr<const QueryFindings> found = findings();
    if (!found) return std::nullopt;
    const QueryLook& look = workspace_.look;
    if (look.sample) {
        const DrawnAgent& side = found->sides[static_cast<std::size_t>(look.sample->side)];
        return PlaceReasons{
            "sample " + std::to_string(look.sample->index) + " of " + side.label,
            end_pairs_of_sample(found->recursion, side.placed.tree(), look.sample->side, look.sample->index)};
    }
    if (look.point) {
        return PlaceReasons{formatted("%.2f s by %.2f s", look.point->time_a, look.point->time_b),
                            pairs_at(found->recursion, look.point->time_a, look.point->time_b)};
    }
    const std::optional<double>& time = workspace_.view().time;
    if (!time) return std::nullopt;
    return PlaceReasons{with_unit(*time, "s"), pairs_at(found->recursion, *time, *time)};
}

void QueryInspector::replace_recursion(const std::shared_ptr<const QueryFindings>& of, Recursion recursion) {
    Workspace::Derived& d = workspace_.derived();
    if (d.findings != of) return;
    auto findings = std::make_shared<QueryFindings>(*of);
    findings->recursion = std::move(recursion);
    d.forget_findings();
    d.findings = std::move(findings);
}

EventValues QueryInspector::events() const {
    const QueryFindings& found = *findings();
    return {workspace_.recorded()->trace, found.recursion, found.sides[0].placed, found.sides[1].placed};
}

PassingEvents& QueryInspector::passing(const EventFilter& filter) const {
    // Each letter that is typed makes another one.
    const std::size_t kMostFilters = 200 + 2 * workspace_.scene().debug.breakpoints.size();
    const EventValues values = events();
    std::map<std::string, PassingEvents>& known = workspace_.derived().passing;
    if (known.size() > kMostFilters) known.clear();
    const auto [at, is_new] = known.try_emplace(filter.text());
    if (is_new) at->second.passes = passing_steps(values, filter);
    return at->second;
}

int QueryInspector::hits(const EventFilter& filter) const {
    const InFocus& inside = in_focus();
    PassingEvents& of = passing(filter);
    const FocusWindow& window = workspace_.look.focus;
    if (!of.count || of.count->first != window) {
        int count = 0;
        for (std::size_t step = 0; step < of.passes.size(); ++step)
            count += of.passes[step] && (inside.empty() || inside[step] != 0) ? 1 : 0;
        of.count.emplace(window, count);
    }
    return of.count->second;
}

int QueryInspector::events_in_focus() const {
    const InFocus& inside = in_focus();
    return inside.empty() ? events().size()
                          : static_cast<int>(inside.size() - static_cast<std::size_t>(std::ranges::count(inside, 0)));
}

const std::vector<int>& QueryInspector::break_steps() const {
    const int count = events().size();
    std::optional<std::vector<int>>& known = workspace_.derived().break_steps;
    if (known) return *known;
    std::vector<bool> any(static_cast<std::size_t>(count));
    for (const Breakpoint& breakpoint : workspace_.scene().debug.breakpoints) {
        if (!breakpoint.on) continue;
        const std::vector<bool>& passes = passing(EventFilter(breakpoint.where)).passes;
        for (std::size_t step = 0; step < any.size(); ++step) any[step] = any[step] || passes[step];
    }
    return known.emplace(steps_of(any));
}

namespace {

void sort_as(std::vector<int>& steps, const EventValues& values, const EventList& list) {
    // As they stand they are in order of time.
    if (list.by.field == EventField::step && !list.descending) return;
    sort_steps(steps, values, list.by.field, list.by.side, list.descending);
}

}  // namespace

std::shared_ptr<const std::vector<int>> QueryInspector::listed_events() const {
    const EventValues values = events();
    const EventList& list = workspace_.events;
    const InFocus& inside = in_focus();
    std::shared_ptr<const std::vector<int>>& known = workspace_.derived().listed_events;
    if (known) return known;
    std::vector<int> steps(static_cast<std::size_t>(values.size()));
    if (list.filter) {
        steps = steps_of(passing(*list.filter).passes);
    } else {
        std::iota(steps.begin(), steps.end(), 0);
    }
    if (!inside.empty()) std::erase_if(steps, [&](int step) { return inside[static_cast<std::size_t>(step)] == 0; });
    sort_as(steps, values, list);
    return known = std::make_shared<const std::vector<int>>(std::move(steps));
}

std::optional<int> QueryInspector::listed_event_beside(int by) const {
    const int present = workspace_.step();
    std::vector<int> steps = *listed_events();
    auto at = std::ranges::find(steps, present);
    if (at == steps.end()) {
        if (steps.empty()) return std::nullopt;
        if (workspace_.events.by.field != EventField::step) return by > 0 ? steps.front() : steps.back();
        // It has its place among them all the same.
        at =
            steps.insert(workspace_.events.descending ? std::ranges::lower_bound(steps, present, std::ranges::greater())
                                                      : std::ranges::lower_bound(steps, present),
                         present);
    }
    const std::ptrdiff_t place = at - steps.begin() + by;
    if (place < 0 || place >= std::ssize(steps)) return std::nullopt;
    return steps[static_cast<std::size_t>(place)];
}

const Answer& QueryInspector::answer_of(std::size_t query) const {
    auto [at, is_new] = workspace_.derived().answers.try_emplace(query);
    if (is_new) at->second = answer(workspace_.fitted(), workspace_.fitted().queries()[query], {});
    return at->second;
}

const std::vector<mobb::LevelFigures>& QueryInspector::figures_of(int clip) const {
    auto [at, is_new] = workspace_.derived().figures.try_emplace(clip);
    if (is_new) at->second = mobb::level_figures(workspace_.fitted().tree(clip));
    return at->second;
}

}  // namespace mobbscope::app
