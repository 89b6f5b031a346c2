/// PNG files by hand: every kind that the format knows, and damage that its sums do not tell.
#pragma once

#include <zlib.h>

#include <string>
#include <string_view>
#include <vector>

namespace mobbscope {
inline namespace testing {

/// Four bytes, the highest first.
inline std::string big_endian(std::size_t value) {
    std::string out;
    for (int shift = 24; shift >= 0; shift -= 8) out += static_cast<char>((value >> shift) & 255u);
    return out;
}

inline std::string bytes_of(const std::vector<int>& values) { return {values.begin(), values.end()}; }

/// One chunk of a PNG file, with the sum that it should have.
inline std::string png_chunk(const std::string& type, const std::string& data) {
    const std::string summed = type + data;
    const auto sum = crc32(0, reinterpret_cast<const Bytef*>(summed.data()), static_cast<uInt>(summed.size()));
    return big_endian(data.size()) + summed + big_endian(sum);
}

/// `data` as zlib packs it.
inline std::string packed(const std::string& data) {
    std::string out(compressBound(static_cast<uLong>(data.size())), '\0');
    uLongf size = static_cast<uLongf>(out.size());
    compress(reinterpret_cast<Bytef*>(out.data()), &size, reinterpret_cast<const Bytef*>(data.data()),
             static_cast<uLong>(data.size()));
    out.resize(size);
    return out;
}

struct PngKind {
    int width = 2;
    int height = 1;
    int bits = 8;   ///< of a channel
    int color = 6;  ///< 0 grey, 2 RGB, 3 palette, 4 grey and alpha, 6 RGBA
    bool interlaced = false;
};

inline constexpr std::string_view kPngSignature = "\x89PNG\r\n\x1a\n";

inline std::string png_header(const PngKind& kind) {
    return std::string(kPngSignature) +
           png_chunk("IHDR", big_endian(static_cast<std::size_t>(kind.width)) +
                                 big_endian(static_cast<std::size_t>(kind.height)) +
                                 bytes_of({kind.bits, kind.color, 0, 0, kind.interlaced ? 1 : 0}));
}

/// `rows`: each begins with its filter's number. `between`: chunks before the pixels, such as the palette.
inline std::string png_file(const PngKind& kind, const std::vector<int>& rows, const std::string& between = "") {
    return png_header(kind) + between + png_chunk("IDAT", packed(bytes_of(rows))) + png_chunk("IEND", "");
}

}  // namespace testing
}  // namespace mobbscope
