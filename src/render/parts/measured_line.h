/// What is measured between two places of a picture: how far apart they are on the floor and in time.
#pragma once

#include <render/drawlist/draw_list.h>
#include <render/drawlist/picture_options.h>

#include <glm/vec3.hpp>

#include <optional>
#include <string>
#include <string_view>

namespace mobbscope {

struct MeasuredLine {
    glm::dvec3 from{0}, to{0};  ///< x, y in world metres, t in global seconds

    double metres() const;   ///< on the floor
    double seconds() const;  ///< >= 0
    /// At which one gets from one to the other in that time, m/s; none where both are at one moment.
    std::optional<double> speed() const;
    friend bool operator==(const MeasuredLine&, const MeasuredLine&) = default;
};

/// "2.314 m, 0.533 s, 4.342 m/s"
std::string measured_words(const MeasuredLine& line);

/// "X,Y,T:X,Y,T". Throws std::invalid_argument.
MeasuredLine parse_measured_line(std::string_view text);
std::string text_of(const MeasuredLine& line);

/// The line, and in space-time its two legs, on the floor and along time, as highlights. `scale`: of line widths.
void add_measured_line(DrawList& list, const MeasuredLine& line, float scale);

/// Where the middle of the line is seen, and its words stand; none behind the eye.
std::optional<glm::vec2> middle_in_view(const DrawList& list, const MeasuredLine& line);

/// With its words beside it, out of the way of all that is written so far, or without.
void add_measure(DrawList& list, const MeasuredLine& line, const Metrics& metrics, bool has_words);

}  // namespace mobbscope
