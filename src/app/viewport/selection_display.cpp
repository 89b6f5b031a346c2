#include <app/document/agents.h>
#include <app/document/described.h>
#include <app/document/shown_agents.h>
#include <app/viewport/selection_display.h>
#include <render/parts/highlights.h>
#include <scene/arrangement.h>

#include <utility>

namespace mobbscope::app {

namespace {

using Role = HighlightLine::Role;

constexpr double kNearConflict = 2;  // seconds around a conflict in which its other one is pointed out

bool is_hidden(const Workspace& workspace, const PlacedAgent& who) {
    if (who.agent < 0 && !workspace.scene().agents.empty()) return false;
    return are_hidden(workspace, {name_in_view(workspace.fitted().scene(), who)});
}

void add_highlight_of(DrawList& list, const Session& session, const Selection& what, Role role, float scale) {
    if (!what.on_path() || !index_in_view(session.workspace.fitted(), session.workspace.view(), what.path)) return;
    const FittedScene& fitted = session.workspace.fitted();
    const auto who = placed_agent_of(fitted, what.path);
    if (!who || is_hidden(session.workspace, *who)) return;
    DrawnAgent drawn = drawn_agent_of(fitted, *who);
    drawn.placed = {fitted.tree(who->clip), shown_placement(fitted, session.workspace.view(), *who)};
    add_highlight(list, drawn, what.part(), role, scale);
}

/// The two nodes of the event that is under the mouse in another panel.
void add_hovered_event(DrawList& list, const Session& session, float scale) {
    const Workspace& workspace = session.workspace;
    const RecordedQuery* query = workspace.recorded();
    const int event = workspace.hovered_event;
    if (!query || event < 0 || event >= query->trace.size() || workspace.hovered.on_path()) return;
    const mobb::Trace::Event test = query->trace[event];
    for (const auto& [side, node] : {std::pair(0, test.a), std::pair(1, test.b)}) {
        const AgentRef path = agent_in_view(workspace.fitted(), workspace.view(), side);
        add_highlight_of(list, session, {Selection::Kind::node, path, node}, Role::hover, scale);
    }
}

void add_candidate(DrawList& list, const Session& session, float scale) {
    const FollowedChoice* followed = session.crowds.choice();
    if (!followed || !session.workspace.view().candidates || session.crowds.candidate() < 0) return;
    const Candidate& candidate = followed->choice.candidates[static_cast<std::size_t>(session.crowds.candidate())];
    add_way_highlight(list, mobb::PlacedClip(*candidate.clip, candidate.placement), Role::candidate, scale);
}

void add_other_of_conflict(DrawList& list, const Session& session, float scale) {
    const std::vector<SceneConflict>* found = session.crowds.conflicts();
    if (!found || session.workspace.conflict < 0 || session.workspace.view().follow.empty() ||
        !session.workspace.view().time)
        return;
    const SceneConflict& conflict = (*found)[static_cast<std::size_t>(session.workspace.conflict)];
    const ConflictPlace place = conflict_place(session.workspace, conflict);
    const double time = *session.workspace.view().time;
    if (time < place.time - kNearConflict || time > conflict.begin() + kNearConflict) return;
    if (place.followed.name != session.workspace.view().follow) return;
    const Selection other{Selection::Kind::path, {place.other.agent, -1, 0}, -1};
    add_highlight_of(list, session, other, Role::conflict, scale);
}

}  // namespace

void add_highlights(DrawList& list, const Session& session, float scale) {
    add_highlight_of(list, session, session.workspace.selection, Role::selection, scale);
    if (session.workspace.hovered != session.workspace.selection) {
        add_highlight_of(list, session, session.workspace.hovered, Role::hover, scale);
    }
    add_hovered_event(list, session, scale);
    add_candidate(list, session, scale);
    add_other_of_conflict(list, session, scale);
}

}  // namespace mobbscope::app
