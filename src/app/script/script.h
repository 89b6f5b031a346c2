/// Scripts that work the window: commands, mouse and keys, pictures, and what is expected of the state. One statement a
/// line; `#` begins a comment; a word with blanks stands in double quotes. Places are X Y, in pixels of the window from
/// its upper left corner, or the NAME of a widget (Marks), meaning its middle.
///
///     run COMMAND [ARGUMENT...]        a command of the table; the rest of the line is its argument
///     move PLACE
///     click PLACE [left|right|middle|double]
///     drag X1 Y1 X2 Y2 [left|right|middle]
///     drag NAME DX DY [left|right|middle]
///     scroll PLACE N                   notches; N > 0 is away from the person
///     key CHORD                        "Ctrl+Shift+S"
///     type TEXT                        the rest of the line
///     drop FILE...                     files and folders onto the window
///     frames N
///     size WxH
///     picture FILE.png                 the whole window
///     viewport FILE.png                the picture in it with what is selected, as `render` draws it
///     state [FILE.json]                the state (state_json.h), to standard output or a file
///     expect POINTER VALUE             RFC 6901 into the state, and JSON; numbers agree to 1e-9 of their size. What is
///     expect POINTER != VALUE          not there is null
///     expect POINTER ~ NUMBER TOLERANCE
///     until SECONDS POINTER VALUE      like expect, but runs frames until it holds, at most so long; and with != and ~
///     until SECONDS NAME               ... until there is a widget of that name
///     marks [FILE.txt]                 names and rectangles of widgets, to standard output or a file
///     wait SECONDS
#pragma once

#include <app/commands/command.h>
#include <app/script/script_statements.h>

#include <ostream>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace mobbscope::app {

/// Whether a script may hold statements that write: `picture`, `viewport`, `state` and `marks`. What the commands that
/// it runs may write is the session's (Session::may_write).
enum class ScriptOutput { allowed, refused };

class Script {
  public:
    /// `name` stands for the file in messages. Throws InputError naming the line of the first statement that is none,
    /// or is refused. `known`: the commands of the session that it will work.
    static Script parse(std::string_view text, const std::string& name, ScriptOutput output = ScriptOutput::allowed,
                        std::span<const Command> known = commands());

    /// Runs it to its end. Throws ExpectationError; InputError if a statement cannot be done; MachineError; each names
    /// the line.
    void run(Session& session, ShellHost& host, std::ostream& out) const;

  private:
    struct Statement {
        int line = 0;
        ScriptAction act;
    };
    std::string name_;
    std::vector<Statement> statements_;
};

}  // namespace mobbscope::app
