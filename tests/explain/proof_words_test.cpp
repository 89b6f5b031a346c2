// Proofs in words, and the traversal's own proof beside them.
#include <base/text.h>
#include <explain/proof_words.h>
#include <explain/query_proof.h>

#include "proven_query.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

namespace mobbscope {
namespace {

TEST(TraversalEnds, PartitionTheCommonTime) {
    mobb::test::Random random(37);
    int boxes = 0, runs = 0;
    for (int i = 0; i < certificate_budget(); ++i) {
        SCOPED_TRACE(i);
        const ProvenQuery query = random_proven_query(random);
        const mobb::PlacedTree a = query.a(), b = query.b();
        const std::vector<TraversalEnd> ends = traversal_ends(a, b, query.recorded.trace);
        const double begin = std::max(a.begin_time(), b.begin_time());
        const double end = query.proof.contact ? query.proof.contact->time : std::min(a.end_time(), b.end_time());
        // Times far from 0 are rounded.
        const double crack = mobb::kMinOverlap + 4 * std::numeric_limits<double>::epsilon() * std::abs(end);
        double covered = begin;
        for (const TraversalEnd& each : ends) {
            EXPECT_NEAR(each.t0, covered, crack);
            EXPECT_GT(each.t1, each.t0);
            covered = each.t1;
            (each.is_boxes ? boxes : runs) += 1;
        }
        EXPECT_GE(covered, std::max(begin, end - crack));
        for (std::size_t k = 1; k < ends.size(); ++k) EXPECT_TRUE(ends[k].is_boxes || ends[k - 1].is_boxes);
    }
    EXPECT_GT(boxes, 100);
    EXPECT_GT(runs, 100);
}

TEST(ProofWords, SayWhatIsProvenAndByHowMuch) {
    const std::vector<TraversalEnd> ends{{0, 4, true, 3}, {4, 5, false, 4}, {5, 12, true, 9}};
    Certificate miss{std::nullopt, {{0, 4, {1, 0}, 0, 0.5}, {4, 12.4, {0, 1}, 0, 0.1839}}};
    EXPECT_EQ(proof_words(miss, ends),
              "Proven bound: at least 0.183 m apart. Proof: 2 lines over 12.40 s; the trees needed 2 box pairs and 1 "
              "run of samples.");
    EXPECT_EQ(proof_words(miss, {}), "Proven bound: at least 0.183 m apart. Proof: 2 lines over 12.40 s.");
    miss.tiles.back().gap = 1e-12;
    EXPECT_EQ(proof_words(miss, std::vector{ends[0]}),
              "They never collide. Proof: 2 lines over 12.40 s; the trees needed 1 box pair.");
    Certificate hit{mobb::Contact{2.31, 4, 5, 0.5, 0.6}, {{0, 2.31, {1, 0}, 0, 1e-9}}};
    EXPECT_EQ(proof_words(hit, std::vector{ends[1]}),
              "No contact before 2.310 s. Proof: 1 line over 2.310 s; the trees needed 1 run of samples.");
    hit.tiles.clear();
    EXPECT_EQ(proof_words(hit, std::vector{ends[1]}), "In contact as soon as both are there.");
    EXPECT_EQ(proof_words({}, {}), "They share no time.");
}

TEST(ProofWords, OneBoundReadsTheSameEverywhere) {
    const Certificate miss{std::nullopt, {{0, 1, {1, 0}, 0, 0.0716}}};
    EXPECT_NE(proof_words(miss, {}).find("Proven bound: at least 0.071 m apart"), std::string::npos);
    EXPECT_EQ(gap_words(0.0716), "0.071 m");
    EXPECT_EQ(proven_words(0.072, "m"), "0.072 m") << "rounding takes nothing from a number that ends there";
}

TEST(MarginWords, SayWhatMayChange) {
    EXPECT_EQ(margin_words({0.0919, {}, true, 0.4}, "B"),
              "Both radii may grow by 0.091 m; B may start up to 0.400 s earlier or later.");
    EXPECT_EQ(margin_words({1, {}, true, std::numeric_limits<double>::infinity()}, "Bea"),
              "Both radii may grow by 1.000 m; Bea may start at any time.");
    EXPECT_EQ(margin_words({0, {}, true, 0}, "B"),
              "Nothing is proven of larger radii; nothing is proven of other starts of B.");
}

}  // namespace
}  // namespace mobbscope
