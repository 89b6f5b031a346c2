/// Whole files, read and written.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace mobbscope {

/// Throws InputError if a file's name is empty or holds a NUL byte, which would end it for the system.
void check_file_name(const std::filesystem::path& file);

/// All bytes of a regular file. Throws InputError if its name is none (check_file_name), or if it is missing,
/// unreadable, no regular file or beyond 2 GiB.
std::string read_file(const std::filesystem::path& file);

/// Writes a file whole or not at all: into a temporary file beside it, which then takes its name. What was there stays
/// until then, so reading from and writing to one name is safe; a file that is write-protected stays. Throws
/// MachineError; InputError for what check_file_name refuses.
void write_file(const std::filesystem::path& file, std::string_view bytes);

/// The path from the root, without a slash at its end, "." and ".."; "" is the present folder.
std::filesystem::path whole_path(const std::filesystem::path& path);

/// What a file or folder is called in its folder, also one that is written "." or with a slash at its end.
std::string own_name(const std::filesystem::path& path);

/// The extension in lower case, with its dot (".csv"); "" if there is none.
std::string lower_extension(const std::filesystem::path& file);

}  // namespace mobbscope
