// Motion files by hand: hierarchy, rest pose, angles, names, times, and what no file can hold.
#include "exported.h"

#include <import/bvh/bvh.h>
#include <import/gltf_bytes.h>
#include <motion_files/formats.h>
#include <scene/crowd_run.h>
#include <scene/motion_graph.h>
#include <support/bvh_text.h>
#include <support/input_error.h>
#include <support/mutate.h>
#include <support/temp_folder.h>

#include <gtest/gtest.h>

#include <cstring>
#include <nlohmann/json.hpp>
#include <random>
#include <sstream>
#include <string>

namespace mobbscope {
namespace {

using nlohmann::json;

/// Three plays of the walker's two frames on a floor, the last one turned on the spot.
std::string run_text(const std::string& clip = R"({"source": "walk.bvh", "fps": 10, "unit": "cm"})",
                     const std::string& second = R"({"source": "walk.bvh", "fps": 10, "unit": "cm"})") {
    return R"({"clips": {"walk": )" + clip + R"(, "again": )" + second + R"(},
      "graph": {"hubs": [{"name": "any"}], "moves": [
        {"clip": "walk", "from": 0, "to": 0, "entry": [0, -0.3, 0], "exit": [0.2, -0.3, 0]},
        {"clip": "again", "from": 0, "to": 0, "entry": [0, -0.3, 0], "exit": [0.2, -0.3, 0]}]},
      "crowd": {"area": [30, 40], "seconds": 0.5, "seed": 1, "agents": [
        {"name": "17", "plays": [{"move": 0, "translate": [3, 4], "rotate_deg": 0, "start": -0.05},
                                 {"move": 1, "translate": [3.2, 4], "rotate_deg": 0, "start": 0.15},
                                 {"move": 0, "translate": [3.1, 3.7], "rotate_deg": 90, "start": 0.35,
                                  "kind": "pivoted"}]},
        {"name": "early", "plays": [{"move": 0, "translate": [9, 9], "rotate_deg": 30, "start": -0.15}]}]}})";
}

/// The walker's file in a folder, and scenes that name it.
class MotionFiles : public ::testing::Test {
  protected:
    MotionFiles() { folder.write("walk.bvh", kWalker); }

    Scene scene(const std::string& text) const { return load_scene(folder.write("run.json", text)); }
    PlayedMotion played(const std::string& text, const std::string& agent) const {
        return PlayedMotion(scene(text), agent);
    }

    TempFolder folder;
};

TEST_F(MotionFiles, PlaysStandOneAfterAnotherWhereTheyWerePlayed) {
    const PlayedMotion motion = played(run_text(), "17");
    ASSERT_EQ(motion.frames(), 6);
    EXPECT_EQ(motion.plays(), 3u);
    EXPECT_EQ(motion.begin(), -0.05);
    EXPECT_NEAR(motion.lead(), 0.1, 1e-12);
    const std::vector<glm::dvec2> places{{3, 3.7}, {3.1, 3.7}, {3.2, 3.7}, {3.3, 3.7}, {3.4, 3.7}, {3.4, 3.8}};
    for (const MotionFormat& format : motion_formats()) {
        const ImportedClip clip = imported_again(motion, format);
        ASSERT_EQ(clip.clip->count(), 6) << format.extension;
        EXPECT_NEAR(clip.clip->dt(), 0.1, 1e-12);
        for (std::size_t i = 0; i < places.size(); ++i) {
            EXPECT_NEAR(clip.clip->samples()[i].x, places[i].x, 1e-6) << format.extension << i;
            EXPECT_NEAR(clip.clip->samples()[i].y, places[i].y, 1e-6) << format.extension << i;
            EXPECT_NEAR(clip.clip->samples()[i].r, 0.7, 1e-6) << format.extension << i;
        }
        EXPECT_LT(farthest_off(motion, format), 1e-5) << format.extension;
    }
}

TEST_F(MotionFiles, ABvhHasTheOffsetsOfItsSource) {
    const std::string text = to_bvh(played(run_text(), "17"));
    EXPECT_TRUE(
        text.starts_with("HIERARCHY\nROOT Hips\n{\n\tOFFSET 0.000000 0.000000 0.000000\n"
                         "\tCHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation\n"
                         "\tJOINT Left Arm\n\t{\n\t\tOFFSET 0.000000 0.750000 0.500000\n"
                         "\t\tCHANNELS 3 Zrotation Xrotation Yrotation\n"))
        << text;
    EXPECT_NE(text.find("OFFSET 0.000000 0.000000 0.200000"), std::string::npos) << text;
    EXPECT_NE(text.find("OFFSET 0.000000 -0.950000 0.000000"), std::string::npos) << text;
    EXPECT_NE(text.find("MOTION\nFrames: 6\nFrame Time: 0.1\n3.000000 0.950000 -3.700000 0.000000 0.000000 0.000000 "),
              std::string::npos)
        << text;
}

TEST_F(MotionFiles, JointsKeepTheirOwnAxesAndRest) {
    const PlayedMotion motion(scene(R"({"clips": {"w": {"source": "walk.bvh", "fps": 10, "unit": "cm"}}})"), {});
    const MotionFile bvh = written_and_read(motion, motion_formats()[0]);
    const MotionFile glb = written_and_read(motion, motion_formats()[1]);
    const auto source = bvh_motion(parse_bvh(kWalker, "walk.bvh")).motion(0, 0);
    for (const double time : {0.0, 0.1}) {
        std::vector<glm::dvec3> p(source->joints().size());
        std::vector<glm::dquat> q(p.size());
        source->pose(time, p, q);
        for (const MotionFile* file : {&bvh, &glb}) {
            const auto again = file->motion(0, 0);
            std::vector<glm::dvec3> places(again->joints().size());
            std::vector<glm::dquat> turns(places.size());
            again->pose(time, places, turns);
            const std::vector<glm::dquat> rest = again->rest();
            for (std::size_t i = 0; i < source->joints().size(); ++i) {
                const Joint& joint = source->joints()[i];
                if (joint.end_site) continue;
                const auto at = std::ranges::find(again->joints(), joint.name, &Joint::name);
                ASSERT_NE(at, again->joints().end());
                const auto j = static_cast<std::size_t>(at - again->joints().begin());
                EXPECT_NEAR(std::abs(glm::dot(turns[j], q[i])), 1, 1e-6) << file->format << ' ' << joint.name;
                EXPECT_NEAR(std::abs(glm::dot(rest[j], glm::dquat(1, 0, 0, 0))), 1, 1e-6);
            }
        }
    }
}

TEST_F(MotionFiles, TheRestOfAGltfIsThePoseOfZeroAngles) {
    // An arm along its own x, whose shoulder is turned up by 90 degrees about z where nothing is animated, and scaled.
    GltfBytes bytes;
    const int times = bytes.add_floats("SCALAR", {0, 1.0F / 30});
    const auto half = static_cast<float>(std::sqrt(0.5));
    bytes.channel("0", "translation", times, bytes.add_floats("VEC3", {0, 1, 0, 1, 1, 0}));
    bytes.channel("0", "rotation", times, bytes.add_floats("VEC4", {0, 0, 0, 1, 0, half, 0, half})).animation();
    folder.write("arm.glb", bytes.glb(R"([{"name": "shoulder", "rotation": [0, 0, 0.7071067811865476,
        0.7071067811865476], "scale": [0.5, 0.5, 0.5], "children": [1, 2]},
        {"name": "hand", "translation": [1, 0, 0]}, {"name": "thumb", "translation": [0, 0.5, 0]}])"));
    const PlayedMotion motion(scene(R"({"clips": {"w": {"source": "arm.glb"}}})"), {});
    const std::string text = to_bvh(motion);
    EXPECT_NE(text.find("JOINT hand\n\t{\n\t\tOFFSET 0.000000 0.500000 0.000000\n"), std::string::npos) << text;
    EXPECT_NE(text.find("JOINT thumb\n\t{\n\t\tOFFSET -0.250000 0.000000 0.000000\n"), std::string::npos) << text;
    // The first frame turns the shoulder back by 90 degrees, the second about y as well.
    EXPECT_NE(text.find("\n0.000000 1.000000 0.000000 -90.000000 0.000000 0.000000 "), std::string::npos) << text;
    for (const MotionFormat& format : motion_formats()) EXPECT_LT(farthest_off(motion, format), 1e-6);
    const MotionFile glb = written_and_read(motion, motion_formats()[1]);
    const glm::dquat rest = glb.motion(0, 0)->rest().front();
    EXPECT_NEAR(rest.z, std::sqrt(0.5), 1e-6);
    EXPECT_NEAR(rest.w, std::sqrt(0.5), 1e-6);
}

TEST_F(MotionFiles, OfARootThatIsNotTheTopmostJointTheRestIsLeftOut) {
    std::string text = replaced(kWalker, "ROOT Hips", "ROOT World\n{\nOFFSET 0 0 0\nCHANNELS 1 Yposition\nJOINT Hips");
    text = replaced(text, "MOTION", "}\nMOTION");
    text = replaced(text, "0 95 30 0 0 0 0", "5 0 95 30 0 0 0 0");
    text = replaced(text, "10 95 30 0", "5 10 95 30 0");
    folder.write("walk.bvh", text);
    const PlayedMotion motion = played(run_text(), "17");
    EXPECT_EQ(motion.joints().front().name, "Hips");
    EXPECT_EQ(motion.joints().size(), 4u);
    for (const MotionFormat& format : motion_formats())
        EXPECT_LT(farthest_off(motion, format), 1e-5) << format.extension;
}

TEST_F(MotionFiles, ZUpAndAHeadingTurnJointsWithTheBody) {
    const std::string clip =
        R"({"source": "walk.bvh", "fps": 10, "unit": "cm", "up": "z", "root": "Hips", "origin": "start_heading"})";
    const PlayedMotion motion(scene(R"({"clips": {"w": )" + clip + R"(}, "agents": [
        {"name": "A", "clip": "w", "translate": [5, -2], "rotate_deg": 40, "start": 7},
        {"name": "B", "clip": "w"}]})"),
                              "A");
    EXPECT_EQ(motion.lead(), 7);
    for (const MotionFormat& format : motion_formats())
        EXPECT_LT(farthest_off(motion, format), 1e-5) << format.extension;
    // The arm keeps its place on the body: bones do not vary.
    for (const Bone& bone : motion.bones()) EXPECT_FALSE(bone.varies);
}

TEST_F(MotionFiles, APathThatWasTurnedTurnsItsJoints) {
    folder.write("walk.bvh", replaced(kWalker, "10 95 30 0 0 90", "0 95 15 0 0 90"));
    const std::string clip = R"({"source": "walk.bvh", "fps": 10, "unit": "cm", "origin": "start_heading"})";
    const PlayedMotion motion(scene(R"({"clips": {"w": )" + clip + "}}"), {});
    // The hips go along +y, and then along +x: clockwise, as about Y by -90 degrees.
    const BvhData again = parse_bvh(to_bvh(motion), "again.bvh");
    EXPECT_NEAR(again.values[5], -90, 1e-4);
    EXPECT_NEAR(again.values[again.row_length], 0.15, 1e-6);
    EXPECT_NEAR(again.values[again.row_length + 5], 0, 1e-4);
}

TEST_F(MotionFiles, BetweenTheFramesOfABvhBonesGetPositionsOfTheirOwn) {
    const std::string clip = R"({"source": "walk.bvh", "fps": 20, "unit": "cm"})";
    const PlayedMotion motion(scene(R"({"clips": {"w": )" + clip + "}}"), {});
    ASSERT_EQ(motion.frames(), 3);
    EXPECT_TRUE(motion.bones()[1].varies);
    EXPECT_NE(to_bvh(motion).find("JOINT Left Arm_tip\n"), std::string::npos);
    for (const MotionFormat& format : motion_formats()) {
        const ImportedClip again = imported_again(motion, format);
        EXPECT_NEAR(again.clip->samples()[1].x, motion.disks()[1].x, 1e-6);
        const DiskDifference off = read_back(format.write(motion), format, motion);
        // Half way through a turn of 90 degrees the arm's tip is nearer to the hips than the mean of both radii.
        EXPECT_NEAR(off.radius, 0.7 - 0.7 * std::sqrt(0.5), 1e-5) << format.extension;
        EXPECT_LT(off.place, 1e-6);
    }
}

TEST_F(MotionFiles, AnglesRunOnFromFrameToFrame) {
    // Hips that turn by 40 degrees a frame, a foot that swings through the angles where z and y turn about one axis.
    std::string rows;
    for (int i = 0; i < 40; ++i) {
        rows += std::to_string(i) + " 95 0 0 0 " + std::to_string(40 * i) + " 170 " + std::to_string(8 * i) +
                " 175 0 " + std::to_string(15 * i) + " 0\n";
    }
    std::string text = kWalker.substr(0, kWalker.find("0 95 30"));
    folder.write("walk.bvh", replaced(text, "Frames: 2", "Frames: 40") + rows);
    const PlayedMotion motion(scene(R"({"clips": {"w": {"source": "walk.bvh", "fps": 10, "unit": "cm"}}})"), {});
    EXPECT_LT(farthest_off(motion, motion_formats()[0]), 1e-5);
    const BvhData data = parse_bvh(to_bvh(motion), "again.bvh");
    for (std::size_t frame = 1; frame < data.frames(); ++frame) {
        for (std::size_t c = 3; c < 6; ++c) {
            const auto at = [&](std::size_t f) { return data.values[f * data.row_length + c]; };
            EXPECT_LE(std::abs(at(frame) - at(frame - 1)), 40.001) << frame << ' ' << c;
        }
    }
}

TEST_F(MotionFiles, AGlbKeepsToItsSpecification) {
    const std::string bytes = to_glb(played(run_text(), "17"));
    std::uint32_t header[5];
    std::memcpy(header, bytes.data(), sizeof header);
    EXPECT_EQ(bytes.substr(0, 4), "glTF");
    EXPECT_EQ(header[1], 2u);
    ASSERT_EQ(header[2], bytes.size());
    EXPECT_EQ(header[3] % 4, 0u);
    const json gltf = json::parse(bytes.substr(20, header[3]));
    EXPECT_EQ(gltf["asset"]["version"], "2.0");
    EXPECT_EQ(gltf["nodes"][0]["name"], "17");
    EXPECT_EQ(gltf["nodes"][1]["name"], "Hips");
    EXPECT_EQ(gltf["skins"][0]["joints"].size(), 4u);
    ASSERT_EQ(gltf["animations"].size(), 1u);
    const json& times = gltf["accessors"][gltf["animations"][0]["samplers"][0]["input"].get<std::size_t>()];
    // The other agent begins a tenth of a second earlier: all files of a run share one clock.
    EXPECT_NEAR(times["min"][0].get<double>(), 0.1, 1e-6);
    EXPECT_NEAR(times["max"][0].get<double>(), 0.6, 1e-6);
    for (const json& view : gltf["bufferViews"]) EXPECT_EQ(view.value("byteOffset", 0) % 4, 0);
}

TEST_F(MotionFiles, NamesThatAFormatCannotHoldAreWrittenOtherwise) {
    std::string text = replaced(kWalker, "Left Arm", "Arm\xff l\xc3\xa4nge");
    folder.write("walk.bvh", replaced(text, "JOINT Foot", "JOINT \x01"));
    const PlayedMotion motion(scene(R"({"clips": {"w": {"source": "walk.bvh", "fps": 10, "unit": "cm"}}})"), {});
    const MotionFile bvh = written_and_read(motion, motion_formats()[0]);
    const MotionFile glb = written_and_read(motion, motion_formats()[1]);
    EXPECT_EQ(bvh.motion(0, 0)->joints().size(), 5u);  // the foot's end is one more
    EXPECT_EQ(bvh.motion(0, 0)->joints()[3].name, "_");
    EXPECT_EQ(glb.motion(0, 0)->joints().size(), 4u);
    for (const MotionFormat& format : motion_formats())
        EXPECT_LT(farthest_off(motion, format), 1e-5) << format.extension;
}

TEST_F(MotionFiles, FarAwayAndLateNothingIsLost) {
    const std::string clip = R"({"source": "walk.bvh", "fps": 10, "unit": "cm"})";
    const PlayedMotion motion(scene(R"({"clips": {"w": )" + clip + R"(}, "agents": [
        {"name": "A", "clip": "w", "translate": [10000, -20000], "start": 3000},
        {"name": "B", "clip": "w", "start": 2800}]})"),
                              "A");
    for (const MotionFormat& format : motion_formats())
        EXPECT_LT(farthest_off(motion, format), 1e-4) << format.extension;
}

TEST_F(MotionFiles, ARootThatStandsStillHasToBeNamed) {
    // The hips turn on the spot with the arm alone below them.
    std::string text = replaced(kWalker, "10 95 30 0 0 90", "0 95 30 0 0 90");
    const std::size_t foot = text.find("  JOINT Foot");
    text.erase(foot, text.find("MOTION") - 2 - foot);
    text = replaced(replaced(text, "0 0 0 0 0 0 0 0 0\n0 95", "0 0 0 0 0 0\n0 95"), "90 0 0 0 0 0 0", "90 0 0 0");
    folder.write("walk.bvh", text);
    const PlayedMotion motion(
        scene(R"({"clips": {"w": {"source": "walk.bvh", "root": "Hips", "fps": 10, "unit": "cm"}}})"), {});
    const DiskDifference off = read_back(to_bvh(motion), motion_formats().front(), motion);
    EXPECT_EQ(off.root, "Hips");
    EXPECT_LT(off.place, 1e-6);
}

TEST_F(MotionFiles, WhatNoFileCanHoldIsRefusedInOneLine) {
    const auto refused = [&](const std::string& text, const std::optional<std::string>& agent,
                             const std::string& words) {
        const Scene in = scene(text);
        const std::string message = input_error([&] { PlayedMotion(in, agent); });
        EXPECT_NE(message.find("run.json: "), std::string::npos) << message;
        EXPECT_NE(message.find(words), std::string::npos) << message;
    };
    refused(run_text(), "71", "there is no agent '71'; the nearest is '17'");
    refused(run_text(), {}, "a motion file holds one agent, and there are 2; name one with --agent, such as '17'");
    refused(run_text(R"({"dt": 0.1, "samples": [[0,-0.3,1],[0.1,-0.3,1]]})"), "17",
            "agent '17': plays the clip 'walk', which has no skeleton");
    folder.write("walk.csv", "t,x,y,r\n0,0,-0.3,1\n0.1,0.1,-0.3,1\n");
    refused(run_text(R"({"source": "walk.bvh", "fps": 10, "unit": "cm"})", R"({"source": "walk.csv"})"), "17",
            "plays the clip 'again', which has no skeleton");
    refused(run_text(R"({"source": "walk.bvh", "fps": 10, "unit": "cm"})",
                     R"({"source": "walk.bvh", "fps": 5, "trim": [0, 0.1], "unit": "cm"})"),
            "17", "plays clips of different sample rates, such as 'walk' and 'again' (every 0.1 and 0.2 s)");
    folder.write("other.bvh", replaced(kWalker, "Foot", "Leg"));
    refused(run_text(R"({"source": "walk.bvh", "fps": 10, "unit": "cm"})",
                     R"({"source": "other.bvh", "fps": 10, "unit": "cm"})"),
            "17", "plays clips of different skeletons, such as 'walk' and 'again' (4 joints and 4)");
}

TEST_F(MotionFiles, DamagedRunsAndRecordingsAreWrittenOrRefused) {
    std::mt19937 random(17);
    int written = 0;
    for (int i = 0; i < 400; ++i) {
        const bool in_run = i % 2 == 0;
        folder.write("walk.bvh", in_run ? kWalker : mutated(kWalker, random));
        try {
            const Scene damaged = scene(in_run ? mutated(run_text(), random) : run_text());
            const PlayedMotion motion(damaged, damaged.crowd ? damaged.crowd->agents.front().name : "walk");
            for (const MotionFormat& format : motion_formats()) {
                const std::string bytes = format.write(motion);
                read_back(bytes, format, motion);
            }
            ++written;
        } catch (const InputError& error) {
            EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
        }
    }
    EXPECT_GT(written, 20);
}

}  // namespace
}  // namespace mobbscope
