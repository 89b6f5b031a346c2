/// Many pictures at once: a list of what `render` takes, one picture or sequence a line.
///
///     # the arguments as one would type them; words with blanks stand in double quotes
///     crossing.json --view top -o top.png
///     crossing.json --query 0 --play --background "#14181D" -o query.png
#pragma once

#include <cli/render/render_job.h>

#include <filesystem>

namespace mobbscope::cli {

/// Draws all of a list; "-" is standard input. Names are relative to the working directory. `defaults` hold for every
/// line that does not say otherwise. Nothing is written unless every line can be drawn. Throws InputError and
/// MachineError naming the line.
void render_batch(const std::filesystem::path& list, const RenderArguments& defaults);

}  // namespace mobbscope::cli
