#include <import/nodes/gltf_characters.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <utility>

namespace mobbscope {

namespace {

/// Whether the numbers of channels are not the same at all keys, or may not be between them. Looks at each list once.
class Changes {
  public:
    bool operator()(const GltfChannel& channel) {
        const std::size_t width = channel.property == NodeProperty::rotation ? 4 : 3;
        const auto [at, is_new] = known_.emplace(std::pair{channel.values.get(), width}, false);
        const std::vector<double>& values = *channel.values;
        for (std::size_t i = width; is_new && !at->second && i < values.size(); ++i) {
            at->second = values[i] != values[i % width];
        }
        return at->second;
    }

  private:
    std::map<std::pair<const std::vector<double>*, std::size_t>, bool> known_;
};

/// Sets that are joined step by step.
class Sets {
  public:
    explicit Sets(std::size_t count) : up_(count) { std::iota(up_.begin(), up_.end(), std::size_t{0}); }

    /// The first of the set that one is in.
    std::size_t of(std::size_t one) {
        while (up_[one] != one) one = up_[one] = up_[up_[one]];
        return one;
    }
    void join(std::size_t a, std::size_t b) {
        a = of(a);
        b = of(b);
        up_[std::max(a, b)] = std::min(a, b);
    }

  private:
    std::vector<std::size_t> up_;
};

/// A file's nodes, and what its animations do to them.
class SkinnedNodes {
  public:
    SkinnedNodes(const NodeScene& scene, const std::vector<GltfSkin>& skins, const std::vector<GltfChannel>& channels)
        : nodes_(scene.nodes), skins_(skins), order_(parents_first(scene.nodes)), sets_(skins.size()) {
        is_keyed_.resize(nodes_.size());
        moves_.resize(nodes_.size());
        shifts_.resize(nodes_.size());
        Changes changes;
        for (const GltfChannel& channel : channels) {
            is_keyed_[as_index(channel.node)] = true;
            if (!changes(channel)) continue;
            moves_[as_index(channel.node)] = true;
            if (channel.property == NodeProperty::translation) shifts_[as_index(channel.node)] = 1;
        }
        size_.assign(nodes_.size(), 1);
        for (auto node = order_.rbegin(); node != order_.rend(); ++node) {
            if (parent_of(*node) >= 0) size_[as_index(parent_of(*node))] += size_[as_index(*node)];
        }
        place_.resize(nodes_.size());
        std::vector<int> room(nodes_.size());  // the place of the next child
        int root_room = 0;
        for (const int node : order_) {
            const int parent = parent_of(node);
            int& place = parent < 0 ? root_room : room[as_index(parent)];
            place_[as_index(node)] = place;
            room[as_index(node)] = place + 1;
            place += size_[as_index(node)];
            if (parent < 0) continue;
            shifts_[as_index(node)] += shifts_[as_index(parent)];
            if (moves_[as_index(parent)]) moves_[as_index(node)] = true;
        }
    }

    std::vector<std::vector<int>> characters() {
        join_nested();
        join_hanging();
        std::map<std::size_t, std::vector<int>> joints;  // by the first skin of each
        std::vector<bool> is_taken(nodes_.size());
        for (std::size_t skin = 0; skin < skins_.size(); ++skin) {
            for (const int joint : skins_[skin].joints) {
                if (is_taken[as_index(joint)]) continue;
                is_taken[as_index(joint)] = true;
                joints[sets_.of(skin)].push_back(joint);
            }
        }
        std::map<std::size_t, std::vector<int>> tops = topmost_joints_of_sets();
        std::vector<std::vector<int>> out;
        for (auto& [set, of_set] : joints) {
            const int above = above_all(tops[set]);
            if (above >= 0 && !is_taken[as_index(above)]) {
                is_taken[as_index(above)] = true;
                of_set.insert(of_set.begin(), above);
            }
            out.push_back(std::move(of_set));
        }
        return out;
    }

  private:
    int parent_of(int node) const { return nodes_[as_index(node)].parent; }

    /// Joins skins that share a joint, and those with a joint below another's.
    void join_nested() {
        skin_at_.assign(nodes_.size(), -1);
        for (std::size_t skin = 0; skin < skins_.size(); ++skin) {
            for (const int joint : skins_[skin].joints) {
                int& at = skin_at_[as_index(joint)];
                if (at >= 0) sets_.join(as_index(at), skin);
                at = static_cast<int>(skin);
            }
        }
        skin_above_.assign(nodes_.size(), -1);
        for (const int node : order_) {
            const int parent = parent_of(node);
            if (parent < 0) continue;
            const int of_parent = skin_at_[as_index(parent)];
            const int above = of_parent >= 0 ? of_parent : skin_above_[as_index(parent)];
            skin_above_[as_index(node)] = above;
            if (above >= 0 && skin_at_[as_index(node)] >= 0) {
                sets_.join(as_index(above), as_index(skin_at_[as_index(node)]));
            }
        }
    }

    /// The joints of each set that have none above them, parents first.
    std::map<std::size_t, std::vector<int>> topmost_joints_of_sets() {
        std::map<std::size_t, std::vector<int>> out;
        for (const int node : order_) {
            if (skin_at_[as_index(node)] >= 0 && skin_above_[as_index(node)] < 0) {
                out[sets_.of(as_index(skin_at_[as_index(node)]))].push_back(node);
            }
        }
        return out;
    }

    /// True if joints change their place in the axes of a node above them.
    bool shift(const std::vector<int>& joints, int above) const {
        const auto shifts = [&](int joint) { return shifts_[as_index(joint)] > shifts_[as_index(above)]; };
        return std::ranges::any_of(joints, shifts);
    }

    bool is_above(int above, int node) const {
        const int steps = place_[as_index(node)] - place_[as_index(above)];
        return steps >= 0 && steps < size_[as_index(above)];
    }

    /// The moving node that all topmost joints of a set hang on: the skeleton that its first skin names, else their
    /// parent; -1: none.
    int moving_holder(std::size_t set, const std::vector<int>& tops) const {
        const int skeleton = skins_[set].skeleton;
        const auto is_below = [&](int top) { return top != skeleton && is_above(skeleton, top); };
        if (skeleton >= 0 && moves_[as_index(skeleton)] && std::ranges::all_of(tops, is_below)) return skeleton;
        const int parent = parent_of(tops.front());
        const auto is_child = [&](int top) { return parent_of(top) == parent; };
        return parent >= 0 && moves_[as_index(parent)] && std::ranges::all_of(tops, is_child) ? parent : -1;
    }

    /// Joins skins that hang on one moving node, if at most one of them moves away from its place there: two that do
    /// are two people on something that carries both.
    void join_hanging() {
        struct Hanging {
            std::vector<std::size_t> kept;    // sets that keep their place
            std::vector<std::size_t> moving;  // and those that do not
        };
        std::map<int, Hanging> by_holder;
        for (const auto& [set, tops] : topmost_joints_of_sets()) {
            const int holder = moving_holder(set, tops);
            if (holder < 0) continue;
            Hanging& hanging = by_holder[holder];
            (shift(tops, holder) ? hanging.moving : hanging.kept).push_back(set);
        }
        for (const auto& [holder, hanging] : by_holder) {
            if (hanging.kept.empty() || hanging.moving.size() > 1) continue;
            for (const std::size_t set : hanging.kept) sets_.join(hanging.kept.front(), set);
            for (const std::size_t set : hanging.moving) sets_.join(hanging.kept.front(), set);
        }
    }

    /// The lowest node above several topmost joints, where it is one of the body; -1: none.
    int above_all(const std::vector<int>& tops) const {
        if (tops.size() < 2) return -1;
        const auto [first, last] =
            std::ranges::minmax(tops, [this](int a, int b) { return place_[as_index(a)] < place_[as_index(b)]; });
        int above = first;
        while (above >= 0 && !is_above(above, last)) above = parent_of(above);
        if (above < 0) return -1;
        const bool is_animated = is_keyed_[as_index(above)] || moves_[as_index(above)];
        return is_animated && !shift(tops, above) ? above : -1;
    }

    const std::vector<Node>& nodes_;
    const std::vector<GltfSkin>& skins_;
    std::vector<int> order_;  ///< parents first
    Sets sets_;
    // By node:
    std::vector<bool> is_keyed_;
    std::vector<bool> moves_;      ///< itself, or a node above it
    std::vector<int> shifts_;      ///< of it and the nodes above it, how many change their place below their parents
    std::vector<int> place_;       ///< where it stands when each node is followed by all below it
    std::vector<int> size_;        ///< how many these are, with itself
    std::vector<int> skin_at_;     ///< one whose joint it is; -1: none
    std::vector<int> skin_above_;  ///< one whose joint is nearest above it; -1: none
};

}  // namespace

std::vector<std::vector<int>> gltf_characters(const NodeScene& scene, const std::vector<GltfSkin>& skins,
                                              const std::vector<GltfChannel>& channels) {
    return SkinnedNodes(scene, skins, channels).characters();
}

}  // namespace mobbscope
