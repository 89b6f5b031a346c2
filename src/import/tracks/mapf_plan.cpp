// Plans of multi-agent path finding, as the solvers of atb033/multi_agent_path_planning write them.
#include <import/tracks/tracks.h>
#include <mobb/clip.h>

#include <yaml-cpp/yaml.h>

#include <cmath>

namespace mobbscope {

namespace {

// The YAML reader takes some hundred bytes for each of the text's; plans of ten thousand agents are smaller.
constexpr std::size_t kLargestPlan = std::size_t{64} << 20;

[[noreturn]] void fail(const std::string& file, const YAML::Mark& mark, const std::string& message) {
    throw InputError(file, mark.is_null() ? "" : at_line(mark.line + 1), message);
}

double number(const std::string& file, const YAML::Node& node, const std::string& key, double largest) {
    const std::optional<double> value = node.IsScalar() ? parse_double(node.Scalar()) : std::nullopt;
    if (!value) fail(file, node.Mark(), key + " is no finite number; write it like 2 or 0.25");
    if (std::abs(*value) > largest) fail(file, node.Mark(), key + " is beyond " + short_double(largest));
    return *value;
}

/// One "- t: 3 x: 1 y: 2".
TrackPoint read_point(const std::string& file, const YAML::Node& step) {
    if (!step.IsMap()) fail(file, step.Mark(), "a step of the plan must be a map of t, x and y");
    TrackPoint point;
    bool has_t = false, has_x = false, has_y = false;
    for (const auto& entry : step) {
        const std::string key = entry.first.IsScalar() ? entry.first.Scalar() : "";
        const auto read = [&](double& value, bool& has, double largest) {
            if (has) fail(file, entry.first.Mark(), in_quotes(key) + " stands twice in a step; leave one");
            value = number(file, entry.second, key, largest);
            has = true;
        };
        if (key == "t") read(point.frame, has_t, kMaxFrame);
        if (key == "x") read(point.x, has_x, mobb::kMaxLength);
        if (key == "y") read(point.y, has_y, mobb::kMaxLength);
    }
    if (!has_t || !has_x || !has_y) fail(file, step.Mark(), "the step lacks one of t, x and y; add it");
    point.line = step.Mark().line + 1;
    return point;
}

/// A plan of so many bytes has at most `most` steps, unless it repeats them by aliases.
TrackFile read_plan(const std::string& file, const YAML::Node& plan, std::size_t most) {
    std::optional<YAML::Node> found;
    if (plan.IsMap()) {
        for (const auto& entry : plan) {
            if (!entry.first.IsScalar() || entry.first.Scalar() != "schedule") continue;
            if (found) fail(file, entry.first.Mark(), "'schedule' stands twice; leave one");
            found = entry.second;
        }
    }
    if (!found || !found->IsMap()) {
        fail(file, plan.Mark(),
             "there is no schedule; a plan has 'schedule:', and below it a list of t, x, y for each "
             "agent");
    }
    const YAML::Node& schedule = *found;
    TrackCollector tracks;
    for (const auto& agent : schedule) {
        if (!agent.first.IsScalar() || agent.first.Scalar().empty() || !is_utf8(agent.first.Scalar()))
            fail(file, agent.first.Mark(), "an agent of the schedule needs a name");
        if (!agent.second.IsSequence())
            fail(file, agent.second.Mark(), in_quotes(agent.first.Scalar()) + " must have a list of t, x, y");
        for (const YAML::Node& step : agent.second) {
            if (most-- == 0)
                fail(file, agent.first.Mark(),
                     "there are more steps than the file can hold; write them out, without aliases");
            tracks.add(agent.first.Scalar(), read_point(file, step));
        }
    }
    if (tracks.empty()) fail(file, schedule.Mark(), "the schedule has no step; add agents with t, x, y");
    TrackFile out;
    out.format = "mapf";
    out.tracks = tracks.take(file);
    out.rate_assumption = "a step of the plan counts as one second; give dt (seconds a step) if that is wrong";
    out.unit_assumption = "a cell of the plan counts as one metre; give unit (metres a cell) if that is wrong";
    return out;
}

/// The YAML reader would leave out all but the first; its LoadAll never ends on some damaged texts.
void refuse_second_document(std::string_view text, const std::string& file) {
    constexpr const char* kBlanks = " \t\r";
    bool begun = false;
    if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);
    for (std::size_t at = 0; at < text.size();) {
        const std::string_view line = text.substr(at, text.find('\n', at) - at);
        at += line.size() + 1;
        const bool marks = line.starts_with("---") && line.find_first_not_of(kBlanks, 3) != 3;
        if (marks && begun) throw InputError(file, "", "holds several documents ('---'); leave one plan");
        const std::size_t first = line.find_first_not_of(kBlanks);
        begun = begun || marks || !(first == std::string_view::npos || line[first] == '#' || line.front() == '%');
    }
}

}  // namespace

bool looks_like_mapf_plan(std::string_view text) {
    return text.starts_with("schedule:") || text.find("\nschedule:") != std::string_view::npos;
}

TrackFile parse_mapf_plan(std::string_view text, const std::string& file) {
    if (text.size() > kLargestPlan) throw InputError(file, "", "is larger than 64 MiB; split the plan");
    if (text.find('\0') != std::string_view::npos) throw InputError(file, "", "holds a NUL byte; this is no text file");
    refuse_second_document(text, file);
    try {
        constexpr std::size_t kLeastStep = 6;  // bytes
        return read_plan(file, YAML::Load(std::string(text)), text.size() / kLeastStep);
    } catch (const YAML::Exception& error) {
        fail(file, error.mark, "is no YAML: " + cleaned(error.msg));
    }
}

}  // namespace mobbscope
