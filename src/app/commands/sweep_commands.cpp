// Which tree to ship: fits tried on the same queries.
#include <app/commands/command.h>
#include <scene/fit_text.h>

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

/// Whether the last sweep recommends another fit than the present one, for the scene as it is.
bool recommends(const SweepInspector& sweeps, const Workspace& workspace) {
    const auto shown = sweeps.result();
    return shown && !shown->rows->why.empty() && sweeps.is_of_scene() &&
           shown->rows->rows[shown->rows->recommended].fit != workspace.fitted().options();
}

void apply_recommended(Edits& edits, const SweepInspector& sweeps, const Workspace& workspace) {
    const auto shown = sweeps.result();
    const mobb::FitOptions& fit = shown->rows->rows[shown->rows->recommended].fit;
    set_fit(edits, workspace, fit_text(fit, workspace.fitted().options()));
}

}  // namespace

std::vector<Command> sweep_commands() {
    const std::vector<Command> rows{
        Command("tree.fit", "Fit as", "Fits the trees with several options at once, as moving,leaf=20.", set_fit,
                {.menu = kNoMenu,
                 .argument = "TREE[,OPTION=VALUE...]",
                 .present = [](const Workspace& workspace) { return fit_text(workspace.fitted().options(), {}); }}),
        Command("tree.sweep", "Which tree to ship",
                "Tries all kinds of trees and leaves on the same queries, and recommends the cheapest.",
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
