/// Films out of the window.
#pragma once

#include <app/commands/picture_order.h>

#include <filesystem>

namespace mobbscope::app {

/// Has another process of this program draw a film (PictureOrder::film) by the command line that does the same; a
/// message tells of its end. Throws MachineError if the machine has no ffmpeg for such films, InputError where nothing
/// may be written.
void start_film(Session& session, const PictureOrder& order, const std::filesystem::path& file);

}  // namespace mobbscope::app
