/// FBX documents for tests: records that are written as text and as binary of any version.
#pragma once

#include <zlib.h>

#include <algorithm>
#include <array>

#include <bit>
#include <cstdint>
#include <cstdio>
#include <stdexcept>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace mobbscope {
inline namespace testing {

/// A value of a record. A text that is a name may hold "Class::Name", which binary files write the other way round.
using FbxWritten = std::variant<std::int64_t, double, std::string, std::vector<std::int64_t>, std::vector<double>,
                                std::vector<std::uint32_t>>;

/// "name: values { inside }".
struct FbxWrite {
    std::string name;
    std::vector<FbxWritten> values{};
    std::vector<FbxWrite> inside{};

    FbxWrite& add(FbxWrite record) { return inside.emplace_back(std::move(record)); }
};

/// How a document is written.
struct FbxForm {
    int version = 7400;
    bool is_text = false;
    bool is_packed = false;  ///< arrays by zlib
    bool is_big_endian = false;
};

namespace fbx_detail {

inline std::string number(double value) {
    char out[32];
    std::snprintf(out, sizeof out, "%.17g", value);
    return out;
}

template <class Number>
std::string text_list(const std::vector<Number>& numbers) {
    std::string out = "*" + std::to_string(numbers.size()) + " {\n a: ";
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        out += i > 0 ? "," : "";
        if constexpr (std::is_same_v<Number, double>) {
            out += number(numbers[i]);
        } else {
            out += std::to_string(numbers[i]);
        }
    }
    return out + "\n}";
}

inline void write_text(const FbxWrite& record, int version, std::string& out) {
    out += record.name + ": ";
    for (std::size_t i = 0; i < record.values.size(); ++i) {
        out += i > 0 ? ", " : "";
        const FbxWritten& value = record.values[i];
        if (const auto* whole = std::get_if<std::int64_t>(&value)) out += std::to_string(*whole);
        if (const auto* real = std::get_if<double>(&value)) out += number(*real);
        if (const auto* text = std::get_if<std::string>(&value)) out += '"' + *text + '"';
        if (const auto* list = std::get_if<std::vector<std::int64_t>>(&value)) out += text_list(*list);
        if (const auto* list = std::get_if<std::vector<double>>(&value)) out += text_list(*list);
        if (const auto* bits = std::get_if<std::vector<std::uint32_t>>(&value)) {
            // From 7.2 on as integers, before as the floats of these bits.
            std::vector<double> floats;
            for (const std::uint32_t word : *bits) floats.push_back(static_cast<double>(std::bit_cast<float>(word)));
            out += version >= 7200 ? text_list(*bits) : text_list(floats);
        }
    }
    if (!record.inside.empty()) {
        out += " {\n";
        for (const FbxWrite& inside : record.inside) write_text(inside, version, out);
        out += "}";
    }
    out += "\n";
}

class BinaryWriter {
  public:
    explicit BinaryWriter(const FbxForm& form) : form_(form) {}

    std::string write(const std::vector<FbxWrite>& records) {
        out_ = std::string("Kaydara FBX Binary  \0\x1a", 22);
        out_ += form_.is_big_endian ? '\1' : '\0';
        put(static_cast<std::uint32_t>(form_.version));
        for (const FbxWrite& record : records) put_record(record);
        put_end();
        return out_;
    }

  private:
    template <class Number>
    void put(Number number) {
        auto raw = std::bit_cast<std::array<char, sizeof(Number)>>(number);
        if (form_.is_big_endian) std::reverse(raw.begin(), raw.end());
        out_.append(raw.data(), raw.size());
    }
    void put_offset(std::uint64_t offset) {
        if (form_.version >= 7500) {
            put(offset);
        } else {
            put(static_cast<std::uint32_t>(offset));
        }
    }
    std::size_t offset_size() const { return form_.version >= 7500 ? 8 : 4; }
    void put_end() { out_.append(3 * offset_size() + 1, '\0'); }

    void set_offset(std::size_t at, std::uint64_t offset) {
        std::string rest = out_.substr(at + offset_size());
        out_.resize(at);
        put_offset(offset);
        out_ += rest;
    }

    void put_record(const FbxWrite& record) {
        const std::size_t begin = out_.size();
        put_offset(0);
        put_offset(record.values.size());
        put_offset(0);
        put(static_cast<std::uint8_t>(record.name.size()));
        out_ += record.name;
        const std::size_t values = out_.size();
        for (const FbxWritten& value : record.values) std::visit([&](const auto& it) { put_value(it); }, value);
        set_offset(begin + 2 * offset_size(), out_.size() - values);
        for (const FbxWrite& inside : record.inside) put_record(inside);
        if (!record.inside.empty()) put_end();
        set_offset(begin, out_.size());
    }

    void put_value(std::int64_t value) {
        out_ += 'L';
        put(value);
    }
    void put_value(double value) {
        out_ += 'D';
        put(value);
    }
    void put_value(const std::string& value) {
        std::string name = value;
        if (const std::size_t at = value.find("::"); at != value.npos)
            name = value.substr(at + 2) + std::string("\0\1", 2) + value.substr(0, at);
        out_ += 'S';
        put(static_cast<std::uint32_t>(name.size()));
        out_ += name;
    }
    void put_value(const std::vector<std::int64_t>& value) { put_array('l', value); }
    void put_value(const std::vector<double>& value) { put_array('d', value); }
    void put_value(const std::vector<std::uint32_t>& value) { put_array('f', value); }

    template <class Number>
    void put_array(char type, const std::vector<Number>& numbers) {
        out_ += type;
        put(static_cast<std::uint32_t>(numbers.size()));
        const std::size_t head = out_.size();
        for (const Number number : numbers) put(number);
        std::string bytes = out_.substr(head);
        out_.resize(head);
        if (form_.is_packed) {
            uLongf size = compressBound(bytes.size());
            std::string packed(size, '\0');
            if (compress(reinterpret_cast<Bytef*>(packed.data()), &size, reinterpret_cast<const Bytef*>(bytes.data()),
                         bytes.size()) != Z_OK) {
                throw std::runtime_error("zlib packs nothing");
            }
            bytes = packed.substr(0, size);
        }
        put(static_cast<std::uint32_t>(form_.is_packed));
        put(static_cast<std::uint32_t>(bytes.size()));
        out_ += bytes;
    }

    FbxForm form_;
    std::string out_;
};

}  // namespace fbx_detail

/// The bytes of a file with these records; the header, which says the version, comes before them.
inline std::string fbx_bytes(std::vector<FbxWrite> records, const FbxForm& form = {}) {
    FbxWrite header{"FBXHeaderExtension"};
    header.add({"FBXHeaderVersion", {std::int64_t{1003}}});
    header.add({"FBXVersion", {std::int64_t{form.version}}});
    records.insert(records.begin(), header);
    if (!form.is_text) return fbx_detail::BinaryWriter(form).write(records);
    std::string out = "; FBX project file\n";
    for (const FbxWrite& record : records) fbx_detail::write_text(record, form.version, out);
    return out;
}

}  // namespace testing
}  // namespace mobbscope
