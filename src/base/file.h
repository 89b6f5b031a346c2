/// Whole files, read and written.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace mobbscope {

/// Throws InputError if a file's name is empty or holds a NUL byte, which would end it for the system.
void check_file_name(const std::filesystem::path& file);

/// All bytes of a regular file. Throws InputError if its name is none (check_file_name), or if it is missing,
/// unreadable, no regular file or beyond 2 GiB.
std::string read_file(const std::filesystem::path& file);

/// What read_file is made of, each of which throws likewise: a file that is open, and how large it is; all of it.
using FileHandle = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;
std::pair<FileHandle, std::uintmax_t> open_to_read(const std::filesystem::path& file);
std::string read_all(std::FILE* in, std::uintmax_t size, const std::string& name);
inline constexpr std::uintmax_t kLargestFile = std::uintmax_t{1} << 31;
void check_file_size(std::uintmax_t size, const std::string& name);
[[noreturn]] void fail_to_read(const std::string& name);  ///< as errno says

/// Whether a name stands for standard input: "-", where a command takes a scene or a clip.
bool is_standard_input(const std::filesystem::path& file);

/// Whether standard output goes to a file, of any name: results would replace it.
bool is_standard_output(const std::filesystem::path& file);

/// Remembers that a file is read. read_file and read_input do by themselves; this is for one that will be.
/// Throws InputError if standard output goes to it.
void note_read(const std::filesystem::path& file);

/// Those that were read since this was asked last, from the root.
std::vector<std::filesystem::path> take_files_read();

/// Throws InputError if a file is one that was read, by whatever name or link, or from standard input: it must not be
/// replaced by what is made from it.
void check_not_read(const std::filesystem::path& file);

/// The file that a name means, through links and folders that are not there ("none/.."); where the last link leads to
/// nothing, the file that it would be.
std::filesystem::path meant(const std::filesystem::path& file);

/// Whether two names mean one file or folder: what they mean has one place, or one number (hard links).
bool is_same_file(const std::filesystem::path& a, const std::filesystem::path& b);

/// Throws InputError if a name means a file of another folder, through links: for names that the user does not choose.
void check_stays_in_folder(const std::filesystem::path& file);

/// A file, and what is to be in it. The bytes must live until they are written.
struct FileBytes {
    std::filesystem::path file;
    std::string_view bytes;
    bool to_disk = false;  ///< what is written is on the disk then, also where it replaces nothing
};

/// Writes files, each whole, and all of them or none. What was there stays until all is on the disk, so a loss of power
/// leaves the old or the new, and reading from and writing to one name is safe; owner and rights stay too, but for
/// those to run as the owner. A file that is write-protected stays. A pipe or a device gets the bytes. Throws
/// MachineError; InputError for what check_file_name refuses. Unfinished files have no names where the file system can
/// do that; else they are called .mobbscope-PID-N, and those that a killed process left in the folder are removed.
void write_files(std::span<const FileBytes> files);
void write_file(const std::filesystem::path& file, std::string_view bytes);
/// Of work: it is on the disk then, whatever becomes of the machine.
void write_to_disk(const std::filesystem::path& file, std::string_view bytes);

/// A file that another program writes. `take_place` puts it under its name, as if write_file had written it; without
/// that nothing is left of it. `file` may not be a pipe or a device.
class NewFile {
  public:
    /// Throws as write_file does.
    explicit NewFile(const std::filesystem::path& file);
    ~NewFile();
    NewFile(const NewFile&) = delete;
    NewFile& operator=(const NewFile&) = delete;

    /// Open for writing.
    int descriptor() const;
    /// Once. Returns how many bytes it has. Throws MachineError.
    std::size_t take_place();

  private:
    std::unique_ptr<class UnfinishedFile> file_;
};

/// Removes the unfinished files of this process: for the handler of a signal that ends it.
void remove_unfinished_files() noexcept;

/// The path from the root, without a slash at its end, "." and ".."; "" is the present folder. The path as it is given,
/// made normal, where the present folder is gone.
std::filesystem::path whole_path(const std::filesystem::path& path);

/// What a file or folder is called in its folder, also one that is written "." or with a slash at its end.
std::string own_name(const std::filesystem::path& path);

/// The extension in lower case, with its dot (".csv"); "" if there is none.
std::string lower_extension(const std::filesystem::path& file);

/// The same of what a packed file holds: ".csv" of "walk.csv.gz" too.
std::string unpacked_extension(const std::filesystem::path& file);

/// What the file's clip is called: "walk" of "walk.csv" and of "walk.csv.gz".
std::string input_stem(const std::filesystem::path& file);

/// A file's name for messages: "standard input" of "-".
std::string shown_name(const std::filesystem::path& file);

}  // namespace mobbscope
