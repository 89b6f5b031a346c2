// Plans of the MAPF tracker (tracker.pathfinding.ai): a table whose cell is a plan, a line of moves an agent. Where the
// agents start stands in a scenario of Moving AI beside it.
#include <base/file.h>
#include <import/clip/sampling.h>
#include <import/tracks/mapf_plan.h>
#include <mobb/clip.h>

#include <algorithm>
#include <filesystem>
#include <utility>

namespace mobbscope {

namespace {

using Row = std::vector<std::string>;

bool is_plan_column(std::string_view name) { return name == "solution_plan" || name == "path"; }

/// Takes a row off a table; what is in quotes may go over lines. `line`: that of the text's beginning, moved on.
Row take_table_row(std::string_view& text, int& line) {
    Row out(1);
    bool quoted = false;
    std::size_t at = 0;
    for (; at < text.size(); ++at) {
        const char c = text[at];
        line += c == '\n' ? 1 : 0;
        if (c == '"') {
            quoted = !quoted;
        } else if (c == ',' && !quoted) {
            out.emplace_back();
        } else if (c == '\n' && !quoted) {
            ++at;
            break;
        } else if (c != '\r') {
            out.back() += c;
        }
    }
    text.remove_prefix(at);
    return out;
}

/// Where agents start, in the order of a scenario.
std::vector<TrackPoint> starts_in(const std::string& scenario) {
    constexpr std::size_t kX = 4, kY = 5;  // columns
    const std::string text = read_file(scenario);
    TextLines lines(text, scenario);
    std::vector<TrackPoint> out;
    while (lines.next()) {
        if (lines.line().starts_with("version")) continue;
        std::vector<std::string_view> words;
        for (std::string_view rest = lines.line(); !rest.empty() && words.size() <= kY;)
            words.push_back(take_word(rest, ' '));
        const std::optional<int> x = words.size() > kY ? parse_int(words[kX]) : std::nullopt;
        const std::optional<int> y = words.size() > kY ? parse_int(words[kY]) : std::nullopt;
        if (!x || !y) lines.fail("is no row of a scenario, which has a start x y in its columns 5 and 6");
        out.push_back({0, static_cast<double>(*x), static_cast<double>(*y), lines.number()});
    }
    return out;
}

class TrackerReader {
  public:
    TrackerReader(std::string_view text, const std::string& file) : text_(text), file_(file) {}

    TrackFile read() {
        const Row names = take_table_row(text_, line_);
        row_line_ = line_;
        const Row row = take_table_row(text_, line_);
        if (row.size() != names.size()) {
            fail(row_line_, "has " + counted(row.size(), "value", "values") + " but the header names " +
                                std::to_string(names.size()) + "; the file may be cut off");
        }
        if (!trimmed(text_).empty()) fail(line_, "holds a second plan; leave one");
        const auto cell = [&](std::string_view name) {
            const auto at = std::ranges::find(names, name);
            return at == names.end() ? std::string() : row[static_cast<std::size_t>(at - names.begin())];
        };
        const auto plan = std::ranges::find_if(names, is_plan_column);
        if (plan == names.end()) fail(1, "the header names no column solution_plan or path; add it");
        const std::string scenario = scenario_of(cell("map_name"), cell("scen_type"), cell("type_id"));
        std::string_view paths = row[static_cast<std::size_t>(plan - names.begin())];
        if (trimmed(paths).empty()) fail(row_line_, "the plan is empty; give one with a solution");
        const std::vector<TrackPoint> starts = starts_in(scenario);
        for (std::size_t agent = 0; !paths.empty(); ++agent) {
            const std::size_t end = std::min(paths.find('\n'), paths.size());
            if (agent == starts.size())
                fail(row_line_ + static_cast<int>(agent),
                     "has more agents than " + scenario + " has starts, " + std::to_string(starts.size()));
            read_agent(agent, starts[agent], paths.substr(0, end));
            paths.remove_prefix(std::min(end + 1, paths.size()));
        }
        TrackFile out = plan_of(tracks_, file_);
        out.warnings.push_back({"agents start where " + scenario + " says"});
        return out;
    }

  private:
    [[noreturn]] void fail(int line, const std::string& message) const {
        throw InputError(file_, at_line(line), message);
    }

    /// By what the row says, else by the file's name: map_type_id_agents.csv.
    std::string scenario_of(const std::string& map, const std::string& type, const std::string& id) const {
        std::string name = map + '-' + type + '-' + id;
        if (map.empty()) {
            name = input_stem(file_);
            if (const std::size_t agents = name.rfind('_'); agents != std::string::npos) name.resize(agents);
            std::ranges::replace(name, '_', '-');
        }
        const std::filesystem::path file = std::filesystem::path(file_).parent_path() / (name + ".scen");
        std::error_code ignored;
        if (!std::filesystem::exists(file, ignored)) {
            throw InputError(
                file_, "",
                "is a plan of the MAPF tracker, without where its agents start: put its scenario beside it, as " +
                    in_quotes(file.filename().string()));
        }
        return file.string();
    }

    void read_agent(std::size_t agent, TrackPoint at, std::string_view moves) {
        const std::string id = std::to_string(agent);
        at.line = row_line_ + static_cast<int>(agent);
        tracks_.add(id, at);
        for (const char move : moves) {
            if (move != 'w' && move != 'r' && move != 'l' && move != 'u' && move != 'd')
                fail(at.line, in_quotes({&move, 1}) + " is no move; they are u, d, l, r and w");
            at.x += move == 'r' ? 1 : move == 'l' ? -1 : 0;
            at.y += move == 'd' ? 1 : move == 'u' ? -1 : 0;
            ++at.frame;
            tracks_.add(id, at);
        }
    }

    std::string_view text_;
    const std::string& file_;
    int line_ = 1;      ///< of what is left of the text
    int row_line_ = 1;  ///< of the plan's first agent
    TrackCollector tracks_{file_};
};

}  // namespace

bool looks_like_mapf_tracker(std::string_view text) {
    int line = 1;
    const Row names = take_table_row(text, line);
    const auto has = [&names](std::string_view name) { return std::ranges::find(names, name) != names.end(); };
    return has("solution_plan") || (has("path") && (has("solution_cost") || has("agents")));
}

TrackFile parse_mapf_tracker(std::string_view text, const std::string& file) {
    return TrackerReader(text, file).read();
}

}  // namespace mobbscope
