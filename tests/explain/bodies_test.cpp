/// Nearest bones against all pairs of bones at all times.
#include <explain/bodies.h>
#include <import/import.h>
#include <import/skeleton/disk_sampler.h>
#include <scene/scene.h>
#include <support/bvh_text.h>
#include <support/temp_folder.h>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "mobb/random_motion.h"

namespace mobbscope {
namespace {

using mobb::PlacedClip;
using mobb::Placement;
using mobb::test::Random;

glm::dvec3 at(const Segment& segment, double s) { return segment.from + s * (segment.to - segment.from); }

/// By thirds of thirds: the distance is convex in both.
double measured(const Segment& a, const Segment& b) {
    const auto least = [](const auto& value) {
        double low = 0, high = 1;
        for (int i = 0; i < 45; ++i) {
            const double first = low + (high - low) / 3, second = high - (high - low) / 3;
            (value(first) <= value(second) ? high : low) = value(first) <= value(second) ? second : first;
        }
        return std::min({value(0.5 * (low + high)), value(0.0), value(1.0)});
    };
    return least([&](double s) { return least([&](double t) { return glm::distance(at(a, s), at(b, t)); }); });
}

Segment random_segment(Random& random) {
    const auto point = [&] { return glm::dvec3(random.real(-1, 1), random.real(-1, 1), random.real(0, 2)); };
    const glm::dvec3 from = point();
    // Points, and directions that several have.
    if (random.chance(0.1)) return {from, from};
    if (random.chance(0.3)) return {from, from + random.real(-1, 1) * glm::dvec3(0, 0, 1)};
    return {from, point()};
}

TEST(Bodies, DistanceOfSegmentsIsTheLeastOfAllPoints) {
    Random random(1);
    for (int round = 0; round < 100; ++round) {
        const Segment a = random_segment(random);
        Segment b = random_segment(random);
        if (random.chance(0.2)) b.to = b.from + random.real(-2, 2) * (a.to - a.from) * (1 + 1e-12);
        const SegmentDistance found = distance_of(a, b);
        EXPECT_NEAR(found.distance, measured(a, b), 1e-7) << round;
        EXPECT_EQ(found.distance, glm::length(found.a - found.b));
        EXPECT_NEAR(measured({found.a, found.a}, a), 0, 1e-7);
        EXPECT_NEAR(measured({found.b, found.b}, b), 0, 1e-7);
        EXPECT_NEAR(distance_of(b, a).distance, found.distance, 1e-12);
    }
}

struct Motions {
    mobb::ClipPtr clip;
    Skeleton skeleton;
};

/// A body of a few joints that walks and sways; its disks reach the farthest.
Motions random_body(Random& random, mobb::Motion motion) {
    Motions out;
    const int joints = random.integer(1, 7), count = random.integer(1, 12);
    for (int i = 0; i < joints; ++i)
        out.skeleton.joints.push_back({"j" + std::to_string(i), i == 0 ? -1 : random.integer(0, i - 1), false});
    // Now and then there is a joint above the root, which is no part of the body.
    out.skeleton.root = joints > 3 && random.chance(0.3) ? 1 : 0;
    const std::vector<bool> inside = subtree(out.skeleton.joints, out.skeleton.root);
    std::vector<mobb::Disk> disks;
    std::vector<glm::vec3> pose;
    for (int i = 0; i < joints; ++i)
        pose.emplace_back(random.real(-0.5, 0.5), random.real(-0.5, 0.5), random.real(0, 1.8));
    const double heading = random.real(0, 6.28);
    for (int sample = 0; sample < count; ++sample) {
        double reach = 0;
        for (int i = 0; i < joints; ++i) {
            glm::vec3 p = pose[static_cast<std::size_t>(i)];
            p += glm::vec3(random.real(-0.1, 0.1), random.real(-0.1, 0.1), random.real(-0.1, 0.1));
            if (i == out.skeleton.root) p.x = p.y = 0;
            out.skeleton.positions.push_back(p);
            if (inside[static_cast<std::size_t>(i)]) reach = std::max(reach, std::hypot(double{p.x}, double{p.y}));
        }
        disks.push_back({0.15 * sample * std::cos(heading), 0.15 * sample * std::sin(heading), reach});
    }
    out.clip = std::make_shared<const mobb::Clip>(random.real(0.03, 0.1), disks, motion);
    return out;
}

/// Of all bones, whatever their disks.
double least_of_all(const PlacedBody& a, int i, const PlacedBody& b, int j, double time) {
    double out = std::numeric_limits<double>::infinity();
    for (const Segment& p : a.place(i, time)) {
        for (const Segment& q : b.place(j, time)) out = std::min(out, distance_of(p, q).distance);
    }
    return out;
}

TEST(Bodies, NearestBonesAreThoseOfAllPairsAtAllTimes) {
    Random random(2);
    int touch = 0, miss = 0, no_hit = 0;
    for (int round = 0; round < 900; ++round) {
        const mobb::Motion motion = round % 3 == 0 ? mobb::Motion::linear : mobb::Motion::held;
        const Motions of_a = random_body(random, motion), of_b = random_body(random, motion);
        const double radius = random.chance(0.2) ? 0 : random.real(0.01, 0.1);
        const PlacedClip clip_a(*of_a.clip, {{}, mobb::test::random_angle(random), 0});
        const PlacedClip clip_b(*of_b.clip, {{random.real(-1.5, 1.5), random.real(-1.5, 1.5)},
                                             mobb::test::random_angle(random),
                                             random.real(-0.3, 0.3)});
        const PlacedBody a(clip_a, of_a.skeleton), b(clip_b, of_b.skeleton);
        const Clearance clearance = clearance_over_time(clip_a, clip_b);
        const BodyDistances found = body_distances(a, b, clearance, radius);
        const double tolerance = motion == mobb::Motion::held ? 1e-7 : 2e-6;
        double least = std::numeric_limits<double>::infinity(), first = least;
        std::size_t step = 0;
        for (const ClearancePiece& piece : clearance.pieces) {
            const int moments = motion == mobb::Motion::held ? 1 : 12;
            double of_piece = std::numeric_limits<double>::infinity();
            for (int k = 0; k < moments; ++k) {
                const double time = piece.t0 + (piece.t1 - piece.t0) * k / moments;
                const double distance = least_of_all(a, piece.a_sample, b, piece.b_sample, time) - 2 * radius;
                of_piece = std::min(of_piece, distance);
                if (distance < -tolerance) first = std::min(first, time);
                const bool searched = std::ranges::any_of(
                    found.intervals, [&](const mobb::Interval& i) { return i.t0 <= time && time < i.t1; });
                EXPECT_TRUE(searched || distance >= -tolerance) << round << " at " << time;
            }
            least = std::min(least, of_piece);
            if (step >= found.steps.size() || found.steps[step].a_sample != piece.a_sample ||
                found.steps[step].b_sample != piece.b_sample)
                continue;
            const BodyStep& measured_step = found.steps[step++];
            const NearestBones& nearest = measured_step.nearest;
            EXPECT_LE(piece.t0, measured_step.t0);
            EXPECT_LE(measured_step.t1, piece.t1);
            EXPECT_GE(nearest.time, measured_step.t0);
            EXPECT_LE(nearest.time, measured_step.t1);
            const bool whole = measured_step.t0 == piece.t0 && measured_step.t1 == piece.t1;
            EXPECT_TRUE(!whole || nearest.distance <= of_piece + tolerance) << round;
            // It is the distance of the two bones that it names, at its time, and of none that is nearer.
            EXPECT_NEAR(least_of_all(a, piece.a_sample, b, piece.b_sample, nearest.time) - 2 * radius, nearest.distance,
                        1e-7);
            const auto index = [](const PlacedBody& body, SkeletonBone bone) {
                return static_cast<std::size_t>(std::ranges::find(body.bones(), bone) - body.bones().begin());
            };
            EXPECT_NEAR(distance_of(a.place(piece.a_sample, nearest.time)[index(a, nearest.a)],
                                    b.place(piece.b_sample, nearest.time)[index(b, nearest.b)])
                            .distance,
                        glm::distance(nearest.a_point, nearest.b_point), 1e-7);
        }
        EXPECT_EQ(step, found.steps.size()) << round;
        EXPECT_EQ(found.nearest.has_value(), !found.steps.empty());
        if (found.first) {
            ++touch;
            EXPECT_LE(found.first->time, first + 1e-9) << round;
            EXPECT_LE(found.first->distance, tolerance);
            EXPECT_TRUE(motion == mobb::Motion::linear || found.first->time == first) << round;
            EXPECT_GT(found.first->time, first - 0.1);
        } else {
            EXPECT_GE(least, -tolerance) << round;
            ++(found.intervals.empty() ? miss : no_hit);
        }
    }
    EXPECT_GT(touch, 20);
    EXPECT_GT(miss, 20);
    EXPECT_GT(no_hit, 10) << "disks that hit where no body does";
}

/// A pole of 1 m at a height, with an arm of half a metre along x or none.
Motions pole(double low, double arm, int samples = 3) {
    Motions out;
    out.skeleton.joints = {{"Foot", -1, false}, {"Head", 0, false}, {"Hand", 1, false}};
    for (int i = 0; i < samples; ++i) {
        out.skeleton.positions.insert(out.skeleton.positions.end(), {{0, 0, low}, {0, 0, low + 1}, {arm, 0, low + 1}});
    }
    out.clip = std::make_shared<const mobb::Clip>(
        0.1, std::vector<mobb::Disk>(static_cast<std::size_t>(samples), {0, 0, arm}));
    return out;
}

TEST(Bodies, DisksMayHitWhereNoBodyDoes) {
    const Motions one = pole(0, 0.5), other = pole(0, 0.5);
    // Side by side, the arms in parallel.
    const PlacedClip clip_a(*one.clip, {}), clip_b(*other.clip, {{0, 0.4}, 0, 0.05});
    const PlacedBody a(clip_a, one.skeleton), b(clip_b, other.skeleton);
    const Clearance clearance = clearance_over_time(clip_a, clip_b);
    ASSERT_TRUE(clearance.contact);
    const BodyDistances found = body_distances(a, b, clearance, 0.05);
    EXPECT_FALSE(found.first);
    ASSERT_EQ(found.intervals.size(), 1u);
    EXPECT_EQ(found.intervals[0].t0, 0.05);
    ASSERT_TRUE(found.nearest);
    EXPECT_NEAR(found.steps[*found.nearest].nearest.distance, 0.3, 1e-9);
    EXPECT_LE(std::ssize(found.steps) * 4, body_cost(a, b, clearance, 0.05));

    // The arm of one through the pole of the other.
    const PlacedClip clip_c(*other.clip, {{0.3, 0.08}, 0, 0});
    const PlacedBody c(clip_c, other.skeleton);
    const BodyDistances hit = body_distances(a, c, clearance_over_time(clip_a, clip_c), 0.05);
    ASSERT_TRUE(hit.first);
    EXPECT_EQ(hit.first->time, 0);
    EXPECT_NEAR(hit.first->distance, -0.02, 1e-7);
    EXPECT_EQ(bone_words(one.skeleton, hit.first->a), "Head\u2013Hand");
    EXPECT_EQ(bone_words(one.skeleton, hit.first->b), "Foot\u2013Head");
}

TEST(Bodies, CapsulesReachBeyondTheDisks) {
    // Disks of no radius, as poles are, 6 cm apart: the capsules of 5 cm overlap by 4.
    const Motions one = pole(0, 0), other = pole(0.5, 0);
    const PlacedClip clip_a(*one.clip, {}), clip_b(*other.clip, {{0.06, 0}, 0, 0.1});
    const PlacedBody a(clip_a, one.skeleton), b(clip_b, other.skeleton);
    const Clearance clearance = clearance_over_time(clip_a, clip_b);
    EXPECT_FALSE(clearance.contact);
    const BodyDistances found = body_distances(a, b, clearance, 0.05);
    ASSERT_TRUE(found.first);
    EXPECT_EQ(found.first->time, 0.1);
    EXPECT_NEAR(found.first->distance, -0.04, 1e-9);
    // Touching is not colliding, and what ends before the other's height is passed below it.
    EXPECT_FALSE(body_distances(a, b, clearance, 0.02).first);
    const Motions above = pole(1.2, 0);
    const PlacedClip clip_c(*above.clip, {});
    const BodyDistances over =
        body_distances(a, PlacedBody(clip_c, above.skeleton), clearance_over_time(clip_a, clip_c), 0.05);
    EXPECT_FALSE(over.first);
    EXPECT_NEAR(over.steps[*over.nearest].nearest.distance, 0.1, 1e-6);
}

TEST(Bodies, ARadiusThatWasGivenHidesNoBody) {
    Motions one = pole(0, 0.5);
    const Motions other = pole(0, 0);
    one.clip = std::make_shared<const mobb::Clip>(0.1, std::vector<mobb::Disk>(3, {0, 0, 0.1}));
    const PlacedClip clip_a(*one.clip, {}), clip_b(*other.clip, {{0.5, 0}, 0, 0});
    const BodyDistances found = body_distances(PlacedBody(clip_a, one.skeleton), PlacedBody(clip_b, other.skeleton),
                                               clearance_over_time(clip_a, clip_b), 0.05);
    EXPECT_TRUE(found.first);
}

TEST(Bodies, OfRunningClipsTheFirstTouchIsFoundBetweenSamples) {
    const Motions other = pole(0, 0);
    // 2 m/s along x, past a pole 6 cm aside at x = 3: capsules of 5 cm touch 8 cm before it.
    const mobb::Clip runs(1, {{0, 0, 0}, {2, 0, 0}, {4, 0, 0}}, mobb::Motion::linear);
    const mobb::Clip stands(1, {{3, 0.06, 0}, {3, 0.06, 0}, {3, 0.06, 0}});
    const PlacedClip clip_a(runs, {}), clip_b(stands, {});
    const PlacedBody a(clip_a, other.skeleton), b(clip_b, other.skeleton);
    const BodyDistances found = body_distances(a, b, clearance_over_time(clip_a, clip_b), 0.05);
    ASSERT_TRUE(found.first);
    EXPECT_NEAR(found.first->time, 1.46, 2e-6);
    EXPECT_NEAR(found.first->distance, 0, 2e-6);
    EXPECT_NEAR(found.steps[*found.nearest].nearest.distance, -0.04, 2e-6);
    EXPECT_NEAR(found.steps[*found.nearest].nearest.time, 1.5, 1e-3);
    ASSERT_EQ(found.intervals.size(), 1u);
    EXPECT_NEAR(found.intervals[0].t0, 1.46, 1e-9);
    EXPECT_NEAR(found.intervals[0].t1, 1.54, 1e-9);
}

/// Each joint of the disks' subtree lies in its sample's disk, where it is placed.
void expect_bones_inside(const SceneClip& clip, const std::string& what) {
    ASSERT_TRUE(clip.skeleton) << what;
    const PlacedClip placed(*clip.clip, {{12, -7}, 123.4, 5});
    const PlacedBody body(placed, *clip.skeleton);
    for (int i = 0; i < placed.count(); ++i) {
        for (const double share : {0.0, 0.4}) {
            const double time = placed.time(i) + share * (placed.time(i + 1) - placed.time(i));
            const mobb::Disk disk = mobb::swept(placed, i).at(time);
            for (const Segment& bone : body.place(i, time)) {
                for (const glm::dvec3& p : {bone.from, bone.to})
                    ASSERT_LE(std::hypot(p.x - disk.x, p.y - disk.y), disk.r + 1e-6) << what << ", sample " << i;
            }
        }
    }
}

TEST(Bodies, BonesLieInTheDisks) {
    const TempFolder folder;
    folder.write("walker.bvh", kWalker);
    const std::string options[] = {R"("fps": 17)", R"("fps": 30, "trim": [0.03, 0.08])", R"("root": "Left Arm")",
                                   R"("origin": "start_heading", "motion": "linear")",
                                   R"("turn": {"deg": 70, "seconds": 0.05}, "fps": 40)"};
    for (const std::string& option : options) {
        const Scene scene =
            parse_scene(R"({"clips": {"c": {"source": "walker.bvh", )" + option + "}}}", "s.json", folder.path());
        expect_bones_inside(scene.clips[0], option);
    }
}

TEST(Bodies, BonesOfRealMotionsLieInTheDisks) {
    const std::filesystem::path data(MOBBSCOPE_SHARED_DATA);
    if (!std::filesystem::exists(data)) GTEST_SKIP() << "no test data at " << data;
    for (const char* file : {"bvh/short/bn1_walk_normal_002.bvh", "bvh/short/cmu_02_01_walk_30hz.bvh",
                             "bvh/long/cmu_02_10_wash-self_30hz.bvh", "bvh/quirks/rotation_first_root.bvh",
                             "gltf/CesiumMan.glb", "gltf/derived_cmu_07_05_zup.glb", "fbx/cmu_85_04_breakdance.fbx"}) {
        const Scene scene = load_scene(data / file);
        for (const SceneClip& clip : scene.clips) expect_bones_inside(clip, file);
    }
}

}  // namespace
}  // namespace mobbscope
