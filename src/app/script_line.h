/// A line of a script in words.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace mobbscope::app {

/// The words of a line, and what follows the first: for statements that take all of it as it stands.
struct ScriptLine {
    std::vector<std::string> words;
    std::string rest;
};

/// Words apart from blanks; one in double quotes may hold blanks. A `#` that begins a word begins a comment. Throws
/// std::invalid_argument if a quote is not closed.
ScriptLine split_line(std::string_view line);

}  // namespace mobbscope::app
