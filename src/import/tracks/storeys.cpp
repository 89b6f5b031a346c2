#include <base/text.h>
#include <import/clip/road_users.h>
#include <import/tracks/storeys.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace mobbscope {

namespace {

constexpr double kLeastStorey = 2.2;  // metres
constexpr double kLeastOfFlight = 1;  // metres

/// Metres between heights that belong to different floors.
double least_storey(const TrackFile& file, double metres) {
    constexpr double kRounding = 1 - 1e-9;
    if (file.format == "mapf") return metres * kRounding;
    const bool flies = std::ranges::all_of(file.tracks, [](const Track& track) {
        const RoadUser* const user = road_user(track.label);
        return user && user->flies;
    });
    return (flies ? kLeastOfFlight : kLeastStorey) * kRounding;
}

}  // namespace

Storeys storeys_of(const TrackFile& file, double metres) {
    Storeys out;
    if (!file.floors.empty()) {
        const auto is_share = [](const std::string& name) {
            const std::optional<double> level = parse_double(name);
            return level && 2 * *level != std::floor(2 * *level);
        };
        if (std::ranges::any_of(file.floors, is_share)) {
            out.remark = "the levels of the rows are no floors, such as " +
                         in_quotes(*std::ranges::find_if(file.floors, is_share)) + ": they keep nobody apart";
            return out;
        }
        out.names = file.floors;
        for (const PointDetail& detail : file.details) out.by_detail.push_back(detail.floor);
        if (out.names.size() > 1)
            out.remark =
                "the rows name " + std::to_string(out.names.size()) + " floors: those of different floors never meet";
        return out;
    }
    std::vector<std::pair<double, std::size_t>> heights;
    for (std::size_t i = 0; i < file.details.size(); ++i) {
        if (!std::isnan(file.details[i].z)) heights.emplace_back(file.details[i].z * metres, i);
    }
    if (heights.empty() || file.alone) return out;
    std::ranges::sort(heights);
    const double least = least_storey(file, metres), highest = heights.back().first, lowest = heights.front().first;
    if (highest - lowest < least) return out;
    out.by_detail.assign(file.details.size(), -1);
    for (std::size_t i = 0; i < heights.size(); ++i) {
        const auto [height, at] = heights[i];
        if (i == 0 || height - heights[i - 1].first >= least) out.names.push_back("z " + brief(height));
        out.by_detail[at] = static_cast<int>(out.names.size()) - 1;
    }
    const std::string apart = brief(std::round(least * 100) / 100) + " m apart";
    if (out.names.size() == 1) {
        out = {};
        out.remark = "heights (z) go from " + brief(lowest) + " to " + brief(highest) +
                     " m, but form no floors that are " + apart + ": who is above another meets them";
    } else {
        out.remark = "heights (z) are on " + std::to_string(out.names.size()) + " floors at least " + apart +
                     ", from " + brief(lowest) + " to " + brief(highest) + " m: those of different floors never meet";
    }
    return out;
}

}  // namespace mobbscope
