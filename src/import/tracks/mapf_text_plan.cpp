// Plans of multi-agent path finding in text: "3:(1,2),(4,4)," is a step, "Agent 0: (2,1)->(2,2)" an agent.
#include <import/clip/sampling.h>
#include <import/tracks/mapf_plan.h>
#include <mobb/clip.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <unordered_set>
#include <utility>

namespace mobbscope {

namespace {

/// What a line of cells is about.
enum class LineOf : std::uint8_t { step, agent };

/// What stands before the number of a line: "Agent 0:", "t=3:", "at[3]:", "3:".
constexpr std::array<std::pair<std::string_view, LineOf>, 8> kWords{{{"", LineOf::step},
                                                                     {"t", LineOf::step},
                                                                     {"at", LineOf::step},
                                                                     {"step", LineOf::step},
                                                                     {"time", LineOf::step},
                                                                     {"timestep", LineOf::step},
                                                                     {"agent", LineOf::agent},
                                                                     {"robot", LineOf::agent}}};

/// The keys of which LaCAM's and PIBT's results begin with one.
constexpr std::string_view kFirstKeys[] = {"instance", "agents", "map_file", "solver", "solved", "starts", "solution"};

constexpr std::string_view kHint =
    "a plan in text has a line a step, '3:(1,2),(4,4),' with a cell (x, y) for each agent, below the line 'solution=', "
    "or a line an agent, 'Agent 0: (2,1)->(2,2)->' with cells (row, column)";

bool is_blank(char c) { return c == ' ' || c == '\t'; }
bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_latin_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }

std::string_view without_blanks(std::string_view text) {
    while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
    return text;
}

/// The beginning of a line of cells, and what follows it.
struct LineLabel {
    LineOf of = LineOf::step;
    std::string_view number;
    std::string_view cells;
};

/// None if the line begins otherwise.
std::optional<LineLabel> read_label(std::string_view line) {
    const std::size_t word_end =
        static_cast<std::size_t>(std::ranges::find_if_not(line, is_latin_letter) - line.begin());
    const auto* const word =
        std::ranges::find(kWords, lower(line.substr(0, word_end)), &decltype(kWords)::value_type::first);
    if (word == kWords.end()) return std::nullopt;
    std::string_view rest = without_blanks(line.substr(word_end));
    const bool in_brackets = rest.starts_with('[');
    if (!word->first.empty() && (in_brackets || rest.starts_with('=') || rest.starts_with('#'))) rest.remove_prefix(1);
    const std::size_t digits = static_cast<std::size_t>(std::ranges::find_if_not(rest, is_digit) - rest.begin());
    const std::string_view number = rest.substr(0, digits);
    rest.remove_prefix(digits);
    if (in_brackets && rest.starts_with(']')) rest.remove_prefix(1);
    rest = without_blanks(rest);
    if (number.empty() || !rest.starts_with(':')) return std::nullopt;
    return LineLabel{word->second, number, without_blanks(rest.substr(1))};
}

/// "agents=50": the key; none if the line is of another kind.
std::optional<std::string_view> key_of(std::string_view line) {
    const std::size_t end = line.find('=');
    if (end == std::string_view::npos || end == 0) return std::nullopt;
    const std::string_view key = line.substr(0, end);
    const bool is_word = std::ranges::all_of(key, [](char c) { return is_latin_letter(c) || is_digit(c) || c == '_'; });
    return is_word && is_latin_letter(key.front()) ? std::optional(key) : std::nullopt;
}

/// MAPF-LNS numbers the cells: the number of agents, then "12,13,45," for each.
bool is_list_of_cells(std::string_view line) {
    return line.ends_with(',') && is_digit(line.front()) &&
           std::ranges::all_of(line, [](char c) { return is_digit(c) || c == ','; });
}

/// Reads the cells of one line: "(1,2)", and more after commas, arrows or blanks.
class CellReader {
  public:
    CellReader(std::string_view cells, const TextLines& lines)
        : at_(cells.data()), end_(at_ + cells.size()), lines_(lines) {}

    /// The next cell; false at the end of the line.
    bool next(double& first, double& second) {
        while (at_ != end_ && is_between(*at_)) ++at_;
        if (at_ == end_) return false;
        ++count_;
        if (*at_ != '(') fail("a cell in brackets was expected, like (1,2)");
        ++at_;
        first = number();
        if (at_ == end_ || *at_ != ',') fail("a cell has two numbers, like (1,2)");
        ++at_;
        second = number();
        // Some solvers say there which way the agent looks.
        if (at_ != end_ && *at_ == ',') at_ = std::find_if(at_, end_, [](char c) { return c == ')' || c == '('; });
        if (at_ == end_ || *at_ != ')') fail("the bracket of a cell is not closed; the file may be cut off");
        ++at_;
        return true;
    }

    /// Passes over "->(4,4):12" behind a cell: where the agent is headed, and for what.
    bool pass_over_target() {
        if (end_ - at_ < 3 || at_[0] != '-' || at_[1] != '>' || at_[2] != '(') return false;
        at_ = std::find(at_, end_, ')');
        if (end_ - at_ < 2 || at_[1] != ':')
            fail("an arrow and no task after it: is this an agent's path? Then begin the line with 'Agent'");
        at_ = std::find(at_, end_, ',');
        return true;
    }

  private:
    static bool is_between(char c) { return is_blank(c) || c == ',' || c == ';' || c == '-' || c == '>' || c == '='; }

    double number() {
        while (at_ != end_ && is_blank(*at_)) ++at_;
        double value = 0;
        const char* const after = read_plain_double(at_, end_, value);
        if (after == at_ || !ends_number(after)) {
            const char* const stop = std::find_if(at_, end_, [](char c) { return c == ',' || c == ')' || c == '('; });
            const std::string_view word = trimmed({at_, stop});
            const std::optional<double> read = parse_double(word);
            if (!read) fail(in_quotes(word) + " is not a finite number; write it like 2");
            value = *read;
            at_ = stop;
        } else {
            at_ = after;
            while (at_ != end_ && is_blank(*at_)) ++at_;
        }
        if (std::abs(value) > mobb::kMaxLength) fail("a cell is beyond " + format_double(mobb::kMaxLength));
        return value;
    }

    bool ends_number(const char* at) const { return at == end_ || is_blank(*at) || *at == ',' || *at == ')'; }

    [[noreturn]] void fail(const std::string& message) const {
        lines_.fail("cell " + std::to_string(count_) + ": " + message);
    }

    const char* at_;
    const char* end_;
    const TextLines& lines_;
    std::size_t count_ = 0;
};

class TextPlanParser {
  public:
    TextPlanParser(std::string_view text, const std::string& file) : lines_(text, file), file_(file) {}

    TrackFile parse() {
        while (lines_.next()) {
            const std::string_view line = lines_.line();
            if (line.front() == '#') continue;
            if (in_tasks_ && !line.starts_with("solution=")) continue;
            if (const std::optional<LineLabel> label = read_label(line)) {
                read_line(*label);
            } else if (const std::optional<std::string_view> key = key_of(line)) {
                // PIBT lists the tasks that were done between "task=" and "solution=".
                in_tasks_ = *key == "task";
            } else if (is_list_of_cells(line) || parse_int(line)) {
                lines_.fail(
                    "cells are numbers here, as MAPF-LNS writes them, which tell where they are by the width of "
                    "the map alone; write each as (row,column): 'Agent 0: (2,1)->(2,2)->'");
            } else {
                lines_.fail("is not a line of a plan; " + std::string(kHint));
            }
        }
        if (tracks_.empty()) throw InputError(file_, "", "has no step; " + std::string(kHint));
        return finished();
    }

  private:
    void read_line(const LineLabel& label) {
        if (!of_) of_ = label.of;
        if (*of_ != label.of)
            lines_.fail("lines of agents and of steps are mixed; give one line a step, or one an agent");
        const std::optional<double> number = parse_double(label.number);
        if (!number || *number > kMaxFrame)
            lines_.fail(in_quotes(label.number) + " is beyond " + format_double(kMaxFrame));
        label.of == LineOf::step ? read_step(*number, label.cells) : read_agent(label);
    }

    void read_step(double step, std::string_view cells) {
        if (step_ && step <= *step_)
            lines_.fail("step " + format_double(step) + " stands after step " + format_double(*step_) +
                        "; put the steps in order, each once");
        CellReader reader(cells, lines_);
        std::size_t agent = 0;
        for (TrackPoint point{step, 0, 0, lines_.number()}; reader.next(point.x, point.y); ++agent) {
            has_targets_ = reader.pass_over_target() || has_targets_;
            tracks_.add(std::to_string(agent), point);
        }
        if (agent == 0) lines_.fail("the step has no cell; " + std::string(kHint));
        if (step_ && agent != agents_)
            lines_.fail("has " + counted(agent, "cell", "cells") + " but the steps before it have " +
                        std::to_string(agents_) + "; give every agent one in each step");
        agents_ = agent;
        step_ = step;
    }

    void read_agent(const LineLabel& label) {
        const std::string id(label.number);
        if (!ids_.insert(id).second) lines_.fail("agent " + id + " has a line already; leave one");
        CellReader reader(label.cells, lines_);
        TrackPoint point{0, 0, 0, lines_.number()};
        while (reader.next(point.y, point.x)) {
            tracks_.add(id, point);
            ++point.frame;
        }
        if (point.frame == 0) lines_.fail("agent " + id + " has no cell; " + std::string(kHint));
    }

    TrackFile finished() {
        TrackFile out = plan_of(tracks_, file_);
        if (*of_ == LineOf::agent) {
            out.warnings.push_back(
                {"cells of a line an agent are taken as (row, column), as EECBS and MAPF-LNS2 write them: x is the "
                 "column, y the row"});
        }
        if (has_targets_) out.warnings.push_back({"where agents are headed ('->') is ignored"});
        return out;
    }

    TextLines lines_;
    const std::string& file_;
    TrackCollector tracks_{file_};
    std::unordered_set<std::string> ids_;  ///< of lines an agent
    std::optional<LineOf> of_;
    std::optional<double> step_;  ///< the last one
    std::size_t agents_ = 0;      ///< of each step
    bool in_tasks_ = false;
    bool has_targets_ = false;
};

}  // namespace

bool looks_like_mapf_text_plan(std::string_view text) {
    text = without_mark(text);
    bool first_is_count = false;
    for (std::string_view line = take_row(text); !line.empty(); line = take_row(text)) {
        if (const auto label = read_label(line)) return label->cells.starts_with('(');
        if (const auto key = key_of(line)) return std::ranges::find(kFirstKeys, *key) != std::end(kFirstKeys);
        if (first_is_count) return is_list_of_cells(line);
        if (!parse_int(line)) return false;
        first_is_count = true;
    }
    return false;
}

TrackFile parse_mapf_text_plan(std::string_view text, const std::string& file) {
    return TextPlanParser(text, file).parse();
}

}  // namespace mobbscope
