/// What comparing two pictures found, in words.
#pragma once

#include <render/image_diff.h>

#include <string>

namespace mobbscope {

/// "different: 412 of 230400 pixels (0.18 %) differ by more than 3/255, up to 87/255, within 120x40 at (300, 12);
/// allowed: 230".
std::string diff_sentence(const ImageDiff& diff);

/// The same without the verdict at its beginning.
std::string what_differs(const ImageDiff& diff);

}  // namespace mobbscope
