#include <cli/written_files.h>
#include <import/error.h>
#include <import/file.h>
#include <import/text.h>

#include <fcntl.h>
#include <unistd.h>

#include <system_error>

namespace mobbscope::cli {

namespace {

namespace fs = std::filesystem;

/// The file that a name means, through links; the name itself where that cannot be told.
fs::path meant(const fs::path& file) {
    // A bare name has no folder of its own until it is made absolute.
    const fs::path absolute = fs::absolute(file);
    std::error_code error;
    const fs::path target = fs::weakly_canonical(absolute, error);
    return error ? absolute : target;
}

bool is_same_file(const fs::path& a, const fs::path& b) {
    std::error_code ignored;
    return meant(a) == meant(b) || fs::equivalent(a, b, ignored);
}

/// A pipe or a device takes whatever comes and loses nothing.
bool is_stream(const fs::path& file) {
    std::error_code ignored;
    return fs::exists(file, ignored) && !fs::is_regular_file(file, ignored) && !fs::is_directory(file, ignored);
}

void check_writable(const fs::path& output) {
    const auto refuse = [&](const std::string& why) {
        throw MachineError(output.string() + ": cannot be written: " + why);
    };
    std::error_code ignored;
    if (fs::is_directory(output, ignored)) refuse("is a folder");
    const fs::path target = meant(output);
    const fs::path folder = target.parent_path();
    if (!fs::is_directory(folder, ignored)) refuse("there is no folder " + in_quotes(folder.string()));
    const bool there = fs::exists(target, ignored);
    if (there && ::faccessat(AT_FDCWD, target.c_str(), W_OK, AT_EACCESS) != 0) refuse("it is write-protected");
    if (is_stream(target)) return;
    if (::faccessat(AT_FDCWD, folder.c_str(), W_OK | X_OK, AT_EACCESS) != 0) {
        refuse("its folder " + in_quotes(folder.string()) + " is write-protected");
    }
}

}  // namespace

void check_picture_name(const fs::path& output) {
    check_file_name(output);
    if (lower_extension(output) != ".png") {
        throw InputError(output.string(), "", "pictures are written as .png; rename the output");
    }
}

void WrittenFiles::writes(const fs::path& output) {
    for (const fs::path& source : sources_) {
        if (!is_same_file(output, source)) continue;
        throw InputError(output.string(), "",
                         "would replace " + in_quotes(source.string()) + ", which is read; give another output");
    }
    for (const fs::path& other : outputs_) {
        if (is_stream(output) || !is_same_file(output, other)) continue;
        throw InputError(output.string(), "", "would be written twice; give each output a name of its own");
    }
    outputs_.push_back(output);
    check_writable(output);
}

}  // namespace mobbscope::cli
