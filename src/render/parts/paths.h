/// Paths: a stack of disks growing in time, and its trace on the floor.
#pragma once

#include <mobb/clip.h>
#include <render/drawlist/draw_list.h>
#include <scene/drawn_agent.h>

#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace mobbscope {

/// How much of its colour a disk outside the nodes under test keeps.
inline constexpr float kOutOfFocus = 0.38f;

/// How much of its colour an agent keeps where another stands out.
inline constexpr float kDimmed = 0.3f;

/// How much of its colour a disk keeps behind boxes whose colours are to be read.
inline constexpr float kBehind = 0.5f;

/// Which samples of a path matter now; those outside step back.
struct PathFocus {
    std::optional<mobb::SampleRange> range;  ///< none: all
    std::optional<int> hit;                  ///< a sample that collides
    bool behind = false;                     ///< the boxes' colours matter more: all disks step back
    /// By sample, where a figure of theirs is shown; null: the agent's colour.
    std::shared_ptr<const std::vector<Rgba>> colors{};

    friend bool operator==(const PathFocus& a, const PathFocus& b) {
        const auto span_of = [](const PathFocus& focus) {
            return focus.range ? std::pair(focus.range->first, focus.range->count) : std::pair(-1, -1);
        };
        return span_of(a) == span_of(b) && a.hit == b.hit && a.behind == b.behind && a.colors == b.colors;
    }
};

/// The text's colour for lines of an agent, which dim with it.
Rgba line_color_of(const DrawnAgent& agent, const Palette& palette);

/// A disk for each sample; of a linear clip it leans to the next one.
void add_disks(DrawList& list, const DrawnAgent& agent, const PathFocus& focus);

/// Gives the disks from `first` on, which add_disks made of this agent, the colours of another focus. Returns where the
/// next agent's begin.
std::size_t color_disks(std::vector<DiskInstance>& disks, std::size_t first, const Palette& palette,
                        const DrawnAgent& agent, const PathFocus& focus);

/// The line of centres, where the disks are too small to be seen.
void add_thin_path(DrawList& list, const DrawnAgent& agent, float width);

/// The line of centres of who is not in the foreground.
void add_path_outline(DrawList& list, const DrawnAgent& agent, float scale);

/// How a path looks on the floor where nothing else is said of it.
Rgba floor_trace_color(const DrawnAgent& agent, const Palette& palette);

/// The way of the centres of some samples at height `floor` (drawn space). `width`: pixels.
void add_floor_trace(DrawList& list, const DrawnAgent& agent, mobb::SampleRange range, float floor, Rgba color,
                     float width);

/// The outline of a sample's disk, seen through everything: one line for what the time cursor meets, a heavy and a fine
/// one in the colour of hits for what collides. Of a held clip at half the disk's height, of a linear one where and as
/// wide as the disk is at a global time within the sample's.
void add_cursor_ring(DrawList& list, const DrawnAgent& agent, int sample, double time, float scale, int pieces = 48);
void add_hit_ring(DrawList& list, const DrawnAgent& agent, int sample, double time, float scale);

struct DiskOverlap {
    /// Its two outlines from end to end, as many points in each; rows of points across it. World metres.
    std::array<std::vector<glm::dvec2>, 2> sides;
    bool has_tips = false;  ///< the circles cross at the ends of the outlines
};

/// `rows` >= 2 points in each outline; both are empty if the disks do not overlap.
DiskOverlap disk_overlap(const mobb::Disk& a, const mobb::Disk& b, int rows);

}  // namespace mobbscope
