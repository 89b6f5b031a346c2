#include <app/commands/arguments.h>
#include <app/commands/command.h>
#include <app/document/agents.h>
#include <base/text.h>
#include <scene/scene_edits.h>

#include <algorithm>
#include <stdexcept>

namespace mobbscope::app {

namespace {

using mobb::Outcome;

bool has_queries(const Session& session) { return !session.fitted().queries().empty(); }
bool in_query(const Session& session) { return session.view().query.has_value(); }
int query_total(const Session& session) { return static_cast<int>(session.fitted().queries().size()); }

void show_query(Session& session, int query, Step step = {}) {
    session.change_view([&](ViewState& view) {
        view.query = query;
        view.step = step;
    });
}

void select(Session& session, const std::string& text) {
    show_query(session, whole_number_in(text, "the query", 0, query_total(session) - 1));
}

bool stays(const Message& message) { return message.level != Message::Level::info; }

/// One thing after the other, what lies in front first.
void leave(Session& session) {
    const auto& messages = session.messages();
    const auto last = std::find_if(messages.rbegin(), messages.rend(), stays);
    if (last != messages.rend()) return session.dismiss(static_cast<std::size_t>(messages.rend() - last) - 1);
    if (!in_query(session)) return session.select({});
    session.change_view([](ViewState& view) { view.query.reset(); });
}

void next(Session& session) { show_query(session, session.view().query.value_or(-1) + 1); }

void previous(Session& session) { show_query(session, session.view().query.value_or(query_total(session)) - 1); }

// --- what is asked

std::vector<std::string> others(const Session& session) {
    std::vector<std::string> names = path_names(session);
    if (has_selected_agent(session)) names.erase(names.begin() + selected_agent(session));
    return names;
}

/// The query that asks these two against each other, in either order.
std::optional<int> query_of(const Session& session, int a, int b) {
    for (int i = 0; i < query_total(session); ++i) {
        const SceneQuery query = session.fitted().queries()[static_cast<std::size_t>(i)];
        const auto [low, high] = std::minmax(query.a.agent, query.b.agent);
        if (low == std::min(a, b) && high == std::max(a, b)) return i;
    }
    return std::nullopt;
}

void add_against(Session& session, const std::string& other) {
    const int a = selected_agent(session);
    const int b = index_of_name(path_names(session), other, "agent");
    // What is asked already is only shown.
    if (const auto known = query_of(session, a, b)) return show_query(session, *known);
    session.edit({"asking " + selected_agent_name(session) + " against " + other, ""}, [&](Scene& scene) {
        add_agents_for_clips(scene);
        scene.view.query = static_cast<int>(add_query(scene, a, b));
        scene.view.step = {};
    });
}

/// The query that is edited: the selected one, else that in view.
std::optional<int> edited_query(const Session& session) {
    if (session.selection.kind == Selection::Kind::query) return session.selection.index;
    return session.view().query;
}

void remove_edited(Session& session) {
    const int query = *edited_query(session);
    session.edit({"removing a query", ""}, [&](Scene& scene) {
        remove_query(scene, static_cast<std::size_t>(query));
        std::optional<int>& shown = scene.view.query;
        if (shown == query) shown.reset();
        if (shown && *shown > query) --*shown;
    });
    // Those behind it have other indices now.
    if (session.selection.kind == Selection::Kind::query || session.selection.path.query >= 0) session.select({});
}

bool is_expected(const Session& session) {
    const auto query = edited_query(session);
    return query && session.fitted().queries()[static_cast<std::size_t>(*query)].expect.has_value();
}

void expect(Session& session) {
    const auto query = static_cast<std::size_t>(*edited_query(session));
    const bool was_expected = is_expected(session);
    const std::optional<mobb::Contact> contact = session.answer_of(query).contact;
    session.edit({was_expected ? "expecting nothing" : "expecting the answer", ""}, [&](Scene& scene) {
        make_queries_explicit(scene);
        scene.queries[query].expect =
            was_expected ? std::nullopt : std::optional<Expectation>({contact.has_value(), contact});
    });
}

// --- steps

void to_event(Session& session, int event) {
    session.change_view([&](ViewState& view) { view.step = {Step::Unit::event, static_cast<double>(event)}; });
}

/// Without a query in view its first one is shown instead, at this step.
bool entered(Session& session, Step step) {
    if (in_query(session)) return false;
    show_query(session, 0, step);
    return true;
}

constexpr Step kFirst{Step::Unit::event, 0};
constexpr Step kEnd{Step::Unit::end, 0};

void first(Session& session) {
    if (!entered(session, kFirst)) to_event(session, 0);
}

void back(Session& session) {
    if (!entered(session, kEnd)) to_event(session, std::max(session.step() - 1, 0));
}

void forward(Session& session) {
    if (!entered(session, kFirst))
        to_event(session, std::min(session.step() + 1, session.recorded()->trace.size() - 1));
}

void last(Session& session) {
    if (!entered(session, kEnd)) session.change_view([](ViewState& view) { view.step = kEnd; });
}

void to(Session& session, const std::string& text) {
    to_event(session, whole_number_in(text, "the step", 0, session.recorded()->trace.size() - 1));
}

void percent(Session& session, const std::string& text) {
    const double share = number_in(text, "the percentage", 0, 100);
    session.change_view([&](ViewState& view) { view.step = {Step::Unit::percent, share}; });
}

/// To the next event that ended so; says so if there is none.
void to_next(Session& session, Outcome outcome, const char* what) {
    const int from = in_query(session) ? session.step() : -1;
    entered(session, kFirst);
    const mobb::Trace& trace = session.recorded()->trace;
    for (int event = from + 1; event < trace.size(); ++event) {
        if (trace[event].outcome == outcome) return to_event(session, event);
    }
    session.tell(Message::Level::info, std::string("There is no later test that ") + what);
}

/// The next event of the same pair, or of the next pair that is not below it.
std::optional<int> event_after_pair(const Session& session) {
    const mobb::Trace& trace = session.recorded()->trace;
    const int depth = trace[session.step()].depth;
    for (int event = session.step() + 1; event < trace.size(); ++event) {
        if (trace[event].depth <= depth) return event;
    }
    return std::nullopt;
}

int parent_event(const Session& session) {
    const mobb::Trace& trace = session.recorded()->trace;
    return trace[session.step()].parent;
}

}  // namespace

std::vector<Command> query_commands() {
    const std::vector<Command> rows{
        {.id = "query.select",
         .title = "Show query",
         .menu = kNoMenu,
         .argument = "N",
         .doc = "Shows a query, by its number from 0, with its answer.",
         .enabled = has_queries,
         .run = select},
        {.id = "query.next",
         .title = "Next query",
         .shortcut = "PageDown",
         .repeats = true,
         .doc = "Shows the next query with its answer.",
         .enabled = [](const Session& session) { return session.view().query.value_or(-1) + 1 < query_total(session); },
         .run = next},
        {.id = "query.previous",
         .title = "Previous query",
         .shortcut = "PageUp",
         .repeats = true,
         .doc = "Shows the previous query with its answer.",
         .enabled = [](const Session& session) { return session.view().query.value_or(query_total(session)) > 0; },
         .run = previous},
        {.id = "query.none",
         .title = "Back",
         .shortcut = "Escape",
         .doc = "Dismisses a message; else leaves the query in view for the levels of all trees; else selects nothing.",
         .enabled =
             [](const Session& session) {
                 return in_query(session) || session.selection.kind != Selection::Kind::none ||
                        std::any_of(session.messages().begin(), session.messages().end(), stays);
             },
         .run = leave},
        {.id = "query.add",
         .title = "Ask against",
         .argument = "AGENT",
         .doc = "Asks whether the selected agent collides with another.",
         .enabled = {has_selected_of_several, why_no_agent},
         .run = add_against,
         .choices = others},
        {.id = "query.remove",
         .title = "Remove the query",
         .doc = "Asks the selected query, or that in view, no more.",
         .enabled = [](const Session& session) { return edited_query(session) && query_total(session) > 1; },
         .run = remove_edited},
        {.id = "query.expect",
         .title = "Expect this answer",
         .doc = "Writes the present answer into the scene: `mobbscope query` then says when it has changed.",
         .enabled = [](const Session& session) { return edited_query(session).has_value(); },
         .run = expect,
         .checked = is_expected},
        {.id = "step.first",
         .title = "First step",
         .shortcut = "Shift+Left",
         .doc = "Shows the first test of the query.",
         .enabled = {has_queries, why_no_step},
         .run = first},
        {.id = "step.back",
         .title = "Step back",
         .shortcut = "Left",
         .repeats = true,
         .doc = "Shows the test before.",
         .enabled = {has_queries, why_no_step},
         .run = back},
        {.id = "step.forward",
         .title = "Step forward",
         .shortcut = "Right",
         .repeats = true,
         .doc = "Shows the next test.",
         .enabled = {has_queries, why_no_step},
         .run = forward},
        {.id = "step.last",
         .title = "Last step",
         .shortcut = "Shift+Right",
         .doc = "Shows the last test, with the answer.",
         .enabled = {has_queries, why_no_step},
         .run = last},
        {.id = "step.to",
         .title = "Go to step",
         .menu = kNoMenu,
         .argument = "N",
         .doc = "Shows a test by its number from 0.",
         .enabled = {in_query, why_no_step},
         .run = to},
        {.id = "step.next_separated",
         .title = "Next separation",
         .shortcut = "S",
         .doc = "Shows the next test that found two boxes separated in space.",
         .enabled = {has_queries, why_no_step},
         .run = [](Session& session) { to_next(session, Outcome::separated, "found boxes separated in space"); }},
        {.id = "step.next_overlap",
         .title = "Next overlap",
         .shortcut = "O",
         .doc = "Shows the next test that found an overlap, so that the search went on below.",
         .enabled = {has_queries, why_no_step},
         .run = [](Session& session) { to_next(session, Outcome::overlap, "found an overlap"); }},
        {.id = "step.next_hit",
         .title = "Next hit",
         .shortcut = "H",
         .doc = "Shows the test that found samples which collide.",
         .enabled = {has_queries, why_no_step},
         .run = [](Session& session) { to_next(session, Outcome::hit, "found a hit"); }},
        {.id = "step.over",
         .title = "Step over",
         .shortcut = "Down",
         .repeats = true,
         .doc = "Shows the next test that is not about parts of the present two nodes.",
         .enabled = {[](const Session& session) { return in_query(session) && event_after_pair(session); },
                     why_no_step},
         .run = [](Session& session) { to_event(session, *event_after_pair(session)); }},
        {.id = "step.out",
         .title = "Step out",
         .shortcut = "Up",
         .repeats = true,
         .doc = "Shows the test that led to the present one.",
         .enabled = {[](const Session& session) { return in_query(session) && parent_event(session) >= 0; },
                     why_no_step},
         .run = [](Session& session) { to_event(session, parent_event(session)); }},
        {.id = "step.percent",
         .title = "Go to a percentage of the steps",
         .menu = kNoMenu,
         .argument = "P",
         .doc = "Shows the test at a percentage of the way, 0 to 100.",
         .enabled = {in_query, why_no_step},
         .run = percent},
    };
    return in_menu("Query", rows);
}

}  // namespace mobbscope::app
