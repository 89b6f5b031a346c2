// The ways through the tests of a query.
#include <app/commands/arguments.h>
#include <app/commands/command.h>
#include <app/document/agents.h>
#include <base/text.h>
#include <explain/query_findings.h>
#include <explain/query_progress.h>
#include <explain/query_sentence.h>

#include <algorithm>
#include <limits>
#include <memory>
#include <optional>
#include <string>

namespace mobbscope::app {

namespace {

constexpr int kMaxSteps = std::numeric_limits<int>::max();

bool in_any_query(const Workspace& workspace) { return workspace.view().query.has_value(); }

/// Without a query in view the first one is shown instead, where it was left; else at this step.
bool entered(Workspace& workspace, QueryInspector& queries, Step step) {
    if (in_any_query(workspace)) return false;
    const bool is_known = workspace.document().steps.contains(step_key(*workspace.document().fitted, 0));
    queries.show(0, is_known ? std::nullopt : std::optional(step));
    return true;
}

constexpr Step kFirst{Step::Unit::event, 0};
constexpr Step kEnd{Step::Unit::end, 0};

void first(Workspace& workspace, QueryInspector& queries) {
    if (!entered(workspace, queries, kFirst)) workspace.go_to_event(0);
}

void back(Workspace& workspace, QueryInspector& queries) {
    if (!entered(workspace, queries, kEnd)) workspace.go_to_event(std::max(workspace.step() - 1, 0));
}

void forward(Workspace& workspace, QueryInspector& queries) {
    if (!entered(workspace, queries, kFirst))
        workspace.go_to_event(std::min(workspace.step() + 1, workspace.recorded()->trace.size() - 1));
}

void last(Workspace& workspace, QueryInspector& queries) {
    if (!entered(workspace, queries, kEnd)) workspace.change_view([](ViewState& view) { view.step = kEnd; });
}

void to(Session& session, const std::string& text) {
    if (text.empty()) return ask_for_argument(session, command_named("step.to"));
    Workspace& workspace = session.workspace;
    workspace.go_to_event(whole_number_in(text, "the step", 0, workspace.recorded()->trace.size() - 1));
}

void percent(Workspace& workspace, const std::string& text) {
    const double share = number_in(text, "the percentage", 0, 100);
    workspace.change_view([&](ViewState& view) { view.step = {Step::Unit::percent, share}; });
}

bool has_step_before(const QueryInspector& queries) { return queries.step_before().has_value(); }
std::string_view why_no_step_before(const Workspace& workspace) {
    return in_any_query(workspace) ? "no other step was visited" : "no query is shown";
}

void to_step_before(QueryInspector& queries, Workspace& workspace) {
    const Step before = *queries.step_before();
    workspace.change_view([&](ViewState& view) { view.step = before; });
}

enum class Way { next, previous };

/// To the nearest event that a step of this kind counts; says so if there is none.
template <Way way>
void to_counted(Workspace& workspace, QueryInspector& queries, Notifications& notifications, const Step& of,
                const std::string& what) {
    const bool next = way == Way::next;
    // Without a query in view its first test is looked at too.
    const int from = in_any_query(workspace) ? workspace.step() : next ? -1 : kMaxSteps;
    entered(workspace, queries, next ? kFirst : kEnd);
    const mobb::Trace& trace = workspace.recorded()->trace;
    const SceneQuery query = workspace.fitted().queries()[static_cast<std::size_t>(*workspace.view().query)];
    const mobb::Tree& a = workspace.fitted().tree(query.a);
    const mobb::Tree& b = workspace.fitted().tree(query.b);
    const int by = next ? 1 : -1;
    for (int event = std::min(from, trace.size()) + by; event >= 0 && event < trace.size(); event += by) {
        if (is_counted(of, trace, event, a, b)) return workspace.go_to_event(event);
    }
    notifications.tell(MessageLevel::info, (next ? "There is no later test " : "There is no test before ") + what);
}

/// What a search for the next or previous one looks for.
struct Sought {
    Step::Unit unit;
    const char* what;
};
constexpr Sought kSeparated{Step::Unit::separated, "that found boxes separated in space"};
constexpr Sought kOverlap{Step::Unit::overlap, "that found an overlap"};
constexpr Sought kHit{Step::Unit::hit, "that found a hit"};
constexpr Sought kLeaf{Step::Unit::leaf, "of two leaves"};

template <Way way>
Command found_row(std::string_view id, std::string_view title, std::string_view key, const Sought& sought,
                  std::string_view doc) {
    const auto go = [sought](Workspace& workspace, QueryInspector& queries, Notifications& notifications) {
        to_counted<way>(workspace, queries, notifications, {sought.unit, 1}, sought.what);
    };
    return {id, title, doc, go, {.shortcut = key, .enabled = {has_queries, why_no_step}}};
}

template <Way way>
void to_depth(Workspace& workspace, QueryInspector& queries, Notifications& notifications, const std::string& text) {
    const int depth = whole_number_in(text, "the depth", 0, kMaxSteps);
    to_counted<way>(workspace, queries, notifications, {Step::Unit::depth, static_cast<double>(depth)},
                    "at depth " + text);
}

/// To the next or the previous avoidable overlap; says so if there is none.
template <int way>
void to_avoidable(Workspace& workspace, QueryInspector& queries, Notifications& notifications) {
    const bool was_in = in_any_query(workspace);
    entered(workspace, queries, way > 0 ? kFirst : kEnd);
    const AvoidableOverlaps& avoidable = queries.findings()->recursion.avoidable;
    // The step at which the query is entered is looked at too.
    const int here = workspace.step() + (was_in ? 0 : -way);
    const auto behind = std::ranges::upper_bound(avoidable.events, here);
    const auto at = std::ranges::lower_bound(avoidable.events, here);
    if (way > 0 && behind != avoidable.events.end()) return workspace.go_to_event(*behind);
    if (way < 0 && at != avoidable.events.begin()) return workspace.go_to_event(*(at - 1));
    std::string why = avoidable.events.empty() ? "No overlap of this query was avoidable"
                      : way > 0                ? "There is no later avoidable overlap"
                                               : "There is no earlier avoidable overlap";
    if (!avoidable.all_judged()) why.append(". ").append(judged_words(avoidable));
    notifications.tell(MessageLevel::info, why);
}

/// Which side of the query in view the selected node is of; none if no node of it is selected.
std::optional<int> side_of_node(const Workspace& workspace) {
    if (!in_any_query(workspace) || workspace.selection.kind != Selection::Kind::node) return std::nullopt;
    return index_in_view(workspace.fitted(), workspace.view(), workspace.selection.path);
}

/// To the next test of the selected node; behind the last one to the first again.
void to_next_of_node(Workspace& workspace, Notifications& notifications) {
    const bool of_a = *side_of_node(workspace) == 0;
    const mobb::Trace& trace = workspace.recorded()->trace;
    for (int i = 1; i <= trace.size(); ++i) {
        const int event = (workspace.step() + i) % trace.size();
        if ((of_a ? trace[event].a : trace[event].b) == workspace.selection.index) return workspace.go_to_event(event);
    }
    notifications.tell(MessageLevel::info, "The selected node is never tested: the search ended before it");
}

/// The next event of the same pair, or of the next pair that is not below it.
std::optional<int> event_after_pair(const Workspace& workspace, const QueryInspector& queries) {
    const std::shared_ptr<const QueryFindings> findings = queries.findings();
    const int step = workspace.step();
    const RecursionPair& pair = findings->recursion.pair_at(step);
    const int next = step < pair.last ? step + 1 : pair.end;
    return next < workspace.recorded()->trace.size() ? std::optional(next) : std::nullopt;
}

/// The last event of a pair that is not below the present one, as deep or less deep.
std::optional<int> event_before_pair(const Workspace& workspace, const QueryInspector& queries) {
    const int step = workspace.step();
    if (step == 0) return std::nullopt;
    const std::shared_ptr<const QueryFindings> findings = queries.findings();
    const Recursion& recursion = findings->recursion;
    const int depth = recursion.pair_at(step).depth;
    const RecursionPair* before = &recursion.pair_at(step - 1);
    while (before->depth > depth) before = &recursion.pairs[static_cast<std::size_t>(before->parent)];
    return std::min(before->last, step - 1);
}

/// The first event of the first pair that the present one called.
std::optional<int> first_below(const Workspace& workspace, const QueryInspector& queries) {
    const auto findings = queries.findings();
    if (!findings || findings->recursion.pairs.empty()) return std::nullopt;
    const RecursionPair& now = findings->recursion.pair_at(workspace.step());
    return now.has_children() ? std::optional(now.last + 1) : std::nullopt;
}

int parent_event(const Workspace& workspace) {
    const mobb::Trace& trace = workspace.recorded()->trace;
    return trace[workspace.step()].parent;
}

}  // namespace

std::vector<Command> step_commands() {
    const CommandTraits of_depth{.menu = kNoMenu, .argument = "K", .enabled = {has_queries, why_no_step}};
    const std::vector<Command> rows{
        Command("step.first", "First step", "Shows the first test of the query.", first,
                {.shortcut = "Shift+Left", .enabled = {has_queries, why_no_step}, .also = "rewind restart beginning"}),
        Command("step.back", "Step back", "Shows the previous test.", back,
                {.shortcut = "Left", .repeats = true, .enabled = {has_queries, why_no_step}, .also = "previous"}),
        Command("step.forward", "Step forward", "Shows the next test.", forward,
                {.shortcut = "Right", .repeats = true, .enabled = {has_queries, why_no_step}, .also = "next"}),
        Command("step.last", "Last step", "Shows the last test, with the answer.", last,
                {.shortcut = "Shift+Right", .enabled = {has_queries, why_no_step}}),
        Command("step.before", "Step looked at before",
                "Goes back to where the last jump or run of single steps began; again: comes back, so that one key "
                "compares two steps.",
                to_step_before, {.shortcut = "J", .enabled = {has_step_before, why_no_step_before}}),
        Command("step.to", "Go to step...", "Shows a test by its number from 0.", to,
                {.shortcut = "Ctrl+G",
                 .argument = "[N]",
                 .enabled = {in_any_query, why_no_step},
                 .present = [](const Workspace& workspace) { return std::to_string(workspace.step()); },
                 .also = "event jump frame"}),
        found_row<Way::next>("step.next_separated", "Next separation", "S", kSeparated,
                             "Shows the next test that found two boxes separated in space."),
        found_row<Way::next>("step.next_overlap", "Next overlap", "O", kOverlap,
                             "Shows the next test that found an overlap, so that the search went on below."),
        found_row<Way::next>("step.next_hit", "Next hit", "H", kHit,
                             "Shows the test that found samples which collide."),
        found_row<Way::next>("step.next_leaf", "Next pair of leaves", "Ctrl+L", kLeaf,
                             "Shows the last test of the next pair of leaves."),
        found_row<Way::previous>("step.previous_separated", "Previous separation", "Shift+S", kSeparated,
                                 "Shows the previous test that found two boxes separated in space."),
        found_row<Way::previous>("step.previous_overlap", "Previous overlap", "Shift+O", kOverlap,
                                 "Shows the previous test that found an overlap."),
        found_row<Way::previous>("step.previous_hit", "Previous hit", "Shift+H", kHit,
                                 "Shows the previous test that found samples which collide."),
        found_row<Way::previous>("step.previous_leaf", "Previous pair of leaves", "Ctrl+Shift+L", kLeaf,
                                 "Shows the last test of the previous pair of leaves."),
        Command("step.next_avoidable", "Next avoidable overlap",
                "Shows the next test that found an overlap although one line keeps the disks apart.", to_avoidable<1>,
                {.shortcut = "U", .enabled = {has_queries, why_no_step}, .also = "waste wasted loose false positive"}),
        Command("step.previous_avoidable", "Previous avoidable overlap",
                "Shows the previous test that found an overlap although one line keeps the disks apart.",
                to_avoidable<-1>, {.shortcut = "Shift+U", .enabled = {has_queries, why_no_step}}),
        Command("step.next_depth", "Next test at a depth",
                "Shows the next test at a depth of the recursion; the roots are at 0.", to_depth<Way::next>, of_depth),
        Command("step.previous_depth", "Previous test at a depth",
                "Shows the previous test at a depth of the recursion.", to_depth<Way::previous>, of_depth),
        Command("step.next_of_node", "Next test of the selected node",
                "Shows the next test of the selected node, and after the last one the first.", to_next_of_node,
                {.enabled = {[](const Workspace& workspace) { return side_of_node(workspace).has_value(); },
                             [](const Workspace& workspace) -> std::string_view {
                                 return workspace.view().query ? "no node of the query is selected"
                                                               : "no query is shown";
                             }}}),
        Command("step.into", "Step into", "Shows the first test of the first pair that the present one called.",
                [](Workspace& workspace, QueryInspector& queries) {
                    workspace.go_to_event(*first_below(workspace, queries));
                },
                {.shortcut = "F11",
                 .repeats = true,
                 .enabled = {[](const Workspace& workspace, const QueryInspector& queries) {
                                 return first_below(workspace, queries).has_value();
                             },
                             why_no_step},
                 .also = "down enter descend"}),
        Command("step.over", "Step over", "Shows the next test that is not below the present pair.",
                [](Workspace& workspace, QueryInspector& queries) {
                    workspace.go_to_event(*event_after_pair(workspace, queries));
                },
                {.shortcut = "Down",
                 .repeats = true,
                 .enabled = {[](const Workspace& workspace, const QueryInspector& queries) {
                                 return in_any_query(workspace) && event_after_pair(workspace, queries);
                             },
                             why_no_step}}),
        Command("step.over_back", "Step over, backwards",
                "Shows the last test before that is not about parts of its pair.",
                [](Workspace& workspace, QueryInspector& queries) {
                    workspace.go_to_event(*event_before_pair(workspace, queries));
                },
                {.shortcut = "Shift+Down",
                 .repeats = true,
                 .enabled = {[](const Workspace& workspace, const QueryInspector& queries) {
                                 return in_any_query(workspace) && event_before_pair(workspace, queries);
                             },
                             why_no_step}}),
        Command("step.out", "Step out", "Shows the test that led to the present one.",
                [](Workspace& workspace) { workspace.go_to_event(parent_event(workspace)); },
                {.shortcut = "Up Shift+F11",
                 .repeats = true,
                 .enabled = {[](const Workspace& workspace) {
                                 return in_any_query(workspace) && parent_event(workspace) >= 0;
                             },
                             why_no_step},
                 .also = "up return parent"}),
        Command("step.percent", "Go to a percentage of the steps",
                "Shows the test at a percentage of the way, 0 to 100.", percent,
                {.menu = kNoMenu, .argument = "P", .enabled = {in_any_query, why_no_step}}),
    };
    return in_menu("Query/Steps", rows);
}

}  // namespace mobbscope::app
