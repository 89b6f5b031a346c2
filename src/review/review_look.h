/// How picture tests are looked at.
#pragma once

#include <glm/vec2.hpp>

#include <array>
#include <string_view>

namespace mobbscope::app {

/// How the pictures of a case are laid out.
enum class ReviewMode { side_by_side, golden, actual, difference, slider, blink };
struct ReviewModeWords {
    std::string_view name;   ///< for scripts
    std::string_view title;  ///< on its button
    std::string_view doc;    ///< of its command
    std::string_view shortcut;
};
inline constexpr std::array<ReviewModeWords, 6> kReviewModes{
    {{"side", "Side by side", "Shows golden, actual picture and difference beside one another.", "1"},
     {"golden", "Golden", "Shows the golden.", "2"},
     {"actual", "Actual", "Shows the picture as it is drawn now.", "3"},
     {"difference", "Difference", "Shows where the pictures differ: the brighter, the more.", "4"},
     {"slider", "Slider", "Shows the golden left of a line and the actual picture right of it; drag the line.", "5"},
     {"blink", "Blink", "Shows golden and actual picture in turn.", "6 B"}}};

enum class ReviewOrder { name, difference, outcome };
inline constexpr std::array<std::string_view, 3> kReviewOrders{"name", "difference", "outcome"};

inline constexpr double kLeastReviewZoom = 1.0 / 32;
inline constexpr double kMostReviewZoom = 64;

/// How the cases are looked at; any value may be set at any time.
struct ReviewLook {
    ReviewMode mode = ReviewMode::side_by_side;
    double blink_seconds = 0.5;  ///< that each picture stays
    double divider = 0.5;        ///< of the slider: share of what is seen of the picture, across, that shows the golden
    double zoom = 0;             ///< pixels of the window for one of the picture; 0: all of it is seen
    double fits = 1;             ///< the zoom at which all is seen, as the panel last had it
    glm::dvec2 middle{0.5};      ///< what is in the middle, as shares of width and height
    bool failed_only = false;    ///< of the list
    ReviewOrder order = ReviewOrder::name;

    double scale() const { return zoom > 0 ? zoom : fits; }
};

}  // namespace mobbscope::app
