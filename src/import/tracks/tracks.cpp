#include <import/clip/sampling.h>
#include <import/tracks/tracks.h>

#include <algorithm>

namespace mobbscope {

namespace {

/// Twice as much room, as usual, would be empty for the most part where there are many short tracks.
template <class T>
void push_to(std::vector<T>& to, T one) {
    if (to.size() == to.capacity()) to.reserve(to.size() + std::max<std::size_t>(to.size() / 4, 4));
    to.push_back(std::move(one));
}

}  // namespace

void TrackCollector::add(std::string_view id, TrackPoint point, std::string_view label, const PointDetail* detail) {
    // Many files have a track's points one after another.
    if (tracks_.empty() || tracks_[last_].id != id) {
        const auto [at, is_new] = index_.try_emplace(std::string(id), tracks_.size());
        if (is_new) {
            push_to(tracks_, Track{std::string(id), {}, std::string(label)});
            used_ += kBytesOfTrack + 4 * id.size();
        }
        last_ = at->second;
    }
    used_ += kBytesOfPoint;
    if (detail) {
        used_ += sizeof(PointDetail);
        details_.push_back(*detail);
        point.detail = static_cast<int>(details_.size());
    }
    spent_.cover(used_, "its rows", file_);
    std::vector<TrackPoint>& points = tracks_[last_].points;
    ++rows_;
    if (!points.empty() && point.frame < points.back().frame && steps_back_++ == 0) back_line_ = point.line;
    push_to(points, point);
}

std::string TrackCollector::step_back() const {
    // Rows in any order step back all the time.
    constexpr std::size_t kFewestRows = 10;
    if (steps_back_ == 0 || rows_ < kFewestRows * steps_back_) return "";
    return "times go back in " + at_line(back_line_) +
           (steps_back_ > 1 ? " and " + counted(steps_back_ - 1, "row", "rows") + " more" : "") +
           ": was the clock set back, or does another recording begin? Give other ids from there on if so";
}

void TrackCollector::add_to_early(double before, double more) {
    for (Track& track : tracks_) {
        for (TrackPoint& point : track.points) point.frame += point.frame < before ? more : 0;
    }
}

std::string TrackCollector::is_twice(const Track& track, const TrackPoint& point) {
    return in_quotes(track.id) + " is in frame " + format_double(point.frame) + " already in line ";
}

std::vector<Track> TrackCollector::take_sorted(const std::function<std::string(const Track&, const TrackPoint&)>& twice,
                                               bool once) {
    for (Track& track : tracks_) {
        // Most are in order, which is found out sooner than they are sorted.
        if (!std::ranges::is_sorted(track.points, {}, &TrackPoint::frame))
            std::ranges::stable_sort(track.points, {}, &TrackPoint::frame);
        auto at = std::ranges::adjacent_find(track.points, {}, &TrackPoint::frame);
        if (at == track.points.end()) continue;
        const auto same = [](const TrackPoint& a, const TrackPoint& b) {
            return a.frame == b.frame && a.x == b.x && a.y == b.y && a.r == b.r;
        };
        if (once) {
            if (repeated_ == 0) first_repeated_ = (at + 1)->line;
            const auto left = std::unique(track.points.begin(), track.points.end(), same);
            repeated_ += static_cast<std::size_t>(track.points.end() - left);
            track.points.erase(left, track.points.end());
            at = std::ranges::adjacent_find(track.points, {}, &TrackPoint::frame);
            if (at == track.points.end()) continue;
        }
        throw InputError(file_, at_line((at + 1)->line),
                         twice(track, *at) + std::to_string(at->line) + "; remove one" +
                             (step_back().empty() ? "" : ", or: " + step_back()));
    }
    return take();
}

std::string_view without_mark(std::string_view text) {
    if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);
    return text;
}

std::string_view take_row(std::string_view& text) {
    while (!text.empty()) {
        const std::size_t end = text.find('\n');
        const std::string_view line = trimmed(text.substr(0, end));
        text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
        if (!line.empty() && line[0] != '#') return line;
    }
    return "";
}

std::string_view take_word(std::string_view& rest, char separator) {
    const std::size_t from = rest.starts_with('"') ? std::min(rest.find('"', 1), rest.size()) : 0;
    const std::size_t at =
        std::min(separator == ' ' ? rest.find_first_of(" \t", from) : rest.find(separator, from), rest.size());
    std::string_view field = trimmed(rest.substr(0, at));
    if (field.size() > 1 && field.front() == '"' && field.back() == '"') field = field.substr(1, field.size() - 2);
    rest.remove_prefix(std::min(at + 1, rest.size()));
    if (separator == ' ') rest = trimmed(rest);
    return field;
}

}  // namespace mobbscope
