#include <conflicts/conflicts.h>
#include <mobb/predicate.h>
#include <mobb/traversal.h>
#include <scene/crowd_run.h>
#include <scene/crowd_scene.h>
#include <scene/motion_graph.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <unordered_map>
#include <utility>

namespace mobbscope {

namespace {

/// Told of every pair of samples that collides, in order of time; keeps the one that overlaps deepest.
struct DeepestPair {
    const mobb::PlacedClip& a;
    const mobb::PlacedClip& b;
    Conflict& conflict;

    bool operator()(int i, int j) {
        const mobb::Contact contact = mobb::contact_of(a, i, b, j);
        const double clearance = contact.distance - contact.radii;
        if (clearance >= conflict.least_clearance) return false;
        conflict.least_clearance = clearance;
        conflict.time = contact.time;
        conflict.a_sample = i;
        conflict.b_sample = j;
        return false;
    }
};

/// The pair's conflict; without intervals if there is none. Where two collide the least clearance is that of a pair of
/// samples that collides: no other is measured for it.
Conflict conflict_of(const mobb::PlacedTree& a, const mobb::PlacedTree& b, Search search) {
    const bool direct = search == Search::direct;
    Conflict conflict;
    conflict.intervals =
        direct ? mobb::direct_contact_intervals(a.placed_clip(), b.placed_clip()) : mobb::contact_intervals(a, b);
    if (conflict.intervals.empty()) return conflict;
    conflict.least_clearance = std::numeric_limits<double>::infinity();
    mobb::NoObserver observer;
    DeepestPair deepest{a.placed_clip(), b.placed_clip(), conflict};
    if (direct) {
        mobb::visit_sample_pairs(deepest.a, 0, deepest.a.count(), deepest.b, 0, deepest.b.count(), observer, deepest);
    } else {
        mobb::Traversal(a, b, observer, deepest).run();
    }
    return conflict;
}

constexpr int kPieceSamples = 16;  // few enough that a piece is small on the floor, enough that pieces are few
constexpr double kMostCellsPerPiece = 8;
// Widens the pieces by more than any rounding of the predicate: it must not hit where they are apart.
constexpr double kWidening = 1e-14;

/// Some samples of a member: where they are on the floor, and when.
struct PathPiece {
    int member = 0;
    double t0 = 0, t1 = 0;
    double x0 = 0, x1 = 0, y0 = 0, y1 = 0;
};

bool near(const PathPiece& a, const PathPiece& b) {
    return a.x0 <= b.x1 && b.x0 <= a.x1 && a.y0 <= b.y1 && b.y0 <= a.y1 &&
           mobb::overlap_in_time(a.t0, a.t1, b.t0, b.t1);
}

std::vector<PathPiece> cut(std::span<const mobb::PlacedTree> crowd) {
    std::vector<PathPiece> pieces;
    for (std::size_t member = 0; member < crowd.size(); ++member) {
        const mobb::PlacedClip& clip = crowd[member].placed_clip();
        for (int first = 0; first < clip.count(); first += kPieceSamples) {
            const int end = std::min(clip.count() - first, kPieceSamples) + first;
            constexpr double kFar = std::numeric_limits<double>::infinity();
            PathPiece piece{static_cast<int>(member), clip.time(first), clip.time(end), kFar, -kFar, kFar, -kFar};
            // A linear clip runs on to the next disk.
            const bool runs_on = clip.clip().motion() == mobb::Motion::linear && end < clip.count();
            for (int i = first; i < (runs_on ? end + 1 : end); ++i) {
                const mobb::Disk disk = clip.disk(i);
                const double wide = disk.r + kWidening * (std::abs(disk.x) + std::abs(disk.y) + disk.r);
                piece.x0 = std::min(piece.x0, disk.x - wide);
                piece.x1 = std::max(piece.x1, disk.x + wide);
                piece.y0 = std::min(piece.y0, disk.y - wide);
                piece.y1 = std::max(piece.y1, disk.y + wide);
            }
            pieces.push_back(piece);
        }
    }
    return pieces;
}

/// Square cells on the floor.
class Grid {
  public:
    /// Chooses cells as large as a piece is wide on average, and larger ones where some pieces would cover too many.
    explicit Grid(std::span<const PathPiece> pieces) {
        const auto count = static_cast<double>(pieces.size());
        double width = 0;
        double largest = 0;
        for (const PathPiece& piece : pieces) {
            width += std::max(piece.x1 - piece.x0, piece.y1 - piece.y0) / count;
            largest =
                std::max({largest, std::abs(piece.x0), std::abs(piece.x1), std::abs(piece.y0), std::abs(piece.y1)});
        }
        // The numbers of cells fit 31 bits.
        size_ = std::max({width, largest * 0x1p-30, std::numeric_limits<double>::min()});
        while (cells_covered(pieces) > kMostCellsPerPiece * count) size_ *= 2;
    }

    template <class Visit>
    void for_each_cell(const PathPiece& piece, Visit visit) const {
        for (std::int64_t x = cell(piece.x0); x <= cell(piece.x1); ++x) {
            for (std::int64_t y = cell(piece.y0); y <= cell(piece.y1); ++y) visit(x * (std::int64_t{1} << 32) + y);
        }
    }

  private:
    std::int64_t cell(double coordinate) const { return static_cast<std::int64_t>(std::floor(coordinate / size_)); }

    double cells_covered(std::span<const PathPiece> pieces) const {
        double sum = 0;
        for (const PathPiece& piece : pieces) {
            sum += static_cast<double>(cell(piece.x1) - cell(piece.x0) + 1) *
                   static_cast<double>(cell(piece.y1) - cell(piece.y0) + 1);
        }
        return sum;
    }

    double size_ = 1;
};

/// Everything that is walked in it.
std::vector<PlacedAgent> paths_of(const FittedScene& fitted) {
    const Scene& scene = fitted.scene();
    if (!is_run(scene)) return fitted.placed_agents();
    std::vector<PlacedAgent> out;
    for (std::size_t run_agent = 0; run_agent < scene.crowd->agents.size(); ++run_agent) {
        const CrowdAgent& agent = scene.crowd->agents[run_agent];
        for (const Play& play : agent.plays) {
            const int clip = scene.graph->moves[static_cast<std::size_t>(play.move)].clip;
            out.push_back({agent.name, clip, play.placement, static_cast<int>(run_agent)});
        }
    }
    return out;
}

}  // namespace

Conflicts find_conflicts(std::span<const mobb::PlacedTree> crowd, Search search, const Progress& progress) {
    Conflicts out;
    const auto test = [&](std::size_t a, std::size_t b, std::size_t pairs) {
        if (progress) progress(static_cast<std::size_t>(out.pairs_tested), pairs);
        ++out.pairs_tested;
        Conflict conflict = conflict_of(crowd[a], crowd[b], search);
        if (conflict.intervals.empty()) return;
        conflict.a = static_cast<int>(a);
        conflict.b = static_cast<int>(b);
        out.found.push_back(std::move(conflict));
    };
    if (search == Search::trees) {
        const std::vector<std::pair<int, int>> pairs = near_pairs(crowd);
        for (const auto& [a, b] : pairs) test(static_cast<std::size_t>(a), static_cast<std::size_t>(b), pairs.size());
        return out;
    }
    for (std::size_t a = 0; a < crowd.size(); ++a) {
        for (std::size_t b = a + 1; b < crowd.size(); ++b) test(a, b, crowd.size() * (crowd.size() - 1) / 2);
    }
    return out;
}

std::vector<std::pair<int, int>> near_pairs(std::span<const mobb::PlacedTree> crowd) {
    std::vector<PathPiece> pieces = cut(crowd);
    std::vector<std::pair<int, int>> pairs;
    if (pieces.empty()) return pairs;
    std::sort(pieces.begin(), pieces.end(), [](const PathPiece& a, const PathPiece& b) { return a.t0 < b.t0; });
    const Grid grid(pieces);
    std::unordered_map<std::int64_t, std::vector<const PathPiece*>> present;  // by cell: pieces that may not have ended
    for (const PathPiece& piece : pieces) {
        grid.for_each_cell(piece, [&](std::int64_t cell) {
            std::vector<const PathPiece*>& others = present[cell];
            std::erase_if(others, [&](const PathPiece* other) { return other->t1 <= piece.t0; });
            for (const PathPiece* other : others) {
                if (other->member != piece.member && near(*other, piece))
                    pairs.emplace_back(std::min(other->member, piece.member), std::max(other->member, piece.member));
            }
            others.push_back(&piece);
        });
    }
    std::sort(pairs.begin(), pairs.end());
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
    return pairs;
}

std::vector<SceneConflict> conflicts_in(const FittedScene& fitted, const Progress& progress) {
    const std::vector<PlacedAgent> paths = paths_of(fitted);
    std::vector<mobb::PlacedTree> trees;
    trees.reserve(paths.size());
    for (const PlacedAgent& path : paths) trees.push_back(fitted.placed(path));
    std::vector<SceneConflict> out;
    for (const Conflict& found : find_conflicts(trees, Search::trees, progress).found) {
        const PlacedAgent& a = paths[static_cast<std::size_t>(found.a)];
        const PlacedAgent& b = paths[static_cast<std::size_t>(found.b)];
        // A person's plays join; a hair of overlap in time is no meeting.
        if (is_run(fitted.scene()) && a.agent == b.agent) continue;
        out.push_back({a, b, found});
    }
    std::stable_sort(out.begin(), out.end(),
                     [](const SceneConflict& a, const SceneConflict& b) { return a.begin() < b.begin(); });
    return out;
}

}  // namespace mobbscope
