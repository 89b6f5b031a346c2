#include <render/image/image.h>

#include <glm/common.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace mobbscope {

namespace {

constexpr int kStripGap = 4;
constexpr std::uint8_t kGrey = 128;  // stands out from both themes

glm::vec3 color_at(const Image& image, std::size_t i) {
    return glm::vec3(image.rgba[i], image.rgba[i + 1], image.rgba[i + 2]) / 255.0f;
}

float sum(glm::vec3 v) { return v.x + v.y + v.z; }

std::uint8_t to_byte(float value) {
    return static_cast<std::uint8_t>(std::lround(255 * glm::clamp(value, 0.0f, 1.0f)));
}

}  // namespace

std::string size_word(PictureSize size) { return std::to_string(size.width) + 'x' + std::to_string(size.height); }
std::string size_text(PictureSize size) { return std::to_string(size.width) + " x " + std::to_string(size.height); }

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

Image shrunk(const Image& image, int side) {
    Image out((image.width + side - 1) / side, (image.height + side - 1) / side);
    for (int y = 0; y < out.height; ++y) {
        for (int x = 0; x < out.width; ++x) {
            const int end_x = std::min((x + 1) * side, image.width);
            const int end_y = std::min((y + 1) * side, image.height);
            // Colours count as much as they cover.
            unsigned red = 0, green = 0, blue = 0, cover = 0, count = 0;
            for (int from_y = y * side; from_y < end_y; ++from_y) {
                for (int from_x = x * side; from_x < end_x; ++from_x) {
                    const std::uint8_t* pixel = image.at(from_x, from_y);
                    red += pixel[0] * unsigned{pixel[3]};
                    green += pixel[1] * unsigned{pixel[3]};
                    blue += pixel[2] * unsigned{pixel[3]};
                    cover += pixel[3];
                    ++count;
                }
            }
            std::uint8_t* pixel = out.at(x, y);
            const unsigned covered = std::max(cover, 1u);
            pixel[0] = static_cast<std::uint8_t>((red + covered / 2) / covered);
            pixel[1] = static_cast<std::uint8_t>((green + covered / 2) / covered);
            pixel[2] = static_cast<std::uint8_t>((blue + covered / 2) / covered);
            pixel[3] = static_cast<std::uint8_t>((cover + count / 2) / count);
        }
    }
    return out;
}

Image with_transparent_background(const OnGround& first, const OnGround& second, Rgba background) {
    const glm::vec3 ground(first.ground);
    const float between_grounds = sum(glm::vec3(second.ground) - ground);
    Image out(first.image.width, first.image.height);
    for (std::size_t i = 0; i < out.rgba.size(); i += 4) {
        const glm::vec3 seen = color_at(first.image, i);
        const float through = glm::clamp(sum(color_at(second.image, i) - seen) / between_grounds, 0.0f, 1.0f);
        const glm::vec3 drawn = seen - through * ground + through * background.a * glm::vec3(background);
        const float covers = 1 - through * (1 - background.a);
        // The colour makes up for what rounding does to the opacity, so that all is right over the first ground.
        const std::uint8_t alpha = to_byte(covers);
        const float rounded = static_cast<float>(alpha) / 255.0f;
        const glm::vec3 color = alpha > 0 ? (drawn + (rounded - covers) * ground) / rounded : glm::vec3(0);
        for (int c = 0; c < 3; ++c) out.rgba[i + static_cast<std::size_t>(c)] = to_byte(color[c]);
        out.rgba[i + 3] = alpha;
    }
    return out;
}

}  // namespace mobbscope
