// Answers a query of every kind of structure: all of the library is in the plug-in.
#include <mobb/placed_chain.h>
#include <mobb/query.h>

#include <memory>
#include <vector>

/// Of three people, the first that somebody who walks 6 m meets; -1: none, or the structures do not agree.
extern "C" int first_met() {
    std::vector<mobb::Disk> path;
    for (int i = 0; i < 300; ++i) path.push_back({i * 0.02, 0.0, 0.5});
    const auto walk = std::make_shared<const mobb::Clip>(0.02, path);

    const mobb::Blocks blocks(walk);
    const mobb::PlacedBlocks east(blocks, {});
    const std::vector<mobb::PlacedBlocks> people{{blocks, {.translate = {0, 50}}},
                                                 {blocks, {.translate = {6, 0}, .start = 100}},
                                                 {blocks, {.translate = {6, 0}, .rotate_deg = 180}}};
    std::vector<const mobb::PlacedBlocks*> others;
    for (const mobb::PlacedBlocks& person : people) others.push_back(&person);
    const auto first = mobb::intersects_any(east, others);

    const auto tree = std::make_shared<const mobb::Tree>(walk, mobb::FitOptions{});
    const std::vector<mobb::ChainLink> links(2, {.part = std::make_shared<const mobb::ChainPart>(tree)});
    const mobb::Chain chain(links);
    const mobb::PlacedChain of_two(chain, {.translate = {6, 0}, .rotate_deg = 180});
    const auto contact = mobb::query(mobb::PlacedTree(*tree, {}), of_two);
    return first && contact && mobb::query(east, people[*first]) == contact ? static_cast<int>(*first) : -1;
}
