#include <base/error.h>
#include <base/text.h>
#include <render/image/image_diff.h>
#include <render/image/png.h>

#include <glm/common.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <stdexcept>
#include <vector>

namespace mobbscope {

namespace {

/// The largest difference of their channels, 0..255.
int difference(const std::uint8_t* a, const std::uint8_t* b) {
    int largest = 0;
    for (int c = 0; c < 4; ++c) largest = std::max(largest, std::abs(seen_channel(a, c) - seen_channel(b, c)));
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

/// What is within the tolerance may lean to one side: sets the tile whose mean differs most. Tiles of which less than
/// half of kTileSide squared is compared are too small for a mean.
void find_tile(ImageDiff& result, const Image& actual, const Image& reference,
               std::span<const std::int16_t> differences) {
    const int columns = std::max(1, reference.width / kTileSide), rows = std::max(1, reference.height / kTileSide);
    for (int tile = 0; tile < columns * rows; ++tile) {
        const auto edge = [](int size, int index, int tiles) {
            return static_cast<int>(std::int64_t{size} * index / tiles);
        };
        const int column = tile % columns, left = edge(reference.width, column, columns);
        const int right = edge(reference.width, column + 1, columns);
        const int row = tile / columns, top = edge(reference.height, row, rows);
        const int bottom = edge(reference.height, row + 1, rows);
        std::array<int, 4> sums{};
        int pixels = 0;
        for (int y = top; y < bottom; ++y) {
            const std::size_t first = static_cast<std::size_t>(y) * static_cast<std::size_t>(reference.width);
            for (int x = left; x < right; ++x) {
                const int found = differences[first + static_cast<std::size_t>(x)];
                if (found == kNotCompared) continue;
                ++pixels;
                if (found == 0) continue;
                const std::uint8_t *here = actual.at(x, y), *there = reference.at(x, y);
                const int unshifted = result.options.shift > 0 ? difference(here, there) : found;
                if (unshifted > result.options.channel_tolerance) continue;
                for (int c = 0; c < 4; ++c)
                    sums[static_cast<std::size_t>(c)] += seen_channel(here, c) - seen_channel(there, c);
            }
        }
        if (2 * pixels < kTileSide * kTileSide) continue;
        for (const int sum : sums) {
            const double mean = static_cast<double>(std::abs(sum)) / pixels;
            if (mean <= result.tile_mean) continue;
            result.tile_mean = mean;
            result.tile = {left, top, right - left, bottom - top};
        }
    }
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

bool leaves_nothing(const Image& mask) {
    for (int y = 0; y < mask.height; ++y) {
        for (int x = 0; x < mask.width; ++x) {
            if (is_compared(&mask, x, y)) return false;
        }
    }
    return true;
}

using HeatColor = glm::vec3;  // 0..255

constexpr HeatColor kHalo{190, 18, 40};
constexpr HeatColor kWeak{255, 110, 0};
constexpr HeatColor kMedium{255, 214, 60};
constexpr HeatColor kStrong{255, 255, 255};
constexpr HeatColor kSkipped{14, 24, 62};
constexpr float kGhost = 0.28f;  // brightness of the reference
constexpr float kHaloStrength = 0.7f;

/// How far the halo of a pixel reaches: the same share of every picture.
float halo_reach(const Image& image) {
    return std::max(4.0f, static_cast<float>(std::max(image.width, image.height)) / 120);
}

/// The distance in pixels to the nearest pixel that differs, within 8 %: two sweeps, each from the neighbours that the
/// sweep has passed.
std::vector<float> distances(int width, int height, std::span<const std::int16_t> differences, double tolerance) {
    constexpr float kFar = 1e9f;
    constexpr float kCopyDistance = 1;
    constexpr float kAcross = 1.41421356f;
    std::vector<float> out(differences.size());
    for (std::size_t i = 0; i < out.size(); ++i) out[i] = differences[i] > tolerance ? 0 : kFar;
    const auto take = [&](int x, int y, int u, int v, float step) {
        if (u < 0 || u >= width || v < 0 || v >= height) return;
        const auto index = [&](int column, int row) {
            return static_cast<std::size_t>(row) * static_cast<std::size_t>(width) + static_cast<std::size_t>(column);
        };
        float& here = out[index(x, y)];
        here = std::min(here, out[index(u, v)] + step);
    };
    const auto sweep_pixel = [&](int x, int y, int back) {
        take(x, y, x - back, y, kCopyDistance);
        take(x, y, x, y - back, kCopyDistance);
        take(x, y, x - back, y - back, kAcross);
        take(x, y, x + back, y - back, kAcross);
    };
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) sweep_pixel(x, y, 1);
    }
    for (int y = height - 1; y >= 0; --y) {
        for (int x = width - 1; x >= 0; --x) sweep_pixel(x, y, -1);
    }
    return out;
}

HeatColor ghost(const std::uint8_t* pixel) {
    const float luminance = 0.299f * pixel[0] + 0.587f * pixel[1] + 0.114f * pixel[2];
    return HeatColor(12 + kGhost * luminance * pixel[3] / 255);
}

/// The colour of a difference beyond the tolerance.
HeatColor glow(int difference, double tolerance) {
    const double beyond = (difference - tolerance) / std::max(1.0, 255 - tolerance);
    // The eye tells small differences apart better than large ones.
    const auto t = static_cast<float>(std::sqrt(std::clamp(beyond, 0.0, 1.0)));
    return t < 0.5f ? glm::mix(kWeak, kMedium, 2 * t) : glm::mix(kMedium, kStrong, 2 * t - 1);
}

void write_size(JsonWriter& out, const char* key, PictureSize size) {
    out.values(key, std::array{size.width, size.height});
}

void write_bounds(JsonWriter& out, const char* key, const std::optional<PixelRect>& bounds) {
    if (!bounds) return out.member(key, std::optional<int>());
    out.begin_object(key, JsonWriter::Layout::row);
    out.member("x", bounds->x);
    out.member("y", bounds->y);
    out.member("width", bounds->width);
    out.member("height", bounds->height);
    out.end_object();
}

/// "0.18 %", "13.8 %"; 100 % only if it is all.
std::string percent(double share) {
    const double value = 100 * share;
    if (value >= 10) return brief(std::floor(10 * value) / 10) + " %";
    char buffer[32];
    const auto [end, error] = std::to_chars(buffer, buffer + sizeof buffer, value, std::chars_format::general, 2);
    return std::string(buffer, end) + " %";
}

std::string level(double value) { return brief(value) + "/255"; }

}  // namespace

int seen_channel(const std::uint8_t* pixel, int channel) {
    return channel == 3 || pixel[3] == 255 ? pixel[channel] : (pixel[channel] * pixel[3] + 127) / 255;
}

bool is_compared(const Image* mask, int x, int y) {
    if (!mask) return true;
    const std::uint8_t* p = mask->at(x, y);
    return p[3] != 0 && (p[0] != 0 || p[1] != 0 || p[2] != 0);
}

Image read_mask(const std::filesystem::path& file, PictureSize size, const std::filesystem::path& picture) {
    Image mask = read_png(file);
    const PictureSize of_mask{mask.width, mask.height};
    if (of_mask != size) {
        throw InputError(file.string(), "",
                         "the mask has " + size_word(of_mask) + " pixels and " + in_quotes(picture.string()) + ' ' +
                             size_word(size) + "; make them one size");
    }
    if (leaves_nothing(mask)) {
        throw InputError(file.string(), "", "the mask leaves nothing to compare; paint white what is to be compared");
    }
    return mask;
}

ImageDiff diff_of_sizes(PictureSize actual, PictureSize reference, const DiffOptions& options) {
    ImageDiff result;
    result.options = options;
    result.actual_size = actual;
    result.reference_size = reference;
    result.same_size = actual == reference;
    return result;
}

ImageDiff diff(const Image& actual, const Image& reference, const DiffOptions& options, const Image* mask,
               HeatMap heat) {
    ImageDiff result = diff_of_sizes({actual.width, actual.height}, {reference.width, reference.height}, options);
    if (!result.same_size) return result;
    if (mask && (mask->width != reference.width || mask->height != reference.height)) {
        throw std::invalid_argument("the mask has another size than the picture");
    }
    std::vector<std::int16_t> differences;
    differences.reserve(reference.rgba.size() / 4);
    std::int64_t sum = 0;
    result.same = true;
    for (int y = 0; y < reference.height; ++y) {
        for (int x = 0; x < reference.width; ++x) {
            if (!is_compared(mask, x, y)) {
                differences.push_back(kNotCompared);
                continue;
            }
            const std::uint8_t* here = actual.at(x, y);
            const std::uint8_t* there = reference.at(x, y);
            result.same = result.same && std::equal(here, here + 4, there);
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
            if (found > 0) {
                ++result.unequal;
                grow(result.unequal_bounds, x, y);
            }
            if (found > options.channel_tolerance) {
                ++result.differing;
                grow(result.bounds, x, y);
            }
        }
    }
    if (result.pixels > 0) result.mean = static_cast<double>(sum) / static_cast<double>(result.pixels);
    if (result.unequal > 0) find_tile(result, actual, reference, differences);
    result.passes = result.differing <= result.allowed() && !result.tile_differs();
    if (result.tile_differs() && !result.bounds) result.bounds = result.tile;
    if (heat == HeatMap::drawn) {
        // A mean differs by all that is unequal.
        result.heat = heat_map(reference, differences, result.tile_differs() ? 0 : options.channel_tolerance);
    }
    return result;
}

Image heat_map(const Image& reference, std::span<const std::int16_t> differences, double tolerance) {
    const std::vector<float> away = distances(reference.width, reference.height, differences, tolerance);
    const float reach = halo_reach(reference);
    Image out(reference.width, reference.height);
    for (std::size_t i = 0; i < differences.size(); ++i) {
        HeatColor color = ghost(reference.rgba.data() + 4 * i);
        if (differences[i] == kNotCompared) color = kSkipped + 0.5f * color;
        if (differences[i] > tolerance) {
            color = glow(differences[i], tolerance);
        } else if (away[i] < reach) {
            color = glm::mix(color, kHalo, kHaloStrength * (1 - away[i] / reach));
        }
        for (int c = 0; c < 3; ++c) {
            out.rgba[4 * i + static_cast<std::size_t>(c)] = static_cast<std::uint8_t>(std::lround(color[c]));
        }
        out.rgba[4 * i + 3] = 255;
    }
    return out;
}

void write_diff(JsonWriter& out, const ImageDiff& diff) {
    out.begin_object();
    out.members("same", diff.same, "passes", diff.passes, "same_size", diff.same_size);
    write_size(out, "size_a", diff.actual_size);
    write_size(out, "size_b", diff.reference_size);
    out.members("pixels", diff.pixels, "unequal", diff.unequal, "failing", diff.differing);
    out.members("fraction", diff.fraction(), "maximum", diff.largest, "mean", diff.mean);
    write_bounds(out, "unequal_bounds", diff.unequal_bounds);
    write_bounds(out, "bounds", diff.bounds);
    out.values("histogram", diff.histogram);
    const DiffOptions& options = diff.options;
    out.members("threshold", options.channel_tolerance, "allowed", options.pixel_fraction);
    out.members("least_pixels", options.least_pixels, "allowed_pixels", diff.allowed(), "shift", options.shift);
    out.member("tile_mean", diff.tile_mean);
    write_bounds(out, "tile", diff.tile);
    out.member("tile_threshold", options.tile_tolerance);
    out.end_object();
}

std::string what_differs(const ImageDiff& diff) {
    if (!diff.same_size) {
        return "the sizes are " + size_word(diff.actual_size) + " and " + size_word(diff.reference_size);
    }
    const std::string all = std::to_string(diff.pixels);
    const std::string beyond = " by more than " + level(diff.options.channel_tolerance);
    const auto plural = [](std::int64_t count) { return count == 1 ? "differs" : "differ"; };
    const auto within = [](const PixelRect& at) {
        return " within " + size_word({at.width, at.height}) + " at (" + std::to_string(at.x) + ", " +
               std::to_string(at.y) + ")";
    };
    if (diff.same) return "none of " + all + " pixels differs";
    if (diff.unequal == 0) {
        return "none of " + all + " pixels looks different; " +
               (diff.options.shift > 0 ? "something lies a pixel aside" : "colours under transparent ones differ");
    }
    std::string out;
    if (diff.differing == 0) {
        out = "none of " + all + " pixels differs" + beyond + "; " + std::to_string(diff.unequal) + ' ' +
              plural(diff.unequal) + " by up to " + level(diff.largest) + ',' + within(*diff.unequal_bounds);
    } else {
        out = std::to_string(diff.differing) + " of " + all + " pixels (" + percent(diff.fraction()) + ") " +
              plural(diff.differing) + beyond + ", up to " + level(diff.largest) + ',' + within(*diff.bounds) +
              "; allowed: " + std::to_string(diff.allowed());
    }
    if (!diff.tile_differs()) return out;
    return out + "; the mean" + within(*diff.tile) + " differs by " + figure(diff.tile_mean, 3) +
           "/255, allowed: " + level(diff.options.tile_tolerance);
}

std::string diff_sentence(const ImageDiff& diff) {
    return (diff.same ? "same: " : diff.passes ? "passes: " : "different: ") + what_differs(diff);
}

}  // namespace mobbscope
