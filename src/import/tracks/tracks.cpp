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

void TrackCollector::add(std::string_view id, const TrackPoint& point, std::string_view label) {
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
    spent_.cover(used_, "its rows", file_);
    push_to(tracks_[last_].points, point);
}

std::string TrackCollector::is_twice(const Track& track, const TrackPoint& point) {
    return in_quotes(track.id) + " is in frame " + format_double(point.frame) + " already in line ";
}

TrackFile TrackCollector::take_timed(bool in_milliseconds) {
    TrackFile out;
    out.timed = true;
    out.least_step.reset();
    if (in_milliseconds) out.rounding = kMillisecond;
    out.tracks = take_sorted([](const Track& track, const TrackPoint& point) {
        return "the time " + format_double(point.frame) + " of " + in_quotes(track.id) + " stands already in line ";
    });
    out.spent = take_spent();
    return out;
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
        throw InputError(file_, at_line((at + 1)->line), twice(track, *at) + std::to_string(at->line) + "; remove one");
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

}  // namespace mobbscope
