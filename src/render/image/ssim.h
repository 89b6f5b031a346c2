/// Structural similarity of pictures, by windows.
#pragma once

#include <render/image/image.h>

namespace mobbscope {

/// The largest loss of structural similarity of any window of 8x8 pixels, 0 (all alike) .. 2: 1 - SSIM(x, y) with the
/// means, variances and covariance of each channel over the window (Wang, Bovik, Sheikh, Simoncelli: "Image quality
/// assessment: from error visibility to structural similarity", 2004, equation 13; K1 = 0.01, K2 = 0.03). Colours count
/// by their opacity. Windows stand at every second pixel. The pictures are of one size; a side below 8 is one window.
double largest_ssim_loss(const Image& a, const Image& b);

}  // namespace mobbscope
