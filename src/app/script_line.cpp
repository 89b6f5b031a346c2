#include <app/script_line.h>
#include <import/text.h>

#include <stdexcept>
#include <utility>

namespace mobbscope::app {

ScriptLine split_line(std::string_view line) {
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

}  // namespace mobbscope::app
