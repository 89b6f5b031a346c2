#include <scene/fitted_scene.h>

#include <gtest/gtest.h>

#include <stdexcept>

namespace mobbscope {
namespace {

Scene head_on() {
    return parse_scene(R"({"clips": {"walk": {"dt": 0.5, "samples":
        [[0,0,0.4],[0.5,0,0.4],[1,0,0.4],[1.5,0,0.4],[2,0,0.4],[2.5,0,0.4],[3,0,0.4],[3.5,0,0.4]]}},
        "agents": [{"name": "A", "clip": "walk"}, {"name": "B", "clip": "walk", "translate": [4, 0.1], "rotate_deg": 180}]})",
                       "s.json", "");
}

TEST(FittedScene, TheRecordIsTheAnswer) {
    const Scene scene = head_on();
    const FittedScene fitted(scene, {mobb::TreeKind::umobb, 2, 0, mobb::Axes::endpoints, 1});
    ASSERT_EQ(fitted.queries().size(), 1u);
    const RecordedQuery recorded = record(fitted, fitted.queries()[0]);
    const auto a = fitted.placed(fitted.queries()[0].a);
    const auto b = fitted.placed(fitted.queries()[0].b);
    ASSERT_TRUE(recorded.contact);
    EXPECT_EQ(recorded.contact, mobb::direct_search(a.placed_clip(), b.placed_clip()));
    mobb::Statistics statistics;
    mobb::query(a, b, statistics);
    EXPECT_EQ(recorded.tests, statistics.tests);
    EXPECT_EQ(recorded.trace[recorded.trace.size() - 1].outcome, mobb::Outcome::hit);
}

TEST(FittedScene, OptionsOutOfRangeAreRefused) {
    mobb::FitOptions options;
    options.leaf = 0;
    EXPECT_THROW(FittedScene(head_on(), options), std::invalid_argument);
}

}  // namespace
}  // namespace mobbscope
