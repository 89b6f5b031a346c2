// The block query of docs/library.md: two people who walk towards each other, and one who comes later.
#include <mobb/blocks.h>
#include <mobb/query.h>

#include <cstdio>
#include <memory>
#include <vector>

int main() {
    std::vector<mobb::Disk> path;
    for (int i = 0; i < 300; ++i) path.push_back({i * 0.02, 0.0, 0.5});
    const auto walk = std::make_shared<const mobb::Clip>(0.02, path);

    const mobb::Blocks blocks(walk);  // once per clip; share it
    const mobb::PlacedBlocks east(blocks, {.translate = {0, 0}});
    const mobb::PlacedBlocks west(blocks, {.translate = {6, 0}, .rotate_deg = 180});
    const mobb::PlacedBlocks later(blocks, {.translate = {0, 0}, .start = 10});

    const bool meet = mobb::intersects(east, west);  // yes or no

    const std::vector<const mobb::PlacedBlocks*> others{&later, &west};
    const auto first = mobb::intersects_any(east, others);  // the first of many that collides

    const auto contact = mobb::query(east, west);            // the earliest contact
    const auto times = mobb::contact_intervals(east, west);  // all of them

    if (meet && first == 1u && contact && times.size() == 1) std::printf("they meet at %.1f s\n", contact->time);
}
