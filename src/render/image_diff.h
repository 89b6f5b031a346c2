/// Are two pictures the same, up to what a software rasteriser differs by from one CPU maker to another?
#pragma once

#include <render/image.h>

#include <cstdint>

namespace mobbscope {

struct DiffOptions {
    int channel_tolerance = 3;      ///< a pixel differs if one of its channels does by more than this, 0..255
    double pixel_fraction = 0.001;  ///< pictures differ if more than this share of their pixels does, 0..1
};

struct ImageDiff {
    bool same_size = false;
    std::int64_t pixels = 0;     ///< of the picture
    std::int64_t differing = 0;  ///< pixels beyond the tolerance
    int largest = 0;             ///< largest difference of a channel, 0..255
    bool same = false;           ///< the verdict
    Image heat;                  ///< grey where equal, black to yellow by difference; empty if the sizes differ

    double fraction() const { return pixels > 0 ? static_cast<double>(differing) / static_cast<double>(pixels) : 0; }
};

ImageDiff diff(const Image& actual, const Image& reference, const DiffOptions& options = {});

}  // namespace mobbscope
