/// FBX documents as they are stored: nested records with values, binary or text. What they mean: objects.h.
#pragma once

#include <base/budget.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace mobbscope {

/// A value of a record. An array stays packed until somebody asks for its numbers (FbxDocument::numbers): most arrays
/// of a file are meshes.
struct FbxValue {
    enum class Kind : unsigned char { integer, real, text, array };

    std::string_view text;     ///< text: as it stands in the file; array: its bytes
    std::int64_t integer = 0;  ///< of a real one: towards zero, within the range; array: how many numbers it claims
    double real = 0;           ///< of an integer too
    Kind kind = Kind::integer;
    char type = 0;           ///< array: 'f', 'd', 'i', 'l', 'b'; 'a' where it is text
    bool is_packed = false;  ///< array: by zlib
};

/// "Name: value, value { records }".
struct FbxRecord {
    std::string_view name;
    std::size_t place = 0;  ///< where it begins: a byte of a binary file, a line of a text file
    std::uint32_t first_value = 0;
    std::uint32_t values = 0;
    std::uint32_t end = 0;  ///< one past the last record inside it; the first one follows it at once
};

/// All records of a file, those inside a record right behind it. Refers to the bytes, which must outlive it.
class FbxDocument {
  public:
    using Index = std::uint32_t;

    /// Throws InputError, naming `file` and the place, for what is no FBX, is damaged, or of a version other than 6.1
    /// and those from 7.1 on.
    FbxDocument(std::string_view bytes, std::string file);

    /// 7400 for FBX 7.4.
    int version() const { return version_; }
    /// FBX 6: names stand for ids, and takes for stacks of animation.
    bool is_old() const { return version_ < 7000; }
    const std::string& file() const { return file_; }
    const FbxRecord& record(Index record) const { return records_[record]; }
    /// Of kNone none.
    std::span<const FbxValue> values(Index record) const {
        if (record == kNone) return {};
        return std::span(values_).subspan(records_[record].first_value, records_[record].values);
    }

    static constexpr Index kNone = UINT32_MAX;
    static constexpr Index kFile = kNone - 1;  ///< what all records are inside of
    /// Calls `visit` with each record directly inside of one; of kNone none.
    template <class Visit>
    void each_inside(Index record, const Visit& visit) const {
        const auto [first, end] = inside(record);
        for (Index at = first; at < end; at = records_[at].end) visit(at);
    }
    /// The first one of that name; kNone if there is none.
    Index find(Index record, std::string_view name) const;

    /// The numbers of a record, an array or values one by one; of kNone none. Throws InputError, naming the place, if
    /// the array is damaged, holds another number of elements than it claims, or is too much (see `charge`).
    std::vector<double> numbers(Index record);
    std::vector<std::int64_t> integers(Index record);
    /// The same for 32-bit floats that stand for packed bits: their bits. 64-bit ones are made 32-bit first.
    std::vector<std::uint32_t> float_bits(Index record);

    /// Counts what a record's numbers take in memory. Throws InputError, naming the record, once all of them together
    /// take far more than a file of this size could need, or more than the budget.
    void charge(Index record, std::uint64_t count, std::size_t bytes_each);

    /// "byte 1234" or "line 12".
    std::string place_of(Index record) const;
    [[noreturn]] void fail(Index record, const std::string& message) const;

  private:
    friend class FbxBinaryReader;
    friend class FbxTextReader;

    /// First and end of what is inside of a record.
    std::pair<Index, Index> inside(Index record) const {
        if (record == kNone) return {0, 0};
        if (record == kFile) return {0, static_cast<Index>(records_.size())};
        return {record + 1, records_[record].end};
    }
    /// Counts what the records and values so far take.
    void charge_records() {
        spent_.cover(sizeof(FbxRecord) * records_.capacity() + sizeof(FbxValue) * values_.capacity(), "its records",
                     file_);
    }
    /// Throws InputError for a version that is too old.
    void set_version(int version);
    template <class Number>
    std::vector<Number> read(Index record);
    /// The bytes of an array, unpacked into `room` where they are packed.
    std::string_view unpacked(Index record, const FbxValue& array, std::size_t width, std::string& room);

    std::string_view bytes_;
    std::string file_;
    int version_ = 0;
    bool is_text_ = false;
    bool is_big_endian_ = false;
    std::vector<FbxRecord> records_;
    std::vector<FbxValue> values_;
    Spent spent_;    ///< on records and values
    Spent numbers_;  ///< on what charge counts
};

/// Text as it stands in a text file ("a &quot;b&quot;") without escapes.
std::string fbx_text(const FbxValue& value);

}  // namespace mobbscope
