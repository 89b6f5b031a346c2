#include <app/commands/arguments.h>
#include <app/commands/node_place.h>
#include <base/text.h>

#include <stdexcept>
#include <vector>

namespace mobbscope::app {

int node_at(const mobb::Tree& tree, std::string_view text) {
    const std::size_t dot = text.find('.');
    const int count = static_cast<int>(tree.nodes().size());
    if (dot == std::string_view::npos) return whole_number_in(text, "the node", 0, count - 1);
    const int level = whole_number_in(text.substr(0, dot), "the level", 0, tree.depth() - 1);
    // Nodes lie depth first, so those of a level are in order of time.
    std::vector<int> on_level;
    for (int node = 0; node < count; ++node) {
        if (tree.nodes()[static_cast<std::size_t>(node)].level == level) on_level.push_back(node);
    }
    const int last = static_cast<int>(on_level.size()) - 1;
    return on_level[static_cast<std::size_t>(whole_number_in(text.substr(dot + 1), "the place on the level", 0, last))];
}

int leaf_of_sample(const mobb::Tree& tree, int sample) {
    int node = 0;
    while (true) {
        const mobb::Node& at = tree.nodes()[static_cast<std::size_t>(node)];
        if (at.is_leaf()) return node;
        const int first = at.children[0];
        node = sample < tree.nodes()[static_cast<std::size_t>(first)].end() ? first : at.children[1];
    }
}

int neighbour_on_level(const mobb::Tree& tree, int node, int direction) {
    const int level = tree.nodes()[static_cast<std::size_t>(node)].level;
    const int count = static_cast<int>(tree.nodes().size());
    for (int next = node + direction; next >= 0 && next < count; next += direction) {
        if (tree.nodes()[static_cast<std::size_t>(next)].level == level) return next;
    }
    return -1;
}

}  // namespace mobbscope::app
