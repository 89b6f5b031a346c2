// Feet that should stand, and how far they slide.
#include "walking_body.h"

#include <crowd/graph/continuity.h>
#include <crowd/graph/foot_slide.h>

#include <gtest/gtest.h>

namespace mobbscope {
namespace {

constexpr int kStepFrames = 30;
constexpr double kHipStep = 0.04;  // metres a frame

/// The hips walk on; the foot stays at `foot` in the clip.
BodyFrame with_foot_at(int frame, glm::dvec3 foot) {
    BodyFrame out{{kHipStep * frame, 0, 1}};
    out.foot = foot - glm::dvec3(kHipStep * frame, 0, 0);
    return out;
}

/// The foot stands for ten frames, swings for ten and stands for ten, sliding by `slide` while it stands the second
/// time.
SceneClip step_clip(double slide) {
    return body_clip("step", kStepFrames, [=](int i) {
        if (i < 10) return with_foot_at(i, {0, 0, 0});
        if (i < 20) return with_foot_at(i, {0.1 * (i - 9), 0, 0.15});
        return with_foot_at(i, {1.2, slide * (i - 20) / 9, 0});
    });
}

std::vector<Contact> standing_in(const SceneClip& clip) {
    return standing(*clip.clip, *clip.skeleton, 0, clip.clip->count());
}

TEST(FootSlide, AFootStandsWhereItIsLowAndSlow) {
    const SceneClip clip = step_clip(0.03);
    const std::vector<Contact> found = standing_in(clip);
    ASSERT_EQ(found.size(), 2u);
    EXPECT_EQ(found[0].joint, 2);  // neither hips nor hand carry
    EXPECT_EQ(found[0].first, 0);
    EXPECT_EQ(found[0].count, 10);
    EXPECT_EQ(found[1].first, 20);
    EXPECT_EQ(found[1].count, 10);
    EXPECT_NEAR(slide_of(places_of(found[0], *clip.clip, *clip.skeleton)), 0, 1e-6);
    EXPECT_NEAR(slide_of(places_of(found[1], *clip.clip, *clip.skeleton)), 0.03, 1e-6);
    // A part of the clip, its frames counted from the part's first.
    const std::vector<Contact> later = standing(*clip.clip, *clip.skeleton, 15, kStepFrames);
    ASSERT_EQ(later.size(), 1u);
    EXPECT_EQ(later[0].first, 5);
}

TEST(FootSlide, AFootThatGlidesOrHoversDoesNotStand) {
    const SceneClip glides = body_clip("glides", kStepFrames, [](int i) { return BodyFrame{{kHipStep * i, 0, 1}}; });
    for (const Contact& contact : standing_in(glides)) EXPECT_EQ(contact.count, 1);
    const SceneClip hovers = body_clip("hovers", kStepFrames, [](int i) {
        return with_foot_at(i, {0, 0, i < 10 ? 0.0 : 0.05});
    });
    const std::vector<Contact> found = standing_in(hovers);
    ASSERT_EQ(found.size(), 1u);
    EXPECT_EQ(found[0].count, 10);
}

TEST(FootSlide, AHandThatTouchesTheFloorForAMomentDoesNotCarry) {
    const SceneClip clip = body_clip("touches", kStepFrames, [](int i) {
        BodyFrame frame;
        frame.hand = {0.5, 0, i < 2 ? 0.0 : 0.02};
        return frame;
    });
    const std::vector<Contact> found = standing_in(clip);
    ASSERT_EQ(found.size(), 1u);
    EXPECT_EQ(found[0].joint, 2);
    EXPECT_EQ(found[0].count, kStepFrames);
}

TEST(FootSlide, ContactsOfOneClipAreMeasuredInAnotherThatWasMadeOfIt) {
    const SceneClip stands = step_clip(0);
    const SceneClip bent = step_clip(0.3);  // slides too fast to be found by itself
    const std::vector<Contact> found = standing_in(stands);
    ASSERT_EQ(found.size(), 2u);
    EXPECT_NEAR(slide_of(places_of(found[1], *bent.clip, *bent.skeleton)), 0.3, 1e-6);
    EXPECT_EQ(standing_in(bent)[1].count, 1);
}

TEST(FootSlide, OfAGraphTheLargestAndTheMedianAreTold) {
    const Stance entry{{0, 0}, 0};
    const Stance exit{{1.2, 0}, 0};
    const Continuity found = graph_continuity(
        body_scene({step_clip(0), step_clip(0.05), step_clip(0)}, {{entry, exit}, {entry, exit}, {entry, exit}}));
    EXPECT_EQ(found.contacts, 6u);
    EXPECT_NEAR(found.median_slide, 0, 1e-6);
    EXPECT_NEAR(found.within.metres, 0.05, 1e-6);
    EXPECT_EQ(found.within.before, 1);
    EXPECT_EQ(found.within.joint, 2);
    // The foot goes on standing where the next move begins; only the slide before is seen.
    EXPECT_NEAR(found.across.metres, 0.05, 1e-6);
    EXPECT_EQ(found.across.before, 1);
}

TEST(FootSlide, AFootThatStandsOnBothSidesOfAJoinSlidesWhereItJumps) {
    const Stance entry{{0, 0}, 0};
    const Stance exit{{1.25, 0}, 0};  // 5 cm beyond where it stands
    const Continuity found = graph_continuity(body_scene({step_clip(0)}, {{entry, exit}}));
    EXPECT_NEAR(found.within.metres, 0, 1e-6);
    EXPECT_NEAR(found.across.metres, 0.05, 1e-6);
    EXPECT_EQ(found.across.before, 0);
    EXPECT_EQ(found.across.after, 0);
}

TEST(FootSlide, AContactLasts) {
    EXPECT_TRUE(lasts(4, 1.0 / 30));
    EXPECT_FALSE(lasts(3, 1.0 / 30));
    EXPECT_FALSE(lasts(1, 1));
}

}  // namespace
}  // namespace mobbscope
