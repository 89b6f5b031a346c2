#include <base/median.h>
#include <base/text.h>
#include <import/clip/road_users.h>
#include <import/tracks/track_bodies.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

namespace mobbscope {

namespace {

constexpr double kTurn = 360;                   // degrees
constexpr double kLongest = 500, kWidest = 70;  // metres, of trains and ships

/// Metres.
struct BodySize {
    double length = 0, width = 0;
    bool varies = false;
};

std::optional<BodySize> size_said(const TrackFile& file, const Track& track, double metres) {
    if (!file.has_sizes) return std::nullopt;
    std::vector<double> lengths, widths;
    for (const TrackPoint& point : track.points) {
        const PointDetail* const detail = file.detail_of(point);
        if (!detail || detail->length == 0 || detail->width == 0) continue;
        lengths.push_back(detail->length * metres);
        widths.push_back(detail->width * metres);
    }
    if (lengths.empty()) return std::nullopt;
    constexpr double kSame = 0.01;  // metres
    const auto varies = [](const std::vector<double>& sizes) {
        const auto [least, most] = std::ranges::minmax(sizes);
        return most - least > kSame;
    };
    const bool vary = varies(lengths) || varies(widths);
    return BodySize{median(std::move(lengths)), median(std::move(widths)), vary};
}

/// Null: the class tells none.
const RoadUser* sized_class(const TrackFile& file, const std::string& label) {
    const RoadUser* const user = file.class_size == ClassSize::none ? nullptr : road_user(label);
    return user && user->radius > 0 ? user : nullptr;
}

bool is_rectangle(const TrackFile& file, const RoadUser& user) {
    return file.class_size == ClassSize::body && user.width > 0;
}

std::string size_words(double length, double width) { return brief(length) + " x " + brief(width) + " m"; }

}  // namespace

TrackBody body_of(const TrackFile& file, const Track& track, double metres) {
    std::optional<BodySize> size = size_said(file, track, metres);
    if (!size) {
        const RoadUser* const user = sized_class(file, track.label);
        if (!user) return {};
        if (!is_rectangle(file, *user)) return {user->radius};
        size = {2 * user->radius, user->width};
    }
    std::vector<mobb::BodyDisk> disks = mobb::rectangle_body(size->length, size->width);
    for (mobb::BodyDisk& disk : disks) disk.forward -= file.place_is_front ? size->length / 2 : 0;
    const double reach = mobb::body_reach(disks);
    if (disks.size() == 1 && !file.place_is_front) disks.clear();
    return {reach, std::move(disks)};
}

std::string body_remark(const TrackFile& file, double metres) {
    std::map<std::string, int> others;  // tracks by class
    std::optional<BodySize> least, most;
    std::size_t sized = 0, varying = 0;
    double excess = 0;
    for (const Track& track : file.tracks) {
        const std::optional<BodySize> size = size_said(file, track, metres);
        if (!size) {
            ++others[track.label];
            continue;
        }
        ++sized;
        varying += size->varies;
        excess = std::max(excess, mobb::rectangle_excess(size->length, size->width));
        if (!least || size->length < least->length) least = size;
        if (!most || size->length > most->length) most = size;
    }
    std::string said;
    if (sized > 0) {
        const std::string range = least->length == most->length ? size_words(most->length, most->width)
                                                                : size_words(least->length, least->width) + " to " +
                                                                      size_words(most->length, most->width);
        said = counted(sized, "body is", "bodies are") + " of " + range + ", as " + file.body_columns + " say: disks " +
               "in a row that cover it and stand out by up to " + brief(std::ceil(excess * 1000) / 1000) +
               " m, along " +
               (file.heading_column.empty() ? "the direction of motion" : "the heading (" + file.heading_column + ")") +
               (file.place_is_front ? "; x and y are the middle of the front" : "") +
               (varying > 0 ? "; of sizes that vary along a track the median is taken" : "") +
               (most->length > kLongest || most->width > kWidest
                    ? "; no vehicle is so large: check the unit of their sizes"
                    : "");
        if (others.empty()) return said + "; give radius for a plain disk";
        said += "; ";
    }
    std::string taken = brief(kDefaultTrackRadius) + " m";
    if (others.size() > 1 || !others.contains("")) {
        taken = "by class";
        const char* separator = " ";
        for (const auto& [label, count] : others) {
            const RoadUser* const known = sized_class(file, label);
            taken +=
                separator + (label.empty() ? "none" : in_quotes(label)) + ' ' +
                (known && is_rectangle(file, *known) ? size_words(2 * known->radius, known->width)
                                                     : brief(known ? known->radius : kDefaultTrackRadius) + " m") +
                " (" + counted(count, "track", "tracks") +
                (known || label.empty() || file.class_size == ClassSize::none ? ")"
                                                                              : ", a class without a usual radius)");
            separator = ", ";
        }
    }
    return said + (sized > 0 ? "of others" : "the file has no radii:") + ' ' + taken +
           " are taken; give radius if that is wrong";
}

mobb::Clip whole_path(const Track& track, double metres) {
    std::vector<mobb::Disk> places;
    for (const TrackPoint& point : track.points) places.push_back({point.x * metres, point.y * metres, 0});
    return {1, std::move(places)};
}

std::vector<double> headings_in_part(const Track& track, std::span<const double> headings,
                                     std::span<const TrackPoint> points) {
    std::vector<double> out;
    const auto first = std::ranges::lower_bound(track.points, points.front().frame, {}, &TrackPoint::frame);
    auto at = static_cast<std::size_t>(first - track.points.begin());
    for (std::size_t i = 0; i < points.size(); ++i) {
        while (at + 1 < headings.size() && track.points[at].frame < points[i].frame) ++at;
        const double before = out.empty() ? headings[at] : out.back();
        out.push_back(before + std::remainder(headings[at] - before, kTurn));
    }
    return out;
}

std::vector<double> headings_at(const TrackFile& file, std::span<const TrackPoint> points) {
    std::vector<double> out;
    if (file.heading_column.empty()) return out;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const PointDetail* const detail = file.detail_of(points[i]);
        if (!detail || std::isnan(detail->heading)) {
            if (!out.empty()) out.push_back(out.back());
            continue;
        }
        if (out.empty()) out.assign(i, detail->heading);
        const double before = out.empty() ? detail->heading : out.back();
        out.push_back(before + std::remainder(detail->heading - before, kTurn));
    }
    return out;
}

}  // namespace mobbscope
