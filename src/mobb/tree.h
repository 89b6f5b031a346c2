/// MOBB and UMOBB trees (paper, Sections 3 and 4), and three kinds beyond the paper, over one clip.
#pragma once

#include <mobb/blocks.h>
#include <mobb/box.h>
#include <mobb/clip.h>
#include <mobb/fit.h>

#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace mobb {

struct FitOptions {
    TreeKind tree = TreeKind::mobb;  ///< the paper's best all round
    // A tree of blocks makes these by itself: of these options it takes the time scale alone, for its boxes.
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

/// What is other at one node of a tree than its options say: to find out what that would cost. Answers stay the same.
struct NodeChange {
    int node = -1;
    std::optional<BoxKind> kind{};  ///< of its box; one that has no test in common with those it meets prunes nothing
    std::optional<Axes> axes{};     ///< of its box
    /// How many of its samples the first child gets, where the options take half; 0: it is a leaf. What is below splits
    /// as the options say. The nodes up to this one keep their numbers.
    std::optional<int> split{};
};

/// What a query reads of a node: one cache line.
struct alignas(64) Node {
    Rectangle rectangle;  ///< of an upright box, in the clip's own frame; of others see Tree::box
    int first = 0;
    int count = 0;
    int second_child = -1;  ///< the first child is the next node; -1: a leaf, where blocks or samples are next
    BoxKind kind = BoxKind::obb2d;

    bool is_leaf() const { return second_child < 0; }
    int end() const { return first + count; }
};
static_assert(sizeof(Node) == 64);

/// A flat array of nodes, the root first: in depth-first order, or of blocks level by level. Immutable; safe to
/// query from any number of threads.
class Tree {
  public:
    /// Throws std::invalid_argument if there is no clip or an option is out of range.
    Tree(ClipPtr clip, const FitOptions& options);
    /// With a change, too. Throws std::invalid_argument if it cannot be made: no tree of blocks takes one.
    Tree(ClipPtr clip, const FitOptions& options, const NodeChange& change);

    const Clip& clip() const { return *clip_; }
    const ClipPtr& shared_clip() const { return clip_; }
    const FitOptions& options() const { return options_; }
    double time_scale() const { return options_.time_scale; }
    std::span<const Node> nodes() const { return nodes_; }
    const Node& node(int i) const { return nodes_[static_cast<std::size_t>(i)]; }
    int depth() const { return depth_; }  ///< number of levels, >= 1
    /// What the nodes of a tree of blocks are, by the same numbers; of another tree nothing. All of these are leaves
    /// to a query, which goes on with the blocks.
    const Blocks* blocks() const { return blocks_.get(); }
    /// Of memory: the nodes with all that belongs to them, blocks included, without the clip.
    std::size_t bytes() const;

    /// The node's box in the clip's own frame and time.
    Box box(int i) const;
    /// The same without a copy, of a box that is not upright.
    const Box& stored_box(int i) const { return boxes_[static_cast<std::size_t>(i)]; }
    /// The first and the last child, in time order; -1 of a leaf. A block has all between them, too.
    std::array<int, 2> children(int i) const;
    /// The child of an inner node that holds a sample of it.
    int child_with(int i, int sample) const;
    /// Whether a node has no children, blocks included.
    bool is_leaf(int i) const { return blocks_ ? level(i) + 1 == depth_ : node(i).is_leaf(); }
    int parent(int i) const { return places_[static_cast<std::size_t>(i)].parent; }  ///< -1 at the root
    int level(int i) const { return places_[static_cast<std::size_t>(i)].level; }    ///< 0 at the root
    /// How many nodes of its level come before a node, in the order of time.
    int place_in_level(int i) const { return places_[static_cast<std::size_t>(i)].in_level; }

    /// Clip time covered by a node, [t0, t1) in seconds; t0 = t1 of a node that has only the last sample of a clip
    /// that runs.
    double t0(const Node& node) const { return clip_->time(node.first); }
    double t1(const Node& node) const { return clip_->time(node.end()); }

  private:
    /// Where a node stands: no query asks for it.
    struct Place {
        int parent;
        int level;
        int in_level;
    };

    int build(SampleRange range, int parent, int level, const NodeChange& change);
    void build_blocks();
    void fit_box(int index, int level, const NodeChange& change);

    ClipPtr clip_;
    FitOptions options_;
    std::shared_ptr<const Blocks> blocks_;
    std::vector<Node> nodes_;
    std::vector<Place> places_;  ///< by node
    std::vector<Box> boxes_;     ///< by node, up to the last whose box is not upright
    int depth_ = 0;
};

}  // namespace mobb
