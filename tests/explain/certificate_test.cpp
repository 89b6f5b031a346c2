// Certificates prove answers without a tree, and what proves nothing is refused.
#include <explain/certificate.h>
#include <mobb/query.h>

#include "mobb/random_motion.h"

#include <gtest/gtest.h>

#include <memory>
#include <random>

namespace mobbscope {
namespace {

mobb::ClipPtr random_clip(mobb::test::Random& random, mobb::Motion motion) {
    const int count = random.integer(1, 60);
    std::vector<mobb::Disk> disks;
    mobb::Disk at{random.real(-2, 2), random.real(-2, 2), random.real(0, 0.6)};
    for (int i = 0; i < count; ++i) {
        disks.push_back(at);
        at.x += random.real(-0.2, 0.3);
        at.y += random.real(-0.2, 0.2);
        if (random.chance(0.2)) at.r = random.real(0, 0.6);
    }
    return std::make_shared<const mobb::Clip>(random.chance(0.5) ? 0.1 : random.real(0.03, 0.2), disks, motion);
}

struct Asked {
    FittedScene fitted;
    RecordedQuery recorded;
    Certificate proof;

    Asked(const mobb::ClipPtr& a, const mobb::ClipPtr& b, const mobb::Placement& placement, mobb::TreeKind kind)
        : fitted(scene_of(a, b, placement), {.tree = kind, .leaf = 4}),
          recorded(record(fitted, fitted.queries()[0])),
          proof(certify(fitted, fitted.queries()[0], recorded)) {}

    static Scene scene_of(const mobb::ClipPtr& a, const mobb::ClipPtr& b, const mobb::Placement& placement) {
        Scene scene;
        scene.clips = {{"a", {}, {}, a}, {"b", {}, {}, b}};
        scene.agents = {{"A", 0, {}, {}}, {"B", 1, placement, {}}};
        return scene;
    }
    mobb::PlacedTree a() const { return fitted.placed(fitted.queries()[0].a); }
    mobb::PlacedTree b() const { return fitted.placed(fitted.queries()[0].b); }
    std::string refused(const Certificate& certificate) const {
        return why_not_proven(a().placed_clip(), b().placed_clip(), certificate);
    }
};

TEST(Certificate, ProvesAnswersOfAllKindsByNoMoreTilesThanTheTraceHasEnds) {
    mobb::test::Random random(35);
    int misses = 0, hits = 0, one = 0;
    for (int i = 0; i < 300; ++i) {
        SCOPED_TRACE(i);
        const auto motion = [&] { return random.chance(0.5) ? mobb::Motion::held : mobb::Motion::linear; };
        const mobb::ClipPtr a = random_clip(random, motion()), b = random_clip(random, motion());
        const mobb::Placement placement{
            {random.real(-3, 3), random.real(-3, 3)}, random.real(-180, 180), random.real(-3, 3)};
        const Asked asked(a, b, placement, static_cast<mobb::TreeKind>(i % 7));
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
