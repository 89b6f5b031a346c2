// Plans of Continuous-CBS (PathPlanning/Continuous-CBS): the XML of its log, where moves and waits take any time.
#include <import/clip/sampling.h>
#include <import/tracks/mapf_plan.h>
#include <import/tracks/xml_text.h>
#include <mobb/clip.h>

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
        TrackFile out = plan_of(std::move(tracks_), file_, std::move(spent_));
        out.warnings.push_back({"i and j of the plan are taken as row and column: x is the column, y the row"});
        return out;
    }

  private:
    void read_agent(pugi::xml_node agent) {
        Track track{std::string(xml_.text(agent, "number")), {}};
        if (!is_utf8(track.id)) xml_.fail(agent, "its number is not UTF-8 text");
        double time = 0;
        for (const pugi::xml_node section : agent.child("path").children("section")) {
            const TrackPoint from = point(section, "start_j", "start_i", time);
            if (track.points.empty()) {
                track.points.push_back(from);
            } else if (from.x != track.points.back().x || from.y != track.points.back().y) {
                xml_.fail(section, "begins where the section before does not end; check them");
            }
            const double seconds = xml_.number(section, "duration", kMaxFrame);
            if (seconds < 0) xml_.fail(section, "its duration is negative; give 0 or more");
            const TrackPoint to = point(section, "goal_j", "goal_i", time += seconds);
            if (to.frame > track.points.back().frame) {
                track.points.push_back(to);
            } else if (to.x != from.x || to.y != from.y) {
                xml_.fail(section, "goes elsewhere in no time; check its duration");
            }
            count_ += 1;
            spent_.cover(kBytesOfPoint * count_ + kBytesOfTrack * tracks_.size(), "its sections", file_);
        }
        if (track.points.empty()) xml_.fail(agent, "has no section; give its path one");
        if (!ids_.insert(track.id).second) xml_.fail(agent, in_quotes(track.id) + " is there twice; leave one");
        tracks_.push_back(std::move(track));
    }

    TrackPoint point(pugi::xml_node section, const char* x, const char* y, double time) {
        return {time, xml_.number(section, x, mobb::kMaxLength), xml_.number(section, y, mobb::kMaxLength),
                xml_.line_of(section)};
    }

    XmlText xml_;
    const std::string& file_;
    std::vector<Track> tracks_;
    std::unordered_set<std::string> ids_;
    std::size_t count_ = 0;  ///< sections
    Spent spent_;
};

}  // namespace

bool looks_like_ccbs_plan(std::string_view text) {
    return xml_root(text) == "root" && text.find("<agent") != std::string_view::npos;
}

TrackFile parse_ccbs_plan(std::string_view text, const std::string& file) { return CcbsReader(text, file).read(); }

}  // namespace mobbscope
