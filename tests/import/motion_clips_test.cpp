#include "imported.h"

#include <import/bvh/bvh.h>
#include <import/skeleton/motion.h>
#include <import/skeleton/motion_clips.h>
#include <support/bvh_text.h>
#include <support/input_error.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace mobbscope {
namespace {

ImportedClip clip_of(const std::string& text, const ImportOptions& options = {}) {
    return motion_clips(bvh_motion(parse_bvh(text, "walk.bvh")), "some/walk.bvh", options).at(0);
}

void expect_disk(const ImportedClip& of, std::size_t sample, double x, double y, double r) {
    const mobb::Disk disk = of.clip->samples()[sample];
    EXPECT_NEAR(disk.x, x, 1e-9);
    EXPECT_NEAR(disk.y, y, 1e-9);
    EXPECT_NEAR(disk.r, r, 1e-9);
}

/// A pole 1.7 m tall in cm that goes along X at a frame's `steps` in cm, 30 a second, with an arm 40 cm long.
std::string walk(const std::vector<double>& xs, double first_arm = 40) {
    std::string text =
        "HIERARCHY\nROOT Hips\n{\nOFFSET 0 0 0\nCHANNELS 3 Xposition Yposition Zposition\nJOINT Head\n{\nOFFSET 0 85 "
        "0\n}\n"
        "JOINT Foot\n{\nOFFSET 0 -85 0\n}\nJOINT Hand\n{\nOFFSET 0 0 0\nCHANNELS 1 Xposition\n}\n}\nMOTION\nFrames: " +
        std::to_string(xs.size()) + "\nFrame Time: 0.033333\n";
    double arm = first_arm;
    for (const double x : xs) {
        text += std::to_string(x) + " 85 0 " + std::to_string(arm) + "\n";
        arm = 40;
    }
    return text;
}

std::vector<double> even_steps(int count, double step) {
    std::vector<double> out;
    for (int i = 0; i < count; ++i) out.push_back(i * step);
    return out;
}

TEST(MotionClips, DisksReachTheFarthestJointOverTheGround) {
    const ImportedClip it = clip_of(kWalker);
    EXPECT_EQ(it.name, "walk");
    EXPECT_EQ(it.facts.format, "bvh");
    EXPECT_EQ(it.facts.root, "Hips");
    EXPECT_EQ(it.facts.joints, 3);
    EXPECT_EQ(it.facts.unit, 0.01);
    EXPECT_NEAR(it.facts.guessed_from_height.value(), 1.7, 1e-9);
    EXPECT_EQ(it.facts.frames, 2);
    EXPECT_EQ(it.facts.dt, 0.1);
    EXPECT_EQ(it.facts.duration, 0.1);
    ASSERT_EQ(it.clip->count(), 4);
    EXPECT_DOUBLE_EQ(it.clip->dt(), 1.0 / 30);
    // The arm with its End Site reaches 0.7 m at both stored frames. With Y up the ground is (X, -Z).
    expect_disk(it, 0, 0, -0.3, 0.7);
    expect_disk(it, 1, 0.1 / 3, -0.3, 0.7);
    expect_disk(it, 3, 0.1, -0.3, 0.7);
}

/// A body 170 tall that stands with an arm stretched out, times a factor; its leg turned by so many degrees.
std::string body(double by, const std::string& turned = "0") {
    const auto offset = [by](double x, double y) {
        return "OFFSET " + std::to_string(x * by) + ' ' + std::to_string(y * by) + " 0\n";
    };
    const auto tip = [](const std::string& of) { return "End Site\n{\n" + of + "}\n"; };
    return "HIERARCHY\nROOT Hips\n{\n" + offset(0, 0) + "JOINT Spine\n{\n" + offset(0, 50) + tip(offset(0, 30)) +
           tip(offset(75, 0)) + "}\nJOINT Leg\n{\n" + offset(0, 0) + "CHANNELS 1 Zrotation\n" + tip(offset(0, -90)) +
           "}\n}\nMOTION\nFrames: 2\nFrame Time: 0.1\n" + turned + '\n' + turned + '\n';
}

TEST(MotionClips, LimbsTellTheUnitWhereTheHeightDoesNot) {
    for (const double by : {1.0, 0.01, 10.0, 1 / 2.54}) {
        const SourceFacts facts = clip_of(body(by)).facts;
        EXPECT_NEAR(facts.unit * by, 0.01, 1e-6) << "who stands is told by the height";
        EXPECT_NEAR(facts.guessed_from_height.value(), 1.7, 1e-4);
    }
    // From hand to foot it is 2.15 m.
    const SourceFacts decimetres = clip_of(body(0.1)).facts;
    EXPECT_EQ(decimetres.unit, 0.1);
    EXPECT_NEAR(decimetres.guessed_from_height.value(), 0.74 * 2.15, 1e-6);
    // Folded it is 0.8 m high: in inches that would be 2.03 m.
    EXPECT_EQ(clip_of(body(1, "180")).facts.unit, 0.01);
}

TEST(MotionClips, UnitUpRootAndRadiusAreOptions) {
    ImportOptions options;
    options.unit = "in";
    expect_disk(clip_of(kWalker, options), 0, 0, -30 * 0.0254, 70 * 0.0254);
    options = {};
    options.unit = "m";
    options.up = "z";
    const double reach = std::hypot(0, 95);
    expect_disk(clip_of(kWalker, options), 0, 0, 95, reach);
    options = {};
    options.root = "Left Arm";
    options.unit = "cm";
    EXPECT_EQ(clip_of(kWalker, options).facts.joints, 1);
    expect_disk(clip_of(kWalker, options), 0, 0, -0.8, 0.2);
    options.radius = 0.5;
    expect_disk(clip_of(kWalker, options), 0, 0, -0.8, 0.5);
}

TEST(MotionClips, RootGoesDownWhileNothingMovesAndThereIsOneChild) {
    const std::string wrapped = R"(HIERARCHY
ROOT World
{
  OFFSET 3 0 4
  CHANNELS 3 Zrotation Xrotation Yrotation
  JOINT Hips
  {
    OFFSET 0 90 0
    CHANNELS 3 Xposition Yposition Zposition
    JOINT Head
    {
      OFFSET 0 80 0
      End Site
      {
        OFFSET 0 0 10
      }
    }
  }
}
MOTION
Frames: 3
Frame Time: 0.033333
0 0 0 0 90 0
0 0 0 0 95 0
0 0 0 5 95 0
)";
    EXPECT_EQ(clip_of(wrapped).facts.root, "Hips");
    EXPECT_EQ(clip_of(wrapped).facts.joints, 2);
    // Up and down is not over the ground; and an End Site is no joint to go on to.
    EXPECT_EQ(clip_of(replaced(wrapped, "0 0 0 5 95 0", "0 0 0 0 95 0")).facts.root, "Head");
    // World spins on its place: it never moves either, whatever Hips does.
    EXPECT_EQ(clip_of(replaced(wrapped, "0 0 0 5 95 0", "0 0 20 5 95 0")).facts.root, "Hips");
    ImportOptions options;
    options.root = "World";
    EXPECT_EQ(clip_of(wrapped, options).facts.root, "World");
}

TEST(MotionClips, UnitComesFromTheHeightOfTheBody) {
    const auto unit_of = [](const std::string& factor) {
        const std::string text = walk({0, 1, 2});
        ImportOptions options;
        std::string scaled = replaced(text, "0 85 0", "0 " + std::to_string(85 * std::stod(factor)) + " 0");
        scaled = replaced(scaled, "0 -85 0", "0 " + std::to_string(-85 * std::stod(factor)) + " 0");
        return clip_of(scaled, options).facts.unit;
    };
    EXPECT_EQ(unit_of("1"), 0.01);
    EXPECT_EQ(unit_of("0.01"), 1);
    EXPECT_EQ(unit_of("10"), 0.001);
    EXPECT_EQ(unit_of("0.3937"), 0.0254);
    EXPECT_EQ(unit_of("0.17716"), 0.0564444);
}

TEST(MotionClips, SamplesGoUpToAndIncludingTheLastKey) {
    const auto count = [](const std::string& frame_time, int frames, std::optional<double> fps = {}) {
        ImportOptions options;
        options.fps = fps;
        return clip_of(replaced(walk(even_steps(frames, 1)), "0.033333", frame_time), options).clip->count();
    };
    EXPECT_EQ(count("0.00833333", 517), 130);
    EXPECT_EQ(count(".0083333", 13), 4);
    EXPECT_EQ(count("0.033333", 2), 2);
    EXPECT_EQ(count("1", 2), 31);
    EXPECT_EQ(count("1", 2, 10), 11);
    EXPECT_EQ(count("5", 1), 1);
}

TEST(MotionClips, StoredFramesAreTakenWithinTheToleranceAndMixedBeyond) {
    ImportOptions options;
    options.fps = 10;
    // Frames at 0, 0.1015, 0.203: a sample at 0.1 is 0.015 frames early and takes the frame, one at 0.2 is 0.03 early.
    const ImportedClip it = clip_of(replaced(walk({0, 10, 30}), "0.033333", "0.1015"), options);
    ASSERT_EQ(it.clip->count(), 3);
    EXPECT_DOUBLE_EQ(it.clip->samples()[1].x, 0.1);
    EXPECT_NEAR(it.clip->samples()[2].x, 0.1 + 0.2 * (0.2 - 0.1015) / 0.1015, 1e-12);
}

TEST(MotionClips, TrimAndOriginTakeTheSkeletonAlong) {
    ImportOptions options;
    options.trim = {0.1, 0.2};
    const ImportedClip part = clip_of(walk({0, 3, 6, 9, 12, 15, 18, 21, 24}), options);
    ASSERT_EQ(part.clip->count(), 4);
    EXPECT_NEAR(part.clip->samples()[0].x, 0.09, 1e-9);

    options = {};
    options.unit = "cm";
    options.origin = Origin::start_heading;
    // Straight away from the viewer: -Z, which is +y on the ground.
    const std::string north = replaced(kWalker, "10 95 30 0 0 90", "0 95 10 0 0 0");
    const ImportedClip it = clip_of(north, options);
    expect_disk(it, 0, 0, 0, 0.7);
    expect_disk(it, 3, 0.2, 0, 0.7);
    ASSERT_TRUE(it.skeleton);
    EXPECT_EQ(it.skeleton->root, 0);
    ASSERT_EQ(it.skeleton->positions.size(), 16u);
    // The arm pointed along +Z, so backwards: after the turn along -x.
    const glm::vec3 tip = it.skeleton->at(3)[2];
    EXPECT_NEAR(tip.x, -0.7, 1e-6);
    EXPECT_NEAR(tip.y, 0, 1e-6);
    EXPECT_NEAR(tip.z, 1.7, 1e-6);
}

TEST(MotionClips, EveryJointOfTheSubtreeIsInsideItsDisk) {
    const ImportedClip it = clip_of(kWalker);
    for (int k = 0; k < it.clip->count(); ++k) {
        const double r = it.clip->samples()[static_cast<std::size_t>(k)].r;
        for (const glm::vec3& p : it.skeleton->at(k)) EXPECT_LE(std::hypot(p.x, p.y), r + 1e-6);
    }
}

TEST(MotionClips, WhatDoesNotApplyOrDoesNotExistIsRefused) {
    const auto refusal = [](const auto& set) {
        ImportOptions options;
        set(options);
        return input_error([&] { clip_of(kWalker, options); });
    };
    EXPECT_EQ(refusal([](ImportOptions& o) { o.root = "left arm"; }),
              "some/walk.bvh: there is no joint 'left arm' for root; the nearest is 'Left Arm'");
    EXPECT_EQ(refusal([](ImportOptions& o) { o.dt = 1; }),
              "some/walk.bvh: dt applies to tracks (CSV, trajectories) alone; leave it out");
    EXPECT_EQ(refusal([](ImportOptions& o) { o.id = "1"; }),
              "some/walk.bvh: id applies to tracks (CSV, trajectories) alone; leave it out");
    EXPECT_EQ(refusal([](ImportOptions& o) { o.animation = "1"; }),
              "some/walk.bvh: there is no animation 1; it has 1, counted from 0");
    EXPECT_EQ(refusal([](ImportOptions& o) { o.animation = "Walk"; }),
              "some/walk.bvh: there is no animation 'Walk'; it has 1, the nearest is '#0'");
    EXPECT_EQ(refusal([](ImportOptions& o) {
                  o.trim = {5, 6};
              }),
              "some/walk.bvh: trim begins at 5 s but the file lasts 0.1 s");
    ImportOptions options;
    options.fps = 1e6;
    EXPECT_EQ(input_error([&] { clip_of(replaced(kWalker, "Time: 0.1", "Time: 2"), options); }),
              "some/walk.bvh: its times make more than 1000000 samples; check them, or lower fps");
    EXPECT_EQ(input_error([&] { clip_of(replaced(kWalker, "Time: 0.1", "Time: 30"), options); }),
              "some/walk.bvh: Frame Time is 30 seconds, which looks like frames a second; if so, write 0.0333333 there "
              "(line 23); its times make more than 1000000 samples; check them, or lower fps");
    EXPECT_TRUE(warns(clip_of(replaced(kWalker, "Time: 0.1", "Time: 30")), "which looks like frames a second"));
}

TEST(MotionClips, NamesAndZerosDoNotTakeHours) {
    std::string text = "HIERARCHY\nROOT r\n{OFFSET 0 0 0\nCHANNELS 1 Xposition\n";
    for (int i = 0; i < 2000; ++i) text += "JOINT j\n{OFFSET 0 0 0}\n";
    text += "}\nMOTION\nFrames: 60000\nFrame Time: 0.001\n";
    for (int i = 0; i < 60'000; ++i) text += "0\n";
    const std::string refusal = input_error([&] { clip_of(text); });
    EXPECT_NE(refusal.find("walk.bvh: its frames would take more than"), std::string::npos) << refusal;
}

TEST(MotionClips, WarningsNameTheSamples) {
    EXPECT_TRUE(clip_of(walk(even_steps(60, 4))).facts.warnings.empty());

    const ImportedClip t_pose = clip_of(walk(even_steps(60, 4), 75));
    EXPECT_TRUE(warns(t_pose, "sample 0 (file frame 0) is a pose that the motion does not begin with"));

    std::vector<double> jumping = even_steps(60, 4);
    for (std::size_t i = 21; i < jumping.size(); ++i) jumping[i] += 50;
    EXPECT_TRUE(warns(clip_of(walk(jumping)), "jumps 0.54 m from sample 20 to 21 (file frames 20 and 21)"));
    for (std::size_t i = 41; i < jumping.size(); ++i) jumping[i] += 90;
    EXPECT_TRUE(warns(clip_of(walk(jumping)), "jumps 2 times, first after sample 20"));

    std::vector<double> glitch = even_steps(60, 4);
    glitch[30] += 40;
    EXPECT_TRUE(warns(clip_of(walk(glitch)), "the path jumps 0.44 m from sample 29"));

    EXPECT_TRUE(warns(clip_of(walk(even_steps(60, 0.01))), "an animation in place"));
    ImportOptions piece;
    piece.trim = {0.2, 1};
    EXPECT_FALSE(warns(clip_of(walk(even_steps(60, 0.01)), piece), "an animation in place"))
        << "who cuts out somebody standing knows it";
    EXPECT_TRUE(warns(clip_of(walk(even_steps(60, 60))), "the usual speed is 18 m/s"));
    ImportOptions options;
    options.unit = "m";
    EXPECT_TRUE(warns(clip_of(walk(even_steps(60, 4)), options), "the usual radius is 40 m"));
    EXPECT_TRUE(warns(clip_of(replaced(walk(even_steps(60, 4)), "0 85 0", "0 300 0")), "give unit"));
}

TEST(MotionClips, HeadingsOfAPartAreAsManyAsItsSamples) {
    // Where times round, the part has a sample more than the whole has from there on.
    const std::string walk = replaced(replaced(kWalker, "Time: 0.1", "Time: 1"), "10 95 30 0 0 90", "0 95 930 0 0 0");
    ImportOptions options;
    options.fps = 10;
    options.trim = {0.5001, 1};
    options.body = {{1, 0, 0.5}, {-1, 0, 0.25}};
    const ImportedClip clip = clip_of(walk, options);
    EXPECT_EQ(clip.headings.size(), clip.clip->samples().size());
    for (const double heading : clip.headings) EXPECT_NEAR(heading, -90, 1e-6);
}

}  // namespace
}  // namespace mobbscope
