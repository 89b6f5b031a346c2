#include <crowd/graph/cut_search.h>
#include <import/skeleton/motion_clips.h>

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>
#include <utility>

namespace mobbscope {

namespace {

constexpr double kSettling = 0.5;         // seconds left out after a T-pose, which captures blend out of
constexpr double kApart = 0.4;            // seconds between two cuts at one hub
constexpr double kHeadingTime = 0.5;      // seconds before and after that give a heading
constexpr double kHeadingDistance = 0.1;  // metres: shorter ways are sway, not a direction

int frames_in(double seconds, double dt) { return static_cast<int>(std::min(std::ceil(seconds / dt - 1e-6), 1e9)); }

/// Where the root goes around a frame; of one that stands, where it goes next or came from.
double way_at(const PoseTrack& track, int frame) {
    const auto& root = track.root;
    const int reach = frames_in(kHeadingTime, track.dt);
    const int last = track.frames() - 1;
    const auto at = [&](int f) { return root[static_cast<std::size_t>(std::clamp(f, 0, last))]; };
    const glm::dvec2 around = at(frame + reach) - at(frame - reach);
    if (glm::length(around) >= kHeadingDistance) return heading_of(around);
    for (int f = frame + 1; f <= last; ++f) {
        if (glm::length(at(f) - at(frame)) >= kHeadingDistance) return heading_of(at(f) - at(frame));
    }
    for (int f = frame - 1; f >= 0; --f) {
        if (glm::length(at(frame) - at(f)) >= kHeadingDistance) return heading_of(at(frame) - at(f));
    }
    return 0;
}

/// Whether the root's velocity, from the frame before and to the next, is within `bound` of the hub's.
bool moves_like(const PoseTrack& track, int frame, double heading_deg, glm::dvec2 velocity, double bound) {
    const mobb::Rotation turn = mobb::Rotation::from_degrees(-heading_deg);
    return glm::distance(turn(track.velocity(frame - 1)), velocity) <= bound &&
           glm::distance(turn(track.velocity(frame)), velocity) <= bound;
}

/// Of cuts of one recording that are close in time, the most alike.
void keep_most_alike(std::vector<Cut>& cuts, std::size_t first, int apart) {
    std::vector<Cut> ranked(cuts.begin() + static_cast<std::ptrdiff_t>(first), cuts.end());
    std::ranges::sort(ranked, {}, [](const Cut& cut) { return std::pair(cut.distance, cut.frame); });
    cuts.resize(first);
    std::set<int> taken;  // frames; only the neighbours of a frame can be near it
    for (const Cut& cut : ranked) {
        const auto after = taken.lower_bound(cut.frame);
        const bool near_after = after != taken.end() && *after - cut.frame < apart;
        const bool near_before = after != taken.begin() && cut.frame - *std::prev(after) < apart;
        if (near_after || near_before) continue;
        taken.insert(cut.frame);
        cuts.push_back(cut);
    }
    std::ranges::sort(cuts.begin() + static_cast<std::ptrdiff_t>(first), cuts.end(), {}, &Cut::frame);
}

}  // namespace

std::vector<Recording> recordings_of(const Scene& scene, const SceneRigs& rigs) {
    std::vector<Recording> out;
    for (std::size_t i = 0; i < scene.clips.size(); ++i) {
        const SceneClip& clip = scene.clips[i];
        if (!clip.skeleton) continue;
        const int rig = rigs.of_clip[i];
        const auto joints = joints_of(rigs.rigs[static_cast<std::size_t>(rig)], *clip.skeleton);
        PoseTrack track = pose_track(*clip.clip, *clip.skeleton, rig, joints);
        PoseWindows windows(track);
        const int settled = begins_in_other_pose(*clip.clip) ? frames_in(kSettling, track.dt) : 0;
        // A frame more on either side, as velocities need it.
        const int first = std::max({windows.first(), settled, 1});
        const int end = std::min(windows.end(), track.frames() - 1);
        out.push_back({static_cast<int>(i), std::move(track), std::move(windows), first, end});
    }
    return out;
}

HubMoment hub_moment(const std::vector<Recording>& recordings, int recording, int frame) {
    const PoseTrack& track = recordings[static_cast<std::size_t>(recording)].track;
    const double heading = way_at(track, frame);
    const glm::dvec2 velocity = (track.velocity(frame - 1) + track.velocity(frame)) / 2.0;
    return {recording, frame, heading, mobb::Rotation::from_degrees(-heading)(velocity)};
}

std::vector<Cut> cuts_like(const std::vector<Recording>& recordings, const HubMoment& hub, const GraphBounds& bounds) {
    const Recording& from = recordings[static_cast<std::size_t>(hub.recording)];
    const double speed = glm::length(hub.velocity);
    std::vector<Cut> out;
    for (std::size_t r = 0; r < recordings.size(); ++r) {
        const auto& [clip, track, windows, first, end] = recordings[r];
        if (track.rig != from.track.rig || track.dt != from.track.dt) continue;
        const std::size_t first_cut = out.size();
        for (int frame = first; frame < end; ++frame) {
            // Cheaper than to compare poses, and it rules out most.
            if (std::abs(glm::length(track.velocity(frame)) - speed) > bounds.root_speed / 2) continue;
            const Alignment found = PoseWindows::compare(from.windows, hub.frame, windows, frame);
            if (!(found.distance <= bounds.pose_distance / 2)) continue;
            const double heading = hub.heading_deg - found.turn_deg;
            if (!moves_like(track, frame, heading, hub.velocity, bounds.root_speed / 2)) continue;
            out.push_back({static_cast<int>(r), frame, std::remainder(heading, 360.0), found.distance});
        }
        keep_most_alike(out, first_cut, frames_in(kApart, track.dt));
    }
    return out;
}

}  // namespace mobbscope
