// Which tree to ship: fits tried on the same queries.
#include <app/commands/command.h>
#include <scene/fit_text.h>

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace mobbscope::app {

namespace {

void set_fit(Edits& edits, const Workspace& workspace, const std::string& text) {
    const mobb::FitOptions fit = parse_fit(text, workspace.fitted().options());
    mobb::check(fit);
    edits.refit({"fitting " + fit_words(fit, workspace.fitted().options()), "fitting"},
                [fit](mobb::FitOptions& options) { options = fit; });
}

/// The row that the last sweep recommends for warm queries of the scene as it is; null: it does not, or the trees are
/// fitted so.
const SweepRow* recommended(const SweepInspector& sweeps, const Workspace& workspace) {
    const auto shown = sweeps.result();
    if (!shown || !sweeps.is_of_scene()) return nullptr;
    const std::optional<std::size_t> row = shown->rows->of(Protocol::warm).recommended;
    return row && shown->rows->rows[*row].fit != workspace.fitted().options() ? &shown->rows->rows[*row] : nullptr;
}

bool recommends(const SweepInspector& sweeps, const Workspace& workspace) {
    return recommended(sweeps, workspace) != nullptr;
}

void apply_recommended(Edits& edits, const SweepInspector& sweeps, const Workspace& workspace) {
    const mobb::FitOptions fit = recommended(sweeps, workspace)->fit;
    set_fit(edits, workspace, fit_text(fit, workspace.fitted().options()));
}

}  // namespace

std::vector<Command> sweep_commands() {
    const std::vector<Command> rows{
        Command("tree.fit", "Fit as", "Fits the trees with several options at once, as moving,leaf=20.", set_fit,
                {.menu = kNoMenu,
                 .argument = "TREE[,OPTION=VALUE...]",
                 .present = [](const Workspace& workspace) { return fit_text(workspace.fitted().options(), {}); }}),
        Command(
            "tree.sweep", "Which tree to ship",
            "Tries all kinds of trees and leaves on the same queries, measures the best, and recommends the fastest.",
            [](SweepInspector& sweeps, Settings& settings, Keys& keys) {
                settings.folded[std::string(kSweepSection)] = false;
                keys.section = kSweepSection;
                if (!sweeps.is_running()) sweeps.start();
            },
            {.enabled = {[](const Workspace& workspace) { return !workspace.scene().clips.empty(); },
                         [] { return std::string_view("there is no clip"); }},
             .also = "best optimal optimise optimize fastest cheapest tightest tune benchmark compare recommend"}),
        Command("tree.sweep_apply", "Fit as recommended", "Fits the trees as the last sweep recommends.",
                apply_recommended,
                {.enabled = {recommends, [] { return std::string_view("no other fit is recommended"); }},
                 .also = "best optimal"}),
        Command("tree.sweep_cancel", "Stop trying fits", "Ends the sweep that is under way.", &SweepInspector::cancel,
                {.menu = kNoMenu,
                 .enabled = {&SweepInspector::is_running, [] { return std::string_view("no sweep is under way"); }}}),
        Command("tree.sweep_axes", "Sweep over axes", "Tries all ways to turn boxes, too.",
                [](SweepInspector& sweeps) { sweeps.over_axes = !sweeps.over_axes; },
                {.menu = "Tree/Sweep", .checked = [](const SweepInspector& sweeps) { return sweeps.over_axes; }}),
        Command("tree.sweep_time_scale", "Sweep over time scales", "Tries time scales of 0.1 to 30 m/s, too.",
                [](SweepInspector& sweeps) { sweeps.over_time_scale = !sweeps.over_time_scale; },
                {.menu = "Tree/Sweep", .checked = [](const SweepInspector& sweeps) { return sweeps.over_time_scale; }}),
    };
    return in_menu("Tree", rows);
}

}  // namespace mobbscope::app
