#include <app/document/agents.h>
#include <app/document/debug_texts.h>
#include <app/ui/thing_menus.h>
#include <base/text.h>
#include <explain/query_findings.h>
#include <explain/query_sentence.h>
#include <scene/view_options.h>

#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>

namespace mobbscope::app {

namespace {

using Ids = std::span<const std::string_view>;

/// Stands for the toggles that are in the toolbar, too.
constexpr std::string_view kTogglesAtHand = "toggles";
constexpr auto kPicture = std::to_array<std::string_view>({"view.frame",
                                                           "view.frame_all",
                                                           "",
                                                           "view.iso",
                                                           "view.top",
                                                           "view.front",
                                                           "view.side",
                                                           "",
                                                           "view.moment",
                                                           "view.plan",
                                                           "view.measure",
                                                           "view.perspective",
                                                           kTogglesAtHand,
                                                           "view.past",
                                                           "view.theme",
                                                           "",
                                                           "agent.show_all",
                                                           "view.arrange",
                                                           "",
                                                           "file.export_picture",
                                                           "file.export_film",
                                                           "file.copy_command"});
constexpr auto kNode = std::to_array<std::string_view>({"view.frame", "go.parent", "go.child", "node.isolate",
                                                        "view.ancestors", "step.next_of_node", "edit.copy_figures"});
constexpr auto kSample = std::to_array<std::string_view>(
    {"view.frame", "reasons.of_selection", "go.parent", "view.projection", "edit.copy_figures"});
constexpr auto kPath = std::to_array<std::string_view>({"view.frame", "go.child", "edit.copy_figures"});
constexpr auto kAgent = std::to_array<std::string_view>(
    {"query.add", "agent.rename", "agent.duplicate", "agent.remove"});  ///< not of a run
constexpr auto kInCrowd = std::to_array<std::string_view>({"crowd.follow", "crowd.open_pair"});
constexpr auto kQuery = std::to_array<std::string_view>({"query.expect", "query.remove"});
constexpr auto kTime = std::to_array<std::string_view>({"time.play", "time.start", "time.end", "time.clear"});

std::vector<MenuEntry> entries_of(Ids ids) {
    std::vector<MenuEntry> out;
    for (const std::string_view id : ids) out.push_back({id});
    return out;
}

/// A group of its own.
void append(std::vector<MenuEntry>& menu, const std::vector<MenuEntry>& more) {
    if (more.empty()) return;
    if (!menu.empty()) menu.push_back({""});
    menu.insert(menu.end(), more.begin(), more.end());
}

/// What can be done with the agent that the selection is of.
void append_agent(std::vector<MenuEntry>& menu, const Session& session) {
    const auto who = placed_agent_of(session.workspace.fitted(), session.workspace.selection.path);
    if (who && session.workspace.selection.kind != Selection::Kind::path) {
        append(menu, {{"go.agent", who->name, "Select all of " + shortened(cleaned(who->name), 30)}});
    }
    if (who) {
        const std::string& name = name_in_view(session.workspace.fitted().scene(), *who);
        append(menu, shown_menu(session.workspace, {text_of_agent(name), {name}}));
    }
    if (is_crowd(session.workspace)) append(menu, entries_of(kInCrowd));
    if (shows_bare_clips(session.workspace)) {
        append(menu, {{"agent.make"}});
    } else if (!session.workspace.crowd()) {
        append(menu, entries_of(kAgent));
    }
}

std::vector<MenuEntry> node_menu(const Session& session) {
    std::vector<MenuEntry> menu = entries_of(kNode);
    const auto who = placed_agent_of(session.workspace.fitted(), session.workspace.selection.path);
    if (who) {
        const std::string level =
            std::to_string(session.workspace.fitted().tree(*who).level(session.workspace.selection.index));
        menu.push_back({"view.level", level, "Show level " + level + " alone"});
    }
    const std::optional<int> side =
        session.workspace.view().query
            ? index_in_view(session.workspace.fitted(), session.workspace.view(), session.workspace.selection.path)
            : std::nullopt;
    if (who && side) {
        const mobb::Tree& tree = session.workspace.fitted().tree(*who);
        menu.push_back(
            {"breakpoint.add", node_filter(tree, *side, session.workspace.selection.index), "Break when it is tested"});
    }
    append_agent(menu, session);
    return menu;
}

std::vector<MenuEntry> sample_menu(const Session& session) {
    std::vector<MenuEntry> menu = entries_of(kSample);
    if (const auto who = placed_agent_of(session.workspace.fitted(), session.workspace.selection.path)) {
        const double time =
            session.workspace.fitted().placed(*who).placed_clip().time(session.workspace.selection.index);
        menu.push_back({"time.at", format_double(time), formatted("Time cursor to %.3f s", time)});
    }
    append_agent(menu, session);
    return menu;
}

std::vector<MenuEntry> query_menu(const Workspace& workspace) {
    const std::string query = std::to_string(workspace.selection.index);
    std::vector<MenuEntry> menu{{"query.select", query, "Show this query"},
                                {"query.copy_answer", query},
                                {"query.copy_command", query, "Copy as command"},
                                {"query.capture", query}};
    append(menu, entries_of(kQuery));
    return menu;
}

std::vector<MenuEntry> clip_menu(const Workspace& workspace) {
    std::vector<MenuEntry> menu;
    const std::string& name = workspace.scene().clips[static_cast<std::size_t>(workspace.selection.index)].name;
    if (shows_bare_clips(workspace)) {
        menu.push_back({"agent.make"});
    } else if (!workspace.crowd()) {
        menu.push_back({"agent.add", name, "Add an agent that plays it"});
    }
    menu.push_back({"clip.import", name, "How it is read..."});
    menu.push_back({"edit.copy_figures"});
    const AgentNames who = agents_of_clip(workspace, workspace.selection.index);
    if (!who.empty()) append(menu, shown_menu(workspace, {kOfClip + name, who}));
    return menu;
}

}  // namespace

std::vector<MenuEntry> shown_menu(const Workspace& workspace, const ListedAgents& listed) {
    // The keys are about what is selected.
    const bool has_keys = listed.who == selected_agents(workspace);
    const auto like = [&](std::string_view id) { return has_keys ? id : std::string_view(); };
    return {{"agents.hide", listed.text, are_hidden(workspace, listed.who) ? "Show" : "Hide", like("agent.hide")},
            {"agents.solo", listed.text,
             are_isolated(workspace, listed.who) ? "Show what was shown before" : "Show alone", like("agent.solo")},
            {"agents.foreground", listed.text,
             are_in_foreground(workspace, listed.who) ? "No longer in the foreground" : "In the foreground",
             like("agent.foreground")},
            {"agents.pin", listed.text, are_pinned(workspace, listed.who) ? "Unpin" : "Pin", like("agent.pin")},
            {"agent.show_all"}};
}

std::vector<MenuEntry> picture_menu(const Session&) {
    std::vector<MenuEntry> menu;
    for (const std::string_view id : kPicture) {
        if (id != kTogglesAtHand) {
            menu.push_back({id});
            continue;
        }
        for (const ViewOption& option : view_options())
            if (option.at_hand) menu.push_back({option.command});
    }
    return menu;
}

std::vector<MenuEntry> selection_menu(const Session& session) {
    switch (session.workspace.selection.kind) {
        case Selection::Kind::none:
            return {};
        case Selection::Kind::path: {
            std::vector<MenuEntry> menu = entries_of(kPath);
            append_agent(menu, session);
            return menu;
        }
        case Selection::Kind::node:
            return node_menu(session);
        case Selection::Kind::sample:
            return sample_menu(session);
        case Selection::Kind::clip:
            return clip_menu(session.workspace);
        case Selection::Kind::query:
            return query_menu(session.workspace);
    }
    return {};
}

std::vector<MenuEntry> test_menu(const Workspace& workspace, const QueryInspector& queries, int event) {
    const mobb::Trace::Event& test = workspace.recorded()->trace[event];
    std::vector<MenuEntry> menu{{"step.to", std::to_string(event), "Go to this test, " + std::to_string(event)}};
    const std::vector<DrawnAgent>& sides = queries.findings()->sides;
    for (const auto& [side, node] : {std::pair(&sides[0], test.a), std::pair(&sides[1], test.b)}) {
        menu.push_back({"go.node", side->name + ' ' + std::to_string(node), "Select " + node_name(*side, node)});
    }
    append(menu, {{"focus.branch", std::to_string(event)}, {"focus.none"}});
    const auto break_when = [&](const std::string& where, const std::string& what) {
        menu.push_back({"breakpoint.add", where, "Break when " + what});
    };
    menu.push_back({""});
    break_when(pair_filter(queries, event), "these two are tested");
    for (const auto& [side, node] : {std::pair(0, test.a), std::pair(1, test.b)}) {
        const DrawnAgent& of = sides[static_cast<std::size_t>(side)];
        break_when(node_filter(of.placed.tree(), side, node), node_name(of, node) + " is tested");
    }
    const std::string outcome = "outcome = " + std::string(mobb::name(test.outcome));
    break_when(outcome, EventFilter(outcome).words());
    append(menu, {{"step.first"}, {"step.last"}, {"go.contact", "", "Go to contact"}, {"file.copy_command"}});
    return menu;
}

std::vector<MenuEntry> time_menu(const Session& session, double time) {
    std::vector<MenuEntry> menu{{"time.at", format_double(time), formatted("Time cursor to %.3f s", time)}};
    if (session.workspace.view().query) {
        menu.push_back({"reasons.at", format_double(time), formatted("Reasons at %.3f s", time)});
    }
    append(menu, entries_of(kTime));
    return menu;
}

std::vector<MenuEntry> candidate_menu(const CrowdInspector& crowds, const Workspace& workspace, int candidate) {
    const std::string index = std::to_string(candidate);
    std::vector<MenuEntry> menu{{"crowd.candidate", index, "Point it out"}};
    const FollowedChoice* followed = crowds.choice();
    if (!followed) return menu;
    const auto& blocker = followed->choice.candidates[static_cast<std::size_t>(candidate)].blocker;
    if (!blocker) return menu;
    const std::string& other = workspace.crowd()->agents[static_cast<std::size_t>(blocker->agent)].name;
    menu.push_back({"crowd.open_candidate", index});
    menu.push_back({"crowd.follow", other, "Follow " + other + ", who rules it out"});
    return menu;
}

std::vector<MenuEntry> play_menu(int play) {
    return {{"crowd.play", std::to_string(play), "Go to this play"}, {"crowd.previous_choice"}, {"crowd.next_choice"}};
}

std::vector<MenuEntry> conflict_menu(int conflict) {
    const std::string index = std::to_string(conflict);
    return {{"conflicts.go", index, "Show the two alone"}, {"conflicts.open", index}};
}

}  // namespace mobbscope::app
