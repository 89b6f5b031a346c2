#include <import/clip/road_users.h>
#include <import/clip/sampling.h>
#include <import/tracks/sumo.h>
#include <import/tracks/xml_text.h>
#include <mobb/clip.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <unordered_map>

namespace mobbscope {

namespace {

constexpr std::string_view kKinds[] = {"vehicle", "person", "container"};

/// SUMO writes this for what has no place, such as a vehicle that is put elsewhere.
constexpr double kNowhere = -1073741824;
constexpr double kMostSaid = -kNowhere;  // metres; what is beyond mobb::kMaxLength is refused with its clip

class SumoTracks {
  public:
    /// `file` stands for the file in messages, and must outlive this.
    explicit SumoTracks(const std::string& file) : tracks_(file) {}

    /// `riding`: in a vehicle, which has a row of its own.
    void add(std::size_t kind, std::string_view id, const TrackPoint& point, std::string_view type, bool riding) {
        if (riding || point.x == kNowhere || point.y == kNowhere) {
            ++(riding ? riding_ : nowhere_);
            return;
        }
        // A person may be called like a vehicle.
        const auto [at, is_new] = kinds_.try_emplace(std::string(id), kind);
        const std::string name =
            at->second == kind ? std::string(id) : std::string(kKinds[kind]) + ' ' + std::string(id);
        in_milliseconds_ = in_milliseconds_ && is_in_milliseconds(point.frame);
        // A type of which nothing is known says less than the kind.
        const bool is_known = !type.starts_with("DEFAULT_") && road_user(type);
        tracks_.add(name, point, is_known ? type : kKinds[kind]);
    }

    TrackFile finish() {
        TrackFile out = tracks_.take_timed(in_milliseconds_);
        out.format = "sumo";
        if (riding_ > 0)
            out.warnings.push_back({counted(riding_, "row of somebody who rides", "rows of those who ride") +
                                    " in a vehicle are left out"});
        if (nowhere_ > 0)
            out.warnings.push_back(
                {counted(nowhere_, "row without a place is", "rows without a place are") + " left out"});
        return out;
    }

    bool empty() const { return tracks_.empty(); }

  private:
    TrackCollector tracks_;
    std::unordered_map<std::string, std::size_t> kinds_;  ///< by id, whose it was first
    bool in_milliseconds_ = true;                         ///< all times
    int riding_ = 0, nowhere_ = 0;                        ///< rows that do not count
};

class SumoTable {
  public:
    SumoTable(std::string_view text, const std::string& file) : lines_(text, file), tracks_(file) {}

    TrackFile read() {
        lines_.next();
        split();
        names_.assign(fields_.begin(), fields_.end());
        time_ = column("timestep_time");
        if (time_ == kNone) lines_.fail("the header names no column timestep_time; add it");
        for (std::size_t kind = 0; kind < std::size(kKinds); ++kind) {
            const auto of = [&](const char* what) { return column(std::string(kKinds[kind]) + what); };
            columns_[kind] = {of("_id"), of("_x"), of("_y"), of("_type"), of("_vehicle")};
            const bool all = columns_[kind].id != kNone && columns_[kind].x != kNone && columns_[kind].y != kNone;
            if (columns_[kind].id != kNone && !all)
                lines_.fail("the header names no " + std::string(kKinds[kind]) + "_x or _y; let SUMO write x and y");
        }
        while (lines_.next()) read_row();
        if (tracks_.empty()) lines_.fail("nobody has a place in any row; check the columns");
        return tracks_.finish();
    }

  private:
    static constexpr std::size_t kNone = std::string::npos;
    struct ColumnsOfKind {
        std::size_t id = kNone, x = kNone, y = kNone, type = kNone, vehicle = kNone;
    };

    std::size_t column(std::string_view name) const {
        const auto at = std::ranges::find(names_, name);
        return at == names_.end() ? kNone : static_cast<std::size_t>(at - names_.begin());
    }

    /// At its separators, which are semicolons or commas; no name of SUMO's has one.
    void split() {
        std::string_view rest = lines_.line();
        if (names_.empty()) separator_ = rest.find(';') != std::string_view::npos ? ';' : ',';
        fields_.clear();
        for (bool more = true; more;) {
            const std::size_t end = rest.find(separator_);
            fields_.push_back(trimmed(rest.substr(0, end)));
            more = end != std::string_view::npos;
            if (more) rest.remove_prefix(end + 1);
        }
        if (!names_.empty() && fields_.size() != names_.size())
            lines_.fail("has " + counted(fields_.size(), "value", "values") + " but the header names " +
                        std::to_string(names_.size()) + "; give every row all of them");
    }

    /// Of a step in which nobody is there, the time alone.
    void read_row() {
        split();
        for (std::size_t kind = 0; kind < std::size(kKinds); ++kind) {
            const ColumnsOfKind& of = columns_[kind];
            if (of.id == kNone || fields_[of.id].empty()) continue;
            if (!is_utf8(fields_[of.id])) lines_.fail("the id is not UTF-8 text; save the file as UTF-8");
            const TrackPoint point{number(time_, mobb::kMaxTime), number(of.x, kMostSaid), number(of.y, kMostSaid),
                                   lines_.number()};
            tracks_.add(kind, fields_[of.id], point, of.type == kNone ? "" : fields_[of.type],
                        of.vehicle != kNone && !fields_[of.vehicle].empty());
        }
    }

    double number(std::size_t column, double largest) const {
        const std::optional<double> value = parse_double(fields_[column]);
        if (!value || std::abs(*value) > largest)
            lines_.fail(names_[column] + " is " + in_quotes(fields_[column]) + ", which is no number up to " +
                        format_double(largest) + "; check the row");
        return *value;
    }

    TextLines lines_;
    SumoTracks tracks_;
    char separator_ = ';';
    std::vector<std::string> names_;
    std::vector<std::string_view> fields_;  ///< of the line in hand
    std::size_t time_ = kNone;
    std::array<ColumnsOfKind, std::size(kKinds)> columns_;
};

bool is_fcd(std::string_view text) { return xml_root(text) == "fcd-export"; }

TrackFile tracks_of_xml(std::string_view text, const std::string& file) {
    XmlText xml(text, file);
    SumoTracks tracks(file);
    for (const pugi::xml_node step : xml.root().children("timestep")) {
        const std::string_view said = xml.text(step, "time");
        if (said.find(':') != std::string_view::npos)
            xml.fail(step, "time is " + in_quotes(said) + ", a time of day; run SUMO without --human-readable-time");
        const double time = xml.number(step, "time", mobb::kMaxTime);
        for (const pugi::xml_node who : step.children()) {
            const auto* const kind = std::ranges::find(kKinds, std::string_view(who.name()));
            if (kind == std::end(kKinds)) continue;
            const std::string_view id = xml.text(who, "id");
            if (id.empty() || !is_utf8(id)) xml.fail(who, "its id is empty, or no UTF-8 text; give it a name");
            tracks.add(static_cast<std::size_t>(kind - kKinds), id,
                       {time, xml.number(who, "x", kMostSaid), xml.number(who, "y", kMostSaid), xml.line_of(who)},
                       who.attribute("type").value(), *who.attribute("vehicle").value() != '\0');
        }
    }
    if (tracks.empty()) xml.fail(xml.root(), "nobody has a place in any timestep; let SUMO write x and y");
    return tracks.finish();
}

}  // namespace

bool looks_like_sumo(std::string_view text) {
    if (is_fcd(text)) return true;
    text = without_mark(text);
    const std::string_view header = take_row(text);
    return header.find("timestep_time") != std::string_view::npos &&
           header.find_first_of(";,") != std::string_view::npos;
}

TrackFile parse_sumo(std::string_view text, const std::string& file) {
    return is_fcd(text) ? tracks_of_xml(text, file) : SumoTable(text, file).read();
}

}  // namespace mobbscope
