#include <app/script.h>
#include <import/error.h>
#include <import/text.h>

#include <optional>
#include <utility>

namespace mobbscope::app {

namespace {

/// Words apart from blanks; one in double quotes may hold blanks. A `#` that begins a word begins a comment.
ScriptLine split(std::string_view line) {
    ScriptLine out;
    std::size_t at = 0;
    std::size_t behind_first = line.size();
    while (true) {
        while (at < line.size() && (line[at] == ' ' || line[at] == '\t')) ++at;
        if (at == line.size() || line[at] == '#') {
            if (behind_first < at) out.rest = trimmed(line.substr(behind_first, at - behind_first));
            return out;
        }
        std::string word;
        if (line[at] == '"') {
            const std::size_t close = line.find('"', at + 1);
            if (close == std::string_view::npos) throw std::invalid_argument("a quote is not closed");
            word = line.substr(at + 1, close - at - 1);
            at = close + 1;
        } else {
            const std::size_t begin = at;
            while (at < line.size() && line[at] != ' ' && line[at] != '\t') ++at;
            word = line.substr(begin, at - begin);
        }
        out.words.push_back(std::move(word));
        if (out.words.size() == 1) behind_first = at;
    }
}

std::string place(int line) { return "line " + std::to_string(line); }

}  // namespace

Script Script::parse(std::string_view text, const std::string& name, ScriptOutput output) {
    Script script;
    script.name_ = name;
    for (int line = 1; !text.empty(); ++line) {
        const std::size_t end = text.find('\n');
        const std::string_view one = trimmed(text.substr(0, end));
        text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
        try {
            const ScriptLine words = split(one);
            if (words.words.empty()) continue;
            if (output == ScriptOutput::refused && writes_output(words)) {
                throw std::invalid_argument(in_quotes(words.words.front()) +
                                            " has nowhere to write to here: the picture is the window at the script's "
                                            "end; remove the line");
            }
            script.statements_.push_back({line, make_action(words)});
        } catch (const std::invalid_argument& error) {
            throw InputError(name, place(line), error.what());
        }
    }
    return script;
}

void Script::run(Session& session, Stage& stage, std::ostream& out) const {
    ScriptRun run{session, stage, out};
    stage.settle();
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
