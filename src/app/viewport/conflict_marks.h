/// Where in the picture those meet who collide.
#pragma once

#include <app/ui/ui.h>
#include <app/viewport/agent_handles.h>

#include <vector>

namespace mobbscope::app {

struct ConflictMark {
    int conflict = 0;  ///< index in CrowdInspector::conflicts()
    ImVec2 at;
};

/// Of the conflicts that were found those that the picture shows, the deepest some hundred; with agents in the
/// foreground that which was gone to.
std::vector<ConflictMark> conflict_marks(const Ui& ui, const ShownPicture& picture);

/// That at the mouse; null: none.
const ConflictMark* mark_at(const Ui& ui, const std::vector<ConflictMark>& marks, ImVec2 mouse);

/// `lit`: the conflict under the mouse; -1: none.
void draw_conflict_marks(const Ui& ui, const std::vector<ConflictMark>& marks, int lit);

}  // namespace mobbscope::app
