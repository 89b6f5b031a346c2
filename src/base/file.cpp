#include <base/error.h>
#include <base/file.h>
#include <base/text.h>

#include <zlib.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <system_error>
#include <utility>

namespace mobbscope {

namespace {

constexpr std::uintmax_t kLargestFile = std::uintmax_t{1} << 31;

constexpr const char* kStandardInput = "/dev/stdin";

constexpr std::string_view kPackedMark = "\x1f\x8b";
// Tables become a fiftieth at most, and a bomb a thousandth.
constexpr std::uintmax_t kMostGrowth = 200;
constexpr std::uintmax_t kAlwaysUnpacked = std::uintmax_t{64} << 20;  // bytes

std::unique_ptr<std::FILE, int (*)(std::FILE*)> opened(const std::filesystem::path& file) {
    return {std::fopen(file.c_str(), "rbe"), std::fclose};
}

std::string system_message(int error) { return std::generic_category().message(error); }

/// All that is left to read, up to kLargestFile and a little more. False if reading fails: errno says why.
bool read_on(std::FILE* in, std::string& bytes) {
    std::vector<char> buffer(1 << 16);
    std::size_t count = 0;
    while (bytes.size() <= kLargestFile && (count = std::fread(buffer.data(), 1, buffer.size(), in)) > 0)
        bytes.append(buffer.data(), count);
    return std::ferror(in) == 0;
}

void check_size(std::uintmax_t size, const std::string& name) {
    if (size > kLargestFile) throw InputError(name, "is larger than 2 GiB; split it");
}

/// Read at its first use: there is no second time.
const std::string& standard_input() {
    static const std::string bytes = [] {
        std::string read;
        if (!read_on(stdin, read)) throw InputError("-", "cannot be read: " + system_message(errno));
        check_size(read.size(), "-");
        raise_budget(read.size());
        // A file may stand behind it, which must not be replaced. What is typed or piped is none.
        std::error_code ignored;
        if (std::filesystem::is_regular_file(kStandardInput, ignored)) note_read(kStandardInput);
        return read;
    }();
    return bytes;
}

/// What gzip packed, in one piece or several; the first `most` bytes of it where that is less. Throws InputError.
InputBytes unpacked(std::string_view packed, const std::string& name, std::uintmax_t most) {
    z_stream stream{};
    constexpr int kGzip = 16;
    if (inflateInit2(&stream, MAX_WBITS + kGzip) != Z_OK) throw std::bad_alloc();
    const std::unique_ptr<z_stream, decltype(&inflateEnd)> end(&stream, inflateEnd);
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(packed.data()));  // it is not written to
    stream.avail_in = static_cast<uInt>(packed.size());
    InputBytes all;
    std::string& out = all.bytes;
    std::vector<char> buffer(1 << 16);
    for (;;) {
        stream.next_out = reinterpret_cast<Bytef*>(buffer.data());
        stream.avail_out = static_cast<uInt>(buffer.size());
        const int status = inflate(&stream, Z_NO_FLUSH);
        out.append(buffer.data(), buffer.size() - stream.avail_out);
        if (out.size() >= most) {
            out.resize(static_cast<std::size_t>(most));
            return all;
        }
        // Of what was read so far: a bomb shows long before it has grown.
        const std::uintmax_t taken = packed.size() - stream.avail_in;
        const std::uintmax_t limit = std::min(kLargestFile, std::max(kAlwaysUnpacked, kMostGrowth * taken));
        if (out.size() > limit) {
            throw InputError(name, "unpacks to more than " + bytes_text(limit) +
                                       ", which no table of this size does; unpack it by hand if that is right");
        }
        all.spent.cover(out.size(), "what gzip packed", name);
        if (status == Z_STREAM_END) {
            const std::string_view left = packed.substr(packed.size() - stream.avail_in);
            // What is padded to whole blocks ends in zeros.
            if (left.find_first_not_of('\0') == std::string_view::npos) return all;
            if (!left.starts_with(kPackedMark)) {
                throw InputError(name, "other bytes follow what gzip packed; pack the file again");
            }
            inflateReset(&stream);
        } else if (status == Z_BUF_ERROR || (status == Z_OK && stream.avail_in == 0 && stream.avail_out > 0)) {
            if (most < UINTMAX_MAX) return all;
            throw InputError(name, "ends within what gzip packed; get the whole file");
        } else if (status == Z_MEM_ERROR) {
            throw std::bad_alloc();
        } else if (status != Z_OK) {
            throw InputError(name, "what gzip packed is damaged; get the file again");
        }
    }
}

}  // namespace

void check_file_name(const std::filesystem::path& file) {
    if (file.empty()) throw InputError("the name of a file is empty; give one");
    if (file.native().find('\0') != std::string::npos)
        throw InputError(in_quotes(file.native()), "the name of a file holds a NUL byte; remove it");
}

std::string read_file(const std::filesystem::path& file) {
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
    const auto in = opened(file);
    if (!in) throw InputError(name, "cannot be read: " + system_message(errno));
    note_read(file);

    std::string bytes;
    const std::uintmax_t size = std::filesystem::file_size(file, error);
    if (!error) {
        check_size(size, name);
        // In one piece: as it grew, memory would be asked for again and again.
        bytes.reserve(static_cast<std::size_t>(size));
    }
    if (!read_on(in.get(), bytes)) throw InputError(name, "cannot be read: " + system_message(errno));
    check_size(bytes.size(), name);  // it may have grown meanwhile
    raise_budget(bytes.size());
    return bytes;
}

bool is_standard_input(const std::filesystem::path& file) { return file == "-"; }

InputBytes read_input(const std::filesystem::path& file) {
    InputBytes out{is_standard_input(file) ? standard_input() : read_file(file)};
    if (!out.bytes.starts_with(kPackedMark)) return out;
    return unpacked(out.bytes, file.string(), UINTMAX_MAX);
}

std::string read_beginning(const std::filesystem::path& file, std::size_t most) {
    std::string bytes;
    if (is_standard_input(file)) {
        bytes = standard_input().substr(0, most);
    } else {
        std::error_code ignored;
        if (!std::filesystem::is_regular_file(file, ignored)) return "";
        const auto in = opened(file);
        if (!in) return "";
        bytes.resize(most);
        bytes.resize(std::fread(bytes.data(), 1, most, in.get()));
    }
    if (!bytes.starts_with(kPackedMark)) return bytes;
    try {
        return std::move(unpacked(bytes, file.string(), most).bytes);
    } catch (const InputError&) {
        return "";
    }
}

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
