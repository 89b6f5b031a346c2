#include <mobb/fitting.h>
#include <mobb/lanes.h>

#include <cmath>
#include <cstddef>

namespace mobb {

namespace {

constexpr double kBeyond = std::numeric_limits<double>::infinity();

std::array<Extent, 2> extents_in_order(std::span<const Disk> disks, glm::dvec2 u) {
    std::array<Extent, 2> e;
    for (const Disk& d : disks) {
        const double along = d.x * u.x + d.y * u.y;
        const double across = d.y * u.x - d.x * u.y;
        e[0].add(along - d.r, along + d.r);
        e[1].add(across - d.r, across + d.r);
    }
    return e;
}

/// Along and across in one register; every second disk is kept apart, so that none waits for the one before.
std::array<Extent, 2> extents_of_all(std::span<const Disk> disks, glm::dvec2 u) {
    const TwoDoubles u_x = both(u.x), u_y{u.y, -u.y};
    std::array<TwoDoubles, 2> low{both(kBeyond), both(kBeyond)}, high{both(-kBeyond), both(-kBeyond)};
    const auto add = [&](const Disk& d, std::size_t k) {
        const TwoDoubles p = u_x * TwoDoubles{d.x, d.y} + u_y * TwoDoubles{d.y, d.x};
        low[k] = least(p - d.r, low[k]);
        high[k] = greatest(p + d.r, high[k]);
    };
    std::size_t i = 0;
    for (; i + 2 <= disks.size(); i += 2) add(disks[i], 0), add(disks[i + 1], 1);
    if (i < disks.size()) add(disks[i], 0);
    const TwoDoubles lowest = least(low[0], low[1]), highest = greatest(high[0], high[1]);
    return {Extent{lowest[0], highest[0]}, Extent{lowest[1], highest[1]}};
}

/// How far a node's rectangle reaches along a unit vector.
double reach_along(const Rectangle& rectangle, glm::dvec2 u) {
    const glm::dvec2 c = rectangle.center, a = rectangle.axis, half = rectangle.half;
    return c.x * u.x + c.y * u.y + half.x * std::abs(a.x * u.x + a.y * u.y) + half.y * std::abs(a.x * u.y - a.y * u.x);
}

}  // namespace

/// Branch and bound: the furthest disk along a direction, the child that reaches further first.
class BoundedDisks::Search {
  public:
    Search(const Clip& clip, std::span<const Node> nodes, std::size_t most_disks)
        : clip_(clip),
          nodes_(nodes),
          // Fitting and projecting round some twenty times; the least is for numbers that are rounded absolutely.
          slack_(256 * std::numeric_limits<double>::epsilon() * clip.reach() + 1e-300),
          left_(static_cast<std::ptrdiff_t>(most_disks)) {}

    double furthest(int node, glm::dvec2 u) const {
        return furthest(nodes_[static_cast<std::size_t>(node)], node, u, -kBeyond);
    }
    /// It has looked at more disks than it was to: its answers are not to be used.
    bool gave_up() const { return left_ < 0; }

  private:
    static constexpr int kFew = 16;  ///< disks that are looked at sooner than the boxes around them

    double furthest(const Node& node, int index, glm::dvec2 u, double best) const {
        if (node.is_leaf() || node.count <= kFew) {
            const std::span<const Disk> disks = swept_disks(clip_, {node.first, node.count});
            left_ -= static_cast<std::ptrdiff_t>(disks.size());
            for (const Disk& d : disks) best = std::max(best, d.x * u.x + d.y * u.y + d.r);
            return best;
        }
        std::array<int, 2> children{index + 1, node.second_child};
        const auto child = [&](std::size_t k) -> const Node& { return nodes_[static_cast<std::size_t>(children[k])]; };
        std::array<double, 2> reach{reach_along(child(0).rectangle, u), reach_along(child(1).rectangle, u)};
        if (reach[0] < reach[1]) {
            std::swap(children[0], children[1]);
            std::swap(reach[0], reach[1]);
        }
        for (std::size_t k = 0; k < 2; ++k) {
            if (reach[k] + slack_ < best || gave_up()) break;
            best = furthest(child(k), children[k], u, best);
        }
        return best;
    }

    const Clip& clip_;
    std::span<const Node> nodes_;
    double slack_;
    mutable std::ptrdiff_t left_;
};

std::span<const Disk> swept_disks(const Clip& clip, SampleRange range) {
    const bool runs_on = clip.runs() && range.end() < clip.count();
    const int count = range.count + (runs_on ? 1 : 0);
    return clip.samples().subspan(static_cast<std::size_t>(range.first), static_cast<std::size_t>(count));
}

BoundedDisks::BoundedDisks(const Clip& clip, std::span<const Node> nodes, int node)
    : disks_(swept_disks(clip,
                         {nodes[static_cast<std::size_t>(node)].first, nodes[static_cast<std::size_t>(node)].count})),
      clip_(&clip),
      nodes_(nodes),
      node_(node) {}

std::array<Extent, 2> BoundedDisks::extents(glm::dvec2 u) const {
    constexpr std::size_t kMany = 512;  // disks: of fewer all are looked at sooner
    std::array<Extent, 2> e;
    bool is_found = false;
    if (node_ >= 0 && disks_.size() > kMany) {
        const Search search(*clip_, nodes_, disks_.size() / 4);
        const glm::dvec2 v = perpendicular(u);
        e = {Extent{-search.furthest(node_, -u), search.furthest(node_, u)},
             Extent{-search.furthest(node_, -v), search.furthest(node_, v)}};
        is_found = !search.gave_up();
    }
    if (!is_found) e = extents_of_all(disks_, u);
    return has_zero(e[0]) || has_zero(e[1]) ? extents_in_order(disks_, u) : e;
}

}  // namespace mobb
