// The table of a tree's nodes; and what is common to it and to the list of a query's events.
#include <app/commands/arguments.h>
#include <app/commands/command.h>
#include <app/document/agents.h>
#include <base/text.h>

#include <algorithm>
#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace mobbscope::app {

namespace {

// --- the table of nodes

void apply_to_nodes(NodeInspector& nodes, Settings& settings, std::optional<NodeFilter> filter) {
    nodes.filter = std::move(filter);
    settings.bottom_tab = BottomTab::nodes;
}

void filter_nodes(NodeInspector& nodes, Settings& settings, const std::string& text) {
    apply_to_nodes(nodes, settings, NodeFilter(text));
}

std::string node_filter_now(const NodeInspector& nodes) { return nodes.filter ? nodes.filter->text() : ""; }

std::vector<std::string> node_column_names() {
    std::vector<std::string> out;
    for (const NodeField field : node_columns()) out.emplace_back(info(field).name);
    return out;
}

void sort_nodes_by(NodeInspector& nodes, Settings& settings, const std::string& text) {
    nodes.sort_by(node_columns()[static_cast<std::size_t>(index_of_name(node_column_names(), text, "column"))]);
    settings.bottom_tab = BottomTab::nodes;
}

void count_all_of_nodes(Session& session) {
    session.costs.count();
    if (!session.workspace.blame()) run_command(session, "query.blame");
}

bool can_count_nodes(const Workspace& workspace, const NodeInspector& nodes) {
    return has_scene(workspace) && nodes.can_count();
}
std::string_view why_not_counted(const Workspace& workspace) {
    return has_queries(workspace) ? "they are counted" : "the scene has no queries";
}

template <char separator>
void copy_nodes(Session& session) {
    const NodeInspector& nodes = session.nodes;
    const std::vector<int>& rows = *nodes.listed();
    session.desktop->set_clipboard(node_rows(*nodes.values(), nodes.columns(), rows, separator));
    session.notifications.tell(MessageLevel::info, "Copied " + counted(rows.size(), "node", "nodes"));
}

// --- rows of whatever is listed

bool lists_nodes(const Settings& settings) { return settings.bottom_tab == BottomTab::nodes; }

bool has_rows(const Settings& settings, const QueryInspector& queries, const Workspace& workspace) {
    return lists_nodes(settings) ? has_scene(workspace) : has_events(queries);
}
std::string_view why_no_rows() { return "no query is shown, nor the table of nodes"; }

template <int by>
void to_row(Session& session) {
    Workspace& workspace = session.workspace;
    const bool nodes = lists_nodes(session.settings);
    const std::optional<int> row = nodes ? session.nodes.beside(by) : session.queries.listed_event_beside(by);
    if (!row) {
        const std::string what = nodes ? "The table of nodes " : "The list of events ";
        return session.notifications.tell(MessageLevel::info, what + (by > 0 ? "ends" : "begins") + " here");
    }
    if (!nodes) return workspace.go_to_event(*row);
    if (const auto selection = session.nodes.selection_of(*row)) workspace.select(*selection);
}

void find_rows(Settings& settings, const QueryInspector& queries, Keys& keys) {
    if (!lists_nodes(settings)) settings.bottom_tab = has_events(queries) ? BottomTab::events : BottomTab::nodes;
    keys.field = lists_nodes(settings) ? "nodes.filter" : "events.filter";
}

}  // namespace

std::vector<Command> node_commands() {
    const std::vector<Command> rows{
        Command("nodes.filter", "Filter the nodes by",
                "Lists the nodes of the tree in focus that pass a filter: fill < 50 % and not leaf.", filter_nodes,
                {.menu = kNoMenu, .argument = "FILTER", .present = node_filter_now}),
        Command("nodes.all", "All nodes", "Lists all nodes of the tree in focus.",
                [](NodeInspector& nodes, Settings& settings) { apply_to_nodes(nodes, settings, std::nullopt); },
                {.enabled = {[](const NodeInspector& nodes, const Workspace& workspace) {
                                 return has_scene(workspace) && nodes.filter.has_value();
                             },
                             [] { return std::string_view("all are listed"); }}}),
        Command("nodes.sort", "Sort nodes by",
                "Sorts the table of nodes by a column, the worst first; the same one again reverses the order.",
                sort_nodes_by,
                {.argument = "COLUMN",
                 .choices = [](const Session&) { return node_column_names(); },
                 .chosen = [](const NodeInspector& nodes,
                              const std::string& column) { return info(nodes.by).name == column; },
                 .also = "worst order rank"}),
        Command("nodes.count", "Count tests and avoidable overlaps",
                "Counts the tests of each node, and the avoidable overlaps it is to blame for, over all queries.",
                count_all_of_nodes, {.enabled = {can_count_nodes, why_not_counted}}),
        Command("nodes.copy", "Copy the nodes", "Copies the rows of the table of nodes, with tabs between columns.",
                copy_nodes<'\t'>),
        Command("nodes.copy_csv", "Copy the nodes as CSV", "Copies the rows of the table of nodes as CSV.",
                copy_nodes<','>),
    };
    return in_menu("Tree/Nodes", rows);
}

std::vector<Command> row_commands() {
    const std::vector<Command> rows{
        Command("rows.find", "Filter the list below...",
                "Waits for a filter of the nodes where these are listed, else of the events of the query in view.",
                find_rows, {.shortcut = "Ctrl+F", .also = "search"}),
        Command("rows.next", "Next row",
                "Selects the next node in the order of the table, or shows the next event in that of the list.",
                to_row<1>, {.shortcut = "F3", .repeats = true, .enabled = {has_rows, why_no_rows}}),
        Command("rows.previous", "Previous row",
                "Selects the node before in the order of the table, or shows the event before in that of the list.",
                to_row<-1>, {.shortcut = "Shift+F3", .repeats = true, .enabled = {has_rows, why_no_rows}}),
    };
    return in_menu("Go/Rows", rows);
}

}  // namespace mobbscope::app
