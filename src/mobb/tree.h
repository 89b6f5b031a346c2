/// MOBB and UMOBB trees (paper, Sections 3 and 4) over one clip.
#pragma once

#include <mobb/box.h>
#include <mobb/clip.h>
#include <mobb/fit.h>

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace mobb {

enum class TreeKind : std::uint8_t {
    mobb,     ///< 2D oriented boxes extruded in time
    umobb,    ///< free boxes in space-time
    hybrid1,  ///< MOBB root, UMOBB below (paper, Section 5)
    hybrid2,  ///< UMOBB root, MOBB below
};

struct FitOptions {
    TreeKind tree = TreeKind::mobb;  ///< the paper's best all round
    int leaf = 10;   ///< n_min >= 1: a node of at most so many samples is a leaf; 10 is the paper's optimum
    int levels = 0;  ///< 0: all; n >= 1: level n-1 is the last. 1 is the paper's "1 level" tree
    Axes axes = Axes::endpoints;  ///< the paper's
    double time_scale = 1.0;      ///< w > 0, metres per second that mix time with space in 3D boxes; the paper's is 1

    friend bool operator==(const FitOptions&, const FitOptions&) = default;
};

/// Largest time_scale taken (m/s); the smallest is its inverse.
inline constexpr double kMaxTimeScale = 1e6;

/// Names as they stand in files and on the command line: "mobb", "endpoints", "obb2d", ...
std::string_view name(TreeKind kind);
std::string_view name(Axes axes);
std::string_view name(BoxKind kind);
std::optional<TreeKind> tree_kind(std::string_view name);
std::optional<Axes> axes_from_name(std::string_view name);
std::span<const std::string_view> tree_kind_names();
std::span<const std::string_view> axes_names();

struct Node {
    Box box;  ///< in the clip's own frame
    int first = 0;
    int count = 0;
    int parent = -1;             ///< -1 at the root
    int children[2] = {-1, -1};  ///< in time order; -1 in a leaf
    int level = 0;               ///< 0 at the root

    bool is_leaf() const { return children[0] < 0; }
    int end() const { return first + count; }
};

/// A flat array of nodes in depth-first order, the root first. Immutable; safe to query from any number of threads.
class Tree {
  public:
    /// Throws std::invalid_argument if an option is out of range.
    Tree(ClipPtr clip, const FitOptions& options);

    const Clip& clip() const { return *clip_; }
    const ClipPtr& shared_clip() const { return clip_; }
    const FitOptions& options() const { return options_; }
    double time_scale() const { return options_.time_scale; }
    std::span<const Node> nodes() const { return nodes_; }
    int depth() const { return depth_; }  ///< number of levels, >= 1

    /// Clip time covered by a node, [t0, t1) in seconds.
    double t0(const Node& node) const { return node.first * clip_->dt(); }
    double t1(const Node& node) const { return node.end() * clip_->dt(); }

  private:
    int build(SampleRange range, int parent, int level);

    ClipPtr clip_;
    FitOptions options_;
    std::vector<Node> nodes_;
    int depth_ = 0;
};

/// Throws std::invalid_argument, naming the option, if one is out of range.
void check(const FitOptions& options);

/// How well one level bounds its clip. The figures cover the level's nodes and the leaves above it: always the whole
/// clip.
struct LevelFigures {
    int level = 0;
    int nodes = 0;
    double volume = 0;  ///< of the boxes, m^2*s
    std::optional<double>
        tightness;  ///< volume of the cylinders / volume of the boxes; none where the boxes have no volume
};
std::vector<LevelFigures> level_figures(const Tree& tree);

/// Sum over the samples of pi*r^2*dt, m^2*s.
double cylinder_volume(const Clip& clip);

/// A tree seen through a placement: a node source of the traversal. It refers to the tree, which must outlive it.
class PlacedTree {
  public:
    PlacedTree(const Tree& tree, const Placement& placement)
        : nodes_(tree.nodes().data()), placed_(tree.clip(), placement), tree_(&tree) {}

    const Tree& tree() const { return *tree_; }
    const Node& node(int i) const { return nodes_[i]; }
    double time_scale() const { return tree_->time_scale(); }
    const PlacedClip& placed_clip() const { return placed_; }
    /// Global time, as the samples that bound the node have it: so a node is never apart from what its samples meet.
    double begin(const Node& node) const { return placed_.time(node.first); }
    double end(const Node& node) const { return placed_.time(node.end()); }

  private:
    const Node* nodes_;
    PlacedClip placed_;
    const Tree* tree_;
};

}  // namespace mobb
