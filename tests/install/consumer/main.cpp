// The example of docs/library.md: two people walk towards each other at 1 m/s from 6 m apart.
#include <mobb/query.h>

#include <cstdio>
#include <memory>
#include <vector>

int main() {
    std::vector<mobb::Disk> path;
    for (int i = 0; i < 300; ++i) path.push_back({i * 0.02, 0.0, 0.5});  // x, y, r in metres
    const auto walk = std::make_shared<const mobb::Clip>(0.02, path);    // one sample every 0.02 s

    const mobb::Tree tree(walk, {.tree = mobb::TreeKind::mobb, .leaf = 10});
    const mobb::PlacedTree east(tree, {.translate = {0, 0}});
    const mobb::PlacedTree west(tree, {.translate = {6, 0}, .rotate_deg = 180});

    if (const auto contact = mobb::query(east, west)) {
        std::printf("they meet at %.1f s, %.3f m apart\n", contact->time, contact->distance);
    }
}
