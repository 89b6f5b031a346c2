#include <render/image_diff.h>

#include <algorithm>
#include <cstdlib>
#include <stdexcept>

namespace mobbscope {

namespace {

/// The largest difference of their channels, 0..255. Colour that nobody sees is no difference.
int difference(const std::uint8_t* a, const std::uint8_t* b) {
    if (a[3] == 0 && b[3] == 0) return 0;
    int largest = 0;
    for (int c = 0; c < 4; ++c) largest = std::max(largest, std::abs(int{a[c]} - int{b[c]}));
    return largest;
}

/// The least difference of a pixel at (x, y) to those of `other` within a distance.
int least_difference(const std::uint8_t* pixel, const Image& other, int x, int y, int distance) {
    int least = 255;
    for (int v = std::max(0, y - distance); v <= std::min(other.height - 1, y + distance); ++v) {
        for (int u = std::max(0, x - distance); u <= std::min(other.width - 1, x + distance); ++u) {
            least = std::min(least, difference(pixel, other.at(u, v)));
        }
    }
    return least;
}

/// Equal pixels keep a ghost of the reference, so that the eye finds its place; others glow red to yellow.
void paint_heat(std::uint8_t* out, const std::uint8_t* reference, int difference, bool differs) {
    const int grey = (reference[0] + reference[1] + reference[2]) / 12;
    const int glow = differs ? std::min(255, 96 + 2 * difference) : 0;
    out[0] = static_cast<std::uint8_t>(differs ? 255 : grey);
    out[1] = static_cast<std::uint8_t>(differs ? glow : grey);
    out[2] = static_cast<std::uint8_t>(differs ? 0 : grey);
    out[3] = 255;
}

void grow(std::optional<PixelRect>& rect, int x, int y) {
    if (!rect) rect = PixelRect{x, y, 1, 1};
    const int right = std::max(rect->x + rect->width, x + 1);
    const int bottom = std::max(rect->y + rect->height, y + 1);
    rect->x = std::min(rect->x, x);
    rect->y = std::min(rect->y, y);
    rect->width = right - rect->x;
    rect->height = bottom - rect->y;
}

bool is_compared(const Image* mask, int x, int y) {
    if (!mask) return true;
    const std::uint8_t* p = mask->at(x, y);
    return p[3] != 0 && (p[0] != 0 || p[1] != 0 || p[2] != 0);
}

}  // namespace

ImageDiff diff(const Image& actual, const Image& reference, const DiffOptions& options, const Image* mask) {
    if (mask && (mask->width != reference.width || mask->height != reference.height)) {
        throw std::invalid_argument("the mask has another size than the picture");
    }
    ImageDiff result;
    result.same_size = actual.width == reference.width && actual.height == reference.height;
    if (!result.same_size) return result;
    result.heat = Image(reference.width, reference.height);
    std::int64_t sum = 0;
    for (int y = 0; y < reference.height; ++y) {
        for (int x = 0; x < reference.width; ++x) {
            const std::uint8_t* there = reference.at(x, y);
            if (!is_compared(mask, x, y)) {
                paint_heat(result.heat.at(x, y), there, 0, false);
                continue;
            }
            const std::uint8_t* here = actual.at(x, y);
            int found = difference(here, there);
            if (options.shift > 0 && found > options.channel_tolerance) {
                found = std::max(least_difference(here, reference, x, y, options.shift),
                                 least_difference(there, actual, x, y, options.shift));
            }
            const bool differs = found > options.channel_tolerance;
            ++result.pixels;
            ++result.histogram[static_cast<std::size_t>(found)];
            sum += found;
            result.largest = std::max(result.largest, found);
            if (differs) {
                ++result.differing;
                grow(result.bounds, x, y);
            }
            paint_heat(result.heat.at(x, y), there, found, differs);
        }
    }
    if (result.pixels > 0) result.mean = static_cast<double>(sum) / static_cast<double>(result.pixels);
    result.same = static_cast<double>(result.differing) <= options.pixel_fraction * static_cast<double>(result.pixels);
    return result;
}

}  // namespace mobbscope
