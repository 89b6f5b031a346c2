#include <base/text.h>
#include <render/drawlist/picture_options.h>

#include <charconv>
#include <cstdint>
#include <stdexcept>
#include <string_view>

namespace mobbscope {

void check(PictureSize size) {
    const auto within = [](int side) { return side >= kMinSide && side <= kMaxSide; };
    if (within(size.width) && within(size.height) && std::int64_t{size.width} * size.height <= kMaxPixels) return;
    throw std::invalid_argument("a picture of " + std::to_string(size.width) + "x" + std::to_string(size.height) +
                                " pixels cannot be made: each side must be " + std::to_string(kMinSide) + " to " +
                                std::to_string(kMaxSide) + ", and there may be at most " + std::to_string(kMaxPixels) +
                                " in all");
}

void check(const PictureOptions& options) {
    check(options.size);
    const std::int64_t pixels = std::int64_t{options.size.width} * options.size.height;
    if (pixels * (options.samples + 2) <= kMostDrawn) return;
    throw std::invalid_argument(
        "a picture of " + size_word(options.size) + " pixels with " + std::to_string(options.samples) +
        " samples each takes too much memory: with so many samples there may be at most " +
        std::to_string(kMostDrawn / (options.samples + 2)) + " pixels; take fewer of one or the other");
}

PictureSize parse_size(const std::string& text) {
    const std::size_t x = text.find('x');
    const std::optional<int> width = parse_int(std::string_view(text).substr(0, x));
    const std::optional<int> height =
        x == std::string::npos ? std::nullopt : parse_int(std::string_view(text).substr(x + 1));
    if (!width || !height)
        throw std::invalid_argument(in_quotes(text) + " is not a size: give WIDTHxHEIGHT in pixels (1280x720)");
    const PictureSize size{*width, *height};
    check(size);
    return size;
}

Palette palette_for(Theme theme, const PictureOptions& options) {
    Palette out = palette(theme);
    if (options.background && options.background->a >= 1) out.background = *options.background;
    return out;
}

int parse_samples(const std::string& text) {
    const int samples = parse_int(text).value_or(0);
    if (samples == 1 || samples == 2 || samples == 4 || samples == 8) return samples;
    throw std::invalid_argument(in_quotes(text) + " is not a number of samples: give 1, 2, 4 or 8");
}

Rgba parse_background(const std::string& text) {
    if (text == "transparent") return Rgba(0);
    const std::string_view digits = std::string_view(text).substr(text.starts_with('#') ? 1 : 0);
    std::uint32_t value = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value, 16);
    const bool whole = error == std::errc() && end == digits.data() + digits.size();
    if (!text.starts_with('#') || !whole || (digits.size() != 6 && digits.size() != 8)) {
        throw std::invalid_argument(in_quotes(text) + " is not a background: give #RRGGBB, #RRGGBBAA or transparent");
    }
    if (digits.size() == 6) value = value << 8 | 255u;
    return Rgba(value >> 24, value >> 16 & 255u, value >> 8 & 255u, value & 255u) / 255.0f;
}

}  // namespace mobbscope
