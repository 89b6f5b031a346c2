#include <app/script/script.h>
#include <base/error.h>
#include <base/text.h>

namespace mobbscope::app {

namespace {

std::string place(int line) { return "line " + std::to_string(line); }

}  // namespace

Script Script::parse(std::string_view text, const std::string& name, ScriptOutput output,
                     std::span<const Command> known) {
    Script script;
    script.name_ = name;
    for (int line = 1; !text.empty(); ++line) {
        const std::size_t end = text.find('\n');
        const std::string_view one = trimmed(text.substr(0, end));
        text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
        try {
            const ScriptLine words = split_line(one);
            if (words.words.empty()) continue;
            if (output == ScriptOutput::refused && writes_output(words)) {
                throw std::invalid_argument(in_quotes(words.words.front()) +
                                            " has nowhere to write to here: the picture is the window at the script's "
                                            "end; remove the line");
            }
            script.statements_.push_back({line, make_action(words, known)});
        } catch (const std::invalid_argument& error) {
            throw InputError(name, place(line), error.what());
        }
    }
    return script;
}

void Script::run(Session& session, ShellHost& host, std::ostream& out) const {
    ScriptRun run{session, host, out};
    host.settle();
    for (const Statement& statement : statements_) {
        const std::string where = name_ + ": " + place(statement.line) + ": ";
        try {
            statement.act(run);
        } catch (const ExpectationError& error) {
            throw ExpectationError(where + error.what());
        } catch (const MachineError& error) {
            throw MachineError(where + error.what());
        } catch (const InputError& error) {
            throw InputError(where + error.what());
        } catch (const std::invalid_argument& error) {
            throw InputError(where + error.what());
        }
    }
}

}  // namespace mobbscope::app
