/// A fixed set of queries for callgrind to count; see bench/instructions.
#include <mobb/query.h>

#include <cstdio>
#include <vector>

#include "walks.h"

#ifndef MOBBSCOPE_OBSERVER
#define MOBBSCOPE_OBSERVER NoObserver
#endif

using namespace mobb;

/// Counted: callgrind collects inside this function only.
extern "C" [[gnu::noinline]] int counted_queries(const std::vector<PlacedTree>& trees) {
    int hits = 0;
    MOBBSCOPE_OBSERVER observer;
    for (std::size_t i = 0; i + 1 < trees.size(); i += 2) {
        hits += query(trees[i], trees[i + 1], observer).has_value();
    }
    return hits;
}

int main() {
    test::Random random(1);
    std::vector<Tree> trees;
    for (int i = 0; i < 8; ++i) {
        trees.emplace_back(bench::walk(random, i < 4 ? 42 : 2.1), FitOptions{.tree = static_cast<TreeKind>(i % 4)});
    }
    std::vector<PlacedTree> placed;
    for (int k = 0; k < 2000; ++k) {
        for (int side = 0; side < 2; ++side) {
            const Tree& tree = trees[static_cast<std::size_t>(k % 2 * 4 + random.integer(0, 3))];
            placed.emplace_back(tree, bench::somewhere(random, tree.clip().duration()));
        }
    }
    std::printf("%d hits\n", counted_queries(placed));
}
