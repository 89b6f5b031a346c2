#include <app/commands/arguments.h>
#include <app/commands/command.h>
#include <app/document/agents.h>
#include <base/text.h>
#include <explain/query_findings.h>
#include <explain/query_sentence.h>
#include <scene/scene_edits.h>

#include <algorithm>
#include <memory>
#include <stdexcept>
#include <string>

namespace mobbscope::app {

namespace {

using mobb::Outcome;

bool has_queries(const Workspace& workspace) { return !workspace.fitted().queries().empty(); }
std::string_view why_no_query(const Workspace& workspace) {
    return workspace.crowd() ? "a run is asked for its conflicts" : "there is no query";
}
bool may_capture(const Workspace& workspace, const Jobs& jobs) {
    return has_queries(workspace) && !jobs.job() && !workspace.in_excerpt();
}
bool in_query(const Workspace& workspace) { return workspace.view().query.has_value(); }
int query_total(const Workspace& workspace) { return static_cast<int>(workspace.fitted().queries().size()); }

void select(QueryInspector& queries, Workspace& workspace, Keys& keys, const std::string& text) {
    queries.show(whole_number_in(text, "the query", 0, query_total(workspace) - 1));
    keys.move = FocusMove::picture;  // its arrows step now
}

void leave(Workspace& workspace) {
    workspace.change_view([](ViewState& view) { view.query.reset(); });
}

void next(QueryInspector& queries, Workspace& workspace) { queries.show(workspace.view().query.value_or(-1) + 1); }

void previous(QueryInspector& queries, Workspace& workspace) {
    queries.show(workspace.view().query.value_or(query_total(workspace)) - 1);
}

// --- what is asked

std::vector<std::string> others(const Workspace& workspace) {
    std::vector<std::string> names = path_names(workspace);
    if (has_selected_agent(workspace)) names.erase(names.begin() + selected_agent(workspace));
    return names;
}

/// The query that asks these two against each other, in either order.
std::optional<int> query_of(const Workspace& workspace, int a, int b) {
    for (int i = 0; i < query_total(workspace); ++i) {
        const SceneQuery query = workspace.fitted().queries()[static_cast<std::size_t>(i)];
        const auto [low, high] = std::minmax(query.a.agent, query.b.agent);
        if (low == std::min(a, b) && high == std::max(a, b)) return i;
    }
    return std::nullopt;
}

void add_against(Workspace& workspace, QueryInspector& queries, const std::string& other) {
    const int a = selected_agent(workspace);
    const int b = index_of_name(path_names(workspace), other, "agent");
    // What is asked already is only shown.
    if (const auto known = query_of(workspace, a, b)) return queries.show(*known);
    workspace.edit({"asking " + selected_agent_name(workspace) + " against " + other, ""}, [&](Scene& scene) {
        add_agents_for_clips(scene);
        scene.view.query = static_cast<int>(add_query(scene, a, b));
        scene.view.step = {};
    });
}

/// The query that is edited: the selected one, else that in view.
std::optional<int> edited_query(const Workspace& workspace) {
    if (workspace.selection.kind == Selection::Kind::query) return workspace.selection.index;
    return workspace.view().query;
}

void remove_edited(Workspace& workspace) {
    const int query = *edited_query(workspace);
    const SceneQuery asked = workspace.fitted().queries()[static_cast<std::size_t>(query)];
    workspace.edit({"no longer asking " + asked.a.name + " against " + asked.b.name, ""},
                   [&](Scene& scene) { remove_query(scene, static_cast<std::size_t>(query)); });
    // Those behind it have other indices now.
    if (workspace.selection.kind == Selection::Kind::query || workspace.selection.path.query >= 0) workspace.select({});
}

bool is_expected(const Workspace& workspace) {
    const auto query = edited_query(workspace);
    return query && workspace.fitted().queries()[static_cast<std::size_t>(*query)].expect.has_value();
}

void expect(Workspace& workspace, QueryInspector& queries) {
    const auto query = static_cast<std::size_t>(*edited_query(workspace));
    const bool was_expected = is_expected(workspace);
    const std::optional<mobb::Contact> contact = queries.answer_of(query).contact;
    workspace.edit({was_expected ? "expecting nothing" : "expecting the answer", ""}, [&](Scene& scene) {
        make_queries_explicit(scene);
        scene.queries[query].expect =
            was_expected ? std::nullopt : std::optional<Expectation>({contact.has_value(), contact});
    });
}

/// The query by its number; without one the edited one.
int asked_query(const Workspace& workspace, const std::string& text) {
    if (!text.empty()) return whole_number_in(text, "the query", 0, query_total(workspace) - 1);
    const auto query = edited_query(workspace);
    if (!query) throw std::invalid_argument("no query is selected or in view: choose one first");
    return *query;
}

/// The two with their samples inside and the answer expected, as a scene that stands alone.
void capture(Workspace& workspace, QueryInspector& queries, Excerpts& excerpts, const std::string& text) {
    const auto index = static_cast<std::size_t>(asked_query(workspace, text));
    const SceneQuery query = workspace.fitted().queries()[index];
    const std::optional<mobb::Contact> contact = queries.answer_of(index).contact;
    excerpts.open(query.a, query.b);
    workspace.edit({"capturing " + query.a.name + " against " + query.b.name, ""}, [&](Scene& scene) {
        for (SceneClip& clip : scene.clips) {
            clip.source.reset();
            clip.options = {};
            clip.warp.reset();
            clip.turn.reset();
        }
        make_queries_explicit(scene);
        scene.queries.front().expect = Expectation{contact.has_value(), contact};
    });
}

void copy_query_command(Session& session, const std::string& text) {
    session.queries.show(asked_query(session.workspace, text));
    run_command(session, "file.copy_command");
}

void copy_answer(Session& session, const std::string& text) {
    session.queries.show(asked_query(session.workspace, text));
    const std::shared_ptr<const QueryFindings> findings = session.queries.findings();
    std::string answer = answer_words(findings->sides, findings->clearance) + ".\n";
    const std::vector<std::string> why = why_words(findings->sides, findings->clearance, findings->floor);
    for (const auto& sentences : {proof_sentences(*findings), why})
        for (const std::string& sentence : sentences) answer += sentence + '\n';
    session.desktop->set_clipboard(answer);
    session.notifications.tell(MessageLevel::info, "Copied: " + answer);
}

/// In the background: a scene may ask thousands.
void count_blame(Session& session) {
    session.jobs.start("Summing avoidable overlaps",
                       [&session, in = session.workspace.document().fitted](JobControl& control) -> Job::Finish {
                           auto blame = std::make_shared<const BlameInScene>(blame_in(*in, progress_of(control)));
                           return [&session, in, blame = std::move(blame)] {
                               Workspace& workspace = session.workspace;
                               if (in != workspace.document().fitted) {
                                   return session.notifications.tell(
                                       MessageLevel::info, "The scene has changed: sum avoidable overlaps again");
                               }
                               workspace.counted_blame = blame;
                               workspace.blame_counted_in = in;
                               session.notifications.tell(MessageLevel::info,
                                                          blame_words(*blame, in->queries().size()));
                           };
                       });
}

/// Those of the query in view that take too long for each new trace.
void judge_all(Session& session) {
    session.jobs.start("Judging overlaps",
                       [&session, findings = session.queries.findings(), trace = session.workspace.recorded()->trace,
                        fitted = session.workspace.shown()](JobControl& control) -> Job::Finish {
                           Recursion all = recursion_of(trace, findings->sides[0].placed, findings->sides[1].placed,
                                                        kAnyVisits, progress_of(control));
                           return [&session, findings, all = std::move(all)]() mutable {
                               session.queries.replace_recursion(findings, std::move(all));
                           };
                       });
}

// --- steps

void to_event(Workspace& workspace, int event) {
    workspace.change_view([&](ViewState& view) { view.step = {Step::Unit::event, static_cast<double>(event)}; });
}

/// Without a query in view its first one is shown instead, at this step.
bool entered(Workspace& workspace, QueryInspector& queries, Step step) {
    if (in_query(workspace)) return false;
    queries.show(0, step);
    return true;
}

constexpr Step kFirst{Step::Unit::event, 0};
constexpr Step kEnd{Step::Unit::end, 0};

void first(Workspace& workspace, QueryInspector& queries) {
    if (!entered(workspace, queries, kFirst)) to_event(workspace, 0);
}

void back(Workspace& workspace, QueryInspector& queries) {
    if (!entered(workspace, queries, kEnd)) to_event(workspace, std::max(workspace.step() - 1, 0));
}

void forward(Workspace& workspace, QueryInspector& queries) {
    if (!entered(workspace, queries, kFirst))
        to_event(workspace, std::min(workspace.step() + 1, workspace.recorded()->trace.size() - 1));
}

void last(Workspace& workspace, QueryInspector& queries) {
    if (!entered(workspace, queries, kEnd)) workspace.change_view([](ViewState& view) { view.step = kEnd; });
}

void to(Workspace& workspace, const std::string& text) {
    to_event(workspace, whole_number_in(text, "the step", 0, workspace.recorded()->trace.size() - 1));
}

void percent(Workspace& workspace, const std::string& text) {
    const double share = number_in(text, "the percentage", 0, 100);
    workspace.change_view([&](ViewState& view) { view.step = {Step::Unit::percent, share}; });
}

bool has_step_before(const QueryInspector& queries) { return queries.step_before().has_value(); }
std::string_view why_no_step_before(const Workspace& workspace) {
    return in_query(workspace) ? "no other step was looked at" : "no query is shown";
}

void to_step_before(QueryInspector& queries, Workspace& workspace) {
    const Step before = *queries.step_before();
    workspace.change_view([&](ViewState& view) { view.step = before; });
}

/// To the next event that ended so; says so if there is none.
void to_next(Workspace& workspace, QueryInspector& queries, Notifications& notifications, Outcome outcome,
             const char* what) {
    const int from = in_query(workspace) ? workspace.step() : -1;
    entered(workspace, queries, kFirst);
    const mobb::Trace& trace = workspace.recorded()->trace;
    for (int event = from + 1; event < trace.size(); ++event) {
        if (trace[event].outcome == outcome) return to_event(workspace, event);
    }
    notifications.tell(MessageLevel::info, std::string("There is no later test that ") + what);
}

/// To the next or the previous avoidable overlap; says so if there is none.
template <int way>
void to_avoidable(Workspace& workspace, QueryInspector& queries, Notifications& notifications) {
    const bool was_in = in_query(workspace);
    entered(workspace, queries, way > 0 ? kFirst : kEnd);
    const AvoidableOverlaps& avoidable = queries.findings()->recursion.avoidable;
    // The step at which the query is entered is looked at too.
    const int here = workspace.step() + (was_in ? 0 : -way);
    const auto behind = std::ranges::upper_bound(avoidable.events, here);
    const auto at = std::ranges::lower_bound(avoidable.events, here);
    if (way > 0 && behind != avoidable.events.end()) return to_event(workspace, *behind);
    if (way < 0 && at != avoidable.events.begin()) return to_event(workspace, *(at - 1));
    std::string why = avoidable.events.empty() ? "No overlap of this query was avoidable"
                      : way > 0                ? "There is no later avoidable overlap"
                                               : "There is no earlier avoidable overlap";
    if (!avoidable.all_judged()) why.append(". ").append(judged_words(avoidable));
    notifications.tell(MessageLevel::info, why);
}

/// Which side of the query in view the selected node is of; none if no node of it is selected.
std::optional<int> side_of_node(const Workspace& workspace) {
    if (!in_query(workspace) || workspace.selection.kind != Selection::Kind::node) return std::nullopt;
    return index_in_view(workspace.fitted(), workspace.view(), workspace.selection.path);
}

/// To the next test of the selected node; behind the last one to the first again.
void to_next_of_node(Workspace& workspace, Notifications& notifications) {
    const bool of_a = *side_of_node(workspace) == 0;
    const mobb::Trace& trace = workspace.recorded()->trace;
    for (int i = 1; i <= trace.size(); ++i) {
        const int event = (workspace.step() + i) % trace.size();
        if ((of_a ? trace[event].a : trace[event].b) == workspace.selection.index) return to_event(workspace, event);
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

int parent_event(const Workspace& workspace) {
    const mobb::Trace& trace = workspace.recorded()->trace;
    return trace[workspace.step()].parent;
}

}  // namespace

std::vector<Command> query_commands() {
    const std::vector<Command> rows{
        Command("query.select", "Show query", "Shows a query, by its number from 0, with its answer.", select,
                {.menu = kNoMenu, .argument = "N", .enabled = has_queries}),
        Command("query.next", "Next query", "Shows the next query with its answer.", next,
                {.shortcut = "PageDown",
                 .repeats = true,
                 .enabled =
                     [](const Workspace& workspace) {
                         return workspace.view().query.value_or(-1) + 1 < query_total(workspace);
                     }}),
        Command("query.previous", "Previous query", "Shows the previous query with its answer.", previous,
                {.shortcut = "PageUp",
                 .repeats = true,
                 .enabled =
                     [](const Workspace& workspace) {
                         return workspace.view().query.value_or(query_total(workspace)) > 0;
                     }}),
        Command("query.none", "Close the query", "Leaves the query in view for the levels of all trees.", leave,
                {.shortcut = "Q", .enabled = {in_query, why_no_step}}),
        Command("query.add", "Ask against", "Asks whether the selected agent collides with another.", add_against,
                {.argument = "AGENT", .enabled = {has_selected_of_several, why_no_agent}, .choices = others}),
        Command("query.remove", "Remove the query", "Asks the selected query, or that in view, no more.", remove_edited,
                {.enabled =
                     [](const Workspace& workspace) { return edited_query(workspace) && query_total(workspace) > 1; }}),
        Command(
            "query.capture", "Open as a capture",
            "Opens the two of a query as a scene of their own, their samples inside and the answer expected; saved, "
            "it stands alone.",
            capture, {.argument = "[N]", .enabled = {may_capture, why_no_query}}),
        Command("query.copy_command", "Copy the query as command",
                "Shows a query and copies the command line that draws it again without a window.", copy_query_command,
                {.argument = "[N]", .enabled = {has_queries, why_no_query}}),
        Command("query.copy_answer", "Copy the answer in words",
                "Shows a query and copies whether the two collide, and why.", copy_answer,
                {.argument = "[N]", .enabled = {has_queries, why_no_query}}),
        Command("query.judge", "Judge all overlaps",
                "Finds out which overlaps of the query in view were avoidable, where there are too many to do so at "
                "once.",
                judge_all, {.enabled = {in_query, why_no_step}}),
        Command(
            "query.blame", "Sum avoidable overlaps by node",
            "Asks all queries and counts, by node, the overlaps that a tighter box would have avoided; the facts of "
            "a selected node say it then.",
            count_blame, {.enabled = {has_queries, why_no_query}}),
        Command("query.expect", "Expect this answer",
                "Writes the present answer into the scene: `mobbscope query` then says when it has changed.", expect,
                {.enabled = [](const Workspace& workspace) { return edited_query(workspace).has_value(); },
                 .checked = is_expected}),
        Command("step.first", "First step", "Shows the first test of the query.", first,
                {.shortcut = "Shift+Left", .enabled = {has_queries, why_no_step}}),
        Command("step.back", "Step back", "Shows the test before.", back,
                {.shortcut = "Left", .repeats = true, .enabled = {has_queries, why_no_step}}),
        Command("step.forward", "Step forward", "Shows the next test.", forward,
                {.shortcut = "Right", .repeats = true, .enabled = {has_queries, why_no_step}}),
        Command("step.last", "Last step", "Shows the last test, with the answer.", last,
                {.shortcut = "Shift+Right", .enabled = {has_queries, why_no_step}}),
        Command("step.before", "Step looked at before",
                "Goes back to where the last jump, or the last run of single steps, began; once more comes back, so "
                "that one key compares two steps.",
                to_step_before, {.shortcut = "J", .enabled = {has_step_before, why_no_step_before}}),
        Command("step.to", "Go to step", "Shows a test by its number from 0.", to,
                {.menu = kNoMenu,
                 .argument = "N",
                 .enabled = {in_query, why_no_step},
                 .present = [](const Workspace& workspace) { return std::to_string(workspace.step()); }}),
        Command("step.next_separated", "Next separation",
                "Shows the next test that found two boxes separated in space.",
                [](Workspace& workspace, QueryInspector& queries, Notifications& notifications) {
                    to_next(workspace, queries, notifications, Outcome::separated, "found boxes separated in space");
                },
                {.shortcut = "S", .enabled = {has_queries, why_no_step}}),
        Command("step.next_overlap", "Next overlap",
                "Shows the next test that found an overlap, so that the search went on below.",
                [](Workspace& workspace, QueryInspector& queries, Notifications& notifications) {
                    to_next(workspace, queries, notifications, Outcome::overlap, "found an overlap");
                },
                {.shortcut = "O", .enabled = {has_queries, why_no_step}}),
        Command("step.next_avoidable", "Next avoidable overlap",
                "Shows the next test that found an overlap although one line keeps the disks apart.", to_avoidable<1>,
                {.shortcut = "U", .enabled = {has_queries, why_no_step}}),
        Command("step.previous_avoidable", "Previous avoidable overlap",
                "Shows the last test before that found an overlap although one line keeps the disks apart.",
                to_avoidable<-1>, {.shortcut = "Shift+U", .enabled = {has_queries, why_no_step}}),
        Command("step.next_hit", "Next hit", "Shows the test that found samples which collide.",
                [](Workspace& workspace, QueryInspector& queries, Notifications& notifications) {
                    to_next(workspace, queries, notifications, Outcome::hit, "found a hit");
                },
                {.shortcut = "H", .enabled = {has_queries, why_no_step}}),
        Command("step.next_of_node", "Next test of the selected node",
                "Shows the next test of the selected node, and behind the last one the first.", to_next_of_node,
                {.enabled = {[](const Workspace& workspace) { return side_of_node(workspace).has_value(); },
                             [](const Workspace& workspace) -> std::string_view {
                                 return workspace.view().query ? "no node of the query is selected"
                                                               : "no query is shown";
                             }}}),
        Command("step.over", "Step over", "Shows the next test that is not about parts of the present two nodes.",
                [](Workspace& workspace, QueryInspector& queries) {
                    to_event(workspace, *event_after_pair(workspace, queries));
                },
                {.shortcut = "Down",
                 .repeats = true,
                 .enabled = {[](const Workspace& workspace, const QueryInspector& queries) {
                                 return in_query(workspace) && event_after_pair(workspace, queries);
                             },
                             why_no_step}}),
        Command(
            "step.out", "Step out", "Shows the test that led to the present one.",
            [](Workspace& workspace) { to_event(workspace, parent_event(workspace)); },
            {.shortcut = "Up",
             .repeats = true,
             .enabled = {[](const Workspace& workspace) { return in_query(workspace) && parent_event(workspace) >= 0; },
                         why_no_step}}),
        Command("step.percent", "Go to a percentage of the steps",
                "Shows the test at a percentage of the way, 0 to 100.", percent,
                {.menu = kNoMenu, .argument = "P", .enabled = {in_query, why_no_step}}),
    };
    return in_menu("Query", joined({rows, proof_commands()}));
}

}  // namespace mobbscope::app
