// From places to the tests that decided about them, what branches cost, and the part of a query that is looked at.
#include <app/commands/arguments.h>
#include <app/commands/command.h>
#include <app/document/agents.h>
#include <base/text.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace mobbscope::app {

namespace {

constexpr std::string_view kNoQuery = "no query is shown";

// --- reasons

double moment_in(const std::string& text) { return number_in(text, "the time", -mobb::kMaxTime, mobb::kMaxTime); }

void reasons_at(Workspace& workspace, const std::string& text) {
    const double time = moment_in(text);
    workspace.change_view([&](ViewState& view) { view.time = time; });
    workspace.look.sample.reset();
    workspace.look.point.reset();
}

void reasons_of_point(Workspace& workspace, const std::string& text) {
    const glm::dvec2 times = two_numbers(text, "the point");
    for (const double time : {times.x, times.y}) {
        if (std::abs(time) > mobb::kMaxTime) throw std::invalid_argument("the time is out of range");
    }
    workspace.look.sample.reset();
    workspace.look.point = QueryLook::Point{times.x, times.y};
}

void ask_about_sample(Workspace& workspace, int side, int index) {
    workspace.look.point.reset();
    workspace.look.sample = QueryLook::Sample{side, index};
}

void reasons_of_sample(Workspace& workspace, Keys& keys, const std::string& text) {
    keys.section = "reasons";
    const auto [side, index] = name_and_word(text, "the sample");
    if (side != "a" && side != "b")
        throw std::invalid_argument("the side cannot be " + in_quotes(std::string(side)) + ": give a or b");
    const SceneQuery query = workspace.fitted().queries()[static_cast<std::size_t>(*workspace.view().query)];
    const int of = side == "a" ? 0 : 1;
    const int last = workspace.fitted().tree(of == 0 ? query.a : query.b).clip().count() - 1;
    ask_about_sample(workspace, of, whole_number_in(index, "the sample", 0, last));
}

/// The side of the query in view that the selected sample is of.
std::optional<int> side_of_sample(const Workspace& workspace) {
    if (!has_tests(workspace) || workspace.selection.kind != Selection::Kind::sample) return std::nullopt;
    return index_in_view(workspace.fitted(), workspace.view(), workspace.selection.path);
}

bool has_place_asked(const Workspace& workspace) {
    return has_tests(workspace) && (workspace.look.sample || workspace.look.point || workspace.view().time);
}

void no_reasons(Workspace& workspace) {
    if (!workspace.look.sample && !workspace.look.point) {
        workspace.change_view([](ViewState& view) { view.time.reset(); });
    }
    workspace.look.sample.reset();
    workspace.look.point.reset();
}

// --- the part that is looked at

std::pair<double, double> range_in(const std::string& text, const char* what) {
    const auto range = parse_range(text);
    if (!range || range->first >= range->second) {
        throw std::invalid_argument(std::string(what) + " cannot be " + in_quotes(text) +
                                    ": give two numbers, such as 1:3");
    }
    return *range;
}

void focus_time(Workspace& workspace, const std::string& text) {
    const auto [from, to] = range_in(text, "the time");
    workspace.look.focus.time = mobb::Interval{from, to};
}

int event_in(const Workspace& workspace, const std::string& text) {
    if (text.empty()) return workspace.step();
    return whole_number_in(text, "the step", 0, workspace.recorded()->trace.size() - 1);
}

void focus_branch(Workspace& workspace, QueryInspector& queries, const std::string& text) {
    const int event = event_in(workspace, text);
    workspace.look.focus.branch = queries.findings()->recursion.pair_of[static_cast<std::size_t>(event)];
    const RecursionPair& pair = queries.findings()->recursion.pair_at(event);
    workspace.look.zoom = EventRange{pair.first, pair.end};
}

void no_focus(Workspace& workspace) {
    workspace.look.focus = {};
    workspace.look.zoom.reset();
}

void zoom_steps(Workspace& workspace, const std::string& text) {
    const auto [from, to] = range_in(text, "the steps");
    const int events = workspace.recorded()->trace.size();
    const int first = static_cast<int>(std::clamp(from, 0.0, events - 1.0));
    const int end = static_cast<int>(std::clamp(to + 1, first + 1.0, static_cast<double>(events)));
    workspace.look.zoom = EventRange{first, end};
}

// --- costs

constexpr std::array<std::string_view, 2> kBranchesOf{"query", "scene"};

void branches_of(CostInspector& costs, Keys& keys, const std::string& text) {
    keys.section = "costliest branches";
    costs.branches_of = choice_named<CostInspector::Of>(kBranchesOf, text, "the branches");
    if (costs.branches_of == CostInspector::Of::scene) costs.count();
}

void show_sandwich(CostInspector& costs, Workspace& workspace, const std::string& text) {
    const auto [name, place] = name_and_word(text, "the node");
    std::vector<std::string> names;
    for (const SceneClip& clip : workspace.fitted().scene().clips) names.push_back(clip.name);
    const int clip = index_of_name(names, name, "clip");
    costs.branches_of = CostInspector::Of::scene;
    costs.count();
    costs.show_sandwich({clip, node_at(workspace.fitted().tree(clip), place)});
}

}  // namespace

std::vector<Command> reason_commands() {
    const Condition in_query{has_tests, why_no_tests};
    const Condition with_queries{has_queries, [] { return std::string_view("there is no query"); }};
    const std::vector<Command> rows{
        Command("reasons.at", "Reasons at a moment",
                "Lists the tests, from the roots on, that decided about a moment in seconds, and puts the time cursor "
                "there.",
                reasons_at, {.menu = kNoMenu, .argument = "S", .enabled = in_query, .also = "why explain because"}),
        Command("reasons.of_point", "Reasons at a point of the recursion map",
                "Lists the tests that decided about a moment of A and one of B, in seconds.", reasons_of_point,
                {.menu = kNoMenu, .argument = "TIME_A TIME_B", .enabled = in_query}),
        Command("reasons.of_sample", "Reasons about a sample",
                "Lists the tests that ended the search for a sample of a side, a or b, by its number from 0.",
                reasons_of_sample, {.menu = kNoMenu, .argument = "SIDE N", .enabled = in_query}),
        Command("reasons.of_selection", "Why here?", "Lists the tests that ended the search for the selected sample.",
                [](Workspace& workspace, Keys& keys) {
                    ask_about_sample(workspace, *side_of_sample(workspace), workspace.selection.index);
                    keys.section = "reasons";
                },
                {.enabled = {[](const Workspace& workspace) { return side_of_sample(workspace).has_value(); },
                             [](const Workspace& workspace) -> std::string_view {
                                 return workspace.view().query ? "no sample of the query is selected" : kNoQuery;
                             }},
                 .also = "reason explain because"}),
        Command("reasons.none", "No reasons", "Empties the list of reasons.", no_reasons,
                {.menu = kNoMenu, .enabled = has_place_asked}),
        Command("focus.branch", "Focus on this branch",
                "Restricts lists and counts to the pair under test, or that of a step, and to those below it.",
                focus_branch, {.argument = "[N]", .enabled = in_query, .also = "isolate zoom only"}),
        Command("focus.time", "Focus on a time...",
                "Restricts lists and counts to pairs that have a part in a range of time, in seconds.", focus_time,
                {.argument = "FROM:TO", .enabled = in_query}),
        Command("focus.none", "Focus on everything", "Lists and counts are of the whole query again.", no_focus,
                {.enabled = {[](const Workspace& workspace) { return !workspace.look.focus.is_all(); },
                             []() -> std::string_view { return "there is no focus"; }}}),
        Command("recursion.zoom", "Zoom the steps to", "Shows only a range of steps in the strip and the recursion.",
                zoom_steps, {.menu = kNoMenu, .argument = "FROM:TO", .enabled = in_query}),
        Command("recursion.zoom_all", "All steps", "Shows all steps in the strip and the recursion again.",
                [](Workspace& workspace) { workspace.look.zoom.reset(); },
                {.shortcut = "Shift+Home",
                 .enabled = {[](const Workspace& workspace) { return workspace.look.zoom.has_value(); },
                             []() -> std::string_view { return "all steps are shown"; }}}),
        Command(
            "branches.of", "Costliest branches of",
            "Lists the costliest branches of the query in view, or the costliest nodes of all queries.", branches_of,
            {.argument = "WHICH",
             .enabled = with_queries,
             .choices = [](const Session&) { return std::vector<std::string>(kBranchesOf.begin(), kBranchesOf.end()); },
             .chosen =
                 [](const CostInspector& costs, const std::string& text) {
                     return kBranchesOf[static_cast<std::size_t>(costs.branches_of)] == text;
                 },
             .also = "hot path profile expensive worst"}),
        Command("branches.of_node", "Costs of a node",
                "Lists over all queries which pairs called pairs with a node of a clip's tree, and which those called.",
                show_sandwich, {.menu = kNoMenu, .argument = "CLIP NODE", .enabled = with_queries}),
    };
    return in_menu("Query", rows);
}

}  // namespace mobbscope::app
