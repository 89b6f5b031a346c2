/// Lists of things, a row each.
#pragma once

#include <app/ui.h>

#include <functional>
#include <string>

namespace mobbscope::app {

/// A text on one line that fits `room` pixels in the present font: its end becomes an ellipsis.
std::string fitted_text(const std::string& text, float room);

/// A list with a row of equal height for each item: as high as its rows, at most `most_rows` before it scrolls.
void rows(Ui& ui, const char* name, int count, int most_rows, const std::function<void(int)>& draw);

/// A list's row across the panel: a name, and a short remark at its right end. Returns true when it is clicked.
struct Row {
    std::string id;  ///< unique in the list
    std::string name;
    std::string remark;
    bool selected = false;
    bool hovered = false;    ///< lit, as it is under the mouse elsewhere
    float indent = 0;        ///< pixels left of the name
    ImU32 remark_color = 0;  ///< 0: quiet
};
bool row(Ui& ui, const Row& row);

}  // namespace mobbscope::app
