#include <base/error.h>
#include <base/file.h>
#include <base/text.h>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <system_error>
#include <vector>

namespace mobbscope {

namespace {

constexpr std::uintmax_t kLargestFile = std::uintmax_t{1} << 31;

struct CloseFile {
    void operator()(std::FILE* file) const { std::fclose(file); }
};
using OpenFile = std::unique_ptr<std::FILE, CloseFile>;

std::string system_message(int error) { return std::generic_category().message(error); }

/// Where a link points, so that writing through it leaves the link in place.
std::filesystem::path resolved(const std::filesystem::path& file) {
    std::error_code error;
    const std::filesystem::path target = std::filesystem::weakly_canonical(file, error);
    return error ? file : target;
}

/// A new file with the rights that the process gives to new files.
struct TemporaryFile {
    std::string name;
    int descriptor;  ///< -1: errno says why there is none
};

TemporaryFile make_temporary(const std::filesystem::path& folder) {
    static std::atomic<unsigned> made{0};
    for (;;) {
        const std::string number = std::to_string(::getpid()) + '-' + std::to_string(made++);
        TemporaryFile file{(folder / (".mobbscope-" + number)).string(), -1};
        file.descriptor = ::open(file.name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
        // A file of that name was left by a process that was killed.
        if (file.descriptor >= 0 || errno != EEXIST) return file;
    }
}

}  // namespace

void check_file_name(const std::filesystem::path& file) {
    if (file.empty()) throw InputError("the name of a file is empty; give one");
    if (file.native().find('\0') != std::string::npos)
        throw InputError(in_quotes(file.native()), "", "the name of a file holds a NUL byte; remove it");
}

std::string read_file(const std::filesystem::path& file) {
    check_file_name(file);
    const std::string name = file.string();
    std::error_code error;
    const std::filesystem::file_status status = std::filesystem::status(file, error);
    if (status.type() == std::filesystem::file_type::not_found) {
        throw InputError(name, "", "no such file; check the path");
    }
    if (error) throw InputError(name, "", "cannot be read: " + error.message());
    if (status.type() == std::filesystem::file_type::directory) {
        throw InputError(name, "", "is a directory; give a file in it");
    }
    // Devices and pipes may never end.
    if (status.type() != std::filesystem::file_type::regular) {
        throw InputError(name, "", "is no regular file; save the data to a file first");
    }
    const OpenFile in(std::fopen(file.c_str(), "rb"));
    if (!in) throw InputError(name, "", "cannot be read: " + system_message(errno));

    std::string bytes;
    const auto check_size = [&name](std::uintmax_t size) {
        if (size > kLargestFile) throw InputError(name, "", "is larger than 2 GiB; split it");
    };
    const std::uintmax_t size = std::filesystem::file_size(file, error);
    if (!error) {
        check_size(size);
        // In one piece: as it grew, memory would be asked for again and again.
        bytes.reserve(static_cast<std::size_t>(size));
    }
    std::vector<char> buffer(1 << 16);
    std::size_t count = 0;
    while ((count = std::fread(buffer.data(), 1, buffer.size(), in.get())) > 0) {
        bytes.append(buffer.data(), count);
        check_size(bytes.size());  // it may have grown meanwhile
    }
    if (std::ferror(in.get())) throw InputError(name, "", "cannot be read: " + system_message(errno));
    return bytes;
}

void write_file(const std::filesystem::path& file, std::string_view bytes) {
    check_file_name(file);
    const auto failure = [&](int error) {
        return MachineError(file.string() + ": cannot be written: " + system_message(error));
    };
    const std::filesystem::path target = resolved(file);
    // Renaming over a device or a pipe would replace it.
    std::error_code ignored;
    const std::filesystem::file_status status = std::filesystem::status(target, ignored);
    if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status)) {
        throw MachineError(file.string() + ": cannot be written: is no regular file");
    }
    struct stat replaced {};
    const bool replaces = ::stat(target.c_str(), &replaced) == 0;
    // Renaming asks for rights over the folder alone, so a protected file would be replaced too.
    if (replaces && ::faccessat(AT_FDCWD, target.c_str(), W_OK, AT_EACCESS) != 0) throw failure(errno);

    const auto [temporary, descriptor] = make_temporary(target.parent_path());
    if (descriptor < 0) throw failure(errno);
    int error = 0;
    for (std::size_t done = 0; done < bytes.size() && error == 0;) {
        const ssize_t count = ::write(descriptor, bytes.data() + done, bytes.size() - done);
        if (count >= 0) {
            done += static_cast<std::size_t>(count);
        } else if (errno != EINTR) {
            error = errno;
        }
    }
    if (error == 0 && replaces && ::fchmod(descriptor, replaced.st_mode & 07777) != 0) error = errno;
    if (::close(descriptor) != 0 && error == 0) error = errno;
    if (error == 0 && std::rename(temporary.c_str(), target.c_str()) != 0) error = errno;
    if (error != 0) {
        ::unlink(temporary.c_str());
        throw failure(error);
    }
}

std::filesystem::path whole_path(const std::filesystem::path& path) {
    std::error_code ignored;
    const std::filesystem::path whole =
        std::filesystem::absolute(path.empty() ? "." : path, ignored).lexically_normal();
    return whole.has_filename() || !whole.has_relative_path() ? whole : whole.parent_path();
}

std::string own_name(const std::filesystem::path& path) {
    const std::filesystem::path whole = whole_path(path);
    return (whole.has_filename() ? whole.filename() : whole).string();
}

std::string lower_extension(const std::filesystem::path& file) { return lower(file.extension().string()); }

}  // namespace mobbscope
