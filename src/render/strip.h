/// Pictures side by side, without words.
#pragma once

#include <render/image.h>

#include <span>

namespace mobbscope {

/// Three of the largest pictures that are read, and what is between them.
inline constexpr long long kMostStripPixels = 500'000'000;

/// From left to right, their upper edges level, a few grey pixels between them and below shorter ones; pictures keep
/// their pixels. At least one. Throws std::invalid_argument if that is more than kMostStripPixels.
Image make_strip(std::span<const Image* const> pictures);

}  // namespace mobbscope
