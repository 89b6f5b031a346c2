// Certificates prove answers without a tree, and what proves nothing is refused.
#include <explain/certificate.h>
#include <mobb/query.h>

#include "proven_query.h"

#include <gtest/gtest.h>

namespace mobbscope {
namespace {

using testing::ProvenQuery;

TEST(Certificate, ProvesAnswersOfAllKindsByNoMoreTilesThanTheTraceHasEnds) {
    mobb::test::Random random(35);
    int misses = 0, hits = 0;
    for (int i = 0; i < testing::certificate_budget(); ++i) {
        SCOPED_TRACE(i);
        const ProvenQuery asked = testing::random_proven_query(random);
        EXPECT_EQ(asked.refused(asked.proof), "");
        EXPECT_EQ(asked.proof.contact, asked.recorded.contact);
        std::size_t ends = 0;
        for (int step = 0; step < asked.recorded.trace.size(); ++step) {
            const mobb::Trace::Event event = asked.recorded.trace[step];
            ends += event.outcome == mobb::Outcome::separated ? 1 : event.pairs.size();
        }
        EXPECT_LE(asked.proof.tiles.size(), ends);
        (asked.recorded.contact ? hits : misses) += 1;
    }
    EXPECT_GT(misses, 50);
    EXPECT_GT(hits, 50);
}

}  // namespace
}  // namespace mobbscope
