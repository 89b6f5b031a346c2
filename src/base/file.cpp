#include <base/budget.h>
#include <base/error.h>
#include <base/file.h>
#include <base/text.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <system_error>
#include <utility>

namespace mobbscope {

namespace {

/// All that is left to read, up to kLargestFile and a little more. False if reading fails: errno says why.
bool read_on(std::FILE* in, std::string& bytes) {
    std::vector<char> buffer(1 << 16);
    std::size_t count = 0;
    while (bytes.size() <= kLargestFile && (count = std::fread(buffer.data(), 1, buffer.size(), in)) > 0)
        bytes.append(buffer.data(), count);
    return std::ferror(in) == 0;
}

}  // namespace

void check_file_name(const std::filesystem::path& file) {
    if (file.empty()) throw InputError("the name of a file is empty; give one");
    if (file.native().find('\0') != std::string::npos)
        throw InputError(in_quotes(file.native()), "the name of a file holds a NUL byte; remove it");
}

void check_file_size(std::uintmax_t size, const std::string& name) {
    if (size > kLargestFile) throw InputError(name, "is larger than 2 GiB; split it");
}

void fail_to_read(const std::string& name) {
    throw InputError(name, "cannot be read: " + std::generic_category().message(errno));
}

std::pair<FileHandle, std::uintmax_t> open_to_read(const std::filesystem::path& file) {
    check_file_name(file);
    const std::string name = file.string();
    std::error_code error;
    const std::filesystem::file_status status = std::filesystem::status(file, error);
    if (status.type() == std::filesystem::file_type::not_found) throw InputError(name, "no such file; check the path");
    if (error) throw InputError(name, "cannot be read: " + error.message());
    if (status.type() == std::filesystem::file_type::directory) {
        throw InputError(name, "is a directory; give a file in it");
    }
    // Devices and pipes may never end.
    if (status.type() != std::filesystem::file_type::regular) {
        throw InputError(name, "is not a regular file; save the data to a file first");
    }
    FileHandle in(std::fopen(file.c_str(), "rbe"), std::fclose);
    if (!in) fail_to_read(name);
    note_read(file);
    std::uintmax_t size = std::filesystem::file_size(file, error);
    if (error) size = 0;
    check_file_size(size, name);
    return {std::move(in), size};
}

std::string read_all(std::FILE* in, std::uintmax_t size, const std::string& name) {
    std::string bytes;
    // In one piece: as it grew, memory would be asked for again and again.
    bytes.reserve(static_cast<std::size_t>(size));
    if (!read_on(in, bytes)) fail_to_read(name);
    check_file_size(bytes.size(), name);  // it may have grown meanwhile
    raise_budget(bytes.size());
    return bytes;
}

std::string read_file(const std::filesystem::path& file) {
    const auto [in, size] = open_to_read(file);
    return read_all(in.get(), size, file.string());
}

bool is_standard_input(const std::filesystem::path& file) { return file == "-"; }

std::filesystem::path whole_path(const std::filesystem::path& path) {
    std::error_code gone;
    const std::filesystem::path given = path.empty() ? "." : path;
    const std::filesystem::path absolute = std::filesystem::absolute(given, gone);
    const std::filesystem::path whole = (gone ? given : absolute).lexically_normal();
    return whole.has_filename() || !whole.has_relative_path() ? whole : whole.parent_path();
}

std::string own_name(const std::filesystem::path& path) {
    const std::filesystem::path whole = whole_path(path);
    return (whole.has_filename() ? whole.filename() : whole).string();
}

std::string lower_extension(const std::filesystem::path& file) { return lower(file.extension().string()); }

std::string unpacked_extension(const std::filesystem::path& file) {
    const std::string extension = lower_extension(file);
    return extension == ".gz" ? lower_extension(file.stem()) : extension;
}

std::string input_stem(const std::filesystem::path& file) {
    if (is_standard_input(file)) return shown_name(file);
    return (lower_extension(file) == ".gz" ? file.stem() : file).stem().string();
}

std::string shown_name(const std::filesystem::path& file) {
    return is_standard_input(file) ? "standard input" : file.string();
}

}  // namespace mobbscope
