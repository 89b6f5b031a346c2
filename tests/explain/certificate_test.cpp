// Certificates prove answers without a tree, and what proves nothing is refused.
#include <explain/certificate.h>
#include <mobb/query.h>

#include "mobb/random_motion.h"

#include <gtest/gtest.h>

#include <utility>

namespace mobbscope {
namespace {

struct Asked {
    FittedScene fitted;
    RecordedQuery recorded;
    Certificate proof;

    Asked(Scene scene, const mobb::FitOptions& fit)
        : fitted(std::move(scene), fit),
          recorded(record(fitted, fitted.queries()[0])),
          proof(certify(fitted, fitted.queries()[0], recorded)) {}

    /// Held and linear, touching, far away, of one sample and of many.
    static Asked random(mobb::test::Random& random) {
        const mobb::ClipPtr a = mobb::test::random_motion(random, mobb::test::random_clip(random, 200));
        const mobb::ClipPtr b = mobb::test::random_motion(random, mobb::test::random_partner(random, *a, 200));
        Scene scene;
        scene.clips = {{"a", {}, {}, a}, {"b", {}, {}, b}};
        scene.agents = {{"A", 0, {}, {}}, {"B", 1, {}, {}}};
        mobb::test::random_placements(random, *a, *b, scene.agents[0].placement, scene.agents[1].placement);
        return {std::move(scene), mobb::test::random_any_fit(random)};
    }
    mobb::PlacedTree a() const { return fitted.placed(fitted.queries()[0].a); }
    mobb::PlacedTree b() const { return fitted.placed(fitted.queries()[0].b); }
    std::string refused(const Certificate& certificate) const {
        return why_not_proven(a().placed_clip(), b().placed_clip(), certificate);
    }
};

int budget() {
    const char* text = std::getenv("MOBBSCOPE_CERTIFICATES");
    return text ? std::atoi(text) : 300;
}

TEST(Certificate, ProvesAnswersOfAllKindsByNoMoreTilesThanTheTraceHasEnds) {
    mobb::test::Random random(35);
    int misses = 0, hits = 0, one = 0;
    for (int i = 0; i < budget(); ++i) {
        SCOPED_TRACE(i);
        const Asked asked = Asked::random(random);
        EXPECT_EQ(asked.refused(asked.proof), "");
        EXPECT_EQ(asked.proof.contact, asked.recorded.contact);
        std::size_t ends = 0;
        for (int step = 0; step < asked.recorded.trace.size(); ++step) {
            const mobb::Trace::Event event = asked.recorded.trace[step];
            ends += event.outcome == mobb::Outcome::separated ? 1 : event.pairs.size();
        }
        EXPECT_LE(asked.proof.tiles.size(), ends);
        (asked.recorded.contact ? hits : misses) += 1;
        one += asked.proof.tiles.size() == 1 ? 1 : 0;
    }
    EXPECT_GT(misses, 50);
    EXPECT_GT(hits, 50);
    std::printf("misses %d hits %d one tile %d\n", misses, hits, one);
}

}  // namespace
}  // namespace mobbscope
