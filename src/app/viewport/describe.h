/// What is selected or under the mouse, in words and numbers.
#pragma once

#include <app/document/selection.h>
#include <scene/drawn_agent.h>

#include <string>
#include <utility>
#include <vector>

namespace mobbscope::app {

/// What a selection is, a line each: first its name.
struct Described {
    std::string name;
    std::vector<std::pair<std::string, std::string>> facts;  ///< "time", "1.20..1.53 s"
};
Described describe(const FittedScene& fitted, const Selection& what);

/// An agent as one that is drawn, whether or not it is in the present picture.
DrawnAgent drawn_agent_of(const FittedScene& fitted, const PlacedAgent& who);

}  // namespace mobbscope::app
