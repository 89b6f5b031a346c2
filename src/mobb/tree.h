/// MOBB and UMOBB trees (paper, Sections 3 and 4), and two kinds beyond the paper, over one clip.
#pragma once

#include <mobb/blocks.h>
#include <mobb/box.h>
#include <mobb/clip.h>
#include <mobb/fit.h>

#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace mobb {

struct FitOptions {
    TreeKind tree = TreeKind::mobb;  ///< the paper's best all round
    // A production tree has blocks of its own making: of these options it takes the time scale alone, for its boxes.
    int leaf = 10;   ///< n_min >= 1: a node of at most so many samples is a leaf; 10 is the paper's optimum
    int levels = 0;  ///< 0: all; n >= 1: level n-1 is the last. 1 is the paper's "1 level" tree
    Axes axes = Axes::endpoints;  ///< the paper's
    double time_scale = 1.0;      ///< w > 0, metres per second that mix time with space in 3D boxes; the paper's is 1

    friend bool operator==(const FitOptions&, const FitOptions&) = default;
};

/// Largest time_scale taken (m/s); the smallest is its inverse.
inline constexpr double kMaxTimeScale = 1e6;

/// As in files and on the command line; mobb/kinds.h has them.
std::string_view name(TreeKind kind);
std::optional<TreeKind> tree_kind_from_name(std::string_view name);
std::span<const std::string_view> tree_kind_names();

/// Throws std::invalid_argument, naming the option, if one is out of range.
void check(const FitOptions& options);

struct Node {
    Box box;  ///< in the clip's own frame
    int first = 0;
    int count = 0;
    int parent = -1;             ///< -1 at the root
    int children[2] = {-1, -1};  ///< in time order; -1 in a leaf. Of a production tree the first and the last child
    int level = 0;               ///< 0 at the root

    bool is_leaf() const { return children[0] < 0; }
    int end() const { return first + count; }
};

/// A flat array of nodes, the root first: in depth-first order, or of a production tree level by level. Immutable; safe
/// to query from any number of threads.
class Tree {
  public:
    /// Throws std::invalid_argument if there is no clip or an option is out of range.
    Tree(ClipPtr clip, const FitOptions& options);

    const Clip& clip() const { return *clip_; }
    const ClipPtr& shared_clip() const { return clip_; }
    const FitOptions& options() const { return options_; }
    double time_scale() const { return options_.time_scale; }
    std::span<const Node> nodes() const { return nodes_; }
    int depth() const { return depth_; }  ///< number of levels, >= 1
    /// What the nodes of a production tree are, by the same numbers; of another tree nothing.
    const Blocks* blocks() const { return blocks_.get(); }
    /// The child of an inner node that holds a sample of it.
    int child_with(const Node& node, int sample) const;

    /// How many nodes of its level come before a node, in the order of time.
    int place_in_level(int node) const { return places_[static_cast<std::size_t>(node)]; }

    /// Clip time covered by a node, [t0, t1) in seconds.
    double t0(const Node& node) const { return node.first * clip_->dt(); }
    double t1(const Node& node) const { return node.end() * clip_->dt(); }

  private:
    int build(SampleRange range, int parent, int level);
    void build_blocks();

    ClipPtr clip_;
    FitOptions options_;
    std::shared_ptr<const Blocks> blocks_;
    std::vector<Node> nodes_;
    std::vector<int> places_;  ///< by node, see place_in_level
    int depth_ = 0;
};

}  // namespace mobb
