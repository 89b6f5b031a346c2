/// A fixed set of queries for callgrind to count; see bench/instructions.
#include <mobb/capture.h>
#include <mobb/query.h>

#include <cstdio>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "walks.h"

#ifndef MOBBSCOPE_OBSERVER
#define MOBBSCOPE_OBSERVER NoObserver
#endif
// Who asks, in place of query(): NoCaptureRing or CaptureRing.
#ifdef MOBBSCOPE_RING
#define MOBBSCOPE_ASK(a, b) ring.query(a, b)
#else
#define MOBBSCOPE_RING NoCaptureRing
#define MOBBSCOPE_ASK(a, b) query(a, b, observer)
#endif

using namespace mobb;

/// Counted: callgrind collects inside this function only.
extern "C" [[gnu::noinline]] int counted_queries(const std::vector<PlacedTree>& trees,
                                                 [[maybe_unused]] MOBBSCOPE_RING& ring) {
    int hits = 0;
    [[maybe_unused]] MOBBSCOPE_OBSERVER observer;
    for (std::size_t i = 0; i + 1 < trees.size(); i += 2) {
        hits += MOBBSCOPE_ASK(trees[i], trees[i + 1]).has_value();
    }
    return hits;
}

/// The kind of tree to query, or `mixed`: all of them, in pairs by chance. Without arguments: names the choices.
int main(int argc, char** argv) {
    const std::span<const std::string_view> kinds = tree_kind_names();
    if (argc != 2) {
        std::puts("mixed");
        for (const std::string_view kind : kinds) std::printf("%s\n", kind.data());
        return 0;
    }
    const std::optional<TreeKind> only = tree_kind_from_name(argv[1]);
    if (!only && std::string_view(argv[1]) != "mixed") return 2;
    const int of_a_length = only ? 4 : static_cast<int>(kinds.size());
    test::Random random(1);
    std::vector<Tree> trees;
    for (const double seconds : {42.0, 2.1}) {
        for (int i = 0; i < of_a_length; ++i) {
            trees.emplace_back(bench::walk(random, seconds),
                               FitOptions{.tree = only.value_or(static_cast<TreeKind>(i))});
        }
    }
    std::vector<PlacedTree> placed;
    for (int k = 0; k < 2000; ++k) {
        for (int side = 0; side < 2; ++side) {
            const Tree& tree =
                trees[static_cast<std::size_t>(k % 2 * of_a_length + random.integer(0, of_a_length - 1))];
            placed.emplace_back(tree, bench::somewhere(random, tree.clip().duration()));
        }
    }
    MOBBSCOPE_RING ring(64);
    std::printf("%d hits\n", counted_queries(placed, ring));
}
