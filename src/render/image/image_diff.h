/// Are two pictures the same, up to what rasterisers differ by?
#pragma once

#include <base/json_writer.h>
#include <render/image/diff_options.h>
#include <render/image/image.h>

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>

namespace mobbscope {

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
    bool same = false;  ///< no byte of a compared pixel differs
    /// The verdict: no more pixels than allowed differ beyond the tolerance, and no tile's mean differs beyond its own.
    bool passes = false;
    std::int64_t pixels = 0;     ///< compared: all, or those of the mask
    std::int64_t unequal = 0;    ///< of them, those that look different, by however little
    std::int64_t differing = 0;  ///< of them, those beyond the tolerance
    int largest = 0;             ///< largest difference of a channel, 0..255
    double mean = 0;             ///< of the compared pixels' differences, 0..255
    /// Compared pixels by their difference, the largest of their channels (with a shift: the least found).
    std::array<std::int64_t, 256> histogram{};
    std::optional<PixelRect> unequal_bounds{};  ///< of the unequal pixels
    std::optional<PixelRect> bounds{};          ///< of the differing pixels; without any, the tile if its mean differs
    double tile_mean = 0;                       ///< largest difference of a tile's means (DiffOptions), 0..255
    std::optional<PixelRect> tile{};            ///< that has it; none if it is 0
    Image heat;  ///< where they differ, see heat_map; empty if the sizes differ or it was left out

    double fraction() const { return pixels > 0 ? static_cast<double>(differing) / static_cast<double>(pixels) : 0; }
    /// The most pixels that may differ.
    std::int64_t allowed() const { return options.allowed(pixels); }
    bool tile_differs() const { return tile_mean > options.tile_tolerance; }
};

/// Whether ImageDiff::heat is made.
enum class HeatMap { drawn, left_out };

/// Colours count by their opacity, as they are seen: under a transparent pixel none does. `mask`: of the same size;
/// pixels that are black or transparent in it are not compared. Null: all are. Throws std::invalid_argument if the
/// pictures have one size and the mask another.
ImageDiff diff(const Image& actual, const Image& reference, const DiffOptions& options = {},
               const Image* mask = nullptr, HeatMap heat = HeatMap::drawn);

/// The same where the sizes differ: nothing is compared but them.
ImageDiff diff_of_sizes(PictureSize actual, PictureSize reference, const DiffOptions& options = {});

/// A mask. Throws InputError if it cannot be read, has another size than the picture (`picture`: its name in the
/// message), or leaves nothing to compare.
Image read_mask(const std::filesystem::path& file, PictureSize size, const std::filesystem::path& picture);

/// What a channel (0..3, the last is opacity) adds to what is seen, 0..255.
int seen_channel(const std::uint8_t* pixel, int channel);

/// Whether a mask, null: none, lets this pixel be compared.
bool is_compared(const Image* mask, int x, int y);

/// In the place of a pixel's difference: it was not compared.
inline constexpr std::int16_t kNotCompared = -1;

/// Of the reference's size, opaque. A faint grey ghost of the reference, blue where nothing was compared; pixels that
/// differ by more than the tolerance glow orange to white, the more the brighter, in a red halo that lets a single one
/// be seen in a large picture. `differences`: of each pixel, row by row, 0..255 or kNotCompared.
Image heat_map(const Image& reference, std::span<const std::int16_t> differences, double tolerance);

/// {"same", "passes", "same_size", "size_a": [w, h], "size_b", "pixels", "unequal", "failing", "fraction", "maximum",
/// "mean", "unequal_bounds", "bounds": null | {"x", "y", "width", "height"}, "histogram": [256], "threshold",
/// "allowed", "least_pixels", "allowed_pixels", "shift", "tile_mean", "tile": null | as bounds, "tile_threshold"}: A is
/// the actual picture, B the reference; differences are 0..255, `fraction` and `allowed` shares 0..1; `failing` is
/// ImageDiff::differing, the rest as there. Of pictures whose sizes differ no pixels are compared.
void write_diff(JsonWriter& out, const ImageDiff& diff);

/// "different: 412 of 230400 pixels (0.18 %) differ by more than 3/255, up to 87/255, within 120x40 at (300, 12);
/// allowed: 4"; if means differ also "; the mean within 32x36 at (64, 36) differs by 1.5/255, allowed: 0.3/255". A
/// picture that passes is "same" where no byte differs, else "passes: ...".
std::string diff_sentence(const ImageDiff& diff);

/// The same without the verdict at its beginning.
std::string what_differs(const ImageDiff& diff);

}  // namespace mobbscope
