#include <app/document/agents.h>
#include <app/document/described.h>
#include <app/document/shown_agents.h>
#include <app/viewport/selection_display.h>
#include <render/parts/highlights.h>
#include <render/parts/measured_line.h>
#include <scene/arrangement.h>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <utility>

namespace mobbscope::app {

namespace {

using Role = HighlightLine::Role;

constexpr double kNearConflict = 2;  // seconds around a conflict in which its other one is pointed out

bool is_hidden(const SceneView& seen, const PlacedAgent& who) {
    const Scene& scene = seen.fitted->scene();
    if (who.agent < 0 && !scene.agents.empty()) return false;
    return std::ranges::find(seen.view.hidden, name_in_view(scene, who)) != seen.view.hidden.end();
}

/// Whose a selection is; none if it is not in the picture.
std::optional<DrawnAgent> owner_in_view(const SceneView& seen, const Selection& what) {
    const FittedScene& fitted = *seen.fitted;
    if (!what.on_path() || !index_in_view(fitted, seen.view, what.path)) return std::nullopt;
    const auto who = placed_agent_of(fitted, what.path);
    if (!who || is_hidden(seen, *who)) return std::nullopt;
    DrawnAgent drawn = drawn_agent_of(fitted, *who);
    drawn.placed = {fitted.tree(*who), shown_placement(fitted, seen.view, *who)};
    drawn.members = drawn_members(fitted.scene(), *who, drawn.clip().placement());
    return drawn;
}

SceneView active_view(const Session& session) { return {session.workspace.shown(), session.workspace.view()}; }

void add_highlight_of(DrawList& list, const SceneView& seen, const Selection& what, Role role, float scale) {
    if (const auto owner = owner_in_view(seen, what)) add_highlight(list, *owner, what.part(), role, scale);
}

/// The boxes above the selected node, or else above the part that is shown alone.
void add_ancestors_of(DrawList& list, const SceneView& seen, const Selection& selected, float scale) {
    if (!seen.view.ancestors || seen.view.projection) return;
    if (selected.kind == Selection::Kind::node) {
        if (const auto owner = owner_in_view(seen, selected)) add_ancestors(list, *owner, selected.index, scale);
        return;
    }
    if (seen.view.subtree) add_ancestors_of_part(list, drawn_agents(*seen.fitted, seen.view), seen.view, scale);
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
        add_highlight_of(list, active_view(session), {Selection::Kind::node, path, node}, Role::hover, scale);
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
    add_highlight_of(list, active_view(session), other, Role::conflict, scale);
}

void add_pointed_out(DrawList& list, const SceneView& seen, const Selection& selection, const Selection& hovered,
                     float scale) {
    add_highlight_of(list, seen, selection, Role::selection, scale);
    if (hovered != selection) add_highlight_of(list, seen, hovered, Role::hover, scale);
}

}  // namespace

void add_highlights(DrawList& list, const Session& session, float scale) {
    add_ancestors_of(list, active_view(session), session.workspace.selection, scale);
    add_pointed_out(list, active_view(session), session.workspace.selection, session.workspace.hovered, scale);
    add_hovered_event(list, session, scale);
    add_candidate(list, session, scale);
    add_other_of_conflict(list, session, scale);
    if (const auto line = measured_in_view(session.workspace)) add_measured_line(list, *line, scale);
}

void add_highlights_beside(DrawList& list, const Workspace& workspace, const SceneView& seen, float scale) {
    const auto there = [&](const Selection& here) { return counterpart(here, workspace.fitted(), *seen.fitted); };
    add_ancestors_of(list, seen, there(workspace.selection), scale);
    add_pointed_out(list, seen, there(workspace.selection), there(workspace.hovered), scale);
}

}  // namespace mobbscope::app
