#include <app/commands/arguments.h>
#include <app/commands/command.h>
#include <app/document/agents.h>
#include <app/document/shown_agents.h>
#include <render/parts/node_boxes.h>

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>
#include <unordered_set>
#include <vector>

namespace mobbscope::app {

namespace {

/// Paths by their names, the first of each name: those in the picture first, as a query may place clips itself.
struct NamedPaths {
    explicit NamedPaths(const Session& session) {
        std::unordered_set<std::string> known;
        const auto add = [&](const AgentRef& path) {
            const std::string name = placed_agent_of(session.workspace.fitted(), path)->name;
            if (!known.insert(name).second) return;
            names.push_back(name);
            paths.push_back(path);
        };
        for (int side = 0; side < (session.workspace.view().query ? 2 : 0); ++side) {
            add(agent_in_view(session.workspace.fitted(), session.workspace.view(), side));
        }
        for (int i = 0; i < static_cast<int>(session.workspace.fitted().placed_agents().size()); ++i) add({i, -1, 0});
    }
    std::vector<std::string> names;
    std::vector<AgentRef> paths;
};

AgentRef path_named(const Session& session, std::string_view name) {
    const NamedPaths all(session);
    return all.paths[static_cast<std::size_t>(index_of_name(all.names, name, "agent"))];
}

const mobb::Tree& tree_of(const Workspace& workspace, const AgentRef& path) {
    return workspace.fitted().tree(placed_agent_of(workspace.fitted(), path)->clip);
}

const mobb::Tree& selected_tree(const Workspace& workspace) { return tree_of(workspace, workspace.selection.path); }

/// Selects something of a path and brings it into the picture: what a query does not show is outside of it, and a node
/// is seen only on its level.
void go_to(Workspace& workspace, const Selection& selected) {
    const bool in_view = index_in_view(workspace.fitted(), workspace.view(), selected.path).has_value();
    const mobb::Tree& tree = tree_of(workspace, selected.path);
    workspace.change_view([&](ViewState& view) {
        if (!in_view) view.query.reset();
        if (selected.kind != Selection::Kind::node || view.query) return;
        // A part that is shown alone goes along with what is selected outside of it.
        const bool of_part = view.subtree && view.subtree->agent == selected.path.agent;
        if (of_part && !is_within(tree, selected.index, view.subtree->node)) view.subtree->node = selected.index;
        if (of_part && view.subtree->node == selected.index) return;
        const std::vector<int> shown = shown_nodes(tree, view.levels);
        if (std::find(shown.begin(), shown.end(), selected.index) != shown.end()) return;
        const int level = tree.level(selected.index);
        view.levels = {level, level, false};
    });
    workspace.select(selected);
}

void go_to_node(Workspace& workspace, int node) {
    go_to(workspace, {Selection::Kind::node, workspace.selection.path, node});
}

void go_agent(Session& session, const std::string& name) {
    go_to(session.workspace, {Selection::Kind::path, path_named(session, name), -1});
}

void go_node(Session& session, const std::string& text) {
    const auto [name, place] = name_and_word(text, "the node");
    const AgentRef path = path_named(session, name);
    go_to(session.workspace, {Selection::Kind::node, path, node_at(tree_of(session.workspace, path), place)});
}

void go_sample(Session& session, const std::string& text) {
    const auto [name, index] = name_and_word(text, "the sample");
    const AgentRef path = path_named(session, name);
    const int last = tree_of(session.workspace, path).clip().count() - 1;
    go_to(session.workspace, {Selection::Kind::sample, path, whole_number_in(index, "the sample", 0, last)});
}

// --- about the tree

/// A node's parent, or a sample's leaf; -1 if there is none.
int parent(const Workspace& workspace) {
    const Selection& selected = workspace.selection;
    if (selected.kind == Selection::Kind::sample) return leaf_of_sample(selected_tree(workspace), selected.index);
    if (selected.kind != Selection::Kind::node) return -1;
    return selected_tree(workspace).parent(selected.index);
}

/// A node's first or last child, or a path's root; -1 if there is none.
template <std::size_t which>
int child(const Workspace& workspace) {
    const Selection& selected = workspace.selection;
    if (selected.kind == Selection::Kind::path) return 0;
    if (selected.kind != Selection::Kind::node) return -1;
    return selected_tree(workspace).children(selected.index)[which];
}

/// The node before or after on the same level; -1 if there is none.
template <int direction>
int neighbour(const Workspace& workspace) {
    if (workspace.selection.kind != Selection::Kind::node) return -1;
    return neighbour_on_level(selected_tree(workspace), workspace.selection.index, direction);
}

bool is_node_selected(const Workspace& workspace) { return workspace.selection.kind == Selection::Kind::node; }

/// Where there is no node to go to: the tree ends there.
std::string_view why_no_parent(const Workspace& workspace) {
    return is_node_selected(workspace) ? "this is the root of its tree" : "no node or sample is selected";
}
std::string_view why_no_child(const Workspace& workspace) {
    return is_node_selected(workspace) ? "this is a leaf" : "no node or agent is selected";
}
template <int direction>
std::string_view why_no_neighbour(const Workspace& workspace) {
    if (!is_node_selected(workspace)) return "no node is selected";
    return direction < 0 ? "this is the first node of its level" : "this is the last node of its level";
}

/// A command that goes to the node that `find` finds, if it finds one.
template <int (*find)(const Workspace&)>
bool is_found(const Workspace& workspace) {
    return find(workspace) >= 0;
}
template <int (*find)(const Workspace&)>
void go_to_found(Workspace& workspace) {
    go_to_node(workspace, find(workspace));
}

// --- the rest

template <FocusMove move>
void move_focus(Keys& keys) {
    keys.move = move;
}

/// One thing after the other, what lies in front first.
void put_away(Notifications& notifications, Workspace& workspace) {
    if (notifications.has_up()) return notifications.put_away();
    if (!workspace.measuring.is_nothing()) return void(workspace.measuring = {});
    if (workspace.selection.kind != Selection::Kind::none) return workspace.select({});
    show_in_full(workspace);
}

void go_clip(Workspace& workspace, const std::string& name) {
    workspace.select({Selection::Kind::clip, {}, index_of_name(clip_names(workspace), name, "clip")});
}

bool has_contact(const Workspace& workspace) {
    const RecordedQuery* recorded = workspace.recorded();
    return recorded && recorded->contact;
}

void go_contact(Workspace& workspace) {
    const RecordedQuery& recorded = *workspace.recorded();
    workspace.change_view([&](ViewState& view) {
        view.time = recorded.contact->time;
        view.step = {Step::Unit::end, 0};  // the search ends with the hit
    });
}

}  // namespace

std::vector<Command> go_commands() {
    const std::vector<Command> rows{
        Command("go.palette", "Search...", "Finds commands, agents, clips, queries and nodes by a few letters.",
                [](Dialogs& dialogs) { dialogs.open(Dialog::palette); },
                {.shortcut = "Ctrl+P", .enabled = always, .where = Where::everywhere, .also = "find commands"}),
        Command("go.agent", "Agent", "Selects an agent.", go_agent,
                {.argument = "NAME", .choices = [](const Session& session) { return NamedPaths(session).names; }}),
        Command("go.clip", "Clip", "Selects a clip.", go_clip, {.argument = "NAME", .choices = clip_names}),
        Command("go.node", "Node...",
                "Selects a node, by its index (A 12) or by level and place (A 2.1), and shows its level.", go_node,
                {.argument = "AGENT NODE"}),
        Command("go.sample", "Sample...", "Selects a sample of an agent by its number from 0.", go_sample,
                {.argument = "AGENT INDEX"}),
        Command("go.parent", "Parent node",
                "Selects the node above the selected one, or the leaf that holds the selected sample.",
                go_to_found<parent>,
                {.shortcut = "Ctrl+Up", .repeats = true, .enabled = {is_found<parent>, why_no_parent}}),
        Command("go.child", "First child node",
                "Selects the first node below the selected one, or the root of the selected agent's tree.",
                go_to_found<child<0>>,
                {.shortcut = "Ctrl+Down", .repeats = true, .enabled = {is_found<child<0>>, why_no_child}}),
        Command("go.last_child", "Last child node",
                "Selects the last node below the selected one, or the root of the selected agent's tree.",
                go_to_found<child<1>>,
                {.shortcut = "Ctrl+Shift+Down", .repeats = true, .enabled = {is_found<child<1>>, why_no_child}}),
        Command("go.previous_node", "Previous node", "Selects the node before the selected one on its level.",
                go_to_found<neighbour<-1>>,
                {.shortcut = "Ctrl+Left", .repeats = true, .enabled = {is_found<neighbour<-1>>, why_no_neighbour<-1>}}),
        Command("go.next_node", "Next node", "Selects the node after the selected one on its level.",
                go_to_found<neighbour<1>>,
                {.shortcut = "Ctrl+Right", .repeats = true, .enabled = {is_found<neighbour<1>>, why_no_neighbour<1>}}),
        Command("go.contact", "Contact",
                "Goes to the moment and the step at which the two of the query in view first touch.", go_contact,
                {.enabled = {has_contact, why_no_step}}),
        Command("go.next_panel", "Next panel",
                "Moves the keyboard focus to the next panel; after the last to the viewport.",
                move_focus<FocusMove::next_panel>,
                {.shortcut = "Ctrl+F6", .enabled = always, .where = Where::everywhere}),
        Command("go.previous_panel", "Previous panel", "Moves the keyboard focus to the previous panel.",
                move_focus<FocusMove::previous_panel>,
                {.shortcut = "Ctrl+Shift+F6", .enabled = always, .where = Where::everywhere}),
        Command("go.menu", "Menus", "Opens the menus; arrows and letters go through them.",
                move_focus<FocusMove::menu_bar>,
                {.shortcut = "F10 Alt", .enabled = always, .where = Where::everywhere}),
        Command("go.menu_of_this", "Menu of this",
                "Opens the menu of what has the keyboard focus, or else of what is selected in the picture, as a right "
                "click does.",
                move_focus<FocusMove::menu_of_this>,
                {.shortcut = "Shift+F10 Menu", .enabled = always, .where = Where::everywhere}),
        Command("go.none", "Select nothing",
                "Hides messages; else ends measuring; else clears the selection; else draws all agents in full. The "
                "query in view stays.",
                put_away,
                {.shortcut = "Escape",
                 .enabled =
                     [](const Workspace& workspace, const Notifications& notifications) {
                         return workspace.selection.kind != Selection::Kind::none || notifications.has_up() ||
                                !workspace.measuring.is_nothing() || !workspace.view().foreground.empty();
                     }}),
    };
    return in_menu("Go", rows);
}

}  // namespace mobbscope::app
