#include <app/document/query_inspector.h>

#include <utility>

namespace mobbscope::app {

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
    if (!d.findings)
        d.findings = std::make_shared<const QueryFindings>(find_out(workspace_.fitted(), workspace_.view(), *query));
    return d.findings;
}

void QueryInspector::replace_recursion(const std::shared_ptr<const QueryFindings>& of, Recursion recursion) {
    std::shared_ptr<const QueryFindings>& now = workspace_.derived().findings;
    if (now != of) return;
    auto findings = std::make_shared<QueryFindings>(*of);
    findings->recursion = std::move(recursion);
    now = std::move(findings);
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
