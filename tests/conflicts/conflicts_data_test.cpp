// Conflicts of real trajectories, where the shared data set is, against an exact search written here: over the straight
// segments between the points of each track, of which nobody is there before the first and after the last.
#include <conflicts/conflicts.h>
#include <scene/scene.h>
#include <support/folders.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace mobbscope {
namespace {

using Real = long double;

/// A point of a track.
struct Seen {
    Real t, x, y, r;
};

struct SeenTrack {
    std::string name;
    std::vector<Seen> points;
};

Seen between(const Seen& a, const Seen& b, Real t) {
    const Real s = b.t > a.t ? (t - a.t) / (b.t - a.t) : 0;
    return {t, a.x + s * (b.x - a.x), a.y + s * (b.y - a.y), a.r + s * (b.r - a.r)};
}

struct Span {
    Real begin, end;
};

/// When two tracks overlap: roots of |d|^2 = r^2 over every pair of segments that share time.
std::vector<Span> overlaps_of(const SeenTrack& a, const SeenTrack& b) {
    std::vector<Span> out;
    const auto add = [&](Real begin, Real end) {
        if (!out.empty() && begin - out.back().end <= 1e-9L) {
            out.back().end = end;
        } else {
            out.push_back({begin, end});
        }
    };
    for (std::size_t i = 0, j = 0; i + 1 < a.points.size() && j + 1 < b.points.size();) {
        const Seen &a0 = a.points[i], &a1 = a.points[i + 1], &b0 = b.points[j], &b1 = b.points[j + 1];
        const Real from = std::max(a0.t, b0.t), to = std::min(a1.t, b1.t);
        if (to - from > 1e-9L) {
            const Seen pa = between(a0, a1, from), qa = between(a0, a1, to);
            const Seen pb = between(b0, b1, from), qb = between(b0, b1, to);
            const Real dx = pa.x - pb.x, dy = pa.y - pb.y, r = pa.r + pb.r;
            const Real vx = qa.x - qb.x - dx, vy = qa.y - qb.y - dy, vr = qa.r + qb.r - r;
            const Real square = vx * vx + vy * vy - vr * vr, half = dx * vx + dy * vy - r * vr;
            const Real still = dx * dx + dy * dy - r * r;
            const auto at = [&](Real s) { return from + s * (to - from); };
            if (square <= 0) {
                EXPECT_EQ(vr, 0) << "radii of these files do not change";
                if (still < 0) add(from, to);
            } else if (const Real root = half * half - square * still; root > 0) {
                const Real begin = std::max<Real>(0, (-half - std::sqrt(root)) / square);
                const Real end = std::min<Real>(1, (-half + std::sqrt(root)) / square);
                if (begin < end) add(at(begin), at(end));
            }
        }
        a1.t < b1.t ? ++i : ++j;
    }
    return out;
}

/// Tracks as they were read, by points alone.
std::vector<SeenTrack> tracks_of(const Scene& scene) {
    std::vector<SeenTrack> out;
    for (const Agent& agent : scene.agents) {
        const mobb::Clip& clip = *scene.clips[static_cast<std::size_t>(agent.clip)].clip;
        SeenTrack& track = out.emplace_back();
        track.name = agent.name;
        for (int i = 0; i < clip.count(); ++i) {
            const mobb::Disk& d = clip.samples()[static_cast<std::size_t>(i)];
            track.points.push_back({agent.placement.start + i * clip.dt(), d.x, d.y, d.r});
        }
        // One point alone holds for a step.
        if (clip.count() == 1) {
            track.points.push_back(track.points.front());
            track.points.back().t += clip.dt();
        }
    }
    return out;
}

TEST(ConflictsData, AreThoseOfAnExactSearchOfSegments) {
    const auto folder = kSharedData / "trajectories";
    if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no test data at " << folder;
    std::size_t conflicts = 0;
    std::vector<std::pair<std::filesystem::path, double>> crowds;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        // In one of the files a pixel counts as a metre.
        const bool in_pixels = entry.path().filename().string().starts_with("sdd");
        for (const double radius : {0.2, 0.4}) {
            if (entry.is_regular_file()) crowds.emplace_back(entry.path(), in_pixels ? 100 * radius : radius);
        }
    }
    for (const auto& [file, radius] : crowds) {
        SCOPED_TRACE(file.filename());
        ImportOptions options;
        options.radius = radius;
        const Scene scene = load_scene(file, options);
        const std::vector<SeenTrack> tracks = tracks_of(scene);
        ASSERT_GT(tracks.size(), 1u);
        std::map<std::pair<std::string, std::string>, std::vector<Span>> expected;
        for (std::size_t a = 0; a < tracks.size(); ++a) {
            for (std::size_t b = a + 1; b < tracks.size(); ++b) {
                std::vector<Span> spans = overlaps_of(tracks[a], tracks[b]);
                if (!spans.empty()) expected[{tracks[a].name, tracks[b].name}] = std::move(spans);
            }
        }
        const std::vector<SceneConflict> found = conflicts_in(scene);
        EXPECT_EQ(found.size(), expected.size());
        for (const SceneConflict& conflict : found) {
            const auto at = expected.find({conflict.a.name, conflict.b.name});
            ASSERT_NE(at, expected.end()) << conflict.a.name << " and " << conflict.b.name;
            ASSERT_EQ(conflict.facts.intervals.size(), at->second.size()) << conflict.a.name << ", " << conflict.b.name;
            for (std::size_t i = 0; i < at->second.size(); ++i) {
                EXPECT_NEAR(conflict.facts.intervals[i].t0, static_cast<double>(at->second[i].begin), 1e-7);
                EXPECT_NEAR(conflict.facts.intervals[i].t1, static_cast<double>(at->second[i].end), 1e-7);
            }
        }
        conflicts += found.size();
    }
    EXPECT_EQ(crowds.size(), 18u);
    EXPECT_GT(conflicts, 800u);
}

}  // namespace
}  // namespace mobbscope
