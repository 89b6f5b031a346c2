/// What is measured in the picture, from one click to another.
#pragma once

#include <render/parts/measured_line.h>

#include <glm/vec3.hpp>

#include <optional>
#include <string>

namespace mobbscope::app {

struct MeasuredEnd {
    glm::dvec3 place{0};  ///< x, y in world metres, t in global seconds
    std::string what;     ///< that is there: "A, centre of sample 12"
};

struct Measuring {
    bool picks = false;  ///< the next clicks in the picture are its ends
    std::optional<MeasuredEnd> from, to;

    /// Between its ends, once there are both.
    std::optional<MeasuredLine> line() const {
        return from && to ? std::optional(MeasuredLine{from->place, to->place}) : std::nullopt;
    }
    bool is_nothing() const { return !picks && !from; }
};

class Workspace;
/// Whether places in the picture are where they are: not in a grid, nor of a disk alone.
bool can_measure(const Workspace& workspace);
/// What the picture shows.
std::optional<MeasuredLine> measured_in_view(const Workspace& workspace);

}  // namespace mobbscope::app
