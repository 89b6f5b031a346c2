#include <base/error.h>
#include <import/fbx/readers.h>

#include <cmath>
#include <cstdint>

namespace mobbscope {

namespace {

// "Kaydara FBX Binary  ", NUL, 0x1A, then 1 where numbers are big-endian, and the version.
constexpr std::size_t kEndianByte = 22;
constexpr std::size_t kVersionByte = 23;
constexpr std::size_t kBinaryHeaderSize = 27;
constexpr int kWideOffsets = 7500;  // from this version on offsets and counts have 64 bits
constexpr std::string_view kExportAgain = "; the file is damaged, export it again";

}  // namespace

std::string at_byte(std::size_t byte) { return "byte " + std::to_string(byte); }

/// One pass over a binary file.
class FbxBinaryReader {
  public:
    explicit FbxBinaryReader(FbxDocument& document) : document_(document), bytes_(document.bytes_) {}

    void read() {
        if (bytes_.size() < kBinaryHeaderSize) fail(bytes_.size(), "is cut off");
        document_.is_big_endian_ = bytes_[kEndianByte] != 0;
        at_ = kVersionByte;
        const auto version = take<std::uint32_t>(kBinaryHeaderSize);
        if (version > 100'000) fail(kVersionByte, "does not say its version of FBX");
        document_.set_version(static_cast<int>(version));

        std::vector<FbxRecord>& records = document_.records_;
        std::vector<Open> open;
        const auto close = [&] {
            at_ = open.back().end;
            records[open.back().record].end = static_cast<std::uint32_t>(records.size());
            open.pop_back();
        };
        for (;;) {
            while (!open.empty() && at_ >= open.back().end) close();
            const std::size_t limit = open.empty() ? bytes_.size() : open.back().end;
            if (at_ == limit) break;  // no record of zeros at the end of the file, which says nothing
            FbxRecord record;
            record.place = at_;
            const std::uint64_t end = take_offset(limit);
            const std::uint64_t values = take_offset(limit);
            const std::uint64_t values_size = take_offset(limit);
            record.name = take_bytes(take<std::uint8_t>(limit), limit);
            if (end == 0) {  // what ends a list
                if (open.empty()) break;
                close();
                continue;
            }
            if (end < at_ || end > limit || values_size > end - at_)
                fail(record.place, "the record ends outside of what holds it");
            const std::size_t values_end = at_ + values_size;
            record.first_value = static_cast<std::uint32_t>(document_.values_.size());
            for (std::uint64_t i = 0; i < values; ++i) take_value(values_end);
            record.values = static_cast<std::uint32_t>(document_.values_.size()) - record.first_value;
            at_ = values_end;
            records.push_back(record);
            document_.charge_records();
            open.push_back({static_cast<FbxDocument::Index>(records.size() - 1), end});
        }
    }

  private:
    struct Open {
        FbxDocument::Index record = 0;
        std::size_t end = 0;  ///< byte
    };

    void fail(std::size_t place, const std::string& message) const {
        throw InputError(document_.file_, at_byte(place), message + std::string(kExportAgain));
    }

    template <class Number>
    Number take(std::size_t end) {
        if (end - at_ < sizeof(Number)) fail(at_, "is cut off");
        const auto out = fbx_number<Number>(bytes_, at_, document_.is_big_endian_);
        at_ += sizeof(Number);
        return out;
    }

    std::uint64_t take_offset(std::size_t end) {
        return document_.version_ >= kWideOffsets ? take<std::uint64_t>(end) : take<std::uint32_t>(end);
    }

    std::string_view take_bytes(std::uint64_t size, std::size_t end) {
        if (end - at_ < size) fail(at_, "claims " + std::to_string(size) + " bytes where none are left");
        const std::string_view out = bytes_.substr(at_, size);
        at_ += size;
        return out;
    }

    void take_value(std::size_t end) {
        const std::size_t place = at_;
        const char type = take<char>(end);
        FbxValue value;
        const auto integer = [&](std::int64_t number) {
            value.integer = number;
            value.real = static_cast<double>(number);
        };
        const auto real = [&](double number) {
            value.kind = FbxValue::Kind::real;
            value.real = number;
            value.integer = fbx_whole(number);
        };
        switch (type) {
            case 'B':
            case 'C':
            case 'Z':
                integer(take<std::uint8_t>(end));
                break;
            case 'Y':
                integer(take<std::int16_t>(end));
                break;
            case 'I':
                integer(take<std::int32_t>(end));
                break;
            case 'L':
                integer(take<std::int64_t>(end));
                break;
            case 'F':
                real(static_cast<double>(take<float>(end)));
                break;
            case 'D':
                real(take<double>(end));
                break;
            case 'S':
            case 'R':
                value.kind = FbxValue::Kind::text;
                value.text = take_bytes(take<std::uint32_t>(end), end);
                break;
            case 'b':
            case 'c':
            case 'd':
            case 'f':
            case 'i':
            case 'l':
                return take_array(type, end);
            default:
                fail(place, "a value has no known type");
        }
        document_.values_.push_back(value);
        document_.charge_records();
    }

    void take_array(char type, std::size_t end) {
        FbxValue value;
        value.kind = FbxValue::Kind::array;
        value.type = type;
        value.integer = take<std::uint32_t>(end);
        const std::size_t place = at_;
        const auto encoding = take<std::uint32_t>(end);
        if (encoding > 1) fail(place, "an array is packed in an unknown way");
        value.is_packed = encoding == 1;
        value.text = take_bytes(take<std::uint32_t>(end), end);
        document_.values_.push_back(value);
    }

    FbxDocument& document_;
    std::string_view bytes_;
    std::size_t at_ = 0;
};

void read_fbx_binary(FbxDocument& document) { FbxBinaryReader(document).read(); }

}  // namespace mobbscope
