/// PNG files.
#pragma once

#include <render/image.h>

#include <filesystem>

namespace mobbscope {

/// Writes to a temporary file beside `file` and renames it, so that a picture is there whole or not at all. Throws
/// MachineError if that cannot be done.
void write_png(const std::filesystem::path& file, const Image& image);

/// Throws InputError if the file is missing or no PNG.
Image read_png(const std::filesystem::path& file);

}  // namespace mobbscope
