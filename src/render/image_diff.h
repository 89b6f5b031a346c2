/// Are two pictures the same, up to what rasterisers differ by?
#pragma once

#include <render/image.h>

#include <array>
#include <cstdint>
#include <optional>

namespace mobbscope {

struct DiffOptions {
    double channel_tolerance = 3;   ///< a pixel differs if one of its channels does by more than this, 0..255
    double pixel_fraction = 0.001;  ///< pictures differ if more than this share of the compared pixels does, 0..1
    /// Pixels (0 or 1) by which something may be elsewhere: a pixel differs only if it is unlike all pixels of the
    /// other picture within that distance, in either direction; so a line that is missing is found, one that moved is
    /// not.
    int shift = 0;
};

/// Pixels x .. x + width - 1, y .. y + height - 1, from the upper left corner.
struct PixelRect {
    int x = 0, y = 0, width = 0, height = 0;
    friend bool operator==(const PixelRect&, const PixelRect&) = default;
};

struct ImageDiff {
    DiffOptions options;        ///< what was asked for
    PictureSize actual_size{};  ///< of the two pictures
    PictureSize reference_size{};
    bool same_size = false;
    bool same = false;           ///< the verdict
    std::int64_t pixels = 0;     ///< compared: all, or those of the mask
    std::int64_t differing = 0;  ///< of them beyond the tolerance
    int largest = 0;             ///< largest difference of a channel, 0..255
    double mean = 0;             ///< of the compared pixels' differences, 0..255
    /// Compared pixels by their difference, the largest of their channels (with a shift: the least found).
    std::array<std::int64_t, 256> histogram{};
    std::optional<PixelRect> bounds{};  ///< of the differing pixels
    Image heat;                         ///< where they differ, see heat_map.h; empty if the sizes differ

    double fraction() const { return pixels > 0 ? static_cast<double>(differing) / static_cast<double>(pixels) : 0; }
    /// The most pixels that may differ.
    std::int64_t allowed() const {
        // Rounding must not take a pixel off what is a whole number.
        return static_cast<std::int64_t>(options.pixel_fraction * static_cast<double>(pixels) + 1e-6);
    }
};

/// Colours count by their opacity, as they are seen: under a transparent pixel none does. `mask`: of the same size;
/// pixels that are black or transparent in it are not compared. Null: all are. Throws std::invalid_argument if the
/// pictures have one size and the mask another.
ImageDiff diff(const Image& actual, const Image& reference, const DiffOptions& options = {},
               const Image* mask = nullptr);

}  // namespace mobbscope
