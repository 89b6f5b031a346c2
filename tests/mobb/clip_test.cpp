#include <gtest/gtest.h>
#include <mobb/clip.h>
#include <mobb/predicate.h>

#include <cmath>
#include <limits>
#include <stdexcept>

namespace mobb {
namespace {

TEST(Clip, RefusesWhatIsNotAMotion) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const double infinity = std::numeric_limits<double>::infinity();
    EXPECT_THROW(Clip(0, {{0, 0, 1}}), std::invalid_argument);
    EXPECT_THROW(Clip(-1, {{0, 0, 1}}), std::invalid_argument);
    EXPECT_THROW(Clip(0.9e-12, {{0, 0, 1}}), std::invalid_argument);
    EXPECT_THROW(Clip(nan, {{0, 0, 1}}), std::invalid_argument);
    EXPECT_THROW(Clip(infinity, {{0, 0, 1}}), std::invalid_argument);
    EXPECT_THROW(Clip(1, {}), std::invalid_argument);
    EXPECT_THROW(Clip(1, {{nan, 0, 1}}), std::invalid_argument);
    EXPECT_THROW(Clip(1, {{0, infinity, 1}}), std::invalid_argument);
    EXPECT_THROW(Clip(1, {{0, 0, -1e-9}}), std::invalid_argument);
    EXPECT_THROW(Clip(1, {{1e10, 0, 1}}), std::invalid_argument);
    EXPECT_THROW(Clip(1e12, {{0, 0, 1}, {0, 0, 1}}), std::invalid_argument);
    try {
        Clip(1, {{0, 0, 1}, {0, 0, -1}});
        FAIL();
    } catch (const std::invalid_argument& error) {
        EXPECT_STREQ(error.what(), "sample 1: r must be finite, not negative and within 1e9 m");
    }
}

TEST(Clip, LastsAsLongAsItsCylinders) {
    const Clip clip(0.5, {{0, 0, 1}, {1, 0, 1}, {2, 0, 1}});
    EXPECT_EQ(clip.duration(), 1.5);
    EXPECT_EQ(clip.reach(), 3);
}

TEST(Rotation, QuarterTurnsAreExact) {
    for (int quarters = -9; quarters <= 9; ++quarters) {
        const Rotation r = Rotation::from_degrees(90.0 * quarters);
        const int k = ((quarters % 4) + 4) % 4;
        EXPECT_EQ(r.c, k == 0 ? 1 : k == 2 ? -1 : 0) << quarters;
        EXPECT_EQ(r.s, k == 1 ? 1 : k == 3 ? -1 : 0) << quarters;
    }
}

TEST(Rotation, AgreesWithTheFormula) {
    for (double degrees = -725; degrees < 725; degrees += 7.3) {
        const Rotation r = Rotation::from_degrees(degrees);
        EXPECT_NEAR(r.c, std::cos(degrees * std::acos(-1.0) / 180), 1e-13);
        EXPECT_NEAR(r.s, std::sin(degrees * std::acos(-1.0) / 180), 1e-13);
    }
}

TEST(Turn, IsOneOfDegreesOrOfCosineAndSine) {
    EXPECT_EQ(Turn(), 0.0);
    EXPECT_EQ(Turn(-270).rotation().s, 1);
    EXPECT_EQ(Turn(1e9 + 90), 1e9 + 90);
    EXPECT_FALSE(Turn(1e9 + 90).has_rotation());
    for (double degrees = -179.5; degrees < 180; degrees += 7.3) {
        const double radians = degrees * std::acos(-1.0) / 180;
        const Turn exact = Turn::by(std::cos(radians), std::sin(radians));
        EXPECT_NEAR(exact, degrees, 1e-12);
        // Floats are scaled: what is placed keeps its size.
        const Turn rough = Turn::by(std::cos(static_cast<float>(radians)), std::sin(static_cast<float>(radians)));
        const auto [c, s] = rough.rotation();
        EXPECT_NEAR(c * c + s * s, 1, 1e-15) << degrees;
        EXPECT_NEAR(rough, degrees, 1e-5);
        const Placement placement{.translate = {1, 2}, .rotate_deg = rough};
        EXPECT_EQ(placement, placement);
        EXPECT_EQ(placement.rotation().c, c);
    }
    EXPECT_EQ(Turn::by(0, 1).rotation().s, 1);
}

TEST(PlacedClip, RotatesAboutTheOriginThenTranslates) {
    const Clip clip(0.25, {{1, 0, 0.5}, {2, 0, 0.5}});
    const PlacedClip placed(clip, {.translate = {10, 20}, .rotate_deg = 90, .start = 3});
    EXPECT_EQ(placed.disk(1).x, 10);
    EXPECT_EQ(placed.disk(1).y, 22);
    EXPECT_EQ(placed.disk(1).r, 0.5);
    EXPECT_EQ(placed.time(0), 3);
    EXPECT_EQ(placed.time(2), 3.5);
}

TEST(Predicate, TouchingIsNotColliding) {
    EXPECT_FALSE(collide({0, 0, 1}, {2, 0, 1}));
    EXPECT_TRUE(collide({0, 0, 1}, {std::nextafter(2.0, 0.0), 0, 1}));
    EXPECT_FALSE(collide({0, 0, 0}, {0, 0, 0}));
}

TEST(Predicate, SharingAnEndPointIsNotOverlapping) {
    EXPECT_FALSE(overlap_in_time(0, 1, 1, 2));
    EXPECT_FALSE(overlap_in_time(0, 1 + 0.9e-9, 1, 2));
    EXPECT_TRUE(overlap_in_time(0, 1 + 1.1e-9, 1, 2));
}

TEST(Placement, Validity) {
    EXPECT_TRUE(is_valid({}));
    EXPECT_TRUE(is_valid({{kMaxLength, -kMaxLength}, -kMaxDegrees, -kMaxTime}));
    const double nan = std::nan(""), infinity = std::numeric_limits<double>::infinity();
    for (const double bad : {nan, -nan, infinity, -infinity, std::nextafter(kMaxLength, infinity), -1e10}) {
        EXPECT_FALSE(is_valid({.translate = {bad, 0}})) << bad;
        EXPECT_FALSE(is_valid({.translate = {0, bad}})) << bad;
        EXPECT_FALSE(is_valid({.rotate_deg = bad})) << bad;
        EXPECT_EQ(is_valid({.start = bad}), std::abs(bad) <= 1e12) << bad;
    }
    EXPECT_FALSE(is_valid({.start = std::nextafter(kMaxTime, infinity)}));
}

/// Whatever other clip is there with it, each sample shares over kMinOverlap with one of the other's, to the largest
/// start that is taken; and what is refused beyond has samples that may share it with none.
TEST(Placement, StartsAreTakenAsFarAsTimesAreHeld) {
    for (const double dt : {2.1e-9, 1e-8, 1e-5, 1.0 / 30, 1.0, 1e6}) {
        const Clip clip(dt, std::vector<Disk>(50, Disk{0, 0, 0.4}));
        const double most = clip.most_start();
        ASSERT_GE(most, 0);
        EXPECT_TRUE(is_valid({.start = most}, most));
        EXPECT_FALSE(is_valid({.start = std::nextafter(most, 1e300)}, most));
        EXPECT_EQ(most < kMaxTime, dt < 4.5e-4) << dt;
        for (const double sign : {-1.0, 1.0}) {
            const PlacedClip placed(clip, {.start = sign * most});
            for (const double shift : {0.0, 0.3, 0.5, 0.7}) {
                const PlacedClip other(clip, {.start = sign * (most - shift * dt)});
                for (int i = 1; i + 1 < clip.count(); ++i) {
                    double longest = 0;
                    for (int j = 0; j < clip.count(); ++j) {
                        longest = std::max(longest, std::min(placed.time(i + 1), other.time(j + 1)) -
                                                        std::max(placed.time(i), other.time(j)));
                    }
                    ASSERT_GT(longest, kMinOverlap) << dt << ", " << shift << ", sample " << i;
                }
            }
            if (most == kMaxTime) continue;
            try {
                PlacedClip(clip, {.start = sign * (1.001 * most + 1e-3)});
                ADD_FAILURE() << dt;
            } catch (const std::invalid_argument& error) {
                EXPECT_NE(std::string(error.what()).find("is too far from 0"), std::string::npos) << error.what();
            }
        }
    }
}

TEST(Clip, ATimeStepThatNothingCanBeSharedOfIsRefused) {
    for (const double dt : {1e-12, 1e-10, 1e-9, 2e-9}) {
        EXPECT_THROW(Clip(dt, {{0, 0, 0.4}}), std::invalid_argument) << dt;
    }
    EXPECT_NO_THROW(Clip(2.1e-9, {{0, 0, 0.4}}));
}

TEST(Rotation, RefusesWhatIsNoAngle) {
    for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity(), 1.1e9, -1.1e9}) {
        try {
            Rotation::from_degrees(bad);
            FAIL() << bad;
        } catch (const std::invalid_argument& error) {
            EXPECT_STREQ(error.what(), "rotate_deg must be finite and within 1e9 degrees");
        }
    }
}

}  // namespace
}  // namespace mobb
