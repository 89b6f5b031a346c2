/// The two ways in which a document is stored, and the numbers in them.
#pragma once

#include <import/fbx/document.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <vector>

namespace mobbscope {

inline constexpr std::string_view kFbxBinaryMark = "Kaydara FBX Binary";
inline constexpr char kFbxTextArray = 'a';  ///< FbxValue::type of an array that is text

/// The number stored at a place; there are as many bytes.
template <class Number>
Number fbx_number(std::string_view bytes, std::size_t at, bool is_big_endian) {
    std::array<char, sizeof(Number)> raw{};
    std::memcpy(raw.data(), bytes.data() + at, sizeof(Number));
    if (is_big_endian != (std::endian::native == std::endian::big)) std::reverse(raw.begin(), raw.end());
    return std::bit_cast<Number>(raw);
}

/// A real number as an integer: towards zero, within the range; 0 for what is no number.
inline std::int64_t fbx_whole(double value) {
    constexpr double kMost = 9.2e18;
    return std::isnan(value) ? 0 : static_cast<std::int64_t>(std::clamp(value, -kMost, kMost));
}

/// Where a line ends, from `at` on: its line feed or carriage return, or the end of the text.
inline std::size_t fbx_line_end(std::string_view text, std::size_t at) {
    return std::min(text.find_first_of("\r\n", at), text.size());
}

/// A word of a text file as a number, or as text where it is none. "nan" and "inf" are numbers.
FbxValue fbx_word(std::string_view word);

/// Calls `visit` with each number, as fbx_word reads it, of a list with commas and comments.
template <class Visit>
void each_fbx_number(std::string_view list, const Visit& visit) {
    constexpr std::string_view kBetween = " \t\r\n,";
    for (std::size_t at = list.find_first_not_of(kBetween); at < list.size();
         at = list.find_first_not_of(kBetween, at)) {
        if (list[at] == ';') {
            at = fbx_line_end(list, at);
            continue;
        }
        const std::size_t end = std::min(list.find_first_of(" \t\r\n,;", at), list.size());
        visit(fbx_word(list.substr(at, end - at)));
        at = end;
    }
}

/// "byte 1234".
std::string at_byte(std::size_t byte);

/// Fill a document. Throw InputError.
void read_fbx_binary(FbxDocument& document);
void read_fbx_text(FbxDocument& document);

}  // namespace mobbscope
