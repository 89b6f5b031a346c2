/// Overlaps that a tighter box would have avoided.
///
/// An overlap of a box test is *avoidable* if one line on the floor, fixed or moving evenly, keeps the disks of the two
/// nodes apart as long as both last. Above samples that collide there is no such line.
///
/// To *blame* is the box in whose place another one of its kind around the same disks would not have met the present
/// box of the other node: turned otherwise, of a free or moving box also leaning otherwise. Boxes along the axes cannot
/// turn, so such a one is to blame only where it was wrapped again in a clip that is rotated. Blocks are round: as
/// tight along one direction as along any, so none is to blame. If either box would have done it, the one of the deeper
/// level is to blame; on one level the one whose change leaves the wider gap. If only both together would have, both
/// are. If no boxes of their kinds would have, as where only a moving line parts what upright boxes hold, none is.
#pragma once

#include <explain/separating_line.h>
#include <mobb/placed_tree.h>
#include <mobb/trace.h>
#include <scene/fitted_scene.h>

#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

namespace mobbscope {

enum class Blame : std::uint8_t { none, a, b, both };

/// Whether the box of A (0) or B (1) is to blame, alone or with the other.
constexpr bool blames(Blame blame, int side) {
    return blame == Blame::both || blame == (side == 0 ? Blame::a : Blame::b);
}

struct AvoidableOverlap {
    Tile line;  ///< that keeps the disks apart, over the common time
    Blame blame = Blame::none;
};

/// Of a box test that found an overlap, if it was avoidable; none for another event.
std::optional<AvoidableOverlap> avoidable_overlap(const mobb::PlacedTree& a, const mobb::PlacedTree& b,
                                                  const mobb::Trace::Event& event);

/// What is known of the overlaps of a query.
struct AvoidableOverlaps {
    std::vector<int> events;              ///< that are avoidable overlaps, in order
    std::vector<AvoidableOverlap> found;  ///< what is known of each
    std::int64_t judged = 0;              ///< box tests that found an overlap: so many, the first of them, were judged
    std::int64_t overlaps = 0;            ///< ... of these

    bool all_judged() const { return judged == overlaps; }
    /// Null if the event is none, or was not judged.
    const AvoidableOverlap* at(int event) const;
    /// How many there are among the events [0, end).
    std::int64_t before(int end) const;
};

/// What the window spends on each new trace: disks and boxes looked at, some 30 ns each with the rest.
inline constexpr std::int64_t kVisitsWhileDragging = 150'000;
inline constexpr std::int64_t kAnyVisits = std::numeric_limits<std::int64_t>::max();

/// Judges the overlaps in order, until it has looked at so many disks and boxes. `trace` must be that of a query of
/// these two. `progress` is told how much of the trace is done.
AvoidableOverlaps avoidable_overlaps(const mobb::Trace& trace, const mobb::PlacedTree& a, const mobb::PlacedTree& b,
                                     std::int64_t most_visits = kAnyVisits, const Progress& progress = {});

/// How many avoidable overlaps each node of a clip's tree is to blame for.
using BlameByNode = std::vector<std::int64_t>;

struct BlameInScene {
    explicit BlameInScene(const FittedScene& fitted) : of_clip(fitted.scene().clips.size()) {}

    std::vector<BlameByNode> of_clip;  ///< by clip and node; empty of a clip that no query asks
    std::int64_t overlaps = 0;         ///< that are avoidable, in all queries
    std::int64_t without_blame = 0;    ///< ... of these, of which no box is to blame

    std::int64_t of(int clip, int node) const;
    void add(const FittedScene& fitted, const SceneQuery& query, const mobb::Trace& trace,
             const AvoidableOverlaps& avoidable);
};

/// Over all queries of a scene. `progress` is told after each.
BlameInScene blame_in(const FittedScene& fitted, const Progress& progress = {});

}  // namespace mobbscope
