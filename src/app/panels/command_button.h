/// The button that every command has, wherever it stands.
#pragma once

#include <app/ui.h>

#include <string>

namespace mobbscope::app {

/// Disabled as the command is; its tooltip says what the command does and by which key. `mark` names it for scripts.
void command_button(Ui& ui, const char* label, const char* command, const std::string& mark);

/// Pixels of a button with this label, in the present font and style.
float button_width(const char* label);

}  // namespace mobbscope::app
