/// The field of a dialog: it has the keyboard from the start.
#pragma once

#include <app/ui.h>

#include <functional>
#include <string>

namespace mobbscope::app {

/// Shows and edits the text of the session's `input`. `complete`: what Tab makes of the text; without it Tab goes to
/// the next widget.
struct FieldEvents {
    bool changed = false;
    bool entered = false;  ///< Enter was pressed
};
FieldEvents text_field(Ui& ui, const char* hint, const std::function<std::string(const std::string&)>& complete = {});

}  // namespace mobbscope::app
