/// How far two pictures may be apart.
#pragma once

#include <cstdint>
#include <string>

namespace mobbscope {

/// Tiles of a picture are as wide and high as this in pixels, or up to twice as much, so that they fill it.
inline constexpr int kTileSide = 32;

struct DiffOptions {
    double channel_tolerance = 3;  ///< a pixel differs if one of its channels does by more than this, 0..255
    /// Pictures differ if more of their compared pixels do than this share, 0..1, and more than `least_pixels`. The
    /// defaults let pass what rasterisers, processors and encoders alter, and hardly anything that an eye could find
    /// (docs/ci.md, "What differs between machines").
    double pixel_fraction = 20e-6;
    /// Pixels (0 or 1) by which something may be elsewhere: a pixel differs only if it is unlike all pixels of the
    /// other picture within that distance, in either direction; so a line that is missing is found, one that moved is
    /// not.
    int shift = 0;
    /// See pixel_fraction; beside a share it is at most 0.1 %, so that of a small picture not all may differ.
    std::int64_t least_pixels = 4;

    /// Pictures also differ if the mean of a channel over a tile (kTileSide) does by more than this, 0..255. Pixels
    /// beyond channel_tolerance are left out, as they are counted.
    double tile_tolerance = 0.3;

    /// The most pixels that may differ, of so many that are compared.
    std::int64_t allowed(std::int64_t pixels) const;
};

/// Sets how far channels may be off: "3", "3/255", "1.2%", or a number between 0 and 1. Means may be as far off. Throws
/// std::invalid_argument.
void set_threshold(DiffOptions& options, const std::string& text);

/// Sets how many pixels may differ: "12px", or a share of those that are compared, "20ppm", "0.1%" or "0.001". Throws
/// std::invalid_argument.
void set_allowance(DiffOptions& options, const std::string& text);

}  // namespace mobbscope
