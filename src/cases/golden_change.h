/// Goldens are written in one place, whoever takes them.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace mobbscope::picture_tests {

/// The bytes of a golden, and those that they take the place of; none: there is no such file.
struct GoldenChange {
    std::filesystem::path file;
    std::optional<std::string> bytes;
    std::optional<std::string> replaces{};
};

/// What a file holds now; nothing if there is none. Throws InputError if it cannot be read.
std::optional<std::string> golden_bytes(const std::filesystem::path& file);

/// Makes the folder that a file goes to, if need be. Throws MachineError.
void make_folder_of(const std::filesystem::path& file);

/// What takes the changes back.
std::vector<GoldenChange> taken_back(std::span<const GoldenChange> changes);

/// Makes all these changes or none of them, each file whole. Throws InputError if a file is no longer what its change
/// takes the place of, or is a link that leads out of its folder, MachineError if one cannot be written; it names those
/// that could not be put back then.
void write_goldens(std::span<const GoldenChange> changes);

}  // namespace mobbscope::picture_tests
