// FBX files of several skeletons: which are people, and which are their props.
#include "fbx_scene.h"

#include <import/import.h>
#include <support/temp_folder.h>

#include <filesystem>

namespace mobbscope {
namespace {

using namespace testing::fbx;

/// A body of seven joints of usual names below `parent`, which walks from `from` to `to` along x.
std::int64_t add_person(Scene& scene, std::int64_t layer, std::int64_t parent, double from, double to, double z) {
    const std::int64_t hips = scene.model("Hips", parent, {{"Lcl Translation", vector(from, 95, z)}});
    const std::int64_t spine = scene.model("Spine", hips, {{"Lcl Translation", vector(0, 30, 0)}});
    for (const char* name : {"Head", "LeftHand", "RightHand"})
        scene.model(name, spine, {{"Lcl Translation", vector(name[0] == 'L' ? 60 : -60, 20, 0)}});
    for (const char* name : {"LeftFoot", "RightFoot"})
        scene.model(name, hips, {{"Lcl Translation", vector(10, -90, 0)}});
    scene.animate(layer, hips, "Lcl Translation", {{"X", line(from, to)}}, {{"d|Y", scalar(95)}, {"d|Z", scalar(z)}});
    return hips;
}

void expect_ends(const ImportedClip& clip, double x0, double y0, double x1, double y1) {
    const auto samples = clip.clip->samples();
    EXPECT_NEAR(samples.front().x, x0, 1e-9) << clip.name;
    EXPECT_NEAR(samples.front().y, y0, 1e-9) << clip.name;
    EXPECT_NEAR(samples.back().x, x1, 1e-9) << clip.name;
    EXPECT_NEAR(samples.back().y, y1, 1e-9) << clip.name;
    EXPECT_NEAR(samples.front().r, 0.6, 1e-9) << clip.name;
}

TEST(FbxPeople, OfEqualJointNamesAreTwoClips) {
    for (const int way : {0, 1, 2, 3, 4}) {
        SCOPED_TRACE(way);
        Scene scene;
        const std::int64_t layer = scene.layer(scene.stack("Take 001"));
        std::int64_t above[2] = {0, 0};
        if (way == 1) above[0] = above[1] = scene.model("Scene", 0, {}, "Null");
        if (way == 2 || way == 3) {
            for (std::int64_t& group : above) group = scene.model("Armature", 0, {}, way == 2 ? "Null" : "Mesh");
        }
        add_person(scene, layer, above[0], 0, 400, 0);
        add_person(scene, layer, above[1], 0, -200, 300);
        if (way == 4) scene.model("Camera", 0, {}, "Camera");
        const TempFolder folder;
        const auto file = folder.write("clip.fbx", scene.bytes());
        const std::vector<ImportedClip> clips = import_clips(file, {});
        ASSERT_EQ(clips.size(), 2u);
        EXPECT_EQ(clips[0].name, "Take 001 · Hips");
        EXPECT_EQ(clips[1].name, "Take 001 · Hips #2");
        expect_ends(clips[0], 0, 0, 4, 0);
        expect_ends(clips[1], 0, -3, -2, -3);
        ImportOptions second;
        second.root = "Hips #2";
        const std::vector<ImportedClip> chosen = import_clips(file, second);
        ASSERT_EQ(chosen.size(), 1u);
        expect_ends(chosen[0], 0, -3, -2, -3);
    }
}

TEST(FbxPeople, WhatCarriesOneOfThemMovesIt) {
    // Two groups that walk, with bodies that stand still in them.
    Scene scene;
    const std::int64_t layer = scene.layer(scene.stack("Take 001"));
    for (const double z : {0.0, 300.0}) {
        const std::int64_t group = scene.model("Reference", 0, {{"Lcl Translation", vector(0, 0, z)}}, "Null");
        scene.animate(layer, group, "Lcl Translation", {{"X", line(0, 100)}}, {{"d|Z", scalar(z)}});
        add_person(scene, layer, group, 0, 0, 0);
    }
    const TempFolder folder;
    const std::vector<ImportedClip> clips = import_clips(folder.write("clip.fbx", scene.bytes()), {});
    ASSERT_EQ(clips.size(), 2u);
    expect_ends(clips[0], 0, 0, 1, 0);
    expect_ends(clips[1], 0, -3, 1, -3);
}

TEST(FbxPeople, OneWithPropsAndControlsIsOne) {
    Scene scene;
    const std::int64_t layer = scene.layer(scene.stack("Take 001"));
    const std::int64_t armature = scene.model("Armature", 0, {}, "Null");
    add_person(scene, layer, armature, 0, 400, 0);
    for (const char* name : {"ik_foot_l", "ik_foot_r"}) {
        const std::int64_t control = scene.model(name, armature);
        scene.animate(layer, control, "Lcl Translation", {{"X", line(0, 400)}});
    }
    scene.animate(layer, scene.model("Ball", 0, {}, "Mesh"), "Lcl Translation", {{"X", line(0, 100)}});
    const TempFolder folder;
    EXPECT_EQ(import_clips(folder.write("clip.fbx", scene.bytes()), {}).size(), 1u);
}

/// A chain of limbs, the first of which walks from 0 to `to` along x; the id of that.
std::int64_t add_chain(Scene& scene, std::int64_t layer, const std::string& name, int limbs, double to,
                       const std::string& type = "LimbNode") {
    const std::int64_t first = scene.model(name, 0, {}, type);
    std::int64_t above = first;
    for (int i = 1; i < limbs; ++i)
        above = scene.model(name + std::to_string(i), above, {{"Lcl Translation", vector(0, 40, 0)}}, type);
    scene.animate(layer, first, "Lcl Translation", {{"X", line(0, to)}});
    return first;
}

std::vector<std::string> clip_names(const Scene& scene) {
    const TempFolder folder;
    std::vector<std::string> out;
    for (const ImportedClip& clip : import_clips(folder.write("clip.fbx", scene.bytes()), {})) {
        out.push_back(clip.name + ": " + clip.facts.root);
    }
    return out;
}

TEST(FbxPeople, AreFoundWhateverMovesBesideThem) {
    // A camera or a ball that moves, before the body and behind it.
    for (const char* type : {"Camera", "Mesh", "Null"}) {
        for (const bool is_first : {true, false}) {
            Scene scene;
            const std::int64_t layer = scene.layer(scene.stack("Take 001"));
            const auto add_other = [&] {
                scene.animate(layer, scene.model("Other", 0, {}, type), "Lcl Translation", {{"X", line(0, 100)}});
            };
            if (is_first) add_other();
            add_person(scene, layer, 0, 0, 400, 0);
            if (!is_first) add_other();
            EXPECT_EQ(clip_names(scene), std::vector<std::string>{"clip: Hips"}) << type << ' ' << is_first;
        }
    }
}

TEST(FbxPeople, OfFewLimbsAreTwoAsWell) {
    for (const int limbs : {2, 3, 4}) {
        Scene scene;
        const std::int64_t layer = scene.layer(scene.stack("t"));
        add_chain(scene, layer, "a", limbs, 100);
        add_chain(scene, layer, "b", limbs, 200);
        EXPECT_EQ(clip_names(scene), (std::vector<std::string>{"t · a: a", "t · b: b"})) << limbs;
    }
    Scene beams;  // of the nodes that move where none is a limb
    const std::int64_t layer = beams.layer(beams.stack("t"));
    for (const char* name : {"a", "b"}) {
        const std::int64_t first = add_chain(beams, layer, name, 2, 100, "Null");
        beams.animate(layer, first + 1, "Lcl Rotation", {{"X", line(0, 90)}});
    }
    EXPECT_EQ(clip_names(beams).size(), 2u);
}

TEST(FbxPeople, SmallSkeletonsBesideThemAreNamed) {
    Scene scene;
    const std::int64_t layer = scene.layer(scene.stack("Take 001"));
    add_chain(scene, layer, "Sword", 2, 100);
    add_person(scene, layer, 0, 0, 400, 0);
    add_chain(scene, layer, "Ball", 1, 100);
    const TempFolder folder;
    const auto file = folder.write("clip.fbx", scene.bytes());
    const std::vector<ImportedClip> clips = import_clips(file, {});
    ASSERT_EQ(clips.size(), 1u);
    EXPECT_EQ(clips[0].facts.root, "Hips");
    ASSERT_EQ(clips[0].facts.warnings.size(), 1u);
    EXPECT_EQ(clips[0].facts.warnings[0].text,
              "the small skeletons 'Sword' and 1 more were left out; give root to follow one");
    ImportOptions sword;
    sword.root = "Sword";
    EXPECT_EQ(import_clips(file, sword).at(0).facts.root, "Sword");
}

TEST(FbxPeople, AreAtMostAThousand) {
    Scene scene;
    const std::int64_t layer = scene.layer(scene.stack("t"));
    for (int i = 0; i < 1001; ++i) add_chain(scene, layer, "a", 2, 100);
    EXPECT_EQ(refusal(scene.bytes()),
              "clip.fbx: holds 1001 characters, but at most 1000 are read; export fewer at a time");
}

}  // namespace
}  // namespace mobbscope
