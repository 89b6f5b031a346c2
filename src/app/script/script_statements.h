/// The statements of scripts, one maker each.
#pragma once

#include <app/session/session.h>
#include <app/window/shell.h>
#include <base/text.h>

#include <functional>
#include <ostream>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

namespace mobbscope::app {

/// A script expected something else. what() says where and what is there.
class ExpectationError : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

/// What a script works on.
struct ScriptRun {
    Session& session;
    ShellHost& host;
    std::ostream& out;
    bool clicked = false;  ///< a click may still be the first half of a double click
};

using ScriptAction = std::function<void(ScriptRun&)>;

/// Throws std::invalid_argument, in words, if it is no statement. `known`: the commands that it may run.
ScriptAction make_action(const ScriptLine& line, std::span<const Command> known);

/// Whether it is a statement that writes a file or prints.
bool writes_output(const ScriptLine& line);

}  // namespace mobbscope::app
