#include <render/heat_map.h>

#include <glm/common.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

namespace mobbscope {

namespace {

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
    constexpr float kAside = 1;
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
        take(x, y, x - back, y, kAside);
        take(x, y, x, y - back, kAside);
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

}  // namespace

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

}  // namespace mobbscope
