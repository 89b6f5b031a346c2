#include <base/error.h>
#include <base/file.h>
#include <base/input.h>
#include <base/text.h>

#include <unistd.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <span>
#include <system_error>
#include <vector>

namespace mobbscope {

namespace {

constexpr const char* kStandardInput = "/dev/stdin";
constexpr std::size_t kMostHeld = std::size_t{4} << 20;  // bytes: a larger file is read again from the disk
constexpr std::size_t kPiece = std::size_t{1} << 17;
constexpr std::uintmax_t kLargeText = 100'000'000, kLargePacked = 1'000'000;

constexpr std::string_view kPackedMark = "\x1f\x8b";
// Tables become a fiftieth at most, and a bomb a thousandth.
constexpr std::uintmax_t kMostGrowth = 200;
constexpr std::uintmax_t kAlwaysUnpacked = std::uintmax_t{64} << 20;  // bytes

}  // namespace

struct Input::Source {
    std::string name;
    std::string held{};                     ///< all, where there is no file
    FileHandle file{nullptr, std::fclose};  ///< of what is too large
    std::uintmax_t size = 0;                ///< when it was opened

    /// As many bytes as there are from a place on, at most those that fit.
    std::size_t read(std::uintmax_t from, std::span<char> to) const {
        if (!file)
            return std::string_view(held).substr(std::min<std::size_t>(from, held.size())).copy(to.data(), to.size());
        std::size_t count = 0;
        while (count < to.size()) {
            const ssize_t here =
                ::pread(::fileno(file.get()), to.data() + count, to.size() - count, static_cast<off_t>(from + count));
            if (here < 0 && errno == EINTR) continue;
            if (here < 0) fail_to_read(name);
            if (here == 0) break;
            count += static_cast<std::size_t>(here);
        }
        return count;
    }
    bool is_packed() const {
        std::array<char, kPackedMark.size()> mark{};
        return read(0, mark) == mark.size() && std::ranges::equal(mark, kPackedMark);
    }
};

/// One pass over an input. gzip may have packed it in one piece or several.
class InputReader {
  public:
    explicit InputReader(std::shared_ptr<const Input::Source> source)
        : source_(std::move(source)), is_packed_(source_->is_packed()), buffer_(kPiece) {
        constexpr int kGzip = 16;
        if (is_packed_ && inflateInit2(&stream_, MAX_WBITS + kGzip) != Z_OK) throw std::bad_alloc();
    }
    ~InputReader() {
        if (is_packed_) inflateEnd(&stream_);
    }
    InputReader(const InputReader&) = delete;
    InputReader& operator=(const InputReader&) = delete;

    bool next(std::string& to) {
        if (is_packed_) return unpack(to);
        const std::string_view stored = take(1);
        to.append(stored);
        skip(stored.size());
        check_file_size(at_, source_->name);  // it may have grown meanwhile
        return !stored.empty();
    }

  private:
    /// What is stored and was not used yet: at least so many bytes where there are so many.
    std::string_view take(std::size_t least) {
        if (stream_.avail_in < least) {
            const std::size_t left = stream_.avail_in;
            if (left > 0) std::memmove(buffer_.data(), stream_.next_in, left);
            const std::size_t count = source_->read(at_, std::span(buffer_).subspan(left));
            at_ += count;
            stream_.next_in = reinterpret_cast<Bytef*>(buffer_.data());
            stream_.avail_in = static_cast<uInt>(left + count);
        }
        return {reinterpret_cast<const char*>(stream_.next_in), stream_.avail_in};
    }
    void skip(std::size_t count) {
        stream_.next_in += count;
        stream_.avail_in -= static_cast<uInt>(count);
    }

    bool unpack(std::string& to) {
        const std::size_t before = to.size();
        while (!ended_ && to.size() == before) {
            take(1);
            to.resize(before + kPiece);
            stream_.next_out = reinterpret_cast<Bytef*>(to.data() + before);
            stream_.avail_out = static_cast<uInt>(kPiece);
            const int status = inflate(&stream_, Z_NO_FLUSH);
            to.resize(before + kPiece - stream_.avail_out);
            unpacked_ += to.size() - before;
            // Of what was read so far: a bomb shows long before it has grown.
            const std::uintmax_t taken = at_ - stream_.avail_in;
            const std::uintmax_t limit = std::min(kLargestFile, std::max(kAlwaysUnpacked, kMostGrowth * taken));
            if (unpacked_ > limit) {
                fail("unpacks to more than " + bytes_text(limit) +
                     ", which no table of this size does; unpack it by hand if that is right");
            }
            if (status == Z_STREAM_END) {
                end_piece();
            } else if (status == Z_MEM_ERROR) {
                throw std::bad_alloc();
            } else if (status == Z_BUF_ERROR) {
                fail("ends within what gzip packed; get the whole file");
            } else if (status != Z_OK) {
                fail("what gzip packed is damaged; get the file again");
            }
        }
        return to.size() > before;
    }
    /// Goes on to the next piece, if there is one.
    void end_piece() {
        std::string_view left = take(kPackedMark.size());
        if (left.starts_with(kPackedMark)) {
            inflateReset(&stream_);
            return;
        }
        // What is padded to whole blocks ends in zeros.
        for (; !left.empty(); left = take(1)) {
            if (left.find_first_not_of('\0') != std::string_view::npos)
                fail("other bytes follow what gzip packed; pack the file again");
            skip(left.size());
        }
        ended_ = true;
    }
    [[noreturn]] void fail(const std::string& message) const { throw InputError(source_->name, message); }

    std::shared_ptr<const Input::Source> source_;
    bool is_packed_;
    std::vector<char> buffer_;
    z_stream stream_{};            ///< its next_in is the rest of the buffer, packed or not
    std::uintmax_t at_ = 0;        ///< what was read of the source
    std::uintmax_t unpacked_ = 0;  ///< bytes
    bool ended_ = false;           ///< nothing packed is left
};

Input::Input(std::string_view bytes)
    : source_(std::make_shared<const Source>(Source{{}, std::string(bytes), {nullptr, std::fclose}, bytes.size()})) {}

Input Input::open(const std::filesystem::path& file) {
    if (is_standard_input(file)) return standard_input();
    auto [handle, size] = open_to_read(file);
    Source source{file.string()};
    if (size <= kMostHeld) {
        source.held = read_all(handle.get(), size, source.name);
        source.size = source.held.size();
    } else {
        raise_budget(size);
        source.file = std::move(handle);
        source.size = size;
    }
    return Input(std::make_shared<const Source>(std::move(source)));
}

/// Read at its first use: there is no second time.
Input Input::standard_input() {
    static const Input kept = [] {
        Source source{"-"};
        std::vector<char> buffer(kPiece);
        while (const std::size_t count = std::fread(buffer.data(), 1, buffer.size(), stdin)) {
            source.size += count;
            check_file_size(source.size, source.name);
            source.held.append(buffer.data(), count);
            if (!source.file && source.size <= kMostHeld) continue;
            if (!source.file) source.file.reset(std::tmpfile());
            if (!source.file ||
                std::fwrite(source.held.data(), 1, source.held.size(), source.file.get()) < source.held.size())
                throw MachineError("standard input cannot be kept in a file: " +
                                   std::generic_category().message(errno));
            source.held.clear();
        }
        if (std::ferror(stdin) != 0) fail_to_read(source.name);
        if (source.file && std::fflush(source.file.get()) != 0)
            throw MachineError("standard input cannot be kept in a file: " + std::generic_category().message(errno));
        source.held.shrink_to_fit();
        raise_budget(source.size);
        // A file may stand behind it, which must not be replaced. What is typed or piped is none.
        std::error_code ignored;
        if (std::filesystem::is_regular_file(kStandardInput, ignored)) note_read(kStandardInput);
        return Input(std::make_shared<const Source>(std::move(source)));
    }();
    return kept;
}

InputBytes Input::all() const {
    InputBytes out;
    const bool is_packed = source_->is_packed();
    if (!is_packed) out.bytes.reserve(source_->size);
    for (InputReader reader(source_); reader.next(out.bytes);) {
        if (is_packed) out.spent.cover(out.bytes.size(), "what gzip packed", source_->name);
    }
    return out;
}

std::string Input::beginning(std::size_t most) const {
    std::string out;
    InputReader reader(source_);
    while (out.size() < most && reader.next(out)) {
    }
    out.resize(std::min(out.size(), most));
    return out;
}

TextPieces Input::pieces() const {
    return [reader = std::make_shared<InputReader>(source_)](std::string& to) { return reader->next(to); };
}

bool Input::is_large() const { return source_->size > (source_->is_packed() ? kLargePacked : kLargeText); }

InputBytes read_input(const std::filesystem::path& file) { return Input::open(file).all(); }

std::string read_beginning(const std::filesystem::path& file, std::size_t most) {
    std::string out;
    try {
        if (!is_standard_input(file)) {
            std::error_code ignored;
            if (!std::filesystem::is_regular_file(file, ignored)) return "";
            const FileHandle in(std::fopen(file.c_str(), "rbe"), std::fclose);
            if (!in) return "";
            out.resize(std::max(most, kPiece));
            out.resize(std::fread(out.data(), 1, out.size(), in.get()));
        }
        const TextPieces more = (is_standard_input(file) ? Input::open(file) : Input(std::exchange(out, {}))).pieces();
        while (out.size() < most && more(out)) {
        }
    } catch (const InputError&) {
        // What is packed ends within what was read.
    }
    out.resize(std::min(out.size(), most));
    return out;
}

}  // namespace mobbscope
