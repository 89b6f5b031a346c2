#include <base/text.h>
#include <import/clip/road_users.h>
#include <import/clip/sample_times.h>
#include <import/clip/sampling.h>
#include <import/tracks/clock_text.h>
#include <import/tracks/rows.h>
#include <mobb/clip.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

namespace mobbscope {

namespace {

constexpr double kMorning = 6 * 3600.0, kEvening = 18 * 3600.0, kDay = 24 * 3600.0;  // seconds

}  // namespace

double RowReader::value(const Cells& cells, Column column, double largest) const {
    const std::optional<ColumnFormula>& made = (*this)[column];
    if (!made) return 0;
    const double value = made->of([&cells](std::size_t at) { return cells.number(at); });
    if (std::abs(value) <= largest) return value;
    const std::size_t at = place(column);
    if (made->only_column())
        cells.fail(at, in_quotes(cells.text(at)) + " is beyond " + format_double(largest) + "; check the units");
    cells.fail(at, std::string(name(column)) + " becomes " + brief(value) + ", which is not a number up to " +
                       format_double(largest) + "; check the " + (at == Cells::kNoColumn ? "option columns" : "units"));
}

double RowReader::whole(const Cells& cells, Column column) const {
    const double value = this->value(cells, column, kMaxFrame);
    if (value == std::floor(value)) return value;
    const std::size_t at = place(column);
    cells.fail(at, in_quotes(cells.text(at)) + " is not a whole number, as ids and frames of this format (" +
                       std::string(whole_in) + ") are; check the columns");
}

double RowReader::when(const Cells& cells) const {
    if (!has(Column::frame)) return value(cells, Column::t, mobb::kMaxTime);
    return whole_in.empty() ? value(cells, Column::frame, kMaxFrame) : whole(cells, Column::frame);
}

double RowReader::radius(const Cells& cells) const {
    double largest = value(cells, Column::r, mobb::kMaxLength);
    const std::size_t of_r = place(Column::r), at = of_r == Cells::kNoColumn && !axes.empty() ? axes.front() : of_r;
    bool negative = largest < 0;
    for (const std::size_t axis : axes) {
        const double length = cells.number(axis);
        negative = negative || length < 0;
        largest = std::max(largest, length);
    }
    if (negative) cells.fail(at, "the radius is negative; give 0 or more");
    if (largest > mobb::kMaxLength)
        cells.fail(at, brief(largest) + " is beyond " + format_double(mobb::kMaxLength) + "; check the units");
    return largest;
}

std::string_view RowReader::identifier(const Cells& cells) {
    if (!has(Column::id)) return groups_[at_].id;
    if (!whole_in.empty()) {
        const double id = whole(cells, Column::id);
        if (id != id_) {
            id_ = id;
            id_text_ = std::to_string(static_cast<long long>(id));
        }
        return id_text_;
    }
    std::string_view text = cells.name_in(place(Column::id), "the name");
    if (text.empty()) cells.fail(place(Column::id), "the field is empty; name the track");
    // "1.0" is what programs write of 1 where others are missing.
    const std::size_t point = text.find_first_not_of("0123456789");
    if (point > 0 && text.substr(std::min(point, text.size())) == ".0") text = text.substr(0, point);
    if (const std::string& kind = groups_[at_].kind; !kind.empty()) {
        // A person may be called like a vehicle.
        const bool is_first = kinds_.try_emplace(std::string(text), at_).first->second == at_;
        return is_first ? text : scoped_id_ = kind + ' ' + std::string(text);
    }
    if (scopes.empty()) return text;
    scoped_id_.clear();
    for (const std::size_t scope : scopes) scoped_id_.append(cells.name_in(scope, "the name")).append("/");
    scope_size_ = scoped_id_.size() - 1;
    return scoped_id_.append(text);
}

std::string_view RowReader::label(const Cells& cells) const {
    const std::string_view kind = groups_[at_].kind;
    if (!has(Column::label)) return kind;
    const std::string_view text = cells.name_in(place(Column::label), "the label");
    // A type of which nothing is known says less than the kind.
    return !kind.empty() && (text.starts_with("DEFAULT_") || !road_user(text)) ? kind : text;
}

bool RowReader::has_details() const {
    return std::ranges::any_of(std::array{Column::length, Column::heading, Column::z, Column::floor},
                               [this](Column column) { return has(column); });
}

PointDetail RowReader::detail(const Cells& cells) {
    const auto number = [&](Column column, double largest) {
        if (!has(column)) return PointDetail::kUntold;
        const double value =
            (*this)[column]->of([&cells](std::size_t at) { return cells.value(at).value_or(PointDetail::kUntold); });
        return std::abs(value) <= largest ? value : PointDetail::kUntold;
    };
    const auto size = [&](Column column) {
        const double value = number(column, mobb::kMaxLength);
        return value > 0 ? value : 0;
    };
    PointDetail out{size(Column::length), size(Column::width), number(Column::heading, mobb::kMaxDegrees),
                    number(Column::z, mobb::kMaxLength)};
    if (!has(Column::floor) || cells.is_empty(place(Column::floor))) return out;
    std::string name(cells.name_in(place(Column::floor), "the floor"));
    if (const std::optional<double> level = parse_double(name)) name = format_double(*level);
    const auto [at, is_new] = floors_.try_emplace(std::move(name), static_cast<int>(floors_.size()));
    out.floor = at->second;
    return out;
}

void RowReader::tell_details(TrackFile& file) {
    file.details = tracks_.take_details();
    file.floors.resize(floors_.size());
    for (const auto& [name, number] : floors_) file.floors[static_cast<std::size_t>(number)] = name;
    file.has_sizes = std::ranges::any_of(
        file.details, [](const PointDetail& detail) { return detail.length > 0 && detail.width > 0; });
    file.body_columns = body_columns;
    file.heading_column = heading_column;
    const auto lost =
        std::ranges::count_if(file.details, [](const PointDetail& detail) { return std::isnan(detail.heading); });
    if (lost > 0 && !heading_column.empty())
        file.warnings.push_back({counted(static_cast<std::size_t>(lost), "row has", "rows have") +
                                     " no heading that can be read: the one before counts, or the next; without any "
                                     "the direction of motion",
                                 "columns"});
    if (!guesses_angles) return;
    constexpr double kFullTurn = 2 * std::numbers::pi * 1.001;
    const auto is_small = [](const PointDetail& detail) { return !(std::abs(detail.heading) > kFullTurn); };
    const bool in_radians = std::ranges::all_of(file.details, is_small);
    for (PointDetail& detail : file.details) detail.heading *= in_radians ? 180 / std::numbers::pi : 1;
    file.heading_column += in_radians ? ", in radians by its values" : ", in degrees by its values";
}

bool RowReader::is_left_out(const Cells& cells) {
    const auto is_set = [&](Column column) {
        const std::string text = lower(cells.text(place(column)));
        const auto is = [&text](std::string_view word) { return text == word; };
        if (const std::optional<double> number = parse_double(text)) return *number != 0;
        if (std::ranges::any_of(std::array{"", "false", "no", "n", "f", "off"}, is)) return false;
        if (std::ranges::any_of(std::array{"true", "yes", "y", "t", "on"}, is)) return true;
        cells.fail(place(column), in_quotes(text) + " is neither yes nor no; write 1 or 0");
    };
    if ((has(Column::lost) && is_set(Column::lost)) || (has(Column::active) && !is_set(Column::active))) {
        ++lost_;
        return true;
    }
    if (groups_[at_].vehicle && !cells.text(*groups_[at_].vehicle).empty()) {
        ++riding_;
        return true;
    }
    // One motion has no gaps.
    if (!has_ids()) return false;
    constexpr double kNowhere = -1073741824;  // SUMO's, of what is put elsewhere
    for (const Column column : {Column::x, Column::y}) {
        for (const std::size_t at : (*this)[column]->columns()) {
            if (!cells.is_empty(at) && (groups_[at_].kind.empty() || cells.value(at) != kNowhere)) continue;
            // Where each row has several, those who are not there have no cells.
            if ((groups_.size() == 1 || has(Column::id)) && empty_++ == 0) first_empty_ = cells.line();
            return true;
        }
    }
    return false;
}

void RowReader::check_order(const Cells& cells, double time) const {
    if (time > last_) return;
    cells.fail(place(has(Column::frame) ? Column::frame : Column::t),
               time_word() + " does not come after " + format_double(last_) +
                   " of the row before; sort the rows and remove doubles" +
                   (time == last_ && !has(Column::frame) ? rounded_time_hint(time) : "") + order_hint);
}

bool RowReader::add(const Cells& cells) {
    bool counts = false;
    for (std::size_t i = 0; i < groups_.size(); ++i) counts = add(cells, i) || counts;
    return counts;
}

bool RowReader::add(const Cells& cells, std::size_t group) {
    at_ = group;
    // Of a step in which nobody of a kind is there, the time alone.
    if (groups_.size() > 1 && has(Column::id) && cells.is_empty(place(Column::id))) return false;
    if (is_left_out(cells)) return false;
    const std::string_view id = identifier(cells);
    const double time = when(cells);
    const TrackPoint point{time,
                           value(cells, Column::x, mobb::kMaxLength),
                           value(cells, Column::y, mobb::kMaxLength),
                           cells.line(),
                           0,
                           radius(cells)};
    in_milliseconds_ = in_milliseconds_ && is_in_milliseconds(time);
    if (tracks_.empty() && has(Column::t)) {
        const std::vector<std::size_t> from = (*this)[Column::t]->columns();
        is_clock_ = from.size() == 1 && time <= kDay && is_time_of_day(cells.text(from.front()));
    }
    const bool is_past_midnight = is_clock_ && time < kMorning && last_ >= kEvening;
    has_morning_ = has_morning_ || time < kMorning;
    has_midday_ = has_midday_ || (time >= kMorning && time < kEvening);
    // Tracks may lie across each other in any order, the rows of one motion may not.
    if (!has_ids() && has_times() && !tracks_.empty() && !is_past_midnight) check_order(cells, time);
    last_ = time;
    last_of_all_ = std::max(last_of_all_, time);
    std::optional<PointDetail> more;
    if (has_details()) more = detail(cells);
    tracks_.add(id, point, label(cells), more ? &*more : nullptr);
    if (!scopes.empty() && tracks_.last().points.size() == 1) tracks_.last().scope = scoped_id_.substr(0, scope_size_);
    return true;
}

TrackFile RowReader::finish() {
    TrackFile out;
    out.alone = !has_ids();
    out.timed = has(Column::t);
    out.has_times = has_times();
    out.has_radius = has(Column::r) || !axes.empty();
    if (out.timed && in_milliseconds_) out.rounding = kMillisecond;
    if (out.timed) out.least_step.reset();
    // A clock without dates that goes over midnight.
    if (is_clock_ && has_morning_ && !has_midday_ && last_of_all_ >= kEvening) {
        tracks_.add_to_early(kMorning, kDay);
        out.warnings.push_back({"the clock goes over midnight: times before 6:00 are of the day after"});
    } else if (const std::string back = tracks_.step_back(); out.has_times && !back.empty()) {
        out.warnings.push_back({back + "; till then rows count in order of time"});
    }
    const auto twice = [&](const Track& track, const TrackPoint& row) {
        return time_word() + ' ' + format_double(row.frame) + (out.timed ? rounded_time_hint(row.frame) : "") +
               " of track " + in_quotes(track.id) + " stands already in line ";
    };
    out.tracks = !out.alone && out.has_times ? tracks_.take_sorted(twice, true) : tracks_.take();
    const auto tell = [&out](std::size_t count, const char* one, const char* several, const char* rest, int line = 0) {
        if (count > 0) out.warnings.push_back({counted(count, one, several) + rest, "", line});
    };
    tell(tracks_.repeated(), "row repeats another", "rows repeat others", " and count once", tracks_.first_repeated());
    if (!out.has_times) {
        for (Track& track : out.tracks) {
            for (std::size_t i = 0; i < track.points.size(); ++i) track.points[i].frame = static_cast<double>(i);
        }
    }
    out.spent = tracks_.take_spent();
    tell_details(out);
    tell(lost_, "row is", "rows are", " marked as lost or not active and left out");
    tell(riding_, "row of somebody who rides", "rows of those who ride", " in a vehicle are left out");
    tell(empty_, "row has no place and is", "rows have no place and are", " left out; fill x and y in if they count",
         first_empty_);
    return out;
}

}  // namespace mobbscope
