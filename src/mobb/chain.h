/// Chains: clips played back to back, under one tree that is composed of theirs (the future work of the paper, Section
/// 6). A motion graph makes them as it runs.
#pragma once

#include <mobb/kdop.h>
#include <mobb/tree.h>

#include <glm/vec2.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <memory>
#include <span>
#include <vector>

namespace mobb {

/// A tree that may become a link of chains, with what chains need to know of its clip. Immutable: made once per clip,
/// shared by every chain that plays it.
class ChainPart {
  public:
    /// Takes time in proportion to the clip's samples. Throws std::invalid_argument if there is no tree.
    explicit ChainPart(std::shared_ptr<const Tree> tree);

    const Tree& tree() const { return *tree_; }
    const Clip& clip() const { return tree_->clip(); }
    const KDop& outline() const { return outline_; }  ///< of all the clip's disks, in the clip's frame

  private:
    std::shared_ptr<const Tree> tree_;
    KDop outline_;
};

using ChainPartPtr = std::shared_ptr<const ChainPart>;

/// A clip of a chain: rotate about the clip's origin, then translate, into the chain's frame.
struct ChainLink {
    ChainPartPtr part;
    glm::dvec2 translate{0, 0};  ///< metres
    Turn rotate_deg{};           ///< degrees, or Turn::by a cosine and a sine
};

/// A node of a chain, seen in the chain's frame. Valid until the chain changes.
struct ChainNode {
    int first = 0;  ///< sample of the chain
    int count = 0;
    int until = 0;                        ///< the node ends when this sample begins
    std::array<int, 2> children{-1, -1};  ///< in time order; -1 in a leaf
    BoxKind kind = BoxKind::obb2d;
    int link = -1;                         ///< the link that the samples are of; -1: of several
    int node_of_link = -1;                 ///< the node of the link's tree that this is; -1: none, but the chain's own
    const Rectangle* rectangle = nullptr;  ///< in the frame of the link's clip, or of the chain's own node in its frame

    bool is_leaf() const { return children[0] < 0; }
    int end() const { return first + count; }
    bool is_joint() const { return link >= 0 && node_of_link < 0; }
};

/// One or more links in order of time. Sample I of the chain is sample I - F of the link whose first sample in the
/// chain is F, and begins at I*dt of chain time.
///
/// A linear link runs on: from its last sample centre and radius run to the first one of the next link, if that is
/// linear, or else stay as they are until it begins. This joint is a segment of its own, so that the tree of the link,
/// which ends at its last sample, stays valid. The chain ends as its last clip does, but a last clip of one sample that
/// another link has run to takes no time. So links of one motion are as one clip of all their samples.
///
/// The nodes of the links' trees are used where they are: seen through the link's placement, not copied. Joints are
/// leaves. Above them stand MOBB boxes, fitted to merged outlines: perfect binary trees over 2^k links each, the oldest
/// the largest, joined along a spine. A value: copies are independent, and any number of threads may ask one that
/// nobody changes.
class Chain {
  public:
    /// Time is linear in the number of links and does not depend on their samples. Throws std::invalid_argument, naming
    /// the link, if there is none, one has no part, another dt or time scale than the first, a number that is not
    /// finite or out of range, or lies beyond kMaxLength; or if the chain gets longer than a clip may be (kMaxSamples,
    /// kMaxTime) or has more nodes than an int can tell apart (the links times those of the largest tree).
    explicit Chain(std::span<const ChainLink> links);

    /// Adds links at the end; throws like the constructor, and then the chain is as it was. The time per link is
    /// constant but for the spine: at most log2(links) boxes a call.
    void append(std::span<const ChainLink> links);
    void append(const ChainLink& link) { append({&link, 1}); }

    /// Drops the links that end at or before a chain time (seconds), except the last. What stays keeps its sample
    /// indices and times, so the answers keep theirs. Takes time in proportion to the links that stay if one goes.
    /// Throws std::invalid_argument if it is NaN.
    void drop_before(double seconds);

    double dt() const { return dt_; }
    double time_scale() const { return time_scale_; }
    int links() const { return static_cast<int>(links_.size()); }
    /// 0 <= k < links(). The first sample of link k, and where it lies.
    int first_sample(int k) const { return links_[static_cast<std::size_t>(k)].first; }
    const ChainPart& part(int k) const { return *links_[static_cast<std::size_t>(k)].part; }
    const Rotation& rotation(int k) const { return links_[static_cast<std::size_t>(k)].rotation; }
    glm::dvec2 translate(int k) const { return links_[static_cast<std::size_t>(k)].translate; }

    int first() const { return links_.front().first; }  ///< the first sample that has not been dropped
    int end() const { return links_.back().end(); }     ///< one past the last sample
    int until() const { return links_.back().until; }   ///< the chain ends when this sample begins, or would begin
    double duration() const { return until() * dt_; }   ///< chain time at which it ends, seconds
    double until_next() const { return end() * dt_; }   ///< chain time at which a link that is added begins, seconds
    /// See mobb::most_start: who starts farther from time 0, in seconds, is refused.
    double most_start() const { return mobb::most_start(dt_, until_next()); }
    /// An upper bound in metres on |x| + |y| + r over the samples.
    double reach() const { return reach_; }

    /// Nodes are numbered anew whenever the chain changes, with gaps: 0 is the root, the others come from `children`.
    ChainNode node(int id) const;
    /// The node's box in the chain's frame and time, and the rectangle of an upright one.
    Box box(const ChainNode& node) const;
    Rectangle rectangle(const ChainNode& node) const;

    /// Sample i in the chain's frame, first() <= i < end(), and what it has become when it ends; in O(log links).
    Disk disk(int i) const;
    Disk disk_at_end(int i) const;
    /// Whether any link's clip is linear.
    bool is_linear() const { return linear_; }

  private:
    friend class ChainSamples;

    struct Link {
        ChainPartPtr part;
        const Node* nodes;    ///< of the part's tree
        const Disk* samples;  ///< of its clip
        Rotation rotation;
        glm::dvec2 translate;
        int first;  ///< in the chain
        int count;
        bool linear;
        bool is_run_to;     ///< the link before it is linear, also if that has been dropped
        int until;          ///< what the link's tree bounds ends when this sample begins
        Rectangle joint{};  ///< of a linear link with another one behind it: around the joint, in the chain's frame

        int end() const { return first + count; }
        Disk disk(int i) const { return placed(samples[i - first], rotation, translate); }
        /// Of a linear link with another one behind it, which must be the next in memory: what its last sample becomes.
        Disk runs_on_to() const {
            const Link& next = this[1];
            return next.linear ? next.disk(next.first) : disk(end() - 1);
        }
    };
    /// A box over several links, or over a joint and the link behind it. A child >= 0 is one of upper_; of others
    /// see root_child and joint_child.
    struct Upper {
        Rectangle rectangle;
        int first;
        int last_link;
        int children[2];
    };
    static int root_child(int link) { return ~(2 * link); }
    static int joint_child(int link) { return ~(2 * link + 1); }  ///< the joint behind a link
    /// A tree that is not yet part of a larger one.
    struct Peak {
        int child;  ///< as in Upper
        int first_link;
        int links;
        KDop outline;
    };

    int id_of(int child) const {
        const int uppers = static_cast<int>(upper_.size());
        if (child >= 0) return uppers - 1 - child;
        const int link = ~child / 2;
        return uppers + (link << shift_) + (~child % 2 == 0 ? 0 : nodes_of(links_[static_cast<std::size_t>(link)]));
    }
    static int nodes_of(const Link& link) { return static_cast<int>(link.part->tree().nodes().size()); }
    const Link& link_of(int sample) const;
    void push(Link link);
    Peak with_joint(const Peak& link);
    Peak joined(const Peak& left, const Peak& right);
    void join_peaks();

    std::vector<Link> links_;
    std::vector<Upper> upper_;  ///< the perfect trees in post-order, then the spine; the root is the last
    std::vector<Peak> peaks_;   ///< the perfect trees, ever smaller
    std::size_t perfect_ = 0;   ///< how many of upper_ are not of the spine
    int shift_ = 0;             ///< a link's nodes have 2^shift_ numbers
    double dt_ = 0;
    double time_scale_ = 0;
    double reach_ = 0;
    bool linear_ = false;
};

inline ChainNode Chain::node(int id) const {
    const int uppers = static_cast<int>(upper_.size());
    if (id < uppers) {
        const Upper& upper = upper_[static_cast<std::size_t>(uppers - 1 - id)];
        const Link& last = links_[static_cast<std::size_t>(upper.last_link)];
        return {upper.first,
                last.end() - upper.first,
                last.until,
                {id_of(upper.children[0]), id_of(upper.children[1])},
                BoxKind::obb2d,
                -1,
                -1,
                &upper.rectangle};
    }
    const int k = (id - uppers) >> shift_;
    const int root = uppers + (k << shift_);
    const Link& link = links_[static_cast<std::size_t>(k)];
    if (id - root == nodes_of(link))
        return {link.end() - 1, 1, link.end(), {-1, -1}, BoxKind::obb2d, k, -1, &link.joint};
    const Node& node = link.nodes[id - root];
    // Turned, what lay along x and y no longer does.
    const BoxKind kind = info(node.kind).axes == BoxAxes::world ? BoxKind::obb2d : node.kind;
    ChainNode out{link.first + node.first,
                  node.count,
                  std::min(link.first + node.end(), link.until),
                  {-1, -1},
                  kind,
                  k,
                  id - root,
                  &node.rectangle};
    if (!node.is_leaf()) out.children = {id + 1, root + node.second_child};
    return out;
}

inline Rectangle Chain::rectangle(const ChainNode& node) const {
    Rectangle out = *node.rectangle;
    if (node.node_of_link < 0) return out;
    const Link& link = links_[static_cast<std::size_t>(node.link)];
    out.center = link.rotation(out.center) + link.translate;
    out.axis = link.rotation(out.axis);
    return out;
}

inline Box Chain::box(const ChainNode& node) const {
    if (node.node_of_link < 0) {
        const double t0 = time_scale_ * (node.first * dt_), t1 = time_scale_ * (node.until * dt_);
        return over_time(node.kind, *node.rectangle, t0, t1);
    }
    const Link& link = links_[static_cast<std::size_t>(node.link)];
    Box box = link.part->tree().box(node.node_of_link);
    const auto turned = [&](glm::dvec3 v) {
        const glm::dvec2 on_floor = link.rotation(glm::dvec2{v.x, v.y});
        return glm::dvec3{on_floor.x, on_floor.y, v.z};
    };
    box.kind = node.kind;
    box.center = turned(box.center) + glm::dvec3{link.translate, time_scale_ * (link.first * dt_)};
    for (glm::dvec3& axis : box.axes) axis = turned(axis);
    box.drift = link.rotation(box.drift);
    return box;
}

/// The clip of all samples of a chain that have not been dropped, in its frame: bit for bit the same disks. Throws
/// std::invalid_argument if the links are of both motions, or if the rest of the chain has no duration.
Clip flattened(const Chain& chain);

}  // namespace mobb
