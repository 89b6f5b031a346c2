// How far apart two moments are, and how they are brought together.
#include <crowd/graph/pose_distance.h>

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace mobbscope {
namespace {

constexpr int kFrames = 40;
constexpr std::size_t kJoints = 7;

/// A body whose joints and path wander at random, at 30 Hz.
PoseTrack random_track(std::mt19937& random) {
    std::uniform_real_distribution<double> step(-0.05, 0.05);
    PoseTrack track;
    track.dt = 1.0 / 30;
    track.joints = kJoints;
    glm::dvec2 root(step(random), step(random));
    std::vector<glm::vec3> pose(kJoints);
    for (glm::vec3& p : pose) p = 10.0F * glm::vec3(step(random), step(random), 2 * std::abs(step(random)));
    for (int f = 0; f < kFrames; ++f) {
        root += glm::dvec2(step(random), step(random));
        for (glm::vec3& p : pose) p += glm::vec3(step(random), step(random), step(random));
        track.root.push_back(root);
        track.points.insert(track.points.end(), pose.begin(), pose.end());
    }
    return track;
}

/// The same motion elsewhere on the floor, turned by so many degrees.
PoseTrack moved(const PoseTrack& track, double turn_deg, glm::dvec2 by) {
    const mobb::Rotation turn = mobb::Rotation::from_degrees(turn_deg);
    PoseTrack out = track;
    for (glm::dvec2& root : out.root) root = turn(root) + by;
    for (glm::vec3& p : out.points) p = glm::vec3(glm::vec2(turn({p.x, p.y})), p.z);
    return out;
}

TEST(PoseDistance, AMotionIsNoDistanceFromItselfElsewhere) {
    std::mt19937 random(1);
    for (int round = 0; round < 50; ++round) {
        const PoseTrack a = random_track(random);
        const double turn = std::uniform_real_distribution<double>(-179, 179)(random);
        const PoseTrack b = moved(a, turn, {100, -50});
        const Alignment found = PoseWindows::compare(PoseWindows(a), 20, PoseWindows(b), 20);
        EXPECT_NEAR(found.distance, 0, 1e-3);  // single precision
        EXPECT_NEAR(found.turn_deg, -turn, 1e-2);
        EXPECT_NEAR(joined_distance(a, 20, 0, b, 20, turn), 0, 1e-5);
    }
}

TEST(PoseDistance, NoOtherTurnBringsMomentsCloser) {
    std::mt19937 random(2);
    for (int round = 0; round < 20; ++round) {
        const PoseTrack a = random_track(random);
        const PoseTrack b = random_track(random);
        const Alignment found = PoseWindows::compare(PoseWindows(a), 15, PoseWindows(b), 22);
        EXPECT_NEAR(joined_distance(a, 15, 0, b, 22, -found.turn_deg), found.distance, 1e-5);
        for (int turn = -180; turn < 180; ++turn) {
            EXPECT_GE(joined_distance(a, 15, -turn, b, 22, 0), found.distance - 1e-5) << turn;
        }
    }
}

TEST(PoseDistance, ThePathsAndThePosesAroundTheMiddleCount) {
    std::mt19937 random(3);
    const PoseTrack a = random_track(random);
    PoseTrack later = a;
    later.points[(20 + 4) * kJoints].z += 1;  // the last frame of the moment
    const double seen = PoseWindows::compare(PoseWindows(a), 20, PoseWindows(later), 20).distance;
    EXPECT_NEAR(seen, std::sqrt(1.0 / (5 * kJoints)), 1e-4);
    later = a;
    later.points[(20 + 5) * kJoints].z += 1;  // beyond
    EXPECT_NEAR(PoseWindows::compare(PoseWindows(a), 20, PoseWindows(later), 20).distance, 0, 1e-3);
}

TEST(PoseDistance, ObeysTheTriangleInequality) {
    std::mt19937 random(4);
    for (int round = 0; round < 200; ++round) {
        const PoseWindows a(random_track(random));
        const PoseWindows b(random_track(random));
        const PoseWindows c(random_track(random));
        const double ab = PoseWindows::compare(a, 10, b, 11).distance;
        const double bc = PoseWindows::compare(b, 11, c, 12).distance;
        EXPECT_LE(PoseWindows::compare(a, 10, c, 12).distance, ab + bc + 1e-5);
    }
}

TEST(PoseDistance, WindowsSpreadOverTheSameTimeAtAnyRate) {
    EXPECT_EQ(window_offsets(1.0 / 30), (std::array<int, 5>{-4, -2, 0, 2, 4}));
    EXPECT_EQ(window_offsets(1.0 / 120), (std::array<int, 5>{-16, -8, 0, 8, 16}));
    EXPECT_EQ(window_offsets(10), (std::array<int, 5>{0, 0, 0, 0, 0}));
}

TEST(PoseDistance, WhatATrackLacksIsLeftOut) {
    std::mt19937 random(5);
    const PoseTrack a = random_track(random);
    // Nothing comes before the first frame, so what is after it is compared.
    EXPECT_NEAR(joined_distance(a, 0, 0, a, 0, 0), 0, 1e-12);
    // One beyond the last against the first: no frame in common, so the last against the first.
    PoseTrack still = a;
    for (int f = 0; f < kFrames; ++f) {
        still.root[static_cast<std::size_t>(f)] = {0, 0};
        for (std::size_t j = 0; j < kJoints; ++j) still.points[static_cast<std::size_t>(f) * kJoints + j] = a.points[j];
    }
    EXPECT_NEAR(joined_distance(still, kFrames, 0, still, 0, 0), 0, 1e-12);
}

}  // namespace
}  // namespace mobbscope
