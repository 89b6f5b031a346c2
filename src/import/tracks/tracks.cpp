#include <base/error.h>
#include <base/file.h>
#include <base/text.h>
#include <import/tracks/tracks.h>

#include <algorithm>
#include <array>
#include <utility>

namespace mobbscope {

namespace {

using Parser = TrackFile (*)(std::string_view, const std::string&);
constexpr std::array<std::pair<std::string_view, Parser>, 4> kParsers{
    {{".txt", parse_text_tracks}, {".ndjson", parse_trajnetpp}, {".yaml", parse_mapf_plan}, {".yml", parse_mapf_plan}}};

Parser parser_for(std::string_view extension) {
    for (const auto& [name, parser] : kParsers) {
        if (name == extension) return parser;
    }
    return nullptr;
}

}  // namespace

void TrackCollector::add(const std::string& id, const TrackPoint& point) {
    const auto [at, is_new] = index_.try_emplace(id, tracks_.size());
    if (is_new) tracks_.push_back({id, {}});
    tracks_[at->second].points.push_back(point);
}

std::vector<Track> TrackCollector::take(const std::string& file) {
    for (Track& track : tracks_) {
        std::stable_sort(track.points.begin(), track.points.end(),
                         [](const TrackPoint& a, const TrackPoint& b) { return a.frame < b.frame; });
        const auto twice =
            std::adjacent_find(track.points.begin(), track.points.end(),
                               [](const TrackPoint& a, const TrackPoint& b) { return a.frame == b.frame; });
        if (twice == track.points.end()) continue;
        throw InputError(file, at_line((twice + 1)->line),
                         in_quotes(track.id) + " is in frame " + short_double(twice->frame) + " already in line " +
                             std::to_string(twice->line) + "; remove one");
    }
    return std::move(tracks_);
}

bool is_track_extension(std::string_view extension) { return parser_for(extension) != nullptr; }

TrackFile read_tracks(const std::filesystem::path& file) {
    const Parser parser = parser_for(lower_extension(file));
    if (!parser) throw InputError(file.string(), "", "is no file of tracks; give .txt, .ndjson, .yaml or .yml");
    return parser(read_file(file), file.string());
}

}  // namespace mobbscope
