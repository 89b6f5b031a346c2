/// Whether outputs have somewhere to go: better said before long work than after it.
#pragma once

#include <filesystem>

namespace mobbscope::cli {

/// The file that a name means, through links; the name itself where that cannot be told.
std::filesystem::path meant(const std::filesystem::path& file);

/// Throws MachineError, saying why, if a file cannot be written there; a pipe or a device may be. Writes
/// nothing.
void check_writable(const std::filesystem::path& output);

}  // namespace mobbscope::cli
