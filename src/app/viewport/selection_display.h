/// What is selected, under the mouse and the like: in words and numbers, and highlighted in the picture.
#pragma once

#include <app/document/session.h>
#include <render/drawlist/draw_list.h>

#include <string>
#include <utility>
#include <vector>

namespace mobbscope::app {

/// What a selection is, a line each: first its name.
struct Described {
    std::string name;
    std::vector<std::pair<std::string, std::string>> facts;  ///< "time", "1.20..1.53 s"
};
Described describe(const FittedScene& fitted, const Selection& what);

/// Adds to the list of the session's view what is selected and what is under the mouse, the candidate that is looked
/// at, and the agent that the followed one is about to meet in the conflict that was gone to. `scale`: of line widths.
void add_highlights(DrawList& list, const Session& session, float scale);

}  // namespace mobbscope::app
