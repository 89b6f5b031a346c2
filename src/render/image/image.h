/// Pixels on the CPU.
#pragma once

#include <base/budget.h>
#include <base/color.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace mobbscope {

/// Width and height of a picture in pixels.
struct PictureSize {
    int width = 0;
    int height = 0;
    friend bool operator==(const PictureSize&, const PictureSize&) = default;
};

/// "1280x720", as options and files have it, and "1280 x 720" for people.
std::string size_word(PictureSize size);
std::string size_text(PictureSize size);

/// Rows from top to bottom, 4 bytes a pixel (RGBA, straight alpha).
struct Image {
    int width = 0;
    int height = 0;
    std::vector<std::uint8_t> rgba;
    std::shared_ptr<const Spent> spent{};  ///< of the budget, of one that was read

    Image() = default;
    Image(int w, int h) : width(w), height(h), rgba(static_cast<std::size_t>(w) * static_cast<std::size_t>(h) * 4) {}

    /// The four channels of pixel (x, y), which must lie in the image.
    std::uint8_t* at(int x, int y) { return rgba.data() + offset(x, y); }
    const std::uint8_t* at(int x, int y) const { return rgba.data() + offset(x, y); }

  private:
    std::size_t offset(int x, int y) const {
        return (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)) * 4;
    }
};

/// Three of the largest pictures that are read side by side, and what is between them.
inline constexpr long long kMostStripPixels = 110'000'000;

/// From left to right, their upper edges level, a few grey pixels between them and below shorter ones; pictures keep
/// their pixels. At least one. Throws std::invalid_argument if that is more than kMostStripPixels.
Image make_strip(std::span<const Image* const> pictures);

/// One pixel for each square of `side` x `side` (>= 1), their mean; what remains at the right and below is a pixel too.
Image shrunk(const Image& image, int side);

/// A picture on an opaque ground.
struct OnGround {
    const Image& image;
    Rgba ground;
};

/// The same picture on two grounds of different lightness gives what was drawn and how much it covers; that over
/// `background`, with straight alpha. Laid over the first ground, what is drawn is the first picture again, within
/// rounding.
Image with_transparent_background(const OnGround& first, const OnGround& second, Rgba background);

}  // namespace mobbscope
