/// The files that a command writes: named before anything is read, checked before the first is written.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace mobbscope::cli {

/// Throws InputError unless this is the name of a PNG file.
void check_picture_name(const std::filesystem::path& output);

class WrittenFiles {
  public:
    /// A file that is read, and must not be replaced.
    void reads(const std::filesystem::path& file) { sources_.push_back(file); }

    /// Throws InputError if the file is one that is read, or is written already; MachineError if it has nowhere to go.
    void writes(const std::filesystem::path& output);

  private:
    std::vector<std::filesystem::path> sources_;
    std::vector<std::filesystem::path> outputs_;
};

}  // namespace mobbscope::cli
