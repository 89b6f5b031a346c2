#include <render/png_chunks.h>

#include <import/error.h>

#include <array>
#include <cstddef>
#include <cstdint>

namespace mobbscope {

namespace {

constexpr std::string_view kSignature = "\x89PNG\r\n\x1a\n";
constexpr std::size_t kHeader = 13;  // bytes in IHDR
constexpr std::size_t kAround = 12;  // bytes of a chunk beside its data: length, type, sum

/// A number of four bytes, the highest first.
std::uint32_t number_at(std::string_view bytes, std::size_t at) {
    std::uint32_t value = 0;
    for (std::size_t i = at; i < at + 4; ++i) value = (value << 8) | static_cast<std::uint8_t>(bytes[i]);
    return value;
}

/// The remainder of every byte in the cyclic redundancy check that PNG takes from ISO 3309.
constexpr std::array<std::uint32_t, 256> kRemainders = [] {
    std::array<std::uint32_t, 256> out{};
    for (std::uint32_t byte = 0; byte < 256; ++byte) {
        std::uint32_t remainder = byte;
        for (int bit = 0; bit < 8; ++bit) remainder = (remainder >> 1) ^ (remainder & 1 ? 0xEDB88320u : 0u);
        out[byte] = remainder;
    }
    return out;
}();

std::uint32_t sum_of(std::string_view bytes) {
    std::uint32_t sum = ~0u;
    for (const char c : bytes) sum = (sum >> 8) ^ kRemainders[(sum ^ static_cast<std::uint8_t>(c)) & 255u];
    return ~sum;
}

void check_size(std::string_view header, const std::string& file) {
    const long long width = number_at(header, 0);
    const long long height = number_at(header, 4);
    if (width == 0 || height == 0) throw InputError(file, "", "the picture has no pixels");
    if (width > kMostPngPixels / height) {
        throw InputError(file, "",
                         "the picture of " + std::to_string(width) + "x" + std::to_string(height) +
                             " pixels is too large; up to 134 million pixels are read");
    }
}

}  // namespace

void check_png(std::string_view bytes, const std::string& file) {
    if (!bytes.starts_with(kSignature)) throw InputError(file, "", "is no PNG picture; give a .png file");
    std::string_view type;
    for (std::size_t at = kSignature.size(); type != "IEND";) {
        const std::string place = "byte " + std::to_string(at);
        const std::size_t left = bytes.size() - at;
        const std::size_t length = left < kAround ? 0 : number_at(bytes, at);
        if (left < kAround || length > left - kAround) {
            throw InputError(file, place, "the PNG picture is cut short here; write or copy it again");
        }
        type = bytes.substr(at + 4, 4);
        if (sum_of(bytes.substr(at + 4, 4 + length)) != number_at(bytes, at + 8 + length)) {
            throw InputError(file, place, "the PNG picture is damaged after here; write or copy it again");
        }
        if (at == kSignature.size()) {
            if (type != "IHDR" || length != kHeader) {
                throw InputError(file, place, "the PNG picture does not begin with its size; write it again");
            }
            check_size(bytes.substr(at + 8, kHeader), file);
        }
        at += kAround + length;
    }
}

}  // namespace mobbscope
