#include <app/commands/arguments.h>
#include <app/commands/command.h>
#include <app/document/agents.h>
#include <app/document/debug_texts.h>
#include <base/text.h>
#include <scene/scene_edits.h>
#include <scene/step_link.h>

#include <algorithm>
#include <functional>
#include <iterator>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace mobbscope::app {

namespace {

const DebugState& debug_of(const Workspace& workspace) { return workspace.scene().debug; }

std::string_view why_no_events() { return "no query is shown"; }
Condition with_events() { return {has_events, why_no_events}; }

// --- the list of events

bool shows_list(const Settings& settings) { return settings.bottom_tab == BottomTab::events; }
void show_list(Settings& settings) {
    settings.bottom_tab = shows_list(settings) ? BottomTab::recursion : BottomTab::events;
}

void apply(Workspace& workspace, Settings& settings, const std::optional<EventFilter>& filter) {
    workspace.events.filter = filter;
    workspace.derived().listed_events.reset();
    settings.bottom_tab = BottomTab::events;
}

void filter_events(Workspace& workspace, Settings& settings, const std::string& text) {
    apply(workspace, settings, EventFilter(text));
}

std::string filter_now(const Workspace& workspace) {
    return workspace.events.filter ? workspace.events.filter->text() : "";
}

bool is_filtered(const Workspace& workspace) { return workspace.events.filter.has_value(); }

std::vector<std::string> column_names() {
    std::vector<std::string> out;
    for (const EventColumn& column : event_columns()) out.push_back(column_name(column));
    return out;
}

void sort_by(Workspace& workspace, const std::string& text) {
    const EventColumn& column =
        event_columns()[static_cast<std::size_t>(index_of_name(column_names(), text, "column"))];
    EventList& list = workspace.events;
    const bool again = column_name(list.by) == text;
    list.by = column;
    list.descending = again && !list.descending;
    workspace.derived().listed_events.reset();
}

template <char separator>
void copy_rows(const Session& session) {
    const std::vector<int>& steps = *session.queries.listed_events();
    session.desktop->set_clipboard(event_rows(session.queries.events(), steps, separator));
}

void copy_with_note(Session& session, const std::function<void(const Session&)>& copy) {
    copy(session);
    session.notifications.tell(MessageLevel::info,
                               "Copied " + counted(session.queries.listed_events()->size(), "event", "events"));
}

// --- saved filters

std::vector<std::string> filter_names(const Workspace& workspace) {
    std::vector<std::string> out;
    for (const NamedFilter& saved : debug_of(workspace).filters) out.push_back(saved.name);
    return out;
}

bool has_filters(const Workspace& workspace) { return !debug_of(workspace).filters.empty(); }
std::string_view why_no_filter() { return "no filter is saved with this scene"; }

std::size_t filter_named(const Workspace& workspace, const std::string& name) {
    return static_cast<std::size_t>(index_of_name(filter_names(workspace), name, "saved filter"));
}

/// The saved one that holds now.
std::optional<std::size_t> saved_filter(const Workspace& workspace) {
    const std::vector<NamedFilter>& filters = debug_of(workspace).filters;
    const auto at = std::ranges::find(filters, filter_now(workspace), &NamedFilter::where);
    return at == filters.end() ? std::nullopt : std::optional(static_cast<std::size_t>(at - filters.begin()));
}

/// Under a name; another one of that name becomes this one.
void save_filter(Workspace& workspace, const std::string& text) {
    const std::string name = given_name(text, "a filter");
    workspace.edit_debug("saving the filter " + name, [&](DebugState& debug) {
        const auto known = std::ranges::find(debug.filters, name, &NamedFilter::name);
        NamedFilter saved{name, filter_now(workspace)};
        if (known == debug.filters.end()) {
            debug.filters.push_back(std::move(saved));
        } else {
            *known = std::move(saved);
        }
    });
}

void rename_filter(Workspace& workspace, const std::string& text) {
    const std::string name = given_name(text, "a filter");
    const std::size_t index = *saved_filter(workspace);
    const std::vector<std::string> names = filter_names(workspace);
    if (names[index] == name) return;
    if (std::ranges::find(names, name) != names.end())
        throw std::invalid_argument("another filter is named " + in_quotes(name));
    workspace.edit_debug("calling the filter " + name, [&](DebugState& debug) { debug.filters[index].name = name; });
}

void apply_saved(Workspace& workspace, Settings& settings, const std::string& name) {
    apply(workspace, settings, EventFilter(debug_of(workspace).filters[filter_named(workspace, name)].where));
}

void remove_filter(Workspace& workspace, const std::string& name) {
    const std::size_t index = filter_named(workspace, name);
    workspace.edit_debug("removing the filter " + filter_names(workspace)[index], [&](DebugState& debug) {
        debug.filters.erase(debug.filters.begin() + static_cast<std::ptrdiff_t>(index));
    });
}

// --- breakpoints

std::vector<std::string> breakpoint_texts(const Workspace& workspace) {
    std::vector<std::string> out;
    for (const Breakpoint& breakpoint : debug_of(workspace).breakpoints) out.push_back(breakpoint.where);
    return out;
}

bool has_breakpoints(const Workspace& workspace) { return !debug_of(workspace).breakpoints.empty(); }
std::string_view why_no_breakpoint() { return "the scene has no breakpoint"; }

std::size_t breakpoint_of(const Workspace& workspace, const std::string& text) {
    return static_cast<std::size_t>(index_of_name(breakpoint_texts(workspace), text, "breakpoint"));
}

/// One that is there already is switched on.
void add_breakpoint(Workspace& workspace, const std::string& text) {
    const std::string where = EventFilter(trimmed(text)).text();
    workspace.edit_debug("breaking when " + where, [&](DebugState& debug) {
        const auto known = std::ranges::find(debug.breakpoints, where, &Breakpoint::where);
        if (known != debug.breakpoints.end()) {
            known->on = true;
        } else {
            debug.breakpoints.push_back({where, true});
        }
    });
}

void remove_breakpoint(Workspace& workspace, const std::string& text) {
    const std::size_t index = breakpoint_of(workspace, text);
    workspace.edit_debug("no longer breaking when " + text, [&](DebugState& debug) {
        debug.breakpoints.erase(debug.breakpoints.begin() + static_cast<std::ptrdiff_t>(index));
    });
}

void switch_breakpoint(Workspace& workspace, const std::string& text) {
    const std::size_t index = breakpoint_of(workspace, text);
    const bool on = !debug_of(workspace).breakpoints[index].on;
    workspace.edit_debug((on ? "switching on: " : "switching off: ") + text,
                         [&](DebugState& debug) { debug.breakpoints[index].on = on; });
}

std::string present_pair(const QueryInspector& queries, const Workspace& workspace) {
    return pair_filter(queries, workspace.step());
}

void break_here(QueryInspector& queries, Workspace& workspace, Notifications& notifications) {
    const std::string where = present_pair(queries, workspace);
    const std::vector<std::string> texts = breakpoint_texts(workspace);
    const bool is_new = std::ranges::find(texts, where) == texts.end();
    is_new ? add_breakpoint(workspace, where) : remove_breakpoint(workspace, where);
    notifications.tell(MessageLevel::info, (is_new ? "Breaks when " : "No longer breaks when ") + where);
}

bool breaks_here(const QueryInspector& queries, const Workspace& workspace) {
    if (!has_events(queries)) return false;
    const std::vector<std::string> texts = breakpoint_texts(workspace);
    return std::ranges::find(texts, present_pair(queries, workspace)) != texts.end();
}

std::string_view why_no_break(const QueryInspector& queries) {
    return has_events(queries) ? "no breakpoint is on" : why_no_events();
}
bool has_breaks(const QueryInspector& queries, const Workspace& workspace) {
    return has_events(queries) && std::ranges::any_of(debug_of(workspace).breakpoints, &Breakpoint::on);
}

void to_next_break(QueryInspector& queries, Workspace& workspace, Notifications& notifications) {
    const std::vector<int>& steps = queries.break_steps();
    const auto next = std::ranges::upper_bound(steps, workspace.step());
    if (next != steps.end()) return workspace.go_to_event(*next);
    notifications.tell(MessageLevel::info, "No later breakpoint");
}

void to_previous_break(QueryInspector& queries, Workspace& workspace, Notifications& notifications) {
    const std::vector<int>& steps = queries.break_steps();
    const auto behind = std::ranges::lower_bound(steps, workspace.step());
    if (behind != steps.begin()) return workspace.go_to_event(*std::prev(behind));
    notifications.tell(MessageLevel::info, "No earlier breakpoint");
}

// --- bookmarks

std::vector<std::string> bookmark_names(const Workspace& workspace) { return names_of_bookmarks(debug_of(workspace)); }

bool has_bookmarks(const Workspace& workspace) { return !debug_of(workspace).bookmarks.empty(); }
std::string_view why_no_bookmark() { return "the scene has no bookmark"; }

std::size_t bookmark_named(const Workspace& workspace, const std::string& name) {
    return static_cast<std::size_t>(index_of_name(bookmark_names(workspace), name, "bookmark"));
}

std::optional<std::size_t> bookmark_here(const QueryInspector& queries, const Workspace& workspace) {
    return has_events(queries) ? present_bookmark(workspace) : std::nullopt;
}
bool is_bookmarked(const QueryInspector& queries, const Workspace& workspace) {
    return bookmark_here(queries, workspace).has_value();
}
Condition on_bookmark() {
    return {is_bookmarked, [] { return std::string_view("this step has no bookmark"); }};
}

/// Without a name it is called by what is tested.
void add_bookmark(Session& session, const std::string& text) {
    QueryInspector& queries = session.queries;
    Workspace& workspace = session.workspace;
    const int step = workspace.step();
    if (const auto known = present_bookmark(workspace))
        throw std::invalid_argument("this step is bookmarked already: " + bookmark_names(workspace)[*known]);
    UnusedNames names(debug_of(workspace).bookmarks);
    const std::string wanted = trimmed(text).empty() ? name_of_event(queries, step) : given_name(text, "a bookmark");
    const std::string name = names.take(wanted);
    workspace.edit_debug("bookmark " + name, [&](DebugState& debug) {
        debug.bookmarks.push_back({name, *workspace.view().query, step, ""});
    });
    session.keys.section = "bookmarks";
    session.notifications.tell(MessageLevel::info, "Bookmarked step " + std::to_string(step) + ": " + name);
}

void go_to_bookmark(QueryInspector& queries, Workspace& workspace, const std::string& name) {
    const Bookmark& bookmark = debug_of(workspace).bookmarks[bookmark_named(workspace, name)];
    queries.show(bookmark.query, Step{Step::Unit::event, static_cast<double>(bookmark.step)});
}

void remove_bookmark(Workspace& workspace, const std::string& name) {
    const std::size_t index = bookmark_named(workspace, name);
    workspace.edit_debug("removing the bookmark " + name, [&](DebugState& debug) {
        debug.bookmarks.erase(debug.bookmarks.begin() + static_cast<std::ptrdiff_t>(index));
    });
}

void rename_bookmark(Workspace& workspace, const std::string& text) {
    const std::string name = given_name(text, "a bookmark");
    const std::size_t index = *present_bookmark(workspace);
    const std::vector<std::string> names = bookmark_names(workspace);
    if (names[index] != name && std::ranges::find(names, name) != names.end())
        throw std::invalid_argument("another bookmark is named " + in_quotes(name));
    workspace.edit_debug("calling the bookmark " + name,
                         [&](DebugState& debug) { debug.bookmarks[index].name = name; });
}

void note_bookmark(Workspace& workspace, const std::string& text) {
    if (!is_utf8(text)) throw std::invalid_argument("a note is written in UTF-8");
    const std::size_t index = *present_bookmark(workspace);
    workspace.edit_debug("a note on the bookmark " + bookmark_names(workspace)[index],
                         [&](DebugState& debug) { debug.bookmarks[index].note = trimmed(text); });
}

std::string name_here(const Workspace& workspace) {
    const auto index = present_bookmark(workspace);
    return index ? debug_of(workspace).bookmarks[*index].name : "";
}

std::string note_here(const Workspace& workspace) {
    const auto index = present_bookmark(workspace);
    return index ? debug_of(workspace).bookmarks[*index].note : "";
}

// --- steps that were visited

template <bool forward>
void revisit(Workspace& workspace, Notifications& notifications) {
    if (!workspace.revisit(forward)) notifications.tell(MessageLevel::info, "The visited queries no longer exist");
}

template <bool forward>
bool has_visited(const Workspace& workspace) {
    return !(forward ? workspace.visited.after : workspace.visited.before).empty();
}

void copy_link(const Session& session) {
    const Workspace& workspace = session.workspace;
    session.desktop->set_clipboard(workspace.file->string() +
                                   to_string(StepLink{*workspace.view().query, workspace.step()}));
}

std::vector<Command> event_commands() {
    const std::vector<Command> rows{
        Command("events.show", "List of events", "Lists the tests of the query in view in place of its recursion.",
                show_list,
                {.shortcut = "R",
                 .enabled = with_events(),
                 .checked = shows_list,
                 .also = "table spreadsheet event browser log trace calls"}),
        Command("events.filter", "Filter by", "Lists the events that pass a filter: gap < 0.05 and level(a) >= 3.",
                filter_events,
                {.menu = kNoMenu, .argument = "FILTER", .enabled = with_events(), .present = filter_now}),
        Command("events.all", "All events", "Lists all events of the query.",
                [](Workspace& workspace, Settings& settings) { apply(workspace, settings, std::nullopt); },
                {.enabled = {[](const QueryInspector& queries, const Workspace& workspace) {
                                 return has_events(queries) && is_filtered(workspace);
                             },
                             [] { return std::string_view("all are listed"); }}}),
        Command("events.sort", "Sort by",
                "Sorts the list of events by a column; the same one again reverses the order.", sort_by,
                {.argument = "COLUMN",
                 .enabled = with_events(),
                 .choices = [](const Session&) { return column_names(); },
                 .chosen = [](const Workspace& workspace,
                              const std::string& column) { return column_name(workspace.events.by) == column; }}),
        Command("events.saved", "Saved filter", "Lists the events that pass a filter saved with the scene.",
                apply_saved,
                {.argument = "NAME",
                 .enabled = {[](const QueryInspector& queries, const Workspace& workspace) {
                                 return has_events(queries) && has_filters(workspace);
                             },
                             why_no_filter},
                 .choices = filter_names,
                 .chosen =
                     [](const Workspace& workspace, const std::string& name) {
                         const auto saved = saved_filter(workspace);
                         return saved && filter_names(workspace)[*saved] == name;
                     }}),
        Command(
            "events.save", "Save the filter as...", "Saves the filter of the list with the scene, under a name.",
            save_filter,
            {.argument = "NAME", .enabled = {is_filtered, [] { return std::string_view("the list has no filter"); }}}),
        Command("events.rename_saved", "Rename the saved filter...", "Gives the saved filter of the list another name.",
                rename_filter,
                {.argument = "NAME",
                 .enabled = {[](const Workspace& workspace) { return saved_filter(workspace).has_value(); },
                             [] { return std::string_view("the filter of the list is not saved"); }},
                 .present =
                     [](const Workspace& workspace) {
                         const auto saved = saved_filter(workspace);
                         return saved ? filter_names(workspace)[*saved] : "";
                     }}),
        Command("events.remove_saved", "Remove a saved filter", "Removes a filter that is saved with the scene.",
                remove_filter, {.argument = "NAME", .enabled = {has_filters, why_no_filter}, .choices = filter_names}),
        Command("events.copy", "Copy the list", "Copies the rows of the list of events, with tabs between columns.",
                [](Session& session) { copy_with_note(session, copy_rows<'\t'>); },
                {.enabled = with_events(), .also = "clipboard"}),
        Command("events.copy_csv", "Copy the list as CSV", "Copies the rows of the list of events as CSV.",
                [](Session& session) { copy_with_note(session, copy_rows<','>); },
                {.enabled = with_events(), .also = "spreadsheet excel export"}),
    };
    return in_menu("Query/Events", rows);
}

std::vector<Command> breakpoint_commands() {
    const std::vector<Command> rows{
        Command("breakpoint.here", "Break at these two nodes",
                "Adds a breakpoint for tests of the present two nodes, or removes it.", break_here,
                {.shortcut = "F9", .enabled = with_events(), .checked = breaks_here, .also = "breakpoint toggle stop"}),
        Command("breakpoint.next", "Run to the next breakpoint",
                "Shows the next test that stops at an enabled breakpoint.", to_next_break,
                {.shortcut = "F4", .repeats = true, .enabled = {has_breaks, why_no_break}, .also = "continue resume"}),
        Command("breakpoint.previous", "Run back to a breakpoint",
                "Shows the previous test that stops at an enabled breakpoint.", to_previous_break,
                {.shortcut = "Shift+F4", .repeats = true, .enabled = {has_breaks, why_no_break}}),
        Command("breakpoint.add", "Break when...", "Adds a breakpoint, written as a filter: outcome = hit.",
                add_breakpoint, {.argument = "FILTER", .also = "breakpoint watch condition stop"}),
        Command("breakpoint.switch", "Switch a breakpoint", "Switches a breakpoint on or off.", switch_breakpoint,
                {.argument = "FILTER", .enabled = {has_breakpoints, why_no_breakpoint}, .choices = breakpoint_texts}),
        Command("breakpoint.remove", "Remove a breakpoint", "Removes a breakpoint.", remove_breakpoint,
                {.argument = "FILTER", .enabled = {has_breakpoints, why_no_breakpoint}, .choices = breakpoint_texts}),
    };
    return in_menu("Query/Breakpoints", rows);
}

std::vector<Command> bookmark_commands() {
    const std::vector<Command> rows{
        Command("bookmark.add", "Bookmark this step",
                "Keeps the present step with the scene, under a name if one is given.", add_bookmark,
                {.shortcut = "Ctrl+B",
                 .argument = "[NAME]",
                 .enabled = with_events(),
                 .also = "flag marker remember save"}),
        Command("bookmark.go", "Go to a bookmark", "Shows the query and the step of a bookmark.", go_to_bookmark,
                {.argument = "NAME", .enabled = {has_bookmarks, why_no_bookmark}, .choices = bookmark_names}),
        Command("bookmark.rename", "Rename the bookmark...", "Gives the bookmark of the present step another name.",
                rename_bookmark, {.argument = "NAME", .enabled = on_bookmark(), .present = name_here}),
        Command("bookmark.note", "Note on the bookmark...",
                "Writes a note on the bookmark of the present step; without a text it has none.", note_bookmark,
                {.argument = "[NOTE]", .enabled = on_bookmark(), .present = note_here}),
        Command("bookmark.remove", "Remove a bookmark", "Removes a bookmark.", remove_bookmark,
                {.argument = "NAME", .enabled = {has_bookmarks, why_no_bookmark}, .choices = bookmark_names}),
        Command(
            "step.visited_back", "Back to the step visited before",
            "Goes back to where the last jump or run of single steps began; again: further back.", revisit<false>,
            {.shortcut = "Z",
             .repeats = true,
             .enabled = {has_visited<false>, [] { return std::string_view("no step was visited before this one"); }}}),
        Command("step.visited_forward", "Forward to the step visited next", "Goes forward again, after going back.",
                revisit<true>,
                {.shortcut = "Shift+Z",
                 .repeats = true,
                 .enabled = {has_visited<true>, [] { return std::string_view("nothing to go forward to"); }}}),
        Command("step.copy_link", "Copy a link to this step",
                "Copies a link to this file, query and step: `mobbscope FILE#q3@412` opens it there.", copy_link,
                {.enabled = {[](const QueryInspector& queries, const Workspace& workspace) {
                                 return has_events(queries) && workspace.file && !workspace.in_excerpt();
                             },
                             [](const QueryInspector& queries) {
                                 return has_events(queries)
                                            ? std::string_view("the scene has no file yet: save it first")
                                            : why_no_events();
                             }}}),
    };
    return in_menu("Query/Bookmarks", rows);
}

}  // namespace

bool has_events(const QueryInspector& queries) {
    const std::shared_ptr<const QueryFindings> findings = queries.findings();
    return findings && !findings->recursion.pairs.empty();
}

std::vector<Command> debug_commands() { return joined({event_commands(), breakpoint_commands(), bookmark_commands()}); }

}  // namespace mobbscope::app
