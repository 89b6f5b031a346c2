/// What is selected, under the mouse and the like, highlighted in the picture.
#pragma once

#include <app/session/session.h>
#include <render/drawlist/draw_list.h>

namespace mobbscope::app {

/// Adds to the list of the session's view what is selected and what is under the mouse, the candidate that is looked
/// at, the agent that the followed one is about to meet in the conflict that was gone to, and the line that is
/// measured. `scale`: of line widths.
void add_highlights(DrawList& list, const Session& session, float scale);

/// The same of another view: what goes there with what is selected and under the mouse.
void add_highlights_beside(DrawList& list, const Workspace& workspace, const SceneView& seen, float scale);

}  // namespace mobbscope::app
