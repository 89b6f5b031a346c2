#include <base/error.h>
#include <base/text.h>
#include <import/fbx/document.h>
#include <import/fbx/readers.h>
#include <zlib.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <new>
#include <type_traits>
#include <utility>

namespace mobbscope {

namespace {

constexpr int kOldestVersion = 7100, kOldVersion = 6100;
constexpr int kBitsAsIntegers = 7200;
// Bytes that numbers may take once they are read. A key takes some 140, stored well packed at least 2.
constexpr std::size_t kLeastBudget = std::size_t{64} << 20;
constexpr std::size_t kGrowth = 200;
constexpr std::size_t kStep = std::size_t{1} << 20;  // bytes that an unpacked array grows by

std::size_t width_of(char type) {
    switch (type) {
        case 'd':
        case 'l':
            return 8;
        case 'f':
        case 'i':
            return 4;
        case 'b':
        case 'c':
            return 1;
        default:
            return 0;
    }
}

/// "6.1" of 6100, "7.5" of 7500.
std::string version_text(int version) {
    return std::to_string(version / 1000) + "." + std::to_string(version % 1000 / 100);
}

template <class Number, class Stored>
Number converted(Stored stored) {
    if constexpr (std::is_same_v<Number, std::uint32_t> && std::is_floating_point_v<Stored>) {
        return std::bit_cast<std::uint32_t>(static_cast<float>(stored));
    } else if constexpr (std::is_same_v<Number, std::int64_t> && std::is_floating_point_v<Stored>) {
        return fbx_whole(static_cast<double>(stored));
    } else {
        return static_cast<Number>(stored);
    }
}

template <class Number, class Stored>
void append(std::string_view bytes, bool is_big_endian, std::vector<Number>& out) {
    out.reserve(bytes.size() / sizeof(Stored));
    for (std::size_t at = 0; at + sizeof(Stored) <= bytes.size(); at += sizeof(Stored)) {
        out.push_back(converted<Number>(fbx_number<Stored>(bytes, at, is_big_endian)));
    }
}

}  // namespace

FbxDocument::FbxDocument(std::string_view bytes, std::string file) : bytes_(bytes), file_(std::move(file)) {
    is_text_ = !bytes.starts_with(kFbxBinaryMark);
    is_text_ ? read_fbx_text(*this) : read_fbx_binary(*this);
}

void FbxDocument::set_version(int version) {
    version_ = version;
    if (version < kOldestVersion && version != kOldVersion) {
        throw InputError(file_, "",
                         "is FBX " + version_text(version) +
                             ", which is not read; export it again as FBX 7.4 (FBX 2014/2015) or newer, or as glTF");
    }
}

FbxDocument::Index FbxDocument::find(Index record, std::string_view name) const {
    const auto [first, end] = inside(record);
    for (Index at = first; at < end; at = records_[at].end) {
        if (records_[at].name == name) return at;
    }
    return kNone;
}

std::string FbxDocument::place_of(Index record) const {
    return is_text_ ? at_line(static_cast<int>(records_[record].place)) : at_byte(records_[record].place);
}

void FbxDocument::fail(Index record, const std::string& message) const {
    throw InputError(file_, place_of(record), std::string(records_[record].name) + " " + message);
}

std::vector<double> FbxDocument::numbers(Index record) { return read<double>(record); }
std::vector<std::int64_t> FbxDocument::integers(Index record) { return read<std::int64_t>(record); }
std::vector<std::uint32_t> FbxDocument::float_bits(Index record) { return read<std::uint32_t>(record); }

void FbxDocument::charge(Index record, std::uint64_t count, std::size_t bytes_each) {
    const std::size_t most = std::max(kLeastBudget, kGrowth * bytes_.size());
    if (count > (most - numbers_.bytes()) / bytes_each || !numbers_.try_add(count * bytes_each))
        fail(record, "claims " + std::to_string(count) + " numbers, too many for this file; export it again");
}

std::string_view FbxDocument::unpacked(Index record, const FbxValue& array, std::size_t width, std::string& room) {
    const std::string_view stored = array.text;
    const auto count = static_cast<std::uint64_t>(array.integer);
    if (!array.is_packed) {
        if (stored.size() / width != count || stored.size() % width != 0) {
            fail(record, "claims " + std::to_string(count) + " numbers, but holds " + std::to_string(stored.size()) +
                             " bytes; export the file again");
        }
        return stored;
    }
    charge(record, count, width);
    const std::size_t size = count * width;

    z_stream stream{};
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(stored.data()));  // zlib only reads it
    stream.avail_in = static_cast<uInt>(stored.size());
    if (inflateInit(&stream) != Z_OK) throw std::bad_alloc();
    const std::unique_ptr<z_stream, decltype(&inflateEnd)> end(&stream, inflateEnd);
    // The room grows with what comes: a claim alone takes no memory. One byte more tells that there is too much.
    std::size_t filled = 0;
    int status = Z_OK;
    while (status == Z_OK && filled <= size) {
        room.resize(std::min(size + 1, filled + kStep));
        stream.next_out = reinterpret_cast<Bytef*>(room.data() + filled);
        stream.avail_out = static_cast<uInt>(room.size() - filled);
        status = inflate(&stream, Z_NO_FLUSH);
        filled = room.size() - stream.avail_out;
        if (status == Z_BUF_ERROR || stream.avail_out > 0) break;
    }
    if (filled != size || (status != Z_OK && status != Z_STREAM_END))
        fail(record,
             "does not unpack to the " + std::to_string(count) + " numbers that it claims; export the file again");
    return std::string_view(room).substr(0, size);
}

template <class Number>
std::vector<Number> FbxDocument::read(Index record) {
    std::vector<Number> out;
    // Before 7.2 text files had the floats in which bits are packed as floats, since then as the integers of these
    // bits.
    const bool is_real = std::is_same_v<Number, std::uint32_t> && version_ < kBitsAsIntegers;
    const auto add = [&](const FbxValue& value) {
        if (value.kind != FbxValue::Kind::integer && value.kind != FbxValue::Kind::real)
            fail(record, "holds " + in_quotes(value.text) + ", which is not a number; export the file again");
        out.push_back(is_real || value.kind == FbxValue::Kind::real ? converted<Number>(value.real)
                                                                    : converted<Number>(value.integer));
    };
    const std::span<const FbxValue> all = values(record);
    if (all.size() != 1 || all[0].kind != FbxValue::Kind::array) {
        std::ranges::for_each(all, add);
        return out;
    }
    const FbxValue& array = all[0];
    if (array.type == kFbxTextArray) {
        each_fbx_number(array.text, add);
        if (out.size() != static_cast<std::uint64_t>(array.integer)) {
            fail(record, "claims " + std::to_string(array.integer) + " numbers, but holds " +
                             std::to_string(out.size()) + "; export the file again");
        }
        charge(record, out.size(), sizeof(Number));
        return out;
    }
    const std::size_t width = width_of(array.type);
    std::string room;
    const std::string_view bytes = unpacked(record, array, width, room);
    charge(record, bytes.size() / width, sizeof(Number));
    switch (array.type) {
        case 'd':
            append<Number, double>(bytes, is_big_endian_, out);
            break;
        case 'f':
            append<Number, float>(bytes, is_big_endian_, out);
            break;
        case 'l':
            append<Number, std::int64_t>(bytes, is_big_endian_, out);
            break;
        case 'i':
            append<Number, std::int32_t>(bytes, is_big_endian_, out);
            break;
        default:
            append<Number, std::uint8_t>(bytes, is_big_endian_, out);
            break;
    }
    return out;
}

std::string fbx_text(const FbxValue& value) {
    constexpr std::pair<std::string_view, char> kEscapes[] = {{"&quot;", '"'}, {"&cr;", '\r'}, {"&lf;", '\n'}};
    std::string out;
    for (std::string_view rest = value.text; !rest.empty();) {
        const auto escape = std::ranges::find_if(kEscapes, [&](const auto& e) { return rest.starts_with(e.first); });
        const bool is_escape = escape != std::end(kEscapes);
        out += is_escape ? escape->second : rest[0];
        rest.remove_prefix(is_escape ? escape->first.size() : 1);
    }
    return out;
}

}  // namespace mobbscope
