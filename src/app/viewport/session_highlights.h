/// What the window points out in its picture.
#pragma once

#include <app/document/session.h>
#include <render/drawlist/draw_list.h>

namespace mobbscope::app {

/// Adds the session's to the list of its view: what is selected and what is under the mouse, the candidate that is
/// looked at, and whom the followed agent is about to meet in the conflict that was gone to. `scale`: of line widths.
void add_highlights(DrawList& list, const Session& session, float scale);

}  // namespace mobbscope::app
