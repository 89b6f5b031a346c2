/// Are two pictures the same, up to what rasterisers differ by?
#pragma once

#include <base/json_writer.h>
#include <render/image/image.h>

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

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

/// In the place of a pixel's difference: it was not compared.
inline constexpr std::int16_t kNotCompared = -1;

/// Of the reference's size, opaque. A faint grey ghost of the reference, blue where nothing was compared; pixels that
/// differ by more than the tolerance glow orange to white, the more the brighter, in a red halo that lets a single one
/// be seen in a large picture. `differences`: of each pixel, row by row, 0..255 or kNotCompared.
Image heat_map(const Image& reference, std::span<const std::int16_t> differences, double tolerance);

/// {"same", "same_size", "size_a": [w, h], "size_b", "pixels", "failing", "fraction", "maximum", "mean",
/// "bounds": null | {"x", "y", "width", "height"}, "histogram": [256], "threshold", "allowed", "shift"}: A is the
/// actual picture, B the reference; differences are 0..255, shares 0..1; the rest as in ImageDiff. Of pictures whose
/// sizes differ no pixels are compared.
void write_diff(JsonWriter& out, const ImageDiff& diff);

/// "different: 412 of 230400 pixels (0.18 %) differ by more than 3/255, up to 87/255, within 120x40 at (300, 12);
/// allowed: 230".
std::string diff_sentence(const ImageDiff& diff);

/// The same without the verdict at its beginning.
std::string what_differs(const ImageDiff& diff);

}  // namespace mobbscope
