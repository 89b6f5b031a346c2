#include <render/image/image_diff.h>
#include <render/image/ssim.h>

#include <algorithm>
#include <cstddef>

namespace mobbscope {

namespace {

constexpr int kWindow = 8;
constexpr int kStep = 2;

/// The pixels x .. x + width - 1, y .. y + height - 1 of both pictures.
struct Window {
    int x, y, width, height;
};

bool same_bytes(const Image& a, const Image& b, const Window& window) {
    for (int y = window.y; y < window.y + window.height; ++y) {
        const std::uint8_t* row = a.at(window.x, y);
        if (!std::equal(row, row + 4 * static_cast<std::ptrdiff_t>(window.width), b.at(window.x, y))) return false;
    }
    return true;
}

/// 1 - SSIM of one channel.
double loss_of(const Image& a, const Image& b, const Window& window, int channel) {
    constexpr double kC1 = 0.01 * 255 * 0.01 * 255;
    constexpr double kC2 = 0.03 * 255 * 0.03 * 255;
    double sum_a = 0, sum_b = 0, sum_aa = 0, sum_bb = 0, sum_ab = 0;
    for (int y = window.y; y < window.y + window.height; ++y) {
        for (int x = window.x; x < window.x + window.width; ++x) {
            const double value_a = seen_channel(a.at(x, y), channel);
            const double value_b = seen_channel(b.at(x, y), channel);
            sum_a += value_a;
            sum_b += value_b;
            sum_aa += value_a * value_a;
            sum_bb += value_b * value_b;
            sum_ab += value_a * value_b;
        }
    }
    const double count = window.width * window.height;
    const double mean_a = sum_a / count;
    const double mean_b = sum_b / count;
    const double variances = sum_aa / count - mean_a * mean_a + sum_bb / count - mean_b * mean_b;
    const double covariance = sum_ab / count - mean_a * mean_b;
    return 1 - (2 * mean_a * mean_b + kC1) * (2 * covariance + kC2) /
                   ((mean_a * mean_a + mean_b * mean_b + kC1) * (variances + kC2));
}

}  // namespace

double largest_ssim_loss(const Image& a, const Image& b) {
    const int width = std::min(kWindow, a.width);
    const int height = std::min(kWindow, a.height);
    double largest = 0;
    // The last window of a row or column ends at the picture's edge.
    for (int v = 0; v < a.height - height + kStep; v += kStep) {
        for (int u = 0; u < a.width - width + kStep; u += kStep) {
            const Window window{std::min(u, a.width - width), std::min(v, a.height - height), width, height};
            if (same_bytes(a, b, window)) continue;
            for (int channel = 0; channel < 4; ++channel) {
                largest = std::max(largest, loss_of(a, b, window, channel));
            }
        }
    }
    return largest;
}

}  // namespace mobbscope
