#include <base/strong_components.h>

#include <algorithm>
#include <cstddef>

namespace mobbscope {

namespace {

using Neighbours = std::vector<std::vector<int>>;

/// Adds the nodes reached from one that are not seen yet, each after those that it leads to.
void add_reached(const Neighbours& next, int from, std::vector<bool>& seen, std::vector<int>& out) {
    struct Step {
        int node;
        std::size_t done = 0;
    };
    if (seen[static_cast<std::size_t>(from)]) return;
    seen[static_cast<std::size_t>(from)] = true;
    std::vector<Step> open{{from}};
    while (!open.empty()) {
        const auto node = static_cast<std::size_t>(open.back().node);
        if (open.back().done == next[node].size()) {
            out.push_back(open.back().node);
            open.pop_back();
            continue;
        }
        const int other = next[node][open.back().done++];
        if (seen[static_cast<std::size_t>(other)]) continue;
        seen[static_cast<std::size_t>(other)] = true;
        open.push_back({other});
    }
}

}  // namespace

std::vector<int> strong_components(int nodes, const std::vector<std::pair<int, int>>& edges) {
    const auto count = static_cast<std::size_t>(nodes);
    Neighbours next(count);
    Neighbours before(count);
    for (const auto& [from, to] : edges) {
        next[static_cast<std::size_t>(from)].push_back(to);
        before[static_cast<std::size_t>(to)].push_back(from);
    }
    // Kosaraju's algorithm: backwards from the nodes that lead to most.
    std::vector<int> order;
    std::vector<bool> seen(count, false);
    for (int node = 0; node < nodes; ++node) add_reached(next, node, seen, order);
    std::reverse(order.begin(), order.end());
    std::vector<int> first(count);  // of each node, the least node of its component
    seen.assign(count, false);
    for (const int node : order) {
        std::vector<int> members;
        add_reached(before, node, seen, members);
        if (members.empty()) continue;
        const int least = *std::min_element(members.begin(), members.end());
        for (const int member : members) first[static_cast<std::size_t>(member)] = least;
    }
    std::vector<int> number(count, -1);
    std::vector<int> out;
    int components = 0;
    for (const int node : first) {
        int& of = number[static_cast<std::size_t>(node)];
        if (of < 0) of = components++;
        out.push_back(of);
    }
    return out;
}

}  // namespace mobbscope
