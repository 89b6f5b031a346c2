#include <paper_tables/built_in_clips.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace mobbscope {
namespace {

double mean_seconds(const std::vector<mobb::ClipPtr>& clips) {
    double sum = 0;
    for (const mobb::ClipPtr& clip : clips) sum += clip->duration();
    return sum / static_cast<double>(clips.size());
}

TEST(BuiltInClips, LongWalksStayInTheirVolume) {
    const std::vector<mobb::ClipPtr> clips = walks_in_a_volume(14, 42, 1);
    ASSERT_EQ(clips.size(), 14u);
    EXPECT_NEAR(mean_seconds(clips), 42, 6);
    for (const mobb::ClipPtr& clip : clips) {
        double farthest = 0, travelled = 0;
        const auto samples = clip->samples();
        for (std::size_t i = 0; i < samples.size(); ++i) {
            farthest = std::max(farthest, std::hypot(samples[i].x, samples[i].y));
            if (i > 0) travelled += std::hypot(samples[i].x - samples[i - 1].x, samples[i].y - samples[i - 1].y);
        }
        EXPECT_LT(farthest, 3.2);
        EXPECT_GT(farthest, 1.5);
        EXPECT_GT(travelled, 0.25 * clip->duration());
    }
}

TEST(BuiltInClips, ShortMovesAreOfSeveralKinds) {
    const std::vector<mobb::ClipPtr> clips = short_moves(51, 2.1, 1);
    ASSERT_EQ(clips.size(), 51u);
    EXPECT_NEAR(mean_seconds(clips), 2.1, 0.2);
    int fast = 0, backwards = 0;
    for (const mobb::ClipPtr& clip : clips) {
        const mobb::Disk& last = clip->samples().back();
        if (std::hypot(last.x, last.y) > 2.5 * clip->duration()) ++fast;
        if (last.x < -0.3) ++backwards;
    }
    EXPECT_GE(fast, 3);
    EXPECT_GE(backwards, 1);
}

TEST(BuiltInClips, ASeedGivesTheSameClipsAndAnotherSeedOthers) {
    EXPECT_EQ(walks_in_a_volume(1, 5, 3)[0]->samples()[100].x, walks_in_a_volume(1, 5, 3)[0]->samples()[100].x);
    EXPECT_NE(walks_in_a_volume(1, 5, 3)[0]->samples()[90].x, walks_in_a_volume(1, 5, 4)[0]->samples()[90].x);
}

}  // namespace
}  // namespace mobbscope
