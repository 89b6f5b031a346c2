/// The paths that a picture is about.
#pragma once

#include <base/color.h>
#include <scene/fitted_scene.h>

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace mobbscope {

/// A path that is drawn: who, with which tree, in which colour. Refers to the fitted scene.
struct DrawnAgent {
    mobb::PlacedTree placed;
    std::string name;
    std::string label;  ///< the name as pictures say it: short enough to leave room for what is said of it
    Rgba color;
    int index = 0;                       ///< in DrawList::agents
    const Skeleton* skeleton = nullptr;  ///< of the clip; null: none, or it has a body
    int run_agent = -1;                  ///< of a run: who plays it, as Agent::run_agent; else -1
    bool goes_on = false;                ///< of a run: another play begins when this one ends
    /// Of a run in space-time: the samples within the view's window, maybe none; nothing: all of them.
    std::optional<mobb::SampleRange> window{};
    /// Its cell, if the view lays out a grid: `placed` is where it is drawn there, which answers nothing.
    std::optional<GridCell> cell{};
    bool hidden = false;           ///< it has its place in lists and frames, but is not drawn
    bool pinned = false;           ///< see ViewState::pinned
    bool outlined = false;         ///< others are in the foreground: of it an outline is left (ViewState::foreground)
    bool dimmed = false;           ///< others stand out: its colour is on the way to the background's
    bool named = false;            ///< its name stands in the picture, however many there are
    std::optional<int> subtree{};  ///< of its boxes those of this node and below it are drawn alone
    std::vector<mobb::PlacedClip> members{};  ///< of a body: the paths of its disks, which are drawn in place of clip()

    bool is_whole() const { return !hidden && !outlined; }
    const mobb::PlacedClip& clip() const { return placed.placed_clip(); }
    /// What is drawn of it: clip(), or its members. All have as many samples, at the same times.
    std::span<const mobb::PlacedClip> paths() const {
        return members.empty() ? std::span(&clip(), 1) : std::span<const mobb::PlacedClip>(members);
    }
    /// Of a query the member that is asked; else all.
    bool is_asked(const mobb::PlacedClip& path) const { return &path.clip() == &clip().clip(); }
    mobb::SampleRange samples() const { return window.value_or(mobb::SampleRange{0, clip().count()}); }  ///< drawn
    double begin() const { return clip().time(0); }
    double end() const { return clip().time(clip().count()); }
};

/// As scene/arrangement.h has it, of an agent that is drawn without a query.
const std::string& name_in_view(const Scene& scene, const DrawnAgent& agent);

/// Where a view shows an agent of the scene: where it is, or in its cell.
mobb::Placement shown_placement(const FittedScene& fitted, const ViewState& view, const PlacedAgent& who);

/// DrawnAgent::members of who is drawn at a placement.
std::vector<mobb::PlacedClip> drawn_members(const Scene& scene, const PlacedAgent& who, const mobb::Placement& at);

/// The colour of an agent: its own, or the palette's by index. None of them is an outcome's colour.
Rgba agent_color(const Scene& scene, const PlacedAgent& who, int index);

/// The colours of the two sides of a query: their own, but two that can be told apart.
std::array<Rgba, 2> query_colors(const Scene& scene, const PlacedAgent& a, const PlacedAgent& b);

/// The scene's agents, of a run made a scene (scene/crowd_scene.h) cut to the view's window of time; with a query
/// in the view, its two sides; those that the view hides too. Throws std::invalid_argument if the scene has no such
/// query.
std::vector<DrawnAgent> drawn_agents(const FittedScene& fitted, const ViewState& view);

/// The sample that holds at a global time, or runs to the next; of a linear clip the last one when the clip ends,
/// unless the agent goes on with another. None: nobody is there.
std::optional<int> sample_at(const DrawnAgent& agent, double time);

/// A node's box in world (x, y, w*t), global time. An aabb is wrapped again along the world's x and y.
mobb::Box world_box(const mobb::PlacedTree& tree, int node);

}  // namespace mobbscope
