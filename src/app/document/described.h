/// What is selected, under the mouse and the like, in words and numbers.
#pragma once

#include <app/document/selection.h>
#include <app/document/workspace.h>
#include <scene/drawn_agent.h>

#include <map>
#include <string>
#include <utility>
#include <vector>

namespace mobbscope::app {

/// What a selection is, a line each: first its name.
struct Described {
    std::string name;
    std::vector<std::pair<std::string, std::string>> facts;  ///< "time", "1.20..1.53 s"
    std::map<std::string, std::vector<double>> exact{};      ///< by fact: its numbers with all digits, in order
};
/// Of nothing, nothing.
Described describe(const Workspace& workspace, const Selection& what);

/// A line for the name and one for each fact, its value behind a tab.
std::string lines_of(const Described& what);

/// An agent with its tree, in no colour.
DrawnAgent drawn_agent_of(const FittedScene& fitted, const PlacedAgent& who);

}  // namespace mobbscope::app
