/// How tight the boxes of chains are beside those of trees rebuilt over all samples.
#pragma once

#include <mobb/chain.h>

#include <memory>

namespace mobb::test {

/// How many boxes, and their volume in m^2*s.
struct Boxes {
    double count = 0;
    double volume = 0;
};
inline Boxes boxes_of(const Chain& chain, int id = 0) {
    const ChainNode node = chain.node(id);
    Boxes boxes{1, volume(chain.box(node), chain.time_scale())};
    if (node.is_leaf()) return boxes;
    for (const int child : node.children) {
        const Boxes below = boxes_of(chain, child);
        boxes.count += below.count;
        boxes.volume += below.volume;
    }
    return boxes;
}
inline Boxes boxes_of(const Tree& tree) {
    Boxes boxes;
    for (int i = 0; i < static_cast<int>(tree.nodes().size()); ++i) {
        boxes.count += 1;
        boxes.volume += volume(tree.box(i), tree.time_scale());
    }
    return boxes;
}

/// The volume of so many boxes of a tree rebuilt over the samples: between those of the two nearest sizes of leaves.
inline double rebuilt_volume(const ClipPtr& clip, double boxes) {
    Boxes more = boxes_of(Tree(clip, {.leaf = 1}));
    for (int leaf = 2;; ++leaf) {
        const Boxes fewer = boxes_of(Tree(clip, {.leaf = leaf}));
        if (fewer.count <= boxes) {
            return fewer.volume + (more.volume - fewer.volume) * (boxes - fewer.count) / (more.count - fewer.count);
        }
        more = fewer;
    }
}

}  // namespace mobb::test
