// Plans of Continuous-CBS (PathPlanning/Continuous-CBS): the XML of its log, where moves and waits take any time.
#include <import/clip/sampling.h>
#include <import/tracks/mapf_plan.h>
#include <import/tracks/xml_text.h>
#include <mobb/clip.h>

#include <algorithm>
#include <string>
#include <unordered_set>
#include <utility>

namespace mobbscope {

namespace {

class CcbsReader {
  public:
    CcbsReader(std::string_view text, const std::string& file) : xml_(text, file), file_(file) {}

    TrackFile read() {
        const pugi::xml_node log = xml_.root().child("log");
        if (!log) {
            xml_.fail(xml_.root(),
                      "has no log: is this the task for Continuous-CBS? Give the log that it writes, whose name ends "
                      "with _log.xml");
        }
        for (const pugi::xml_node agent : log.children("agent")) read_agent(agent);
        if (tracks_.empty()) xml_.fail(log, "has no agent with a path; was a solution found?");
        TrackFile out = plan_of(tracks_, file_);
        out.warnings.push_back({"i and j of the plan are taken as row and column: x is the column, y the row"});
        return out;
    }

  private:
    void read_agent(pugi::xml_node agent) {
        const std::string id(xml_.text(agent, "number"));
        if (!is_utf8(id)) xml_.fail(agent, "its number is not UTF-8 text");
        if (!ids_.insert(id).second) xml_.fail(agent, in_quotes(id) + " is there twice; leave one");
        TrackPoint last{-1};
        for (const pugi::xml_node section : agent.child("path").children("section")) {
            const TrackPoint from = point(section, "start_j", "start_i", std::max(last.frame, 0.0));
            if (last.frame < 0) {
                tracks_.add(id, from);
            } else if (from.x != last.x || from.y != last.y) {
                xml_.fail(section, "begins where the section before does not end; check them");
            }
            const double seconds = xml_.number(section, "duration", kMaxFrame);
            if (seconds < 0) xml_.fail(section, "its duration is negative; give 0 or more");
            last = point(section, "goal_j", "goal_i", from.frame + seconds);
            if (last.frame > from.frame) {
                tracks_.add(id, last);
            } else if (last.x != from.x || last.y != from.y) {
                xml_.fail(section, "goes elsewhere in no time; check its duration");
            }
        }
        if (last.frame < 0) xml_.fail(agent, "has no section; give its path one");
    }

    TrackPoint point(pugi::xml_node section, const char* x, const char* y, double time) {
        return {time, xml_.number(section, x, mobb::kMaxLength), xml_.number(section, y, mobb::kMaxLength),
                xml_.line_of(section)};
    }

    XmlText xml_;
    const std::string& file_;
    TrackCollector tracks_{file_};
    std::unordered_set<std::string> ids_;
};

}  // namespace

bool looks_like_ccbs_plan(std::string_view text) {
    return xml_root(text) == "root" && text.find("<agent") != std::string_view::npos;
}

TrackFile parse_ccbs_plan(std::string_view text, const std::string& file) { return CcbsReader(text, file).read(); }

}  // namespace mobbscope
