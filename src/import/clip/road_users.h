/// What is usual of classes of road users: how fast they are and how much room they take.
#pragma once

#include <string_view>

namespace mobbscope {

struct RoadUser {
    std::string_view word;  ///< a part of the class's name in small letters
    double fastest;         ///< metres a second that nobody exceeds
    double radius = 0;      ///< metres: half of the length; 0: no size is usual
    double width = 0;       ///< metres; 0: it is round
    bool is_whole = false;  ///< the word stands alone, or with an s: a businessman is no bus
    bool flies = false;
};

/// The class that a name of any spelling stands for; null: none that is known.
const RoadUser* road_user(std::string_view label);

}  // namespace mobbscope
