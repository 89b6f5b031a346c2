#include <render/image_diff.h>

#include <render/heat_map.h>

#include <algorithm>
#include <cstdlib>
#include <stdexcept>
#include <vector>

namespace mobbscope {

namespace {

/// What a channel adds to what is seen, 0..255; opacity itself is the fourth.
int seen(const std::uint8_t* pixel, int channel) {
    return channel == 3 || pixel[3] == 255 ? pixel[channel] : (pixel[channel] * pixel[3] + 127) / 255;
}

/// The largest difference of their channels, 0..255.
int difference(const std::uint8_t* a, const std::uint8_t* b) {
    int largest = 0;
    for (int c = 0; c < 4; ++c) largest = std::max(largest, std::abs(seen(a, c) - seen(b, c)));
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
    ImageDiff result;
    result.options = options;
    result.actual_size = {actual.width, actual.height};
    result.reference_size = {reference.width, reference.height};
    result.same_size = result.actual_size == result.reference_size;
    if (!result.same_size) return result;
    if (mask && (mask->width != reference.width || mask->height != reference.height)) {
        throw std::invalid_argument("the mask has another size than the picture");
    }
    std::vector<std::int16_t> differences;
    differences.reserve(reference.rgba.size() / 4);
    std::int64_t sum = 0;
    for (int y = 0; y < reference.height; ++y) {
        for (int x = 0; x < reference.width; ++x) {
            if (!is_compared(mask, x, y)) {
                differences.push_back(kNotCompared);
                continue;
            }
            const std::uint8_t* here = actual.at(x, y);
            const std::uint8_t* there = reference.at(x, y);
            int found = difference(here, there);
            if (options.shift > 0 && found > options.channel_tolerance) {
                found = std::max(least_difference(here, reference, x, y, options.shift),
                                 least_difference(there, actual, x, y, options.shift));
            }
            differences.push_back(static_cast<std::int16_t>(found));
            ++result.pixels;
            ++result.histogram[static_cast<std::size_t>(found)];
            sum += found;
            result.largest = std::max(result.largest, found);
            if (found > options.channel_tolerance) {
                ++result.differing;
                grow(result.bounds, x, y);
            }
        }
    }
    if (result.pixels > 0) result.mean = static_cast<double>(sum) / static_cast<double>(result.pixels);
    result.same = result.differing <= result.allowed();
    result.heat = heat_map(reference, differences, options.channel_tolerance);
    return result;
}

}  // namespace mobbscope
