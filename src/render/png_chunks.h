/// Whether the bytes of a PNG file are whole.
#pragma once

#include <string>
#include <string_view>

namespace mobbscope {

/// The most pixels that a PNG file may have to be read.
inline constexpr long long kMostPngPixels = 1LL << 27;

/// Checks the chunks and their sums up to the last. Throws InputError, naming the file and the place, if the bytes are
/// no PNG file, damaged or cut short, or if the picture has more than kMostPngPixels.
void check_png(std::string_view bytes, const std::string& file);

}  // namespace mobbscope
