/// How many there are of which value, with their colours and the range that these are spread over.
#pragma once

#include <app/ui/ui.h>
#include <base/color.h>

#include <cstddef>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace mobbscope::app {

/// Places along it are from 0 at its left end to 1.
struct ValueHistogram {
    std::string mark;                            ///< `mark`.from, .to and .auto are its handles and button
    std::vector<std::size_t> counts;             ///< in equal parts of its length
    std::function<Rgba(float place)> color;      ///< that values there have
    float from = 0, to = 1;                      ///< where the handles stand
    std::function<std::string(float place)> at;  ///< the value there, for the tooltip
    std::string from_text, to_text;              ///< the values of the handles
    bool chosen = false;                         ///< by somebody: it can go back to all values
};

/// What somebody does with its handles.
struct HistogramChange {
    enum class Kind { none, dragged, automatic } kind = Kind::none;
    std::pair<float, float> ends{};  ///< where they are dragged to
};
/// At the cursor of the current ImGui window, so many pixels wide.
HistogramChange value_histogram(Ui& ui, const ValueHistogram& shown, float width);
/// Pixels that it takes downwards.
float histogram_height(const Ui& ui);

}  // namespace mobbscope::app
