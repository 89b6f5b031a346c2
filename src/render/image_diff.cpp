#include <render/image_diff.h>

#include <algorithm>
#include <cstdlib>

namespace mobbscope {

namespace {

/// Equal pixels keep a ghost of the reference, so that the eye finds its place; others glow red to yellow.
void paint_heat(std::uint8_t* out, const std::uint8_t* reference, int difference, bool differs) {
    const int grey = (reference[0] + reference[1] + reference[2]) / 12;
    const int glow = differs ? std::min(255, 96 + 2 * difference) : 0;
    out[0] = static_cast<std::uint8_t>(differs ? 255 : grey);
    out[1] = static_cast<std::uint8_t>(differs ? glow : grey);
    out[2] = static_cast<std::uint8_t>(differs ? 0 : grey);
    out[3] = 255;
}

}  // namespace

ImageDiff diff(const Image& actual, const Image& reference, const DiffOptions& options) {
    ImageDiff result;
    result.same_size = actual.width == reference.width && actual.height == reference.height;
    result.pixels = static_cast<std::int64_t>(reference.width) * reference.height;
    if (!result.same_size) return result;
    result.heat = Image(reference.width, reference.height);
    for (std::size_t i = 0; i < reference.rgba.size(); i += 4) {
        int difference = 0;
        for (std::size_t c = 0; c < 4; ++c) {
            difference = std::max(difference, std::abs(int{actual.rgba[i + c]} - int{reference.rgba[i + c]}));
        }
        const bool differs = difference > options.channel_tolerance;
        result.differing += differs ? 1 : 0;
        result.largest = std::max(result.largest, difference);
        paint_heat(result.heat.rgba.data() + i, reference.rgba.data() + i, difference, differs);
    }
    result.same = static_cast<double>(result.differing) <= options.pixel_fraction * static_cast<double>(result.pixels);
    return result;
}

}  // namespace mobbscope
