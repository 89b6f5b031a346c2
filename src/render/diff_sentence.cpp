#include <render/diff_sentence.h>

#include <import/text.h>

#include <charconv>
#include <cmath>

namespace mobbscope {

namespace {

std::string in_words(PictureSize size) { return std::to_string(size.width) + 'x' + std::to_string(size.height); }

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

std::string what_differs(const ImageDiff& diff) {
    if (!diff.same_size) {
        return "the sizes are " + in_words(diff.actual_size) + " and " + in_words(diff.reference_size);
    }
    const std::string all = std::to_string(diff.pixels);
    const std::string beyond = " by more than " + level(diff.options.channel_tolerance);
    if (diff.largest == 0) return "none of " + all + " pixels differs";
    if (!diff.bounds) {
        return "none of " + all + " pixels differs" + beyond + ", the most by " + level(diff.largest);
    }
    const PixelRect& at = *diff.bounds;
    const std::int64_t allowed = diff.allowed();
    return std::to_string(diff.differing) + " of " + all + " pixels (" + percent(diff.fraction()) + ") " +
           (diff.differing == 1 ? "differs" : "differ") + beyond + ", up to " + level(diff.largest) + ", within " +
           in_words({at.width, at.height}) + " at (" + std::to_string(at.x) + ", " + std::to_string(at.y) +
           "); allowed: " + std::to_string(allowed);
}

std::string diff_sentence(const ImageDiff& diff) { return (diff.same ? "same: " : "different: ") + what_differs(diff); }

}  // namespace mobbscope
