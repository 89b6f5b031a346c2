#include <mobb_tracks/parts.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace mobb {

namespace {

constexpr int kPlaces = 4;  // that are looked at of each path

/// The value that so many of all are below; no limit before the first and behind the last.
double cut(std::vector<double>& values, int below, int of) {
    if (below == 0 || values.empty()) return -Region::kNoLimit;
    if (below == of) return Region::kNoLimit;
    const auto at = values.begin() + static_cast<std::ptrdiff_t>(values.size() * std::size_t(below) / std::size_t(of));
    std::nth_element(values.begin(), at, values.end());
    return *at;
}

}  // namespace

Region region_of_part(std::span<const PlacedClip> crowd, int part, int parts) {
    int across = 1;
    for (int divisor = 2; divisor * divisor <= parts; ++divisor) {
        if (parts % divisor == 0) across = divisor;
    }
    std::vector<double> times, xs;
    for (const PlacedClip& clip : crowd) {
        for (int k = 0; k < kPlaces; ++k) {
            const int sample = static_cast<int>(std::int64_t{clip.count()} * (2 * k + 1) / (2 * kPlaces));
            times.push_back(clip.time(sample));
            xs.push_back(clip.disk(sample).x);
        }
    }
    const int slices = parts / across, slice = part / across, column = part % across;
    return {cut(times, slice, slices), cut(times, slice + 1, slices), cut(xs, column, across),
            cut(xs, column + 1, across)};
}

}  // namespace mobb
