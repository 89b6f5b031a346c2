// The query in view beside itself: under another fit, or as a trace of it is stored in the scene.
#include <app/commands/arguments.h>
#include <app/commands/command.h>
#include <base/text.h>
#include <scene/fit_text.h>

#include <algorithm>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace mobbscope::app {

namespace {

constexpr std::string_view kStored = "stored";

bool compares_fits(const Workspace& workspace) { return workspace.compare_with && workspace.compare_with->fit; }

std::vector<std::string> comparable(const QueryInspector& queries) {
    const auto kinds = mobb::tree_kind_names();
    std::vector<std::string> out(kinds.begin(), kinds.end());
    if (queries.stored_trace()) out.emplace_back(kStored);
    return out;
}

/// What an argument leaves out is as in the fit that is compared with already, or that of the view.
mobb::FitOptions fit_before(const Workspace& workspace) {
    return compares_fits(workspace) ? *workspace.compare_with->fit : workspace.fitted().options();
}

void compare_with(Workspace& workspace, const QueryInspector& queries, const std::string& text) {
    Workspace::CompareWith with;
    if (text != kStored) {
        with.fit = parse_fit(text, fit_before(workspace));
        mobb::check(*with.fit);
    } else if (!queries.stored_trace()) {
        throw std::invalid_argument("the scene has no stored trace of this query");
    }
    workspace.compare_with = with;
}

void set_compared_leaf(Workspace& workspace, const std::string& text) {
    workspace.compare_with->fit->leaf =
        whole_number_in(text, "the samples of a leaf", 1, std::numeric_limits<int>::max());
}

void go_to_moment(Workspace& workspace, const QueryInspector& queries, const std::string& text) {
    const double time = number_in(text, "the time", -mobb::kMaxTime, mobb::kMaxTime);
    const TraversalComparison& traversals = queries.comparison()->traversals;
    const ComparedTime* at = traversals.at(time);
    if (!at) throw std::invalid_argument("no test decides about " + format_double(time) + " s");
    const int step = traversals.decision(*at, 0).step;
    workspace.change_view([&](ViewState& view) {
        view.time = time;
        view.step = {Step::Unit::event, static_cast<double>(step)};
    });
}

bool differs_from_stored(const Workspace& workspace, const QueryInspector& queries) {
    return has_tests(workspace) && queries.stored_trace() && queries.stored_check().difference;
}

void go_to_difference(Workspace& workspace, const QueryInspector& queries, Keys& keys) {
    workspace.compare_with = Workspace::CompareWith{};
    keys.section = "compare";
    // Of a trace that is now shorter its end stands for what is missing.
    const int step = std::min(queries.stored_check().difference->step, workspace.recorded()->trace.size() - 1);
    workspace.go_to_event(step);
}

}  // namespace

std::vector<Command> compare_commands() {
    const Condition with_tests{has_tests, why_no_tests};
    const Condition with_fits{
        [](const Workspace& workspace) { return has_tests(workspace) && compares_fits(workspace); },
        [] { return std::string_view("it is not compared with a fit"); }};
    const std::vector<Command> rows{
        Command("compare.with", "Compare with",
                "Compares the query with itself under other trees, or with its stored trace.", compare_with,
                {.argument = "FIT",
                 .enabled = with_tests,
                 .choices = comparable,
                 .choice_title = [](const std::string& choice) { return choice == kStored ? "stored trace" : choice; },
                 .chosen =
                     [](const Workspace& workspace, const std::string& choice) {
                         if (!workspace.compare_with) return false;
                         const auto& fit = workspace.compare_with->fit;
                         return choice == (fit ? mobb::name(fit->tree) : kStored);
                     }}),
        Command("compare.leaf", "Compare with leaves of...",
                "Sets the samples in a leaf of the trees that are compared with.", set_compared_leaf,
                {.argument = "N",
                 .enabled = with_fits,
                 .present = [](const Workspace& workspace) { return std::to_string(fit_before(workspace).leaf); }}),
        Command("compare.at", "Compare at a moment",
                "Goes to the test that decided about a moment in seconds, and puts the time cursor there.",
                go_to_moment, {.menu = kNoMenu, .argument = "S", .enabled = with_fits}),
        Command("compare.difference", "Compare: go to the first difference",
                "Goes to the first step that differs from the stored trace.", go_to_difference,
                {.enabled = {differs_from_stored,
                             [](const Workspace& workspace, const QueryInspector& queries) -> std::string_view {
                                 if (!has_tests(workspace)) return why_no_tests(workspace);
                                 return queries.stored_trace() ? "the stored trace agrees" : "no trace is stored";
                             }}}),
        Command("compare.none", "Compare with nothing", "Shows the query alone again.",
                [](Workspace& workspace) { workspace.compare_with.reset(); },
                {.enabled = {[](const Workspace& workspace) { return workspace.compare_with.has_value(); },
                             [] { return std::string_view("nothing is compared"); }}}),
    };
    return in_menu("Query/Compare", rows);
}

}  // namespace mobbscope::app
