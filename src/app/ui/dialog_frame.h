/// What all dialogs have in common: the window behind them steps back and takes no input.
#pragma once

#include <app/input/key.h>
#include <app/ui/ui.h>

#include <functional>
#include <string>

namespace mobbscope::app {

/// Between begin and end, content goes into a panel in the middle of the window, at most as large as asked for (pixels
/// at scale 1) and as the window has room for.
void begin_dialog(Ui& ui, const char* name, ImVec2 size, float top_share = 0.5f);
void end_dialog();

/// A line at the head of a dialog.
void dialog_title(Ui& ui, const char* text);

/// A button with a mark for scripts.
bool marked_button(Ui& ui, const char* label, const char* mark, bool is_default = false);

/// Closes the dialog, as Enter does.
void close_button(Ui& ui, const char* mark);

/// Whether a key went down in this frame.
bool pressed(ImGuiKey key, bool repeat = false);
/// A key that Dear ImGui has no name for.
bool pressed(Key key);

/// Moves `picked` through a list of `count` with Up, Down, PageUp and PageDown; true if it moved.
bool move_picked(int& picked, int count);

/// What a field holds. When it gets the keys, all of a file's name but its folder and extension is selected, so that
/// what is typed replaces it; of a search nothing is, and typing goes on with it.
enum class FieldText { search, file_name };
struct FieldEvents {
    bool changed = false;
    bool entered = false;  ///< Enter was pressed
};
/// Shows and edits the text of the session's `input`. `complete`: what Tab makes of the text; without it Tab goes to
/// the next widget.
FieldEvents text_field(Ui& ui, const char* hint, const std::function<std::string(const std::string&)>& complete = {},
                       FieldText what = FieldText::search);

}  // namespace mobbscope::app
