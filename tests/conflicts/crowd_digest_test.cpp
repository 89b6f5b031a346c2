// Parts are of one whole if their crowds are the same, bodies and floors included; a conflict is of agents, not of
// disks.
#include <conflicts/conflicts.h>
#include <conflicts/crowd.h>

#include <gtest/gtest.h>

#include <set>
#include <string>

namespace mobbscope {
namespace {

std::string two(const std::string& body, const std::string& floors) {
    return R"({"clips": {"car": {"dt": 1, "motion": "linear", )" + body + R"("samples": [[0,0,1],[5,0,1]]}},
        "agents": [{"name": "A", "clip": "car"}, {"name": "B", "clip": "car", "translate": [0, 1.5])" +
           floors + "}]}";
}

Scene scene(const std::string& text) { return parse_scene(text, "s.json", ""); }

std::uint64_t digest_of(const Scene& scene) { return Crowd(scene).digest(); }

TEST(CrowdDigest, IsAnotherForOtherBodiesHeadingsAndFloors) {
    const std::string body = R"("body": [[1,0,0.8],[-1,0,0.8]], )";
    const std::set<std::uint64_t> all{digest_of(scene(two("", ""))), digest_of(scene(two(body, ""))),
                                      digest_of(scene(two(R"("body": [[1,0,0.8],[-1,0,0.7]], )", ""))),
                                      digest_of(scene(two(body + R"("headings": [0, 90], )", ""))),
                                      digest_of(scene(two(body, R"(, "floor": 1)")))};
    EXPECT_EQ(all.size(), 5u);
}

TEST(BodiesInAScene, HaveOneConflict) {
    const Scene cars = scene(two(R"("body": [[1,0,0.8],[-1,0,0.8]], )", ""));
    const std::vector<SceneConflict> conflicts = conflicts_in(cars);
    ASSERT_EQ(conflicts.size(), 1u);
    EXPECT_EQ(conflicts[0].a.agent, 0);
    EXPECT_EQ(conflicts[0].b.agent, 1);
    EXPECT_GE(conflicts[0].a.member, 0);
    EXPECT_NEAR(conflicts[0].facts.deepest.least_clearance, -0.1, 1e-12);
    ASSERT_TRUE(place_of(cars, conflicts[0]));
    EXPECT_NEAR(place_of(cars, conflicts[0])->y, 0.75, 1e-12);
}

}  // namespace
}  // namespace mobbscope
