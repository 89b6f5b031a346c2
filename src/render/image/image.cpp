#include <render/image/image.h>

#include <algorithm>
#include <stdexcept>
#include <string>

namespace mobbscope {

namespace {

constexpr int kStripGap = 4;
constexpr std::uint8_t kGrey = 128;  // stands out from both themes

}  // namespace

Image make_strip(std::span<const Image* const> pictures) {
    long long width = kStripGap * (static_cast<long long>(pictures.size()) - 1);
    long long height = 0;
    for (const Image* picture : pictures) {
        width += picture->width;
        height = std::max<long long>(height, picture->height);
    }
    if (width * height > kMostStripPixels) {
        throw std::invalid_argument("a strip of " + std::to_string(width) + "x" + std::to_string(height) +
                                    " pixels is too large; leave it out");
    }
    Image out(static_cast<int>(width), static_cast<int>(height));
    for (std::size_t i = 0; i < out.rgba.size(); ++i) out.rgba[i] = i % 4 == 3 ? 255 : kGrey;
    int left = 0;
    for (const Image* picture : pictures) {
        for (int y = 0; y < picture->height; ++y) {
            std::copy_n(picture->at(0, y), 4 * static_cast<std::size_t>(picture->width), out.at(left, y));
        }
        left += picture->width + kStripGap;
    }
    return out;
}

}  // namespace mobbscope
