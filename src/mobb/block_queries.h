/// The queries of blocks.h, compiled for one set of instructions: what block_queries.cpp chooses from. Not installed.
#pragma once

#include <mobb/blocks.h>

#include <cstddef>
#include <string_view>
#include <vector>

namespace mobb {

/// `first_hit`, `intersects` and, where nobody watches, `for_each_hit` require that the roots meet.
struct BlockQueries {
    bool (*first_hit)(const PlacedBlocks& a, const PlacedBlocks& b, const RootsApart& roots, SamplePair& pair);
    bool (*intersects)(const PlacedBlocks& a, const PlacedBlocks& b, const RootsApart& roots);
    bool (*for_each_hit)(const PlacedBlocks& a, const PlacedBlocks& b, const RootsApart& roots, HitSink sink,
                         BlockObserver* observer);
    void (*intersects_each)(const BlocksPair* pairs, std::size_t count, bool* answers);
};

/// A set of instructions and the queries that are compiled for it.
struct InstructionSet {
    std::string_view name;
    const BlockQueries* queries;
};

/// Those of this machine that Highway has, the best first.
std::vector<InstructionSet> vector_instruction_sets();

}  // namespace mobb
