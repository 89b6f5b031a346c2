// Motion files of several characters in `conflicts`: each is somebody who may meet the others.
#include "run_program.h"

#include "../import/gltf_bytes.h"

#include <support/temp_folder.h>

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace mobbscope {
namespace {

/// Two people, A and B, who go 2 m along x with an arm of 0.3 m; B is so far beside A, with keys at these times, and in
/// an animation of its own or in that of A.
std::string two_people(bool in_one_animation, float beside, const std::vector<float>& times) {
    GltfBytes bytes;
    const auto walk = [&](const std::string& node, const std::vector<float>& at, float z) {
        bytes.channel(node, "translation", bytes.add_floats("SCALAR", at),
                      bytes.add_floats("VEC3", {0, 0, z, 2, 0, z}));
    };
    walk("0", {0, 2}, 0);
    if (!in_one_animation) bytes.animation("walk_A");
    walk("2", times, beside);
    bytes.animation(in_one_animation ? "walk" : "walk_B");
    return bytes.glb(R"([{"name":"A","children":[1]},{"translation":[0,0.9,0.3]},)"
                     R"({"name":"B","children":[3]},{"translation":[0,0.9,0.3]}])",
                     R"(,"skins":[{"joints":[0,1]},{"joints":[2,3]}])");
}

TEST(Performers, PeopleOfOneFileMeetWithoutAScene) {
    const TempFolder folder;
    for (const bool in_one : {true, false}) {
        const json near = json_of({"conflicts", folder.write("near.glb", two_people(in_one, 0.5, {0, 2}))});
        EXPECT_EQ(near["agents"], 2);
        EXPECT_EQ(near["conflicts"].size(), 1u);
        const json far = json_of({"conflicts", folder.write("far.glb", two_people(in_one, 1, {0, 2}))});
        EXPECT_EQ(far["agents"], 2);
        EXPECT_EQ(far["conflicts"].size(), 0u);
    }
    const std::string bvh =
        "HIERARCHY\nROOT A\n{\nOFFSET 0 0 0\nCHANNELS 3 Xposition Yposition Zposition\nEnd Site\n{\nOFFSET 30 170 "
        "0\n}\n"
        "}\nROOT B\n{\nOFFSET 0 0 0\nCHANNELS 3 Xposition Yposition Zposition\nEnd Site\n{\nOFFSET 30 170 0\n}\n}\n"
        "MOTION\nFrames: 3\nFrame Time: 0.5\n0 0 0 300 0 0\n100 0 0 150 0 0\n200 0 0 0 0 0\n";
    EXPECT_EQ(json_of({"conflicts", folder.write("two.bvh", bvh)})["conflicts"].size(), 1u);
}

TEST(Performers, EachIsThereFromItsFirstKeyToItsLast) {
    const TempFolder folder;
    const std::string file = folder.write("late.glb", two_people(true, 0, {2.5, 4.5}));
    EXPECT_EQ(json_of({"conflicts", file})["conflicts"].size(), 0u) << "on one line, one after the other";
    const json clips = json_of({"info", file})["clips"];
    EXPECT_EQ(clips[0]["file_duration"], 2);
    EXPECT_EQ(clips[1]["start"], 2.5);
}

TEST(Performers, TakesOnOneTimelineKeepTheirTimes) {
    const TempFolder folder;
    const std::string file = folder.write("takes.glb", two_people(false, 0, {2.5, 4.5}));
    const json found = json_of({"conflicts", file});
    EXPECT_EQ(found["agents"], 2);
    EXPECT_EQ(found["conflicts"].size(), 0u) << "B begins when A has gone";
    EXPECT_EQ(found["t0"], 0);
    const json clips = json_of({"info", file})["clips"];
    EXPECT_EQ(clips[0]["t0"], 0);
    EXPECT_EQ(clips[1]["t0"], 2.5);
    EXPECT_EQ(clips[1]["start"], 2.5);
    const Result run = run_program({"info", file});
    EXPECT_NE(run.out.find("  first key    at 2.5 s of the file, which is 0 s of the clip\n"), std::string::npos)
        << run.out;
    // Alone it is at the time that the file says.
    EXPECT_EQ(json_of({"info", file, "--animation", "walk_B"})["clips"][0]["t0"], 2.5);
}

TEST(Performers, WhoIsInSeveralTakesIsAskedFor) {
    const TempFolder folder;
    const std::string file = folder.write("one.glb", two_people(true, 1, {0, 2}));
    const Result alone = run_program({"conflicts", file, "--root", "A"});
    EXPECT_EQ(alone.status, 2);
    EXPECT_NE(alone.err.find("there are no agents who could meet; give a scene with agents, trajectories, a CSV with "
                             "ids or a motion of several characters"),
              std::string::npos)
        << alone.err;
    GltfBytes bytes;
    for (const char* name : {"walk", "run"}) {
        for (const char* node : {"0", "2"}) {
            bytes.channel(node, "translation", bytes.add_floats("SCALAR", {0, 2}),
                          bytes.add_floats("VEC3", {0, 0, 0, 2, 0, 0}));
        }
        bytes.animation(name);
    }
    const std::string takes =
        folder.write("takes.glb", bytes.glb(R"([{"name":"A","children":[1]},{"translation":[0,0.9,0.3]},)"
                                            R"({"name":"B","children":[3]},{"translation":[0,0.9,0.3]}])",
                                            R"(,"skins":[{"joints":[0,1]},{"joints":[2,3]}])"));
    const Result several = run_program({"conflicts", takes});
    EXPECT_EQ(several.status, 2);
    EXPECT_NE(several.err.find("has several animations of 'B', who cannot be in two at one time; choose one with "
                               "--animation"),
              std::string::npos)
        << several.err;
    EXPECT_EQ(json_of({"conflicts", takes, "--animation", "run"})["agents"], 2);
}

}  // namespace
}  // namespace mobbscope
