#include <base/error.h>
#include <base/file.h>
#include <base/text.h>
#include <cli/program.h>
#include <render/image/picture_names.h>

#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include <iostream>
#include <system_error>

namespace mobbscope::cli {

namespace {

constexpr std::size_t kLongestMessage = 1000;  // names of files may be longer

}  // namespace

void complain(std::string_view message) {
    std::cerr << "mobbscope: " + shortened(cleaned(message), kLongestMessage) + '\n' << std::flush;
}

void say(std::string_view message) { complain(message); }

void warn(std::string_view message) { complain("warning: " + std::string(message)); }

void flush_results() {
    std::cout.flush();
    if (std::cout) return;
    // The write that failed may be long ago: errno is that of another call.
    pollfd output{STDOUT_FILENO, POLLOUT, 0};
    if (::poll(&output, 1, 0) == 1 && (output.revents & POLLERR) != 0)
        throw ReaderGone("nobody reads from standard output any more");
    throw MachineError("standard output cannot be written; is the disk full?");
}

namespace fs = std::filesystem;

void check_extension(const fs::path& file, std::string_view extension, const std::string& message) {
    if (!file.empty() && lower_extension(file) != extension) throw InputError(file, message);
}

void check_picture_output(const fs::path& file) {
    if (!file.empty() && !is_picture_name(file)) throw InputError(file, std::string(kPictureNames));
}

void check_output(const fs::path& output) {
    check_not_read(output);
    const auto refuse = [&](const std::string& why) {
        throw MachineError(output.string() + ": cannot be written: " + why);
    };
    std::error_code error;
    if (fs::is_directory(output, error)) refuse("is a folder");
    const fs::path target = meant(output);
    if (target.is_relative()) refuse("the present folder is gone; change to another, or give the whole name");
    const fs::path folder = target.parent_path();
    if (!fs::is_directory(folder, error)) refuse("there is no folder " + in_quotes(folder.string()));
    const bool there = fs::exists(target, error);
    if (there && ::faccessat(AT_FDCWD, target.c_str(), W_OK, AT_EACCESS) != 0) refuse("it is write-protected");
    // What is no regular file is written in place.
    if (there && !fs::is_regular_file(target, error)) return;
    if (is_standard_output(target))
        throw InputError(output, "is the file that standard output goes to, with the results; give another one");
    if (::faccessat(AT_FDCWD, folder.c_str(), W_OK | X_OK, AT_EACCESS) != 0) {
        refuse("its folder " + in_quotes(folder.string()) + " is write-protected");
    }
}

}  // namespace mobbscope::cli
