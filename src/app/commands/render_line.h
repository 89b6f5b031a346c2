/// The picture in the window as a command line.
#pragma once

#include <app/document/session.h>

#include <string>

namespace mobbscope::app {

/// "mobbscope render ..." that draws the present picture in the viewport's size, quoted for a shell. Throws
/// std::invalid_argument, saying that the scene must be saved first, if its files and the command's options do not tell
/// the whole picture.
std::string render_line(const Session& session);

}  // namespace mobbscope::app
