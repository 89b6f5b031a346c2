/// Pictures in the desktop's clipboard, by a program that keeps them there: GLFW copies texts alone.
#pragma once

#include <string_view>

namespace mobbscope::app {

/// What is missing, and what to do; empty: pictures can be copied. One of the programs that are there now is enough.
std::string_view why_no_picture_clipboard();

/// Gives the bytes of a PNG file to the clipboard. Throws MachineError if the program is not there or does not take
/// them within some seconds.
void copy_picture_to_clipboard(std::string_view png);

}  // namespace mobbscope::app
