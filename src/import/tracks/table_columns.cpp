// Which columns of a table are which: by their names, by the option columns, and of programs whose tables are known.
#include <base/text.h>
#include <import/tracks/table_columns.h>

#include <algorithm>
#include <array>
#include <span>
#include <stdexcept>
#include <utility>

namespace mobbscope {

namespace {

/// Boxes, of which people want the centres: by their words, with what x and y are made of.
struct BoxColumns {
    std::array<std::string_view, 4> words;
    bool has_middles;             ///< the last two are the other ends, else lengths
    std::string_view not_with{};  ///< a word that makes it something else
};
constexpr BoxColumns kBoxes[] = {
    {{"x", "y", "width", "height"}, false, "length"},  // highD; with a length they are those of a body around x and y
    {{"xmin", "ymin", "xmax", "ymax"}, true},
    {{"x1", "y1", "x2", "y2"}, true},
    {{"left", "top", "width", "height"}, false},
    {{"bbleft", "bbtop", "bbwidth", "bbheight"}, false},  // MOT Challenge
};

std::string quoted_list(const std::vector<std::string>& names) {
    constexpr std::size_t kMostNamed = 8;
    std::string out;
    for (std::size_t i = 0; i < std::min(names.size(), kMostNamed); ++i) {
        const bool last = i > 0 && i + 1 == names.size();
        out += (i == 0 ? "" : last ? " and " : ", ") + in_quotes(names[i]);
    }
    if (names.size() > kMostNamed) out += " and " + std::to_string(names.size() - kMostNamed) + " more";
    return out;
}

std::string without_digits(std::string text) {
    std::erase_if(text, [](char c) { return c >= '0' && c <= '9'; });
    return text;
}

/// What stands ahead of "/pose/position/x": "robot1"; empty: nothing, or the poses of a path.
std::string robot_of(const std::string& name) {
    const std::string robot = name.substr(0, std::min(lower(name).find("pose"), name.size()));
    const std::size_t first = robot.find_first_not_of("/."), last = robot.find_last_not_of("/._");
    return last == std::string::npos || last < first ? "" : robot.substr(first, last + 1 - first);
}

}  // namespace

std::string shown(const std::string& name) {
    constexpr std::size_t kLongest = 40;
    return shortened(cleaned(name), kLongest);
}

void TableColumns::fail_in_header(const std::string& message) const {
    throw InputError(file_, at_line(header_line), message);
}

/// Where each row has several, the others' columns are hidden while one's are chosen.
void TableColumns::choose_groups() {
    if (has_word("timesteptime") && !options.columns) return choose_kinds_of_sumo();
    if (names.front().starts_with('$')) return choose_of_vissim();
    const bool has_places = std::ranges::any_of(names, [](const std::string& name) {
        const std::optional<KnownColumn> known = known_column(name);
        return known && known->column == Column::x && !known->is_weak;
    });
    const std::vector<std::string> all = names;
    std::vector<std::string> robots;  // whose names differ in digits alone; of several places the first counts
    for (const std::string& name : all) {
        if (has_places || options.columns || pose_axis(name) != 'x') continue;
        const std::string robot = robot_of(name);
        const bool is_like_first = robots.empty() || (robots.front() != without_digits(robots.front()) &&
                                                      without_digits(robot) == without_digits(robots.front()));
        if (!is_like_first || std::ranges::find(robots, robot) != robots.end()) continue;
        if (!robots.empty()) rows_.begin_group();
        robots.push_back(robot);
        format = "poses";
        const std::string place = name.substr(0, lower(name).rfind('x'));
        for (std::size_t i = 0; i < all.size(); ++i)
            names[i] = pose_axis(all[i]) == 0 || all[i].starts_with(place) ? all[i] : "_";
        choose_columns();
        rows_.group().kind = kRobot;
        if (!rows_[Column::id]) rows_.group().id = robot;
    }
    names = all;
    if (robots.empty()) return choose_columns();
    if (robots.size() == 1 && !rows_[Column::id]) rows_.group().id = kRobot;
}

void TableColumns::choose_kinds_of_sumo() {
    format = "sumo";
    const std::vector<std::string> all = names;
    bool is_first = true;
    for (const std::string_view kind : kSumoKinds) {
        const std::string prefix = std::string(kind) + '_';
        if (!has_word(std::string(kind) + "id")) continue;
        for (std::string& name : names)
            name = name.starts_with(prefix) ? name.substr(prefix.size()) : name == "timestep_time" ? name : "_";
        if (!has_word("x") || !has_word("y"))
            fail_in_header("the header names no " + prefix + "x or _y; let SUMO write x and y");
        if (!std::exchange(is_first, false)) rows_.begin_group();
        choose_columns();
        rows_.group().kind = kind;
        rows_.group().vehicle = column_with("vehicle");
        names = all;
    }
    if (is_first) fail_in_header("the header names no column vehicle_id or person_id; let SUMO write the ids");
}

void TableColumns::choose_of_vissim() {
    format = "vissim";
    const bool of_people = names.front().starts_with("$PEDESTRIAN");
    for (const std::string_view word : {"coordfront", "coordcent"}) {
        // All coordinates in one cell.
        const std::optional<std::size_t> cell = column_with(word);
        if (!cell || has_word(std::string(word) + 'x')) continue;
        spot = cell;
        for (const char axis : {'X', 'Y'}) names.push_back(names[*cell] + axis);
        break;
    }
    const std::optional<std::size_t> id = column_with("no");
    if (!id || !has_word("simsec") || (!has_word("coordfrontx") && !has_word("coordcentx")))
        fail_in_header(
            "lacks one of SIMSEC, NO and coordinates; let VISSIM write them: CoordFront of vehicles, CoordCentX "
            "and CoordCentY of pedestrians");
    rows_[Column::id].emplace(*id);
    choose_columns();
    rows_.group().kind = of_people ? "pedestrian" : "vehicle";
}

/// The column that is most likely meant where none is known by its name: one whose unit alone is strange, else the
/// first of which nothing is known.
std::string TableColumns::likely_column(Column needed) const {
    const auto is_meant = [&](const std::string& name) {
        const std::optional<KnownColumn> known = known_column(plain_name(name).word);
        return known && known->column == needed && !known_column(name);
    };
    const auto is_strange = [](const std::string& name) { return !name.empty() && !known_column(name); };
    auto at = std::ranges::find_if(names, is_meant);
    if (at == names.end()) at = std::ranges::find_if(names, is_strange);
    return at == names.end() ? "" : *at;
}

/// "; or say what it is by the option columns, such as x=px"; of degrees what else to do.
std::string TableColumns::also_by_option(Column needed) const {
    const std::string likely = likely_column(needed);
    if (has_word("lat") || has_word("latitude") || is_unit_of_angles(plain_name(likely).unit))
        return ". Latitudes and longitudes are degrees: turn them into metres first";
    return "; or say what it is by the option columns, such as " + std::string(name(needed)) + '=' +
           (likely.empty() ? "east" : shown(likely));
}

std::string TableColumns::order_hint() const {
    const std::string likely = likely_column(Column::id);
    return likely.empty() || options.columns
               ? ""
               : ", or, if these are several tracks, say which column names them, such as columns id=" + shown(likely);
}

// ---- which column is which

void TableColumns::choose_columns() {
    try {
        if (options.columns) {
            for (const auto& [column, text] : chosen_columns(*options.columns))
                rows_[column].emplace(text, std::span<const std::string>(names));
        }
        take_boxes();
        for (const Column column : {Column::id, Column::label, Column::lost, Column::active, Column::floor}) {
            if (rows_[column] && !rows_[column]->only_column())
                fail_in_header("columns: " + std::string(name(column)) + " is one column, and nothing to work out");
        }
        for (const Column column : kColumns) take_by_name(column);
        take_stamp();
    } catch (const std::invalid_argument& error) {
        fail_in_header(error.what());
    }
    name_radius_column();
    settle_bodies();
    for (const Column needed : {Column::x, Column::y}) {
        if (rows_[needed]) continue;
        fail_in_header("the header names no column " + std::string(name(needed)) + "; it needs t,x,y,r or x,y,r" +
                       also_by_option(needed));
    }
    const std::optional<std::size_t> time = rows_[Column::t] ? rows_[Column::t]->only_column() : std::nullopt;
    const std::optional<KnownColumn> named = time ? known_column(names[*time]) : std::nullopt;
    if (options.columns && named && named->column == Column::frame) {
        // Frame numbers, if fps says how many are a second.
        rows_[Column::frame] = std::exchange(rows_[Column::t], std::nullopt);
        frames_are_chosen = true;
    }
    if (rows_[Column::t]) rows_[Column::frame].reset();
    date = rows_[Column::t] ? column_with("date") : std::nullopt;
    find_scopes();
}

/// Seconds and nanoseconds of ROS.
void TableColumns::take_stamp() {
    if (rows_[Column::t] || rows_[Column::frame]) return;
    const auto ending = [this](std::string_view one, std::string_view other) {
        const auto at = std::ranges::find_if(names, [&](const std::string& name) {
            const std::string word = plain_name(name).word;
            return name.find('"') == std::string::npos && (word.ends_with(one) || word.ends_with(other));
        });
        return at == names.end() ? "" : '"' + *at + '"';
    };
    const std::string seconds = ending("stampsecs", "stampsec"), rest = ending("stampnsecs", "stampnanosec");
    if (!seconds.empty())
        rows_[Column::t].emplace(seconds + (rest.empty() ? "" : "+" + rest + "/1000000000"),
                                 std::span<const std::string>(names));
}

/// What makes no body, and keeps nobody apart, is a column like any other.
void TableColumns::settle_bodies() {
    const auto column_words = [this](Column column) {
        const std::size_t at = rows_[column]->first_column();
        return at == ColumnFormula::kNone ? "the option columns" : in_quotes(names[at]);
    };
    const bool has_sizes = rows_[Column::length] && rows_[Column::width] && !rows_[Column::r];
    if (has_sizes) {
        rows_.body_columns = "the columns " + column_words(Column::length) + " and " + column_words(Column::width);
    }
    const auto leave = [this](Column column, bool is_left) {
        if (is_left) rows_[column].reset();
    };
    leave(Column::length, !has_sizes);
    leave(Column::width, !has_sizes);
    leave(Column::heading, !has_sizes && !rows_[Column::label] && !options.body);
    if (rows_[Column::heading]) rows_.heading_column = "the column " + column_words(Column::heading);
    rows_.guesses_angles = rows_.guesses_angles && rows_[Column::heading];
    const auto is_as_it_stands = [this](Column column) { return rows_[column] && rows_[column]->only_column(); };
    if (rows_[Column::z] && is_as_it_stands(Column::x) && is_as_it_stands(Column::y) && header_line > 0 &&
        !options.columns)
        height = rows_[Column::z]->first_column();
    leave(Column::floor, !rows_[Column::id]);
    // Where y points up, z is the ground.
    const auto is_used = [&](Column column) {
        const std::vector<std::size_t> of = rows_[column] ? rows_[column]->columns() : std::vector<std::size_t>();
        return rows_[Column::z] && std::ranges::count(of, rows_[Column::z]->first_column()) > 0;
    };
    leave(Column::z, is_used(Column::x) || is_used(Column::y));
}

void TableColumns::find_scopes() {
    if (header_line == 0 || !rows_[Column::id] || options.columns || format != "csv") return;
    constexpr std::string_view kScopes[] = {
        "recordingid", "recording",  "sceneid",    "scene",   "caseid",    "case",    "sequenceid",
        "sequence",    "sessionid",  "session",    "videoid", "video",     "runid",   "run",
        "trialid",     "trial",      "experiment", "episode", "episodeid", "dataset", "take",
        "takeid",      "scenarioid", "scenario",   "logid",   "location"};
    // Of one recording there may be several.
    constexpr std::string_view kOtherScopes[] = {"site",     "intersection", "camera", "cameraid", "file",
                                                 "filename", "clip",         "clipid", "day"};
    const auto take = [this](std::span<const std::string_view> words) {
        for (std::size_t i = 0; i < names.size(); ++i) {
            if (std::ranges::find(words, plain_name(names[i]).word) != words.end()) scopes.push_back(i);
        }
    };
    take(kScopes);
    // A room is no recording, nor is a camera, unless the ids say so.
    is_weak_scope =
        std::ranges::all_of(scopes, [this](std::size_t i) { return plain_name(names[i]).word == "location"; });
    if (scopes.empty()) take(kOtherScopes);
    if (!scoped || scopes.empty()) return;
    rows_.scopes = scopes;
    std::vector<std::string> said;
    for (const std::size_t scope : scopes) said.push_back(names[scope]);
    warnings.push_back({"ids are one's within " + quoted_list(said) +
                            " alone and are told with it, as '0/17': who is in different ones was never there "
                            "together and does not meet; give columns (id=...) if that is wrong",
                        "columns"});
}

std::optional<std::size_t> TableColumns::column_with(std::string_view word) const {
    const auto at = std::ranges::find(names, word, [](const std::string& name) { return plain_name(name).word; });
    return at == names.end() ? std::nullopt : std::optional(static_cast<std::size_t>(at - names.begin()));
}

/// Centres of boxes, where the columns are corners.
void TableColumns::take_boxes() {
    if (rows_[Column::x] || rows_[Column::y]) return;
    for (const BoxColumns& box : kBoxes) {
        std::array<std::string, 4> corners;
        bool all = box.not_with.empty() || !has_word(box.not_with);
        for (std::size_t i = 0; all && i < corners.size(); ++i) {
            const std::optional<std::size_t> column = column_with(box.words[i]);
            all = column && names[*column].find('"') == std::string::npos;
            if (all) corners[i] = names[*column];
        }
        // A table with centres of its own needs none of this.
        if (!all || (box.words[0] != "x" && has_word("x"))) continue;
        const auto centre = [&](std::size_t i, const std::string& quote = "") {
            std::string sum = quote;
            sum.append(corners[i]).append(quote).append("+").append(quote).append(corners[i + 2]).append(quote);
            return box.has_middles ? "(" + sum + ")/2" : sum + "/2";
        };
        rows_[Column::x].emplace(centre(0, "\""), std::span<const std::string>(names));
        rows_[Column::y].emplace(centre(1, "\""), std::span<const std::string>(names));
        if (header_line == 0) return;
        warnings.push_back({"the columns " + quoted_list({corners.begin(), corners.end()}) +
                                " are taken for boxes: their centres are " + centre(0) + ", " + centre(1) +
                                "; give columns (x=" + corners[0] + ",y=" + corners[1] + ") if that is wrong" +
                                (box.has_middles ? ""
                                                 : ", (length=" + corners[2] + ",width=" + corners[3] +
                                                       ") for bodies that are as large along their way"),
                            "columns"});
        return;
    }
}

void TableColumns::take_by_name(Column column) {
    std::vector<std::size_t> found;
    std::vector<KnownColumn> known;
    bool strong = false;
    if (const std::optional<ColumnFormula>& chosen = rows_[column]) {
        // A column that was chosen as it is keeps the unit that its name says.
        const std::optional<std::size_t> only = chosen->only_column();
        const std::optional<KnownColumn> here = only ? known_column(names[*only]) : std::nullopt;
        if (column == Column::heading) rows_.guesses_angles = !here || !here->says_unit;
        if (!here || !here->says_unit || (here->column == Column::t) != (column == Column::t)) return;
        found.push_back(*only);
        known.push_back(*here);
    }
    const bool is_chosen = !found.empty();
    for (std::size_t i = 0; i < names.size() && !is_chosen; ++i) {
        const std::optional<KnownColumn> here = known_column(names[i]);
        if (!here || here->column != column || (strong && here->is_weak)) continue;
        if (!here->is_weak && !strong) {
            found.clear();
            known.clear();
            strong = true;
        }
        found.push_back(i);
        known.push_back(*here);
    }
    const bool is_other_clock =
        (column == Column::frame && rows_[Column::t]) || (column == Column::t && rows_[Column::frame]);
    if (found.empty() || is_other_clock) return;
    // Of others the first counts.
    const bool must_be_one = column <= Column::r;
    if (found.size() > 1 && must_be_one) {
        const std::string& first = names[found[0]];
        const std::string& second = names[found[1]];
        if (first == second) fail_at_name(found[1], "the column stands twice; remove one");
        fail_at_name(found[1], in_quotes(first) + " and " + in_quotes(second) + " may both be " +
                                   std::string(name(column)) + "; say which by the option columns, such as " +
                                   std::string(name(column)) + "=" + shown(second));
    }
    const KnownColumn& is = known.front();
    if (column == Column::t) {
        rows_[column].emplace(found.front(), is.scale);
        counts_time = !is.says_unit && !is_chosen;
        is_weak_time = is.is_weak;
        return;
    }
    if (column == Column::heading && format == "sumo") {
        rows_[column].emplace("90-" + shown(names[found.front()]), std::span<const std::string>(names));
        return;
    }
    if (column == Column::heading) {
        rows_[column].emplace(found.front(), is.scale);
        rows_.guesses_angles = !is.says_unit;
        return;
    }
    // All lengths are in the unit of the first column that says one.
    double factor = 1;
    if (is.says_unit && column != Column::x && column != Column::y && unit_why.empty()) {
        // Places without a unit are in metres all the same.
        factor = options.unit ? 1 : is.scale;
    } else if (is.says_unit) {
        if (unit_why.empty()) {
            unit = is.scale;
            unit_why = "the column " + in_quotes(names[found.front()]);
        }
        factor = is.scale / unit;
    }
    rows_[column].emplace(found.front(), factor * is.share);
}

void TableColumns::fail_at_name(std::size_t column, const std::string& message) const {
    throw InputError(file_, at_line(header_line) + ", column " + std::to_string(column + 1), message);
}

/// The column that the option radius names.
void TableColumns::name_radius_column() {
    const RadiusColumn* const wanted = options.radius ? std::get_if<RadiusColumn>(&*options.radius) : nullptr;
    if (!wanted) return;
    const auto at = std::ranges::find(names, wanted->name);
    // "r" may be made of others.
    if (at == names.end() && wanted->name == "r" && rows_[Column::r]) return;
    if (at == names.end()) {
        fail_in_header("the header names no column " + in_quotes(wanted->name) + " of radii" +
                       did_you_mean(wanted->name, names) + "; give metres, or a column that it names");
    }
    const auto column = static_cast<std::size_t>(at - names.begin());
    const auto twice = std::find(at + 1, names.end(), wanted->name);
    if (twice != names.end())
        fail_at_name(static_cast<std::size_t>(twice - names.begin()), "the column stands twice; remove one");
    rows_[Column::r].emplace(column);
}

std::vector<std::string> TableColumns::tell_ignored() {
    std::vector<std::string> others;
    std::vector<bool> used(names.size(), header_line == 0);
    for (const RowGroup& group : rows_.groups()) {
        for (const std::optional<ColumnFormula>& made : group.formulas) {
            for (const std::size_t at : made ? made->columns() : std::vector<std::size_t>()) used[at] = true;
        }
        if (group.vehicle) used[*group.vehicle] = true;
    }
    if (spot) used[*spot] = true;
    for (const std::size_t scope : rows_.scopes) used[scope] = true;
    if (date) used[*date] = true;
    std::size_t unnamed = 0;
    for (std::size_t i = 0; i < names.size(); ++i) {
        if (used[i]) continue;
        if (names[i].empty()) {
            ++unnamed;
        } else if (std::ranges::find(others, names[i]) == others.end()) {
            others.push_back(names[i]);
        }
    }
    std::string over;
    if (!others.empty()) over = (others.size() == 1 ? "the column " : "the columns ") + quoted_list(others);
    if (unnamed > 0) {
        over += (over.empty() ? "" : " and ") +
                (unnamed == 1 ? std::string("a column") : counted(unnamed, "", "columns")) + " without a name";
    }
    if (!over.empty())
        warnings.push_back({over + (others.size() + unnamed == 1 ? " is" : " are") + " ignored", "columns"});
    return others;
}

}  // namespace mobbscope
