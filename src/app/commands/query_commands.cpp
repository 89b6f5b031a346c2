#include <app/commands/arguments.h>
#include <app/commands/command.h>
#include <app/document/agents.h>
#include <base/text.h>
#include <explain/query_findings.h>
#include <explain/query_sentence.h>
#include <mobb/capture.h>
#include <scene/scene_edits.h>

#include <algorithm>
#include <array>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace mobbscope::app {

namespace {

std::string_view why_no_query(const Workspace& workspace) {
    return workspace.crowd() ? "a run has conflicts, not queries" : "there is no query";
}
bool may_capture(const Workspace& workspace, const Jobs& jobs) { return has_queries(workspace) && !jobs.job(); }
std::string_view why_no_capture(const Workspace& workspace, const Jobs& jobs) {
    return jobs.job() ? "work is under way" : why_no_query(workspace);
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

/// The query `by` rows on in the list; from none the first, or the last.
template <int by>
std::optional<int> query_beside(const Workspace& workspace, const CostInspector& costs) {
    const std::vector<int>& listed = costs.listed();
    const auto count = static_cast<int>(listed.size());
    int place = by > 0 ? -1 : count;
    if (const auto now = workspace.view().query)
        place = static_cast<int>(std::ranges::find(listed, *now) - listed.begin());
    place += by;
    if (place < 0 || place >= count) return std::nullopt;
    return listed[static_cast<std::size_t>(place)];
}

template <int by>
bool has_query_beside(const Workspace& workspace, const CostInspector& costs) {
    return query_beside<by>(workspace, costs).has_value();
}

template <int by>
void show_beside(QueryInspector& queries, Workspace& workspace, const CostInspector& costs) {
    queries.show(*query_beside<by>(workspace, costs));
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
            clip.digest = mobb::digest(*clip.clip);
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
                               const FittedScene& now = *workspace.document().fitted;
                               // Another view may be active now: it is of the same scene, with another fit.
                               if (&in->scene() != &now.scene() && !ask_the_same(*in, now)) {
                                   return session.notifications.tell(
                                       MessageLevel::info, "The scene has changed: sum avoidable overlaps again");
                               }
                               workspace.keep_blame(in, blame);
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

// --- what they cost

constexpr std::array<std::string_view, 3> kQueryOrders{"hits", "number", "tests"};

void sort_queries(CostInspector& costs, const std::string& text) {
    costs.order = choice_named<CostInspector::Order>(kQueryOrders, text, "the order");
    if (costs.order == CostInspector::Order::tests) costs.count();
}

void show_worst(CostInspector& costs, QueryInspector& queries, Keys& keys) {
    costs.count([&] { queries.show(costs.costs()->by_tests.front()); });
    keys.move = FocusMove::picture;
}

}  // namespace

std::vector<Command> query_commands() {
    const std::vector<Command> rows{
        Command("query.select", "Show query", "Shows a query, by its number from 0, with its answer.", select,
                {.menu = kNoMenu, .argument = "N", .enabled = has_queries, .also = "pair collision ray"}),
        Command("query.next", "Next query", "Shows the next query of the list with its answer.", show_beside<1>,
                {.shortcut = "PageDown", .repeats = true, .enabled = has_query_beside<1>}),
        Command("query.previous", "Previous query", "Shows the previous query of the list with its answer.",
                show_beside<-1>, {.shortcut = "PageUp", .repeats = true, .enabled = has_query_beside<-1>}),
        Command("query.sort", "Sort queries by",
                "Lists those that hit first, all in their order, or the costliest first.", sort_queries,
                {.argument = "ORDER",
                 .enabled = {has_queries, why_no_query},
                 .choices =
                     [](const Session&) { return std::vector<std::string>(kQueryOrders.begin(), kQueryOrders.end()); },
                 .chosen =
                     [](const CostInspector& costs, const std::string& text) {
                         return kQueryOrders[static_cast<std::size_t>(costs.order)] == text;
                     }}),
        Command("query.worst", "Costliest query", "Shows the query with the most tests.", show_worst,
                {.enabled = {has_queries, why_no_query}, .also = "worst slowest expensive hot"}),
        Command("query.none", "Close the query", "Closes the query in view and shows the levels of all trees.", leave,
                {.shortcut = "Q", .enabled = {in_query, why_no_step}, .also = "exit leave back"}),
        Command("query.add", "Ask against", "Asks whether the selected agent collides with another.", add_against,
                {.argument = "AGENT",
                 .enabled = {has_selected_of_several, why_no_agent},
                 .choices = others,
                 .also = "new collide test"}),
        Command("query.remove", "Remove the query", "Removes the selected query, or the one in view.", remove_edited,
                {.enabled =
                     [](const Workspace& workspace) { return edited_query(workspace) && query_total(workspace) > 1; }}),
        Command("query.capture", "Open as a capture",
                "Opens the two clips of a query as a scene of its own, with their samples and the expected answer; "
                "saved, it needs no other file.",
                capture, {.argument = "[N]", .enabled = {may_capture, why_no_capture}, .also = "save repro bug"}),
        Command("query.copy_command", "Copy the query as command",
                "Shows a query and copies the command line that draws it again without a window.", copy_query_command,
                {.argument = "[N]", .enabled = {has_queries, why_no_query}}),
        Command("query.copy_answer", "Copy the answer in words",
                "Shows a query and copies whether the two collide, and why.", copy_answer,
                {.argument = "[N]", .enabled = {has_queries, why_no_query}}),
        Command("query.judge", "Judge all overlaps",
                "Finds out which overlaps of the query in view were avoidable, where there are too many to do so at "
                "once.",
                judge_all, {.enabled = {in_query, why_no_step}, .also = "avoidable false positive"}),
        Command(
            "query.blame", "Sum avoidable overlaps by node",
            "Asks all queries and counts, by node, the overlaps that a tighter box would have avoided; the facts of "
            "a selected node say it then.",
            count_blame,
            {.enabled = {has_queries, why_no_query}, .also = "waste wasted loose worst false positive unnecessary"}),
        Command("query.expect", "Expect this answer",
                "Writes the present answer into the scene: `mobbscope query` then says when it has changed.", expect,
                {.enabled = [](const Workspace& workspace) { return edited_query(workspace).has_value(); },
                 .checked = is_expected}),
    };
    return in_menu("Query", joined({rows, proof_commands()}));
}

}  // namespace mobbscope::app
