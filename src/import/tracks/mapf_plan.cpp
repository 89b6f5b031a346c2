// Plans of multi-agent path finding in YAML, as the solvers of atb033/multi_agent_path_planning write them. Read event
// by event: a plan of a million steps is never in memory as a document.
#include <base/json.h>
#include <import/clip/sampling.h>
#include <import/tracks/mapf_plan.h>
#include <mobb/clip.h>

#include <yaml.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <new>
#include <optional>
#include <unordered_set>

namespace mobbscope {

namespace {

constexpr int kDeepest = 100;          // levels of what is ignored
constexpr std::size_t kLeastStep = 6;  // bytes that a step takes at least
constexpr std::string_view kMergeKey = "<<";

/// The events of one YAML document, the next one at hand.
class YamlEvents {
  public:
    /// `file` stands for the file in messages; both must outlive this.
    YamlEvents(std::string_view text, const std::string& file) : text_(text), file_(file) {
        if (yaml_parser_initialize(&parser_) == 0) throw std::bad_alloc();
        yaml_parser_set_input_string(&parser_, reinterpret_cast<const unsigned char*>(text.data()), text.size());
    }
    YamlEvents(const YamlEvents&) = delete;
    YamlEvents& operator=(const YamlEvents&) = delete;
    ~YamlEvents() {
        yaml_event_delete(&event_);
        yaml_parser_delete(&parser_);
    }

    void next() {
        yaml_event_delete(&event_);
        if (yaml_parser_parse(&parser_, &event_) == 0) fail_as_parser();
        line_ = static_cast<int>(event_.start_mark.line) + 1;
    }

    yaml_event_type_t type() const { return event_.type; }
    bool is_scalar() const { return event_.type == YAML_SCALAR_EVENT; }
    int line() const { return line_; }

    /// Of a scalar; until the next event.
    std::string_view scalar() const {
        return {reinterpret_cast<const char*>(event_.data.scalar.value), event_.data.scalar.length};
    }
    bool is_quoted() const { return event_.data.scalar.style != YAML_PLAIN_SCALAR_STYLE; }

    /// The anchor of what begins, or that an alias stands for; empty if it has none.
    std::string anchor() const {
        const yaml_char_t* name = nullptr;
        if (event_.type == YAML_SCALAR_EVENT) name = event_.data.scalar.anchor;
        if (event_.type == YAML_ALIAS_EVENT) name = event_.data.alias.anchor;
        if (event_.type == YAML_SEQUENCE_START_EVENT) name = event_.data.sequence_start.anchor;
        if (event_.type == YAML_MAPPING_START_EVENT) name = event_.data.mapping_start.anchor;
        return name ? reinterpret_cast<const char*>(name) : "";
    }

    /// Goes to the last event of the value that begins.
    void pass_over() {
        for (int depth = 0;;) {
            if (type() == YAML_SEQUENCE_START_EVENT || type() == YAML_MAPPING_START_EVENT) ++depth;
            if (type() == YAML_SEQUENCE_END_EVENT || type() == YAML_MAPPING_END_EVENT) --depth;
            if (depth == 0) return;
            if (depth > kDeepest)
                fail("is nested deeper than " + std::to_string(kDeepest) + " levels; this is not a plan");
            next();
        }
    }

    [[noreturn]] void fail(const std::string& message) const { fail(line_, message); }
    [[noreturn]] void fail(int line, const std::string& message) const {
        throw InputError(file_, at_line(line), message);
    }

  private:
    [[noreturn]] void fail_as_parser() const {
        if (parser_.error == YAML_MEMORY_ERROR) throw std::bad_alloc();
        // What is no text at all has no mark but a place in bytes.
        const bool unreadable = parser_.error == YAML_READER_ERROR;
        const std::string_view before = text_.substr(0, std::min(parser_.problem_offset, text_.size()));
        const auto line =
            unreadable ? std::ranges::count(before, '\n') : static_cast<std::ptrdiff_t>(parser_.problem_mark.line);
        std::string message = "is not YAML: " + cleaned(parser_.problem ? parser_.problem : "it cannot be read");
        if (begins_with_tab(line)) message += " (a tab; YAML is indented with blanks)";
        if (parser_.context) message += ", " + cleaned(parser_.context);
        fail(static_cast<int>(line) + 1, message);
    }

    /// Whether a line, from 0, is indented with a tab.
    bool begins_with_tab(std::ptrdiff_t line) const {
        std::string_view rest = text_;
        for (; line > 0; --line) rest.remove_prefix(std::min(rest.find('\n'), rest.size() - 1) + 1);
        return rest.substr(std::min(rest.find_first_not_of(' '), rest.size())).starts_with('\t');
    }

    std::string_view text_;
    const std::string& file_;
    yaml_parser_t parser_{};
    yaml_event_t event_{};
    int line_ = 1;
};

/// One of an agent.
struct Step {
    TrackPoint point{};
    PointDetail detail{};
    bool has_z = false;
};

class PlanReader {
  public:
    /// A plan of so many bytes has at most so many steps, unless it repeats them by aliases.
    PlanReader(std::string_view text, const std::string& file)
        : yaml_(text, file), file_(file), most_(std::min(kMaxSamples, text.size() / kLeastStep)) {}

    TrackFile read() {
        yaml_.next();
        yaml_.next();
        if (yaml_.type() == YAML_STREAM_END_EVENT) fail_without_schedule(1);
        yaml_.next();
        const int line = yaml_.line();
        if (yaml_.type() != YAML_MAPPING_START_EVENT) fail_without_schedule(line);
        bool found = false;
        for (yaml_.next(); yaml_.type() != YAML_MAPPING_END_EVENT; yaml_.next()) {
            const bool is_schedule = yaml_.is_scalar() && yaml_.scalar() == "schedule";
            if (is_schedule && found) yaml_.fail("'schedule' stands twice; leave one");
            yaml_.pass_over();
            yaml_.next();
            if (is_schedule) {
                found = true;
                read_schedule();
            } else {
                yaml_.pass_over();
            }
        }
        if (!found) fail_without_schedule(line);
        yaml_.next();
        yaml_.next();
        if (yaml_.type() == YAML_DOCUMENT_START_EVENT) yaml_.fail("holds several documents ('---'); leave one plan");
        if (tracks_.empty()) yaml_.fail(schedule_line_, "the schedule has no step; add agents with t, x, y");
        TrackFile out = plan_of(tracks_, file_);
        if (without_steps_ > 0) {
            out.warnings.push_back({counted(without_steps_, "agent has", "agents have") + " no step, such as " +
                                    in_quotes(without_step_) + "; left out"});
        }
        return out;
    }

  private:
    [[noreturn]] void fail_without_schedule(int line) const {
        yaml_.fail(line, "there is no schedule; a plan has 'schedule:', and below it a list of t, x, y for each agent");
    }

    void read_schedule() {
        schedule_line_ = yaml_.line();
        if (yaml_.type() != YAML_MAPPING_START_EVENT) fail_without_schedule(schedule_line_);
        std::unordered_set<std::string> names;
        for (yaml_.next(); yaml_.type() != YAML_MAPPING_END_EVENT; yaml_.next()) {
            if (!yaml_.is_scalar() || yaml_.scalar().empty()) yaml_.fail("an agent of the schedule needs a name");
            const std::string name(yaml_.scalar());
            if (!is_utf8(name)) yaml_.fail("an agent of the schedule needs a name");
            if (name == kMergeKey && !yaml_.is_quoted()) fail_at_merge_key();
            if (!names.insert(name).second) yaml_.fail(in_quotes(name) + " stands twice in the schedule; leave one");
            yaml_.next();
            read_agent(name);
        }
    }

    void read_agent(const std::string& name) {
        if (yaml_.type() == YAML_ALIAS_EVENT) {
            for (const Step& step : anchored(agents_)) add(name, step);
            return;
        }
        if (yaml_.type() != YAML_SEQUENCE_START_EVENT) yaml_.fail(in_quotes(name) + " must have a list of t, x, y");
        const std::string anchor = yaml_.anchor();
        std::vector<Step> steps;  // of an anchor
        bool has_step = false;
        for (yaml_.next(); yaml_.type() != YAML_SEQUENCE_END_EVENT; yaml_.next()) {
            const Step step = read_step();
            add(name, step);
            has_step = true;
            if (!anchor.empty()) steps.push_back(step);
        }
        if (!has_step && without_steps_++ == 0) without_step_ = name;
        if (!anchor.empty()) agents_[anchor] = std::move(steps);
    }

    void add(const std::string& name, const Step& step) {
        if (most_-- == 0)
            yaml_.fail("there are more steps than the file can hold, or than " + std::to_string(kMaxSamples) +
                       "; write them out, without aliases, or split the plan");
        tracks_.add(name, step.point, {}, step.has_z ? &step.detail : nullptr);
    }

    /// One "- t: 3 x: 1 y: 2"; goes to its last event.
    Step read_step() {
        if (yaml_.type() == YAML_ALIAS_EVENT) return anchored(steps_);
        if (yaml_.type() != YAML_MAPPING_START_EVENT) yaml_.fail("a step of the plan must be a map of t, x and y");
        const std::string anchor = yaml_.anchor();
        Step step;
        TrackPoint& point = step.point;
        point.line = yaml_.line();
        bool has_t = false, has_x = false, has_y = false;
        for (yaml_.next(); yaml_.type() != YAML_MAPPING_END_EVENT; yaml_.next()) {
            const std::string_view key = yaml_.is_scalar() ? yaml_.scalar() : "";
            if (key == "t") {
                read_number("t", point.frame, has_t, kMaxFrame);
            } else if (key == "x") {
                read_number("x", point.x, has_x, mobb::kMaxLength);
            } else if (key == "y") {
                read_number("y", point.y, has_y, mobb::kMaxLength);
            } else if (key == "z") {
                read_number("z", step.detail.z, step.has_z, mobb::kMaxLength);
            } else {
                if (key == kMergeKey && !yaml_.is_quoted()) fail_at_merge_key();
                yaml_.pass_over();
                yaml_.next();
                yaml_.pass_over();
            }
        }
        if (!has_t || !has_x || !has_y) yaml_.fail(point.line, "the step lacks one of t, x and y; add it");
        if (!anchor.empty()) steps_[anchor] = step;
        return step;
    }

    /// The value of the key at hand.
    void read_number(const std::string& key, double& value, bool& has, double largest) {
        if (has) yaml_.fail(in_quotes(key) + " stands twice in a step; leave one");
        has = true;
        yaml_.next();
        if (yaml_.type() == YAML_ALIAS_EVENT) {
            value = anchored(numbers_);
        } else {
            if (!yaml_.is_scalar()) fail_as_number(key);
            const std::string_view text = yaml_.scalar();
            const char* const end = text.data() + text.size();
            if (text.empty() || read_plain_double(text.data(), end, value) != end) {
                const std::optional<double> number = parse_double(text);
                if (!number) fail_as_number(key);
                value = *number;
            }
            if (const std::string anchor = yaml_.anchor(); !anchor.empty()) numbers_[anchor] = value;
        }
        if (std::abs(value) > largest) yaml_.fail(key + " is beyond " + format_double(largest));
    }

    [[noreturn]] void fail_as_number(const std::string& key) const {
        yaml_.fail(key + " is not a finite number; write it like 2 or 0.25");
    }

    [[noreturn]] void fail_at_merge_key() const { yaml_.fail("merge keys ('<<') are not read; write t, x and y out"); }

    /// What the alias at hand stands for.
    template <class Value>
    const Value& anchored(const std::map<std::string, Value>& values) const {
        const auto found = values.find(yaml_.anchor());
        if (found == values.end())
            yaml_.fail("the alias " + in_quotes("*" + yaml_.anchor()) +
                       " stands for nothing of its kind; write it out");
        return found->second;
    }

    YamlEvents yaml_;
    const std::string& file_;
    std::size_t most_;  ///< steps that may still come
    TrackCollector tracks_{file_};
    int schedule_line_ = 1;
    int without_steps_ = 0;     ///< agents
    std::string without_step_;  ///< the first of them
    // By anchor, of what stands in the schedule.
    std::map<std::string, double> numbers_;
    std::map<std::string, Step> steps_;
    std::map<std::string, std::vector<Step>> agents_;
};

}  // namespace

bool looks_like_mapf_plan(std::string_view text) {
    const std::size_t first = text.find_first_not_of(" \t\r\n\xef\xbb\xbf");
    // JSON is YAML too.
    if (first != std::string_view::npos && text[first] == '{') {
        const std::vector<JsonKey> keys = json_head(text).keys;
        const bool is_json = !keys.empty() && !keys.front().name.empty();
        return is_json ? json_head(text).has_any({"schedule"}) : text.find("schedule") != std::string_view::npos;
    }
    return text.starts_with("schedule:") || text.find("\nschedule:") != std::string_view::npos;
}

TrackFile parse_mapf_plan(std::string_view text, const std::string& file) {
    if (text.find('\0') != std::string_view::npos)
        throw InputError(file, "", "holds a NUL byte; this is not a text file");
    return PlanReader(text, file).read();
}

}  // namespace mobbscope
