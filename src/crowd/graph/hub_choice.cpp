#include <base/threads.h>
#include <crowd/graph/hub_choice.h>

#include <glm/geometric.hpp>

#include <tbb/parallel_for.h>

#include <algorithm>
#include <tuple>
#include <utility>

namespace mobbscope {

namespace {

constexpr double kLeastGain = 1;  // second
constexpr double kJump = 3;       // metres per second that the root's velocity changes from step to step; people: 0.9

/// A cut, and at which of the hubs.
struct HubCut {
    Cut cut;
    int hub = 0;
};

std::vector<HubCut> cuts_of(const std::vector<const Hub*>& hubs) {
    std::vector<HubCut> out;
    for (std::size_t h = 0; h < hubs.size(); ++h) {
        for (const Cut& cut : hubs[h]->cuts) out.push_back({cut, static_cast<int>(h)});
    }
    std::ranges::sort(out, {}, [](const HubCut& of) { return std::tuple(of.cut.recording, of.cut.frame, of.hub); });
    return out;
}

/// Calls visit(begin, end) for each pair of cuts of one recording that are as far apart as a move may be long.
template <class Visit>
void for_each_pair(const std::vector<Recording>& recordings, const std::vector<HubCut>& cuts,
                   const GraphOptions& options, const Visit& visit) {
    for (std::size_t i = 0; i < cuts.size(); ++i) {
        const double dt = recordings[static_cast<std::size_t>(cuts[i].cut.recording)].track.dt;
        for (std::size_t j = i + 1; j < cuts.size() && cuts[j].cut.recording == cuts[i].cut.recording; ++j) {
            const double seconds = (cuts[j].cut.frame - cuts[i].cut.frame) * dt;
            if (seconds > options.most_seconds + 1e-9) break;
            if (seconds >= options.least_seconds - 1e-9) visit(cuts[i], cuts[j]);
        }
    }
}

/// Seconds of the recordings that lie in pieces between hubs which lead to each other.
double covered_seconds(const std::vector<Recording>& recordings, const std::vector<const Hub*>& hubs,
                       const GraphOptions& options) {
    const std::vector<HubCut> cuts = cuts_of(hubs);
    const std::size_t n = hubs.size();
    std::vector<bool> joined(n * n, false);
    for_each_pair(recordings, cuts, options, [&](const HubCut& a, const HubCut& b) {
        joined[static_cast<std::size_t>(a.hub) * n + static_cast<std::size_t>(b.hub)] = true;
    });
    std::vector<std::pair<int, int>> edges;
    for (std::size_t e = 0; e < joined.size(); ++e) {
        if (joined[e]) edges.emplace_back(static_cast<int>(e / n), static_cast<int>(e % n));
    }
    const std::vector<int> component = strong_components(static_cast<int>(n), edges);
    double seconds = 0;
    int recording = -1;
    int covered_to = 0;  // frame of that recording
    for_each_pair(recordings, cuts, options, [&](const HubCut& a, const HubCut& b) {
        if (component[static_cast<std::size_t>(a.hub)] != component[static_cast<std::size_t>(b.hub)]) return;
        if (a.cut.recording != recording) covered_to = 0;
        recording = a.cut.recording;
        const int from = std::max(a.cut.frame, covered_to);
        if (b.cut.frame <= from) return;
        seconds += (b.cut.frame - from) * recordings[static_cast<std::size_t>(recording)].track.dt;
        covered_to = b.cut.frame;
    });
    return seconds;
}

/// The frames after which the path of a track jumps.
std::vector<int> jumps_of(const PoseTrack& track) {
    std::vector<int> out;
    for (int frame = 1; frame + 1 < track.frames(); ++frame) {
        if (glm::distance(track.velocity(frame - 1), track.velocity(frame)) > kJump) out.push_back(frame);
    }
    return out;
}

}  // namespace

std::vector<Piece> pieces_between(const std::vector<Recording>& recordings, const std::vector<Hub>& hubs,
                                  const GraphOptions& options) {
    std::vector<const Hub*> all;
    for (const Hub& hub : hubs) all.push_back(&hub);
    std::vector<std::vector<int>> jumps;
    for (const Recording& recording : recordings) jumps.push_back(jumps_of(recording.track));
    std::vector<Piece> out;
    for_each_pair(recordings, cuts_of(all), options, [&](const HubCut& a, const HubCut& b) {
        const auto& frames = jumps[static_cast<std::size_t>(a.cut.recording)];
        const auto jump = std::lower_bound(frames.begin(), frames.end(), a.cut.frame);
        if (jump != frames.end() && *jump <= b.cut.frame) return;
        out.push_back({a.hub, b.hub, a.cut, b.cut});
    });
    return out;
}

std::vector<Hub> choose_hubs(const std::vector<Recording>& recordings, const std::vector<Hub>& candidates,
                             const GraphOptions& options) {
    std::vector<const Hub*> chosen;
    double covered = 0;
    while (static_cast<int>(chosen.size()) < options.hubs) {
        std::vector<double> seconds(candidates.size());
        limit_worker_threads();
        tbb::parallel_for(std::size_t{0}, candidates.size(), [&](std::size_t i) {
            std::vector<const Hub*> with = chosen;
            with.push_back(&candidates[i]);
            seconds[i] = covered_seconds(recordings, with, options);
        });
        // The first of equals: the same whatever the number of threads.
        const auto best = std::max_element(seconds.begin(), seconds.end());
        if (best == seconds.end() || *best < covered + kLeastGain) break;
        covered = *best;
        chosen.push_back(&candidates[static_cast<std::size_t>(best - seconds.begin())]);
    }
    std::vector<Hub> out;
    for (const Hub* hub : chosen) out.push_back(*hub);
    return out;
}

}  // namespace mobbscope
